#include "analysis/screen/elastic.hpp"

#include "analysis/fe/contact_runs.hpp"
#include "core/input_error.hpp"

#include <fmt/format.h>
#include <limits>

namespace damslip {

Verdict ElasticScreening::verdict(const std::optional<double>& allowable) const
{
    const Verdict verdict = runs.empty() ? Verdict::undecided : verdict_of(runs, allowable);
    return verdict == Verdict::pass && !why_not.empty() ? Verdict::undecided : verdict;
}

ElasticScreening screen_elastic(const Ready& ready, int jobs, Watch& watch)
{
    ElasticScreening out;
    if (const auto why_not = why_not_reducible(ready.given)) {
        out.why_not = why_not->problem;
        return out;
    }
    Scene given = ready.given;
    given.time.substeps.reset();
    given.time.slip_tolerance = std::numeric_limits<double>::infinity(); // one halving, for the error estimate
    try {
        const Ready elastic =
            prepare(std::move(given), Method::finite_elements, ready.pairs, {.seepage = ready.seepage, .stop = watch.stop()});
        ContactRuns all(elastic, {.mesh_error = false, .reduced = true, .jobs = jobs}, watch);
        out.why_not = text_of(all.why_not());
        if (!out.why_not.empty()) return out;
        out.runs = all.run([](ContactRun& run, const GroundMotion&) { run.fe.history = {}; });
        if (out.runs.size() < all.whole())
            out.why_not = fmt::format("Stopped after {} of {} runs.", out.runs.size(), all.whole());
    } catch (const InputError& error) {
        out.why_not = error.diagnostics().front().problem;
    } catch (const NotConverged& error) {
        out.why_not = error.diagnostic().problem;
    }
    return out;
}

} // namespace damslip
