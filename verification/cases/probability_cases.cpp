#include "analysis/fragility/hazard_file.hpp"
#include "probability/annual_rate.hpp"
#include "probability/distribution.hpp"
#include "probability/fit.hpp"
#include "probability/sampling.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/block_slip.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::probability;
using Check = damslip::verification::Check;

constexpr double g_of_blocks = 9.81;

GroundMotion shaken(const std::vector<double>& accel, double dt)
{
    return {"", dt, accel, {}, {}};
}

GroundMotion rectangle_motion(double a, double duration)
{
    return shaken(std::vector<double>(5, a), duration / 4.0);
}

GroundMotion triangle_motion(double a, double rise)
{
    return shaken({0.0, 0.5 * a, a, 0.5 * a, 0.0}, 0.5 * rise);
}

sliding::RigidBlock dry_block(double friction)
{
    sliding::RigidBlock block;
    block.mass = 1.0;
    block.gravity = g_of_blocks;
    block.friction = friction;
    return block;
}

double one_way_slip(const GroundMotion& motion, double friction)
{
    sliding::SlideOptions options;
    options.sliding.two_way = false;
    return sliding::slide(motion, dry_block(friction), options).slip;
}

/// Friction at which the block slides by d > 0: the slip falls with the friction.
double critical_for_slip(const GroundMotion& motion, double d)
{
    double low = 1e-3, high = 10.0;
    for (int k = 0; k < 100; ++k) {
        const double mid = 0.5 * (low + high);
        (one_way_slip(motion, mid) > d ? low : high) = mid;
    }
    return low;
}

/// A train of pulses of both signs that ends at rest: some slides of one, some of two pulses.
GroundMotion train(double factor)
{
    std::vector<double> a;
    for (int k = 0; k <= 400; ++k) {
        const double t = 0.02 * k;
        a.push_back(factor * std::sin(5.0 * t) * std::sin(0.4 * t) * (2.0 + std::cos(23.0 * t)));
    }
    return shaken(a, 0.02);
}

/// Bound of a share of N draws: 4 standard errors.
Check share_check(const std::string& what, double p, double found, double n)
{
    return {what, "–", p, found, 4.0 * std::sqrt(p * (1.0 - p) / n), Measure::absolute};
}

std::vector<Check> pulse_fragility()
{
    const double a = 6.0, duration = 0.4, d = 0.05, at2 = a * duration * duration;
    const double critical = a * at2 / (g_of_blocks * (2.0 * d + at2));
    const GroundMotion motion = rectangle_motion(a, duration);
    std::vector<Check> checks{{"rectangle 6 m/s², 0.4 s: friction of 50 mm, A²T²/(g(2d + AT²))", "–", critical,
                               critical_for_slip(motion, d), 1e-9}};
    const std::array<std::pair<const char*, Distribution>, 3> laws{
        {{"lognormal 0.55, 0.3", Distribution::lognormal(0.55, 0.3)},
         {"the same from 0.4 up", Distribution::lognormal(0.55, 0.3).truncated(0.4, INFINITY)},
         {"uniform 0.3 to 0.7", Distribution::uniform(0.3, 0.7)}}};
    const double whole = normal_cdf(std::log(critical / 0.55) / 0.3), below = normal_cdf(std::log(0.4 / 0.55) / 0.3);
    const std::array<double, 3> exact{whole, (whole - below) / (1.0 - below), (critical - 0.3) / 0.4};
    constexpr std::uint32_t n = 4096;
    for (std::size_t k = 0; k < laws.size(); ++k) {
        const auto& [name, law] = laws[k];
        checks.push_back({fmt::format("{}: P = F(critical friction)", name), "–", exact[k],
                          law.cdf(critical_for_slip(motion, d)), 1e-9});
        const UnitPoints points(Sampling::random, 7, {"mu"}, n);
        double share = 0.0;
        for (std::uint32_t i = 0; i < n; ++i)
            share += one_way_slip(motion, law.quantile(points(i, 0))) > d ? 1.0 / n : 0.0;
        checks.push_back(share_check(fmt::format("{}: share of 4096 blocks", name), exact[k], share, n));
    }
    const double triangle = critical_for_slip(triangle_motion(6.0, 0.3), 0.02);
    checks.push_back({"triangle 6 m/s², 0.3 s: closed slip at the friction of 20 mm", "m", 0.02,
                      exact::slip_under_triangle(6.0, 0.3, triangle * g_of_blocks), 1e-9});
    return checks;
}

