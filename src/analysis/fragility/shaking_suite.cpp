#include "analysis/fragility/shaking_suite.hpp"

#include "analysis/prepare/flexible_mass.hpp"
#include "analysis/prepare/record_list.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "records/measure/measures.hpp"
#include "records/read/header.hpp"
#include "records/read/read_record.hpp"
#include "records/transform/transform.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace damslip {

ShakingSuite suite_of_input(const Scene& scene, const FragilityInput& input)
{
    Scene of = scene;
    RecordList files;
    std::filesystem::path index; // of the scene's own records none: few, and a folder may hold others
    if (input.suite && !input.suite->files.empty()) {
        files = record_list(input.suite->files);
        index = files.folder;
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
    records::SuiteIndex kept(index);
    ShakingSuite suite = measured_suite(of, load_records(of, Method::rigid_block), input.intensity, kept,
                                        std::move(files.events), std::move(files.weights));
    suite.notes.insert(suite.notes.begin(), files.notes.begin(), files.notes.end());
    suite.made = files.made;
    kept.keep();
    return suite;
}

double intensity_of(const Record& horizontal, const IntensityInput& intensity, double first_period,
                    records::SuiteIndex& index)
{
    const auto spectral = [&](std::span<const double> periods) {
        double sum = 0.0;
        for (const double value : index.spectrum(horizontal, periods)) sum += std::log(value);
        return std::exp(sum / static_cast<double>(periods.size()));
    };
    switch (intensity.measure) {
    case IntensityMeasure::sa:
        if (intensity.first_period) return spectral({&first_period, 1});
        return spectral(intensity.periods);
    case IntensityMeasure::avg_sa:
        return spectral(intensity.periods);
    case IntensityMeasure::pga:
        return index.measures(horizontal).pga;
    case IntensityMeasure::pgv:
        return index.measures(horizontal).pgv;
    case IntensityMeasure::arias:
        return index.measures(horizontal).arias_intensity;
    case IntensityMeasure::cav:
        break;
    }
    return index.measures(horizontal).cumulative_velocity;
}

double first_period_of(const Scene& scene)
{
    Scene with_modes = scene;
    with_modes.flexible_block.emplace();
    with_modes.flexible_block->of_modes = true;
    resolve_flexible_modes(with_modes);
    return with_modes.flexible_block->period.value();
}

namespace {

Record horizontal_of(const GroundMotion& motion)
{
    Record record;
    record.name = motion.name;
    record.dt = motion.dt;
    record.acceleration = motion.accel_h;
    return record;
}

/// The other horizontal component with the factor that the first one has.
Record other_horizontal(const RecordPair& pair, const Record& first)
{
    records::ReadOptions options;
    options.unit = pair.files.unit;
    options.dt = pair.files.dt;
    if (*pair.files.other_horizontal ==
        pair.files.horizontal) // of one file: the horizontal channel that is not the first
        for (const Record& channel :
             records::parse_record(read_file(pair.files.horizontal), pair.files.horizontal.string(), options))
            if (records::component_in(channel.source.component) == records::Component::horizontal &&
                channel.source.component != pair.horizontal.source.component)
                options.column = channel.source.component;
    const Record other = records::read_record(*pair.files.other_horizontal, options);
    const double read = records::measure(pair.horizontal).pga;
    return records::scaled(other, read > 0.0 ? records::measure(first).pga / read : 1.0);
}

} // namespace

ShakingSuite measured_suite(const Scene& scene, Records pairs, const IntensityInput& intensity,
                            records::SuiteIndex& index, std::vector<std::string> event, std::vector<double> weight)
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
    const bool both = intensity.component == IntensityComponent::geomean;
    std::size_t alone = 0;
    for (const RecordPair& pair : *suite.pairs) {
        const std::string& name = pair.files.name;
        if (!events) suite.event.push_back(name);
        if (!weights) suite.weight.push_back(1.0);
        const Record horizontal = horizontal_of(ready.motion(pair));
        suite.intensity.push_back(intensity_of(horizontal, intensity, period, index));
        if (both && pair.files.other_horizontal)
            suite.intensity.back() = std::sqrt(
                suite.intensity.back() * intensity_of(other_horizontal(pair, horizontal), intensity, period, index));
        else if (both)
            ++alone;
        if (!(suite.intensity.back() > 0.0))
            throw InputError(Diagnostic{pair.files.horizontal.string(), 0, 0,
                                        fmt::format("{} of this record is 0.", intensity.text), "a record that shakes",
                                        "leave it out"});
        const std::string& sum = pair.horizontal.source.sha256;
        if (const auto [at, fresh] = seen.emplace(sum + " " + pair.files.column, name); !sum.empty() && !fresh)
            throw InputError(Diagnostic{pair.files.horizontal.string(), 0, 0,
                                        fmt::format("the records \"{}\" and \"{}\" are the same.", at->second, name),
                                        "each record once; how often one is met is its weight", "leave one out"});
    }
    if (both)
        suite.notes.push_back(fmt::format(
            "{} is the geometric mean of both horizontal components{}.", intensity.text,
            alone == 0 ? ""
                       : fmt::format("; of {} of {} records that of the one there is", alone, suite.pairs->size())));
    return suite;
}

} // namespace damslip
