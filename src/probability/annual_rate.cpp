#include "probability/annual_rate.hpp"

#include "core/text.hpp"
#include "probability/distribution.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

namespace damslip::probability {

namespace {

double lognormal_p(double x, double median, double beta)
{
    if (beta == 0.0) return x >= median ? 1.0 : 0.0;
    return normal_cdf(std::log(x / median) / beta);
}

/// ln[Phi(b) - Phi(a)], a < b, also where both lie far out in one tail.
double log_normal_between(double a, double b)
{
    if (a > 0.0) return log_normal_between(-b, -a);
    const double high = log_normal_cdf(b), low = log_normal_cdf(a);
    return high + std::log1p(-std::exp(low - high));
}

/// Integral of P |dH| from a to b within one segment, H_a at a and H ~ x^-k.
double lognormal_segment(double a, double b, double h_a, double k, double median, double beta)
{
    const double h_b = h_a * std::pow(b / a, -k);
    if (beta == 0.0) {
        if (median <= a) return h_a - h_b;
        return median < b ? h_a * std::pow(median / a, -k) - h_b : 0.0;
    }
    const double z_a = std::log(a / median) / beta, z_b = std::log(b / median) / beta;
    const double middle = std::exp(std::log(h_a) + k * beta * z_a + 0.5 * k * k * beta * beta +
                                   log_normal_between(z_a + k * beta, z_b + k * beta));
    return std::max(0.0, normal_cdf(z_a) * h_a - normal_cdf(z_b) * h_b + middle);
}

/// The same of P = p_a + s ln(x / a).
double linear_segment(double a, double b, double h_a, double k, double p_a, double p_b)
{
    const double width = std::log(b / a), h_b = h_a * std::exp(-k * width);
    const double mean_h = k * width > 1e-300 ? -std::expm1(-k * width) / (k * width) * h_a : h_a; // of H over ln x
    return p_a * h_a - p_b * h_b + (p_b - p_a) * mean_h;
}

void check_nu(const HazardCurve& curve, const std::optional<double>& nu)
{
    if (nu && !(*nu >= curve.rate().front()))
        throw ParameterError("rate of all events", shortest(*nu),
                             fmt::format("at least the curve's first rate, {:g}", curve.rate().front()));
}

/// Bounds of what lies outside a ... b. @param p_below  P below a is at most that @param p_above  P above b is at least that
void add_ends(AnnualRate& r, const HazardCurve& curve, double p_below, double h_a, double p_above, double h_b,
              const std::optional<double>& nu)
{
    r.p_first = p_below;
    r.x_first = curve.x().front();
    r.all_events = nu || p_below == 0.0;
    r.above_lower = p_above * h_b;
    r.above_upper = h_b;
    r.below_upper = p_below * (nu.value_or(curve.rate().front()) - h_a);
    r.lower = r.inside + r.above_lower;
    r.upper = r.inside + r.above_upper + r.below_upper;
}

void tell_share(AnnualRate& r, double tested)
{
    r.outside_share = r.upper > 0.0 ? std::clamp(1.0 - tested / r.upper, 0.0, 1.0) : 0.0;
    r.mostly_tested = r.outside_share <= 0.1;
}

} // namespace

AnnualRate annual_rate(const HazardCurve& curve, double median, double beta, double tested_lower, double tested_upper,
                       std::optional<double> nu)
{
    if (!(median > 0.0) || !std::isfinite(median)) throw ParameterError("median", shortest(median), "an intensity > 0");
    if (!(beta >= 0.0) || !std::isfinite(beta)) throw ParameterError("beta", shortest(beta), "a number >= 0");
    check_nu(curve, nu);
    AnnualRate r;
    double tested = 0.0;
    const std::vector<double>&x = curve.x(), &h = curve.rate();
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        const double k = curve.slope(i);
        r.parts.push_back({x[i], x[i + 1], lognormal_segment(x[i], x[i + 1], h[i], k, median, beta)});
        r.inside += r.parts.back().rate;
        const double from = std::max(x[i], tested_lower), to = std::min(x[i + 1], tested_upper);
        if (from == x[i] && to == x[i + 1])
            tested += r.parts.back().rate;
        else if (from < to)
            tested += lognormal_segment(from, to, h[i] * std::pow(from / x[i], -k), k, median, beta);
    }
    add_ends(r, curve, lognormal_p(x.front(), median, beta), h.front(), lognormal_p(x.back(), median, beta), h.back(),
             nu);
    tell_share(r, tested);
    return r;
}

