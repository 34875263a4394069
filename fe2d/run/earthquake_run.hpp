#pragma once

#include "core/parallel.hpp"
#include "core/status.hpp"
#include "fe2d/contact/bond_law.hpp"
#include "fe2d/rock/radiating_rock.hpp"
#include "fe2d/run/base_water.hpp"
#include "fe2d/run/run_watches.hpp"
#include "fe2d/run/dynamic_contact.hpp"
#include "fe2d/run/explicit_contact.hpp"
#include "fe2d/run/run_history.hpp"
#include "fe2d/run/stages.hpp"
#include "fe2d/time/energy.hpp"
#include "records/record.hpp"
#include "scene/anchor_bar.hpp"

#include <filesystem>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <span>

/// The staged run: gravity, water, uplift, earthquake, run-out, and the static state after it.
namespace damslip::fe2d {

class EarthquakePass;
class EarthquakeRun;
class StepCorrector;
struct CoupledModes; // fe2d/fluid/coupled_system.hpp
struct PassSteps;

/// What the caller brings from other modules, and what only a run needs. All else is the scene's.
struct RunOptions {
    AddedMassLaw added_mass;            ///< of the upstream face (ModelOptions::added_mass); empty: none
    PressureProfile uplift;             ///< under the base before the earthquake; empty: none
    CrackedUplift uplift_after;         ///< the same after it, where the base has cracked; empty: as before
    CrackedUplift cracked_uplift;       ///< `uplift` where the base has cracked, for uplift.opening
    CrackedUplift cracked_uplift_after; ///< between the records of a sequence; empty: it stays as it is
    std::optional<DrainLoss> drain_loss; ///< of `uplift`, while it shakes; none: the drains hold
    /// Forces of the water in the rock on all unknowns of the model [N/m], constant from the uplift on; empty: none.
    std::function<Eigen::VectorXd(const Model&)> water_in_rock;
    std::optional<RayleighConstants> damping; ///< in place of the scene's
    double wave_frequency = 25.0;     ///< up to which waves in radiating rock are right, where the scene has none [Hz]
    std::filesystem::path rock_cache; ///< folder of reduced rock (RockStore); empty: none
    int largest_halvings = 5;         ///< of sub-steps that are chosen
    double smallest_slip = 1e-6;      ///< errors below time.slip_tolerance of this do not matter [m]
    std::vector<double> slip_limits = {}; ///< only the side of these is asked for on which the slip of the base lies [m]; empty: the slip
    /// corrected_run() of fe2d/reduction; empty: steps that are chosen are halved
    std::function<std::unique_ptr<const StepCorrector>(const EarthquakeRun&, const Scene&, const RunOptions&)> corrector;
    std::optional<double> rest_time;  ///< the run-out ends when the dam has not slid for this long; none: window() [s]
    ContactOptions contact;
    std::optional<RunState> start; ///< as RunResult::state of a run before; none: a dam that no earthquake has shaken
    PairSeries pair_series = PairSeries::none;
    int frames =
        0; ///< >= 2: kept over the record at equal intervals (RunHistory::frames), start and end included; 0: none
    /// Asked after every step of the record; empty: none. Steps count sub-steps of all passes of the chosen halvings,
    /// as far as they are known. Runs that go on in parallel call it from their own threads.
    std::function<RunAnswer(const RunProgress&)> progress;
    bool ends_when_lifts_wake = false; ///< as interrupted, once a tied lift has reached wake_index, or a face f_t where cracks are traced
    std::vector<CrackStart> crack_starts = {}; ///< of the traced cracks
    StopAsked stop;                                  ///< asked between the parts of the set-up
    std::function<void(int unknowns)> reducing_rock; ///< RadiatingRockInput::reducing; empty: no call
};

/// Error of the step that the slip of the base may have: time.slip_tolerance of it, or where RunOptions::slip_limits are given half the
/// distance to the nearest of them, if that is more [m]. @param largest  on the way [m]
double allowed_error(const Scene& scene, const RunOptions& options, double slip, double largest);

/// Seconds of each part.
struct RunSeconds {
    double model = 0.0; ///< mesh, matrices, modes for the damping, condensation
    double statics = 0.0;
    double dynamics = 0.0; ///< contact included
    double contact = 0.0;  ///< of the dynamics
};

/// What became of the block above a lift joint.
struct LiftResult {
    std::string plane;                                            ///< "lift joint at 51.5 m"
    std::string name;                                             ///< the scene's
    double slip = 0.0;                                            ///< final, area mean, since the static state [m]
    double largest_slip = 0.0;                                    ///< largest |slip| of all steps on the way [m]
    double slip_error = std::numeric_limits<double>::quiet_NaN(); ///< as RunResult::slip_error
    double largest_opening = 0.0;                                 ///< [m]
    double largest_rocking = 0.0;                                 ///< largest |rotation| [rad]
    BondLengths bond;                                             ///< at the end
    double dip = 0.0; ///< of the joint against the level, positive where it falls downstream [rad]
    /// Sliding factor after the earthquake with head_in_crack() [-]; NaN: nothing is broken, or there is no shear.
    double cut_factor = std::numeric_limits<double>::quiet_NaN();
};

/// What runs on few modes of the dam, with smaller steps than the run's, add to its slip (StepCorrector).
struct StepCorrection {
    double slip = 0.0; ///< part of RunResult::slip [m]
    double dt = 0.0;   ///< the smallest of their steps [s]
};

struct RunResult {
    Status status = Status::not_resolved; ///< not_resolved until the record has run
    std::vector<Note> notes;              ///< how it ended, with the numbers; of a stage that fails, that stage's
    std::vector<StageResult> stages;      ///< before the earthquake
    std::vector<StageResult> between; ///< of a sequence, before its second, third, ... record (uplift.after = "full")
    StageResult after;                ///< after it, with residual strength and uplift_after
    RunHistory history;
    double slip = 0.0;             ///< final, area mean, since the static state [m]
    double max_slip = 0.0;         ///< largest |slip| of all steps on the way, between the rows of the history too [m]
    double slip_error = 0.0;       ///< estimate of what the time step leaves open, at any time [m]; NaN: not estimated
    std::optional<StepCorrection> correction; ///< none: the steps themselves are small enough, or fixed
    // Of a run on few modes of the dam (ReducedRun).
    int modes = 0;                  ///< elastic modes kept, the three rigid ones apart; 0: the whole dam
    double highest_frequency = 0.0; ///< of them [Hz]
    double truncation_error = 0.0;  ///< estimate of the largest change of the slip, at any time, by the modes left out
                                    ///< [m]; NaN: not estimated
    std::vector<EventSlip> events; ///< of a sequence, as far as they were reached; else empty
    std::size_t events_left = 0;   ///< not reached
    int halvings = 0;              ///< the step was dt / 2^halvings
    double dt = 0.0;               ///< [s]; of adaptive steps the mean
    double end_time = 0.0;         ///< run-out included [s]
    RunOutFigures run_out;         ///< slip with the ground moving and at rest, and what pays for it
    RayleighConstants damping;
    DynamicCounts counts;                       ///< of the run that is reported
    double energy_error = 0.0;                  ///< |imbalance| at the end over the largest term [-]
    std::vector<LiftResult> lifts;              ///< from bottom to top
    CrackFigures cracks;                        ///< of the parts that cannot crack
    std::vector<AnchorOutcome> anchors;         ///< in the order of the scene
    std::optional<JointWaterReport> base_water; ///< none where the water under the base stays as it was
    Eigen::VectorXd pair_distance, pair_area;   ///< of the base [m]
    Eigen::VectorXd pair_pressure, pair_shear, pair_slip, pair_opening; ///< at the end [Pa, Pa, m, m]
    RunState state;                    ///< of the joints at the end; without pairs where the record has not run
    Eigen::VectorXd displacement;      ///< at the end, on all unknowns of the model, from `zero_displacement` on [m]
    Eigen::VectorXd zero_displacement; ///< of the gravity stage where scene.stages.geostatic is set; else empty [m]
    RunSeconds seconds;
    std::size_t bytes = 0;

