#include "analysis/fragility/conditioned_plan.hpp"
#include "analysis/fragility/fragility_estimate.hpp"
#include "analysis/sweep/sweep_grid.hpp"
#include "probability/distribution.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/block_slip.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

/// What `damslip fragility` itself does, from the tables of a scene to P: draws, runs of the rigid block, estimate.
namespace damslip::verification {

namespace {

using Check = damslip::verification::Check;
using probability::normal_cdf;

constexpr double gravity_of_command = 9.81, plateau = 4.0, plateau_step = 0.01; // [m/s2], [m/s2], [s]
constexpr double friction_median = 0.3, friction_beta = 0.2, slip_limit = 0.2;  // [-], [-], [m]
constexpr int replicates = 4;

std::vector<double> plateau_samples(double a)
{
    std::vector<double> samples(54, a);
    samples.front() = samples[52] = samples[53] = 0.0;
    return samples;
}

/// Accelerations of both signs that end at rest.
std::vector<double> irregular_samples(double phase)
{
    std::vector<double> a;
    for (int k = 0; k <= 400; ++k) {
        const double t = 0.02 * k;
        a.push_back(3.0 * std::sin(5.0 * t + phase) * std::sin(0.125 * std::numbers::pi * t) *
                    (2.0 + std::cos(23.0 * t)));
    }
    return a;
}

RecordPair recorded(const std::string& name, std::vector<double> samples, double dt)
{
    RecordPair pair;
    pair.files.name = pair.horizontal.name = name;
    pair.horizontal.dt = dt;
    pair.horizontal.acceleration = std::move(samples);
    return pair;
}

/// A block on a dry base that slides downstream alone. @param more  further tables
SceneText block_text(const std::string& more = "")
{
    return {fmt::format("[section]\nheight_m = 50\nbase_m = 40\ncrest_m = 5\n[dam]\ndensity_kg_m3 = 2400\n"
                        "young_modulus_GPa = 25\npoisson_ratio = 0.2\n[contact]\nfriction = 0.7\n"
                        "[sliding]\ntwo_way = false\n{}",
                        more),
            "block.toml"};
}

/// Each record an event of its own, used as it is at the level `plateau`.
ShakingSuite suite_of_pairs(std::vector<RecordPair> pairs)
{
    ShakingSuite suite;
    for (const RecordPair& pair : pairs) {
        suite.event.push_back(pair.files.name);
        suite.weight.push_back(1.0);
        suite.intensity.push_back(plateau);
    }
    suite.pairs = std::make_shared<const std::vector<RecordPair>>(std::move(pairs));
    return suite;
}

ShakingSuite suite_of_plateau()
{
    return suite_of_pairs({recorded("pulse", plateau_samples(plateau), plateau_step)});
}

RandomVariable lognormal_variable(const std::string& name, const std::string& key, double median, double beta)
{
    RandomVariable v;
    v.name = name;
    v.keys = {key};
    v.law = {"lognormal", {{"median", median}, {"beta", beta}}, {}, {}, {}};
    return v;
}

FragilityInput input_of_command()
{
    FragilityInput input;
    input.probability.sampling = SamplingInput::random;
    input.probability.replicates = replicates;
    input.probability.variables = {lognormal_variable("mu", "contact.friction", friction_median, friction_beta)};
    input.intensity.levels = {plateau};
    input.limits = {{LimitQuantity::slip, slip_limit, "slip > 200 mm"}};
    input.suite = SuiteInput{};
    input.suite->polarity = SuitePolarity::as_recorded;
    return input;
}

struct CommandRun {
    FragilityPlan plan;
    FragilityRuns runs;
    FragilityEstimate estimate;
    const LevelEstimate& level() const { return estimate.limits.front().levels.front(); }
};

FragilityRuns runs_of_plan(const FragilityPlan& plan, const SceneText& text)
{
    Watch watch;
    return run_fragility(plan, text, sweep_method("rigid"), wanted_samples(plan), nullptr, 1, watch);
}

CommandRun command(const SceneText& text, const FragilityInput& input, const ShakingSuite& suite, std::size_t samples)
{
    CommandRun done;
    done.plan = plan_fragility(input, suite, {samples}, text.file(), [](const std::string&) { return 1.0; });
    done.runs = runs_of_plan(done.plan, text);
    done.estimate = estimate_fragility(done.plan, done.runs, nullptr, {});
    return done;
}

/// P(mu* of every record) without a draw, as --conditioning on has it.
LevelEstimate conditioned_command(const SceneText& text, const FragilityInput& input, const ShakingSuite& suite)
{
    Watch watch;
    const ConditionedPlan plan = condition_rigid(
        input, suite, text, [](const std::string&) { return 1.0; }, sweep_method("rigid"), {}, watch);
    return estimate_fragility(plan.plan, runs_of_plan(plan.plan, text), nullptr, {}, &plan).limits[0].levels[0];
}

/// Largest friction with a slip of more than d; the slip falls with the friction.
template <class Slip>
double friction_of_slip(double d, Slip slip)
{
    double low = 0.01, high = 5.0;
    for (int k = 0; k < 60; ++k) {
        const double mid = 0.5 * (low + high);
        (slip(mid * gravity_of_command) > d ? low : high) = mid;
    }
    return low;
}

double interpolant_friction(const std::vector<double>& samples, double dt, double d)
{
    return friction_of_slip(d, [&](double yield) { return exact::slip_of_interpolant(samples, dt, yield, INFINITY); });
}

/// Latin hypercubes, and Sobol' points of a power of two, meet F(μ*) to one of the points of a replicate.
double one_stratum(int samples)
{
    return static_cast<double>(replicates) / samples;
}

double share_below(double mu)
{
    return normal_cdf(std::log(mu / friction_median) / friction_beta);
}

std::vector<Check> conditioned_pulses()
{
    std::vector<Check> checks;
    const SceneText text = block_text();
    FragilityInput input = input_of_command();
    const auto pulse = [&](const std::string& name, const std::vector<double>& samples, double dt, double mu) {
        checks.push_back({name + ": P = F(μ*)", "–", share_below(mu),
                          conditioned_command(text, input, suite_of_pairs({recorded("pulse", samples, dt)})).p, 1e-9});
    };
    pulse("plateau with flanks", plateau_samples(plateau), plateau_step,
          interpolant_friction(plateau_samples(plateau), plateau_step, slip_limit));
    pulse("triangle", {0.0, plateau, 0.0, 0.0}, 0.5, friction_of_slip(slip_limit, [](double yield) {
              return yield < plateau ? exact::slip_under_triangle(plateau, 0.5, yield) : 0.0;
          }));
    constexpr int half = 100'000; // chords of a sine are (π/half)²/12 below it: 8e-11
    std::vector<double> sine(half + 2, 0.0);
    for (int k = 0; k < half; ++k) sine[static_cast<std::size_t>(k)] = plateau * std::sin(std::numbers::pi * k / half);
    pulse("half sine", sine, 0.8 / half, friction_of_slip(slip_limit, [](double yield) {
              return yield < plateau ? exact::slip_under_half_sine(plateau, std::numbers::pi / 0.8, yield) : 0.0;
          }));
    std::vector<RecordPair> pairs;
    double mean = 0.0, reversed = 0.0;
    for (const double phase : {0.0, 0.7, 1.9}) {
        std::vector<double> samples = irregular_samples(phase);
        mean += share_below(interpolant_friction(samples, 0.02, slip_limit)) / 3.0;
        pairs.push_back(recorded(fmt::format("phase {}", phase), samples, 0.02));
        for (double& a : samples) a = -a;
        reversed += share_below(interpolant_friction(samples, 0.02, slip_limit)) / 3.0;
    }
    const ShakingSuite suite = suite_of_pairs(std::move(pairs));
    checks.push_back(
        {"three irregular motions: P = mean of F(μ*)", "–", mean, conditioned_command(text, input, suite).p, 1e-9});
    input.suite.reset();
    checks.push_back({"both polarities, as without [suite]: mean over six", "–", 0.5 * (mean + reversed),
                      conditioned_command(text, input, suite).p, 1e-9});
    return checks;
}

std::vector<Check> sequence_of_command()
{
    const std::vector<double> first = irregular_samples(0.0), second = irregular_samples(1.9);
    RecordPair both = recorded("first, then second", first, 0.02);
    both.parts = {recorded("first", first, 0.02), recorded("second", second, 0.02)};
    const double mu = friction_of_slip(slip_limit, [&](double yield) {
        return exact::slip_of_interpolant(first, 0.02, yield, INFINITY) +
               exact::slip_of_interpolant(second, 0.02, yield, INFINITY);
    });
    const SceneText text = block_text();
    const FragilityInput input = input_of_command();
    std::vector<Check> checks{{"P of a sequence: F(μ*), D₁(μ*) + D₂(μ*) = d", "–", share_below(mu),
                               conditioned_command(text, input, suite_of_pairs({both})).p, 1e-9}};
    const CommandRun together = command(text, input, suite_of_pairs({both}), 64),
                     one = command(text, input, suite_of_pairs({both.parts[0]}), 64),
                     two = command(text, input, suite_of_pairs({both.parts[1]}), 64);
    double difference = 0.0, largest = 0.0;
    for (std::size_t id = 0; id < together.runs.rows.size(); ++id) {
        const auto slip = [id](const CommandRun& run) { return run.runs.rows[id]->results.slip.value_or(NAN); };
        difference = std::max(difference, std::abs(slip(together) - slip(one) - slip(two)));
        largest = std::max(largest, slip(together));
    }
    checks.push_back({"64 runs: largest |D - D₁ - D₂|", "m", 0.0, difference, 1e-9 * largest, Measure::absolute});
    checks.push_back({"their largest slip", "m", slip_limit, largest, 0.0, Measure::lower_bound});
    return checks;
}

std::vector<Check> lost_runs()
{
    std::vector<Check> checks;
    const SceneText text = block_text();
    CommandRun full = command(text, input_of_command(), suite_of_plateau(), 1024);
    const double p = full.level().p;
    const std::size_t n = full.runs.rows.size();
    struct Lost {
        const char* name;
        bool (*is_lost)(std::size_t id, bool fails);
    };
    const Lost ways[] = {{"every tenth", [](std::size_t id, bool) { return id % 10 == 0; }},
                         {"a tenth, all failures", [](std::size_t id, bool fails) { return fails && id % 5 == 0; }},
                         {"a tenth, all survivals", [](std::size_t id, bool fails) { return !fails && id % 5 == 0; }}};
    for (const Lost& way : ways) {
        FragilityRuns runs = full.runs;
        double lost = 0.0;
        for (std::size_t id = 0; id < n; ++id) {
            const bool fails = answer_to(full.plan.input.limits.front(), full.runs.rows[id]) == LimitAnswer::fails;
            if (!way.is_lost(id, fails)) continue;
            FinishedRow row = *runs.rows[id];
            row.results.status = word(Status::not_resolved);
            runs.rows.put(row);
            lost += 1.0;
        }
        const LevelEstimate level = estimate_fragility(full.plan, runs, nullptr, {}).limits[0].levels[0];
        const std::string name = way.name;
        checks.push_back({name + " lost: told", "–", lost, level.missing, 1e-12});
        checks.push_back({name + ": width of the bounds, lost runs over all", "–", lost / static_cast<double>(n),
                          level.p_high - level.p_low, 1e-9});
        checks.push_back({name + ": P of all runs at least", "–", level.p_low, p, 1e-15, Measure::lower_bound});
        checks.push_back({name + ": and at most", "–", level.p_high, p, 1e-15, Measure::upper_bound});
        checks.push_back({name + ": interval from below the lower bound", "–", level.p_low, level.sampling.lower, 0.0,
                          Measure::upper_bound});
        checks.push_back(
            {name + ": to above the upper one", "–", level.p_high, level.sampling.upper, 0.0, Measure::lower_bound});
    }
    return checks;
}

std::vector<Check> command_draws()
{
    std::vector<Check> checks;
    const SceneText text = block_text();
    const FragilityInput input = input_of_command();
    const double exact = share_below(interpolant_friction(plateau_samples(plateau), plateau_step, slip_limit));
    for (const auto& [name, sampling] : {std::pair{"random", SamplingInput::random},
                                         {"Latin hypercubes", SamplingInput::latin_hypercube},
                                         {"Sobol'", SamplingInput::sobol}}) {
        FragilityInput drawn = input;
        drawn.probability.sampling = sampling;
        const CommandRun run = command(text, drawn, suite_of_plateau(), 2048);
        const double scatter = 4.0 * std::sqrt(exact * (1.0 - exact) / 2048.0);
        checks.push_back({fmt::format("plateau, {}: P of 2048 runs", name), "–", exact, run.level().p,
                          sampling == SamplingInput::random ? scatter : one_stratum(2048), Measure::absolute});
    }
    // Amplitude and friction by the copula: slides at all where A f > mu g.
    FragilityInput correlated = input;
    correlated.probability.variables.push_back(lognormal_variable("a", "motion.scale", 0.9, 0.3));
    correlated.limits.front().value = 1e-12;
    for (const double spearman : {0.0, 0.6, -0.5}) {
        correlated.probability.correlations.clear();
        if (spearman != 0.0) correlated.probability.correlations = {{"mu", "a", spearman, {}}};
        const double r = 2.0 * std::sin(std::numbers::pi * spearman / 6.0);
        const double beta = std::sqrt(0.09 + friction_beta * friction_beta - 2.0 * r * 0.3 * friction_beta);
        const double p = normal_cdf(std::log(0.9 * plateau / (gravity_of_command * friction_median)) / beta);
        checks.push_back(
            {fmt::format("amplitude and friction, rank correlation {}: share that slides, 4096 runs", spearman), "–", p,
             command(text, correlated, suite_of_plateau(), 4096).level().p, 4.0 * std::sqrt(p * (1.0 - p) / 4096.0),
             Measure::absolute});
    }
    FragilityInput unknown = input;
    unknown.probability.sampling = SamplingInput::latin_hypercube;
    unknown.probability.variables.front().kind = VariableKind::epistemic;
    const CommandRun bands = command(text, unknown, suite_of_plateau(), 2048);
    const auto& of = bands.level().bands;
    checks.push_back({"friction not known: P_e is 0 or 1, mean of the bands", "–", exact, of ? of->mean : NAN,
                      one_stratum(2048), Measure::absolute});
    checks.push_back(
        {"runs within an epistemic draw", "–", 1.0, static_cast<double>(bands.plan.inner), 0.0, Measure::absolute});
    checks.push_back({"share of noise within the bands", "–", 0.0, of ? of->noise_share : NAN, 0.0, Measure::absolute});
    checks.push_back(
        {"5 % of P_e", "–", exact > 0.95 ? 1.0 : 0.0, of ? of->percentiles.front() : NAN, 0.0, Measure::absolute});
    checks.push_back(
        {"95 % of P_e", "–", exact > 0.05 ? 1.0 : 0.0, of ? of->percentiles.back() : NAN, 0.0, Measure::absolute});
    return checks;
}

std::vector<Check> ends_of_command()
{
    const SceneText text = block_text("[reservoir]\nlevel_m = 45\n[uplift]\nmodel = \"none\"\n");
    FragilityInput input = input_of_command();
    input.limits.front().value = 1e3;
    input.intensity.levels = {0.01}; // moves no dam that stands
    const double critical = prepare(text.scene(), Method::rigid_block).rigid_model().critical_friction;
    input.probability.variables.front().law.parameters["median"] = 1.2 * critical;
    const double p = normal_cdf(std::log(1.0 / 1.2) / friction_beta);
    std::vector<Check> checks{{"does not stand: P = p_static = F(critical friction)", "–", p,
                               conditioned_command(text, input, suite_of_plateau()).p, 1e-9}};
    FragilityInput stratified = input;
    stratified.probability.sampling = SamplingInput::latin_hypercube;
    const CommandRun hypercubes = command(text, stratified, suite_of_plateau(), 1024);
    checks.push_back(
        {"Latin hypercubes, 1024 runs: P", "–", p, hypercubes.level().p, one_stratum(1024), Measure::absolute});
    checks.push_back({"and the share that is told", "–", hypercubes.level().p, hypercubes.estimate.p_static, 1e-12});
    const CommandRun all = command(text, input, suite_of_plateau(), 4096);
    checks.push_back(
        {"4096 runs: P", "–", p, all.level().p, 4.0 * std::sqrt(p * (1.0 - p) / 4096.0), Measure::absolute});
    checks.push_back({"and the share that is told", "–", all.level().p, all.estimate.p_static, 1e-12});
    input.probability.static_failure = StaticFailure::given_standing;
    const CommandRun standing = command(text, input, suite_of_plateau(), 4096);
    checks.push_back({"given standing: no failure", "–", 0.0, standing.level().z, 0.0, Measure::absolute});
    checks.push_back(
        {"runs that count: those that stand", "–", 4096.0 * (1.0 - all.estimate.p_static), standing.level().n, 1e-12});
    const double k2 = std::pow(probability::normal_quantile(0.975), 2), n = standing.level().n;
    checks.push_back({"no failure of n: lower end", "–", 0.0, standing.level().sampling.lower, 0.0, Measure::absolute});
    checks.push_back(
        {"no failure of n: upper end k²/(n + k²)", "–", k2 / (n + k2), standing.level().sampling.upper, 1e-9});
    return checks;
}

std::vector<Check> same_bits()
{
    const SceneText text = block_text();
    FragilityInput input = input_of_command();
    input.intensity.levels = {0.5 * plateau, 0.75 * plateau, plateau};
    const CommandRun one = command(text, input, suite_of_plateau(), 512);
    const auto different = [&](const FragilityRuns& runs) {
        double n = 0.0;
        for (std::size_t id = 0; id < one.runs.rows.size(); ++id)
            n += !runs.rows[id] || runs.rows[id]->results != one.runs.rows[id]->results;
        return n;
    };
    Watch watch;
    const FragilityRuns threads =
        run_fragility(one.plan, text, sweep_method("rigid"), wanted_samples(one.plan), nullptr, 4, watch);
    FragilityRuns parts = no_runs(one.plan, one.plan.samples.size());
    for (std::size_t i = 0; i < 3; ++i) {
        const FragilityRuns part =
            run_fragility(one.plan, text, sweep_method("rigid"), wanted_samples(one.plan, {i, 3}), nullptr, 1, watch);
        for (std::size_t id = 0; id < part.rows.size(); ++id)
            if (part.rows.has(id)) parts.rows.put(*part.rows[id]);
    }
    FragilityInput more = input;
    more.probability.variables.insert(more.probability.variables.begin(),
                                      lognormal_variable("stiffness", "dam.young_modulus_GPa", 25.0, 0.1));
    const CommandRun added = command(text, more, suite_of_plateau(), 512);
    double draws = 0.0;
    for (std::size_t i = 0; i < one.plan.draws.size(); ++i)
        draws += std::get<double>(added.plan.draws[i].values[1]) != std::get<double>(one.plan.draws[i].values[0]);
    return {
        {"runs that differ with 4 threads, of 1536", "–", 0.0, different(threads), 0.0, Measure::absolute},
        {"with three parts", "–", 0.0, different(parts), 0.0, Measure::absolute},
        {"with a variable added that moves no rigid block", "–", 0.0, different(added.runs), 0.0, Measure::absolute},
        {"frictions drawn otherwise with it", "–", 0.0, draws, 0.0, Measure::absolute}};
}

} // namespace

void add_probability_command_cases(Registry& registry)
{
    registry.push_back({"probability.conditioned",
                        "Friction that is not drawn: P of a block under pulses and irregular motions",
                        "D(μ*) = d by closed slips and by an integrator of its own; P = mean of F(μ*)",
                        "μ* is found to the last bit: 1e-9", conditioned_pulses});
    registry.push_back({"probability.sequence", "Slips of a sequence add up, and P is that of their sum",
                        "D = D₁ + D₂ of constant yield", "1e-9", sequence_of_command});
    registry.push_back({"probability.missing", "Runs without an answer: the bounds hold the answer of all runs",
                        "lost runs as survivals, as failures", "counts are exact; sums to round-off", lost_runs});
    registry.push_back({"probability.draws", "Runs of random friction and amplitude, drawn as the command draws them",
                        "F(μ*); Φ(ln(A/(gμ))/√(β_A² + β_μ² - 2 r β_A β_μ)), medians", "4 √(P(1-P)/N)", command_draws});
    registry.push_back({"probability.static", "A dam that does not stand, and intervals where none fails",
                        "F(critical friction); Wilson (1927)", "exact ones 1e-9; drawn ones 4 √(P(1-P)/N)",
                        ends_of_command});
    registry.push_back({"probability.same-bits", "Threads, parts and variables added change no run",
                        "the run by one thread", "exact", same_bits});
}

} // namespace damslip::verification
