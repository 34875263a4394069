#pragma once

#include "fe2d/run/node_order.hpp"
#include "fe2d/run/water_body.hpp"
#include "fe2d/time/energy.hpp"
#include "fe2d/time/scheme.hpp"

namespace damslip::fe2d {

/// The water's part of the work ledger of a sliding run, see CoupledEnergy: kinetic ½ ψᵀL_b ψ and strain ½ pᵀQ_b p of the
/// water in the mesh, what its boundaries take, numerical dissipation of its own rows and of the coupling. Vectors of
/// states are in the order of the steps.
class WaterLedger {
public:
    WaterLedger(const WaterBody& body, const NodeOrder& order);

    /// One instant: what the rows of the water say.
    struct Instant {
        Eigen::VectorXd z, v, a; ///< of all unknowns
        Eigen::VectorXd load;    ///< on the mesh's rows, turned
        Eigen::VectorXd force;   ///< F of the mesh's rows, turned: all but the inertia s²Q φ̈
        Eigen::VectorXd jolt;    ///< change of F by contact impulses at its end; empty: none
    };
    double flow(const Instant& instant) const;        ///< ½ ψᵀL_b ψ [J/m]
    double compression(const Instant& instant) const; ///< ½ pᵀQ_b p [J/m]
    Instant instant(const Eigen::VectorXd& z, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double velocity_h,
                    double velocity_v, double displacement_v) const;

    /// Adds the step `before` -> `now`; `before2` is the instant before these.
    void add(const StepConstants& constants, const Instant& before2, const Instant& before, const Instant& now,
             Energy& energy) const;

private:
    Eigen::VectorXd water_of(const Eigen::VectorXd& vector) const;

    const WaterBody& body_;
    Eigen::Index mesh_;
    std::vector<Eigen::Index> place_;                       ///< of the water's unknowns in the order of the steps
    Eigen::SparseMatrix<double, Eigen::RowMajor> coupling_; ///< s Hᵀ, mesh's rows x all unknowns in that order
    SparseMatrix mass_, stiffness_;                         ///< s² Q_b, s² L_b, mesh x mesh
    SparseMatrix end_mass_, damping_, end_stiffness_;       ///< s² (Q - Q_b), s² A, s² (L - L_b), mesh's rows
    Eigen::VectorXd velocity_x_, velocity_y_, displacement_y_;
};

} // namespace damslip::fe2d