    /// The static state from which the last record starts. @pre some stage was solved
    const StageResult& rest() const { return between.empty() ? stages.back() : between.back(); }
    /// Slips of single planes below it are measured against it: a hundredth of the largest slip of all planes [m].
    double least_slip_of_planes() const;
};

/// The steps of a run as another run chose them.
struct ChosenSteps {
    int halvings = 0;           ///< uniform steps Δt/2^halvings
    std::optional<double> step; ///< of an explicit scheme, whose limit depends on the mesh: Δt/2^halvings itself [s]
};

/// One of several runs of a model.
struct Shaking {
    const GroundMotion* motion = nullptr; ///< not null
    Contact contact;                      ///< strength of the base
};

/// What takes the place of halving where steps are chosen.
class StepCorrector {
public:
    virtual ~StepCorrector() = default;
    virtual std::vector<RunResult> run_all(std::span<const Shaking> shakings) const = 0; ///< as EarthquakeRun::run_all
};

/// A scene made ready: mesh, matrices, rock condensed, loads, damping. Friction and motion may differ from run to run.
/// The operators of each step size are made by the first run that needs them and shared by all; runs can go on in
/// parallel.
class EarthquakeRun {
public:
    /// @throws InputError for what the model cannot be made of; Interrupted
    EarthquakeRun(const Scene& scene, RunOptions options);
    ~EarthquakeRun();
    EarthquakeRun(const EarthquakeRun&) = delete;
    EarthquakeRun& operator=(const EarthquakeRun&) = delete;

