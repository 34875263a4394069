#include "fe2d/rock/reduce_rock.hpp"

#include "core/parallel.hpp"
#include "fe2d/harmonic/transfer.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/solver/linear_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <stdexcept>

extern "C" void dgemm_(const char* turn_a, const char* turn_b, const int* m, const int* n, const int* k,
                       const double* alpha, const double* a, const int* lda, const double* b, const int* ldb,
                       const double* beta, double* c, const int* ldc);

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::size_t random_loads = 2;

/// Sampled beyond the highest frequency, where loads grow with e^{σt}: σ, ω over the highest ω. Blows are short: without
/// these the rock's answer to one of 20 ms at b_K 0.9 ms is off by 11 ... 15 % of its peak, with them by 0.7 % (25 Hz), and nearly undamped
/// modes of twice that frequency are gone.
constexpr FrequencySolver::At beyond[]{{.frequency = 1.3, .growth = 0.3}, {.frequency = 2.0, .growth = 1.0}};

MatrixXd product(char turn, Eigen::Ref<const MatrixXd> a, const MatrixXd& b)
{
    const int m = static_cast<int>(turn == 'T' ? a.cols() : a.rows()), k = static_cast<int>(b.rows()),
              n = static_cast<int>(b.cols()), lda = static_cast<int>(a.outerStride());
    const double one = 1.0, zero = 0.0;
    MatrixXd c(m, n);
    dgemm_(&turn, "N", &m, &n, &k, &one, a.data(), &lda, b.data(), &k, &zero, c.data(), &m);
    return c;
}

MatrixXd symmetric(const MatrixXd& m)
{
    return 0.5 * (m + m.transpose());
}

/// Same numbers everywhere, uniform in -1 ... 1 (SplitMix64: Steele, Lea & Flood 2014).
class Random {
public:
    double operator()()
    {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1.0;
    }

private:
    std::uint64_t state_ = 18;
};

/// Arc length along nodes of the surface, from 0 to 1 [-].
std::vector<double> stations(std::span<const Point> surface)
{
    std::vector<double> s{0.0};
    for (std::size_t i = 1; i < surface.size(); ++i)
        s.push_back(s.back() + std::hypot(surface[i].x - surface[i - 1].x, surface[i].y - surface[i - 1].y));
    const double length = s.back();
    for (double& value : s) value /= length;
    return s;
}

double length_of(std::span<const Point> surface)
{
    double length = 0.0;
    for (std::size_t i = 1; i < surface.size(); ++i)
        length += std::hypot(surface[i].x - surface[i - 1].x, surface[i].y - surface[i - 1].y);
    return length;
}

/// The base's nodes; those of the water's floor, the heel last.
std::span<const Point> base_of(const WaveBoxInput& input)
{
    return std::span(input.surface).subspan(static_cast<std::size_t>(input.floor));
}
std::span<const Point> floor_of(const WaveBoxInput& input)
{
    return std::span(input.surface).first(input.floor > 0 ? static_cast<std::size_t>(input.floor) + 1 : 0);
}

/// Polynomials on the base times the length that belongs to each node, in x and in y.
MatrixXd legendre_loads(std::span<const Point> surface, int degrees)
{
    const std::vector<double> s = stations(surface);
    const auto n = static_cast<Index>(s.size());
    MatrixXd loads = MatrixXd::Zero(2 * n, 2 * degrees);
    for (Index i = 0; i < n; ++i) {
        const double before = s[static_cast<std::size_t>(std::max<Index>(0, i - 1))],
                     after = s[static_cast<std::size_t>(std::min(n - 1, i + 1))],
                     x = 2.0 * s[static_cast<std::size_t>(i)] - 1.0;
        for (int k = 0; k < degrees; ++k)
            loads(2 * i, 2 * k) = loads(2 * i + 1, 2 * k + 1) =
                0.5 * (after - before) * std::legendre(static_cast<unsigned>(k), x);
    }
    return loads;
}

