#include "records/transform/transform.hpp"

#include "core/input_error.hpp"

#include <algorithm>
#include <array>
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

namespace {

using Samples = std::vector<double>;

/// Velocity at the samples, starting from rest, in units of dt.
Samples integral(const Samples& accel)
{
    Samples v(accel.size(), 0.0);
    for (std::size_t k = 1; k < accel.size(); ++k) v[k] = v[k - 1] + 0.5 * (accel[k - 1] + accel[k]);
    return v;
}

double dot(const Samples& a, const Samples& b)
{
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
}

/// Legendre polynomial of degree p on x in 0 ... 1, well conditioned as a basis, and its coefficients of 1, x, x^2.
constexpr std::array<std::array<double, 3>, 3> legendre{{{1.0, 0.0, 0.0}, {-1.0, 2.0, 0.0}, {1.0, -6.0, 6.0}}};

Samples basis_samples(std::size_t degree, std::size_t n)
{
    Samples f(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double x = static_cast<double>(k) / static_cast<double>(n - 1);
        f[k] = legendre[degree][0] + x * (legendre[degree][1] + x * legendre[degree][2]);
    }
    return f;
}

/// Least squares by Gram-Schmidt, twice: coefficients b of the columns so that |target - sum b_p column_p| is smallest.
std::vector<double> least_squares(const std::vector<Samples>& columns, Samples target)
{
    std::vector<Samples> q = columns;
    std::vector<std::vector<double>> r(columns.size(), std::vector<double>(columns.size(), 0.0));
    std::vector<double> b(columns.size(), 0.0);
    for (std::size_t j = 0; j < q.size(); ++j) {
        for (int pass = 0; pass < 2; ++pass)
            for (std::size_t i = 0; i < j; ++i) {
                const double share = dot(q[i], q[j]);
                r[i][j] += share;
                for (std::size_t k = 0; k < target.size(); ++k) q[j][k] -= share * q[i][k];
            }
        r[j][j] = std::sqrt(dot(q[j], q[j]));
        for (double& value : q[j]) value /= r[j][j];
        b[j] = dot(q[j], target);
        for (std::size_t k = 0; k < target.size(); ++k) target[k] -= b[j] * q[j][k];
    }
    for (std::size_t j = q.size(); j-- > 0;) {
        for (std::size_t i = j + 1; i < q.size(); ++i) b[j] -= r[j][i] * b[i];
        b[j] /= r[j][j];
    }
    return b;
}

} // namespace

BaselineResult baseline_corrected(const Record& record, const BaselineOptions& options)
{
    const std::size_t n = record.acceleration.size();
    if (n < 4)
        throw InputError(
            Diagnostic{record.source.file, 0, 0,
                       fmt::format("the record \"{}\" has {} samples: too few to fit a baseline.", record.name, n),
                       "at least 4 samples", "use the record as it is"});
    const auto degree = static_cast<std::size_t>(options.degree);
    const bool by_velocity = options.fit == BaselineFit::velocity;
    std::vector<Samples> shapes, columns;
    for (std::size_t p = 0; p <= degree; ++p) {
        shapes.push_back(basis_samples(p, n));
        columns.push_back(by_velocity ? integral(shapes.back()) : shapes.back());
    }
    const std::vector<double> b =
        least_squares(columns, by_velocity ? integral(record.acceleration) : record.acceleration);

    BaselineResult result{record, std::vector<double>(degree + 1, 0.0)};
    for (std::size_t p = 0; p <= degree; ++p) {
        for (std::size_t k = 0; k < n; ++k) result.record.acceleration[k] -= b[p] * shapes[p][k];
        for (std::size_t c = 0; c <= p; ++c) result.coefficients[c] += b[p] * legendre[p][c];
    }
    return result;
}

namespace {

void flip_and_scale(Record& h, std::optional<Record>& v, const MotionOptions& options)
{
    const double factor = options.scale * (options.scale_to_pga ? factor_to_pga(h, *options.scale_to_pga) : 1.0);
    h = scaled(std::move(h), factor * options.polarity);
    if (v) v = scaled(std::move(*v), factor);
}

/// Brings both records to one time step.
void share_grid(Record& h, Record& v, std::vector<std::string>& notes)
{
    constexpr int most_parts = 16;
    constexpr double same = 1e-9; // relative; steps of text files carry fewer digits
    for (int m = 1; m <= most_parts; ++m) {
        const double n = std::round(m * v.dt / h.dt);
        if (n < 1.0 || n > most_parts || std::abs(n * h.dt - m * v.dt) > same * m * v.dt) continue;
        const double dt_h = h.dt, dt_v = v.dt;
        if (m > 1) h = subdivided(h, m);
        if (n > 1.0) v = subdivided(v, static_cast<int>(n));
        v.dt = h.dt;
        if (m > 1 || n > 1.0)
            notes.push_back(fmt::format("horizontal dt = {} s and vertical dt = {} s subdivided to {} s (same motion)",
                                        dt_h, dt_v, h.dt));
        return;
    }
    const bool horizontal_is_coarse = h.dt > v.dt;
    Record& coarse = horizontal_is_coarse ? h : v;
    const double dt = std::min(h.dt, v.dt);
    const std::size_t before = coarse.warnings.size();
    coarse = resampled(coarse, dt);
    for (std::size_t k = before; k < coarse.warnings.size(); ++k)
        notes.push_back(
            fmt::format("{} component {}", horizontal_is_coarse ? "horizontal" : "vertical", coarse.warnings[k]));
}

/// Zeros at the end of the shorter component.
void pad(std::vector<double>& accel, std::size_t n, const char* component, std::vector<std::string>& notes)
{
    if (accel.size() >= n) return;
    notes.push_back(fmt::format("{} component filled up with {} zero samples to the length of the other", component,
                                n - accel.size()));
    if (accel.back() != 0.0) notes.back() += fmt::format(" (its last sample is {:.3g} m/s2)", accel.back());
    accel.resize(n, 0.0);
}

void start_at_zero(GroundMotion& motion)
{
    const double h0 = motion.accel_h.front(), v0 = motion.accel_v.empty() ? 0.0 : motion.accel_v.front();
    if (h0 == 0.0 && v0 == 0.0) return;
    motion.accel_h.insert(motion.accel_h.begin(), 0.0);
    if (!motion.accel_v.empty()) motion.accel_v.insert(motion.accel_v.begin(), 0.0);
    motion.notes.push_back(fmt::format("a zero sample was put {} s before the first, which is {:.3g} m/s2", motion.dt,
                                       h0 != 0.0 ? h0 : v0));
}

} // namespace