    const Model& model() const { return *model_; }
    /// What moves in the earthquake: structure(), or with rock that has mass a structure of dam and rock.
    const ContactStructure& in_motion() const { return moving_ ? *moving_ : *structure_; }
    const Model& model_in_motion() const { return moving_model_ ? *moving_model_ : *model_; }
    const WaterBody* water() const { return water_.get(); } ///< acoustic; null: none
    const ContactStructure& structure() const { return *structure_; }
    /// Of structure(); null where it is not usable (why_not).
    const std::shared_ptr<const StaticOperator>& static_operator() const { return statics_; }
    const LoadStages& stages() const { return stages_; } ///< static loads before the earthquake
    const RayleighConstants& damping() const { return damping_.constants; }
    const RadiatingRock* radiating() const
    {
        return radiating_.get();
    } ///< rows (x, y) by node; null: other rock, or none
    /// The same with rows as the base's plane has them, as the steps take it.
    const ReducedRock* radiating_on_base() const { return operators_ ? operators_->radiating() : nullptr; }
    const std::vector<Note>& why_not() const { return why_not_; } ///< no run has an answer; empty: they may
    double seconds() const { return seconds_; }             ///< that making it ready took
    /// Of the windows in which sliding after the record is looked at (slide_window) [s]; found by the first run that asks.
    double window() const;
    double rest_time() const { return options_.rest_time ? *options_.rest_time : window(); } ///< [s]
    int factorisations() const { return operators_ ? operators_->made() : 0; } ///< step sizes of all runs so far

    /// Takes the steps that the scene fixes, or chooses them by time.slip_tolerance.
    /// @param contact  strength; default: the scene's
    RunResult run(const GroundMotion& motion, const std::optional<Contact>& contact = {}) const;

    /// Several motions and strengths of the base, in lockstep on common passes over the factor where their steps are of the
    /// same size: results in the same order, the same bits as run() of each. Their dynamic seconds are equal shares of the
    /// common ones.
    /// @param steps  in place of those of options and scene; the slip then has no estimate of its error
    std::vector<RunResult> run_all(std::span<const Shaking> shakings,
                                   const std::optional<ChosenSteps>& steps = {}) const;
    std::vector<RunResult> run_all(const GroundMotion& motion, std::span<const Contact> contacts,
                                   const std::optional<ChosenSteps>& steps = {}) const;
    /// The same without a corrector: chosen steps are halved until the slip stays.
    std::vector<RunResult> run_halved(std::span<const Shaking> shakings) const { return run_in_step(shakings, {}); }
    /// How many runs gain by going in step in one run_all(), where they differ in the motion, too: 1 where the factor stays in
    /// the processor's cache.
    std::size_t runs_together() const;
    RunResult run_at(const GroundMotion& motion, const ChosenSteps& steps) const; ///< with the scene's strength
    /// Those of a run, for one on another mesh.
    ChosenSteps steps_of(const RunResult& run) const;

    /// Displacements of a kept state on the unknowns of model() [m]; edges of the rock box that are free in motion but not
    /// there are left out.
    Eigen::VectorXd displacement_of(const StoredState& state) const { return displacement_of(state.dam, state.rock); }

