#include "exact/added_mass.hpp"
#include "exact/reservoir.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/harmonic/harmonic_solver.hpp"
#include "verification/modules.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::fe2d;

/// A triangular dam with a full reservoir; only its upstream face matters here.
Scene basin(double depth, double length_over_depth, double face_slope = 0.0)
{
    Scene scene;
    scene.section.polygon = {{0, 0}, {2.0 * depth, 0}, {face_slope * depth, depth}};
    scene.reservoir = Reservoir{};
    scene.reservoir->level = depth;
    scene.reservoir->length = length_over_depth * depth;
    scene.reservoir->bottom_motion = BottomMotion::still;
    return scene;
}

std::complex<double> force_at(const FluidModel& water, HarmonicSolver& solver, double frequency)
{
    if (!solver.factorise(frequency)) return std::nan("");
    const Eigen::VectorXcd p = solver.solve((-water.flux_x).cast<std::complex<double>>());
    const double h = water.reservoir.depth;
    return -(water.force_x.cast<std::complex<double>>().transpose() * p).value() / (water.options.density * h * h);
}

std::string at(double alpha, double ratio)
{
    return fmt::format("alpha {:.2f}, Omega {:.2f}", alpha, ratio);
}

/// Frequency ratios Omega = ω/ω_1 and the error allowed there.
const std::pair<double, double> chopra_points[] = {{0.2, 0.01}, {0.4, 0.01},  {0.6, 0.01}, {0.8, 0.01}, {0.9, 0.01},
                                                   {1.1, 0.02}, {1.25, 0.02}, {1.5, 0.02}, {2.0, 0.02}, {2.5, 0.02}};

std::vector<Check> chopra()
{
    std::vector<Check> checks;
    for (const double alpha : {1.0, 0.75, 0.5, 0.25, 0.0}) {
        Scene scene = basin(100.0, 1.0);
        scene.reservoir->bottom_reflection = alpha;
        const FluidModel water = build_fluid(scene);
        scene.reservoir->far_end = FarEnd::damper;
        scene.reservoir->length = 240.0;
        const FluidModel damper = build_fluid(scene);
        const exact::InfiniteReservoir infinite{100.0, 1000.0, water.options.sound_speed(), alpha};
        HarmonicSolver solver(water.mass, water.damping, water.stiffness),
            plain(damper.mass, damper.damping, damper.stiffness);
        for (const auto& [ratio, tolerance] : chopra_points) {
            const double w = ratio * infinite.first_frequency();
            const std::complex<double> expected = infinite.wall_force(w), computed = force_at(water, solver, w),
                                       damped = force_at(damper, plain, w);
            const double size = std::abs(expected), error = std::abs(computed - expected) / size,
                         error_of_damper = std::abs(damped - expected) / size;
            checks.push_back({at(alpha, ratio) + ": force on the wall, amplitude", "rho h^2 a", size,
                              std::abs(computed), tolerance});
            checks.push_back({at(alpha, ratio) + ": complex error", "–", tolerance, error, 0.0, Measure::upper_bound});
            // The damper is exact for waves along the axis only; what it loses against the better end is the point of this table.
            if (alpha >= 0.5 && ratio > 1.0)
                checks.push_back({at(alpha, ratio) + ": error of the damper at 2.4 h, larger than", "–", error,
                                  error_of_damper, 0.0, Measure::lower_bound});
            else
                checks.push_back({at(alpha, ratio) + ": error of the damper at 2.4 h", "–", 0.1, error_of_damper, 0.0,
                                  Measure::upper_bound});
        }
    }
    return checks;
}

std::vector<Check> incompressible()
{
    std::vector<Check> checks;
    for (const FarEnd end : {FarEnd::absorbing, FarEnd::closed}) {
        Scene scene = basin(100.0, end == FarEnd::absorbing ? 1.0 : 4.0);
        scene.reservoir->far_end = end;
        const FluidModel water = build_fluid(scene);
        HarmonicSolver solver(water.mass, water.damping, water.stiffness);
        const double w = 1e-3 * 0.5 * std::numbers::pi * water.options.sound_speed() / 100.0;
        const std::string name = end == FarEnd::absorbing ? "absorbing end at h: " : "closed end at 4 h: ";
        checks.push_back(
            {name + "total force", "rho h^2 a", exact::westergaard_total(), force_at(water, solver, w).real(), 5e-3});
        const Eigen::VectorXcd p = solver.solve((-water.flux_x).cast<std::complex<double>>());
        const int base = water.dofs(water.reservoir.face.front());
        checks.push_back(
            {name + "pressure at the base", "rho h a", exact::westergaard_base(), -p[base].real() / 1e5, 5e-3});
    }
    return checks;
}

} // namespace

void add_fe_fluid_cases(Registry& registry)
{
    registry.push_back(
        {"fe2d.fluid.rigid-wall-incompressible",
         "Slow shaking of a rigid vertical wall moves the water of Westergaard's incompressible reservoir.",
         "14 zeta(3)/pi^3 rho h^2 and 8 G/pi^2 rho h (Westergaard 1933, series (3-1) summed; G Catalan's constant)",
         "0.5 %: bilinear elements, 20 over the depth, whose error at the surface's z log z falls with h^2; 1e-6 of it "
         "is the frequency, "
         "1/1000 of the reservoir's first",
         incompressible});
    registry.push_back(
        {"fe2d.fluid.frequency-response",
         "Hydrodynamic force on a rigid wall over frequency and bottom absorption, with the absorbing end at one "
         "depth; beside it the plain "
         "damper at 2.4 depths.",
         "series over the complex depth modes of the infinite reservoir (Chopra 1967; Fenves & Chopra 1984)",
         "1 % below the first frequency and 2 % above of the complex force, mesh of 20 elements over the depth (0.2 % "
         "of error) included; "
         "the end's own reflection is below 0.1 %. The damper has no tolerance above the first frequency: it must be "
         "worse there",
         chopra});
}

} // namespace damslip::verification
