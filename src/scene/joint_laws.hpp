#pragma once

#include <optional>
#include <string>

/// What a joint may have beyond Coulomb's friction and cohesion. Each is absent until the scene names it.
namespace damslip {

/// When a bonded joint loses its cohesion.
enum class BondLoss {
    together, ///< all at once, when |T| exceeds mu N' + c A over the closed length: the rigid block's rule
    fracture, ///< by the work of its fracture energies, pair by pair
    pairs     ///< pair by pair at first slip, without any work: depends on the mesh
};

/// How a damaged bond unloads.
enum class BondUnloading {
    origin, ///< to no stress at no opening and no slip: stiffness is lost
    plastic ///< with the first stiffness: opening and slip remain
};

/// How a bond loses its strength f beyond the peak, w its opening or slip.
enum class BondSoftening {
    linear,     ///< f (1 - w f/(2G))
    exponential ///< f exp(-w f/G), down to a thousandth of f
};

/// Bond of a joint beside its cohesion. FE runs only, but for `loss`.
struct Bond {
    std::optional<BondLoss> loss;         ///< none: `fracture` with shear energy, else `together`
    double tensile_strength = 0.0;        ///< f_t [Pa]
    std::optional<double> tension_energy; ///< G_I, to open 1 m² [N/m]; needed with f_t where `fracture`
    std::optional<double> shear_energy;   ///< G_II, to shear 1 m² [N/m]
    BondUnloading unloading = BondUnloading::origin;
    BondSoftening softening = BondSoftening::linear;
    double dynamic_increase = 1.0; ///< strengths and energies in an earthquake over those at rest [-]
};

/// Friction that falls (or rises) with the rate of slip: mu_k + (mu - mu_k) exp(-|v| / v_c), mu over slip as without it.
struct RateFriction {
    double kinetic_ratio = 1.0;                ///< mu_k / mu; 1: no rate dependence [-]
    std::optional<double> characteristic_rate; ///< v_c [m/s]
    std::optional<double> relaxation_time;     ///< tau_mu of the lag behind mu(v) [s]
    std::optional<double> relaxation_slip;     ///< d_mu of it [m]

    bool active() const { return kinetic_ratio != 1.0; }
};

/// Pressure of the water in the part of a joint that opens while it shakes.
enum class OpeningWater {
    unchanged, ///< as before the earthquake
    zero,      ///< none where open, back when shut
    full,      ///< full head of the wet end to the tip, from there linear to the pressure that was
    mouth,     ///< full head as far as the water has come, at a given speed
    reynolds   ///< of thin flow along the crack
};

enum class WaterAfter { unchanged, full };       ///< full: full head of the wet end on all that has cracked
enum class WetEndPressure { still, with_waves }; ///< of the reservoir at the heel: without or with that of its waves

/// How the water in the joint follows its opening.
struct JointWaterLaw {
    OpeningWater opening = OpeningWater::unchanged;
    WaterAfter after = WaterAfter::unchanged;
    std::optional<double> mouth_speed; ///< v_w of `mouth` [m/s]
    // Of `reynolds`.
    double clearance = 0.2e-3; ///< w_0 of the shut joint [m]
    double viscosity = 1.3e-3; ///< eta [Pa s]
    double cavitation = -99e3; ///< p_cav, against the atmosphere [Pa]
    WetEndPressure wet_end = WetEndPressure::still;

    /// Does it differ from water that stays as it was, or ask for the crack afterwards?
    bool follows() const { return opening != OpeningWater::unchanged || after != WaterAfter::unchanged; }
};

enum class AnchorForceRule { prestress, yield }; ///< N in limit equilibrium: P_0, or f_y A_b

/// A row of anchors through a joint, per metre of dam length.
struct Anchor {
    std::string name;
    std::string joint;                    ///< name of the lift joint; empty: the base
    double distance = 0.0;                ///< where it crosses the joint, from its upstream end [m]
    double inclination = 0.0;             ///< psi from the joint's normal; positive: slip downstream stretches it [rad]
    double free_length = 0.0;             ///< L; of a grouted bar its debonded length [m]
    double area = 0.0;                    ///< A_b [m²/m]
    double young_modulus = 200e9;         ///< E_b [Pa]
    double yield_strength = 0.0;          ///< f_y [Pa]
    std::optional<double> rupture_strain; ///< eps_u [-]; none: it does not snap
    double prestress = 0.0;               ///< P_0 [N/m]; 0: passive
    bool dowel = false;                   ///< grouted: it also resists across its axis
    AnchorForceRule limit_force = AnchorForceRule::prestress; ///< of limit equilibrium; a passive one: yield
};

} // namespace damslip