AnnualRate annual_rate(const HazardCurve& curve, std::span<const double> x, std::span<const double> p,
                       std::optional<double> nu, bool growing)
{
    check_nu(curve, nu);
    if (x.empty() || x.size() != p.size())
        throw ParameterError("stripes", fmt::format("{}, {}", x.size(), p.size()), "one at least, a P for each");
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!(x[i] > (i ? x[i - 1] : 0.0))) throw ParameterError("x", shortest(x[i]), "intensities > 0 that rise");
        if (!(p[i] >= 0.0 && p[i] <= 1.0)) throw ParameterError("p", shortest(p[i]), "0 to 1");
    }
    const double low = std::max(x.front(), curve.x().front()), high = std::min(x.back(), curve.x().back());
    if (!(low <= high))
        throw ParameterError(
            "stripes", fmt::format("{:g} to {:g}", x.front(), x.back()),
            fmt::format("one within the hazard curve, {:g} to {:g}", curve.x().front(), curve.x().back()));
    const auto p_at = [&](double level) {
        const std::size_t above = static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), level) - x.begin());
        if (above == x.size()) return p.back();
        if (above == 0 || x[above] == level) return p[above];
        const double share = std::log(level / x[above - 1]) / std::log(x[above] / x[above - 1]);
        return p[above - 1] + share * (p[above] - p[above - 1]);
    };
    std::vector<double> cuts{low, high};
    for (const double v : x)
        if (v > low && v < high) cuts.push_back(v);
    for (const double v : curve.x())
        if (v > low && v < high) cuts.push_back(v);
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    AnnualRate r;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const double a = cuts[i], b = cuts[i + 1], h_a = curve.rate_at(a);
        const double k = -std::log(curve.rate_at(b) / h_a) / std::log(b / a);
        r.parts.push_back({a, b, linear_segment(a, b, h_a, k, p_at(a), p_at(b))});
        r.inside += r.parts.back().rate;
    }
    add_ends(r, curve, growing ? p_at(low) : 1.0, curve.rate_at(low), growing ? p_at(high) : 0.0, curve.rate_at(high),
             nu);
    tell_share(r, r.inside);
    return r;
}

double probability_in(double rate, double years)
{
    return -std::expm1(-rate * years);
}

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

} // namespace

HazardCurve::HazardCurve(std::vector<double> x, std::vector<double> rate) : x_(std::move(x)), rate_(std::move(rate))
{
    if (x_.size() != rate_.size() || x_.size() < 2)
        throw ParameterError("points", fmt::format("{}, {}", x_.size(), rate_.size()), "two at least, a rate for each");
    for (std::size_t i = 0; i < x_.size(); ++i) {
        if (!(x_[i] > (i ? x_[i - 1] : 0.0)) || !std::isfinite(x_[i]))
            throw ParameterError("x", shortest(x_[i]), "intensities > 0 that rise");
        if (!(rate_[i] > 0.0) || !std::isfinite(rate_[i]) || (i && rate_[i] > rate_[i - 1]))
            throw ParameterError("rate", shortest(rate_[i]), "rates > 0 that never rise");
    }
}

double HazardCurve::slope(std::size_t i) const
{
    return -std::log(rate_[i + 1] / rate_[i]) / std::log(x_[i + 1] / x_[i]);
}

double HazardCurve::rate_at(double x) const
{
    if (!(x >= x_.front() && x <= x_.back())) return not_a_number;
    const std::size_t above = static_cast<std::size_t>(std::lower_bound(x_.begin(), x_.end(), x) - x_.begin());
    if (x_[above] == x) return rate_[above];
    return rate_[above - 1] * std::pow(x / x_[above - 1], -slope(above - 1));
}

namespace {

void check_word(const char* what, const std::string& word)
{
    const bool ok = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '-' || c == '_';
    });
    if (!ok) throw ParameterError(what, "\"" + word + "\"", "letters, digits, \"-\" and \"_\"");
}

void check_model(const NrmlModel& model, bool discrete)
{
    check_word("id", model.id);
    if (model.limits.empty()) throw ParameterError("limits", "none", "one limit at least");
    if (model.levels.empty()) throw ParameterError("levels", "none", "the tested intensities");
    for (std::size_t i = 0; i < model.levels.size(); ++i)
        if (!(model.levels[i] > (i ? model.levels[i - 1] : 0.0)))
            throw ParameterError("levels", shortest(model.levels[i]), "intensities > 0 that rise");
    for (const NrmlLimit& limit : model.limits) {
        check_word("limit", limit.name);
        if (!discrete && !(limit.median > 0.0 && limit.beta > 0.0))
            throw ParameterError("beta", shortest(limit.beta), "median and beta > 0");
        if (discrete && limit.poes.size() != model.levels.size())
            throw ParameterError("poes", fmt::format("{}", limit.poes.size()),
                                 fmt::format("{}, one for each level", model.levels.size()));
    }
}