/// The same as pressures on the floor.
MatrixXd legendre_pressures(std::span<const Point> floor, int degrees)
{
    const std::vector<double> s = stations(floor);
    MatrixXd pressures(static_cast<Index>(s.size()), degrees);
    for (Index i = 0; i < pressures.rows(); ++i)
        for (int k = 0; k < degrees; ++k)
            pressures(i, k) = std::legendre(static_cast<unsigned>(k), 2.0 * s[static_cast<std::size_t>(i)] - 1.0);
    return pressures;
}

/// Rows of the reduced rock by the displacements of the surface's nodes: (x, y) of the base, then v of the floor (ReducedRock::floor).
SparseMatrix rows_of_rock(const WaveBoxInput& input)
{
    const std::span<const Point> floor = floor_of(input);
    const auto base = static_cast<Index>(2 * base_of(input).size()), before = static_cast<Index>(2 * input.floor);
    std::vector<Eigen::Triplet<double>> entries;
    for (Index i = 0; i < base; ++i) entries.emplace_back(i, before + i, 1.0);
    for (std::size_t k = 0; k + 1 < floor.size(); ++k) {
        const double length = floor[k + 1].x - floor[k].x;
        for (const std::size_t i : {k, k + 1})
            for (const std::size_t j : {k, k + 1})
                entries.emplace_back(base + static_cast<Index>(i), static_cast<Index>(2 * j + 1),
                                     -length * (i == j ? 1.0 / 3.0 : 1.0 / 6.0));
    }
    SparseMatrix rows(base + static_cast<Index>(floor.size()), before + base);
    rows.setFromTriplets(entries.begin(), entries.end());
    return rows;
}

/// What makes a mean displacement of each row.
VectorXd per_length(const WaveBoxInput& input)
{
    const std::span<const Point> floor = floor_of(input);
    const auto base = static_cast<Index>(2 * base_of(input).size());
    VectorXd scale = VectorXd::Ones(base + static_cast<Index>(floor.size()));
    for (std::size_t i = 0; i < floor.size(); ++i)
        scale[base + static_cast<Index>(i)] =
            2.0 / (floor[std::min(i + 1, floor.size() - 1)].x - floor[i > 0 ? i - 1 : 0].x);
    return scale;
}

/// Depth where the sponge has taken all but 1/e of a wave that goes in, out of its damping b0 ξ² K: the wave loses
/// ω² b0 ξ²/(2 c_s) per length [m].
double reach(const WaveBoxInput& input, double frequency)
{
    const WaveBoxShape& s = input.shape;
    const double thickness = (s.depth - s.inner_depth) * input.base, c = elastic_waves(input.rock).s;
    const double b0 = s.sponge * thickness / c;
    return s.inner_depth * input.base +
           thickness * std::min(1.0, std::cbrt(6.0 * c / (frequency * frequency * b0 * thickness)));
}

class Reduction {
public:
    Reduction(const WaveBoxInput& input, const WaveBox& box, const ReductionOptions& options)
        : input_(input), box_(box), options_(options), solver_(box.mass, box.damping, box.stiffness, "the rock's box"),
          kept_(options.kept), frequencies_(sampled_frequencies(input, options.sampling))
    {
        loads_ = legendre_loads(base_of(input), degrees_on(base_of(input)));
        // forces of random size: rough, as those of single nodes are
        Random random;
        random_.resize(loads_.rows(), random_loads);
        for (double& value : random_.reshaped()) value = random();
        if (input.floor == 0) return;
        rows_ = rows_of_rock(input);
        per_length_ = per_length(input);
        loads_ = side_by_side(loads_, legendre_pressures(floor_of(input), degrees_on(floor_of(input))));
        MatrixXd pressures(static_cast<Index>(floor_of(input).size()), random_loads);
        for (double& value : pressures.reshaped()) value = random();
        random_ = side_by_side(random_, pressures);
    }