std::vector<Check> correlated_pulse()
{
    const double median_a = 4.0, beta_a = 0.4, median_mu = 0.6, beta_mu = 0.2, r = 0.6;
    const double p = normal_cdf(std::log(median_a / (g_of_blocks * median_mu)) /
                                std::sqrt(beta_a * beta_a + beta_mu * beta_mu - 2.0 * r * beta_a * beta_mu));
    const std::array<RankCorrelation, 1> ranks{{{0, 1, 6.0 / std::numbers::pi * std::asin(0.5 * r)}}};
    const GaussianCopula copula(2, ranks);
    const Distribution a = Distribution::lognormal(median_a, beta_a), mu = Distribution::lognormal(median_mu, beta_mu);
    constexpr std::uint32_t n = 8192;
    const UnitPoints points(Sampling::sobol, 11, {"a", "mu"}, n);
    double share = 0.0;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::vector<double> u = copula.dependent(points.point(i));
        share += one_way_slip(rectangle_motion(a.quantile(u[0]), 0.3), mu.quantile(u[1])) > 0.0 ? 1.0 / n : 0.0;
    }
    return {{"correlation of the normal variables, r = 2 sin(π ρ_S/6)", "–", r, copula.correlation(0, 1), 1e-14},
            share_check("share that slides at all, 8192 Sobol' points", p, share, n)};
}

std::vector<Check> homogeneity()
{
    std::vector<Check> checks;
    for (const double factor : {0.5, 1.7, 3.0})
        checks.push_back({fmt::format("D(κa; a_y) = κ D(a; a_y/κ), κ = {:g}", factor), "m",
                          factor * one_way_slip(train(1.0), 0.1 / factor), one_way_slip(train(factor), 0.1), 1e-9});
    GroundMotion two = train(1.0);
    const GroundMotion second = train(1.4);
    two.accel_h.insert(two.accel_h.end(), 1000, 0.0);
    two.accel_h.insert(two.accel_h.end(), second.accel_h.begin(), second.accel_h.end());
    checks.push_back({"two records with rest between: D = D₁ + D₂", "m",
                      one_way_slip(train(1.0), 0.05) + one_way_slip(second, 0.05), one_way_slip(two, 0.05), 1e-9});
    return checks;
}

std::vector<double> spread_levels(double from, double to, int n)
{
    std::vector<double> x;
    for (int k = 0; k <= n; ++k) x.push_back(from * std::pow(to / from, static_cast<double>(k) / n));
    return x;
}

/// Integral of P |dH| by Simpson's rule in ln x, 2000 intervals a segment.
double simpson_rate(const HazardCurve& h, double median, double beta)
{
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < h.x().size(); ++i) {
        const double from = std::log(h.x()[i]), width = std::log(h.x()[i + 1]) - from, k = h.slope(i);
        constexpr int n = 2000;
        for (int j = 0; j <= n; ++j) {
            const double l = from + width * j / n, weight = j == 0 || j == n ? 1.0 : j % 2 ? 4.0 : 2.0;
            sum += weight * width / n / 3.0 * normal_cdf((l - std::log(median)) / beta) * k * h.rate()[i] *
                   std::exp(-k * (l - from));
        }
    }
    return sum;
}

