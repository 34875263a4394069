#include "analysis/accuracy/ladder.hpp"

#include "analysis/accuracy/accuracy.hpp"
#include "core/watch.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

constexpr int reduced_modes[] = {6, 12, 24};
constexpr double penalties[] = {2e8, 1e10, 1e11}; // [N/m^3]; the first is about Abaqus' slip tolerance of 0.005
constexpr double wave_boxes[] = {0.7, 1.4};       // of radiating rock, over the automatic one
constexpr int finest_step = 7;                    // halvings
constexpr double finest_mesh = 0.125;             // element sizes over the scene's
constexpr double quadratic_unknowns = 3.0;        // of Q8 over those of Q4 of the same size
constexpr double settled_slip = 1e-4;             // [m]: changes below the tolerance's share of it do not matter

const RungResult* find(const std::vector<RungResult>& results, const Rung& rung)
{
    const auto at = std::find_if(results.begin(), results.end(), [&](const RungResult& r) { return r.rung == rung; });
    return at == results.end() ? nullptr : &*at;
}

Rung fe_rung(RungWater water, int halvings, double mesh = 1.0)
{
    Rung rung;
    rung.family = RungFamily::finite_elements;
    rung.water = water;
    rung.halvings = halvings;
    rung.mesh = mesh;
    return rung;
}

bool of_model(const RungResult& r, RungWater water)
{
    return r.done() && r.rung.family == RungFamily::finite_elements && r.rung.water == water && r.rung.plain();
}

/// Does what the finest rung of a row or column leaves open no longer matter, for every motion, by an order that can be
/// believed?
/// @param elsewhere  row that shows an order where this one has two rungs only; may be empty
bool settled(const std::vector<const RungResult*>& row, double tolerance,
             const std::vector<const RungResult*>& elsewhere = {})
{
    for (std::size_t motion = 0; motion < row.back()->slip.size(); ++motion) {
        const std::vector<double> slips = slips_of(row, motion);
        const std::optional<Limit> limit = extrapolated(slips, 2.0, observed_order(slips_of(elsewhere, motion)));
        if (!limit || !limit->plausible() ||
            std::abs(limit->correction) > tolerance * std::max(std::abs(slips.back()), settled_slip))
            return false;
    }
    return true;
}

/// How far the row of a model goes: the halvings to run next, or the end of it.
struct Row {
    bool complete = false;
    int last = -1; ///< halvings of the last done; of the one to run next where not complete
};

Row row_of(RungWater water, const LadderOptions& options, const std::vector<RungResult>& so_far)
{
    const int least = options.effort == Effort::quick ? 2 : 3, most = options.effort == Effort::quick ? 4 : 6;
    const std::vector<const RungResult*> done = step_row(so_far, water);
    const int n = static_cast<int>(done.size());
    const RungResult* next = find(so_far, fe_rung(water, n));
    if (next || n > most || (n > least && settled(done, 0.25 * options.tolerance))) return {true, n - 1};
    return {false, n};
}

void add_variants(const LadderFacts& facts, RungWater water, int halvings, std::vector<Rung>& rungs)
{
    const auto variant = [&](auto&& change) {
        Rung rung = fe_rung(water, halvings);
        change(rung);
        rungs.push_back(rung);
    };
    if (facts.reducible)
        for (const int modes : reduced_modes) variant([&](Rung& r) { r.modes = modes; });
    for (const double stiffness : penalties) variant([&](Rung& r) { r.tangential_stiffness = stiffness; });
    for (const double alpha : facts.alphas) variant([&](Rung& r) { r.alpha = alpha; });
    if (facts.rock == RockKind::radiating)
        for (const double size : wave_boxes) variant([&](Rung& r) { r.wave_box = size; });
}

/// What the rock does: the other of massless and radiating rock beside the scene's.
void add_rock(const LadderFacts& facts, RungWater water, int halvings, std::vector<Rung>& rungs)
{
    if (facts.rock != RockKind::radiating && facts.rock != RockKind::massless) return;
    rungs.push_back(fe_rung(water, halvings));
    rungs.back().rock = facts.rock == RockKind::radiating ? RungRock::massless : RungRock::radiating;
}

/// Quadratic elements of the scene's size and, where it leaves enough of them, of twice that: about as many unknowns as
/// linear ones of half and of the same size, which are rungs with the same step.
void add_elements(const LadderFacts& facts, RungWater water, int halvings, std::vector<Rung>& rungs)
{
    for (const double mesh : {2.0, 1.0}) {
        if (mesh > facts.coarsest) continue;
        rungs.push_back(fe_rung(water, halvings, mesh));
        rungs.back().element = "q8";
    }
}

void add_cheap(const LadderFacts& facts, std::vector<Rung>& rungs)
{
    for (const std::string& id : facts.regressions) {
        Rung rung;
        rung.family = RungFamily::regression;
        rung.regression = id;
        rungs.push_back(rung);
    }
    for (const Components components : {Components::horizontal, Components::both}) {
        if (components == Components::both && !facts.vertical) continue;
        Rung rung;
        rung.components = components;
        rungs.push_back(rung);
        rung.scheme = RigidScheme::slammer;
        if (facts.slammer) rungs.push_back(rung);
        rung.scheme = RigidScheme::rocking;
        if (facts.rocks) rungs.push_back(rung);
    }
}

} // namespace

