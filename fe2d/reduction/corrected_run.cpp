#include "fe2d/reduction/corrected_run.hpp"

#include "core/watch.hpp"
#include "fe2d/run/step_error.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace damslip::fe2d {

namespace {

constexpr double share = 0.1;          ///< of the correction, that may be wrong in any case
/// Stresses are not corrected, and want the record's step halved: largest σ₁ of own_dam 0.146, 0.212, 0.215, 0.221 MPa at Δt ... Δt/8.
constexpr std::size_t least_halvings = 1;
constexpr std::size_t most_passes = 4; ///< on few modes; slips that are still open are not of a kind to be corrected

/// A pass on few modes from which the full run may start, and what the slip then leaves open.
struct Choice {
    std::size_t coarse = 0;
    double of_step = 0.0, of_correction = 0.0; ///< error [m]
};

/// The last pass is the finest.
std::optional<Choice> coarsest_within(std::span<const RunResult> passes, double order, double wanted)
{
    if (passes.size() < least_halvings + 2 || passes.back().status != Status::at_rest) return {};
    std::vector<SlipAtStep> slips;
    for (std::size_t k = 0; k < passes.size(); ++k)
        slips.push_back({passes[k].halvings, passes[k].slip,
                         k == 0 ? 0.0 : largest_difference(passes[k - 1].history.slip, passes[k].history.slip)});
    const double of_step = step_error(slips, order);
    for (std::size_t k = least_halvings; k + 1 < passes.size(); ++k) {
        const double of_correction = share * largest_difference(passes[k].history.slip, passes.back().history.slip);
        if (of_step + of_correction <= wanted) return Choice{k, of_step, of_correction};
    }
    return {};
}

double at(const std::vector<double>& series, std::size_t row)
{
    return series[std::min(row, series.size() - 1)];
}

/// How much farther than its end the dam was on the way [m].
double beyond_the_end(const RunResult& run)
{
    return run.max_slip - std::abs(run.slip);
}

/// Slides the dam farther, as a rigid body.
void slide_farther(const ContactStructure& structure, const RunResult& coarse, const RunResult& fine, double record_end, RunResult& run)
{
    RunHistory& history = run.history;
    const double beyond = beyond_the_end(run) + beyond_the_end(fine) - beyond_the_end(coarse);
    std::vector<double> change;
    for (std::size_t row = 0; row < history.time.size(); ++row)
        change.push_back(at(fine.history.slip, row) - at(coarse.history.slip, row));
    const Eigen::Vector2d along = structure.plane().tangent;
    const Eigen::Index dam = structure.model().mesh.dam_node_count;
    const Eigen::VectorXd sliding = along.replicate(dam, 1);
    Eigen::VectorXd all_nodes = Eigen::VectorXd::Zero(structure.dam_unknowns()); // acoustic water's, too
    all_nodes.head(sliding.size()) = sliding;
    slide(change, structure.order().to_new(all_nodes), along.x(), history);
    run.displacement.head(sliding.size()) += change.back() * sliding;
    const auto end_of_record = static_cast<std::size_t>(
        std::lower_bound(history.time.begin(), history.time.end(), record_end - 1e-9) - history.time.begin());
    const double shaken = at(change, end_of_record), all = change.back();
    run.pair_slip.array() += all;
    run.state.slip.array() += all;
    run.after.slip += all;
    run.correction = StepCorrection{all, fine.dt};
    run.slip += all;
    run.max_slip = std::abs(run.slip) + std::max(0.0, beyond);
    run.run_out.slip_shaking += shaken;
    run.run_out.slip_at_rest += all - shaken;
    for (Note& note : run.notes)
        if (note.kind == NoteKind::slip_at_rest) note.values.front() = 1e3 * run.slip;
}

/// Options of the runs on few modes. They keep no frames and no series, and their progress only asks whether to stop.
RunOptions of_few_modes(RunOptions options)
{
    options.frames = 0;
    options.pair_series = PairSeries::none;
    if (options.progress)
        options.progress = [stop = options.stop](const RunProgress&) {
            return stop && stop() ? RunAnswer::stop : RunAnswer::go_on;
        };
    return options;
}

double duration(const GroundMotion& motion)
{
    return motion.dt * static_cast<double>(motion.accel_h.size() - 1);
}

} // namespace

