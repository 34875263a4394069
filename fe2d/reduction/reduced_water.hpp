#pragma once

#include "core/status.hpp"
#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/rock/reduced_rock.hpp"

#include <string>

namespace damslip::fe2d {

struct WaterReductionOptions {
    double wanted =
        0.02; ///< gate: largest error of the pressures on face and floor in between the sampled frequencies [-]
    double kept = 1e-4;     ///< what the basis may leave of a snapshot, of its energy over that of its load [-]
    int degrees = 8;        ///< polynomials along the face that it is shaken by
    int checks = 5;         ///< frequencies of the gate
    int largest_rounds = 6; ///< of adding snapshots where the gate is failed
    int largest_snapshots = 3000; ///< of the first round; their basis costs the cube of them
};

/// Acoustic water of a dam that slides (WaterBody) on a few shapes φ = V y, by rows of CoupledSystem:
///
///     M_w ÿ + G_w ẏ + K_w y - s Vᵀ(Hᵀu̇ + v̇) = ground loads,   p = s V ẏ
///
/// V has the pressures of the mesh in a basis of their own. An absorbing end (fe2d/fluid/coupled_system.hpp) lets energy leave and never
/// come as a whole only, as the channel beyond some depth column; so its layers keep their form on a column of few shapes, of which
/// the trace of V on the end is made, too. The reduced water is then as passive as that of the mesh, whatever is cut.
struct ReducedWater {
    Eigen::MatrixXd mass, damping, stiffness;               ///< -s²VᵀQV, -s²VᵀAV, -s²VᵀLV
    Eigen::VectorXd velocity_x, velocity_y, displacement_y; ///< loads per ground velocity and displacement
    Eigen::MatrixXd face;     ///< s V on face_pressures(): what pressure each shape's rate is there [Pa s/m]
    Eigen::MatrixXd floor;    ///< s V on FluidModel::floor; without rows: the floor is not the rock's
    Eigen::Index layers = 0;  ///< the last of the shapes, those of an absorbing end: they meet neither dam nor floor
    ReductionReport report;

    Eigen::Index count() const { return mass.rows(); }
    Eigen::Index pressures() const { return count() - layers; } ///< of the mesh, with mass
    /// A reduction that missed its gate says here how far it errs, what is allowed and what the user can do.
    Note missed_gate() const;
};

/// Basis: real and imaginary part of the pressures at frequencies up to the highest (three to the distance of two of the
/// water's cut-offs) and at two places beyond it, by Legendre polynomials along the face in its two directions, by the
/// ground's horizontal and vertical motion and, where the floor is the rock's, by polynomials along the floor; proper
/// orthogonal decomposition in the norm L + (ω_max/2)² Q. The frequencies have growing loads, e^{σt} with σ = ω/100: water
/// in a closed box without losses has no answer at its own frequencies.
///
/// Checked by the water itself, at frequencies in between, for two mixtures of the dam's motions and for the ground's; where
/// it fails the worst frequency's snapshots go in and a finer cut is made.
///
/// @param motions  φᵀH of the dam's motions, one row each (DamModes::face)
/// @param highest  ω up to which pressures are to be right [rad/s]
/// @throws std::runtime_error when the water cannot be factorised, or takes more than the largest number of snapshots
ReducedWater reduce_water(const WaterBody& water, const Eigen::MatrixXd& motions, double highest,
                          const WaterReductionOptions& options = {});

} // namespace damslip::fe2d
