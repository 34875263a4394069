#include "records/generate/generate.hpp"

#include "core/input_error.hpp"
#include "records/measure/response_spectrum.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

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

namespace {

struct EndState {
    double velocity = 0.0;     ///< in units of dt
    double displacement = 0.0; ///< in units of dt^2
};

EndState end_state(const std::vector<double>& accel)
{
    EndState s;
    for (std::size_t k = 1; k < accel.size(); ++k) {
        s.displacement += s.velocity + accel[k - 1] / 3.0 + accel[k] / 6.0;
        s.velocity += 0.5 * (accel[k - 1] + accel[k]);
    }
    return s;
}

std::size_t largest(const std::vector<double>& accel)
{
    return static_cast<std::size_t>(
        std::max_element(accel.begin(), accel.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
        accel.begin());
}

} // namespace

void end_at_rest(std::vector<double>& accel)
{
    const std::size_t n = accel.size();
    std::vector<double> bump(n), slope(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double x = static_cast<double>(k) / static_cast<double>(n - 1), s = std::sin(std::numbers::pi * x);
        bump[k] = s * s;
        slope[k] = x * bump[k];
    }
    const EndState a = end_state(bump), b = end_state(slope), now = end_state(accel);
    const double determinant = a.velocity * b.displacement - b.velocity * a.displacement;
    const double c0 = (now.velocity * b.displacement - b.velocity * now.displacement) / determinant;
    const double c1 = (a.velocity * now.displacement - now.velocity * a.displacement) / determinant;
    for (std::size_t k = 1; k + 1 < n; ++k) accel[k] -= c0 * bump[k] + c1 * slope[k];
}

void set_peak(std::vector<double>& accel, double pga)
{
    const auto move_to = [&](std::size_t k, double value) {
        const double d = value - accel[k];
        accel[k] = value;
        accel[k - 1] -= 0.5 * d;
        accel[k + 1] -= 0.5 * d;
    };
    const auto top = [&] { return std::clamp<std::size_t>(largest(accel), 2, accel.size() - 3); };
    if (const std::size_t k = top(); std::abs(accel[k]) < pga) move_to(k, std::copysign(pga, accel[k]));
    bool changed = true;
    for (int pass = 0; pass < 100 && changed; ++pass) {
        changed = false;
        for (std::size_t k = 2; k + 2 < accel.size(); ++k)
            if (std::abs(accel[k]) > pga) move_to(k, std::copysign(pga, accel[k])), changed = true;
    }
    // What the cuts left above or below, a common factor sets right; it too keeps an end at rest.
    const std::size_t k = largest(accel);
    const double factor = pga / std::abs(accel[k]);
    for (double& a : accel) a *= factor;
    accel[k] = std::copysign(pga, accel[k]);
}

void round_samples(std::vector<double>& accel, double pga)
{
    const std::size_t peak = largest(accel);
    for (std::size_t k = 0; k < accel.size(); ++k) {
        if (k == peak) continue;
        const double up = std::nearbyint(accel[k] * 1e6);
        const double millionths = std::abs(up / 1e6) > pga ? std::trunc(accel[k] * 1e6) : up;
        accel[k] = millionths / 1e6 + 0.0; // + 0.0: no negative zeros
    }
}

std::vector<double> envelope_samples(const Envelope& envelope, std::size_t n)
{
    assert(envelope.rise > 0.0 && envelope.level >= envelope.rise && envelope.level < 1.0 && n >= 2);
    constexpr double end_value = 0.05, taper = 0.025;
    const bool compound = envelope.shape == EnvelopeShape::compound;
    std::vector<double> values(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double x = static_cast<double>(k) / static_cast<double>(n - 1);
        double value = 1.0;
        if (x < envelope.rise) value = compound ? (x / envelope.rise) * (x / envelope.rise) : x / envelope.rise;
        if (x > envelope.level) {
            const double part = (x - envelope.level) / (1.0 - envelope.level);
            value = compound ? std::pow(end_value, part) : 1.0 - part;
        }
        if (x > 1.0 - taper) value *= 0.5 * (1.0 + std::cos(std::numbers::pi * (x - 1.0 + taper) / taper));
        values[k] = value;
    }
    values.back() = 0.0;
    return values;
}

} // namespace damslip::records