std::vector<Check> rates()
{
    const double k0 = 2e-4, k = 2.3, median = 0.5, beta = 0.45;
    const std::vector<double> x = spread_levels(1e-6, 1e4, 40);
    std::vector<double> power;
    for (const double v : x) power.push_back(k0 * std::pow(v, -k));
    const double closed = k0 * std::pow(median, -k) * std::exp(0.5 * k * k * beta * beta);
    std::vector<Check> checks{{"H = k₀x⁻ᵏ in 40 segments: k₀θ⁻ᵏ exp(k²β²/2)", "1/a", closed,
                               annual_rate({x, power}, median, beta, 0.1, 2.0).lower, 1e-9}};
    const HazardCurve bent({0.05, 0.2, 0.4, 1.5}, {1e-2, 2e-3, 2e-3, 4e-5});
    checks.push_back({"three segments, one flat: Simpson's rule", "1/a", simpson_rate(bent, median, beta),
                      annual_rate(bent, median, beta, 0.1, 1.0).inside, 1e-9});
    const AnnualRate bounds = annual_rate(bent, median, beta, 0.1, 1.0, 0.05);
    checks.push_back({"above the last point: H_n - P_n H_n", "1/a", 4e-5 * normal_cdf(std::log(median / 1.5) / beta),
                      bounds.above_upper - bounds.above_lower, 1e-9});
    checks.push_back({"below the first point: P₁(ν - H₁)", "1/a", 0.04 * normal_cdf(std::log(0.05 / median) / beta),
                      bounds.below_upper, 1e-9});
    // P = 0.2 + 0.3 ln(x / 0.2) / ln 2 on the flat part adds nothing; on the last, by parts, k = ln 50 / ln 3.75.
    const std::array<double, 2> stripes{0.4, 1.5}, p{0.2, 0.8};
    checks.push_back({"raw stripes, P linear in ln x", "1/a",
                      0.2 * 2e-3 - 0.8 * 4e-5 + 0.6 * (2e-3 - 4e-5) / std::log(50.0),
                      annual_rate(bent, stripes, p).inside, 1e-9});
    const HazardFile file = parse_hazard_file("#,,,,,\"generated_by='engine', investigation_time=50.0, imt='PGA'\"\n"
                                              "lon,lat,depth,poe-0.1,poe-0.2,poe-0.4\n"
                                              "14.5,46.0,0.0,0.5,0.1,0.01\n",
                                              "hazard_curve-mean-PGA_1.csv", {});
    checks.push_back({"OpenQuake, poe 0.1 in 50 years: rate", "1/a", 0.10536051565782628 / 50.0,
                      file.curve.rate_at(0.2 * 9.80665), 1e-14});
    checks.push_back({"between its points, log-log", "1/a",
                      std::sqrt(0.10536051565782628 * 0.010050335853501450) / 50.0,
                      file.curve.rate_at(std::sqrt(0.08) * 9.80665), 1e-12});
    return checks;
}

std::vector<Check> fits()
{
    const double median = 0.42, beta = 0.37;
    std::vector<StripeCount> stripes;
    for (const double x : {0.1, 0.2, 0.3, 0.5, 0.8})
        stripes.push_back({x, 20.0, 20.0 * normal_cdf(std::log(x / median) / beta)});
    const LognormalFit fit = fit_lognormal(stripes);
    const std::array<StripeCount, 3> separated{{{0.2, 10.0, 0.0}, {0.4, 10.0, 3.0}, {0.8, 10.0, 10.0}}};
    const LognormalFit firth = fit_lognormal(separated);
    const std::array<StripeCount, 2> none{{{0.2, 10.0, 0.0}, {0.4, 10.0, 0.0}}};
    // Firth's penalty on one group is the Jeffreys prior of the saturated model; on two groups of a logit each is (z + 1/2)/(n + 1).
    const std::array<double, 2> group{0.0, 1.0}, n{10.0, 20.0}, z{0.0, 7.0};
    const BinaryFit two = fit_binary(Link::logit, Penalty::firth, group, n, z);
    const std::array<double, 1> first{0.0}, second{1.0};
    // Censored: the gradient is zero where the counts are those of a symmetric sample without any censoring far above.
    const std::array<double, 4> reached{0.2, 0.3, 0.5, 0.9};
    const std::array<double, 1> far{1e-30};
    return {
        {"expected counts 20 Φ at five levels: median", "–", median, fit.curve.median, 1e-8},
        {"its beta", "–", beta, fit.curve.beta, 1e-8},
        {"its deviance", "–", 0.0, fit.deviance, 1e-12, Measure::absolute},
        {"separated counts 0, 3, 10 of 10: Firth, told", "–", 1.0,
         static_cast<double>(firth.method == FitMethod::firth), 0.0},
        {"its median lies between the levels", "–", 0.8, firth.curve.median, 0.0, Measure::upper_bound},
        {"no failure: no curve", "–", 1.0, static_cast<double>(fit_lognormal(none).method == FitMethod::none), 0.0},
        {"Firth's logit of two groups: (z + 1/2)/(n + 1) of none in 10", "–", 0.5 / 11.0, two.probability(first), 1e-9},
        {"of 7 in 20", "–", 7.5 / 21.0, two.probability(second), 1e-9},
        {"a record censored where all have survived: median as without it, likelihood", "–",
         std::pow(0.2 * 0.3 * 0.5 * 0.9, 0.25), fit_capacities(reached, far).curve.median, 1e-8}};
}