std::vector<Rung> ladder(const LadderFacts& facts, const LadderOptions& options, const std::vector<RungResult>& so_far)
{
    std::vector<Rung> rungs;
    add_cheap(facts, rungs);
    std::vector<int> ends;
    for (const RungWater water : facts.waters) {
        const Row row = row_of(water, options, so_far);
        for (int k = 0; k <= row.last; ++k) rungs.push_back(fe_rung(water, k));
        if (!row.complete) return rungs;
        ends.push_back(row.last);
        if (row.last < 1) continue; // not even two steps: nothing to compare beside
        Rung chosen = fe_rung(water, 0);
        chosen.step = StepChoice::by_tolerance;
        rungs.push_back(chosen);
        chosen.step = StepChoice::adaptive;
        rungs.push_back(chosen);
        chosen.step = StepChoice::as_the_scene;
        if (facts.own_settings) rungs.push_back(chosen);
        for (double mesh = facts.coarsest; mesh > 1.0; mesh /= 2.0) rungs.push_back(fe_rung(water, row.last - 1, mesh));
        if (water == facts.waters.back() && facts.quadratic && options.effort == Effort::full)
            add_elements(facts, water, row.last - 1, rungs);
        add_rock(facts, water, row.last - 1, rungs);
        if (water == facts.waters.front() && options.effort == Effort::full)
            add_variants(facts, water, row.last - 1, rungs);
        else if (water == facts.waters.front() && facts.reducible) {
            rungs.push_back(fe_rung(water, row.last - 1));
            rungs.back().modes = reduced_modes[1];
        }
    }
    if (options.effort == Effort::quick || facts.waters.empty()) return rungs;
    for (std::size_t i = 0; i < facts.waters.size(); ++i)
        if (ends[i] >= 1) rungs.push_back(fe_rung(facts.waters[i], ends[i] - 1, 0.5));
    const RungWater rich = facts.waters.back();
    if (ends.back() < 1) return rungs;
    double mesh = 0.5; // of the rich model halved on until the slip is settled in the mesh too
    const RungResult* last = find(so_far, fe_rung(rich, ends.back() - 1, mesh));
    while (last && last->done() && mesh > finest_mesh) {
        last = find(so_far, fe_rung(rich, ends.back() - 1, 0.5 * mesh));
        if (!last && settled(mesh_column(so_far, rich), 0.25 * options.tolerance)) break;
        rungs.push_back(fe_rung(rich, ends.back() - 1, 0.5 * mesh));
        if (!last) return rungs;
        if (last->done()) mesh *= 0.5;
    }
    rungs.push_back(fe_rung(rich, ends.back(), mesh));
    for (int k = ends.back(); k < finest_step; ++k) { // on fine meshes slips may need smaller steps than on the scene's
        const RungResult* done = find(so_far, fe_rung(rich, k, mesh));
        if (!done || !done->done()) break;
        if (!find(so_far, fe_rung(rich, k + 1, mesh)) &&
            settled(fine_row(so_far, rich), 0.25 * options.tolerance, step_row(so_far, rich)))
            break;
        rungs.push_back(fe_rung(rich, k + 1, mesh));
    }
    return rungs;
}

std::optional<Rung> next_rung(const LadderFacts& facts, const LadderOptions& options,
                              const std::vector<RungResult>& so_far)
{
    for (const Rung& rung : ladder(facts, options, so_far))
        if (!find(so_far, rung)) return rung;
    return std::nullopt;
}

bool below(const Rung& a, const Rung& b)
{
    if (a.family != b.family) return a.family < b.family;
    if (a.family == RungFamily::rigid) // the block that may rock above the exact one, that above SLAMMER's
        return std::pair(a.components, b.scheme) < std::pair(b.components, a.scheme);
    if (a.family == RungFamily::regression) return b.regression == "ensemble" && a.regression != "ensemble";
    if (a.water != b.water) return a.water < b.water;
    if (a.mesh != b.mesh) return a.mesh > b.mesh;
    return a.halvings < b.halvings;
}

std::optional<std::size_t> top_rung(const std::vector<RungResult>& results)
{
    std::optional<std::size_t> top;
    for (std::size_t i = 0; i < results.size(); ++i) {
        const RungResult& r = results[i];
        if (!r.done() || (r.rung.family == RungFamily::finite_elements && !r.rung.plain())) continue;
        if (!top || below(results[*top].rung, r.rung)) top = i;
    }
    return top;
}

std::vector<const RungResult*> step_row(const std::vector<RungResult>& results, RungWater water)
{
    std::vector<const RungResult*> row;
    for (;;) {
        const RungResult* next = find(results, fe_rung(water, static_cast<int>(row.size())));
        if (!next || !next->done()) return row;
        row.push_back(next);
    }
}

