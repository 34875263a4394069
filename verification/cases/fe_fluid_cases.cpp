#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/harmonic/transfer.hpp"
#include "sliding/loads/added_mass.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/added_mass.hpp"
#include "verification/exact/reservoir.hpp"

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
    scene.reservoir->bottom_reflection = 1.0;
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
                checks.push_back({at(alpha, ratio) + ": error of the damper at 2.4 h, above", "–", 0.02,
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

/// Stiffer and stiffer water at one frequency of shaking, and its pressure on the face beside Westergaard's series of
/// the sliding module.
std::vector<Check> incompressible_limit()
{
    Scene scene = basin(100.0, 4.0);
    scene.reservoir->far_end = FarEnd::closed;
    const double w = 0.5 * 0.5 * std::numbers::pi * std::sqrt(2.2e6) / 100.0;
    double last = 0.0;
    std::vector<Check> checks;
    const double limit = [&] { // K = infinity: no Q at all
        FluidModel water = build_fluid(scene);
        water.mass.setZero();
        HarmonicSolver solver(water.mass, water.damping, water.stiffness);
        return force_at(water, solver, w).real();
    }();
    FluidModel stiff;
    Eigen::VectorXcd pressure;
    for (const double factor : {1e1, 1e2, 1e3, 1e4}) {
        scene.reservoir->bulk_modulus = 2200e6 * factor;
        stiff = build_fluid(scene);
        HarmonicSolver solver(stiff.mass, stiff.damping, stiff.stiffness);
        const double error = force_at(stiff, solver, w).real() - limit;
        pressure = solver.solve((-stiff.flux_x).cast<std::complex<double>>());
        if (last != 0.0)
            checks.push_back({fmt::format("K x {:g}: order in 1/K", factor), "–", 1.0, std::log10(last / error), 0.03,
                              Measure::absolute});
        last = error;
    }
    checks.push_back({"K x 10000: force over that of incompressible water", "–", 1.0, 1.0 + last / limit, 1e-4});
    const sliding::WaterColumn column{100.0, 1000.0, 2200e6};
    for (const int node : stiff.reservoir.face) {
        const double depth = 100.0 - stiff.reservoir.mesh.nodes[static_cast<std::size_t>(node)].y;
        if (depth < 19.0 || std::abs(std::remainder(depth, 20.0)) > 1e-6) continue;
        checks.push_back({fmt::format("pressure at depth {:.2f} h over Westergaard's series", depth / 100.0), "–", 1.0,
                          -pressure[stiff.dofs(node)].real() / sliding::added_mass_per_area({}, column, depth, 0.0),
                          5e-3});
    }
    return checks;
}

/// A bottom that moves up and down everywhere: the water answers as one column, whatever the end.
std::vector<Check> moving_bottom()
{
    std::vector<Check> checks;
    for (const double alpha : {1.0, 0.5})
        for (const double ratio : {0.5, 1.5}) {
            Scene scene = basin(100.0, 1.0);
            scene.reservoir->bottom_motion = BottomMotion::ground;
            scene.reservoir->bottom_reflection = alpha;
            const FluidModel water = build_fluid(scene);
            HarmonicSolver solver(water.mass, water.damping, water.stiffness);
            const double c = water.options.sound_speed(), w = ratio * 0.5 * std::numbers::pi * c / 100.0, kappa = w / c;
            solver.factorise(w);
            const std::complex<double> i(0.0, 1.0);
            const Eigen::VectorXcd p = solver.solve(-water.flux_y.cast<std::complex<double>>() -
                                                    water.end_y.cast<std::complex<double>>() / (i * w));
            const double q = (1.0 - alpha) / ((1.0 + alpha) * c);
            const std::complex<double> size =
                1000.0 / (kappa * std::cos(kappa * 100.0) + i * w * q * std::sin(kappa * 100.0));
            double error = 0.0;
            for (std::size_t node = 0; node < water.reservoir.mesh.nodes.size(); ++node)
                if (const int k = water.dofs(static_cast<int>(node)); k >= 0)
                    error = std::max(
                        error, std::abs(p[k] - size * std::sin(kappa * (100.0 - water.reservoir.mesh.nodes[node].y))));
            checks.push_back({at(alpha, ratio) + ": largest error of the pressure over its amplitude", "–", 3e-3,
                              error / std::abs(size), 0.0, Measure::upper_bound});
        }
    return checks;
}

/// Total horizontal force on inclined faces beside the two formulas for them.
std::vector<Check> inclined_faces()
{
    std::vector<Check> checks;
    for (const double degrees : {0.0, 15.0, 30.0}) {
        const double slope = std::tan(degrees * std::numbers::pi / 180.0);
        const FluidModel water = build_fluid(basin(100.0, 2.0, slope));
        HarmonicSolver solver(water.mass, water.damping, water.stiffness);
        const double total = force_at(water, solver, 1e-3 * water.options.sound_speed() / 100.0).real();
        const double zangar = (1.0 - degrees / 90.0) * exact::zangar_total();
        // Goldgruber & Feldbacher (3-10)...(3-14), y from the bottom, by the midpoint rule.
        const double peak = std::sqrt(degrees / 1000.0), power = 0.6 + 0.005 * degrees;
        double goldgruber = 0.0;
        for (int k = 0; k < 2000; ++k) {
            const double y = (k + 0.5) / 2000.0;
            goldgruber += 0.707 * (1.0 - 0.011 * degrees) *
                          std::pow(std::max(0.0, std::cos(0.5 * std::numbers::pi * (y - peak) / (1.0 - peak))), power) /
                          2000.0;
        }
        const std::string face = fmt::format("face at {:g} deg: ", degrees);
        checks.push_back({face + "Zangar's total over the elements'", "–", 1.0, zangar / total, 0.1});
        checks.push_back({face + "Goldgruber's total over the elements'", "–", 1.0, goldgruber / total, 0.1});
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
        {"fe2d.fluid.incompressible-limit",
         "Stiffer and stiffer water tends to incompressible water, whose pressure on the face is Westergaard's.",
         "the same matrices without Q; Westergaard (1933), rigorous series (3-1) with T = infinity (sliding/loads)",
         "the error is (omega/omega_1)^2 of the stiffened water to first order: order 1 in 1/K, 0.03 for the next term "
         "at K x 10; "
         "pressures 0.5 %: 20 bilinear elements over the depth",
         incompressible_limit});
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
    registry.push_back({"fe2d.fluid.moving-bottom",
                        "A bottom in uniform vertical motion: one column of water, undisturbed by the absorbing end.",
                        "p = rho a sin k(h - y)/(k cos kh + i omega q sin kh), from the wave equation",
                        "0.3 % of the amplitude: elements of a 20th of the depth err by (k h_e)^2/24 in k, 0.14 % of "
                        "kh = 2.36 at Omega = 1.5, times 1 + |tan kh|",
                        moving_bottom});
    registry.push_back(
        {"fe2d.fluid.inclined-faces", "Hydrodynamic force on inclined faces beside the approximate formulas.",
         "Zangar (1952), C_m = 0.73 (1 - phi/90 deg), and Goldgruber & Feldbacher (2013), (3-10)...(3-14)",
         "the formulas are fits; 10 % is what separates them from the elements, whose own error is 0.3 %",
         inclined_faces});
}

} // namespace damslip::verification