/// The number behind `name="` in a text.
double xml_number(const std::string& text, const std::string& name)
{
    const std::size_t at = text.find(name + "=\"");
    return at == std::string::npos ? NAN : std::stod(text.substr(at + name.size() + 2));
}

std::vector<Check> nrml_round()
{
    NrmlModel model{"dam", "slip", "PGA", 0.01, {0.05, 0.1, 0.2, 0.4, 0.8}, {{"slip-50mm", 0.42, 0.37, {}}}};
    const std::string text = nrml_fragility(model);
    const double mean = xml_number(text, "mean"), sd = xml_number(text, "stddev");
    const double beta = std::sqrt(std::log1p(sd * sd / (mean * mean))), median = mean * std::exp(-0.5 * beta * beta);
    std::vector<Check> checks;
    for (const double x : model.levels)
        checks.push_back({fmt::format("P at {:g} g from mean and stddev of the file", x), "–",
                          LognormalCurve{0.42, 0.37}.probability(x), LognormalCurve{median, beta}.probability(x),
                          1e-9});
    model.limits.push_back({"slip-100mm", 0.45, 0.2, {0.0, 0.0, 0.1, 0.3, 0.9}});
    model.limits[0].poes = {0.0, 0.1, 0.2, 0.5, 0.9};
    checks.push_back({"curves that cross: the discrete form", "–", 1.0,
                      static_cast<double>(nrml_fragility(model).find("format=\"discrete\"") != std::string::npos),
                      0.0});
    return checks;
}

std::vector<Check> intervals()
{
    const Interval none = wilson(0.0, 20.0), all = wilson(20.0, 20.0);
    const double k2 = std::pow(normal_quantile(0.975), 2);
    const Distribution mu = Distribution::lognormal(0.77, 0.15);
    const Interval w = wilson(7.0, 25.0);
    const auto defect = [&](double p) { return std::pow(0.28 - p, 2) - k2 * p * (1.0 - p) / 25.0; };
    sliding::RigidBlock dam = dry_block(0.7);
    dam.horizontal_force = 6.0;
    return {{"Wilson, none of 20: lower end", "–", 0.0, none.lower, 0.0, Measure::absolute},
            {"Wilson, none of 20: upper end k²/(n + k²)", "–", k2 / (20.0 + k2), none.upper, 1e-9},
            {"Wilson, all of 20: upper end", "–", 1.0, all.upper, 0.0},
            {"Wilson, 7 of 25: (p̂ - p)² - k² p(1 - p)/n at both ends", "–", 0.0,
             std::max(std::abs(defect(w.lower)), std::abs(defect(w.upper))), 1e-14, Measure::absolute},
            {"none of 20: bound 1 - 0.05^(1/20)", "–", 0.13910834, bound_of_none(20.0), 1e-7},
            {"static share F(critical friction) of a dam under thrust", "–",
             normal_cdf(std::log(6.0 / 9.81 / 0.77) / 0.15), mu.cdf(sliding::critical_friction(dam)), 1e-9}};
}

