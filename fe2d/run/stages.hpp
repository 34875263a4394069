#pragma once

#include "core/status.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/run/static_contact.hpp"
#include "fe2d/run/step_parts.hpp"
#include "fe2d/run/strength.hpp"

#include <functional>
#include <optional>
#include <string>

namespace damslip::fe2d {

/// What all loads above a plane, and the anchors through it, come to on it, from statics alone.
struct BaseResultant {
    double normal_force = 0.0; ///< N', effective, compression positive [N/m]
    double shear_force = 0.0;  ///< T, drives what is above downstream [N/m]
    double position = 0.0;     ///< of N' from the upstream end of the plane, along it [m]
};
/// @param dam_load  SplitLoad::dam @param plane  0: base
BaseResultant base_resultant(const ContactStructure& structure, const Eigen::VectorXd& dam_load,
                             Eigen::Index plane = 0);

enum class StageStatus {
    ok,
    slides,    ///< |T| > mu N' + c A: no equilibrium whatever the elasticity
    floats,    ///< N' <= 0
    overturns, ///< N' acts outside the base
    progressive, ///< the bond unzips: its strength would do if all of it were there at once, but no state carries the load
    not_resolved ///< resultants allow equilibrium, but the contact problem has none or was not solved: see the report
};

/// What a dam comes to whose static stage ends so. @param stage  not ok
Status status_of(StageStatus stage);

/// One plane at the end of a stage.
struct PlaneBalance {
    std::string plane; ///< "base", "lift joint at 51.5 m"
    StageStatus status = StageStatus::ok;
    BaseResultant resultant;
    double critical_friction = 0.0; ///< (|T| - c A)/N', the least mu of equilibrium [-]
    double sliding_factor = 0.0;    ///< (mu N' + c A)/|T| [-]; infinite without shear
    double slip = 0.0;              ///< area mean so far, positive downstream [m]
    double open_length = 0.0;       ///< area of open pairs [m]
    double slipping_length = 0.0;   ///< area of pairs at their strength [m]
};

/// How much of a stage's load a bond carries.
struct BondLoad {
    double largest = 1.0; ///< t_max: largest share of the load found in equilibrium on any path [-]
    double carried = 1.0; ///< share with the equilibria found by jumps; 1: the stage holds [-]
    double limit = 0.0;   ///< t_LP: upper bound with all of the bond's strength at once (limit_load()) [-]
    int events = 0;       ///< damage updates on the way; 0: found without following the load
    int jumps = 0;        ///< times that the dam lost its equilibrium and found another one
    double lost = 0.0;    ///< kinetic energy of the jumps, all of it taken by damping and waves [J/m]
};

/// A stage: the base's balance, and those of the lift joints.
struct StageResult : PlaneBalance { // `status` is that of the whole stage
    std::string name;               ///< "gravity", "prestress", "water", "uplift", "after the earthquake"
    std::string where;              ///< the lift joint that fails; empty: the base
    double flooded = 0.0;           ///< of the base, that an earthquake has cracked: full head stands in it [m]
    bool base_fails = false;        ///< by its resultants
    std::vector<PlaneBalance> lifts; ///< from bottom to top
    std::optional<BondLoad> bond;    ///< of a bond that breaks by energy; none: none, or not asked for
    ContactReport contact;

    std::vector<Note> notes() const; ///< how it ended, with the numbers
};

/// Static loads of a scene, one after the other; each holds all before it.
struct LoadStages {
    std::vector<std::string> names;
    std::vector<Eigen::VectorXd> loads; ///< on all unknowns of the model [N/m]
    Eigen::VectorXd before_uplift;      ///< all but the water under the base [N/m]

