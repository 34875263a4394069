#include "analysis/fragility/fragility_plan.hpp"

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "probability/distribution.hpp"
#include "probability/sampling.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numeric>

namespace damslip {

namespace {

using probability::Distribution;

/// A law's numbers by name, for the functions that make distributions.
class LawNumbers {
public:
    explicit LawNumbers(const LawInput& law) : law_(law) {}
    bool has(const std::string& name) const { return law_.parameters.count(name) > 0; }
    double operator()(const std::string& name) const
    {
        const auto found = law_.parameters.find(name);
        return found != law_.parameters.end() ? found->second : std::numeric_limits<double>::quiet_NaN();
    }

private:
    const LawInput& law_;
};

Distribution law_as_written(const LawInput& law)
{
    const LawNumbers n(law);
    if (law.name == "discrete") return Distribution::discrete(law.weights);
    if (law.name == "uniform") return Distribution::uniform(n("min"), n("max"));
    if (law.name == "triangular") return Distribution::triangular(n("min"), n("mode"), n("max"));
    if (law.name == "beta") return Distribution::beta(n("a"), n("b"), n("min"), n("max"));
    const Distribution whole = law.name == "normal" ? Distribution::normal(n("mean"), n("sd"))
                               : n.has("median")    ? Distribution::lognormal(n("median"), n("beta"))
                                                    : Distribution::lognormal_of_mean(n("mean"), n("cov"));
    if (!n.has("min") && !n.has("max")) return whole;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    return whole.truncated(n.has("min") ? n("min") : -infinite, n.has("max") ? n("max") : infinite);
}

std::vector<std::size_t> variables_of_kind(const FragilityInput& input, VariableKind kind)
{
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < input.probability.variables.size(); ++i)
        if (input.probability.variables[i].kind == kind) places.push_back(i);
    return places;
}

probability::Sampling sampling_of(SamplingInput sampling)
{
    switch (sampling) {
    case SamplingInput::sobol:
        return probability::Sampling::sobol;
    case SamplingInput::latin_hypercube:
        return probability::Sampling::lhs;
    case SamplingInput::random:
        break;
    }
    return probability::Sampling::random;
}

/// The variables of one kind: their points, made dependent.
class KindOfVariables {
public:
    KindOfVariables(const FragilityInput& input, VariableKind kind, const std::filesystem::path& file)
        : input_(input), places_(variables_of_kind(input, kind)), copula_(copula(file))
    {
    }
    bool empty() const { return places_.empty(); }

    /// Writes the uniform numbers of point i of a set into `u`, which has a place for every variable.
    class Points {
    public:
        Points(const KindOfVariables& kind, probability::UnitPoints points) : kind_(&kind), points_(std::move(points))
        {
        }
        void put(std::size_t i, std::vector<double>& u) const
        {
            if (kind_->empty()) return;
            const std::vector<double> dependent =
                kind_->copula_.dependent(points_.point(static_cast<std::uint32_t>(i)));
            for (std::size_t k = 0; k < dependent.size(); ++k) u[kind_->places_[k]] = dependent[k];
        }

    private:
        const KindOfVariables* kind_;
        probability::UnitPoints points_;
    };
    Points points(std::size_t n, std::uint32_t replicate) const
    {
        std::vector<std::string> names;
        for (const std::size_t place : places_) names.push_back(input_.probability.variables[place].name);
        const auto sampling = empty() ? probability::Sampling::random : sampling_of(input_.probability.sampling);
        return {*this, {sampling, input_.probability.seed, names, static_cast<std::uint32_t>(n), replicate}};
    }

private:
    probability::GaussianCopula copula(const std::filesystem::path& file) const
    {
        std::vector<probability::RankCorrelation> pairs;
        LineOfFile where;
        for (const RankCorrelation& c : input_.probability.correlations) {
            const auto place = [&](const std::string& name) {
                for (std::size_t k = 0; k < places_.size(); ++k)
                    if (input_.probability.variables[places_[k]].name == name) return k;
                return places_.size();
            };
            if (place(c.first) == places_.size() || place(c.second) == places_.size()) continue; // of the other kind
            pairs.push_back({place(c.first), place(c.second), c.spearman});
            where = c.where;
        }
        const auto refused = [&](const std::string& problem, const std::string& expected) {
            return InputError(Diagnostic{file.string(), static_cast<int>(where.line), 0, problem, expected,
                                         "change or leave out one of the correlations"});
        };
        try {
            return {places_.size(), pairs};
        } catch (const probability::NotPositiveDefinite& e) {
            throw refused(
                fmt::format(
                    "the correlations contradict one another: the smallest eigenvalue of their matrix is {:.3g}.",
                    e.smallest_eigenvalue()),
                "a positive definite matrix");
        } catch (const probability::ParameterError& e) {
            throw refused(fmt::format("probability.correlation: {} = {} is not allowed.", e.parameter(), e.value()),
                          e.expected());
        }
    }

