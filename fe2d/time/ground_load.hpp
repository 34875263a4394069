#pragma once

#include "records/record.hpp"

#include <Eigen/Core>

#include <vector>

namespace damslip::fe2d {

/// Ground acceleration, velocity and displacement at one time; a_h positive upstream, a_v positive up, as in the record.
struct GroundState {
    double accel_h = 0.0, accel_v = 0.0;               ///< [m/s^2]
    double velocity_h = 0.0, velocity_v = 0.0;         ///< integrals from zero [m/s]
    double displacement_h = 0.0, displacement_v = 0.0; ///< integrals of these from zero [m]
};

/// Acceleration linear between samples, zero before the first and after the last; velocity and displacement its exact
/// integrals. After the end of the motion the velocity stays.
class GroundHistory {
public:
    explicit GroundHistory(const GroundMotion& motion);
    GroundState at(double time) const;
    double duration() const { return duration_; } ///< [s]

private:
    double dt_ = 0.0, duration_ = 0.0;
    std::vector<GroundState> samples_;
};

/// Load of the motion on the structure as it moves relative to the ground. With r_x, r_y rigid translations in x (downstream)
/// and y (up) and the ground acceleration in these axes a_g = (-a_h, +a_v):
///
///     R = R_static - M r a_g = R_static + M r_x a_h - M r_y a_v,
///
/// M the mass of everything that moves, added mass included. Where the mass-proportional damping resists the total velocity,
/// - a_M M_s (v + r v_g) on the structure's own mass, its second part is a load too:  + a_M M_s (r_x v_h - r_y v_v).
struct GroundLoad {
    Eigen::VectorXd still;              ///< R_static [N/m]
    Eigen::VectorXd mass_x, mass_y;     ///< M r_x, M r_y [kg/m]
    Eigen::VectorXd damped_x, damped_y; ///< a_M M_s r_x, a_M M_s r_y [kg/(m s)]; empty: relative velocity only
    Eigen::VectorXd velocity_x,
        velocity_y; ///< load of the water per ground velocity in these axes (CoupledSystem); empty: no water
    Eigen::VectorXd displacement_y; ///< and per vertical displacement

    void evaluate(const GroundState& ground, Eigen::VectorXd& load) const;
};

} // namespace damslip::fe2d
