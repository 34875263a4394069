#pragma once

namespace damslip::sliding {

/// A block that still moves when the record ends: the ground accelerates no more, so its excess is minus the yield.
struct Coasting {
    double slip = 0.0; ///< [m]
    bool stops = true; ///< within the longest time
};

/// @param rate  per factor, when the record ends [m/s]
/// @param yield  at rest of the ground [m/s^2]; factor: slip acceleration per excess [-]
/// @param longest  run-out at most [s]
inline Coasting coast(double rate, double yield, double factor, double longest)
{
    if (rate <= 0.0) return {};
    if (yield > 0.0 && rate <= yield * longest) return {factor * rate * rate / (2.0 * yield), true};
    return {factor * longest * (rate - 0.5 * yield * longest), false};
}

} // namespace damslip::sliding