    const FragilityInput& input_;
    std::vector<std::size_t> places_;
    probability::GaussianCopula copula_;
};

/// Values of the variables at uniform numbers.
class ValuesOfDraw {
public:
    ValuesOfDraw(const FragilityInput& input, const std::filesystem::path& file, const NumberInFile& written)
        : input_(input)
    {
        for (const RandomVariable& v : input.probability.variables) {
            laws_.push_back(law_of(v, file));
            std::vector<double>& base = bases_.emplace_back();
            for (const std::string& key : v.keys) base.push_back(v.factor ? written(key) : 1.0);
        }
    }

    FragilityDraw operator()(std::span<const double> u) const
    {
        FragilityDraw draw;
        for (std::size_t i = 0; i < laws_.size(); ++i) {
            const RandomVariable& v = input_.probability.variables[i];
            const double q = laws_[i].quantile(u[i]);
            draw.values.push_back(laws_[i].is_discrete() ? v.law.values[static_cast<std::size_t>(q)] : KeyValue(q));
            for (std::size_t k = 0; k < v.keys.size(); ++k) {
                const auto* number = std::get_if<double>(&draw.values.back());
                draw.changes.push_back(
                    {v.keys[k], v.factor && number ? KeyValue(*number * bases_[i][k]) : draw.values.back()});
            }
        }
        return draw;
    }

private:
    const FragilityInput& input_;
    std::vector<Distribution> laws_;
    std::vector<std::vector<double>> bases_;
};

/// Records with their polarities, as one list to draw from.
struct ShakenWays {
    std::vector<std::size_t> record;
    std::vector<int> polarity;
    std::vector<double> weight;
};

ShakenWays shaken_ways(const FragilityInput& input, const ShakingSuite& suite)
{
    const SuitePolarity wanted = input.suite.value_or(SuiteInput{}).polarity;
    ShakenWays ways;
    for (std::size_t r = 0; r < suite.pairs->size(); ++r)
        for (const int polarity : {1, -1}) {
            if (polarity == (wanted == SuitePolarity::reversed ? 1 : -1) && wanted != SuitePolarity::both) continue;
            ways.record.push_back(r);
            ways.polarity.push_back(polarity);
            ways.weight.push_back(suite.weight[r]);
        }
    return ways;
}

/// Sets replicates, outer and inner of the plan.
void choose_sizes(FragilityPlan& plan, std::size_t ways, const FragilitySizes& sizes, bool replaced)
{
    const ProbabilityInput& p = plan.input.probability;
    const auto whole = [&](std::size_t n) { // Sobol' points come in powers of two
        n = std::max<std::size_t>(1, n);
        return p.sampling == SamplingInput::sobol ? std::bit_ceil(n) : n;
    };
    const auto up = [](std::size_t a, std::size_t b) { return (a + b - 1) / b; };
    plan.whole_suite = !plan.aleatory && !replaced;
    plan.replicates = static_cast<std::size_t>(std::max(1, p.replicates));
    const std::size_t given = p.samples ? static_cast<std::size_t>(*p.samples) : 0;
    if (!plan.epistemic) {
        if (plan.whole_suite) plan.replicates = 1;
        plan.inner = plan.whole_suite ? ways
                     : plan.aleatory  ? whole(given ? given : up(sizes.samples, plan.replicates))
                                      : up(sizes.samples, plan.replicates);
        return;
    }
    // More samples are more draws of both kinds: few inner ones would bound what the interval can say, however many outer ones share them.
    const double root = std::sqrt(static_cast<double>(up(sizes.samples, plan.replicates)));
    plan.inner =
        plan.whole_suite
            ? ways
            : whole(given ? given : std::max({std::size_t{16}, ways, static_cast<std::size_t>(std::ceil(root))}));
    plan.outer = whole(up(sizes.samples, plan.replicates * plan.inner));
}

void check_scale(FragilityPlan& plan, const std::filesystem::path& file)
{
    const SuiteInput limits = plan.input.suite.value_or(SuiteInput{});
    std::vector<std::pair<std::size_t, std::size_t>> at_levels;
    for (const FragilitySample& s : plan.samples) {
        const RecordFiles& files = (*plan.suite.pairs)[s.record].files;
        const double factor = s.factor * files.scale; // the list's own counts
        if (!(factor > limits.max_scale)) continue;
        const std::pair at(s.record, s.level);
        if (std::find(at_levels.begin(), at_levels.end(), at) != at_levels.end()) continue;
        at_levels.push_back(at);
        plan.scaled_far.push_back(fmt::format("{}: factor {:.3g} at level {}", files.name, factor, s.level + 1));
    }
    if (plan.scaled_far.empty() || limits.allow_scaling) return;
    refuse(file,
           fmt::format("{} records have to be scaled by more than suite.max_scale = {} to reach their level: {}{}.",
                       plan.scaled_far.size(), shortest(limits.max_scale), plan.scaled_far.front(),
                       plan.scaled_far.size() > 1 ? ", ..." : ""),
           "records that are about as strong as the level",
           "take stronger records, lower levels, a larger suite.max_scale, or --allow-scaling");
}

/// Draws and samples of a plan, each from its place.
class DrawnPlan {
public:
    /// @param plan  with its sizes, without draws and samples
    DrawnPlan(FragilityPlan plan, ShakenWays ways, std::uint32_t stream, const std::filesystem::path& file,
              const NumberInFile& written)
        : plan_(std::move(plan)), ways_(std::move(ways)), epistemic_(plan_.input, VariableKind::epistemic, file),
          aleatory_(plan_.input, VariableKind::aleatory, file), values_(plan_.input, file, written)
    {
        mean_weight_ =
            std::accumulate(ways_.weight.begin(), ways_.weight.end(), 0.0) / static_cast<double>(ways_.weight.size());
        const bool replaced = plan_.input.suite && plan_.input.suite->draw == SuiteDraw::with_replacement;
        const auto order = replaced ? probability::RecordOrder::with_replacement : probability::RecordOrder::balanced;
        const std::size_t first = std::size_t{stream} * (1u << 24);
        for (std::size_t r = 0; r < plan_.replicates; ++r)
            outer_points_.push_back(epistemic_.points(plan_.outer, static_cast<std::uint32_t>(first + r)));
        const std::size_t sets = plan_.replicates * (own_levels() ? plan_.levels : 1);
        way_.reserve(sets * plan_.inner);
        for (std::size_t set = 0; set < sets; ++set) {
            const auto number = static_cast<std::uint32_t>(first + set);
            inner_points_.push_back(aleatory_.points(plan_.inner, number));
            const probability::RecordDraw records(order, plan_.input.probability.seed, ways_.weight, number);
            for (std::size_t i = 0; i < plan_.inner; ++i)
                way_.push_back(
                    static_cast<std::uint32_t>(plan_.whole_suite ? i : records(static_cast<std::uint32_t>(i))));
        }
    }
    DrawnPlan(const DrawnPlan&) = delete; // its parts point to one another
    DrawnPlan& operator=(const DrawnPlan&) = delete;

