#pragma once

#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/model/model.hpp"

namespace damslip::fe2d {

/// What stands before the water in the order of its unknowns.
enum class WaterBeside { dam, dam_and_rock };

/// Acoustic water of a dam that slides: CoupledSystem with its unknowns in nodes of two, as the dam's are. First the
/// dam's nodes (mesh order; then the rock's with WaterBeside::dam_and_rock), then pairs of the water's unknowns; a partner that is missing is an unknown of its own that
/// nothing drives. The dam's own blocks of all matrices are empty. Signs and scale: CoupledSystem.
struct WaterBody {
    FluidModel water;
    SparseMatrix coupling; ///< H, unknowns before the water x unknowns of the water [m]
    double scale = 1.0;    ///< s [Pa s/m]: p = s φ̇
    Eigen::Index dam_unknowns = 0, size = 0;
    std::vector<Eigen::Index> place; ///< of each of the water's unknowns among `size`

    SparseMatrix mass, damping, stiffness;                  ///< -s²Q; -sH, -sHᵀ, -s²A; -s²L
    Eigen::VectorXd velocity_x, velocity_y, displacement_y; ///< loads per ground velocity and displacement

    /// @param model  Base::separate, without added mass
    WaterBody(const Scene& scene, const Model& model, WaterBeside beside = WaterBeside::dam);
};

} // namespace damslip::fe2d
