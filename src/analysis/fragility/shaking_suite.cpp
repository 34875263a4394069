#include "analysis/fragility/shaking_suite.hpp"

#include "analysis/prepare/flexible_mass.hpp"
#include "analysis/prepare/record_list.hpp"
#include "core/input_error.hpp"
#include "records/measure/measures.hpp"
#include "records/measure/response_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace damslip {

ShakingSuite suite_of_input(const Scene& scene, const FragilityInput& input)
{
    Scene of = scene;
    RecordList files;
    if (input.suite && !input.suite->files.empty()) {
        files = record_list(input.suite->files);
        of.motion.records = files.records;
        of.motion.sequence.clear();
    }
    if (of.motion.records.empty())
        throw InputError(Diagnostic{scene.file.string(), static_cast<int>(input.suite ? input.suite->where.line : 0), 0,
                                    input.suite && !input.suite->files.empty()
                                        ? fmt::format("suite.files = \"{}\" names no record.", input.suite->files)
                                        : std::string("there is no record."),
                                    "a folder, a pattern or a list of records that are there, or [[motion.record]]",
                                    "make or fetch the records first, or correct the path:  files = \"suite/*.AT2\""});
    return measured_suite(of, load_records(of, Method::rigid_block), input.intensity, std::move(files.events),
                          std::move(files.weights));
}

double intensity_of(const GroundMotion& motion, const IntensityInput& intensity, double first_period)
{
    Record horizontal;
    horizontal.dt = motion.dt;
    horizontal.acceleration = motion.accel_h;
    const auto spectral = [&](std::span<const double> periods) {
        double sum = 0.0;
        const records::ResponseSpectrum spectrum = records::response_spectrum(motion.accel_h, motion.dt, periods, 0.05);
        for (const records::SpectrumPoint& point : spectrum.points) sum += std::log(point.pseudo_acceleration);
        return std::exp(sum / static_cast<double>(periods.size()));
    };
    switch (intensity.measure) {
    case IntensityMeasure::sa:
        if (intensity.first_period) return spectral({&first_period, 1});
        return spectral(intensity.periods);
    case IntensityMeasure::avg_sa:
        return spectral(intensity.periods);
    case IntensityMeasure::pga:
        return records::measure(horizontal).pga;
    case IntensityMeasure::pgv:
        return records::measure(horizontal).pgv;
    case IntensityMeasure::arias:
        return records::measure(horizontal).arias_intensity;
    case IntensityMeasure::cav:
        break;
    }
    return records::measure(horizontal).cumulative_velocity;
}

double first_period_of(const Scene& scene)
{
    Scene with_modes = scene;
    with_modes.flexible_block.emplace();
    with_modes.flexible_block->of_modes = true;
    resolve_flexible_modes(with_modes);
    return with_modes.flexible_block->period.value();
}

ShakingSuite measured_suite(const Scene& scene, Records pairs, const IntensityInput& intensity,
                            std::vector<std::string> event, std::vector<double> weight)
{
    ShakingSuite suite;
    suite.pairs = std::move(pairs);
    suite.event = std::move(event);
    suite.weight = std::move(weight);
    suite.power = power_of_scale(intensity.measure);
    const Ready ready = prepare(scene, Method::rigid_block, suite.pairs);
    const double period = intensity.first_period ? first_period_of(scene) : 0.0;
    std::map<std::string, std::string> seen; // checksum to name
    const bool events = !suite.event.empty(), weights = !suite.weight.empty();
    for (const RecordPair& pair : *suite.pairs) {
        const std::string& name = pair.files.name;
        if (!events) suite.event.push_back(name);
        if (!weights) suite.weight.push_back(1.0);
        suite.intensity.push_back(intensity_of(ready.motion(pair), intensity, period));
        if (!(suite.intensity.back() > 0.0))
            throw InputError(Diagnostic{pair.files.horizontal.string(), 0, 0,
                                        fmt::format("{} of this record is 0.", intensity.text), "a record that shakes",
                                        "leave it out"});
        const std::string& sum = pair.horizontal.source.sha256;
        if (const auto [at, fresh] = seen.emplace(sum, name); !sum.empty() && !fresh)
            throw InputError(Diagnostic{pair.files.horizontal.string(), 0, 0,
                                        fmt::format("the records \"{}\" and \"{}\" are the same.", at->second, name),
                                        "each record once; how often one is met is its weight", "leave one out"});
    }
    return suite;
}

} // namespace damslip
