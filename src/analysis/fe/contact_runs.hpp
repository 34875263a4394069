#pragma once

#include "analysis/fe/mesh_error.hpp"
#include "analysis/fe/traced_cracks.hpp"
#include "analysis/prepare/ready.hpp"
#include "core/parallel.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "fe2d/time/energy.hpp"
#include "sliding/block/slide.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

/// What a finite-element run of one record gives, and what may be said of it.
namespace damslip {

/// The earthquake of one record, one polarity, with sliding, opening and rocking at the base.
struct ContactRun : MotionName {
    fe2d::RunResult fe;                        ///< of the whole dam, or of few modes of it (RunResult::modes)
    std::optional<sliding::SlideResult> rigid; ///< none where the block slides statically
    std::optional<fe2d::RunResult> exact;      ///< with rigid sticking, where that of `fe` gives way
    MeshError mesh;
    bool leaves_out = false; ///< something that the scene asks for (not_honoured()): no PASS rests on the slip
    std::string unsettled_cracks = {}; ///< "crack 2, crack 3": traced ones whose path still moved; empty: none
    std::optional<double> tensile_strength = {}; ///< dam.tensile_strength, against which `fe.cracks` is held [Pa]
};

/// What is known of the numerical error of a slip [m]; NaN: nothing.
struct SlipError {
    double step = std::numeric_limits<double>::quiet_NaN(); ///< with what reduced runs leave out, of their modes
    double mesh = std::numeric_limits<double>::quiet_NaN();
    double total =
        std::numeric_limits<double>::quiet_NaN(); ///< step and mesh; step alone where no mesh part is asked for
                                                  ///< or can be had; NaN where a part that was asked for failed
    bool modes = false;                           ///< `step` holds what reduced runs leave out, too
    std::string parts() const; ///< "step and mesh", "modes, step only", "step, mesh not known", "no error estimate"
};
SlipError slip_error(const ContactRun& run);
SlipError lift_error(const ContactRun& run, std::size_t lift);

/// Splitting strengths of mass concrete of 10 to 30 MPa, 0.32 f_c^(2/3) with both in MPa (Raphael 1984, ACI Journal 81, 158)
/// [Pa]: without dam.tensile_strength the concrete is said to crack above the largest.
inline constexpr double usual_tensile_strength[] = {1.5e6, 3e6};
/// Would the concrete crack where the model has no joint, or a tied lift slip or part?
bool would_crack(const ContactRun& run);
/// The run with the largest tension away from joints. @returns null: no run was watched
const ContactRun* most_tensioned(const std::vector<ContactRun>& runs);

/// Does its status have a slip?
bool has_slip(const ContactRun& run);

/// Has every run an answer, one that fails included?
bool all_answered(const std::vector<ContactRun>& runs);
/// "EC8, polarity -1 self-excited, slid at least 409 mm": the runs without an answer; empty where all have one.
std::string unanswered_words(const std::vector<ContactRun>& runs);

/// How far a dam that goes on by itself had come when the run ended [m]; none for all others.
std::optional<double> slid_at_least(Status status, double slip);

/// Why parts of the errors are not known, each reason once.
std::vector<std::string> error_notes(const std::vector<ContactRun>& runs);

/// Does what follows the earthquake fall, by its resultants?
bool falls_after(const ContactRun& run);
/// Did the solver find no answer for the state after the earthquake?
bool open_after(const ContactRun& run);

/// Verdict of a run: the worst of its base, of every lift joint and of the state after the earthquake. PASS and FAIL come from
/// judge(), with the total error of each slip. @param allowable  slip [m]; none: no criterion
Verdict verdict_of(const ContactRun& run, const std::optional<double>& allowable);
/// Of all runs: FAIL if one fails, none if one has no verdict, undecided if one is, else PASS.
Verdict verdict_of(const std::vector<ContactRun>& runs, const std::optional<double>& allowable);

/// Whether `a` comes before `b`: the smaller slip; runs without slip before all others, dams that fall or run away after them.
bool milder(const ContactRun& a, const ContactRun& b);
/// The run that no other is worse than; of equals the first. @param runs  not empty
const ContactRun& worst_of(const std::vector<ContactRun>& runs);

/// By the statuses of the runs, and of the states after the earthquake.
int exit_code_of(const std::vector<ContactRun>& runs);

/// What a contact run of a scene condenses, holds and costs. Sizes are those of the run; seconds are measured on a
/// second of strong shaking on this machine, so they differ from call to call.
struct ContactCost {
    struct Part {
        std::string name; ///< "dam at rest, inside eliminated"
        std::int64_t unknowns = 0;
        std::string made; ///< how often
        std::size_t bytes = 0;
    };
    struct OfRecord {
        std::string record;
        std::int64_t steps = 0;    ///< whole ones
        double pass_seconds = 0.0; ///< of one pass with them
    };
    std::vector<Part> parts;           ///< rock, dam at rest, dam in motion, contact problem
    std::int64_t contact_unknowns = 0; ///< what each part becomes
    std::vector<OfRecord> records;     ///< empty: a file is not there, or seconds_per_step is none
    double set_up_seconds = 0.0;
    std::optional<double> seconds_per_step; ///< none: the dam does not stand before the earthquake