    ReducedRock run()
    {
        const Stopwatch watch;
        std::vector<FrequencySolver::At> sampled(frequencies_.size());
        std::ranges::transform(frequencies_, sampled.begin(), [](double f) { return FrequencySolver::At{f}; });
        for (const FrequencySolver::At& b : beyond)
            sampled.push_back({b.frequency * input_.highest_frequency, b.growth * input_.highest_frequency});
        add_snapshots(sampled, loads_, [this] { solve_statics(); });
        choose_checks();
        ReducedRock rock;
        int rounds = 0;
        for (;;) {
            rock = project();
            ++rounds;
            const std::size_t worst = check(rock);
            if (rock.report.passed() || rounds == options_.largest_rounds) break;
            MatrixXd both(loads_.rows(), loads_.cols() + random_.cols());
            both << loads_, random_;
            if (const double frequency = checks_[worst].frequency; frequency != added_) {
                add_snapshots(std::vector{FrequencySolver::At{frequency}}, both);
                frequencies_.push_back(frequency);
                added_ = frequency;
            }
            kept_ *= 0.3;
        }
        rock.report.unknowns = 2 * box_.nodes;
        rock.report.patterns = static_cast<int>(loads_.cols());
        rock.report.frequencies = static_cast<int>(frequencies_.size());
        rock.report.modes = static_cast<int>(rock.count());
        rock.report.rounds = rounds;
        rock.report.wanted = options_.wanted;
        rock.report.seconds = watch.seconds();
        return rock;
    }

private:
    struct Check {
        double frequency;
        MatrixXcd exact; ///< B_r D⁻¹ B_rᵀ p
    };

    int degrees_on(std::span<const Point> surface) const
    {
        const double waves = input_.highest_frequency * length_of(surface) / elastic_waves(input_.rock).s;
        return std::max(3, 1 + static_cast<int>(std::ceil(0.75 * waves)));
    }

    /// Loads on the base and loads on the floor, each alone.
    static MatrixXd side_by_side(const MatrixXd& base, const MatrixXd& floor)
    {
        MatrixXd both = MatrixXd::Zero(base.rows() + floor.rows(), base.cols() + floor.cols());
        both.topLeftCorner(base.rows(), base.cols()) = base;
        both.bottomRightCorner(floor.rows(), floor.cols()) = floor;
        return both;
    }

    Index rows() const { return rows_.rows() > 0 ? rows_.rows() : static_cast<Index>(box_.interface.size()); }

    template <class Matrix>
    auto on_interface(const Matrix& all) const
    {
        typename Matrix::PlainObject rows(static_cast<Index>(box_.interface.size()), all.cols());
        for (Index i = 0; i < rows.rows(); ++i) rows.row(i) = all.row(box_.interface[static_cast<std::size_t>(i)]);
        if (rows_.rows() > 0) rows = (rows_.cast<typename Matrix::Scalar>() * rows).eval();
        return rows;
    }

    MatrixXd on_box(const MatrixXd& loads) const
    {
        const MatrixXd interface = rows_.rows() > 0 ? MatrixXd(rows_.transpose() * loads) : loads;
        MatrixXd all = MatrixXd::Zero(2 * box_.nodes, interface.cols());
        for (Index i = 0; i < interface.rows(); ++i)
            all.row(box_.interface[static_cast<std::size_t>(i)]) = interface.row(i);
        return all;
    }

    /// From `first` on: columns x for loads whose flexibility is |pᵀ u_c|.
    template <class Matrix>
    void put(Index first, const Matrix& x, const VectorXd& flexibility)
    {
        snapshots_.middleCols(first, x.cols()) = x * flexibility.cwiseSqrt().cwiseInverse().asDiagonal();
    }

