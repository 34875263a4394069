#include "probability/sampling.hpp"

#include "core/statistics.hpp"
#include "core/text.hpp"
#include "probability/distribution.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <gsl/gsl_qrng.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace damslip::probability {

namespace {

/// The name of the stream of records. No variable has it: names of variables have no blanks.
constexpr const char* record_stream = "record of a sample";

} // namespace

RecordDraw::RecordDraw(RecordOrder order, std::uint64_t seed, std::span<const double> weights, std::uint32_t replicate)
    : order_(order), stream_(seed, record_stream, replicate)
{
    if (weights.empty()) throw ParameterError("records", "0", "one record at least");
    double sum = 0.0;
    for (const double w : weights) {
        if (!(w > 0.0) || !std::isfinite(w)) throw ParameterError("weight", shortest(w), "a number > 0");
        below_.push_back(sum += w);
    }
    for (double& b : below_) b /= sum;
    below_.back() = 1.0;
    equal_ = std::all_of(weights.begin(), weights.end(), [&](double w) { return w == weights.front(); });
}

RecordDraw::RecordDraw(RecordOrder order, std::uint64_t seed, std::size_t records, std::uint32_t replicate)
    : RecordDraw(order, seed, std::vector<double>(records, 1.0), replicate)
{
}

std::size_t RecordDraw::operator()(std::uint32_t sample) const
{
    const std::uint32_t n = static_cast<std::uint32_t>(below_.size());
    double u = stream_.uniform(sample);
    if (order_ == RecordOrder::balanced) {
        const std::uint32_t block = sample / n;
        const std::uint32_t stratum = permutation(stream_, n, 1 + block)[sample % n];
        if (equal_) return stratum;
        u = std::min((stratum + stream_.uniform(block)) / n, 1.0 - 0x1p-53); // one offset for the block: systematic
    }
    if (equal_) return std::min<std::size_t>(n - 1, static_cast<std::size_t>(u * n));
    return static_cast<std::size_t>(std::upper_bound(below_.begin(), below_.end() - 1, u) - below_.begin());
}

std::vector<std::uint32_t> permutation(const Stream& stream, std::uint32_t n, std::uint32_t block)
{
    std::vector<std::uint32_t> p(n);
    std::iota(p.begin(), p.end(), 0u);
    for (std::uint32_t k = n; k > 1; --k) std::swap(p[k - 1], p[stream.below(k, k, block)]);
    return p;
}

std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> c, std::array<std::uint32_t, 2> key)
{
    constexpr std::uint64_t m0 = 0xD2511F53u, m1 = 0xCD9E8D57u; // multipliers and Weyl steps of Salmon et al. (2011)
    constexpr std::uint32_t w0 = 0x9E3779B9u, w1 = 0xBB67AE85u;
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = m0 * c[0], b = m1 * c[2];
        c = {static_cast<std::uint32_t>(b >> 32) ^ c[1] ^ key[0], static_cast<std::uint32_t>(b),
             static_cast<std::uint32_t>(a >> 32) ^ c[3] ^ key[1], static_cast<std::uint32_t>(a)};
        key[0] += w0;
        key[1] += w1;
    }
    return c;
}

std::uint32_t stream_hash(std::string_view name)
{
    std::uint32_t hash = 2166136261u;
    for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619u;
    return hash;
}

Stream::Stream(std::uint64_t seed, std::string_view name, std::uint32_t replicate)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}, hash_(stream_hash(name)),
      replicate_(replicate)
{
}

std::array<std::uint32_t, 4> Stream::block(std::uint32_t sample, std::uint32_t block) const
{
    return philox4x32({sample, hash_, replicate_, block}, key_);
}

std::uint64_t Stream::bits(std::uint32_t sample, std::uint32_t which) const
{
    const std::array<std::uint32_t, 4> b = block(sample, which);
    return static_cast<std::uint64_t>(b[0]) << 32 | b[1];
}

