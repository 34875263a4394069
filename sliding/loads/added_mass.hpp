#pragma once

#include "scene/added_mass_formulas.hpp"
#include "scene/scene.hpp"
#include "sliding/loads/static_loads.hpp"

#include <functional>
#include <optional>

namespace damslip::sliding {

using damslip::WaterColumn;

double sound_speed(const WaterColumn& water);      ///< c = sqrt(K/rho) [m/s]
double reservoir_period(const WaterColumn& water); ///< T_r = 4h/c of the water alone [s]

/// Added mass m_n per area of wet face, for the pressure p = m_n (n . acceleration of the face): only the acceleration
/// normal to the face moves water, Goldgruber (2015) eq. (3-24), (3-29).
///
/// - Westergaard (1933), simplified (3-4): 7/8 rho sqrt(h z); any face, m_n = m.
/// - Westergaard (1933), series (3-1): (8 rho h/pi^2) sum over odd n of sin(n pi z/2h)/(n^2 c_n),
///   c_n = sqrt(1 - 16 rho h^2/(n^2 K T^2)), T the period of the excitation, none: infinite (incompressible water);
///   m_n = m. Summed to round-off (1e-14 relative).
/// - Zangar (1952), (3-8, 3-9): C rho h, C = (C_m/2)[zeta(2 - zeta) + sqrt(zeta(2 - zeta))], C_m = 0.73 (1 - phi/90 deg)
///   or a table (linear between its rows, constant beyond them).
/// - Goldgruber & Feldbacher (2013), (3-10...3-14): 0.707 rho h (1 - 0.011 phi) cos(A)^(0.6 + 0.005 phi),
///   A = (pi/2)(y - h_m)/(h - h_m), y = h - z above the reservoir bottom, h_m = h sqrt(phi/1000), phi in degrees, 0...30.
/// The last two are pressures per *horizontal* acceleration: m_n = m/cos(phi) reproduces them
/// (InclinedFaceRule::normal_component); InclinedFaceRule::printed takes m_n = m. InclinedFaceRule::horizontal has the m_n of
/// the first; integrate_added_mass() leaves out the vertical part of its push.
/// Other formulas are those of their rows (AddedMassRow::per_area).
///
/// @param depth       z below the water surface [m]; 0 at and above it, taken as h below the bottom
/// @param face_angle  phi from the vertical of the piece of the face that the point lies on [rad], positive: it leans away
///                    from the water. An overhanging piece (phi < 0) takes the coefficients of a vertical one, a
///                    horizontal one (phi = 90 deg) carries none with a Zangar table.
/// @returns m_n [kg/m^2]
/// Errors: InputError for T <= T_r (the first term of the series has no real value: the water resonates at T_r, below
/// it the incompressible picture of a mass is wrong) and for Goldgruber & Feldbacher beyond 30 degrees.
double added_mass_per_area(const AddedMass& method, const WaterColumn& water, double depth, double face_angle);

/// sum over odd n of sin(n pi zeta/2)/(n^2 sqrt(1 - tau/n^2)) with tau = (T_r/T)^2, 0 <= tau < 1, 0 <= zeta <= 1 [-].
double westergaard_series(double zeta, double tau);

/// Does compressible water matter? Omega_r = (c/4h)/f_dam, Goldgruber (2015) eq. (3-36), (3-37): below 2 it does (Hall
/// & Chopra).
struct CompressibilityCriterion {
    double frequency_ratio = 0.0;      ///< Omega_r [-]
    bool compressible_matters = false; ///< Omega_r < 2: use an acoustic reservoir
};
CompressibilityCriterion compressibility_criterion(const WaterColumn& water, double dam_frequency_hz);

/// The added mass of a whole upstream face, so that a rigid acceleration a of the dam meets the water force -M^w a.
/// n is the unit normal of the face (its sense does not matter), r the point [m], m_n as in added_mass_per_area.
struct AddedMassIntegral {
    double xx = 0.0, xy = 0.0,
           yy = 0.0;         ///< M^w = integral of m_n n n^T dS [kg/m]; vertical face: xx only; leaning away: xy < 0
    Point horizontal_moment; ///< integral of -y n_x m_n n dS [kg]: moment about the heel of the horizontal part of M^w
                             ///< a, per a
    Point vertical_moment;   ///< integral of  x n_y m_n n dS [kg]: of the vertical part
    /// Integral of m_n (n_x y - n_y x)^2 dS [kg m]: moment about the heel that resists a rotation about it, per angular
    /// acceleration.
    double rotation = 0.0;
    /// Height above the heel of the horizontal water force under a horizontal acceleration [m]; 0 without added mass.
    double acting_height() const { return xx > 0.0 ? -horizontal_moment.x / xx : 0.0; }
};

/// Integrated to 1e-13 relative (tanh-sinh rule in depth on every straight piece, which takes the root at the surface).
/// The upstream face only, between the reservoir bottom (the heel's level) and the surface or the crest; kinked faces
/// use each piece's own angle. The tailwater has no added mass: the theory has none there, its depth is small.
/// @param share  of the acceleration at a level y over that of the ground; null: the dam moves as one [-]
AddedMassIntegral integrate_added_mass(const AddedMass& method, const WaterColumn& water,
                                       const Polyline& upstream_face,
                                       const std::function<double(double)>& share = nullptr);

/// The scene's added mass with the water at `level` above the heel; all zero without a reservoir, for level <= 0 and
/// for reservoir.model = "hydrostatic".
AddedMassIntegral scene_added_mass(const Scene& scene, std::optional<double> level);

/// Water force on the dam that accelerates rigidly by (ax, ay) [m/s^2]: -M^w a.
FaceLoad hydrodynamic_force(const AddedMassIntegral& mass, double ax, double ay);

} // namespace damslip::sliding
