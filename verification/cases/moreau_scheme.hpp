#pragma once

#include "fe2d/solver/dense_product.hpp"
#include <Eigen/Core>

#include <vector>

/// Time stepping of contact on the level of velocities and impulses, as an independent check of DynamicContact; dense,
/// for small systems. Nothing of fe2d/contact and fe2d/time is used.
namespace damslip::verification {

/// M a + C v + K u = R(t) + B^T lambda. B: openings of the m pairs, then their slips, 2m x n; positive apart and
/// downstream.
struct DenseSystem {
    Eigen::MatrixXd mass, damping, stiffness, interface_map;
};

/// Moreau (1988), Jean (1999), Comput. Methods Appl. Mech. Engrg 177, 235-257: theta-method for everything smooth,
/// impulses P of a whole step for the contact,
///
///     M (v_1 - v_0) + dt [C v_t + K (u_0 + theta dt v_t)] = dt R_t + B^T P,   u_1 = u_0 + dt v_t,
///     v_t = theta v_1 + (1 - theta) v_0,   R_t = theta R_1 + (1 - theta) R_0
///
/// A pair whose gap, half a step ahead, is shut obeys 0 <= P_n, g_n' >= 0, P_n g_n' = 0 and Coulomb's law between P_t
/// and its slip rate at the end of the step (plastic impact); others have P = 0. The gap itself is never looked at again,
/// so nothing forces it to zero: where a displacement scheme has to invent accelerations, this one has impulses.
class MoreauScheme {
public:
    MoreauScheme(DenseSystem system, Eigen::VectorXd friction, double dt, double theta = 0.5);

    /// From u at rest.
    void start(const Eigen::VectorXd& displacement, const Eigen::VectorXd& load);
    /// @param load  R at the end of the step [N/m]
    void advance(const Eigen::VectorXd& load);

    const Eigen::VectorXd& displacement() const { return u_; }
    const Eigen::VectorXd& velocity() const { return v_; }
    const Eigen::VectorXd& impulse() const { return impulse_; } ///< P of the last step, 2m [N s/m]
    Eigen::VectorXd gaps() const { return system_.interface_map * u_; }

    // The problem of the last step: rates = free_rates() + delassus() impulse(), in pairs that are shut.
    const Eigen::MatrixXd& delassus() const { return delassus_; }
    const Eigen::VectorXd& free_rates() const { return free_rates_; }
    bool all_shut() const;

private:
    void gauss_seidel();

    DenseSystem system_;
    Eigen::VectorXd friction_;
    double dt_, theta_;
    Eigen::LLT<Eigen::MatrixXd> factor_; ///< M + theta dt C + theta^2 dt^2 K
    Eigen::MatrixXd response_;           ///< its inverse times B^T
    Eigen::MatrixXd delassus_;           ///< B times that
    Eigen::VectorXd u_, v_, load_, impulse_, free_rates_;
    std::vector<char> shut_;
};

} // namespace damslip::verification