std::string numbers(const std::vector<double>& values)
{
    std::string text;
    for (const double v : values) text += (text.empty() ? "" : " ") + shortest(v);
    return text;
}

/// True where the lognormal curves of two limits cross within the levels: NRML then needs the discrete form.
bool limits_cross(const NrmlModel& model)
{
    if (model.levels.empty()) return false;
    for (std::size_t i = 1; i < model.limits.size(); ++i)
        for (const double x : {model.levels.front(), model.levels.back()}) // straight lines over ln x
            if (std::log(x / model.limits[i - 1].median) / model.limits[i - 1].beta <
                std::log(x / model.limits[i].median) / model.limits[i].beta)
                return true;
    return false;
}

} // namespace

std::string nrml_fragility(const NrmlModel& model)
{
    const bool curves = std::all_of(model.limits.begin(), model.limits.end(),
                                    [](const NrmlLimit& l) { return l.median > 0.0 && l.beta > 0.0; });
    const bool discrete = !curves || limits_cross(model);
    check_model(model, discrete);
    std::string states, rows;
    for (const NrmlLimit& limit : model.limits) {
        states += (states.empty() ? "" : " ") + limit.name;
        if (discrete) {
            rows += fmt::format("      <poes ls=\"{}\">{}</poes>\n", limit.name, numbers(limit.poes));
            continue;
        }
        const double variance = limit.beta * limit.beta, mean = limit.median * std::exp(0.5 * variance);
        rows += fmt::format("      <params ls=\"{}\" mean=\"{}\" stddev=\"{}\"/>\n", limit.name, shortest(mean),
                            shortest(mean * std::sqrt(std::expm1(variance))));
    }
    const std::string imls =
        discrete ? fmt::format("      <imls imt=\"{}\" noDamageLimit=\"{}\">{}</imls>\n", xml_text(model.imt),
                               shortest(model.no_damage), numbers(model.levels))
                 : fmt::format("      <imls imt=\"{}\" noDamageLimit=\"{}\" minIML=\"{}\" maxIML=\"{}\"/>\n",
                               xml_text(model.imt), shortest(model.no_damage), shortest(model.levels.front()),
                               shortest(model.levels.back()));
    return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                       "<nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n"
                       "  <fragilityModel id=\"{0}\" assetCategory=\"dams\" lossCategory=\"structural\">\n"
                       "    <description>{1}</description>\n"
                       "    <limitStates>{2}</limitStates>\n"
                       "    <fragilityFunction id=\"{0}\" format=\"{3}\"{4}>\n{5}{6}"
                       "    </fragilityFunction>\n  </fragilityModel>\n</nrml>\n",
                       model.id, xml_text(model.description), states, discrete ? "discrete" : "continuous",
                       discrete ? "" : " shape=\"logncdf\"", imls, rows);
}

std::string usace_fragility(const std::string& name, const std::vector<UsaceLocation>& locations)
{
    nlohmann::ordered_json file{{"name", name}, {"locations", nlohmann::ordered_json::array()}};
    for (const UsaceLocation& place : locations) {
        nlohmann::ordered_json p = nlohmann::ordered_json::array(), y = nlohmann::ordered_json::array();
        double last = -1.0;
        for (const StageTriangle& s : place.stages) {
            if (!(s.probability > last && s.probability >= 0.0 && s.probability <= 1.0))
                throw ParameterError("probability", shortest(s.probability), "0 to 1, rising");
            if (!(s.min <= s.most_likely && s.most_likely <= s.max))
                throw ParameterError(
                    "stage", fmt::format("{}, {}, {}", shortest(s.min), shortest(s.most_likely), shortest(s.max)),
                    "min <= most likely <= max");
            last = s.probability;
            p.push_back(s.probability);
            y.push_back({{"type", "TriangularDistribution"},
                         {"parameters", {{"min", s.min}, {"mostlikely", s.most_likely}, {"max", s.max}}}});
        }
        file["locations"].push_back(
            {{"location", place.location}, {"probability-stage", {{"xvalues", p}, {"ydistributions", y}}}});
    }
    return file.dump(2) + "\n";
}

} // namespace damslip::probability
