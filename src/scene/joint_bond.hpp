#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace damslip {

/// How a joint loses its cohesion: as the scene says, else by fracture energy where it has one, else all together.
BondLoss bond_loss(const Contact& strength);
/// Has the joint a bond whose fracture takes work? (FE)
bool breaks_by_energy(const Contact& strength);

/// Characteristic length ℓ_ch = E' G/f² of a bond between two bodies [m]: the process zone at a crack's tip is about
/// 0.9 ℓ_ch long (Bažant & Oh 1983).
/// @param modulus  harmonic mean of E/(1 - nu²) of both sides [Pa] @param energy  [N/m] @param strength  [Pa], > 0
double characteristic_length(double modulus, double energy, double strength);

/// Longest element on a bonded joint: ℓ_ch/4 of its more brittle mode, in the earthquake (f and G times
/// Bond::dynamic_increase) [m].
double bond_element_length(const Contact& strength, double modulus);

/// Strengths at rest that elements of some length can carry: f and c, at most √(E' G/(4h d)) with the energies kept (Bažant & Oh
/// 1983), d = Bond::dynamic_increase.
struct CarriedBond {
    double tensile_strength = 0.0; ///< [Pa]
    double cohesion = 0.0;         ///< [Pa]
    bool lowered = false;
};
CarriedBond carried_bond(const Contact& strength, double modulus, double element_length);

/// E' of the joint: harmonic mean of both sides' E/(1 - nu²); a rigid side counts as the other [Pa]. None: no modulus known.
std::optional<double> joint_modulus(const Scene& scene, bool base);

/// Words of uplift.opening, in the order of the guidelines that are for them.
const std::vector<std::pair<std::string, OpeningWater>>& opening_waters();

/// As written in a scene file: "full".
const std::string& word(OpeningWater rule);

/// The uplift hangs on drains that shear off while the base slips.
bool drains_shear_off(const Scene& scene);
/// The water under the base does not stay as it is: it follows the opening, or its drains shear off.
bool base_water_changes(const Scene& scene);

/// Key of the first joint law in the scene that goes beyond Coulomb friction; empty where there is none.
std::string first_joint_law(const Scene& scene);

/// The scene with rigid sticking and hard contact, everything else the same; none where that is its law already.
std::optional<Scene> with_exact_contact(const Scene& scene);

/// Coulomb's friction of a joint over the slip it has accumulated in both directions, as the scene's Contact gives it: one value,
/// peak and residual value, or a table; constant between two of its points, or linear.
class FrictionOverSlip {
public:
    explicit FrictionOverSlip(const Contact& contact);

    bool constant() const { return constant_; }          ///< neither residual value nor table is given
    double peak() const { return points_.front().y; }    ///< of a joint that has not slipped [-]
    double residual() const { return points_.back().y; } ///< in the end [-]
    double at(double slip) const;                        ///< [-]; at a step its value before it @param slip  >= 0 [m]

    /// The same piece by piece.
    struct Piece {
        double from_slip = 0.0; ///< [m]; two pieces from 0 on: the second holds as soon as the joint moves at all
        double friction = 0.0;  ///< there [-]
        double slope = 0.0;     ///< d mu / d slip up to the next piece [1/m]
    };
    std::vector<Piece> pieces() const;

private:
    std::vector<Point> points_; ///< x = slip [m], ascending from 0, y = mu [-]
    Interpolation path_;
    bool constant_;
};

} // namespace damslip
