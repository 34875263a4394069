#pragma once

#include "fe2d/run/block_products.hpp"
#include "fe2d/run/dynamic_operator.hpp"
#include "fe2d/run/static_contact.hpp"
#include "fe2d/time/energy.hpp"

#include <map>
#include <memory>
#include <set>

namespace damslip::fe2d {

/// Ground acceleration of one instant, as records have it.
struct GroundAcceleration {
    double h = 0.0; ///< positive upstream: drives the dam downstream [m/s²]
    double v = 0.0; ///< positive up [m/s²]
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
    double largest_residual = 0.0;    ///< complementarity residual over the static normal force N' [-]
    int factorisations = 0;           ///< step sizes used
    double contact_seconds = 0.0;     ///< in the contact solver
};

/// HHT-α steps of dam, rock and contact (2-25), with the contact problem solved exactly in each. Equations:
/// DynamicOperator. Contact forces are weighted like internal forces, (1+α)λ₁ - αλ₀, slip damping and ground motion
/// too. A pair that sticks keeps its slip to the last bit, so nothing creeps.
///
/// Where the structure slides far, the opening is what the displacements and the present slip make it at the start of
/// each step, so the dam follows the bent surface of the rock; forces pass through the P of the last place where the
/// operators were made, at most `update_share` of an element away, so that a step's work is exact.
class DynamicContact {
public:
    /// @param load  static loads, constant during the motion
    /// @param start  in equilibrium under them; u, contact and rock are taken over, v = a = 0
    DynamicContact(const ContactStructure& structure, RunDamping damping, const Scheme& scheme, SplitLoad load,
                   const StaticState& start, const ContactMemory& memory, const ContactOptions& options = {});

    /// One step to the given ground acceleration. @returns how the contact was solved; when unresolved the step has
    /// been made with the best state found.
    ContactReport advance(double dt, const GroundAcceleration& ground, const ContactLaw& law);

    const DynamicState& state() const { return state_; }
    /// False where the dam would leave the meshed plane: the step was not made (ContactStructure::slides_far()).
    bool within_reach() const;
    const Energy& energy() const { return energy_; }
    double energy_imbalance() const { return energy_.imbalance(energy_start_); } ///< [J/m]
    double energy_scale() const { return energy_scale_; }                        ///< largest term so far [J/m]
    const DynamicCounts& counts() const { return counts_; }
    const ContactStructure& structure() const { return structure_; }
    std::size_t bytes() const;

private:
    /// What the equation of motion's forces at one instant need for their work, see add_energy().
    struct Forces {
        Eigen::VectorXd dam;        ///< a_M M v + K u - R
        Eigen::VectorXd v, a;       ///< of the dam
        Eigen::VectorXd rock;       ///< K_c r - f_r
        Eigen::VectorXd rock_v;     ///< of the rock
        Eigen::VectorXd contact;    ///< λ
        double slip_rate = 0.0;     ///< ωᵀ ġ_t
        double mean_velocity = 0.0; ///< m̂ᵀ v
    };
    DynamicOperator& operator_of(double dt);
    void multiply(const StepConstants& constants);
    void gather_forces(Forces& forces) const;
    void add_energy(const StepConstants& constants, const Eigen::VectorXd& gap_step,
                    const Eigen::VectorXd& force_before);
    void right_hand_side(const StepConstants& constants, const GroundAcceleration& ground);
    void follow_slip(DynamicOperator& op);
    Eigen::VectorXd opening_at(double slip) const;
    void slide_to(double slip, const Pairing::Matrix& trace);

    const ContactStructure& structure_;
    RunDamping damping_;
    Scheme scheme_;
    SplitLoad load_;
    ContactOptions options_;
    SlipDamping slip_damping_;
    Pairing::Matrix trace_;          ///< P of the operators; empty: the identity
    double trace_slip_ = 0.0;        ///< slip it was made for [m]
    Eigen::VectorXd geometric_rest_; ///< see opening_at() [m]
    Eigen::VectorXd rock_load_;      ///< f_r [N/m]
    Eigen::VectorXd rock_rest_;      ///< K_c⁻¹ f_r
    Eigen::VectorXd load_jump_;      ///< force on the rock that moved with the last change of P, for the energy [N/m]
    std::map<double, std::unique_ptr<DynamicOperator>> operators_;
    std::set<const DynamicOperator*> slid_operators_; ///< those whose contact problem has the present P
    double last_dt_ = 0.0;
    double normal_force_ = 0.0; ///< static N', the scale of residuals [N/m]

    DynamicState state_;
    BlockProducts block_products_;
    Products products_;          ///< K u, K y, M v, M a of the state, y = b_K (cv v + ca a)
    Eigen::VectorXd rock_force_; ///< K_c r
    Eigen::VectorXd deformation_, combined_, known_, rock_gap_, stuck_, gap_, dam_interface_; ///< work space
    Eigen::VectorXd elastic_; ///< elastic part of the tangential gaps before the step [m]
    Eigen::VectorXd rate_t_;  ///< tangential gap rates ġ_t
    Eigen::VectorXd accel_t_; ///< and accelerations
    DynamicOperator::Free free_;
    ContactSolution solution_;
    Products before_; ///< products of the state before, for the energy
    Eigen::VectorXd rock_force_before_, u_before_, du_, dr_;
    Forces forces_, forces_before_, forces_before2_;
    GroundAcceleration ground_before_;
    Energy energy_, energy_start_;
    double energy_scale_ = 0.0;
    double stored_ = 0.0; ///< in soft normal contact, part of the strain energy [J/m]
    DynamicCounts counts_;
};

} // namespace damslip::fe2d