    void solve_statics()
    {
        LinearSolver solver({.factorisation = Factorisation::supernodal});
        if (!solver.factorise(box_.stiffness).ok())
            throw std::runtime_error("the rock's box cannot be factorised: " + text_of(solver.report().note()));
        constexpr Index width = 32; // of blocks: all columns at a time are as large as all snapshots
        const MatrixXd each = MatrixXd::Identity(rows(), rows());
        MatrixXd flexibility(rows(), rows()), x = MatrixXd::Zero(2 * box_.nodes, loads_.cols());
        for (Index first = 0; first < rows(); first += width) {
            const Index count = std::min(width, rows() - first);
            const MatrixXd block = solver.solve(on_box(each.middleCols(first, count)));
            flexibility.middleCols(first, count) = on_interface(block);
            x.noalias() += block * loads_.middleRows(first, count);
        }
        flexibility_ = symmetric(flexibility);
        put(0, x, (loads_.transpose() * flexibility_ * loads_).diagonal());
    }

    /// @param statics  of the first ones, which come before all
    void add_snapshots(std::span<const FrequencySolver::At> frequencies, const MatrixXd& loads,
                       const std::function<void()>& statics = {})
    {
        const Index n = loads.cols(), before = statics ? n : snapshots_.cols();
        snapshots_.conservativeResize(2 * box_.nodes, before + 2 * n * static_cast<Index>(frequencies.size()));
        const auto take = [&](std::size_t k, const MatrixXcd& x) {
            const MatrixXcd u = on_interface(x);
            VectorXd flexibility(n);
            for (Index i = 0; i < n; ++i) flexibility[i] = std::abs(u.col(i).cwiseProduct(loads.col(i)).sum());
            const Index first = before + 2 * n * static_cast<Index>(k);
            put(first, x.real(), flexibility);
            put(first + n, x.imag(), flexibility);
        };
        solver_.solve(frequencies, on_box(loads), take, statics);
    }

    /// In the middle between sampled frequencies, from the first gap to the last.
    void choose_checks()
    {
        const auto gaps = static_cast<int>(frequencies_.size());
        std::vector<FrequencySolver::At> between;
        for (int k = 0; k < options_.checks; ++k) {
            const int gap = options_.checks > 1 ? (gaps - 1) * k / (options_.checks - 1) : gaps - 1;
            const double upper = frequencies_[static_cast<std::size_t>(gap)],
                         lower = gap > 0 ? frequencies_[static_cast<std::size_t>(gap - 1)] : 0.0;
            between.push_back({0.5 * (lower + upper)});
        }
        checks_.resize(between.size());
        solver_.solve(between, on_box(random_), [&](std::size_t k, const MatrixXcd& exact) {
            checks_[k] = {between[k].frequency, on_interface(exact)};
        });
    }

    double size(const Eigen::VectorXcd& u) const
    {
        return per_length_.size() > 0 ? u.cwiseProduct(per_length_).norm() : u.norm();
    }

    /// @returns the number of the worst check; the report gets its error
    std::size_t check(ReducedRock& rock) const
    {
        std::size_t worst = 0;
        rock.report.wanted = options_.wanted;
        for (std::size_t k = 0; k < checks_.size(); ++k) {
            const MatrixXcd u = rock.response(checks_[k].frequency, 0.0, random_);
            for (Index load = 0; load < u.cols(); ++load) {
                const double error = size(u.col(load) - checks_[k].exact.col(load)) / size(checks_[k].exact.col(load));
                if (error <= rock.report.error) continue;
                rock.report.error = error;
                worst = k;
            }
        }
        return worst;
    }

