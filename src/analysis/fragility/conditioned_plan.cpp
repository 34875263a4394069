#include "analysis/fragility/conditioned_plan.hpp"

#include "analysis/fragility/fragility_estimate.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "probability/annual_rate.hpp"
#include "probability/distribution.hpp"
#include "probability/fit.hpp"
#include "probability/sampling.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numeric>

namespace damslip {

namespace {

constexpr double least_tail = 0x1p-40;      // of the law of friction beyond what is looked at
constexpr double unsure_of_standing = 0.01; // ln mu: how far both models may differ on what stands
constexpr std::size_t pilot_frictions = 8;  // of one motion

/// The variable that is friction.
std::size_t friction_variable(const FragilityInput& input)
{
    const auto& variables = input.probability.variables;
    for (std::size_t v = 0; v < variables.size(); ++v)
        if (std::find(variables[v].keys.begin(), variables[v].keys.end(), "contact.friction") !=
            variables[v].keys.end())
            return v;
    return variables.size();
}

/// The law of friction, in values of the key.
class FrictionLaw {
public:
    FrictionLaw(const RandomVariable& variable, const SceneText& text, const NumberInFile& written)
        : law_(law_of(variable, text.file())), times_(variable.factor ? written(variable.keys.front()) : 1.0)
    {
    }
    double share_below(double mu) const { return law_.cdf(mu / times_); }
    double friction(double u) const { return times_ * law_.quantile(std::clamp(u, 0x1p-200, 1.0 - 0x1p-50)); }
    double drawn(double mu) const { return mu / times_; } ///< what the variable's value is
    double lowest() const { return std::max(1e-9, friction(least_tail)); }
    double highest() const { return friction(1.0 - least_tail); }

private:
    probability::Distribution law_;
    double times_;
};

/// A motion with one draw of all other variables, and what the rigid block says of friction under it.
struct FrictionMotion {
    std::size_t sample = 0;   ///< of the plan without friction
    double stands_from = 0.0; ///< critical friction: no more than this does not stand
    std::vector<double> star; ///< of each limit: it slides farther below; stands_from where it never does
};

/// The plan of all other variables, and how friction is put back.
class WithoutFriction {
public:
    WithoutFriction(const FragilityInput& input, const ShakingSuite& suite, const SceneText& text,
                    const NumberInFile& written, std::size_t motions)
        : place_(friction_variable(input)), law_(input.probability.variables[place_], text, written)
    {
        FragilityInput others = input;
        others.probability.samples.reset();
        others.probability.variables.erase(others.probability.variables.begin() + static_cast<std::ptrdiff_t>(place_));
        const bool both = input.suite.value_or(SuiteInput{}).polarity == SuitePolarity::both;
        const std::size_t ways = suite.pairs->size() * (both ? 2 : 1);
        const std::size_t whole = ways * ((motions + ways - 1) / ways); // each record with each polarity as often
        const auto replicates = static_cast<std::size_t>(std::max(1, input.probability.replicates));
        base = plan_fragility(others, suite, {whole * replicates}, text.file(), written);
        base_replicates_ = base.replicates;
        base.input = input;
        base.replicates = replicates;
    }
    const FrictionLaw& law() const { return law_; }
    /// Does this sample belong to that replicate? Where the suite is all there is each replicate has all of it.
    bool serves(const FragilitySample& s, std::size_t replicate) const
    {
        return base_replicates_ == 1 || s.replicate == replicate;
    }
    /// Without samples and draws.
    FragilityPlan empty_plan() const
    {
        FragilityPlan plan = base;
        plan.samples.clear();
        plan.draws.clear();
        plan.epistemic = false; // friction is integrated: there is no P of one value of it
        plan.aleatory = true;
        plan.whole_suite = false;
        return plan;
    }
    /// Adds a sample: that of the motion, with this friction.
    void add(FragilityPlan& plan, FragilitySample motion, double mu) const
    {
        FragilityDraw draw = base.draws[motion.draw];
        draw.values.insert(draw.values.begin() + static_cast<std::ptrdiff_t>(place_), law_.drawn(mu));
        draw.changes.push_back({"contact.friction", mu});
        motion.draw = plan.draws.size();
        plan.draws.push_back(std::move(draw));
        plan.samples.push_back(motion);
    }
    std::string words(const FragilitySample& s) const
    {
        std::string words = fmt::format("{} {} {} ", s.record, s.polarity, s.level);
        for (const KeyChange& change : base.draws[s.draw].changes)
            words += change.key + " = " + text_of(change.value) + "\n";
        return words;
    }