std::vector<Check> philox_words()
{
    using Words = std::array<std::uint32_t, 4>;
    struct {
        const char* name;
        Words counter;
        std::array<std::uint32_t, 2> key;
        Words answer;
    } const rows[] = {{"zeros", {0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
                      {"ones", {~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}, {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
                      {"digits of π",
                       {0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
                       {0xa4093822, 0x299f31d0},
                       {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}}};
    std::vector<Check> checks;
    for (const auto& row : rows) {
        const Words found = philox4x32(row.counter, row.key);
        for (std::size_t k = 0; k < 4; ++k)
            checks.push_back({fmt::format("{}, word {}", row.name, k), "–", static_cast<double>(row.answer[k]),
                              static_cast<double>(found[k]), 0.0, Measure::absolute});
    }
    for (const Sampling sampling : {Sampling::random, Sampling::lhs, Sampling::sobol}) {
        const UnitPoints two(sampling, 5, {"mu", "c"}, 64), three(sampling, 5, {"mu", "c", "level"}, 64);
        double change = 0.0;
        for (std::uint32_t i = 0; i < 64; ++i)
            for (std::size_t k = 0; k < 2; ++k) change = std::max(change, std::abs(two(i, k) - three(i, k)));
        checks.push_back({fmt::format("draws with a variable added, sampling {}", static_cast<int>(sampling)), "–", 0.0,
                          change, 0.0, Measure::absolute});
    }
    return checks;
}

std::vector<Check> shapley_linear()
{
    const double b1 = 1.5, b2 = -0.8, r = 0.55, v = b1 * b1 + 2.0 * r * b1 * b2 + b2 * b2;
    const std::vector<double> share = shapley(2, [&](std::uint32_t u) {
        return u == 1 ? std::pow(b1 + r * b2, 2) : u == 2 ? std::pow(b2 + r * b1, 2) : v;
    });
    const double exact = (b1 * b1 * (1.0 - 0.5 * r * r) + r * b1 * b2 + 0.5 * b2 * b2 * r * r) / v;
    const std::array<RankCorrelation, 1> ranks{{{0, 1, 6.0 / std::numbers::pi * std::asin(0.5 * r)}}};
    const ShapleyEffects drawn = shapley_effects(
        GaussianCopula(2, ranks),
        [&](std::span<const double> u) { return b1 * normal_quantile(u[0]) + b2 * normal_quantile(u[1]); }, 4000, 3);
    const double sd = (drawn.shares[0].upper - drawn.shares[0].lower) / 3.92;
    return {
        {"b₁X₁ + b₂X₂, r = 0.55: share of X₁ by subsets", "–", exact, share[0] / v, 1e-12},
        {"both sum up to the variance", "–", v, share[0] + share[1], 1e-12},
        {"the same from draws of the conditional laws", "–", exact, drawn.shares[0].value, 4.0 * sd, Measure::absolute},
        {"no share of more than 2 % scatter", "–", 0.02, sd, 0.0, Measure::upper_bound}};
}

} // namespace

void add_probability_cases(Registry& registry)
{
    registry.push_back(
        {"probability.pulse",
         "Fragility of a block of random friction under pulses is the distribution of its critical friction",
         "D = A (A - a_y) T²/(2 a_y) > d solved for the friction; triangle: closed slip",
         "roots and distributions are exact to round-off: 1e-9; shares of N draws: 4 √(P(1-P)/N)", pulse_fragility});
    registry.push_back({"probability.correlated-pulse",
                        "Pulse and friction correlated by a Gaussian copula slide with the closed probability",
                        "Φ(ln(A/(gμ))/√(β_A² + β_μ² - 2 r β_A β_μ)), medians", "4 √(P(1-P)/N)", correlated_pulse});
    registry.push_back({"probability.homogeneity",
                        "Slip of the one-way block is homogeneous in the motion and adds up over a sequence",
                        "D(κa; a_y) = κ D(a; a_y/κ): s'' = κa - a_y", "both sides are integrated exactly: 1e-9",
                        homogeneity});
    registry.push_back({"probability.rate",
                        "Annual rates of segments, their bounds outside, and curves read from files",
                        "Kennedy & Short (1994); Cornell et al. (2002); integration by parts; rate = -ln(1-poe)/t",
                        "closed forms: 1e-9; Simpson's rule of 2000 intervals leaves 1e-12", rates});
    registry.push_back(
        {"probability.fit",
         "Likelihood returns the curve its counts were made of; where it has no maximum, Firth's penalty is named",
         "Baker (2015); Firth (1993): the logit of a saturated model has p = (z + 1/2)/(n + 1)",
         "Newton's method ends at 1e-10 of the parameters: 1e-8", fits});
    registry.push_back({"probability.nrml", "A curve written as NRML and read back has the same probabilities",
                        "mean and stddev of x: θ exp(β²/2), mean √(exp(β²) - 1)",
                        "numbers are written to the last digit: 1e-9", nrml_round});
    registry.push_back(
        {"probability.interval", "Intervals at the ends of the counts, and the share that slides without an earthquake",
         "Wilson (1927); Brown, Cai & DasGupta (2001); 1 - 0.05^(1/n)", "closed forms: 1e-9", intervals});
    registry.push_back({"probability.philox",
                        "Random numbers are those of Philox4x32-10, and do not change with a variable added",
                        "known answers of Random123 (Salmon et al. 2011)", "whole numbers: exact", philox_words});
    registry.push_back({"probability.shapley", "Shapley effects of correlated variables",
                        "[b₁²(1 - r²/2) + r b₁b₂ + b₂² r²/2]/V (Owen & Prieur 2017)",
                        "by subsets exact; from draws 4 standard deviations of the bootstrap", shapley_linear});
}

} // namespace damslip::verification
