#pragma once

#include "fe2d/run/contact_structure.hpp"

namespace damslip::fe2d {

/// What static loads on acoustic water's face (or on its floor) find in the modes that are left out: of the residual
/// displacements A = G H, G the flexibility without the modes kept, H the loads by unit pressures, one column each.
struct FaceResidual {
    Eigen::MatrixXd flexibility; ///< Hᵀ A
    Eigen::MatrixXd mass;        ///< Aᵀ M A
    Eigen::MatrixXd on_plane;    ///< D A, 2m rows
    Eigen::VectorXd crest;       ///< of A
};

/// Motions of the dam held by nothing: K φ = ω² M φ, φᵀMφ = 1, lowest first. The first three are the rigid motions,
/// ω = 0. Everything a run on the plane needs of them; the shapes themselves are not kept.
///
/// Free-interface modes with residual flexibility (MacNeal 1971; Rubin 1975, AIAA J. 13(8)): the limit of the
/// Craig & Bampton (1968) reduction with all its fixed-interface modes, diagonalised, and cut with static correction
/// (Castanier, Tan & Pierre 2001). What is left out are the modes above ω_n, replaced by their static flexibility.
///
/// Beside acoustic water the modes are the dry dam's, and what they give to the pressures on the face is kept as well: attach()
/// adds the static answers of the modes left out to these pressures as modes of their own (attachment modes).
struct DamModes {
    Eigen::VectorXd omega2;         ///< ω² [rad²/s²]; the first three 0
    Eigen::MatrixXd on_plane;       ///< D φ, 2m x n: what each mode adds to the gaps [kg^-1/2 m^1/2]
    Eigen::VectorXd crest;          ///< horizontal motion of the crest
    Eigen::VectorXd ground_x;       ///< φᵀ M r of the ground's horizontal ...
    Eigen::VectorXd ground_y;       ///< ... and vertical motion
    Eigen::MatrixXd dam_mass;       ///< φᵀ M_dam φ: what mass damping acts on, the identity without added mass [-]
    Eigen::VectorXd dam_x, dam_y;   ///< φᵀ M_dam r of the ground's horizontal and vertical motion
    Eigen::VectorXd momentum;       ///< φᵀ M_dam r along the plane
    Eigen::MatrixXd residual;       ///< static flexibility on the plane of all modes left out, 2m x 2m [m²/N]
    Eigen::VectorXd residual_crest; ///< the same from forces on the plane to the crest, 2m
    Eigen::MatrixXd
        face; ///< φᵀ H by modes, H the coupling of WaterBody with the pressures on the face [m ...]; empty: none
    FaceResidual face_residual; ///< of the modes left out; empty: no acoustic water
    bool complete = false;      ///< nothing is left out
    bool regular = false;       ///< false: the dam could not be factorised, or the modes did not converge
    int solutions = 0;          ///< of the factorised dam

    Eigen::Index count() const { return omega2.size(); }
    /// With the first `count` of the modes only; the others go into the residual flexibility.
    DamModes first(Eigen::Index count) const;
    /// Adds attachment modes for pressures on a face and takes them out of the residual flexibility of the plane.
    /// @param rest  with the displacements on the plane that count as gaps @param pressures  shapes on the face, by columns
    /// @param mass  positive definite: what the water itself has in place of the flexibility ZᵀHᵀA Z of pressures Z;
    /// flexibilities below a ten-thousandth of it are left out
    /// @param [in,out] flexibility  of the plane, 2m x 2m
    /// @returns φᵀ H `pressures` of the modes added, one row each
    Eigen::MatrixXd attach(const FaceResidual& rest, const Eigen::MatrixXd& pressures, const Eigen::MatrixXd& mass,
                           Eigen::MatrixXd& flexibility);
    /// Zeros for unknowns that have neither mass nor stiffness here and do not reach the plane.
    void lengthen(Eigen::Index count);
};

/// Pressures of acoustic water on the dam's face: the columns of H that are not empty.
std::vector<Eigen::Index> face_pressures(const WaterBody& water);

/// @param elastic  modes beyond the three rigid ones, >= 1; all when there are no more
DamModes dam_modes(const ContactStructure& structure, int elastic);

} // namespace damslip::fe2d
