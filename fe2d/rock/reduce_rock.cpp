#include "fe2d/rock/reduce_rock.hpp"

#include "core/stopwatch.hpp"
#include "fe2d/model/edge_dashpots.hpp"
#include "fe2d/rock/frequency_solver.hpp"
#include "fe2d/solver/linear_solver.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
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
struct Beyond {
    double growth, frequency;
};
constexpr Beyond beyond[]{{0.3, 1.3}, {1.0, 2.0}};

MatrixXd product(char turn, const MatrixXd& a, const MatrixXd& b)
{
    const int m = static_cast<int>(turn == 'T' ? a.cols() : a.rows()), k = static_cast<int>(b.rows()),
              n = static_cast<int>(b.cols()), lda = static_cast<int>(a.rows());
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

/// Arc length along the interface, from 0 to 1 [-].
std::vector<double> stations(const std::vector<Point>& surface)
{
    std::vector<double> s{0.0};
    for (std::size_t i = 1; i < surface.size(); ++i)
        s.push_back(s.back() + std::hypot(surface[i].x - surface[i - 1].x, surface[i].y - surface[i - 1].y));
    const double length = s.back();
    for (double& value : s) value /= length;
    return s;
}

/// Polynomials on the interface times the length that belongs to each node, in x and in y.
MatrixXd legendre_loads(const std::vector<Point>& surface, int degrees)
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
        : input_(input), box_(box), options_(options), solver_(box.mass, box.damping, box.stiffness),
          kept_(options.kept), frequencies_(sampled_frequencies(input, options.sampling))
    {
        const double waves = input.highest_frequency * stations_length() / elastic_waves(input.rock).s;
        const int degrees = std::max(3, 1 + static_cast<int>(std::ceil(0.75 * waves)));
        loads_ = legendre_loads(input.surface, degrees);
        // forces of random size: rough, as those of single nodes are
        Random random;
        random_.resize(loads_.rows(), random_loads);
        for (double& value : random_.reshaped()) value = random();
    }

    ReducedRock run()
    {
        const Stopwatch watch;
        solve_statics();
        for (const double frequency : frequencies_) add_snapshots(frequency, 0.0, loads_);
        for (const Beyond& b : beyond)
            add_snapshots(b.frequency * input_.highest_frequency, b.growth * input_.highest_frequency, loads_);
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
                add_snapshots(frequency, 0.0, both);
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

    double stations_length() const
    {
        double length = 0.0;
        for (std::size_t i = 1; i < input_.surface.size(); ++i)
            length += std::hypot(input_.surface[i].x - input_.surface[i - 1].x,
                                 input_.surface[i].y - input_.surface[i - 1].y);
        return length;
    }

    template <class Matrix>
    auto on_interface(const Matrix& all) const
    {
        typename Matrix::PlainObject rows(static_cast<Index>(box_.interface.size()), all.cols());
        for (Index i = 0; i < rows.rows(); ++i) rows.row(i) = all.row(box_.interface[static_cast<std::size_t>(i)]);
        return rows;
    }

    MatrixXd on_box(const MatrixXd& interface) const
    {
        MatrixXd all = MatrixXd::Zero(2 * box_.nodes, interface.cols());
        for (Index i = 0; i < interface.rows(); ++i)
            all.row(box_.interface[static_cast<std::size_t>(i)]) = interface.row(i);
        return all;
    }

    /// Columns x for loads whose flexibility is |pᵀ u_c|.
    void add(const MatrixXd& x, const VectorXd& flexibility)
    {
        const Index before = snapshots_.cols();
        snapshots_.conservativeResize(x.rows(), before + x.cols());
        snapshots_.rightCols(x.cols()) = x * flexibility.cwiseSqrt().cwiseInverse().asDiagonal();
    }

    void solve_statics()
    {
        LinearSolver solver({.factorisation = Factorisation::supernodal});
        if (!solver.factorise(box_.stiffness).ok())
            throw std::runtime_error("the rock's box cannot be factorised: " + solver.report().text());
        const Index n = static_cast<Index>(box_.interface.size());
        const MatrixXd x = solver.solve(on_box(MatrixXd::Identity(n, n)));
        flexibility_ = symmetric(on_interface(x));
        add(product('N', x, loads_), (loads_.transpose() * flexibility_ * loads_).diagonal());
    }

    /// Displacements of the box by loads on its interface.
    MatrixXcd solve(double frequency, double growth, const MatrixXd& loads)
    {
        if (!solver_.factorise(frequency, growth))
            throw std::runtime_error("the rock's box is singular at a frequency");
        const MatrixXcd x = solver_.solve(on_box(loads));
        if (!(solver_.residual() < 1e-8)) throw std::runtime_error("the rock's box is nearly singular at a frequency");
        return x;
    }

    void add_snapshots(double frequency, double growth, const MatrixXd& loads)
    {
        if (!solver_.factorise(frequency, growth))
            throw std::runtime_error("the rock's box is singular at a frequency");
        const MatrixXcd x = solver_.solve(on_box(loads));
        const MatrixXcd u = on_interface(x);
        VectorXd flexibility(loads.cols());
        for (Index k = 0; k < loads.cols(); ++k) flexibility[k] = std::abs(u.col(k).cwiseProduct(loads.col(k)).sum());
        add(x.real(), flexibility);
        add(x.imag(), flexibility);
    }

    /// In the middle between sampled frequencies, from the first gap to the last.
    void choose_checks()
    {
        const auto gaps = static_cast<int>(frequencies_.size());
        for (int k = 0; k < options_.checks; ++k) {
            const int gap = options_.checks > 1 ? (gaps - 1) * k / (options_.checks - 1) : gaps - 1;
            const double upper = frequencies_[static_cast<std::size_t>(gap)],
                         lower = gap > 0 ? frequencies_[static_cast<std::size_t>(gap - 1)] : 0.0;
            const double frequency = 0.5 * (lower + upper);
            checks_.push_back({frequency, on_interface(solve(frequency, 0.0, random_))});
        }
    }

    /// @returns the number of the worst check; the report gets its error
    std::size_t check(ReducedRock& rock) const
    {
        std::size_t worst = 0;
        rock.report.wanted = options_.wanted;
        for (std::size_t k = 0; k < checks_.size(); ++k) {
            const MatrixXcd u = rock.response(checks_[k].frequency, 0.0, random_);
            for (Index load = 0; load < u.cols(); ++load) {
                const double error =
                    (u.col(load) - checks_[k].exact.col(load)).norm() / checks_[k].exact.col(load).norm();
                if (error <= rock.report.error) continue;
                rock.report.error = error;
                worst = k;
            }
        }
        return worst;
    }

    /// Columns that make the snapshots' leading directions orthogonal.
    MatrixXd leading_directions() const
    {
        const double middle = 0.5 * input_.highest_frequency;
        const SparseMatrix norm = box_.stiffness + middle * middle * box_.mass;
        const MatrixXd gram = symmetric(product('T', snapshots_, norm * snapshots_));
        const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(gram);
        const VectorXd values = eigen.eigenvalues().reverse();
        const MatrixXd vectors = eigen.eigenvectors().rowwise().reverse();
        VectorXd left = gram.diagonal(); // of each snapshot
        Index count = 0;
        const double smallest = 1e-13 * values[0];
        while (count < values.size() && values[count] > smallest && left.maxCoeff() > kept_) {
            left -= values[count] * vectors.col(count).cwiseAbs2();
            ++count;
        }
        return vectors.leftCols(count) * values.head(count).cwiseSqrt().cwiseInverse().asDiagonal();
    }

    ReducedRock project() const
    {
        const MatrixXd basis = product('N', snapshots_, leading_directions());
        const MatrixXd stiffness = symmetric(product('T', basis, box_.stiffness * basis)),
                       mass = symmetric(product('T', basis, box_.mass * basis)),
                       damping = symmetric(product('T', basis, box_.damping * basis));
        // M̂ = 1, K̂ diagonal
        const Eigen::LLT<MatrixXd> llt(mass);
        assert(llt.info() == Eigen::Success);
        MatrixXd scaled = llt.matrixL().solve(stiffness);
        scaled = llt.matrixL().solve(scaled.transpose().eval());
        const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(symmetric(scaled));
        const MatrixXd modes = llt.matrixU().solve(eigen.eigenvectors());
        ReducedRock rock;
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
    MatrixXd flexibility_;    ///< B_r K⁻¹ B_rᵀ
    MatrixXd snapshots_;
    std::vector<Check> checks_;
};

} // namespace

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
