#include "probability/sensitivity.hpp"

#include "core/statistics.hpp"
#include "probability/distribution.hpp"
#include "probability/sampling.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace damslip::probability {

namespace {

/// Value with the 95 % interval of its bootstrap values.
Estimated with_interval(double value, const std::vector<double>& drawn)
{
    if (drawn.empty()) return {value, value, value};
    return {value, percentile(drawn, 0.025), percentile(drawn, 0.975)};
}

struct IndexSums {
    double mean = 0.0, variance = 0.0;
    std::vector<double> first, total;
};

/// The formulas on the rows listed.
IndexSums index_sums(std::span<const double> f_a, std::span<const double> f_b,
                     std::span<const std::vector<double>> f_ab, double noise, const std::vector<std::uint32_t>& rows)
{
    IndexSums s;
    const double n = static_cast<double>(rows.size());
    for (const std::uint32_t i : rows) s.mean += 0.5 * (f_a[i] + f_b[i]) / n;
    for (const std::uint32_t i : rows)
        s.variance += (std::pow(f_a[i] - s.mean, 2) + std::pow(f_b[i] - s.mean, 2)) / (2.0 * n - 1.0);
    s.variance = std::max(0.0, s.variance - noise);
    for (const std::vector<double>& f : f_ab) {
        double first = 0.0, total = 0.0;
        for (const std::uint32_t i : rows) {
            first += (f_b[i] - s.mean) * (f[i] - f_a[i]) / n; // the mean taken off: same expectation, less scatter
            total += std::pow(f_a[i] - f[i], 2) / (2.0 * n);
        }
        s.first.push_back(s.variance > 0.0 ? first / s.variance : 0.0);
        s.total.push_back(s.variance > 0.0 ? (total - noise) / s.variance : 0.0);
    }
    return s;
}

std::vector<std::uint32_t> redrawn(const Stream& stream, std::uint32_t n, std::uint32_t draw)
{
    std::vector<std::uint32_t> rows(n);
    for (std::uint32_t i = 0; i < n; ++i) rows[i] = stream.below(n, i, draw);
    return rows;
}

/// 1 / (k C(k - 1, size)).
double shapley_weight(std::size_t k, int size)
{
    double choose = 1.0;
    for (int j = 0; j < size; ++j) choose *= static_cast<double>(k - 1 - static_cast<std::size_t>(j)) / (j + 1);
    return 1.0 / (static_cast<double>(k) * choose);
}

} // namespace

SobolIndices sobol_indices(std::span<const double> f_a, std::span<const double> f_b,
                           std::span<const std::vector<double>> f_ab, double noise, std::uint64_t seed,
                           std::uint32_t bootstrap)
{
    const std::size_t n = f_a.size();
    if (n < 2) throw ParameterError("rows", fmt::format("{}", n), "2 at least");
    bool same = f_b.size() == n;
    for (const std::vector<double>& f : f_ab) same = same && f.size() == n;
    if (!same) throw ParameterError("answers", "samples of unequal size", fmt::format("{} of each sample", n));
    const std::uint32_t count = static_cast<std::uint32_t>(n);
    std::vector<std::uint32_t> rows(n);
    std::iota(rows.begin(), rows.end(), 0u);
    const IndexSums whole = index_sums(f_a, f_b, f_ab, noise, rows);
    const Stream stream(seed, "bootstrap of indices");
    std::vector<std::vector<double>> first(f_ab.size()), total(f_ab.size());
    for (std::uint32_t d = 0; d < bootstrap; ++d) {
        const IndexSums s = index_sums(f_a, f_b, f_ab, noise, redrawn(stream, count, d));
        for (std::size_t i = 0; i < f_ab.size(); ++i) first[i].push_back(s.first[i]), total[i].push_back(s.total[i]);
    }
    SobolIndices out{whole.mean, whole.variance, {}};
    for (std::size_t i = 0; i < f_ab.size(); ++i)
        out.variables.push_back({with_interval(whole.first[i], first[i]), with_interval(whole.total[i], total[i])});
    return out;
}

