#pragma once

#include "core/geometry.hpp"
#include "sliding/block/slip_stage.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <optional>
#include <vector>

/// The rigid block that may stand on its toe or on its heel, and slide on either (docs/rocking.md).
namespace damslip::sliding {

/// Added mass of the water that moves with the block, in the directions of the base: t along it downstream, n up, r a
/// clockwise rotation about the heel. Force on the dam by its acceleration (s'', y'', theta''): minus this matrix times it.
/// As the dam stands before the earthquake; it does not follow the rotation.
struct BaseAddedMass {
    double tt = 0.0, tn = 0.0, nn = 0.0; ///< [kg/m]
    double tr = 0.0, nr = 0.0;           ///< [kg]
    double rr = 0.0;                     ///< [kg m]
};

/// Strength and uplift over the path slipped.
struct RockingStage {
    SlipStage slip;               ///< friction, cohesion and uplift are taken from it
    double uplift_distance = 0.0; ///< of U from the heel along the base [m]
};

/// Everything the block's rocking and sliding depends on, per metre of dam length, in the directions of the base.
struct RockingBlock {
    double mass = 0.0;             ///< [kg/m]
    double inertia = 0.0;          ///< of the dam about its centroid [kg m]
    double length = 0.0;           ///< of the base [m]
    double base_inclination = 0.0; ///< theta of the base [rad], positive: dips downstream
    Point centroid;                ///< from the heel, along t and n [m]
    BaseAddedMass water;

    // Static loads without uplift: forces that keep size and direction, at points that move with the block.
    double force_t = 0.0; ///< downstream [N/m]
    double force_n = 0.0; ///< up; negative: the weight presses [N/m]
    double moment = 0.0;  ///< clockwise about the heel [N]
    double virial = 0.0;  ///< sum of force . (point - heel) [N]: how the moment changes as the block turns

    double cohesion = 0.0;            ///< of the bond before any slip [Pa]; 0: none
    Crack crack;                      ///< open before the earthquake: no bond there
    std::vector<RockingStage> stages; ///< by path, at least one

    /// Uplift on the toe and on the heel, the joint open from end to end; none: that of the stage (uplift.opening)
    std::optional<UpliftResultant> uplift_on_toe, uplift_on_heel;
};

/// The block of a static state. Moments, added mass and uplift are those of tipping_acceleration, so the block starts to
/// rock where that says.
/// @param stages  of the same state; @param later  state whose uplift holds in stages with another uplift than the first;
/// null: there is none
RockingBlock make_rocking_block(const Scene& scene, const BaseState& state, const AddedMassIntegral& water,
                                const SlipStages& stages, const BaseState* later = nullptr);

/// A dry block without water, uplift or cohesion on a horizontal base: a rectangle b wide and h high.
RockingBlock rectangular_block(double width, double height, double density, double gravity, double friction);

} // namespace damslip::sliding