    std::size_t set_up_factorisations() const { return parts.size() - 2; } ///< all but dam in motion, contact problem
};

/// @param ready  for finite elements; its records are estimated
ContactCost contact_cost(const Ready& ready);

/// Runs done, the shares of those under way included, for a progress bar in runs. Each thread has one group of runs
/// under way.
class FeMeter {
public:
    explicit FeMeter(Watch& watch) : watch_(watch) {}

    void begin(std::size_t runs);          ///< a group begins on this thread
    void more(std::size_t runs);           ///< join the group of this thread
    void step(const fe2d::RunProgress& p); ///< a step of all its runs, in lockstep
    void reached(double share);            ///< of the group, 0 ... 1
    void end();                            ///< it has ended

private:
    struct Group {
        double runs = 0.0, share = 0.0;
    };
    void show();

    Watch& watch_;
    std::mutex mutex_;
    std::map<std::thread::id, Group> under_way_;
    double done_ = 0.0;
};

/// RunOptions::reducing_rock of a run that is watched: names the phase where the box of waves is so large that its reduction
/// takes a good part of a minute. @param watch  outlives it; a part of it has begun
std::function<void(int unknowns)> tell_of_large_box(Watch& watch);

/// The earthquakes of a scene by finite elements with contact.

struct FeOptions {
    std::optional<int> polarity = {}; ///< polarities_of() the scene where it is none
    bool mesh_error = true;           ///< one more run on elements of twice the size tells what the mesh leaves open
    bool pair_histories = false;      ///< keep the values of the pairs at every step, for files and pages
    int frames = 0;                   ///< kept over the record, for pictures; 0: none
    bool reduced = false;             ///< on few modes of the dam, whose error is estimated too
    std::optional<int> modes = {};    ///< elastic ones kept then; none: fe2d::default_modes
    std::optional<fe2d::RunState> start = {}; ///< of the joints, from a run before; no mesh error then
    int jobs = 0;                             ///< threads, for polarities side by side; 0: all cores
};

/// The models of one scene, and the runs on them: static stages, earthquake with exact Coulomb contact, run-out, static
/// state after it; the rigid block's slip beside it; where the contact law gives way, the same run with exact contact.
///
/// Tied lifts wake: a run in which some of them reach fe2d::wake_index ends there, these become lift joints (with the mesh that
/// their bond asks for), and the run begins anew from t = 0, until no run of any record wakes another. What slept has then
/// stayed below its strength, so as a joint it would not have moved; what was found before is run again on the last model.
///
/// Traced cracks (`dam.crack`) come the same way: where concrete comes to its strength a run ends and the next one has a line
/// there; once nothing new cracks, paths are drawn anew and run again until they stay.
///
/// On few modes of the dam (FeOptions::reduced) static stages are those of the whole dam; no lift wakes, and no run is compared.
class ContactRuns {
public:
    /// Meshes, assembles and condenses. @param ready, watch  outlive this
    /// @throws InputError, NotConverged, Interrupted; UsageError for what a reduced run cannot do
    ContactRuns(const Ready& ready, const FeOptions& options, Watch& watch);

