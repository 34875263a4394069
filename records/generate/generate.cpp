#include "records/generate/generate.hpp"

#include "core/input_error.hpp"
#include "records/generate/finish.hpp"
#include "records/generate/stages.hpp"
#include "records/measure/response_spectrum.hpp"

#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

constexpr int most_passes = 60;
constexpr int patience = 10; // passes without a better one, once within the tolerance

void check(const GenerateOptions& o)
{
    std::vector<Diagnostic> wrong;
    const auto in_range = [&](const char* name, double value, double low, double high, const char* unit) {
        if (!(value >= low && value <= high))
            wrong.push_back({"", 0, 0, fmt::format("record generate: {} = {} is not allowed.", name, value),
                             fmt::format("{} to {} {}", low, high, unit), "correct it"});
    };
    in_range("pga", o.pga, 1e-3, 50.0, "m/s2");
    in_range("duration", o.duration, 5.0, 600.0, "s");
    in_range("dt", o.dt, 0.001, 0.01, "s");
    in_range("tolerance", o.tolerance, 0.01, 0.5, "");
    in_range("envelope rise", o.envelope.rise, 0.001, 0.999, "of the duration");
    in_range("envelope level", o.envelope.level, o.envelope.rise, 0.999, "of the duration");
    if (wrong.empty() && std::abs(std::round(o.duration / o.dt) * o.dt - o.duration) > 1e-9 * o.duration)
        wrong.push_back(
            {"", 0, 0,
             fmt::format("record generate: duration = {} s is no whole number of dt = {} s.", o.duration, o.dt),
             "a multiple of dt", "change either"});
    if (!wrong.empty()) throw InputError(std::move(wrong));
}

std::vector<double> finished(std::vector<double> accel, double pga)
{
    end_at_rest(accel);
    set_peak(accel, pga);
    round_samples(accel, pga);
    return accel;
}

Record described(std::vector<double> accel, const TargetSpectrum& target, const GenerateOptions& o)
{
    const bool horizontal = o.component == MotionComponent::horizontal;
    Record record{horizontal ? "generated_h" : "generated_v", o.dt, std::move(accel), {}, {}};
    record.source.format = "generated";
    record.source.unit = "m/s2";
    record.source.component = horizontal ? "h" : "v";
    record.source.title = fmt::format("artificial accelerogram; target {}; PGA {} m/s2; {} s; seed {}", target.name,
                                      o.pga, o.duration, o.seed);
    return record;
}

/// Deviations over the band: the largest, where, and a smooth measure of their size (mean of 8th powers) to steer by.
struct Deviations {
    SpectrumMatch worst;
    double norm = 0.0;
};

Deviations deviations(const std::vector<double>& accel, double dt, const TargetSpectrum& target, double pga)
{
    const std::vector<double> periods = logarithmic_periods(matched_from, matched_to, 200);
    Deviations d;
    for (const SpectrumPoint& point : response_spectrum(accel, dt, periods, 0.05).points) {
        const double deviation = std::abs(point.pseudo_acceleration / (pga * target.amplification(point.period)) - 1.0);
        if (!(deviation <= d.worst.deviation)) d.worst = {deviation, point.period};
        const double squared = deviation * deviation;
        d.norm += squared * squared * squared * squared;
    }
    return d;
}

/// The best pass.
struct Matched {
    std::vector<double> accel;
    SpectrumMatch match;
    int passes = 0;
};

/// Wavelet passes, bolder after a good one, more careful after a bad one, which is dropped (Levenberg-Marquardt). Where no step helps any
/// more, one is taken all the same to get away. What counts is the finished record: rounded, at rest, with its PGA.
Matched match(std::vector<double> accel, double dt, const TargetSpectrum& target, double pga, double tolerance)
{
    constexpr double start = 1e-4, boldest = 1e-7, too_careful = 0.1;
    const std::vector<double> periods = logarithmic_periods(0.9 * matched_from, 1.1 * matched_to, 100);
    Deviations now = deviations(accel, dt, target, pga);
    Matched best{accel, now.worst, 0};
    double regularisation = start;
    int since_best = 0;
    const auto good_enough = [&] {
        return best.match.deviation <= 0.5 * tolerance || (best.match.deviation <= tolerance && since_best >= patience);
    };
    for (; best.passes < most_passes && !good_enough(); ++best.passes, ++since_best) {
        std::vector<double> trial = accel;
        match_by_wavelets(trial, dt, target, pga, periods, regularisation);
        trial = finished(std::move(trial), pga);
        const Deviations then = deviations(trial, dt, target, pga);
        const bool better = then.norm<now.norm, stalled = regularisation> too_careful;
        if (better || stalled) accel = std::move(trial), now = then;
        if (now.worst.deviation < best.match.deviation) best.accel = accel, best.match = now.worst, since_best = 0;
        regularisation = better ? std::max(regularisation / 3.0, boldest) : stalled ? start : 4.0 * regularisation;
    }
    return best;
}

GeneratedRecord with_story(Record record, const Matched& m, double tolerance)
{
    GeneratedRecord result{std::move(record), m.match.deviation, m.match.period, m.passes,
                           m.match.deviation <= tolerance};
    if (!result.within_tolerance)
        result.record.warnings.push_back(
            fmt::format("the spectrum is {:.1f} % off its target at {:.3g} s, more than the {:.1f} % asked for",
                        100.0 * result.worst_deviation, result.worst_period, 100.0 * tolerance));
    return result;
}

} // namespace

SpectrumMatch spectrum_match(const std::vector<double>& accel, double dt, const TargetSpectrum& target, double pga)
{
    return deviations(accel, dt, target, pga).worst;
}

GeneratedRecord generate_record(const TargetSpectrum& target, const GenerateOptions& o)
{
    check(o);
    // random phases under the envelope, spectrum roughly right; then wavelets
    const auto n = static_cast<std::size_t>(std::lround(o.duration / o.dt)) + 1;
    const std::vector<double> envelope = envelope_samples(o.envelope, n);
    const std::uint64_t stream = o.component == MotionComponent::horizontal ? 0 : 1;
    Matched m = match(finished(random_phase_record(target, envelope, {o.dt, o.pga, o.seed, stream}), o.pga), o.dt,
                      target, o.pga, o.tolerance);
    return with_story(described(std::move(m.accel), target, o), m, o.tolerance);
}

GeneratedRecord matched_record(const Record& record, const TargetSpectrum& target, double pga, double tolerance)
{
    GenerateOptions o;
    o.pga = pga;
    o.tolerance = tolerance;
    check(o);
    const std::string& file = record.source.file;
    if (!(record.dt >= 0.001 && record.dt <= 0.01))
        throw InputError(Diagnostic{file, 0, 0, fmt::format("dt = {} s is not allowed for a match.", record.dt),
                                    "0.001 to 0.01 s: five samples at the shortest period matched",
                                    fmt::format("damslip record convert {} --new-dt 0.01 --out ...", file)});
    if (record.duration() < 5.0)
        throw InputError(Diagnostic{file, 0, 0,
                                    fmt::format("a record of {:.4g} s is too short for a match.", record.duration()),
                                    "5 s or more", "leave it out, or do not match"});
    Matched m = match(finished(record.acceleration, pga), record.dt, target, pga, tolerance);
    Record changed = record;
    changed.acceleration = std::move(m.accel);
    changed.source.title = fmt::format("{}{}matched by wavelets to {}, PGA {} m/s2", record.source.title,
                                       record.source.title.empty() ? "" : "; ", target.name, pga);
    return with_story(std::move(changed), m, tolerance);
}

} // namespace damslip::records