    FragilityPlan base; ///< of all other variables

private:
    std::size_t place_;
    FrictionLaw law_;
    std::size_t base_replicates_ = 1;
};

bool slid_too_far(LimitAnswer answer)
{
    return answer == LimitAnswer::fails || answer == LimitAnswer::static_failure;
}

/// mu* of each motion by halving, all motions a round.
class FrictionSearch {
public:
    FrictionSearch(const WithoutFriction& others, const SceneText& text, const SweepMethod& rigid, int jobs,
                   Watch& watch)
        : others_(others), text_(text), rigid_(rigid), jobs_(jobs), watch_(watch)
    {
        std::map<std::string, std::size_t> seen; // motions of equal draws are searched once
        for (const FragilitySample& s : others.base.samples) {
            const auto [at, fresh] = seen.emplace(others.words(s), samples_.size());
            if (fresh) samples_.push_back(s);
            place_.push_back(at->second);
        }
    }

    /// @param rounds  each halves the interval of ln mu
    /// @returns one for each sample of the plan without friction
    std::vector<FrictionMotion> find(int rounds)
    {
        const auto& limits = others_.base.input.limits;
        const FrictionLaw& law = others_.law();
        FragilityRuns runs = ask([&](std::size_t, std::size_t) { return law.friction(0.5); }, 1);
        std::vector<FrictionMotion> motions(samples_.size());
        std::vector<std::vector<double>> low(samples_.size()), high(samples_.size());
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            const std::optional<FinishedRow> row = runs.rows[i];
            const double critical = row && row->results.critical_friction ? *row->results.critical_friction : 0.0;
            motions[i].stands_from = std::isfinite(critical) ? std::max(0.0, critical) : 0.0;
            low[i].assign(limits.size(), std::log(std::max(law.lowest(), motions[i].stands_from)));
            high[i].assign(limits.size(), std::max(low[i].front(), std::log(law.highest())));
        }
        for (int round = 0; round < rounds; ++round) {
            const auto middle = [&](std::size_t i, std::size_t l) { return 0.5 * (low[i][l] + high[i][l]); };
            runs = ask([&](std::size_t i, std::size_t l) { return std::exp(middle(i, l)); }, limits.size());
            for (std::size_t i = 0; i < samples_.size(); ++i)
                for (std::size_t l = 0; l < limits.size(); ++l) {
                    const double at = middle(i, l);
                    (slid_too_far(answer_to(limits[l], runs.rows[i * limits.size() + l])) ? low : high)[i][l] = at;
                }
        }
        for (std::size_t i = 0; i < samples_.size(); ++i)
            for (std::size_t l = 0; l < limits.size(); ++l)
                motions[i].star.push_back(std::exp(0.5 * (low[i][l] + high[i][l])));
        std::vector<FrictionMotion> of_all;
        for (std::size_t s = 0; s < place_.size(); ++s) {
            of_all.push_back(motions[place_[s]]);
            of_all.back().sample = s;
        }
        return of_all;
    }

