#pragma once

#include "analysis/fe/contact_run.hpp"
#include "analysis/fe/traced_cracks.hpp"
#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/reducible.hpp"
#include "core/watch.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/time/energy.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace damslip {

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
    std::size_t passes_to_wake() const { return passes_to_wake_; } ///< models that a run left because lifts woke
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
    bool gives_way() const { return exact_.has_value(); } ///< is each run compared with exact contact?
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
