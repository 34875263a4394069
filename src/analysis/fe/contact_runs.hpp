#pragma once

#include "analysis/fe/contact_run.hpp"
#include "analysis/fe/fe_meter.hpp"
#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/reducible.hpp"

#include <functional>
#include <optional>

/// The earthquakes of a scene by finite elements with contact.
namespace damslip {

struct FeOptions {
    std::optional<int> polarity = {}; ///< polarities_of() the scene where it is none
    bool mesh_error = true;           ///< one more run on elements of twice the size tells what the mesh leaves open
    bool pair_histories = false;      ///< keep the values of the pairs at every step, for files and pages
    int frames = 0;                   ///< kept over the record, for pictures; 0: none
    std::optional<int> modes = {};    ///< elastic modes of reduced runs; none: their own choice
    std::optional<fe2d::RunState> start = {}; ///< of the joints, from a run before; no mesh error then
    int jobs = 0;                             ///< threads, for polarities side by side; 0: all cores
};

/// The models of one scene, and the runs on them: static stages, earthquake with exact Coulomb contact, run-out, static
/// state after it; the rigid block's slip beside it; where the contact law gives way, the same run with exact contact.
class ContactRuns {
public:
    /// Meshes, assembles and condenses. @param ready, watch  outlive this
    /// @throws InputError, NotConverged, Interrupted
    ContactRuns(const Ready& ready, const FeOptions& options, Watch& watch);

    const fe2d::EarthquakeRun& model() const { return *model_; }
    const RigidModel& rigid() const { return rigid_; }
    const PressureProfile& uplift() const
    {
        return options_.uplift;
    }                                                     ///< before the earthquake, distance [m], pressure [Pa]
    const std::vector<sliding::Equilibrium>& combinations() const { return combinations_; } ///< Ready::combinations()
    bool gives_way() const { return exact_.has_value(); } ///< is each run compared with exact contact?
    std::size_t whole() const;                            ///< runs of all records and polarities

    /// Called with each run as soon as it is finished, in order, on the calling thread. It may move the large parts out.
    using TakeRun = std::function<void(ContactRun& run, const GroundMotion& motion)>;

    /// All records, the polarities of each beside each other. Ends early when the watch asks. Results do not depend on
    /// the number of threads.
    std::vector<ContactRun> run(const TakeRun& take = {});

private:
    std::vector<ContactRun> run(const RecordPair& pair, std::vector<GroundMotion>& motions);
    void run(const GroundMotion& motion, ContactRun& r);

    const Ready& ready_;
    Watch& watch_;
    FeMeter meter_;
    std::vector<int> polarities_;
    int jobs_;
    fe2d::RunOptions options_;
    CoarserMesh coarser_;
    std::optional<fe2d::EarthquakeRun> model_, exact_;
    RigidModel rigid_;
    std::vector<sliding::Equilibrium> combinations_;
};

/// The same on few modes of the dam: static stages by the full model, the slip with an estimate of what the reduction
/// changes.
class ReducedRuns {
public:
    /// @param ready  prepared for a reduced run; outlives this, as the watch does
    /// @throws UsageError for what a reduced run cannot do; InputError, NotConverged, Interrupted
    ReducedRuns(const Ready& ready, const FeOptions& options, Watch& watch);

    const fe2d::EarthquakeRun& full() const { return *full_; }
    const RigidModel& rigid() const { return rigid_; }
    const PressureProfile& uplift() const { return options_.uplift; }
    const std::vector<sliding::Equilibrium>& combinations() const { return combinations_; } ///< Ready::combinations()
    std::size_t whole() const;

    using TakeRun = std::function<void(ReducedRecord& run)>;
    std::vector<ReducedRecord> run(const TakeRun& take = {});

private:
    const Ready& ready_;
    Watch& watch_;
    std::vector<int> polarities_;
    int jobs_;
    fe2d::RunOptions options_;
    int modes_;
    std::optional<fe2d::EarthquakeRun> full_;
    std::optional<fe2d::ReducedRun> model_;
    CoarserMesh coarser_;
    RigidModel rigid_;
    std::vector<sliding::Equilibrium> combinations_;
};

} // namespace damslip
