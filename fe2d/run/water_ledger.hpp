#pragma once

#include "fe2d/run/node_order.hpp"
#include "fe2d/run/step_rock.hpp"
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

    /// One instant. Vectors without a word of their own are of the mesh's pressures, with the signs of a pressure
    /// equation: what the products of a step hold of the water, turned.
    struct Instant {
        Eigen::VectorXd phi, rate, accel; ///< φ, φ̇, φ̈
        Eigen::VectorXd flow;             ///< s² L_b φ
        Eigen::VectorXd mass_rate;        ///< s² Q_b φ̇
        Eigen::VectorXd mass_accel;       ///< s² Q_b φ̈
        Eigen::VectorXd boundary; ///< of the boundaries: s² (Q - Q_b) φ̈ + s² A φ̇ + s² (L - L_b) φ, on their rows
        Eigen::VectorXd face, face_velocity; ///< sHᵀu, sHᵀu̇ on the rows of the dam's face
        Eigen::VectorXd load;
        Eigen::VectorXd force; ///< F: all but the inertia s²Q φ̈
        FloorMotion floor;     ///< of a floor that is the rock's, times s: sv, sv̇; part of face, face_velocity, too
        Eigen::VectorXd jolt_rate; ///< change of φ̇ by contact impulses at its end; empty: none
        Eigen::VectorXd jolt;      ///< change of F by contact impulses at its end; empty: none
    };
    static double flow(const Instant& instant) { return 0.5 * instant.phi.dot(instant.flow); }              ///< [J/m]
    static double compression(const Instant& instant) { return 0.5 * instant.rate.dot(instant.mass_rate); } ///< [J/m]

    /// Motion of all unknowns in the order of the steps, and K z, M ż, M z̈ of it.
    struct Motion {
        const Eigen::VectorXd &z, &v, &a, &stiffness_z, &mass_v, &mass_a;
    };
    Instant instant(const Motion& motion, const FloorMotion& floor, double velocity_h, double velocity_v,
                    double displacement_v) const;

    /// Adds the step `before` -> `now`, what passes through the floor into the rock included; `before2` is the instant before these.
    void add(const StepConstants& constants, const Instant& before2, const Instant& before, const Instant& now,
             Energy& energy) const;

private:
    using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    Eigen::VectorXd water_of(const Eigen::VectorXd& vector) const;
    Eigen::VectorXd on_floor(const Eigen::VectorXd& mesh) const;
    Eigen::VectorXd on(const std::vector<Eigen::Index>& rows, const Eigen::VectorXd& mesh) const;

    Eigen::Index mesh_;
    std::vector<Eigen::Index> place_;         ///< of the water's unknowns in the order of the steps
    std::vector<Eigen::Index> boundary_rows_; ///< of the mesh's, bottom, surface and far end
    Rows end_mass_, damping_, end_stiffness_; ///< s² (Q - Q_b), s² A, s² (L - L_b) on these rows
    std::vector<Eigen::Index> face_rows_;     ///< of the mesh's: the dam's face, and a floor that is the rock's
    std::vector<Eigen::Index> floor_;         ///< unknowns of that floor
    double scale_;                            ///< s
    Rows coupling_;                           ///< s Hᵀ, these rows x all unknowns in the order of the steps
    Eigen::VectorXd velocity_x_, velocity_y_, displacement_y_;
};

} // namespace damslip::fe2d