    /// How many motions do not fail below one friction and survive above it, slide upstream, or have no answer; of 12 frictions each.
    std::size_t count_exceptions()
    {
        constexpr std::size_t n = 12;
        const auto& limits = others_.base.input.limits;
        const FrictionLaw& law = others_.law();
        const double low = std::log(law.lowest()), high = std::log(law.highest());
        const FragilityRuns runs =
            ask([&](std::size_t,
                    std::size_t k) { return std::exp(low + (high - low) * (static_cast<double>(k) + 0.5) / n); },
                n);
        std::size_t exceptions = 0;
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            bool odd = false;
            for (const LimitInput& limit : limits) {
                bool survived = false;
                for (std::size_t k = 0; k < n; ++k) {
                    const LimitAnswer answer = answer_to(limit, runs.rows[i * n + k]);
                    odd |= answer == LimitAnswer::missing || (survived && slid_too_far(answer));
                    survived |= answer == LimitAnswer::survives;
                    const std::optional<FinishedRow> row = runs.rows[i * n + k];
                    odd |= row && row->results.upstream_slip.value_or(0.0) != 0.0;
                }
            }
            exceptions += odd;
        }
        return exceptions;
    }

    double seconds() const { return seconds_; }
    std::size_t motions() const { return samples_.size(); }

private:
    /// Runs `each` frictions of every motion.
    template <class Friction>
    FragilityRuns ask(Friction friction, std::size_t each)
    {
        stop_if_asked(watch_.stop(), "the search for the friction at which the rigid block slides too far");
        FragilityPlan plan = others_.empty_plan();
        for (std::size_t i = 0; i < samples_.size(); ++i)
            for (std::size_t k = 0; k < each; ++k) others_.add(plan, samples_[i], friction(i, k));
        Watch silent;
        FragilityRuns runs = run_fragility(plan, text_, rigid_, wanted_samples(plan), nullptr, jobs_, silent);
        seconds_ += runs.seconds;
        return runs;
    }

    const WithoutFriction& others_;
    const SceneText& text_;
    const SweepMethod& rigid_;
    int jobs_;
    Watch& watch_;
    std::vector<FragilitySample> samples_;
    std::vector<std::size_t> place_; ///< of each sample in samples_
    double seconds_ = 0.0;
};

/// P(D > d) by a logit in ln(mu / mu*), ln(mu / mu_c) and ln x.
class FailureModel {
public:
    /// ln mu at which it is one half, and the scale of the logistic distribution about it
    struct Middle {
        double log_mu = 0.0, scale = 0.1;
    };
    FailureModel() = default;
    /// @param x  rows of the three covariates @param f  1: failed
    FailureModel(const std::vector<double>& x, const std::vector<double>& f)
    {
        const std::vector<double> ones(f.size(), 1.0);
        if (f.size() >= 8) {
            const probability::BinaryFit fit =
                probability::fit_binary(probability::Link::logit, probability::Penalty::firth, x, ones, f);
            const double slope = fit.coefficients[1] + fit.coefficients[2];
            if (std::all_of(fit.coefficients.begin(), fit.coefficients.end(),
                            [](double c) { return std::isfinite(c); }) &&
                slope < -least_slope)
                b_ = fit.coefficients;
        }
    }
    static std::vector<double> covariates(double mu, double star, double critical, double x)
    {
        return {std::log(mu / star), std::log(mu / std::max(critical, 1e-9)), std::log(x)};
    }
    double eta(double mu, double star, double critical, double x) const
    {
        const std::vector<double> c = covariates(mu, star, critical, x);
        return b_[0] + b_[1] * c[0] + b_[2] * c[1] + b_[3] * c[2];
    }
    double probability(double mu, double star, double critical, double x) const
    {
        return 1.0 / (1.0 + std::exp(-eta(mu, star, critical, x)));
    }
    /// With 0.7 of the slope, as the fit may be too sure of itself, and the tails of a normal distribution (logit = 1.7 probit): those of the logit reach so
    /// far that where P is small nearly all runs would go to frictions that hold.
    double flattened(double mu, double star, double critical, double x) const
    {
        return probability::normal_cdf(0.7 * eta(mu, star, critical, x) / 1.7);
    }
    Middle middle(double star, double critical, double x) const
    {
        const double slope = b_[1] + b_[2];
        return {(b_[1] * std::log(star) + b_[2] * std::log(std::max(critical, 1e-9)) - b_[0] - b_[3] * std::log(x)) /
                    slope,
                -1.0 / slope};
    }

private:
    static constexpr double least_slope = 2.0;       // of the logit over ln mu: less says nothing
    std::vector<double> b_ = {0.0, -20.0, 0.0, 0.0}; ///< before anything is known: the rigid block, give or take 10 %
};

