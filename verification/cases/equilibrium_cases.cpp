#include "sliding/block/rigid_block.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/cracked_base.hpp"
#include "verification/exact/reference_scene.hpp"

#include <cmath>

namespace damslip::verification {

namespace {

using namespace damslip::sliding;
using exact::ReferenceUplift;

Combination combination(CrackRule rule, double k_h = 0.0, double k_v = 0.0)
{
    Combination c;
    c.name = "case";
    c.crack = rule;
    c.k_h = k_h;
    c.k_v = k_v;
    return c;
}

Scene triangular_dam(double density, double level)
{
    Scene scene = exact::bare_scene(exact::triangle(45.0, 62.5), density);
    scene.contact.friction = 0.77;
    scene.reservoir = Reservoir{};
    scene.reservoir->level = level;
    scene.added_mass.formula = AddedMassFormula::westergaard_simplified;
    return scene;
}

std::vector<damslip::verification::Check> triangular_yield()
{
    const Equilibrium e = evaluate(triangular_dam(2500.0, 62.5), combination(CrackRule::none), {});
    return {
        {"a_y", "m/s²", 1.27640, e.yield_acceleration, 5e-6 / 1.2764},
        {"a_y by hand", "m/s²", (0.77 * 34488281.25 - 19160156.25) / (3515625.0 + 7.0 / 12.0 * 3906250.0),
         e.yield_acceleration, 1e-13},
        {"resultant from the toe", "m", 30.0 - 19160156.25 / 34488281.25 * 62.5 / 3.0, e.resultant_from_toe, 1e-13}};
}

std::vector<damslip::verification::Check> reference_dam()
{
    const double weight = 1599.75 * 2500.0 * 9.81, thrust = 0.5 * 9810.0 * 3906.25, p0 = 613125.0;
    const double moment = 2500.0 * 9.81 * (4500.0 + 849.75 * 23.0) + thrust * 62.5 / 3.0; // about the heel, clockwise
    std::vector<damslip::verification::Check> checks;
    struct Row {
        const char* name;
        ReferenceUplift uplift;
        double force, first_moment; ///< of p/p0 over the base [m], [m^2]
    };
    // Triangle 45/2, 45^2/6. Printed rule: 7 x 5/6 + 38/3; 7^2 (1 + 2 x 2/3)/6 + (38/6)(2/3)(2 x 7 + 45).
    for (const Row& row : {Row{"linear", ReferenceUplift::linear, 22.5, 337.5},
                           Row{"printed 2/3 rule", ReferenceUplift::printed_curtain, 18.5,
                               49.0 * (1.0 + 4.0 / 3.0) / 6.0 + 38.0 / 9.0 * 59.0}}) {
        const Scene scene = exact::reference_scene(row.uplift, 0.77);
        const Equilibrium e = evaluate(scene, combination(CrackRule::none), {});
        const double normal = weight - row.force * p0, s = (moment - row.first_moment * p0) / normal;
        checks.push_back({std::string(row.name) + ": uplift", "N/m", row.force * p0, e.base.uplift.force, 1e-14});
        checks.push_back({std::string(row.name) + ": N'", "N/m", normal, e.base.effective_normal, 1e-14});
        checks.push_back({std::string(row.name) + ": holds above mu", "–", thrust / normal,
                          critical_friction(make_rigid_block(scene)), 1e-14});
        checks.push_back({std::string(row.name) + ": a_y at mu = 0.77", "m/s²",
                          (0.77 * normal - thrust) / (3999375.0 + 7.0 / 12.0 * 3906250.0), e.yield_acceleration,
                          1e-12});
        checks.push_back(
            {std::string(row.name) + ": resultant from the heel", "m", s, e.base.resultant_distance, 1e-13});
        checks.push_back({std::string(row.name) + ": heel stress", "Pa",
                          normal / 45.0 * (1.0 - 6.0 * (s - 22.5) / 45.0), e.heel_stress, 1e-11});
    }
    const auto models = compare_uplift(exact::reference_scene(ReferenceUplift::points, 0.77));
    checks.push_back({"free profile: uplift", "N/m", 15.439 * p0, models.back().uplift.force, 1e-14});
    checks.push_back(
        {"printed 2/3 rule, printed", "–", 0.687,
         critical_friction(make_rigid_block(exact::reference_scene(ReferenceUplift::printed_curtain, 0.7))), 1e-3});
    checks.push_back({"linear, printed", "–", 0.753,
                      critical_friction(make_rigid_block(exact::reference_scene(ReferenceUplift::linear, 0.7))), 1e-3});
    return checks;
}

std::vector<damslip::verification::Check> crack()
{
    std::vector<damslip::verification::Check> checks;
    for (const double level : {57.6, 58.0, 58.5}) {
        Scene scene = triangular_dam(2400.0, level);
        scene.uplift.emplace().model = UpliftModel::linear;
        const Equilibrium e = evaluate(scene, combination(CrackRule::fixed_static), {});
        const double weight = 0.5 * 45.0 * 62.5 * 2400.0 * 9.81, thrust = 0.5 * 9810.0 * level * level;
        const double exact =
            exact::linear_uplift_crack(weight, weight * 30.0 - thrust * level / 3.0, 9810.0 * level, 45.0);
        checks.push_back(
            {"crack at " + std::to_string(level).substr(0, 4) + " m of water", "m", exact, e.base.crack.length, 1e-12});
    }
    // Block 20 x 30 m without uplift under 22 m of water: T = L - 3 M/N.
    Scene block = exact::bare_scene({{0, 0}, {20, 0}, {20, 30}, {0, 30}}, 2400.0);
    block.reservoir = Reservoir{};
    block.reservoir->level = 22.0;
    const double weight = 600.0 * 2400.0 * 9.81, overturning = 9810.0 * 22.0 * 22.0 * 22.0 / 6.0;
    const Equilibrium e = evaluate(block, combination(CrackRule::seismic_unchanged, 0.2), {});
    const double a_h = 0.2 * 9.80665, water = scene_added_mass(block, 22.0).xx,
                 lever = scene_added_mass(block, 22.0).acting_height();
    const double restoring = weight * 10.0 - overturning - a_h * (600.0 * 2400.0 * 15.0 + water * lever);
    checks.push_back(
        {"dry joint of a shaken block", "m", exact::dry_crack(weight, restoring, 20.0), e.base.crack.length, 1e-11});
    return checks;
}

std::vector<damslip::verification::Check> drains()
{
    Scene scene = triangular_dam(2400.0, 60.0);
    scene.tailwater = Tailwater{6.0};
    scene.uplift.emplace().model = UpliftModel::drains;
    scene.drains = Drains{};
    scene.drains->distance = 9.0;
    const UpliftState state = scene_uplift_state(scene);
    // H3 = 6 + (1/3) 54 (36/45) = 20.4 m;  U = gamma [9 (60 + 20.4)/2 + 36 (20.4 + 6)/2].
    std::vector<damslip::verification::Check> checks{
        {"pressure at the drains", "Pa", 20.4 * 9810.0, pressure_at(uplift_profile(scene, state), 9.0), 1e-14},
        {"uplift", "N/m", 9810.0 * (361.8 + 475.2), resultant(uplift_profile(scene, state)).force, 1e-14}};
    scene.drains->gallery_level = 15.0; // H4 = 15: H3 = 15 + (1/3) 45 x 0.8 = 27 m
    checks.push_back({"pressure at the drains, gallery at 15 m", "Pa", 27.0 * 9810.0,
                      pressure_at(uplift_profile(scene, state), 9.0), 1e-14});
    checks.push_back({"crack past the drains: pressure there", "Pa", 60.0 * 9810.0,
                      pressure_at(uplift_profile(scene, state, {Side::heel, 10.0}), 9.0), 1e-14});
    return checks;
}

std::vector<damslip::verification::Check> yield_is_limit_equilibrium()
{
    Scene scene = exact::bare_scene({{0, 0}, {50, -3}, {50, 4}, {14, 60}, {6, 60}, {6, 25}}, 2400.0);
    scene.contact.friction = 0.8;
    scene.contact.cohesion = 1e5;
    scene.reservoir = Reservoir{};
    scene.reservoir->level = 55.0;
    scene.tailwater = Tailwater{6.0};
    scene.uplift.emplace().model = UpliftModel::linear;
    const double a_y = evaluate(scene, combination(CrackRule::none, 0.0, 0.1), {}).yield_acceleration;
    const double tipping = evaluate(scene, combination(CrackRule::none, 0.0, 0.1), {}).tipping_acceleration;
    return {{"sliding factor at a_h = a_y", "–", 1.0,
             evaluate(scene, combination(CrackRule::none, a_y / 9.80665, 0.1), {}).sliding_factor, 1e-12},
            {"resultant from the toe at the tipping acceleration", "m", 0.0,
             evaluate(scene, combination(CrackRule::none, tipping / 9.80665, 0.1), {}).resultant_from_toe, 1e-11,
             Measure::absolute}};
}

std::vector<damslip::verification::Check> scaling()
{
    std::vector<damslip::verification::Check> checks;
    for (const auto uplift : {ReferenceUplift::linear, ReferenceUplift::printed_curtain, ReferenceUplift::points}) {
        const double one =
            evaluate(exact::reference_scene(uplift, 0.77), combination(CrackRule::none), {}).yield_acceleration;
        const double two =
            evaluate(exact::reference_scene(uplift, 0.77, 2.0), combination(CrackRule::none), {}).yield_acceleration;
        checks.push_back({"a_y of the doubled dam", "m/s²", one, two, 1e-15});
    }
    return checks;
}

std::vector<damslip::verification::Check> mirror()
{
    Scene a = exact::bare_scene({{0, 0}, {40, 0}, {40, 3}, {9, 50}, {3, 50}, {3, 20}}, 2200.0);
    a.contact.friction = 0.75;
    a.reservoir = Reservoir{};
    a.reservoir->level = 48.0;
    a.reservoir->model = ReservoirModel::hydrostatic;
    a.tailwater = Tailwater{9.0};
    a.uplift.emplace().model = UpliftModel::linear;
    Scene b = a;
    b.section.polygon = exact::mirrored(a.section.polygon);
    std::swap(b.reservoir->level, b.tailwater->level);
    const Equilibrium ea = evaluate(a, combination(CrackRule::fixed_static), {}),
                      eb = evaluate(b, combination(CrackRule::fixed_static), {});
    return {{"shear", "N/m", -ea.shear, eb.shear, 1e-13},
            {"N'", "N/m", ea.base.effective_normal, eb.base.effective_normal, 1e-12},
            {"crack", "m", ea.base.crack.length, eb.base.crack.length, 1e-10},
            {"resultant", "m", ea.resultant_from_toe, 40.0 - eb.resultant_from_toe, 1e-11},
            {"upstream yield", "m/s²", ea.yield_acceleration, eb.yield_acceleration_upstream, 1e-11}};
}

} // namespace

void add_equilibrium_cases(Registry& registry)
{
    registry.push_back({"sliding.equilibrium.triangular-dam",
                        "Triangular dam, full reservoir, no uplift: yield acceleration and resultant by hand.",
                        "Goldgruber (2015) (4-3) with 7/12 rho h^2 (3-5)", "round-off; the printed value to its digits",
                        triangular_yield});
    registry.push_back(
        {"sliding.equilibrium.reference-dam",
         "Reference dam, linear and printed 2/3 uplift: uplift, N', critical friction, a_y, resultant, stress.",
         "hand calculation; Goldgruber (2015) sec. 4.2, fig. 4-2",
         "round-off; printed critical frictions to three digits", reference_dam});
    registry.push_back(
        {"sliding.equilibrium.crack",
         "Crack and uplift in equilibrium on a triangle under linear uplift; dry joint of a shaken block.",
         "T = (N L + p L^2/2 - 3 M)/(N - p L), T = L - 3 M/N: derived in verification/exact/cracked_base.hpp",
         "bisection to the last bit, amplified by N/(N - p L) of about 5", crack});
    registry.push_back({"sliding.equilibrium.drains", "Uplift with drains, gallery and a crack past them, by hand.",
                        "USACE EM 1110-2-2200: H3 = H2 + (1 - E)(H1 - H2)(L - X)/L", "round-off", drains});
    registry.push_back({"sliding.equilibrium.yield-is-limit-equilibrium",
                        "Sloping faces, dipping base, cohesion, vertical motion: the limit equilibrium at a_y has "
                        "factor 1, at the tipping acceleration its "
                        "resultant at the toe.",
                        "the yield acceleration of the block and the factor of the combination are separate codes",
                        "round-off", yield_is_limit_equilibrium});
    registry.push_back({"sliding.equilibrium.scaling", "Doubling all lengths leaves the yield acceleration unchanged.",
                        "forces and masses scale with the square", "powers of two are exact", scaling});
    registry.push_back({"sliding.equilibrium.mirror",
                        "High tailwater on the mirrored dam gives the mirrored answer, the crack at the toe.",
                        "symmetry", "round-off, amplified in the crack search", mirror});
}

} // namespace damslip::verification
