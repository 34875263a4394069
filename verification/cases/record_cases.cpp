// Accelerograms: measures and spectra against closed solutions, and the shipped artificial records against their targets.
#include "records/generate/generate.hpp"
#include "records/measure/measures.hpp"
#include "records/transform/transform.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/oscillator.hpp"

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace records;
using std::numbers::pi;

// Triangle 0 -> A -> 0, each side t_d: integral of a^2 = 2 A^2 t_d/3; integral of |a| = A t_d = final velocity; displacement A t_d^2.
// Share s <= 1/2 of the integral of a^2 has arrived at t_d (2 s)^(1/3), share 1 - s at t_d (2 - (2 s)^(1/3)).
std::vector<Check> triangle()
{
    constexpr double A = 3.0, t_d = 0.5, round_off = 1e-14;
    const std::vector<double> a{0.0, A, 0.0};
    const Peaks peaks = motion_peaks(a, t_d);
    return {
        {"Arias intensity", "m/s", pi / (2.0 * 9.80665) * 2.0 * A * A * t_d / 3.0, arias_intensity(a, t_d), round_off},
        {"CAV", "m/s", A * t_d, cumulative_absolute_velocity(a, t_d), round_off},
        {"PGV", "m/s", A * t_d, peaks.velocity, round_off},
        {"PGD", "m", A * t_d * t_d, peaks.displacement, round_off},
        {"D5-75", "s", t_d * (2.0 - std::cbrt(0.5) - std::cbrt(0.1)), significant_duration(a, t_d, 0.05, 0.75),
         10.0 * round_off},
        {"D5-95", "s", t_d * (2.0 - 2.0 * std::cbrt(0.1)), significant_duration(a, t_d, 0.05, 0.95), 10.0 * round_off}};
}

std::vector<Check> step()
{
    const std::vector<double> a(400, 2.0);
    std::vector<Check> checks;
    for (const double zeta : {0.0, 0.05})
        for (const double period : {0.0137, 0.31, 1.9})
            checks.push_back({"PSA at T = " + std::to_string(period) + " s, damping " + std::to_string(zeta), "m/s2",
                              exact::step_pseudo_acceleration(2.0, zeta),
                              response_spectrum(a, 0.01, std::vector{period}, zeta).points[0].pseudo_acceleration,
                              6e-5});
    return checks;
}

// Impulse I of a short triangle on a slow undamped oscillator: S_d = I/w (1 - (w t_d)^2/12 ...), S_v = I; reached after the record's end.
std::vector<Check> impulse()
{
    const std::vector<double> a{0.0, 5.0, 0.0};
    const auto p = response_spectrum(a, 0.01, std::vector{10.0}, 0.0).points[0];
    return {{"S_d", "m", 0.05 * 10.0 / (2.0 * pi), p.displacement, 6e-5}, {"S_v", "m/s", 0.05, p.velocity, 6e-5}};
}

std::vector<Check> baseline()
{
    Record record{"", 0.01, std::vector<double>(301), {}, {}};
    for (std::size_t k = 0; k < 301; ++k) {
        const double x = static_cast<double>(k) / 300.0;
        record.acceleration[k] = 0.3 - 0.7 * x + 2.0 * x * x;
    }
    const auto c = baseline_corrected(record).coefficients;
    return {{"c0", "m/s2", 0.3, c[0], 1e-12}, {"c1", "m/s2", -0.7, c[1], 1e-12}, {"c2", "m/s2", 2.0, c[2], 1e-12}};
}

std::vector<Check> generated()
{
    std::vector<Check> checks;
    for (const MotionComponent component : {MotionComponent::horizontal, MotionComponent::vertical}) {
        GenerateOptions options;
        options.seed = 2;
        options.component = component;
        const GeneratedRecord g = generate_record(rock_spectrum(), options);
        const Peaks peaks = motion_peaks(g.record.acceleration, g.record.dt);
        const std::string name = component == MotionComponent::horizontal ? "h: " : "v: ";
        checks.push_back({name + "largest deviation from the target, 0.05 to 2 s", "–", 0.10, g.worst_deviation, 0.0,
                          Measure::upper_bound});
        checks.push_back({name + "PGA", "m/s2", 1.0, peaks.acceleration, 0.0});
        checks.push_back({name + "final velocity", "m/s", 0.0, peaks.final_velocity, 1e-6, Measure::absolute});
        checks.push_back({name + "final displacement", "m", 0.0, peaks.final_displacement, 2e-5, Measure::absolute});
    }
    return checks;
}

} // namespace

void add_record_cases(Registry& registry)
{
    registry.push_back(
        {"records.measure.triangle",
         "Measures of a triangular pulse are exact, the 5, 75 and 95 % arrivals inside intervals included.",
         "by integration of the piecewise-linear pulse; Arias intensity: Goldgruber (2015), eq. (4-8)",
         "closed forms on both sides: round-off; the arrivals are found by iteration to round-off", triangle});
    registry.push_back(
        {"records.spectrum.step", "Response spectrum under a suddenly applied constant acceleration A.",
         "A (1 + exp(-pi zeta/sqrt(1 - zeta^2))), first extreme of the closed solution",
         "the recursion is exact; extremes between steps of T/16 are those of a cubic: (2 pi/16)^4/384 = 6e-5", step});
    registry.push_back({"records.spectrum.impulse",
                        "A short pulse on a slow oscillator: the peak comes after the record's end.",
                        "impulse limit S_d = I/w, S_v = I",
                        "cubic between steps 6e-5; the limit itself errs by (w t_d)^2/12 = 3e-6", impulse});
    registry.push_back({"records.baseline.parabola", "The least-squares baseline finds the parabola it is given.",
                        "the parabola itself", "least squares by orthogonalisation: 1e-12", baseline});
    registry.push_back({"records.generate.rock",
                        "Artificial records follow their target spectrum, reach the PGA and end at rest.",
                        "target: Newmark & Hall (1982), rock, 5 % median",
                        "10 % is asked for; the end moves by rounding samples to 1e-6 m/s2: 1e-6 dt sqrt(n/12) = 1e-7 "
                        "m/s and that times 20 s, tenfold allowed",
                        generated});
}

} // namespace damslip::verification