/// A part of the law of friction under one motion.
struct MotionCell {
    std::size_t motion = 0;
    double from = 0.0, to = 1.0; ///< of F_mu
    double share = 0.0;          ///< pi, of the level and replicate
    double sampled = 0.0;        ///< s
    FrictionCell cell;
    std::vector<double> unsure; ///< h' (1 - h') of each limit, FailureModel::flattened()
};

std::vector<MotionCell> cells_of(std::size_t place, const FrictionMotion& motion, double x, double share,
                                 const FrictionLaw& law, const std::vector<FailureModel>& models)
{
    constexpr double about[] = {-8, -5, -4, -3, -2, -1.5, -1, -0.5, 0, 0.5, 1, 1.5, 2, 3, 4, 5, 6, 8, 11, 15};
    const double critical = motion.stands_from, log_critical = std::log(std::max(critical, 1e-9));
    std::vector<double> cuts = {0.0, 1.0};
    for (const double d : {-2.0, -1.0, 0.0, 1.0})
        cuts.push_back(law.share_below(std::exp(log_critical + d * unsure_of_standing)));
    for (std::size_t l = 0; l < models.size(); ++l) {
        const FailureModel::Middle middle = models[l].middle(motion.star[l], critical, x);
        for (const double d : about) cuts.push_back(law.share_below(std::exp(middle.log_mu + d * middle.scale)));
    }
    std::sort(cuts.begin(), cuts.end());
    std::vector<MotionCell> cells;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        if (!(cuts[i + 1] > cuts[i])) continue;
        MotionCell c;
        c.motion = place;
        c.from = cuts[i];
        c.to = cuts[i + 1];
        c.share = share * (c.to - c.from);
        const double mu = law.friction(0.5 * (c.from + c.to));
        c.cell.stands = mu > critical;
        const double near = std::abs(std::log(mu) - log_critical) < unsure_of_standing ? 0.25 : 0.0;
        for (std::size_t l = 0; l < models.size(); ++l) {
            const double flat = models[l].flattened(mu, motion.star[l], critical, x);
            c.cell.fails.push_back(c.cell.stands ? models[l].probability(mu, motion.star[l], critical, x) : 0.0);
            c.unsure.push_back((c.cell.stands ? flat * (1.0 - flat) : 0.0) + near);
        }
        cells.push_back(std::move(c));
    }
    return cells;
}

/// Sum of the weights of the samples of each replicate and level, of index replicate * levels + level.
std::vector<double> weight_sums(const WithoutFriction& others)
{
    std::vector<double> sums(others.base.replicates * others.base.levels, 0.0);
    for (const FragilitySample& s : others.base.samples)
        for (std::size_t r = 0; r < others.base.replicates; ++r)
            if (others.serves(s, r)) sums[r * others.base.levels + s.level] += s.weight;
    return sums;
}

struct PilotRuns {
    FragilityPlan plan;
    std::vector<std::size_t> motion; ///< of each sample
};