    const Ready& ready() const { return ready_; } ///< as given; its lifts that have woken are lift joints
    const std::vector<TracedCrack>& traced() const { return traced_; } ///< in the order in which they began
    const fe2d::EarthquakeRun& model() const { return *model_; }
    /// Why no run has an answer, a sentence; empty: there is a model.
    bool reduced() const { return reduced_.has_value(); } ///< on few modes of the dam
    const std::vector<Note>& why_not() const { return reduced_ ? reduced_->why_not() : model_->why_not(); }
    const RigidModel& rigid() const { return rigid_; }
    const PressureProfile& uplift() const
    {
        return options_.uplift;
    } ///< before the earthquake, distance [m], pressure [Pa]
    const std::vector<sliding::Equilibrium>& combinations() const { return combinations_; } ///< Ready::combinations()
    std::size_t whole() const;                            ///< runs of all records and polarities

    /// Called with each run as soon as it is finished, in order, on the calling thread. It may move the large parts out.
    using TakeRun = std::function<void(ContactRun& run, const GroundMotion& motion)>;

    /// All records, the polarities of each beside each other. Ends early when the watch asks. Results do not depend on
    /// the number of threads.
    std::vector<ContactRun> run(const TakeRun& take = {});

private:
    void run(const GroundMotion& motion, ContactRun& r);
    void wake_lifts();
    bool wake(const std::vector<fe2d::RunResult>& runs);
    bool crack(const std::vector<fe2d::RunResult>& runs);
    bool draw_anew(const std::vector<fe2d::RunResult>& found);
    void make_model(const std::string& what, const Scene& before);

    /// What a run of one record and polarity has come to while lifts were waking.
    struct Found {
        std::vector<fe2d::RunResult> runs; ///< by polarity; empty: not run
        std::size_t model = 0;             ///< passes_to_wake_ of its model
    };

    Ready ready_;
    Watch& watch_;
    FeMeter meter_;
    std::optional<int> polarity_;
    int jobs_;
    fe2d::RunOptions options_;
    CoarserMesh coarser_;
    std::optional<fe2d::EarthquakeRun> model_, exact_;
    std::optional<fe2d::ReducedRun> reduced_; ///< on model_
    RigidModel rigid_;
    std::vector<sliding::Equilibrium> combinations_;
    std::vector<Found> found_; ///< by record; empty: no lift can wake
    std::size_t passes_to_wake_ = 0;
    std::vector<TracedCrack> traced_;
};

/// Groups of runs, each of one model and one motion, that threads take one after the other. With a model whose runs gain by going in
/// step (fe2d::EarthquakeRun::runs_together), a thread takes several groups of it at once, but leaves the other threads their
/// share. What is taken together changes no result.
class GroupQueue {
public:
    /// @param models  of the groups, by number: those with the same number share a model
    GroupQueue(std::vector<std::size_t> models, int threads);

    std::size_t groups() const { return models_.size(); }
    /// The first group that nobody has taken; none: all are taken. Taken by this call.
    std::optional<std::size_t> next();
    /// More groups of the model of `group`, which this call takes. @param most  with `group`
    std::vector<std::size_t> more_of(std::size_t group, std::size_t most);

private:
    std::mutex mutex_;
    std::vector<std::size_t> models_;
    std::vector<bool> taken_;
    std::size_t first_ = 0; ///< all before are taken
    std::size_t threads_;
};

} // namespace damslip
