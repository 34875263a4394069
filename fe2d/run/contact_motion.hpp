#pragma once

#include "fe2d/run/static_contact.hpp"
#include "fe2d/time/energy.hpp"

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

} // namespace damslip::fe2d