/// A few motions of all levels, each with frictions from what just stands to far above what the rigid block needs.
PilotRuns pilot_of(const WithoutFriction& others, const std::vector<FrictionMotion>& motions, std::size_t runs)
{
    PilotRuns pilot{others.empty_plan(), {}};
    const probability::Stream stream(others.base.input.probability.seed, "pilot of the friction");
    std::vector<std::vector<std::size_t>> at_level(others.base.levels);
    for (std::size_t m = 0; m < motions.size(); ++m) at_level[others.base.samples[m].level].push_back(m);
    const std::size_t n = std::max<std::size_t>(6, runs / pilot_frictions);
    for (std::size_t i = 0; i < n; ++i) {
        const auto& there = at_level[i * others.base.levels / n];
        const auto id = static_cast<std::uint32_t>(i);
        const std::size_t m = there[stream.below(static_cast<std::uint32_t>(there.size()), id)];
        const FrictionMotion& motion = motions[m];
        const double low = std::log(std::max(others.law().lowest(), 1.001 * motion.stands_from));
        const double high =
            std::max(low + 0.25, std::log(*std::max_element(motion.star.begin(), motion.star.end())) + 0.4);
        for (std::size_t k = 0; k < pilot_frictions; ++k) {
            const double u = stream.uniform(id, static_cast<std::uint32_t>(k + 1));
            const double at = (static_cast<double>(k) + u) / static_cast<double>(pilot_frictions);
            others.add(pilot.plan, others.base.samples[m], std::exp(low + (high - low) * at));
            pilot.motion.push_back(m);
        }
    }
    return pilot;
}

double correlation_of(const std::vector<double>& a, const std::vector<double>& b)
{
    const auto n = static_cast<double>(a.size());
    const double ma = std::accumulate(a.begin(), a.end(), 0.0) / n, mb = std::accumulate(b.begin(), b.end(), 0.0) / n;
    double aa = 0.0, bb = 0.0, ab = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - ma) * (a[i] - ma);
        bb += (b[i] - mb) * (b[i] - mb);
        ab += (a[i] - ma) * (b[i] - mb);
    }
    return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

/// Runs the pilot and fits the failure model of each limit to it.
std::vector<FailureModel> learn(const WithoutFriction& others, const std::vector<FrictionMotion>& motions,
                                const SceneText& text, const SweepMethod& method, const ConditioningSizes& sizes,
                                Watch& watch, ConditioningPilot& report)
{
    const PilotRuns pilot = pilot_of(others, motions, sizes.pilot);
    const FragilityRuns runs =
        run_fragility(pilot.plan, text, method, wanted_samples(pilot.plan), nullptr, sizes.jobs, watch);
    stop_if_asked(watch.stop(), "the pilot of the finite elements");
    report.runs = runs.finished();
    report.seconds = runs.seconds;
    std::vector<FailureModel> models;
    for (std::size_t l = 0; l < others.base.input.limits.size(); ++l) {
        std::vector<double> x, f;
        std::vector<std::size_t> used;
        for (std::size_t id = 0; id < pilot.plan.samples.size(); ++id) {
            const LimitAnswer answer = answer_to(others.base.input.limits[l], runs.rows[id]);
            if (answer != LimitAnswer::fails && answer != LimitAnswer::survives) continue;
            const FrictionMotion& m = motions[pilot.motion[id]];
            const double mu = std::get<double>(pilot.plan.draws[pilot.plan.samples[id].draw].changes.back().value);
            const auto row = FailureModel::covariates(mu, m.star[l], m.stands_from, pilot.plan.samples[id].x);
            x.insert(x.end(), row.begin(), row.end());
            f.push_back(answer == LimitAnswer::fails ? 1.0 : 0.0);
            used.push_back(id);
        }
        models.emplace_back(x, f);
        std::vector<double> h;
        double scale = 0.0;
        for (const std::size_t id : used) {
            const FrictionMotion& m = motions[pilot.motion[id]];
            const FragilitySample& s = pilot.plan.samples[id];
            h.push_back(models.back().probability(std::get<double>(pilot.plan.draws[s.draw].changes.back().value),
                                                  m.star[l], m.stands_from, s.x));
            scale = models.back().middle(m.star[l], m.stands_from, s.x).scale;
        }
        report.correlation.push_back(h.empty() ? 0.0 : correlation_of(h, f));
        report.spread.push_back(scale);
    }
    return models;
}

/// The level whose P is nearest to `aim` by its logarithm.
std::size_t level_aimed_at(const std::vector<double>& p, double aim)
{
    const auto far = [aim](double at) { return std::abs(std::log(at / aim)); };
    return static_cast<std::size_t>(
        std::min_element(p.begin(), p.end(), [&](double a, double b) { return far(a) < far(b); }) - p.begin());
}