double Stream::uniform(std::uint32_t sample, std::uint32_t block) const
{
    return static_cast<double>(bits(sample, block) >> 12 << 1 | 1u) * 0x1p-53; // (2k + 1) 2^-53
}

std::uint32_t Stream::below(std::uint32_t n, std::uint32_t sample, std::uint32_t block) const
{
    // n bits / 2^64 without 128-bit numbers: high half first, then what the low half carries over.
    const std::uint64_t b = bits(sample, block);
    const std::uint64_t carry = (b & 0xFFFFFFFFu) * n >> 32;
    return static_cast<std::uint32_t>(((b >> 32) * n + carry) >> 32);
}

namespace {

// Blocks of a variable's stream: 0 the number within the stratum; the permutation or the shift has one of its own.
constexpr std::uint32_t whole_block = 1;

/// Strata 0 ... N - 1 of the first N = 2^m points in each dimension. A point of gsl_qrng_sobol is k 2^-30, and its first N ones have zeros below
/// 2^-m; it leaves the origin out.
std::vector<std::uint32_t> sobol_strata(std::size_t dimension, std::uint32_t n, int bits)
{
    std::vector<std::uint32_t> strata(dimension * n, 0u);
    const std::unique_ptr<gsl_qrng, void (*)(gsl_qrng*)> sequence(
        gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(dimension)), gsl_qrng_free);
    std::vector<double> x(dimension);
    for (std::uint32_t i = 1; i < n; ++i) {
        gsl_qrng_get(sequence.get(), x.data());
        for (std::size_t k = 0; k < dimension; ++k)
            strata[k * n + i] = static_cast<std::uint32_t>(std::ldexp(x[k], bits));
    }
    return strata;
}

} // namespace

UnitPoints::UnitPoints(Sampling sampling, std::uint64_t seed, const std::vector<std::string>& names, std::uint32_t n,
                       std::uint32_t replicate)
    : sampling_(sampling), n_(n)
{
    if (n == 0) throw ParameterError("samples", "0", "a whole number > 0");
    for (const std::string& name : names) streams_.emplace_back(seed, name, replicate);
    if (sampling_ == Sampling::sobol && names.size() > sobol_dimensions) sampling_ = Sampling::random;
    if (sampling_ == Sampling::sobol) {
        if (!std::has_single_bit(n) || n > 1u << 30)
            throw ParameterError("samples", fmt::format("{}", n), "a power of two up to 2^30, for Sobol' points");
        bits_ = std::countr_zero(n);
        if (!names.empty()) strata_ = sobol_strata(names.size(), n, bits_);
        for (std::size_t k = 0; k < names.size(); ++k) {
            const std::uint32_t shift = streams_[k].below(n, 0, whole_block);
            for (std::uint32_t i = 0; i < n; ++i) strata_[k * n + i] ^= shift;
        }
    }
    if (sampling_ == Sampling::lhs)
        for (const Stream& stream : streams_) {
            const std::vector<std::uint32_t> order = permutation(stream, n, whole_block);
            strata_.insert(strata_.end(), order.begin(), order.end());
        }
}

double UnitPoints::operator()(std::uint32_t sample, std::size_t variable) const
{
    const double v = streams_[variable].uniform(sample);
    if (sampling_ == Sampling::random) return v;
    const double u = (strata_[variable * n_ + sample] + v) / n_;
    return std::min(u, 1.0 - 0x1p-53); // rounded to 1 in the last stratum, once in 2^52
}

std::vector<double> UnitPoints::point(std::uint32_t sample) const
{
    std::vector<double> u;
    for (std::size_t k = 0; k < dimension(); ++k) u.push_back((*this)(sample, k));
    return u;
}

NotPositiveDefinite::NotPositiveDefinite(double smallest)
    : std::invalid_argument(
          fmt::format("the correlations contradict one another: smallest eigenvalue {:.3g}, expected > 0", smallest)),
      smallest_(smallest)
{
}

