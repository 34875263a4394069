#pragma once

/// Plane failure of a rock slope with a vertical tension crack, as printed: Hoek & Bray (1981), Rock Slope Engineering,
/// 3rd ed., ch. 7; Wyllie & Mah (2004), 4th ed., ch. 6. Level ground behind the crest. Forces per metre of slope, SI.
namespace damslip::exact {

struct PlaneFailure {
    double height = 0.0;          ///< H [m]
    double face_dip = 0.0;        ///< psi_f [rad]
    double plane_dip = 0.0;       ///< psi_p [rad]
    double crack_depth = 0.0;     ///< z [m]
    double water_depth = 0.0;     ///< z_w [m]
    double unit_weight = 0.0;     ///< gamma_r [N/m^3]
    double water_weight = 9810.0; ///< gamma_w [N/m^3]
    double cohesion = 0.0;        ///< [Pa]
    double friction_angle = 0.0;  ///< phi [rad]
    bool crack_in_face = false;   ///< else in the ground behind the crest
};

double plane_area(const PlaneFailure& p);   ///< A = (H - z) / sin psi_p
double plane_weight(const PlaneFailure& p); ///< W by the printed formula of either position of the crack
double plane_uplift(const PlaneFailure& p); ///< U = gamma_w z_w A / 2
double crack_thrust(const PlaneFailure& p); ///< V = gamma_w z_w^2 / 2

/// FS = [c A + (W cos psi - U - V sin psi) tan phi] / (W sin psi + V cos psi); a horizontal force k W out of the slope
/// adds -k W sin psi to the bracket and k W cos psi below.
double plane_factor(const PlaneFailure& p, double k = 0.0);

/// k at which plane_factor is 1.
double plane_yield_coefficient(const PlaneFailure& p);

} // namespace damslip::exact
