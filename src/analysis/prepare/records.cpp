#include "analysis/prepare/records.hpp"

#include "core/input_error.hpp"
#include "core/units.hpp"
#include "records/read/header.hpp"
#include "records/read/read_record.hpp"
#include "records/transform/transform.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace damslip {

namespace {

constexpr double largest_accel = 1e4; ///< [m/s2], a thousand times gravity

[[noreturn]] void refuse_scale(const RecordPair& pair, double factor)
{
    refuse(pair.files.horizontal,
           fmt::format("scaled by {:g} the record has accelerations above {:g} m/s2.", factor, largest_accel),
           fmt::format("at most {:g} m/s2 after --scale, motion.scale and motion.record.scale", largest_accel),
           "lessen the factors; 0.1 to 10 is usual");
}

bool in_sequence(const Scene& scene, const std::string& name)
{
    const std::vector<std::string>& names = scene.motion.sequence;
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The sequence, then the records that it does not name.
std::vector<RecordPair> with_sequence(const Scene& scene, std::vector<RecordPair> pairs)
{
    if (scene.motion.sequence.empty()) return pairs;
    RecordPair sequence;
    for (const std::string& name : scene.motion.sequence) {
        const auto found =
            std::find_if(pairs.begin(), pairs.end(), [&](const RecordPair& pair) { return pair.files.name == name; });
        if (found == pairs.end()) continue; // check_sequence() names it
        sequence.files.name += (sequence.parts.empty() ? "" : ", then ") + name;
        sequence.parts.push_back(*found);
    }
    if (sequence.parts.empty()) return pairs;
    const std::string name = sequence.files.name;
    sequence.files = sequence.parts.front().files;
    sequence.files.name = name;
    sequence.files.magnitude.reset(); // of one earthquake
    sequence.horizontal = sequence.parts.front().horizontal;
    for (const RecordPair& part : sequence.parts)
        if (part.vertical && !sequence.vertical) sequence.vertical = part.vertical;
    std::vector<RecordPair> all{std::move(sequence)};
    for (RecordPair& pair : pairs)
        if (!in_sequence(scene, pair.files.name)) all.push_back(std::move(pair));
    return all;
}

GroundMotion ground_motion_of_one(const RecordPair& pair, const records::MotionOptions& options)
{
    if (!std::isfinite(options.scale)) refuse_scale(pair, options.scale);
    GroundMotion motion = records::make_ground_motion(pair.horizontal, pair.vertical, options);
    motion.name = pair.files.name;
    for (const auto* component : {&motion.accel_h, &motion.accel_v})
        if (!std::all_of(component->begin(), component->end(), [](double a) { return std::abs(a) <= largest_accel; }))
            refuse_scale(pair, options.scale);
    return motion;
}

/// By how much the largest peak of all parts, each with its own scale, is to be changed.
double factor_to_peak(const RecordPair& sequence, double wanted)
{
    double peak = 0.0;
    for (const RecordPair& part : sequence.parts)
        for (const double a : part.horizontal.acceleration) peak = std::max(peak, std::abs(part.files.scale * a));
    if (peak > 0.0) return wanted / peak;
    refuse(sequence.files.horizontal,
           fmt::format("motion.scale_to_pga = {:g} m/s2, but all records of the sequence are zero.", wanted),
           "a horizontal record that is not zero", "delete scale_to_pga, or check the files");
}

} // namespace

std::size_t motion_count(const Scene& scene)
{
    const std::vector<RecordFiles>& all = scene.motion.records;
    const auto alone = static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [&](const RecordFiles& record) { return !in_sequence(scene, record.name); }));
    return alone + (scene.motion.sequence.empty() ? 0 : 1);
}

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
    return with_sequence(scene, std::move(pairs));
}

