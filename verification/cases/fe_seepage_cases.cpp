#include "verification/cases/modules.hpp"

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/seepage/seepage.hpp"
#include "verification/exact/seepage.hpp"

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using Side = exact::SeepageUnderBase::Side;

/// Base of 10 m, water 10 m deep, on rock of the given size.
Scene base_on_rock(double width, double depth)
{
    Scene scene;
    scene.section.polygon = {{0, 0}, {10, 0}, {0, 12}};
    scene.foundation.emplace();
    scene.foundation->mass = RockMass::massless;
    scene.foundation->width = width;
    scene.foundation->depth = depth;
    scene.foundation->permeability = 1e-4;
    scene.reservoir.emplace();
    scene.reservoir->level = 10.0;
    return scene;
}

/// The thesis' dam with its curtain and full reservoir.
Scene thesis_dam(double curtain_thickness, double curtain_permeability)
{
    Scene scene;
    scene.section.polygon = {{0, 0}, {45, 0}, {12, 51.5}, {12, 62.5}, {0, 62.5}};
    scene.dam.density = 2500.0;
    scene.dam.young_modulus = 25e9;
    scene.foundation.emplace();
    scene.foundation->mass = RockMass::massless;
    scene.foundation->material.young_modulus = 30e9;
    scene.foundation->width = 300.0;
    scene.foundation->depth = 100.0;
    scene.curtain.emplace();
    scene.curtain->distance = 7.0;
    scene.curtain->thickness = curtain_thickness;
    scene.curtain->permeability = curtain_permeability;
    scene.reservoir.emplace();
    scene.reservoir->level = 62.5;
    return scene;
}

fe2d::SeepageResult solve(const Scene& scene)
{
    return fe2d::solve_seepage(scene, scene_uplift_state(scene));
}

double pressure_at(const fe2d::SeepageResult& result, double distance)
{
    for (std::size_t i = 1; i < result.profile.points.size(); ++i) {
        const auto &a = result.profile.points[i - 1], &b = result.profile.points[i];
        if (distance <= b.distance)
            return a.pressure + (b.pressure - a.pressure) * (distance - a.distance) / (b.distance - a.distance);
    }
    return result.profile.points.back().pressure;
}

std::vector<Check> arccosine()
{
    const auto result = solve(base_on_rock(1200.0, 200.0));
    std::vector<Check> checks;
    for (const double x : {0.5, 2.5, 5.0, 7.5})
        checks.push_back({"p/p0 at x/B = " + std::to_string(x / 10.0).substr(0, 4), "-",
                          std::acos(2.0 * x / 10.0 - 1.0) / std::numbers::pi, pressure_at(result, x) / 98100.0, 2e-3,
                          Measure::absolute});
    return checks;
}

std::vector<Check> finite_layer()
{
    const exact::SeepageUnderBase exact{5.0, 5.0, 0.0, 10.0};
    const auto result = solve(base_on_rock(70.0, 10.0));
    return {{"p/p0 at x/B = 0.25", "-", exact.head(-2.5, Side::upstream), pressure_at(result, 2.5) / 98100.0, 5e-4,
             Measure::absolute},
            {"uplift force", "N/m", 490500.0, result.uplift, 1e-9, Measure::relative},
            {"discharge q/(k h)", "-", exact.discharge(), result.inflow / 1e-3, 1e-3, Measure::relative}};
}

std::vector<Check> sheet_pile()
{
    Scene scene = base_on_rock(70.0, 10.0);
    scene.curtain.emplace();
    scene.curtain->distance = 3.0;
    scene.curtain->depth = 4.0;
    scene.curtain->thickness = 0.02;
    scene.curtain->permeability = 1e-13;
    const exact::SeepageUnderBase exact{3.0, 7.0, 4.0, 10.0};
    const auto result = solve(scene);
    return {{"p/p0 before the pile", "-", exact.head(0.0, Side::upstream), *result.pressure_before_curtain / 98100.0,
             3e-3, Measure::absolute},
            {"p/p0 behind the pile", "-", exact.head(0.0, Side::downstream), *result.pressure_behind_curtain / 98100.0,
             3e-3, Measure::absolute},
            {"uplift force", "N/m", exact.mean_head() * 981000.0, result.uplift, 1e-3, Measure::relative},
            {"discharge q/(k h)", "-", exact.discharge(), result.inflow / 1e-3, 3e-3, Measure::relative}};
}

