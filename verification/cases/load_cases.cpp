#include "scene/section.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"
#include "sliding/loads/added_mass.hpp"
#include "sliding/loads/static_loads.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/added_mass.hpp"
#include "verification/exact/reference_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::sliding;

constexpr double depth = 62.5; // [m]

AddedMass method(AddedMassFormula formula)
{
    AddedMass m;
    m.formula = formula;
    return m;
}

/// Total over rho h^2 and acting height over h, vertical face.
struct Totals {
    double total, height;
};

Totals totals(const AddedMass& m)
{
    const auto sum = integrate_added_mass(m, {depth, 1000.0, 2200e6}, {{0.0, 0.0}, {0.0, depth}});
    return {sum.xx / (1000.0 * depth * depth), sum.acting_height() / depth};
}

double base_value(const AddedMass& m)
{
    return added_mass_per_area(m, {depth, 1000.0, 2200e6}, depth, 0.0) / (1000.0 * depth);
}

std::vector<Check> added_mass_totals()
{
    const Totals simplified = totals(method(AddedMassFormula::westergaard_simplified));
    const Totals series = totals(method(AddedMassFormula::westergaard));
    return {
        {"simplified, total / rho h^2", "–", 7.0 / 12.0, simplified.total, 1e-12},
        {"simplified, acting height / h", "–", 0.4, simplified.height, 1e-12},
        {"series, total / rho h^2", "–", exact::westergaard_total(), series.total, 1e-12},
        {"series, acting height / h", "–", exact::westergaard_height(), series.height, 1e-12},
        {"series, base / rho h", "–", exact::westergaard_base(), base_value(method(AddedMassFormula::westergaard)),
         1e-13},
        {"Zangar, total / rho h^2", "–", exact::zangar_total(), totals(method(AddedMassFormula::zangar)).total, 1e-12},
        {"Zangar, base / rho h", "–", 0.73, base_value(method(AddedMassFormula::zangar)), 1e-13},
        {"Goldgruber & Feldbacher, total / rho h^2", "–", exact::goldgruber_total(),
         totals(method(AddedMassFormula::goldgruber)).total, 1e-12},
        {"Goldgruber & Feldbacher, base / rho h", "–", 0.707, base_value(method(AddedMassFormula::goldgruber)), 1e-13},
        {"simplified over series, total", "–", 1.075, simplified.total / series.total, 5e-4},
        {"simplified over series, base", "–", 1.179, 0.875 / base_value(method(AddedMassFormula::westergaard)), 5e-4}};
}

std::vector<Check> finite_period()
{
    AddedMass m = method(AddedMassFormula::westergaard);
    m.period = 1.0 / 3.6;
    const WaterColumn water{depth, 1000.0, 2200e6};
    const double tau = std::pow(reservoir_period(water) / *m.period, 2);
    std::vector<Check> checks;
    for (const double zeta : {0.1, 0.5, 1.0})
        checks.push_back({"m / rho h at z/h = " + std::to_string(zeta).substr(0, 3), "–",
                          8.0 / (std::numbers::pi * std::numbers::pi) * exact::westergaard_sine_sum(zeta, tau),
                          added_mass_per_area(m, water, zeta * depth, 0.0) / (1000.0 * depth), 2e-14});
    checks.push_back(
        {"total over that of an infinite period", "–", 1.25, totals(m).total / exact::westergaard_total(), 0.01});
    return checks;
}

std::vector<Check> formulas_against_the_exact_solution()
{
    const double exact_total = exact::westergaard_total(), exact_base = exact::westergaard_base();
    return {{"Zangar, total less exact", "–", 0.03,
             std::abs(totals(method(AddedMassFormula::zangar)).total / exact_total - 1.0), 0.0, Measure::upper_bound},
            {"Zangar, base less exact", "–", 0.02, std::abs(0.73 / exact_base - 1.0), 0.0, Measure::upper_bound},
            {"Goldgruber & Feldbacher, total less exact", "–", 0.05,
             std::abs(totals(method(AddedMassFormula::goldgruber)).total / exact_total - 1.0), 0.0,
             Measure::upper_bound}};
}