/// Runs of each level and replicate: half of them for the same coefficient of variation everywhere, half for the annual rate. With an aim two
/// thirds go to its level, and one third to all as before.
std::vector<std::size_t> runs_of_levels(const std::vector<double>& unsure, const std::vector<double>& p,
                                        const ConditioningSizes& sizes, std::size_t replicates)
{
    const std::vector<double>& weight = sizes.weight_of_level;
    double all = 0.0, of_rate = 0.0;
    for (std::size_t k = 0; k < unsure.size(); ++k) {
        all += unsure[k];
        if (!weight.empty()) of_rate += weight[k] * p[k] * unsure[k];
    }
    const std::size_t aimed = sizes.aim ? level_aimed_at(p, *sizes.aim) : 0;
    std::vector<std::size_t> n;
    for (std::size_t k = 0; k < unsure.size(); ++k) {
        const double same = all > 0.0 ? unsure[k] / all : 1.0 / static_cast<double>(unsure.size());
        double share = of_rate > 0.0 ? 0.5 * same + 0.5 * weight[k] * p[k] * unsure[k] / of_rate : same;
        if (sizes.aim) share = share / 3.0 + (k == aimed ? 2.0 / 3.0 : 0.0);
        n.push_back(std::max<std::size_t>(
            2, static_cast<std::size_t>(share * static_cast<double>(sizes.runs) / static_cast<double>(replicates))));
    }
    return n;
}

/// Draws the runs of one level and replicate from its cells. @param cells  those of all its motions
void draw_cells(ConditionedPlan& to, const WithoutFriction& others, const std::vector<FrictionMotion>& motions,
                const std::vector<MotionCell>& cells, std::size_t replicate, std::size_t level, std::size_t runs)
{
    const probability::Stream stream(others.base.input.probability.seed, "cells of the friction",
                                     static_cast<std::uint32_t>(replicate * others.base.levels + level));
    double sum = 0.0;
    for (const MotionCell& c : cells) sum += c.sampled;
    const double start = stream.uniform(0), step = sum / static_cast<double>(runs);
    double passed = 0.0;
    std::size_t at = 0;
    for (std::size_t j = 0; j < runs; ++j) {
        const double target = (static_cast<double>(j) + start) * step;
        while (at + 1 < cells.size() && passed + cells[at].sampled <= target) passed += cells[at++].sampled;
        const MotionCell& c = cells[at];
        const double u = c.from + (c.to - c.from) * stream.uniform(static_cast<std::uint32_t>(j + 1));
        FrictionCell cell = c.cell;
        cell.weight = c.share * sum / c.sampled; // counts are in runs: w times the number of runs
        FragilitySample s = others.base.samples[motions[c.motion].sample];
        s.replicate = replicate;
        s.weight = cell.weight;
        others.add(to.plan, s, others.law().friction(u));
        to.cells.push_back(std::move(cell));
    }
}

} // namespace

std::string why_not_conditioned(const FragilityInput& input)
{
    if (!input.limits.empty() && input.limits.front().plane != "base") return "the limits are of another plane than the base";
    const std::size_t place = friction_variable(input);
    if (place == input.probability.variables.size()) return "contact.friction is not drawn";
    const RandomVariable& v = input.probability.variables[place];
    if (v.keys.size() != 1) return "the variable of contact.friction has other keys, too";
    if (v.law.name == "discrete") return "contact.friction is a choice of values";
    for (const RankCorrelation& c : input.probability.correlations)
        if (c.first == v.name || c.second == v.name) return "contact.friction is correlated with another variable";
    if (input.intensity.design != FragilityDesign::stripes) return "the design is not stripes";
    if (input.suite && input.suite->draw == SuiteDraw::with_replacement) return "records are drawn with replacement";
    return "";
}

