#pragma once

#include "scene/findings.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <vector>

namespace damslip::sliding {

/// Largest ground accelerations of the records, which the shares pga_fraction and pga_v_fraction are of.
struct PeakGround {
    double a_h = 0.0; ///< [m/s^2], its absolute value drives downstream
    double a_v = 0.0; ///< [m/s^2], its absolute value lightens the dam; 0: no vertical component
};

/// The scene's combinations; if it has none, made from it:
/// 1. usual: the scene's levels, no ice; 2. unusual, drains ineffective (with drains); 3. unusual, ice (with ice);
/// 4. extreme, seismic: k_h and k_v are the shares criteria.pga_fraction (1) and pga_v_fraction (0) of the peaks, with ice
/// if there is any (as in the yield acceleration); left out for a_h = a_v = 0;
/// 5. post-seismic: residual strength, damaged curtain, ineffective drains, ice.
/// Shares given instead of k_h and k_v are replaced by their values.
std::vector<Combination> combinations(const Scene& scene, const PeakGround& peak = {});

/// The state after the earthquake: the scene's first post-seismic combination, else the fifth of the list above. What limit
/// equilibrium and finite elements take of curtain, drains and crack after the earthquake.
Combination after_earthquake(const Scene& scene);

/// Evaluates all combinations in their order.
/// One that names no crack rule is reported without crack and, where that leaves tension or the joint has been opened,
/// also with a crack, as "NAME, cracked": by the scene's rule, `static` where the scene says none; seismic:
/// `seismic-unchanged` where the scene has no seismic rule.
///
/// A post-seismic combination gets the joint that an extreme combination opened, filled with the full head: that of the
/// one it names in `follows`; of the governing one where it names none. Governing is the extreme combination after which
/// the sliding factor of this post-seismic combination (its own strength, with crack) is smallest; of equal ones that with
/// the longer crack, then the first by name. The order in the scene does not matter. A joint cracked through counts as
/// open from end to end.
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
