#include "records/transform/transform.hpp"

#include "core/input_error.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

double peak(const std::vector<double>& accel)
{
    double largest = 0.0;
    for (const double a : accel) largest = std::max(largest, std::abs(a));
    return largest;
}

[[noreturn]] void fail(const Record& record, std::string problem, std::string expected, std::string fix)
{
    throw InputError(Diagnostic{record.source.file, 0, 0, std::move(problem), std::move(expected), std::move(fix)});
}

} // namespace

Record scaled(Record record, double factor)
{
    assert(std::isfinite(factor));
    for (double& a : record.acceleration) a *= factor;
    return record;
}

double factor_to_pga(const Record& record, double pga)
{
    assert(pga > 0.0);
    const double now = peak(record.acceleration);
    if (now == 0.0)
        fail(record,
             fmt::format("the record \"{}\" is zero throughout: it cannot be scaled to a PGA of {} m/s2.", record.name,
                         pga),
             "a record with a peak above zero", "leave the scaling out or name another record");
    return pga / now;
}

Record scaled_to_pga(const Record& record, double pga)
{
    return scaled(record, factor_to_pga(record, pga));
}

Record subdivided(const Record& record, int parts)
{
    assert(parts >= 1 && record.acceleration.size() >= 2);
    const auto& old = record.acceleration;
    if ((old.size() - 1) > (max_samples - 1) / static_cast<std::size_t>(parts))
        fail(record, fmt::format("{} samples in {} parts each are more than {}.", old.size(), parts, max_samples),
             fmt::format("at most {} samples", max_samples), "take a longer time step");
    Record out = record;
    out.dt = record.dt / parts;
    out.acceleration.resize((old.size() - 1) * static_cast<std::size_t>(parts) + 1);
    std::size_t at = 0;
    for (std::size_t k = 0; k + 1 < old.size(); ++k)
        for (int j = 0; j < parts; ++j)
            out.acceleration[at++] = old[k] + (old[k + 1] - old[k]) * (static_cast<double>(j) / parts);
    out.acceleration[at] = old.back();
    return out;
}

Record resampled(const Record& record, double dt)
{
    assert(dt > 0.0 && record.acceleration.size() >= 2);
    const auto& old = record.acceleration;
    const double intervals = std::floor(record.duration() / dt * (1.0 + 1e-12));
    if (intervals < 1.0 || intervals > static_cast<double>(max_samples - 1))
        fail(record,
             fmt::format("a time step of {} s makes {} samples of the {} s of this record.", dt, intervals + 1.0,
                         record.duration()),
             fmt::format("2 to {} samples", max_samples), "choose another time step");
    const double parts = std::round(record.dt / dt);
    if (parts >= 1.0 && parts < 1e6 && std::abs(parts * dt - record.dt) <= 1e-9 * record.dt) {
        Record out = subdivided(record, static_cast<int>(parts));
        out.dt = dt;
        return out;
    }
    Record out = record;
    out.dt = dt;
    out.acceleration.clear();
    for (std::size_t k = 0; k <= static_cast<std::size_t>(intervals); ++k) {
        const double position = static_cast<double>(k) * dt / record.dt;
        const std::size_t left = std::min(static_cast<std::size_t>(position), old.size() - 2);
        const double x = std::min(position - static_cast<double>(left), 1.0);
        out.acceleration.push_back(old[left] + x * (old[left + 1] - old[left]));
    }
    out.warnings.push_back(
        fmt::format("resampled from dt = {} s to {} s by linear interpolation: PGA {:.4g} m/s2 became {:.4g} m/s2",
                    record.dt, dt, peak(old), peak(out.acceleration)));
    return out;
}

} // namespace damslip::records
