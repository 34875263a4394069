#pragma once

#include "analysis/prepare/records.hpp"
#include "analysis/prepare/reservoir.hpp"
#include "analysis/prepare/rigid_model.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/time/integrate.hpp"
#include "records/record.hpp"
#include "scene/scene.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace damslip::fe2d {
struct ModelOptions; // fe2d/model/model.hpp
struct RunOptions;   // fe2d/run/earthquake_run.hpp
} // namespace damslip::fe2d

namespace damslip {

/// What of the scene a reduced run cannot do; nothing where it can.
std::optional<Diagnostic> why_not_reducible(const Scene& scene);

/// @throws UsageError with that
void check_reducible(const Scene& scene);

/// Has its runs correct their steps (fe2d::CorrectedRun) where steps are chosen, contact is exact, and the dam can be reduced and
/// stays in one piece; halve them elsewhere.
void set_corrector(const Scene& scene, fe2d::RunOptions& options);

/// What rock with mass asks of its box and mesh: waves that come back from fixed edges, and elements that are too long
/// for the waves of this motion. Nothing for massless rock.
std::vector<std::string> rock_warnings(const Scene& scene, const fe2d::Mesh& mesh, const GroundMotion& motion);

/// Water in the rock as nodal forces (stages.pore_pressure = total or effective), from the seepage on the model's own mesh; zero for none.
/// @throws NotConverged when the seepage solver loses its accuracy
Eigen::VectorXd rock_water_load(const Scene& scene, const fe2d::Model& model);

/// Does stages.pore_pressure ask for water in the rock, and is there rock?
bool has_water_in_rock(const Scene& scene);

/// The part of rock_water_load() beyond the uplift on both faces of the joint, which contact runs have by themselves. The
/// joint's two sides must have facing nodes for stages.pore_pressure = "effective".
Eigen::VectorXd water_in_rock(const Scene& scene, const fe2d::Model& model);

/// Records as read, shared by all who run them.
using Records = std::shared_ptr<const std::vector<RecordPair>>;

/// A scene that is ready to be computed: what prepare() makes, and the only way from a scene to a model. `fe`, `sweep`,
/// `accuracy`, `explain`, `study` and other programs all start from it, so that the same scene gives the same bits in each.
struct Ready {
    Scene given; ///< as read, but with what became of "auto"
    Scene scene; ///< as the plan calls for it: without what is off, and with numbers in place of "auto", "dam", "modes"
    EffectPlan plan;
    Records pairs;

    // What was decided on the way; empty: nothing was to decide.
    std::optional<ReservoirChoice> reservoir; ///< reservoir.model = "auto"
    std::optional<DamPeriod> dam_period;      ///< added_mass.period_s = "dam"
    std::string flexible_modes;               ///< flexible_block.period_s = "modes", a sentence

    std::shared_ptr<KeptStatics> statics;   ///< of the rigid block, of scenes that differ in friction only; may be null
    std::shared_ptr<SeepageSource> seepage; ///< uplift by the seepage solver, each state solved once

    const std::vector<RecordPair>& records() const { return *pairs; }

    /// Both components of a record on one grid, scaled as scene and record say; the vertical one where the plan has it.
    /// @param scale  on top of the scene's; @param polarity  as of ground_motion(): motion.polarity is that of motions()
    GroundMotion motion(const RecordPair& pair, double scale = 1.0, int polarity = 1) const;

    /// The same with each of polarities_of() the scene, or that which is asked for: one record of motion_names().
    std::vector<GroundMotion> motions(const RecordPair& pair, std::optional<int> asked = {}) const;

    /// @param crack  in place of the scene's uplift.crack, if given
    /// @throws InputError, NotConverged  of the seepage
    RigidModel rigid_model(std::optional<CrackRule> crack = std::nullopt) const;

    /// Limit equilibrium of the scene's load combinations, the state after the earthquake among them.
    std::vector<sliding::Equilibrium> combinations() const;

    /// Up to which waves in radiating rock matter: where the records have their energy, and not below what landings and the
    /// modes of usual dams ask for [Hz].
    double wave_frequency() const;

    /// For models of the dam on a bonded base.
    fe2d::ModelOptions model_options() const;

    /// What a contact run takes from the other modules: added mass, uplift before and after the earthquake (curtain
    /// ruptured, drains ineffective), water in the rock, modified Rayleigh damping by the first record's horizontal
    /// component. Its progress only asks whether to stop. @param watch  outlives the runs
    fe2d::RunOptions run_options(const Watch& watch) const;

    void add_uplift(fe2d::RunOptions& options) const;

    /// The same base and records with another scene of the same kind: elements of another size.
    Ready with(Scene changed) const;
};

struct PrepareOptions {
    bool flexible_modes = false;                 ///< find flexible_block.period_s = "modes", which screening asks for
    bool joints_of_lifts = false;                ///< [lifts] as joints of the finite elements (with_joints_of_lifts())
    std::shared_ptr<SeepageSource> seepage = {}; ///< of scenes that it may serve together; none: one of its own
    std::shared_ptr<KeptStatics> statics = {};   ///< the same for the rigid block's statics, whatever the friction
    StopAsked stop = {};                         ///< asked between the eigenvalue problems of "auto", "dam" and "modes"
};

/// Decides what the scene leaves to the program, and leaves out what the plan does.
/// @param records  take the place of those that the scene names; null: none are there, the plan is by their names
/// @throws InputError where the scene cannot be computed so; NotConverged where a decision found no answer; Interrupted
Ready prepare(Scene given, Method method, Records records, const PrepareOptions& options = {});

/// With the records that the scene names, read here: verticals only where the plan has vertical motion.
/// @throws InputError  for all unreadable files together
Ready prepare(Scene given, Method method, const PrepareOptions& options = {});

/// The records that the scene names, as prepare() reads them.
Records load_records(const Scene& given, Method method);

/// What has to be known of the contact law the scene chooses and of the water in its joint, one sentence each; none for the
/// default.
std::vector<std::string> contact_law_notes(const Scene& scene);

/// What has to be known first of a slip by finite elements on a base that lets no wave go; none where the rock radiates.
std::optional<std::string> base_note(const Scene& scene);

/// How a run on a bonded base is integrated.
struct TiedScheme {
    TimeScheme scheme = TimeScheme::hht; ///< never automatic
    std::string reason;                  ///< of "auto": one sentence; else empty
};

/// "auto" takes modes where the model is linear with Rayleigh damping and no waves leave, and the motion has more steps than the
/// modes cost solves.
TiedScheme tied_scheme(const Scene& scene, const GroundMotion& motion, const fe2d::TiedRunOptions& options);

/// What the scene's time.scheme means for its FE runs, for `explain`.
std::string time_scheme_note(const Scene& scene);

} // namespace damslip