std::vector<const RungResult*> fine_row(const std::vector<RungResult>& results, RungWater water)
{
    std::vector<const RungResult*> best = step_row(results, water);
    for (double mesh = 0.5; mesh > 1e-3; mesh *= 0.5) {
        std::vector<const RungResult*> row;
        for (int k = 0; k <= 10; ++k) {
            const RungResult* next = find(results, fe_rung(water, k, mesh));
            if (next && next->done())
                row.push_back(next);
            else if (!row.empty())
                break;
        }
        if (row.size() > 1) best = std::move(row);
    }
    return best;
}

std::vector<double> slips_of(const std::vector<const RungResult*>& rungs, std::size_t motion)
{
    std::vector<double> slips;
    for (const RungResult* r : rungs) slips.push_back(r->slip[motion]);
    return slips;
}

std::vector<const RungResult*> mesh_column(const std::vector<RungResult>& results, RungWater water)
{
    std::vector<const RungResult*> best;
    for (int halvings = 0; halvings <= 10; ++halvings) {
        std::vector<const RungResult*> column;
        for (const RungResult& r : results)
            if (of_model(r, water) && r.rung.halvings == halvings) column.push_back(&r);
        if (column.size() >= best.size()) best = std::move(column);
    }
    std::sort(best.begin(), best.end(),
              [](const RungResult* a, const RungResult* b) { return a->rung.mesh > b->rung.mesh; });
    return best;
}

std::optional<double> expected_seconds(const Rung& rung, const std::vector<RungResult>& so_far)
{
    if (rung.family != RungFamily::finite_elements) return std::nullopt;
    const RungResult* nearest = nullptr;
    const auto distance = [&](const RungResult& r) {
        return 10.0 * (r.rung.water != rung.water) + std::abs(std::log2(r.rung.mesh / rung.mesh)) +
               0.1 * std::abs(r.rung.halvings - rung.halvings);
    };
    for (const RungResult& r : so_far)
        if (r.done() && r.rung.family == RungFamily::finite_elements && r.rung.plain() &&
            (!nearest || distance(r) < distance(*nearest)))
            nearest = &r;
    if (!nearest) return std::nullopt;
    const double more = rung.element.empty() ? 1.0 : std::pow(quadratic_unknowns, 1.25);
    const double unknowns = more * std::pow(nearest->rung.mesh / rung.mesh, 2.5);
    const bool chosen = rung.step == StepChoice::by_tolerance || rung.step == StepChoice::adaptive;
    const double steps = chosen ? 16.0 : std::exp2(rung.halvings); // 16: passes with whole steps to eighths
    const double run = nearest->seconds - nearest->set_up_seconds;
    const double water = nearest->rung.water == rung.water ? 1.0 : 2.0;
    return water * unknowns * (nearest->set_up_seconds + run * steps / std::exp2(nearest->rung.halvings));
}

namespace {

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

RungResult skipped(const Rung& rung, double expected, double left)
{
    RungResult result;
    result.rung = rung;
    result.outcome = RungOutcome::skipped;
    result.seconds = expected;
    result.remark = fmt::format("about {:.3g} s, {:.3g} s of the budget left", expected, std::max(0.0, left));
    return result;
}

} // namespace

RungResult run_repeatedly(const Rung& rung, int repeats, const ClimbCalls& calls)
{
    RungResult result = calls.run(rung);
    std::vector<double> seconds{result.seconds}, set_up{result.set_up_seconds};
    double spent = result.seconds;
    while (result.done() && static_cast<int>(seconds.size()) < repeats && spent + result.seconds < repeat_seconds) {
        const RungResult again = calls.run(rung);
        if (!again.done()) break; // interrupted: the first run counts
        seconds.push_back(again.seconds);
        set_up.push_back(again.set_up_seconds);
        spent += again.seconds;
    }
    result.repeats = static_cast<int>(seconds.size());
    result.seconds = median(seconds);
    result.set_up_seconds = median(set_up);
    return result;
}

std::vector<RungResult> climb(const LadderFacts& facts, const ClimbOptions& options, const ClimbCalls& calls)
{
    const ProcessorClock clock(ProcessorTimeOf::process);
    std::vector<RungResult> results;
    while (const std::optional<Rung> rung = next_rung(facts, options.ladder, results)) {
        if (calls.interrupted && calls.interrupted()) break;
        const double left = options.budget ? *options.budget - clock.seconds() : 0.0;
        const double least = calls.least_seconds ? calls.least_seconds(*rung) : 0.0;
        const double expected = std::max(least, expected_seconds(*rung, results).value_or(0.0));
        if (options.budget && expected >= left)
            results.push_back(skipped(*rung, expected, left));
        else {
            if (calls.begins) calls.begins(*rung);
            RungResult result = run_repeatedly(*rung, options.repeats, calls);
            if (result.outcome == RungOutcome::stopped) {
                if (!options.budget || (calls.interrupted && calls.interrupted())) break;
                result.outcome = RungOutcome::skipped;
                result.remark = fmt::format("ended after {:.3g} s, when the budget was spent", result.seconds);
            }
            results.push_back(std::move(result));
        }
        if (calls.ends) calls.ends(results);
    }
    return results;
}

} // namespace damslip
