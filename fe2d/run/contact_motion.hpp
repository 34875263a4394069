#pragma once

#include "core/version.hpp"
#include "fe2d/contact/joint_water.hpp"
#include "fe2d/run/contact_planes.hpp"
#include "fe2d/run/static_contact.hpp"
#include "fe2d/time/energy.hpp"
#include "fe2d/time/scheme.hpp"

#include <Eigen/Core>
#include <utility>

namespace damslip::fe2d {

/// Ground acceleration of one instant, as records have it.
struct GroundAcceleration {
    double h = 0.0; ///< positive upstream: drives the dam downstream [m/s²]
    double v = 0.0; ///< positive up [m/s²]
    double velocity_h = 0.0, velocity_v = 0.0,
           displacement_v = 0.0;       ///< integrals, felt by acoustic water [m/s, m/s, m]
    double drag_h = 0.0, drag_v = 0.0; ///< a_M times the velocities, where mass damping resists the total one [m/s²]
};

/// Motion relative to the ground and contact at one instant.
struct DynamicState {
    double time = 0.0;                    ///< [s]
    Eigen::VectorXd u, v, a;              ///< of the dam, in its node order [m, m/s, m/s²]
    Eigen::VectorXd rock, rock_v, rock_a; ///< of the rock's contact nodes, plane; zero for a rigid base
    ContactMemory contact;
    GroundAcceleration ground;
};

/// Figures of a run so far.
struct DynamicCounts {
    int steps = 0, contact_iterations = 0, largest_iterations = 0, unresolved = 0;
    int by_path[5] = {0, 0, 0, 0, 0}; ///< steps by ContactPath
    int landings = 0;                 ///< steps in which some gap came to be held: shut or stuck
    int halved = 0;                   ///< steps cut in two because their contact was not resolved otherwise
    int refined = 0;                  ///< steps cut in two because of their local error (StepControl)
    double largest_residual = 0.0;    ///< complementarity residual over the static normal force N' [-]
    int factorisations = 0;           ///< step sizes used
    double contact_seconds = 0.0;     ///< in the contact solver