std::vector<Check> thesis_scene()
{
    const exact::SeepageUnderBase exact{7.0, 38.0, 30.0, 100.0};
    const double heel = 9810.0 * 62.5;
    const auto thin = solve(thesis_dam(0.02, 1e-13)), as_given = solve(thesis_dam(1.0, 1e-8));
    std::vector<Check> checks{{"p/p0 before a thin curtain", "-", exact.head(0.0, Side::upstream),
                               *thin.pressure_before_curtain / heel, 2e-3, Measure::absolute},
                              {"p/p0 behind a thin curtain", "-", exact.head(0.0, Side::downstream),
                               *thin.pressure_behind_curtain / heel, 2e-3, Measure::absolute},
                              {"uplift with a thin curtain", "MN/m", exact.mean_head() * heel * 45.0 * 1e-6,
                               thin.uplift * 1e-6, 3e-3, Measure::relative}};
    for (const Point& p : {Point{2, .957}, {6, .938}, {10, .314}, {20, .289}, {30, .233}, {40, .137}})
        checks.push_back({"p/p0 with a thin curtain, x = " + std::to_string(static_cast<int>(p.x)) + " m", "-", p.y,
                          pressure_at(thin, p.x) / heel, 2e-3, Measure::absolute});
    checks.push_back(
        {"p/p0 before the 1 m curtain", "-", 0.94, *as_given.pressure_before_curtain / heel, 5e-3, Measure::absolute});
    checks.push_back(
        {"p/p0 behind the 1 m curtain", "-", 0.32, *as_given.pressure_behind_curtain / heel, 2e-2, Measure::absolute});
    checks.push_back({"uplift with the 1 m curtain", "MN/m", 9.6, as_given.uplift * 1e-6, 5e-3, Measure::relative});
    return checks;
}

std::vector<Check> two_forms()
{
    Scene scene = thesis_dam(1.0, 1e-8);
    scene.mesh.size = 3.0;
    scene.stages.pore_pressure = PorePressure::effective; // the mesh carries the flow: the curtain is a zone of it
    const auto flow = fe2d::solve_seepage_on(fe2d::build_mesh(scene), scene, scene_uplift_state(scene));
    const Eigen::VectorXd pressure = fe2d::excess_pore_pressure(flow.field.head, flow.unit_weight);
    const fe2d::DofMap dofs = fe2d::displacement_dofs(flow.mesh, fe2d::Base::tied);
    fe2d::LinearSolver solver;
    solver.factorise(fe2d::stiffness_matrix(flow.mesh, dofs, fe2d::materials_of(scene)));
    const Eigen::VectorXd total =
        solver.solve(fe2d::pore_pressure_loads(flow.mesh, dofs, pressure, PorePressure::total));
    const Eigen::VectorXd effective =
        solver.solve(fe2d::pore_pressure_loads(flow.mesh, dofs, pressure, PorePressure::effective));
    return {{"largest difference of displacements over the largest displacement", "-", 1e-11,
             (total - effective).cwiseAbs().maxCoeff() / total.cwiseAbs().maxCoeff(), 0.0, Measure::upper_bound}};
}

} // namespace

void add_fe_seepage_cases(Registry& registry)
{
    registry.push_back({"fe2d.seepage.arccosine", "Pressure under a flat base on deep rock follows the arccosine law",
                        "Conformal map, p/p0 = arccos(2x/B - 1)/π (Harr 1962)",
                        "Layer 20 base lengths deep in place of none: 1e-3; elements: 1e-3", arccosine});
    registry.push_back(
        {"fe2d.seepage.finite-layer", "Pressure, uplift and discharge under a flat base on a layer as deep as the base",
         "Elliptic integrals (Byrd & Friedman 254.00), derived in exact/seepage.hpp; U = p0 B/2 by symmetry",
         "Elements of B/450 at the singular ends", finite_layer});
    registry.push_back({"fe2d.seepage.sheet-pile",
                        "Pressures, uplift and discharge with a sheet pile, uplift within 1 %",
                        "Conformal map with elliptic integrals, exact/seepage.hpp",
                        "Curtain 0.02 m thick in place of none, and elements", sheet_pile});
    registry.push_back(
        {"fe2d.seepage.thesis-dam",
         "The curtain of the thesis lowers the uplift pressure to about a third, not to two thirds",
         "Conformal map for a thin curtain; profile of an independent flow solution (three digits); curtain 1 m "
         "thick: 0.94 before, 0.32 behind, 9.6 MN/m to two digits",
         "Digits given; thickness of 1 m adds to the way round the foot (0.304 against 0.315)", thesis_scene});
    registry.push_back({"fe2d.seepage.two-forms",
                        "Total form (surface pressures and ∫BᵀmpdV) and effective form (-∇p) of the pore "
                        "pressure give the same displacements",
                        "Divergence theorem", "Round-off of the solution", two_forms});
}

} // namespace damslip::verification