    ReducedRock project() const
    {
        const double middle = 0.5 * input_.highest_frequency;
        const SparseMatrix norm = box_.stiffness + middle * middle * box_.mass;
        const MatrixXd basis = product('N', snapshots_, leading_directions(projected(norm, snapshots_), kept_)),
                       stiffness = projected(box_.stiffness, basis), mass = projected(box_.mass, basis),
                       damping = projected(box_.damping, basis);
        // M̂ = 1, K̂ diagonal
        const Eigen::LLT<MatrixXd> llt(mass);
        assert(llt.info() == Eigen::Success);
        MatrixXd scaled = llt.matrixL().solve(stiffness);
        scaled = llt.matrixL().solve(scaled.transpose().eval());
        const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(symmetric(scaled));
        const MatrixXd modes = llt.matrixU().solve(eigen.eigenvectors());
        ReducedRock rock;
        rock.floor = static_cast<Index>(floor_of(input_).size());
        rock.stiffness = eigen.eigenvalues();
        rock.damping = symmetric(modes.transpose() * damping * modes);
        rock.modes = on_interface(basis) * modes;
        rock.residual =
            symmetric(flexibility_ - rock.modes * rock.stiffness.cwiseInverse().asDiagonal() * rock.modes.transpose());
        // Galerkin's flexibility is below the true one; what is negative is round-off.
        const Eigen::SelfAdjointEigenSolver<MatrixXd> rest(rock.residual);
        if (rest.eigenvalues()[0] < 0.0)
            rock.residual = symmetric(rest.eigenvectors() * rest.eigenvalues().cwiseMax(0.0).asDiagonal() *
                                      rest.eigenvectors().transpose());
        return rock;
    }

    const WaveBoxInput& input_;
    const WaveBox& box_;
    ReductionOptions options_;
    FrequencySolver solver_;
    double kept_, added_ = 0.0;
    std::vector<double> frequencies_;
    MatrixXd loads_, random_; ///< on the interface
    SparseMatrix rows_;       ///< rows_of_rock(); empty where the interface is the base alone
    VectorXd per_length_;     ///< of these rows; empty likewise
    MatrixXd flexibility_;    ///< B_r K⁻¹ B_rᵀ
    MatrixXd snapshots_;
    std::vector<Check> checks_;
};

} // namespace

MatrixXd projected(const SparseMatrix& a, const MatrixXd& v)
{
    constexpr Index width = 32;
    const Index n = v.cols();
    MatrixXd result(n, n);
    parallel_for(static_cast<std::size_t>((n + width - 1) / width), 0, [&](std::size_t block) {
        const Index first = width * static_cast<Index>(block), last = std::min(n, first + width);
        const MatrixXd image = a * v.middleCols(first, last - first);
        result.block(0, first, last, last - first) = product('T', v.leftCols(last), image);
    });
    result.triangularView<Eigen::StrictlyLower>() = result.transpose();
    return result;
}

MatrixXd leading_directions(const MatrixXd& gram, double kept)
{
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(gram);
    const VectorXd values = eigen.eigenvalues().reverse();
    const MatrixXd vectors = eigen.eigenvectors().rowwise().reverse();
    VectorXd left = gram.diagonal(); // of each snapshot
    Index count = 0;
    const double smallest = 1e-13 * values[0];
    while (count < values.size() && values[count] > smallest && left.maxCoeff() > kept) {
        left -= values[count] * vectors.col(count).cwiseAbs2();
        ++count;
    }
    return vectors.leftCols(count) * values.head(count).cwiseSqrt().cwiseInverse().asDiagonal();
}

std::vector<double> sampled_frequencies(const WaveBoxInput& input, double sampling)
{
    constexpr int pieces = 4000;
    const double step = input.highest_frequency / pieces, c = elastic_waves(input.rock).s;
    std::vector<double> number{0.0}; // of frequencies up to here
    for (int k = 0; k < pieces; ++k)
        number.push_back(number.back() + step * reach(input, (k + 0.5) * step) / (std::numbers::pi * c));
    const int count = std::max(3, static_cast<int>(std::ceil(sampling * number.back())));
    std::vector<double> frequencies;
    for (int k = 1; k < count; ++k) {
        const auto at = std::lower_bound(number.begin(), number.end(), number.back() * k / count);
        frequencies.push_back(step * static_cast<double>(at - number.begin()));
    }
    frequencies.push_back(input.highest_frequency);
    return frequencies;
}

ReducedRock reduce_rock(const WaveBoxInput& input, const WaveBox& box, const ReductionOptions& options)
{
    return Reduction(input, box, options).run();
}

} // namespace damslip::fe2d