GaussianCopula::GaussianCopula(std::size_t dimension, std::span<const RankCorrelation> correlations)
    : dimension_(dimension), independent_(correlations.empty())
{
    const Eigen::Index n = static_cast<Eigen::Index>(dimension);
    Eigen::MatrixXd r = Eigen::MatrixXd::Identity(n, n);
    std::set<std::pair<std::size_t, std::size_t>> named;
    for (const RankCorrelation& c : correlations) {
        if (!(std::abs(c.spearman) < 1.0)) throw ParameterError("spearman", shortest(c.spearman), "-1 < spearman < 1");
        if (c.first == c.second || c.first >= dimension || c.second >= dimension ||
            !named.insert(std::minmax(c.first, c.second)).second)
            throw ParameterError("between", fmt::format("{}, {}", c.first, c.second), "two variables, each pair once");
        const Eigen::Index i = static_cast<Eigen::Index>(c.first), j = static_cast<Eigen::Index>(c.second);
        r(i, j) = r(j, i) = 2.0 * std::sin(std::numbers::pi * c.spearman / 6.0);
    }
    Eigen::MatrixXd l = r;
    if (!independent_) {
        const double smallest =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(r, Eigen::EigenvaluesOnly).eigenvalues()(0);
        if (!(smallest > 1e-10)) throw NotPositiveDefinite(smallest);
        l = r.llt().matrixL();
    }
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            r_.push_back(r(i, j));
            factor_.push_back(j > i ? 0.0 : l(i, j));
        }
}

std::vector<double> GaussianCopula::dependent(std::span<const double> u) const
{
    std::vector<double> out(u.begin(), u.end());
    if (independent_) return out;
    std::vector<double> z(u.size());
    for (std::size_t i = 0; i < dimension_; ++i) {
        z[i] = normal_quantile(u[i]);
        double y = 0.0;
        bool alone = true;
        for (std::size_t j = 0; j <= i; ++j) {
            y += factor_[i * dimension_ + j] * z[j];
            alone = alone && (j == i || factor_[i * dimension_ + j] == 0.0);
        }
        if (!alone) out[i] = normal_cdf(y); // a variable without correlation keeps its bits
    }
    return out;
}

std::vector<double> GaussianCopula::conditional(std::uint32_t given, std::span<const double> fixed,
                                                std::span<const double> u) const
{
    std::vector<double> out(u.begin(), u.end());
    std::vector<Eigen::Index> known, open;
    for (std::size_t i = 0; i < dimension_; ++i) {
        (given >> i & 1u ? known : open).push_back(static_cast<Eigen::Index>(i));
        if (given >> i & 1u) out[i] = fixed[i];
    }
    if (independent_ || open.empty()) return out;
    const Eigen::Index n = static_cast<Eigen::Index>(dimension_);
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> r(r_.data(), n, n);
    Eigen::VectorXd z(static_cast<Eigen::Index>(open.size())), y(static_cast<Eigen::Index>(known.size()));
    for (Eigen::Index k = 0; k < z.size(); ++k) z(k) = normal_quantile(u[static_cast<std::size_t>(open[k])]);
    for (Eigen::Index k = 0; k < y.size(); ++k) y(k) = normal_quantile(fixed[static_cast<std::size_t>(known[k])]);
    // Y_open | Y_known is normal: mean R_ok R_kk^-1 y, covariance R_oo - R_ok R_kk^-1 R_ko.
    Eigen::MatrixXd covariance = r(open, open);
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(z.size());
    if (!known.empty()) {
        const Eigen::MatrixXd r_ok = r(open, known), r_kk = r(known, known);
        const Eigen::LLT<Eigen::MatrixXd> solver(r_kk);
        mean = r_ok * solver.solve(y);
        covariance -= r_ok * solver.solve(Eigen::MatrixXd(r_ok.transpose()));
    }
    const Eigen::MatrixXd l = covariance.llt().matrixL();
    const Eigen::VectorXd drawn = mean + l * z;
    for (Eigen::Index k = 0; k < z.size(); ++k) out[static_cast<std::size_t>(open[k])] = normal_cdf(drawn(k));
    return out;
}

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