ConditionedPlan condition_rigid(const FragilityInput& input, const ShakingSuite& suite, const SceneText& text,
                                const NumberInFile& written, const SweepMethod& rigid, const ConditioningSizes& sizes,
                                Watch& watch)
{
    constexpr int halvings = 56; // of ln mu: to the last bit
    const WithoutFriction others(input, suite, text, written, sizes.motions);
    FrictionSearch search(others, text, rigid, sizes.jobs, watch);
    ConditionedPlan to;
    to.plan = others.empty_plan();
    to.exceptions = search.count_exceptions();
    if (to.exceptions > 0)
        to.notes.push_back(fmt::format("P is not F(mu*) of {} of {} motions: they slide upstream, have no answer, or slide too far again above "
                                       "a friction at which they do not. Use  --conditioning off .",
                                       to.exceptions, search.motions()));
    const std::vector<FrictionMotion> motions = search.find(halvings);
    to.motions = search.motions();
    const std::vector<double> sums = weight_sums(others);
    to.counts.assign(input.limits.size(), LimitCounts(to.plan));
    to.runs_at.assign(to.plan.levels, 0);
    const FrictionLaw& law = others.law();
    std::size_t counted = 0;
    for (std::size_t m = 0; m < motions.size(); ++m) {
        const FragilitySample& s = others.base.samples[m];
        const double falls = law.share_below(motions[m].stands_from);
        for (std::size_t r = 0; r < to.plan.replicates; ++r) {
            if (!others.serves(s, r)) continue;
            const double share = s.weight / sums[r * to.plan.levels + s.level];
            const double times =
                share * static_cast<double>(motions.size()) / static_cast<double>(to.plan.levels * to.plan.replicates);
            for (std::size_t l = 0; l < input.limits.size(); ++l) {
                const double fails = std::max(0.0, law.share_below(motions[m].star[l]) - falls);
                RunCount c = count_of(false, 0.0, input.probability.static_failure, times * falls);
                c.n += times * (1.0 - falls);
                c.z += times * fails;
                to.counts[l].add(s, s.level, r, c);
            }
        }
        to.p_static += falls;
        ++counted;
        others.add(to.plan, s, motions[m].star.front());
    }
    to.p_static /= static_cast<double>(std::max<std::size_t>(1, counted));
    to.plan.whole_suite = others.base.whole_suite && !others.base.epistemic; // then nothing at all is drawn
    to.rigid_seconds = search.seconds();
    return to;
}

