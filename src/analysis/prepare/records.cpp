#include "analysis/prepare/records.hpp"

#include "core/input_error.hpp"
#include "records/read/read_record.hpp"
#include "records/transform/ground_motion.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

constexpr double largest_accel = 1e4; ///< [m/s2], a thousand times gravity

[[noreturn]] void refuse_scale(const RecordPair& pair, double factor)
{
    throw InputError(
        Diagnostic{pair.files.horizontal.string(), 0, 0,
                   fmt::format("scaled by {:g} the record has accelerations above {:g} m/s2.", factor, largest_accel),
                   fmt::format("at most {:g} m/s2 after --scale, motion.scale and motion.record.scale", largest_accel),
                   "lessen the factors; 0.1 to 10 is usual"});
}

} // namespace

std::vector<RecordPair> read_records(const Scene& scene, const EffectPlan& plan)
{
    std::vector<RecordPair> pairs;
    std::vector<Diagnostic> wrong;
    for (const RecordFiles& files : scene.motion.records) {
        records::ReadOptions options;
        options.unit = files.unit;
        options.dt = files.dt;
        options.column = files.column;
        try {
            RecordPair pair{files, records::read_record(files.horizontal, options), std::nullopt};
            options.column = files.vertical_column;
            if (files.vertical && plan.on(Effect::vertical_motion))
                pair.vertical = records::read_record(*files.vertical, options);
            pairs.push_back(std::move(pair));
        } catch (const InputError& error) { // go on, so that all bad files are reported at once
            wrong.insert(wrong.end(), error.diagnostics().begin(), error.diagnostics().end());
        }
    }
    if (!wrong.empty()) throw InputError(wrong);
    return pairs;
}

GroundMotion ground_motion(const Scene& scene, const RecordPair& pair, double scale, int polarity)
{
    records::MotionOptions options;
    options.scale = scene.motion.scale * pair.files.scale * scale;
    options.scale_to_pga = scene.motion.scale_to_pga;
    options.polarity = scene.motion.polarity.value_or(1) * polarity;
    if (!std::isfinite(options.scale)) refuse_scale(pair, options.scale);
    GroundMotion motion = records::make_ground_motion(pair.horizontal, pair.vertical, options);
    motion.name = pair.files.name;
    for (const auto* component : {&motion.accel_h, &motion.accel_v})
        if (!std::all_of(component->begin(), component->end(), [](double a) { return std::abs(a) <= largest_accel; }))
            refuse_scale(pair, options.scale);
    return motion;
}

} // namespace damslip