std::vector<std::string> component_remarks(const RecordPair& pair)
{
    using records::Component;
    std::vector<std::string> remarks;
    for (const RecordPair& part : pair.parts)
        for (std::string& remark : component_remarks(part)) remarks.push_back(std::move(remark));
    if (!pair.parts.empty()) return remarks;
    const auto look_at = [&](const Record& record, Component against, const char* by_header, const char* taken) {
        if (records::component_in(record.source.component) == against)
            remarks.push_back(fmt::format("{}: {} by its header ({}), taken as {}.", record.source.file, by_header,
                                          record.source.component, taken));
    };
    look_at(pair.horizontal, Component::vertical, "vertical", "horizontal");
    if (pair.vertical) look_at(*pair.vertical, Component::horizontal, "horizontal", "vertical");
    return remarks;
}

std::vector<std::string> scaled_peak_remarks(const Scene& scene)
{
    const Motion& motion = scene.motion;
    std::vector<std::string> remarks;
    if (!motion.scale_to_pga) return remarks;
    std::map<double, std::vector<std::string>> names_of_factor;
    if (!motion.sequence.empty()) names_of_factor[motion.scale].push_back("the sequence");
    for (const RecordFiles& record : motion.records)
        if (!in_sequence(scene, record.name))
            names_of_factor[motion.scale * record.scale].push_back("\"" + record.name + "\"");
    for (const auto& [factor, names] : names_of_factor) {
        if (factor == 1.0) continue;
        const double pga = *motion.scale_to_pga * factor;
        const std::string others = names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : "";
        remarks.push_back(
            fmt::format("motion.scale_to_pga = {:.4g} m/s2 is followed by a factor of {:.4g} (motion.scale, "
                        "motion.record.scale, --scale): the PGA of {}{} is {:.4g} m/s2 ({:.4g} g).",
                        *motion.scale_to_pga, factor, names.front(), others, pga, pga / units::standard_gravity));
    }
    return remarks;
}

std::vector<int> polarities_of(const Scene& scene, std::optional<int> asked)
{
    if (!asked) asked = scene.motion.polarity;
    if (asked) return {*asked};
    return {1, -1};
}

std::string polarity_words(const std::vector<int>& polarities)
{
    return polarities.size() > 1 ? "both polarities" : fmt::format("polarity {:+d} alone", polarities.front());
}

std::string MotionName::label() const
{
    return both ? fmt::format("{}, polarity {:+d}", record, polarity) : record;
}

std::string MotionName::suffix() const
{
    return both ? fmt::format("_{:+d}", polarity) : "";
}

std::vector<MotionName> motion_names(const Scene& scene, const std::vector<RecordPair>& records,
                                     std::optional<int> asked)
{
    const std::vector<int> polarities = polarities_of(scene, asked);
    std::vector<MotionName> names;
    for (const RecordPair& pair : records)
        for (const int polarity : polarities) names.push_back({pair.files.name, polarity, polarities.size() > 1});
    return names;
}

GroundMotion ground_motion(const Scene& scene, const RecordPair& pair, double scale, int polarity)
{
    records::MotionOptions options;
    options.polarity = polarity;
    options.scale = scene.motion.scale * scale;
    if (pair.parts.empty()) {
        options.scale = scene.motion.scale * pair.files.scale * scale;
        options.scale_to_pga = scene.motion.scale_to_pga;
        return ground_motion_of_one(pair, options);
    }
    if (scene.motion.scale_to_pga) options.scale *= factor_to_peak(pair, *scene.motion.scale_to_pga);
    std::vector<GroundMotion> motions;
    for (const RecordPair& part : pair.parts) {
        records::MotionOptions own = options;
        own.scale *= part.files.scale;
        motions.push_back(ground_motion_of_one(part, own));
    }
    GroundMotion sequence = records::one_after_the_other(motions, scene.motion.sequence_pause);
    sequence.name = pair.files.name;
    return sequence;
}

double peak_of(std::span<const double> samples)
{
    double peak = 0.0;
    for (const double a : samples) peak = std::max(peak, std::abs(a));
    return peak;
}

} // namespace damslip