ConditionedPlan condition_finite_elements(const FragilityInput& input, const ShakingSuite& suite, const SceneText& text,
                                          const NumberInFile& written, const SweepMethod& rigid,
                                          const SweepMethod& method, const ConditioningSizes& sizes, Watch& watch)
{
    constexpr int halvings = 12;               // of ln mu: about 2e-4
    constexpr double floor = 0.1;              // of P: what is not known where the model is sure of itself
    constexpr double least_probability = 1e-6; // P below is not aimed at
    const WithoutFriction others(input, suite, text, written, sizes.motions);
    FrictionSearch search(others, text, rigid, sizes.jobs, watch);
    const std::vector<FrictionMotion> motions = search.find(halvings);
    ConditionedPlan to;
    to.plan = others.empty_plan();
    to.motions = search.motions();
    const std::vector<FailureModel> models = learn(others, motions, text, method, sizes, watch, to.pilot);
    to.rigid_seconds = search.seconds();

    const std::size_t levels = to.plan.levels, limits = input.limits.size();
    const std::vector<double> sums = weight_sums(others);
    std::vector<std::vector<MotionCell>> cells(levels * to.plan.replicates);
    std::vector<std::vector<double>> p(limits, std::vector<double>(levels, 0.0));
    std::vector<double> standing(levels, 0.0);
    for (std::size_t m = 0; m < motions.size(); ++m) {
        const FragilitySample& s = others.base.samples[m];
        for (std::size_t r = 0; r < to.plan.replicates; ++r) {
            if (!others.serves(s, r)) continue;
            const std::size_t at = r * levels + s.level;
            for (MotionCell& c : cells_of(m, motions[m], s.x, s.weight / sums[at], others.law(), models)) {
                for (std::size_t l = 0; l < limits; ++l) p[l][s.level] += c.share * c.cell.fails[l];
                if (c.cell.stands) standing[s.level] += c.share;
                cells[at].push_back(std::move(c));
            }
        }
    }
    for (std::size_t k = 0; k < levels; ++k) {
        for (std::size_t l = 0; l < limits; ++l)
            p[l][k] = std::max(least_probability, p[l][k] / std::max(standing[k], 1e-300));
        to.p_static += 1.0 - standing[k] / static_cast<double>(to.plan.replicates);
    }
    to.p_static /= static_cast<double>(levels);

    std::vector<double> unsure(levels, 0.0);
    for (std::size_t at = 0; at < cells.size(); ++at) {
        const std::size_t k = at % levels;
        for (MotionCell& c : cells[at]) {
            double variance = 0.0;
            for (std::size_t l = 0; l < limits; ++l) variance += c.unsure[l] / (p[l][k] * p[l][k]) + floor * floor;
            c.sampled = c.share * std::sqrt(variance);
            unsure[k] += c.sampled / static_cast<double>(to.plan.replicates);
        }
    }
    const std::vector<std::size_t> n = runs_of_levels(unsure, p.front(), sizes, to.plan.replicates);
    to.counts.assign(limits, LimitCounts(to.plan));
    for (std::size_t at = 0; at < cells.size(); ++at) {
        const std::size_t r = at / levels, k = at % levels;
        for (const MotionCell& c : cells[at])
            for (std::size_t l = 0; l < limits; ++l)
                to.counts[l].add(others.base.samples[motions[c.motion].sample], k, r,
                                 count_of(c.cell.stands, c.cell.fails[l], input.probability.static_failure,
                                          c.share * static_cast<double>(n[k])));
        draw_cells(to, others, motions, cells[at], r, k, n[k]);
    }
    for (std::size_t k = 0; k < levels; ++k) to.runs_at.push_back(n[k] * to.plan.replicates);
    return to;
}

LimitCounts counts_of(const ConditionedPlan& conditioned, const FragilityRuns& runs, std::size_t limit)
{
    LimitCounts counts = conditioned.counts[limit];
    const FragilityPlan& plan = conditioned.plan;
    const StaticFailure rule = plan.input.probability.static_failure;
    for (std::size_t id = 0; id < conditioned.cells.size(); ++id) {
        const FrictionCell& cell = conditioned.cells[id];
        RunCount change = count_of(answer_to(plan.input.limits[limit], runs.rows[id]), rule, cell.weight);
        change.add(count_of(cell.stands, cell.fails[limit], rule, 1.0), -cell.weight);
        const FragilitySample s = plan.samples[id];
        counts.add(s, s.level, s.replicate, change);
    }
    return counts;
}

double static_share(const ConditionedPlan& conditioned, const FragilityRuns& runs)
{
    double change = 0.0;
    for (std::size_t id = 0; id < conditioned.cells.size(); ++id) {
        const FrictionCell& cell = conditioned.cells[id];
        const bool falls =
            answer_to(conditioned.plan.input.limits.front(), runs.rows[id]) == LimitAnswer::static_failure;
        const auto there = static_cast<double>(conditioned.runs_at[conditioned.plan.samples[id].level]);
        change += cell.weight * ((falls ? 1.0 : 0.0) - (cell.stands ? 0.0 : 1.0)) / there;
    }
    return conditioned.p_static + change / static_cast<double>(conditioned.plan.levels);
}

std::vector<double> rate_of_levels(const probability::HazardCurve& hazard, std::span<const double> levels)
{
    std::vector<double> rates;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        std::vector<double> p(levels.size(), 0.0);
        p[k] = 1.0;
        rates.push_back(std::max(0.0, probability::annual_rate(hazard, levels, p).lower));
    }
    return rates;
}

} // namespace damslip