    std::size_t samples() const { return plan_.replicates * plan_.outer * plan_.levels * plan_.inner; }
    std::size_t draws() const
    {
        return plan_.replicates * plan_.outer * (plan_.aleatory ? plan_.inner * (own_levels() ? plan_.levels : 1) : 1);
    }

    FragilityDraw draw(std::size_t place) const
    {
        std::vector<double> u(plan_.input.probability.variables.size());
        const std::size_t each = draws() / (plan_.replicates * plan_.outer), outer = place / each,
                          inside = place % each;
        const std::size_t r = outer / plan_.outer;
        outer_points_[r].put(outer % plan_.outer, u);
        inner_points_[set_of(r, inside / plan_.inner)].put(inside % plan_.inner, u);
        return values_(u);
    }

    FragilitySample sample(std::size_t id) const
    {
        const std::size_t outer = id / (plan_.levels * plan_.inner), inside = id % (plan_.levels * plan_.inner);
        const bool by_draw = plan_.aleatory && !own_levels(); // levels of one draw lie side by side
        FragilitySample s;
        s.replicate = outer / plan_.outer;
        s.outer = outer;
        s.inner = by_draw ? inside / plan_.levels : inside % plan_.inner;
        s.level = by_draw ? inside % plan_.levels : inside / plan_.inner;
        s.draw = !plan_.aleatory ? outer : by_draw ? outer * plan_.inner + s.inner : id;
        const std::size_t way = way_[set_of(s.replicate, s.level) * plan_.inner + s.inner];
        s.record = ways_.record[way];
        s.polarity = ways_.polarity[way];
        if (plan_.whole_suite) s.weight = ways_.weight[way] / mean_weight_;
        const double own = plan_.suite.intensity[s.record];
        const bool cloud = plan_.input.intensity.design == FragilityDesign::cloud;
        s.x = cloud ? own : plan_.input.intensity.levels[s.level];
        s.factor = cloud ? 1.0 : std::pow(s.x / own, 1.0 / plan_.suite.power);
        return s;
    }

private:
    /// The inner draws of each level are its own.
    bool own_levels() const { return plan_.input.intensity.design == FragilityDesign::stripes; }
    std::size_t set_of(std::size_t replicate, std::size_t level) const
    {
        return own_levels() ? replicate * plan_.levels + level : replicate;
    }

