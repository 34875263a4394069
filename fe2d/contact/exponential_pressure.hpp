#pragma once

namespace damslip::fe2d {

/// Soft contact pressure that falls with the clearance g of the two sides (Goldgruber 2015, section 6.3; "exponential
/// pressure-overclosure" of Abaqus):
///
///     p = p0/(e - 1) z (exp z - 1),   z = 1 - g/c0;   p = 0 for g >= c0
///
/// p0 at zero clearance, zero from the clearance c0 on, with a zero slope there: p has a continuous derivative, falls
/// everywhere in g < c0 and has the energy w = ∫ p dg, so it is conservative. c0 -> 0 is hard contact.
///
/// At the penetration z = `deepest` (p = 5e18 p0) and beyond the law goes on along its tangent, so nothing overflows.
class ExponentialPressure {
public:
    static constexpr double deepest = 40.0;

    /// @param at_zero_clearance  p0, > 0 [Pa]
    /// @param at_zero_pressure   c0, > 0 [m]
    ExponentialPressure(double at_zero_clearance, double at_zero_pressure);

    double pressure(double clearance) const;  ///< p, >= 0 [Pa]
    double stiffness(double clearance) const; ///< -dp/dg, >= 0 [N/m³]
    double energy(double clearance) const;    ///< w, from the clearance on, >= 0 [J/m²]
    double clearance(double pressure) const;  ///< g of a pressure > 0 [m]; the inverse of pressure()
    double range() const { return range_; }   ///< c0 [m]

private:
    double unit_;  ///< p0/(e - 1) [Pa]
    double range_; ///< c0 [m]
};

} // namespace damslip::fe2d
