#include "core/units.hpp"
#include "exact/plane_failure.hpp"
#include "exact/reference_scene.hpp"
#include "scene/rock_slope.hpp"
#include "scene/section.hpp"
#include "sliding/block/yield.hpp"
#include "sliding/equilibrium/combinations.hpp"
#include "verification/modules.hpp"

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::sliding;

constexpr double degree = std::numbers::pi / 180.0;

/// The scene of a rock slope with water in its crack, as the scene file fills it in.
Scene slope_scene(const RockSlope& slope, const exact::PlaneFailure& p)
{
    Scene scene = exact::bare_scene(sliding_block(slope), p.unit_weight / 9.81);
    scene.contact.friction = std::tan(p.friction_angle);
    scene.contact.cohesion = p.cohesion;
    if (p.water_depth > 0.0) {
        scene.reservoir = Reservoir{};
        scene.reservoir->level = p.water_depth;
        scene.reservoir->model = ReservoirModel::hydrostatic;
        scene.uplift.emplace().model = UpliftModel::linear;
    }
    return scene;
}

double sliding_factor(const Scene& scene, double k)
{
    Combination c;
    c.name = "case";
    c.crack = CrackRule::none;
    c.k_h = k * 9.81 / units::standard_gravity;
    return evaluate(scene, c, {}).sliding_factor;
}

/// The exercise of Wyllie & Mah: H 12 m, 60 deg, plane 35 deg, crack 4 m behind the crest, 3 m of water.
std::vector<damslip::verification::Check> plane_failure_exercise()
{
    const RockSlope slope{12.0, 60 * degree, 35 * degree, 4.0, 0.0};
    exact::PlaneFailure p;
    p.height = 12.0;
    p.face_dip = 60 * degree;
    p.plane_dip = 35 * degree;
    p.crack_depth = crack_depth(slope);
    p.water_depth = 3.0;
    p.unit_weight = 26e3;
    p.cohesion = 25e3;
    p.friction_angle = 37 * degree;
    const Scene scene = slope_scene(slope, p);
    const RigidBlock block = make_rigid_block(scene);
    return {{"depth of the crack, printed", "m", 4.35, crack_depth(slope), 5e-3, Measure::absolute},
            {"area of the plane, printed", "m²/m", 13.34, base_length(scene.section), 5e-3, Measure::absolute},
            {"weight", "N/m", plane_weight(p), block.mass * 9.81, 1e-14},
            {"U on the plane", "N/m", plane_uplift(p), block.uplift, 1e-14},
            {"V in the crack", "N/m", crack_thrust(p), block.horizontal_force, 1e-14},
            {"factor of safety, printed", "–", 1.25, sliding_factor(scene, 0.0), 5e-3, Measure::absolute},
            {"factor of safety", "–", plane_factor(p), sliding_factor(scene, 0.0), 1e-13},
            {"factor with 0.08 W out of the slope", "–", plane_factor(p, 0.08), sliding_factor(scene, 0.08), 1e-13},
            {"yield acceleration", "m/s²", 9.81 * plane_yield_coefficient(p), yield_acceleration(block), 1e-12}};
}

/// Crack in the face, at the crest and behind it, wet and dry, over dips.
std::vector<damslip::verification::Check> plane_failure_range()
{
    std::vector<damslip::verification::Check> checks;
    for (const double distance : {-6.0, 0.0, 11.0})
        for (const double plane : {22.0, 40.0})
            for (const double fill : {0.0, 0.7}) {
                const RockSlope slope{40.0, 65 * degree, plane * degree, distance, 0.0};
                exact::PlaneFailure p;
                p.height = slope.height;
                p.face_dip = slope.face_dip;
                p.plane_dip = slope.plane_dip;
                p.crack_depth = crack_depth(slope);
                p.crack_in_face = distance < 0.0;
                if (p.crack_in_face) // there the printed z goes from the level of the crest to the foot of the crack
                    p.crack_depth = 40.0 - (40.0 / std::tan(slope.face_dip) + distance) * std::tan(slope.plane_dip);
                p.water_depth = fill * crack_depth(slope);
                p.unit_weight = 25e3;
                p.cohesion = 60e3;
                p.friction_angle = 33 * degree;
                const Scene scene = slope_scene(slope, p);
                checks.push_back({"weight", "N/m", plane_weight(p), make_rigid_block(scene).mass * 9.81, 1e-13});
                checks.push_back({"factor of safety", "–", plane_factor(p), sliding_factor(scene, 0.0), 1e-12});
            }
    return checks;
}

} // namespace

void add_neighbour_cases(Registry& registry)
{
    registry.push_back(
        {"sliding.neighbours.plane-failure",
         "Plane failure with a water-filled tension crack: forces, factor of safety, yield acceleration.",
         "exercise of Wyllie & Mah (2004), Rock Slope Engineering, ch. 6, by the formulas of Hoek & Bray "
         "(1981), ch. 7 (tests/exact/plane_failure.hpp)",
         "printed values to their digits; formulas to round-off, a_y amplified by the difference of forces",
         plane_failure_exercise});
    registry.push_back({"sliding.neighbours.plane-failure-range",
                        "Crack in the face, at the crest and behind it, wet and dry: weight and factor of safety.",
                        "Hoek & Bray (1981), ch. 7", "round-off", plane_failure_range});
}

} // namespace damslip::verification