/// Weight of water a section displaces, with hydrostatic pressure all around it.
std::vector<Check> buoyancy()
{
    std::vector<Check> checks;
    const std::vector<std::pair<const char*, Polyline>> shapes{
        {"reference dam", exact::reference_scene(exact::ReferenceUplift::none, 0.7).section.polygon},
        {"kinked faces, dipping base", {{0, 0}, {40, -5}, {44, 3}, {20, 40}, {20, 52}, {8, 52}, {5, 20}}},
        {"overhanging upstream face, rising base", {{0, 0}, {30, 4}, {12, 45}, {-3, 45}}}};
    for (const auto& [name, polygon] : shapes) {
        Scene scene = exact::bare_scene(polygon);
        scene.reservoir = Reservoir{};
        scene.reservoir->level = 70.0;
        scene.tailwater = Tailwater{70.0};
        scene.uplift.emplace().model = UpliftModel::linear;
        StaticCase static_case = scene_static_case(scene);
        static_case.loads.weight_factor = 0.0;
        const BaseState state = base_state(scene, static_case);
        const double u = state.base.uplift.force;
        const Force lift =
            state.load + Force{u * state.frame.n.x, u * state.frame.n.y, state.base.uplift.moment_about_heel};
        const double weight = area(scene.section) * 9810.0;
        checks.push_back({std::string(name) + ": horizontal over displaced weight", "–", 0.0, lift.x / weight, 1e-14,
                          Measure::absolute});
        checks.push_back({std::string(name) + ": lift", "N/m", weight, lift.y, 1e-14});
        checks.push_back(
            {std::string(name) + ": line of action", "m", centroid(scene.section).x, lift.moment / lift.y, 1e-13});
    }
    return checks;
}

std::vector<Check> ice_and_silt()
{
    Scene scene = exact::reference_scene(exact::ReferenceUplift::none, 0.77);
    scene.silt = Silt{20.0, 9000.0, 0.35};
    scene.ice = Ice{200e3, 62.5};
    const Force sum = resultant(static_loads(scene, scene_load_case(scene)));
    const double water = 0.5 * 9810.0 * 62.5 * 62.5, silt = 0.5 * 0.35 * 9000.0 * 400.0;
    return {{"thrust", "N/m", water + silt + 200e3, sum.x, 1e-14},
            {"moment about the heel", "N m/m",
             -(water * 62.5 / 3.0 + silt * 20.0 / 3.0 + 200e3 * 62.5) - 2500.0 * 9.81 * (4500.0 + 849.75 * 23.0),
             sum.moment, 1e-14}};
}

} // namespace

void add_load_cases(Registry& registry)
{
    registry.push_back({"sliding.loads.added-mass-totals",
                        "Totals, heights and base values of the four added-mass formulas on a vertical face.",
                        "Goldgruber (2015) (3-1)...(3-14): 7/12, 14 zeta(3)/pi^3, 8 G/pi^2, 0.365 (2/3 + pi/4), 0.707 "
                        "Gamma(0.8)/(sqrt(pi) "
                        "Gamma(1.3)); simplified is 7.5 % and 17.9 % above the series",
                        "quadrature of roots and logarithms at the surface to 1e-12; the two percentages as printed",
                        added_mass_totals});
    registry.push_back({"sliding.loads.westergaard-finite-period",
                        "Westergaard's series at the period of a 3.6 Hz dam before 62.5 m of water, against Clausen's "
                        "integral and 20001 terms.",
                        "Westergaard (1933); Goldgruber (2015) (3-1); the total grows by about 25 %",
                        "truncation of both sums below 1e-14; the growth as stated, to 1 %", finite_period});
    registry.push_back({"sliding.loads.added-mass-formulas-error",
                        "Error of Zangar's and of Goldgruber & Feldbacher's formula on a vertical face against the "
                        "exact incompressible solution.",
                        "Westergaard's series, infinite period", "stated bounds", formulas_against_the_exact_solution});
    registry.push_back({"sliding.loads.buoyancy",
                        "Water pressure all around a submerged section is the weight of the water it displaces.",
                        "Archimedes; area and centroid of the polygon", "round-off of sums of the faces' forces",
                        buoyancy});
    registry.push_back(
        {"sliding.loads.ice-and-silt", "Thrust and moment of water, sediment and ice on the reference dam, by hand.",
         "1/2 gamma h^2 at h/3, 1/2 K_s gamma' h_s^2 at h_s/3, ice at the surface", "round-off", ice_and_silt});
}

} // namespace damslip::verification