    /// The stages before the earthquake alone; `memory` ends in the last state of equilibrium.
    std::vector<StageResult> statics(StaticContact& statics, Strength& strength, ContactMemory& memory) const;
    /// Joints that nothing has loaded yet, with the laws of the scene. @param contact  strength of the base
    ContactMemory unloaded(const Contact& contact) const;

private:
    struct BatchedRun;
    const StepCorrector* corrector() const;
    std::vector<RunResult> run_in_step(std::span<const Shaking> shakings, const std::optional<ChosenSteps>& steps) const;
    /// Rest before the earthquake in the terms of what moves.
    struct Rest {
        SplitLoad load;
        StaticState start;
    };
    Rest rest(const BatchedRun& batched) const;
    Eigen::VectorXd displacement_of(const Eigen::VectorXd& moving, const Eigen::VectorXd& rock) const;
    Model tied_model() const;
    CoupledModes coupled_modes(int leading) const;
    Eigen::VectorXd bonded_frequencies(int count) const;
    void find_damping();
    std::shared_ptr<const ReducedRock> let_radiate();
    std::shared_ptr<const ExplicitOperators> explicit_operators() const;
    SplitLoad split(std::size_t stage) const;
    Relaxation relaxation() const;
    SlideWatch slide_watch(const BatchedRun& batched, double record_end) const;
    Eigen::VectorXd zero_displacement(StaticContact& statics, const Strength& strength) const;
    BatchedRun batched_run(const Contact& contact) const;
    SplitLoad load_of(const BatchedRun& batched) const;
    void stand(BatchedRun& batched, const RunState* from) const;
    void go_on(StaticContact& statics, BatchedRun& batched, const RunState& from) const;
    bool rests_between(const GroundMotion& motion) const;
    RunResult shake_with_rests(int halvings, BatchedRun& batched) const;
    PassSteps pass_steps(const BatchedRun& batched, int parts) const;
    bool adapts_steps(const BatchedRun& batched) const;
    std::unique_ptr<EarthquakePass> pass_of(const BatchedRun& batched, int halvings, const PassSteps& steps) const;
    double frame_interval(double record_end) const;
    StepControl control_of(const BatchedRun& batched, int level) const;
    void refine(int halvings, std::span<BatchedRun* const> batch) const;
    std::vector<RunResult> shake(int halvings, std::span<BatchedRun* const> batch) const;
    std::vector<RunResult> shake_in_step(int halvings, std::span<BatchedRun* const> batch) const;
    RunResult shake_explicitly(int halvings, const BatchedRun& batched) const;
    const CrackedUplift& cracked_after(const JointWaterReport& water) const;
    void end_run(const ContactMotion& dynamics, const Strength& strength, const BatchedRun& batched, RunResult& result) const;
    RunProgress progress_of(const BatchedRun& batched, int halvings, long record_steps, long step, double dt) const;
    void judge(RunResult& result) const;
    std::vector<Note> longest_rated_step() const;
    std::vector<Note> runs_away(const RunResult& result) const;
    Note missed_tolerance(const RunResult& result) const;
    Note ending(const RunResult& result) const;

    Scene scene_;
    RunOptions options_;
    std::unique_ptr<Model> model_;
    std::unique_ptr<WaterBody> water_; ///< acoustic; null: none
    std::unique_ptr<ContactStructure>
        structure_;                       ///< of the static stages; without rock that has mass of the motion too
    std::unique_ptr<Model> moving_model_; ///< with rock that has mass; null: the rock has none
    std::unique_ptr<ContactStructure> moving_;
    std::unique_ptr<const RadiatingRock> radiating_;
    std::shared_ptr<const StaticOperator> statics_;
    std::shared_ptr<StepOperators> operators_;          ///< null with explicit steps
    std::shared_ptr<const ExplicitOperators> explicit_; ///< null with implicit steps
    LoadStages stages_;
    RunDamping damping_;
    std::optional<CrackLines> cracks_; ///< none where the structure is not usable
    bool usable_ = false;
    std::vector<Note> why_not_; ///< of what is not usable
    double seconds_ = 0.0;
    std::optional<double> first_frequency_; ///< of dam and acoustic water, where the damping asked for it [rad/s]
    mutable std::once_flag corrector_made_;
    mutable std::unique_ptr<const StepCorrector> corrector_; ///< made by the first run that chooses its steps
    mutable std::once_flag window_found_;
    mutable double window_ = 0.0; ///< see window() [s]
};

} // namespace damslip::fe2d
