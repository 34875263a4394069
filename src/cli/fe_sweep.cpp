#include "cli/fe_sweep.hpp"

#include "cli/contact_options.hpp"
#include "cli/contact_tables.hpp"
#include "cli/fe_inputs.hpp"
#include "core/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::cli {

namespace {

FeSlip slip_of(const fe2d::RunResult& r)
{
    FeSlip slip;
    slip.status = word(r.status);
    slip.good = ended_properly(r.status);
    if (!r.stages.empty()) slip.critical_friction = r.stages.back().friction_needed;
    if (r.history.time.empty()) return slip;
    slip.slip = r.slip;
    slip.max_slip = r.max_slip;
    if (!std::isnan(r.slip_error)) slip.slip_error = r.slip_error;
    return slip;
}

void count(const fe2d::RunResult& r, FeSweepCounts& counts)
{
    ++counts.runs;
    counts.static_failures += r.status == fe2d::RunStatus::static_failure;
    counts.steps += r.counts.steps;
    counts.unresolved += r.counts.unresolved;
    counts.static_seconds += r.seconds.statics;
    counts.dynamic_seconds += r.seconds.dynamics;
}

} // namespace

std::vector<FeSlip> fe_slips(const Scene& given, const std::vector<double>& friction,
                             const std::vector<RecordPair>& records, const std::vector<GroundMotion>& motions, int jobs,
                             Progress& progress, const InterruptGuard& interrupt, FeSweepCounts& counts)
{
    Scene scene = fe_scene(given, make_effect_plan(given, Method::finite_elements));
    if (scene.added_mass.period_of_dam) resolve_dam_period(scene);
    SeepageSource seepage;
    fe2d::RunOptions options = contact_options(scene, records, seepage);
    options.progress = [&](const fe2d::RunProgress&) {
        return interrupt.interrupted() ? fe2d::RunAnswer::stop : fe2d::RunAnswer::go_on;
    };
    const fe2d::EarthquakeRun model(scene, options);
    ++counts.set_ups;
    counts.set_up_seconds += model.seconds();

    const std::size_t n = friction.size(), threads = static_cast<std::size_t>(thread_count(jobs)),
                      shares = std::min(n, (threads + motions.size() - 1) / motions.size());
    std::vector<FeSlip> slips(n * motions.size());
    std::vector<FeSweepCounts> counted(motions.size() * shares);
    parallel_for(counted.size(), jobs, [&](std::size_t task) {
        const std::size_t motion = task / shares;
        std::vector<std::size_t> mine; // every shares-th friction: low ones fail at once, high ones slide little
        std::vector<Contact> contacts;
        for (std::size_t k = task % shares; k < n; k += shares) {
            mine.push_back(k);
            contacts.push_back(friction[k] == scene.contact.friction ? scene.contact
                                                                     : with_friction(scene, friction[k]).contact);
        }
        if (!interrupt.interrupted()) {
            const std::vector<fe2d::RunResult> results = model.run_all(motions[motion], contacts);
            for (std::size_t i = 0; i < results.size(); ++i) {
                slips[motion * n + mine[i]] = slip_of(results[i]);
                count(results[i], counted[task]);
            }
        }
        progress.advance(mine.size());
    });
    for (const FeSweepCounts& c : counted) {
        counts.runs += c.runs;
        counts.static_failures += c.static_failures;
        counts.steps += c.steps;
        counts.unresolved += c.unresolved;
        counts.static_seconds += c.static_seconds;
        counts.dynamic_seconds += c.dynamic_seconds;
    }
    counts.factorisations += model.factorisations();
    return slips;
}

} // namespace damslip::cli