std::vector<double> shapley(std::size_t k, const std::function<double(std::uint32_t)>& c)
{
    if (k == 0 || k > 20) throw ParameterError("variables", fmt::format("{}", k), "1 to 20");
    std::vector<double> values(std::size_t{1} << k, 0.0);
    for (std::uint32_t u = 1; u < values.size(); ++u) values[u] = c(u);
    std::vector<double> share(k, 0.0);
    for (std::uint32_t u = 0; u < values.size(); ++u)
        for (std::uint32_t i = 0; i < k; ++i)
            if (!(u >> i & 1u)) share[i] += shapley_weight(k, std::popcount(u)) * (values[u | 1u << i] - values[u]);
    return share;
}

ShapleyEffects shapley_effects(const GaussianCopula& copula,
                               const std::function<double(std::span<const double>)>& answer, std::uint32_t outer,
                               std::uint32_t inner, double noise, std::uint64_t seed, std::uint32_t bootstrap)
{
    const std::size_t k = copula.dimension();
    if (k == 0 || k > 12) throw ParameterError("variables", fmt::format("{}", k), "1 to 12");
    if (outer < 2) throw ParameterError("outer", fmt::format("{}", outer), "2 at least");
    if (inner < 2) throw ParameterError("inner", fmt::format("{}", inner), "2 at least");
    const std::uint32_t all = (1u << k) - 1u;
    ShapleyEffects out;
    // spread[u][o]: variance of Y over X_u with the others fixed at outer draw o. c(u) = its mean has the same Shapley effects as
    // Var E[Y | X_u] (Song, Nelson & Staum 2016, theorem 1), and is unbiased for any `inner`.
    std::vector<std::vector<double>> spread(all + 1u);
    for (std::uint32_t u = 1; u <= all; ++u) {
        const Stream stream(seed, fmt::format("subset {}", u));
        for (std::uint32_t o = 0; o < outer; ++o) {
            std::vector<double> z(k), y;
            std::uint32_t block = 0;
            for (double& v : z) v = stream.uniform(o, block++);
            const std::vector<double> fixed = copula.dependent(z);
            for (std::uint32_t i = 0; i < inner; ++i) {
                for (double& v : z) v = stream.uniform(o, block++);
                y.push_back(answer(copula.conditional(all & ~u, fixed, z)));
                ++out.runs;
            }
            const double mean = std::accumulate(y.begin(), y.end(), 0.0) / inner;
            double sum = 0.0;
            for (const double v : y) sum += (v - mean) * (v - mean) / (inner - 1.0);
            spread[u].push_back(sum - noise);
            if (u == all) out.mean += mean / outer;
        }
    }
    const auto effects = [&](auto&& row) {
        return shapley(k, [&](std::uint32_t u) {
            double sum = 0.0;
            for (std::uint32_t o = 0; o < outer; ++o) sum += spread[u][row(u, o)] / outer;
            return sum;
        });
    };
    const std::vector<double> whole = effects([](std::uint32_t, std::uint32_t o) { return o; });
    out.variance = std::accumulate(whole.begin(), whole.end(), 0.0);
    std::vector<std::vector<double>> drawn(k);
    for (std::uint32_t d = 0; d < bootstrap; ++d) {
        const Stream stream(seed, "bootstrap of effects", d);
        const std::vector<double> e =
            effects([&](std::uint32_t u, std::uint32_t o) { return stream.below(outer, o, u); });
        const double v = std::accumulate(e.begin(), e.end(), 0.0);
        for (std::size_t i = 0; i < k; ++i) drawn[i].push_back(v > 0.0 ? e[i] / v : 0.0);
    }
    for (std::size_t i = 0; i < k; ++i)
        out.shares.push_back(with_interval(out.variance > 0.0 ? whole[i] / out.variance : 0.0, drawn[i]));
    return out;
}

double TornadoBar::swing() const
{
    if (y.empty()) return 0.0;
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    return *high - *low;
}

void order_tornado(std::vector<TornadoBar>& bars)
{
    std::sort(bars.begin(), bars.end(), [](const TornadoBar& a, const TornadoBar& b) {
        return a.swing() != b.swing() ? a.swing() > b.swing() : a.variable < b.variable;
    });
}

} // namespace damslip::probability