GroundMotion make_ground_motion(const Record& horizontal, const std::optional<Record>& vertical,
                                const MotionOptions& options)
{
    assert(options.polarity == 1 || options.polarity == -1);
    assert(std::isfinite(options.scale));
    Record h = horizontal;
    std::optional<Record> v = vertical;
    GroundMotion motion;
    motion.name = h.name;
    flip_and_scale(h, v, options);
    if (v) share_grid(h, *v, motion.notes);
    motion.dt = h.dt;
    motion.accel_h = std::move(h.acceleration);
    if (v) {
        motion.accel_v = std::move(v->acceleration);
        const std::size_t n = std::max(motion.accel_h.size(), motion.accel_v.size());
        pad(motion.accel_h, n, "horizontal", motion.notes);
        pad(motion.accel_v, n, "vertical", motion.notes);
    }
    start_at_zero(motion);
    return motion;
}

namespace {

constexpr int most_parts = 16;
constexpr double same = 1e-9; ///< relative; steps of text files carry fewer digits

/// The step that both are whole multiples of; 0: none.
double common_part(double a, double b)
{
    for (int m = 1; m <= most_parts; ++m) {
        const double n = std::round(m * b / a);
        if (n >= 1.0 && n <= most_parts && std::abs(n * a - m * b) <= same * m * b) return a / m;
    }
    return 0.0;
}

double common_step(const std::vector<GroundMotion>& motions, bool& exact)
{
    double step = motions.front().dt, finest = step;
    exact = true;
    for (const GroundMotion& motion : motions) {
        finest = std::min(finest, motion.dt);
        if (exact) step = common_part(step, motion.dt);
        exact = exact && step > 0.0;
    }
    return exact ? step : finest;
}

/// Linear between the samples, which every whole part of a step keeps.
std::vector<double> at_step(const std::vector<double>& accel, double dt, double step)
{
    const double parts = std::round(dt / step);
    if (parts == 1.0 && std::abs(dt - step) <= same * dt) return accel;
    const bool whole = std::abs(dt - parts * step) <= same * dt;
    const auto last = static_cast<double>(accel.size() - 1);
    const auto count = static_cast<std::size_t>(whole ? parts * last : std::floor(last * dt / step * (1.0 + same)));
    std::vector<double> result;
    for (std::size_t i = 0; i <= count; ++i) {
        const double place = std::min(last, static_cast<double>(i) * (whole ? 1.0 / parts : step / dt));
        const auto k = std::min(static_cast<std::size_t>(place), accel.size() - 2);
        const double share = place - static_cast<double>(k);
        result.push_back(accel[k] + share * (accel[k + 1] - accel[k]));
    }
    return result;
}

} // namespace

GroundMotion one_after_the_other(const std::vector<GroundMotion>& motions, double pause)
{
    bool exact = true;
    const bool vertical =
        std::any_of(motions.begin(), motions.end(), [](const GroundMotion& m) { return !m.accel_v.empty(); });
    GroundMotion all;
    all.dt = common_step(motions, exact);
    all.pause = pause;
    for (const GroundMotion& motion : motions) {
        all.events.push_back({motion.name, all.accel_h.size()});
        for (const std::string& note : motion.notes) all.notes.push_back(motion.name + ": " + note);
        if (!exact && motion.dt != all.dt)
            all.notes.push_back(fmt::format("{}: dt = {} s interpolated at {} s, the finest of the sequence",
                                            motion.name, motion.dt, all.dt));
        const std::vector<double> h = at_step(motion.accel_h, motion.dt, all.dt);
        all.accel_h.insert(all.accel_h.end(), h.begin(), h.end());
        if (!vertical) continue;
        const std::vector<double> v =
            motion.accel_v.empty() ? std::vector<double>(h.size(), 0.0) : at_step(motion.accel_v, motion.dt, all.dt);
        all.accel_v.insert(all.accel_v.end(), v.begin(), v.end());
    }
    return all;
}

GroundMotion as_played(const GroundMotion& sequence, const std::vector<double>& starts)
{
    if (!sequence.is_sequence()) return sequence;
    GroundMotion played = sequence;
    played.events.clear();
    for (auto component : {&GroundMotion::accel_h, &GroundMotion::accel_v}) {
        const std::vector<double>& samples = sequence.*component;
        std::vector<double>& out = played.*component;
        out.clear();
        if (samples.empty()) continue;
        for (std::size_t e = 0; e < std::min(starts.size(), sequence.events.size()); ++e) {
            const auto first = static_cast<std::size_t>(std::llround(starts[e] / sequence.dt));
            out.resize(std::max(out.size(), first), 0.0);
            const auto from = samples.begin() + static_cast<std::ptrdiff_t>(sequence.events[e].first);
            out.insert(out.end(), from, samples.begin() + static_cast<std::ptrdiff_t>(sequence.last_of(e)) + 1);
        }
    }
    return played;
}

} // namespace damslip::records