    const Eigen::VectorXd& last() const { return loads.back(); }
};

/// Gravity, prestress of anchors, water, uplift with the water in lift joints; stages without loads are left out.
/// @param uplift  under the base; empty: none. It acts on both sides of the joint, open or not, so contact forces are effective
/// @param in_rock  water in the rock, on all unknowns, comes with the uplift and stays (RunOptions::water_in_rock); empty: none
LoadStages load_stages(const Scene& scene, const Model& model, const PressureProfile& uplift,
                       const Eigen::VectorXd& in_rock = {});

/// All loads, with another pressure under the base. @param uplift  as of load_stages(); empty: as it was
Eigen::VectorXd load_with(const LoadStages& stages, const Model& model, const PressureProfile& uplift);

/// The water in the joint presses on the rock below the dam wherever that is: with a structure that slides far it is
/// taken from the rock's load to `load.joint`. Profile as in load_stages().
void let_water_ride(const ContactStructure& structure, const PressureProfile& uplift, SplitLoad& load);

/// What becomes of a dam that has lost its equilibrium under a constant load.
struct Release {
    bool rests = false; ///< it finds another one; false: it goes on moving
    double lost = 0.0;  ///< energy that damping took [J/m]
};
/// @param start, memory  at the limit point; memory after: at rest
using Relaxation = std::function<Release(const SplitLoad& load, const StaticState& start, const ContactLaw& law,
                                    ContactMemory& memory)>;

/// One stage from the memory of the one before. The memory is changed only when the stage ends in equilibrium.
/// @param before  load of the stage before, from which a bond that breaks is followed; null: the stage is made at once
/// @param relax  of a dam whose bond does not carry the load on a way in equilibrium (relaxation_of()); empty: it fails there
StageResult solve_stage(StaticContact& statics, const ContactStructure& structure, const std::string& name,
                        const SplitLoad& load, Strength& strength, ContactMemory& memory,
                        const SplitLoad* before = nullptr, const Relaxation& relax = {});

/// What full head in the broken part of a lift joint adds to the water in it [N/m]: that of the face from which it is broken; of a
/// joint broken from face to face the larger one. From a tip on to the other end the surplus falls on a line, but there is none in
/// a lift without water. Nowhere is there less than before.
double head_in_crack(const Scene& scene, const LiftJoint& lift, const Plane& plane, const BondLengths& crack);

/// The static state after an earthquake: cohesion is lost where the joint has opened or slipped, friction is that of the path,
/// and the uplift has its crack where the base has opened, in the earthquake or under these loads.
/// @param uplift  under a base with cracks from heel and toe; empty: as before the earthquake @param cracked  at least
/// @param strength, memory  at the end of the earthquake; @param load  of all but the uplift's change: load_with() another uplift
StageResult stage_after(StaticContact& statics, const ContactStructure& structure, const CrackedUplift& uplift,
                        const CrackLengths& cracked, const std::function<SplitLoad(const PressureProfile&)>& load,
                        Strength strength, const ContactMemory& memory, const SplitLoad* before = nullptr,
                        const Relaxation& relax = {});

/// A dam that has lost its equilibrium moves under its constant load, with its true mass, stiffness damping b_K and the
/// laws of its joints, until it has not slid for several of its periods or slides away (dynamic relaxation, JOINTS 1).
/// Mass damping is left out: it would hold a sliding dam back.
/// @param structure  of the static stages; kept by reference
/// @param damping  of the run; at least 5 % in a mode of `period`, so that the dam does come to rest
/// @param radiating  the rock of the motion, kept by reference; null: rigid base or massless rock
/// @param period  about that of the dam's first mode [s]
Relaxation relaxation_of(const ContactStructure& structure, const RunDamping& damping, const Scheme& scheme,
                const ReducedRock* radiating, const Contact& joint, const ContactOptions& options, double period);

/// Of a dam, about: 381 s √(N/m²)/m H/√E (Fenves & Chopra 1987, 1.4 H/√E in ft and psi). @param height  [m]
/// @param young_modulus  [Pa] @returns [s]
double first_period(double height, double young_modulus);

} // namespace damslip::fe2d
