#pragma once

#include "sliding/equilibrium/base_state.hpp"

#include <limits>
#include <optional>

/// How far the ground may accelerate before the dam is no longer a block that stands flat on its base.
namespace damslip::sliding {

enum class Towards { downstream, upstream };

/// Ground acceleration |a_h| at which the dam tips about its toe (upstream: its heel): the moments of the static loads, of
/// the uplift and of inertia and water under it cancel there,
///
///     M_static + U-moment + a_h (m y_c + moment of M^w per a_h) = 0,
///
/// uplift as in the static state `before`. A dry rectangle b wide and h high: a_h = g b/h.
/// @param water, before, a_v  added mass; static state; vertical ground acceleration at the same instant [m/s^2]
/// @returns [m/s^2]; negative: it tips without an earthquake; infinite: no acceleration tips it that way
double tipping_acceleration(const Scene& scene, const AddedMassIntegral& water, const BaseState& before, double a_v,
                            Towards towards);

/// Constant horizontal ground accelerations at which the sliding block ends to be a model of the dam, without vertical
/// acceleration.
struct BaseLimits {
    /// About the toe, with the uplift of the joint that is open then where uplift.opening says one, else unchanged; there the
    /// block that rocks begins to [m/s^2].
    double tips = std::numeric_limits<double>::infinity();
    double tips_upstream = std::numeric_limits<double>::infinity(); ///< about the heel [m/s^2]
    /// Downstream: from here on the joint is open from heel to toe, and whatever bond it had is lost [m/s^2]. By the crack
    /// rule of the state; `none` and `static` say nothing of what the earthquake opens, `seismic-unchanged` is taken.
    double opens = std::numeric_limits<double>::infinity();
    /// Downstream: it slides here with the crack that the same acceleration opens, and the uplift in it, by the same rule as
    /// `opens`, and with the bond of the rest; smallest root of c A'(a) + mu N'(a) = T(a) [m/s^2]. The yield acceleration
    /// has the crack, uplift and bond of the static state.
    double yield_with_crack = std::numeric_limits<double>::infinity();
};

/// @param crack  in place of the scene's uplift.crack, if given
BaseLimits base_limits(const Scene& scene, const SeepageProfile& seepage = {},
                       std::optional<CrackRule> crack = std::nullopt);

} // namespace damslip::sliding
