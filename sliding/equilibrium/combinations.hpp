#pragma once

#include "scene/words.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <vector>

namespace damslip::sliding {

/// Peak ground acceleration that the seismic combination is made from.
struct PeakGround {
    double a_h = 0.0; ///< [m/s^2], its absolute value drives downstream
    double a_v = 0.0; ///< [m/s^2], positive up; taken at the same instant; negative lightens the dam
};

/// The scene's combinations; if it has none, made from it:
/// 1. usual: the scene's levels, no ice; 2. unusual, drains ineffective (with drains); 3. unusual, ice (with ice);
/// 4. extreme, seismic at the peak ground acceleration, with ice if there is any (as in the yield acceleration); left
/// out for a_h = a_v = 0;
/// 5. post-seismic: residual strength, damaged curtain, ineffective drains, ice.
std::vector<Combination> combinations(const Scene& scene, const PeakGround& peak = {});

/// Evaluates all combinations in their order.
/// One that names no crack rule is reported without crack and, where that leaves tension or the joint has been opened,
/// also with a crack: the scene's rule, `static` where the scene says none; seismic: `seismic-unchanged` where the
/// scene has no seismic rule. A post-seismic combination gets the joint that the last extreme combination before it
/// opened, filled with the full head.
std::vector<Equilibrium> evaluate_combinations(const Scene& scene, const PeakGround& peak = {},
                                               const SeepageProfile& seepage = {});

/// Uplift of one model on the scene and the friction that just holds against it, no crack.
struct UpliftComparison {
    UpliftModel model = UpliftModel::none;
    PressureProfile profile;
    UpliftResultant uplift;
    double critical_friction = 0.0; ///< [-]
};

/// Every model the scene has the data for: none, linear, curtain, drains, points, seepage (if a solver is given).
std::vector<UpliftComparison> compare_uplift(const Scene& scene, const SeepageProfile& seepage = {});


} // namespace damslip::sliding