    FragilityPlan plan_; ///< its sizes and its suite
    ShakenWays ways_;
    double mean_weight_ = 1.0;
    KindOfVariables epistemic_, aleatory_;
    ValuesOfDraw values_;
    std::vector<KindOfVariables::Points> outer_points_, inner_points_; ///< of each replicate; of each inner set
    std::vector<std::uint32_t> way_;                                   ///< of each inner draw of each inner set
};

} // namespace

bool FragilityPlan::draws_key(std::string_view beginning) const
{
    return std::ranges::any_of(variables(), [&](const RandomVariable& v) {
        return std::ranges::any_of(v.keys, [&](const std::string& key) { return key.starts_with(beginning); });
    });
}

FragilityDraw draw_of(const FragilityInput& input, std::span<const double> u, const std::filesystem::path& scene_file,
                      const NumberInFile& written)
{
    return ValuesOfDraw(input, scene_file, written)(u);
}

void check_fragility(const FragilityInput& input, const SceneText& text)
{
    const NumberInFile written = [&text](const std::string& key) { return text.written(key); };
    const double beyond = std::exp2(-40.0);
    const std::vector<RandomVariable>& variables = input.probability.variables;
    std::vector<double> u(variables.size(), 0.5);
    for (std::size_t i = 0; i < variables.size(); ++i) {
        const RandomVariable& variable = variables[i];
        for (const double end : {beyond, 1.0 - beyond}) {
            u[i] = end;
            const FragilityDraw draw = draw_of(input, u, text.file(), written);
            std::vector<KeyChange> own;
            for (const KeyChange& change : draw.changes)
                if (std::find(variable.keys.begin(), variable.keys.end(), change.key) != variable.keys.end())
                    own.push_back(change);
            try {
                text.with(own);
            } catch (const InputError& e) {
                const Diagnostic& reason = e.diagnostics().front();
                throw InputError(
                    Diagnostic{text.file().string(), static_cast<int>(variable.law.where.line), 0,
                               fmt::format("{} reaches {}, which {} does not allow. {}", variable.law.where.key,
                                           text_of(draw.values[i]), variable.keys.front(), reason.problem),
                               reason.expected, "give the law a min and a max within it, or a smaller spread"});
            }
        }
        u[i] = 0.5;
    }
}

Distribution law_of(const RandomVariable& variable, const std::filesystem::path& scene_file)
{
    const LineOfFile& where = variable.law.where;
    try {
        return law_as_written(variable.law);
    } catch (const probability::ParameterError& e) {
        throw InputError(Diagnostic{scene_file.string(), static_cast<int>(where.line), 0,
                                    fmt::format("{}: {} = {} is not allowed.", where.key, e.parameter(), e.value()),
                                    e.expected(), fmt::format("write another {}", e.parameter())});
    }
}

FragilityPlan plan_fragility(const FragilityInput& input, ShakingSuite suite, const FragilitySizes& sizes,
                             const std::filesystem::path& scene_file, const NumberInFile& written)
{
    FragilityPlan plan;
    plan.input = input;
    plan.suite = std::move(suite);
    const ShakenWays ways = shaken_ways(plan.input, plan.suite);
    const bool replaced = plan.input.suite && plan.input.suite->draw == SuiteDraw::with_replacement;
    plan.epistemic = !variables_of_kind(plan.input, VariableKind::epistemic).empty();
    plan.aleatory = !variables_of_kind(plan.input, VariableKind::aleatory).empty();
    plan.levels = plan.input.intensity.design == FragilityDesign::cloud ? 1 : plan.input.intensity.levels.size();
    choose_sizes(plan, ways.record.size(), sizes, replaced);
    const auto drawn = std::make_shared<const DrawnPlan>(plan, ways, sizes.stream, scene_file, written);
    plan.draws = {drawn->draws(), [drawn](std::size_t place) { return drawn->draw(place); }};
    plan.samples = {drawn->samples(), [drawn](std::size_t id) { return drawn->sample(id); }};
    check_scale(plan, scene_file);
    return plan;
}

} // namespace damslip