/// The runs on few modes of one shaking: with the steps of the full run, and with the smallest.
struct CorrectedRun::OnFewModes {
    double of_step = 0.0, of_correction = 0.0; ///< error [m]
    RunResult coarse, fine;
    double seconds = 0.0;
};

CorrectedRun::CorrectedRun(const EarthquakeRun& full, const Scene& scene, const RunOptions& options)
    : full_(full), progress_(options.progress), few_(full, scene, of_few_modes(options))
{
}

/// Tells the progress before the runs on few modes of shaking `next`: those of all shakings count as a tenth of the work.
/// @returns whether to stop
bool CorrectedRun::stopped(std::size_t next, std::span<const Shaking> shakings) const
{
    if (!progress_) return false;
    constexpr long parts = 10;
    const auto step = static_cast<long>(next), steps = parts * static_cast<long>(shakings.size());
    const double end = duration(*shakings[next].motion);
    return progress_({end * static_cast<double>(step) / static_cast<double>(steps), end, step, steps}) == RunAnswer::stop;
}

std::optional<CorrectedRun::OnFewModes> CorrectedRun::on_few_modes(const Shaking& shaking) const
{
    const Stopwatch clock;
    const bool constant = Strength(shaking.contact, full_.structure().plane()).constant();
    std::optional<Choice> choice;
    std::vector<RunResult> passes = few_.passes(shaking, [&](std::span<const RunResult> so_far) {
        choice = coarsest_within(so_far, constant ? contact_order : sudden_order, few_.wanted(so_far.back()));
        return choice || so_far.size() == most_passes;
    });
    if (!choice) return std::nullopt;
    return OnFewModes{choice->of_step, choice->of_correction, std::move(passes[choice->coarse]), std::move(passes.back()),
                      clock.seconds()};
}

/// The full run at the steps of few.coarse. @returns whether its slip is within the tolerance now
bool CorrectedRun::correct(const GroundMotion& motion, const OnFewModes& few, RunResult& run) const
{
    if (run.status == Status::interrupted) return true;
    if (run.status != Status::at_rest) return false;
    run.slip_error = few.of_step + std::max(few.of_correction, largest_difference(run.history.slip, few.coarse.history.slip));
    if (run.slip_error > few_.wanted(run)) return false;
    run.seconds.dynamics += few.seconds;
    slide_farther(full_.structure(), few.coarse, few.fine, duration(motion), run);
    return true;
}

std::vector<RunResult> CorrectedRun::run_all(std::span<const Shaking> shakings) const
{
    std::vector<RunResult> results(shakings.size());
    std::vector<std::optional<OnFewModes>> few(shakings.size());
    std::map<int, std::vector<std::size_t>> of_steps; ///< numbers of shakings, by halvings
    std::vector<std::size_t> halved;
    bool stop = false;
    for (std::size_t i = 0; i < shakings.size(); ++i) {
        stop = stop || stopped(i, shakings);
        if (!stop) few[i] = on_few_modes(shakings[i]);
        (few[i] ? of_steps[few[i]->coarse.halvings] : halved).push_back(i);
    }
    const auto those = [&](const std::vector<std::size_t>& numbers) {
        std::vector<Shaking> chosen;
        for (const std::size_t i : numbers) chosen.push_back(shakings[i]);
        return chosen;
    };
    for (const auto& [halvings, numbers] : of_steps) {
        std::vector<RunResult> runs = full_.run_all(those(numbers), ChosenSteps{halvings, {}});
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const std::size_t i = numbers[k];
            results[i] = std::move(runs[k]);
            if (!correct(*shakings[i].motion, *few[i], results[i])) halved.push_back(i);
        }
    }
    if (halved.empty()) return results;
    std::vector<RunResult> runs = full_.run_halved(those(halved));
    for (std::size_t k = 0; k < runs.size(); ++k) results[halved[k]] = std::move(runs[k]);
    return results;
}

std::unique_ptr<const StepCorrector> corrected_run(const EarthquakeRun& full, const Scene& scene, const RunOptions& options)
{
    return std::make_unique<const CorrectedRun>(full, scene, options);
}

} // namespace damslip::fe2d