    /// A step that was made. @param residual  of its contact over the static normal force [-]
    void add(const ContactReport& report, double residual);
    DynamicCounts& operator+=(const DynamicCounts& other); ///< of the run before
};

/// Largest |mean slip| of each plane since the start of a motion, over all steps that were made, sub-steps and halves
/// included.
class LargestSlips {
public:
    /// @param planes  outlive this @param start  slips of all pairs before the motion [m]
    LargestSlips(const ContactPlanes& planes, Eigen::VectorXd start);
    void look(const Eigen::VectorXd& slip); ///< of all pairs after a step [m]
    void count_from(Eigen::VectorXd start) { start_ = std::move(start); }
    double of(Eigen::Index plane) const { return largest_[plane]; } ///< [m]

private:
    const ContactPlanes& planes_;
    Eigen::VectorXd start_, largest_, since_; ///< the last: work space
};

/// What a run of dam and contact shows while it goes on, however its steps are made.
class ContactMotion {
public:
    virtual ~ContactMotion() = default;
    virtual const DynamicState& state() const = 0;
    virtual const ContactStructure& structure() const = 0;
    virtual const Energy& energy() const = 0;
    virtual double energy_imbalance() const = 0; ///< [J/m]
    virtual double energy_scale() const = 0;     ///< largest term so far [J/m]
    virtual const DynamicCounts& counts() const = 0;
    virtual const LargestSlips& largest_slips() const = 0;
    virtual double static_normal_force() const = 0; ///< N' before the motion [N/m]
    virtual std::size_t bytes() const = 0;
};

/// Water under the dam that follows the opening of the base, or loses its drains.

/// The law of uplift.opening and drains.lost_at_slip; null: the water does not follow, and nothing asks for the crack afterwards.
/// @param uplift  before the earthquake @param cracked  the same with cracks
std::unique_ptr<CrackWater> base_water(const Scene& scene, const Plane& base, const PressureProfile& uplift,
                                       const CrackedUplift& cracked, const std::optional<DrainLoss>& drain_loss);

/// Pressure of the reservoir's waves at the heel, beyond that of the water at rest [Pa].
class HeelWaves {
public:
    /// @param water  acoustic; null: the added mass speaks for it @param added_mass  of the face; empty: none
    HeelWaves(const Scene& scene, const ContactStructure& structure, const WaterBody* water,
              const std::function<double(Point, double face_angle)>& added_mass);
    double pressure(const DynamicState& state) const;

private:
    Eigen::Index potential_ = -1;           ///< unknown of the water at the heel
    double scale_ = 0.0;                    ///< of its rate: p = scale φ̇ [Pa s/m]
    Eigen::Index heel_ = -1;                ///< first unknown of the dam's heel
    double mass_ = 0.0;                     ///< added mass of the face at the heel [kg/m²]
    Eigen::Vector2d into_water_{-1.0, 0.0}; ///< normal of the face
};

/// Passes over the vectors of a step that read each of them once, four numbers at a time where the processor can. Each number, and
/// each sum, is that of the same formula written with one Eigen expression after the other, to the last bit.

/// One step of Newmark's formulas: x, v, a of the start become those of the end. @param step  Δx
void move_on(const StepConstants& constants, const Eigen::VectorXd& step, Eigen::VectorXd& x, Eigen::VectorXd& v,
             Eigen::VectorXd& a);

/// A term of a sum of vectors.
struct Term {
    double factor;
    const Eigen::VectorXd& vector;
};

/// b = b - k + l + Σ factor vector, in this order, of four terms.
void add_to_load(const Eigen::VectorXd& k, const Eigen::VectorXd& l, const Term (&terms)[4], Eigen::VectorXd& b);

/// b = load + w (h₁ x - v₁ y) - α (h₀ x - v₀ y), w = 1 + α: loads at rest and by the ground's acceleration at the end (1) and the
/// start (0) of a step.
void ground_load(double alpha, const GroundAcceleration& start, const GroundAcceleration& end,
                 const Eigen::VectorXd& load, const Eigen::VectorXd& x, const Eigen::VectorXd& y, Eigen::VectorXd& b);

/// g = h x - v y, f = d m + k - load - g: the ground's load at one instant, and the forces of the equation of motion.
void instant_forces(const GroundAcceleration& ground, double d, const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                    const Eigen::VectorXd& m, const Eigen::VectorXd& k, const Eigen::VectorXd& load, Eigen::VectorXd& g,
                    Eigen::VectorXd& f);

/// What the work ledger multiplies of the dam in one step; water left out of all but the products.
struct WorkVectors {
    const Eigen::VectorXd& step;                                          ///< Δu
    const Eigen::VectorXd &velocity, &velocity_before, &velocity_before2; ///< v₁, v₀, v₋₁
    const Eigen::VectorXd &accel, &accel_before;                          ///< a₁, a₀
    const Eigen::VectorXd &force, &force_before2;                         ///< of the equation of motion, F₁, F₋₁
    const Eigen::VectorXd &ground, &ground_before;                        ///< loads by the moving ground
    const Eigen::VectorXd& load;                                          ///< at rest
    const Eigen::VectorXd &stiffness, &stiffness_before;                  ///< K u₁, K u₀
    const Eigen::VectorXd& mass_rate;                                     ///< M v₁
    const Eigen::VectorXd &mass_accel, &mass_accel_before;                ///< M a₁, M a₀
    const Eigen::VectorXd &dam_mass_rate, &dam_mass_rate_before;          ///< M_dam v₁, M_dam v₀
};

/// Their inner products, ΔKu = K u₁ - K u₀ and so on.
struct WorkSums {
    double kinetic = 0.0;                       ///< v₁ · M v₁
    double mass_damping = 0.0;                  ///< Δu · (M_dam v₁ + M_dam v₀)
    double stiffness_damping = 0.0;             ///< ΔKu · (v₁ + v₀)
    double load = 0.0, ground = 0.0;            ///< Δu · R, Δu · (R_g1 + R_g0)
    double step_inertia = 0.0;                  ///< Δu · ΔMa
    double change_inertia = 0.0;                ///< Δa · ΔMa
    double inertia = 0.0, inertia_before = 0.0; ///< a₁ · M a₁, a₀ · M a₀
    double force = 0.0, force_before2 = 0.0;    ///< Δu · F₁, Δu · F₋₁
    double rate = 0.0, rate_before2 = 0.0;      ///< v₁ · ΔKu, v₋₁ · ΔKu
    friend bool operator==(const WorkSums&, const WorkSums&) = default;
};

/// @param level  the same bits on every level
WorkSums work_sums(const WorkVectors& vectors, VectorLevel level = vector_level());

} // namespace damslip::fe2d
