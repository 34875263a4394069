#include "fe2d/reduction/reduced_water.hpp"

#include "core/parallel.hpp"
#include "fe2d/harmonic/transfer.hpp"
#include "fe2d/reduction/dam_modes.hpp"
#include "fe2d/rock/reduce_rock.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <stdexcept>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double growth = 0.01; ///< σ/ω of sampled frequencies
constexpr double samples_per_cut_off = 3.0;
constexpr int least_samples = 6;
constexpr double column_share = 1000.0; ///< what the depth column may leave over what the mesh may

std::complex<double> growing(double frequency)
{
    return {growth * frequency, frequency};
}

class WaterReduction {
public:
    WaterReduction(const WaterBody& body, const MatrixXd& motions, double highest, const WaterReductionOptions& options)
        : body_(body), water_(body.water), options_(options), highest_(highest), kept_(options.kept),
          solver_(water_.mass, water_.damping, water_.stiffness, "its matrix"), wet_(face_pressures(body))
    {
        make_loads();
        make_trials(motions);
    }

    ReducedWater run()
    {
        const Stopwatch watch;
        const int count = number_of_samples();
        if (water_.options.surface == WaterSurface::sloshing) // its waves are far slower than those of pressure
            for (double slow = 0.5 * std::sqrt(water_.options.gravity / water_.reservoir.depth);
                 slow < 0.5 * highest_ / count; slow *= 2.0)
                frequencies_.push_back(slow);
        for (int k = 1; k <= count; ++k) frequencies_.push_back(highest_ * k / count);
        const Index snapshots = 2 * loads_.cols() * static_cast<Index>(frequencies_.size() + 2);
        if (snapshots > options_.largest_snapshots)
            throw std::runtime_error(fmt::format("its waves are so short that it takes {} snapshots, {} are allowed",
                                                 snapshots, options_.largest_snapshots));
        std::vector<FrequencySolver::At> sampled(frequencies_.size());
        std::ranges::transform(frequencies_, sampled.begin(), at);
        sampled.push_back({1.3 * highest_, 0.3 * highest_}); // blows are short
        sampled.push_back({2.0 * highest_, highest_});
        add_snapshots(sampled, loads_);
        choose_checks();
        int rounds = 0;
        double added = 0.0;
        for (;;) {
            project();
            ++rounds;
            const Check& worst = check();
            if (error_ <= options_.wanted || rounds == options_.largest_rounds) break;
            if (worst.frequency != added) {
                added = worst.frequency;
                add_snapshots(std::vector{at(added)}, loads_);
                add_snapshots(std::vector{at(added)}, trials_);
            }
            kept_ *= 0.3;
        }
        ReducedWater result = reduced();
        result.report = {static_cast<int>(water_.unknowns()),
                         static_cast<int>(loads_.cols()),
                         static_cast<int>(frequencies_.size()),
                         static_cast<int>(basis_.cols()),
                         rounds,
                         error_,
                         options_.wanted,
                         watch.seconds()};
        return result;
    }

private:
    struct Check {
        double frequency;
        MatrixXcd exact; ///< pressures on face and floor
    };

    /// Unknowns of the water that something pushes or feels.
    std::vector<Index> seen() const
    {
        std::vector<Index> all = wet_;
        all.insert(all.end(), water_.floor.begin(), water_.floor.end());
        return all;
    }

    /// More where waves come back from the far end: as many as the water has modes (Weyl 1911).
    int number_of_samples() const
    {
        const ReservoirMesh& r = water_.reservoir;
        const auto& nodes = r.mesh.nodes;
        const double c = water_.options.sound_speed(),
                     length = std::abs(nodes[r.far_end.front()].x - nodes[r.face.front()].x);
        double count = samples_per_cut_off * highest_ * r.depth / (std::numbers::pi * c);
        if (water_.options.far_end != FarEnd::absorbing)
            count += r.depth * length * highest_ * highest_ / (4.0 * std::numbers::pi * c * c);
        return std::max(least_samples, static_cast<int>(std::ceil(count)));
    }

    /// A distribution over boundary unknowns times Legendre polynomials of a place from 0 to 1.
    static void add_polynomials(const VectorXd& flux, const VectorXd& place, int degrees, std::vector<VectorXd>& loads)
    {
        for (int k = 0; k < degrees; ++k) {
            VectorXd load = flux;
            for (Index i = 0; i < load.size(); ++i)
                if (load[i] != 0.0) load[i] *= std::legendre(static_cast<unsigned>(k), 2.0 * place[i] - 1.0);
            loads.push_back(std::move(load));
        }
    }

    /// Where the unknowns of a chain are along it, from 0 to 1.
    VectorXd places(const NodeChain& chain) const
    {
        VectorXd place = VectorXd::Zero(water_.unknowns());
        for (std::size_t k = 0; k < chain.size(); ++k)
            if (const int unknown = water_.dofs(chain[k]); unknown != no_dof)
                place[unknown] = static_cast<double>(k) / static_cast<double>(chain.size() - 1);
        return place;
    }

    void make_loads()
    {
        std::vector<VectorXd> loads;
        const VectorXd up = places(water_.reservoir.face);
        add_polynomials(water_.force_x, up, options_.degrees, loads);
        if (water_.force_y.norm() > 1e-9 * water_.force_x.norm())
            add_polynomials(water_.force_y, up, options_.degrees, loads);
        if (!water_.floor.empty()) {
            const NodeChain& bottom = water_.reservoir.bottom;
            const double length =
                std::abs(water_.reservoir.mesh.nodes[bottom.front()].x - water_.reservoir.mesh.nodes[bottom.back()].x);
            const int waves =
                static_cast<int>(std::ceil(highest_ * length / (std::numbers::pi * water_.options.sound_speed())));
            add_polynomials(boundary_flux(water_.reservoir.mesh, water_.dofs, bottom, {0.0, 1.0}, water_.unknowns()),
                            places(bottom), options_.degrees + waves, loads);
        }
        for (const VectorXd* ground : {&water_.flux_y, &water_.end_y})
            if (ground->norm() > 0.0) loads.push_back(*ground);
        loads_.resize(water_.unknowns(), static_cast<Index>(loads.size()));
        for (Index k = 0; k < loads_.cols(); ++k) loads_.col(k) = loads[static_cast<std::size_t>(k)].normalized();
    }

    /// Mixtures of the dam's motions, pseudo-random and always the same, and the ground's.
    void make_trials(const MatrixXd& motions)
    {
        trials_ = MatrixXd::Zero(water_.unknowns(), 2 + 3);
        for (Index load = 0; load < 2; ++load)
            for (Index i = 0; i < motions.rows(); ++i) {
                const double share = std::sin(1.0 + 1.7 * static_cast<double>(i * i + 11 * load));
                for (std::size_t k = 0; k < wet_.size(); ++k)
                    trials_(wet_[k], load) += share * motions(i, static_cast<Index>(k));
            }
        trials_.rightCols(3) << water_.flux_x, water_.flux_y, water_.end_y;
    }

    /// Pressures on face and floor by the trials, those by the vertical ground motion together: -flux_y v̇ - end_y v.
    MatrixXcd felt_of(const MatrixXcd& x, std::complex<double> s) const
    {
        MatrixXcd p = on_seen(x);
        p.col(3) += p.col(4) / s;
        return p.leftCols(4);
    }

    static FrequencySolver::At at(double frequency) { return {frequency, growth * frequency}; }

    void add_snapshots(std::span<const FrequencySolver::At> frequencies, const MatrixXd& loads)
    {
        const Index n = loads.cols(), before = snapshots_.cols();
        snapshots_.conservativeResize(loads.rows(), before + 2 * n * static_cast<Index>(frequencies.size()));
        solver_.solve(frequencies, loads, [&](std::size_t at, const MatrixXcd& x) {
            const Index first = before + 2 * n * static_cast<Index>(at);
            for (Index k = 0; k < n; ++k) {
                const double energy = std::abs(x.col(k).cwiseProduct(loads.col(k)).sum()),
                             scale = energy > 0.0 ? 1.0 / std::sqrt(energy) : 0.0;
                snapshots_.col(first + 2 * k) = scale * x.col(k).real();
                snapshots_.col(first + 2 * k + 1) = scale * x.col(k).imag();
            }
        });
    }

    template <class Matrix>
    typename Matrix::PlainObject on_seen(const Matrix& x) const
    {
        const std::vector<Index> rows = seen();
        typename Matrix::PlainObject result(static_cast<Index>(rows.size()), x.cols());
        for (Index i = 0; i < result.rows(); ++i) result.row(i) = x.row(rows[static_cast<std::size_t>(i)]);
        return result;
    }

    void choose_checks()
    {
        const auto gaps = static_cast<int>(frequencies_.size());
        std::vector<FrequencySolver::At> between;
        for (int k = 0; k < options_.checks; ++k) {
            const int gap = options_.checks > 1 ? (gaps - 1) * k / (options_.checks - 1) : gaps - 1;
            const double lower = gap > 0 ? frequencies_[static_cast<std::size_t>(gap - 1)] : 0.0;
            between.push_back(at(0.5 * (lower + frequencies_[static_cast<std::size_t>(gap)])));
        }
        checks_.resize(between.size());
        solver_.solve(between, trials_, [&](std::size_t k, const MatrixXcd& exact) {
            checks_[k] = {between[k].frequency, felt_of(exact, growing(between[k].frequency))};
        });
    }

    void project()
    {
        const Index n = water_.unknowns(), mesh = water_.mesh_unknowns;
        const double middle = 0.5 * highest_;
        const SparseMatrix norm = water_.stiffness + middle * middle * water_.mass;
        basis_ = MatrixXd::Zero(n, snapshots_.cols());
        basis_.topRows(mesh) = snapshots_.topRows(mesh);
        basis_ = (basis_ * leading_directions(projected(norm, basis_), kept_)).eval();
        if (water_.layer_pressures > 0) add_layers(norm);
        mass_ = projected(water_.mass, basis_);
        damping_ = projected(water_.damping, basis_);
        stiffness_ = projected(water_.stiffness, basis_);
    }

    /// The channel beyond an absorbing end is passive as a whole only, as one built of some depth column. So the column is reduced: the
    /// same few shapes W over the depth for all layers and for the trace of the mesh's shapes on the end. Its momenta are ΔW over the
    /// heights of the elements, since the layer's own are β/(sρh) Δq.
    void add_layers(const SparseMatrix& norm)
    {
        const ReservoirMesh& r = water_.reservoir;
        std::vector<Index> end; // unknowns of the column
        std::vector<int> place; // of a node among them; -1: p = 0
        for (const int node : r.far_end) {
            const int unknown = water_.dofs(node);
            place.push_back(unknown == no_dof ? -1 : static_cast<int>(end.size()));
            if (unknown != no_dof) end.push_back(unknown);
        }
        const auto count = static_cast<Index>(end.size()), elements = static_cast<Index>(place.size()) - 1,
                   layers = water_.layer_pressures / count, with_momenta = water_.layer_momenta / elements;
        MatrixXd of_end(count, count);
        for (Index i = 0; i < count; ++i)
            for (Index j = 0; j < count; ++j)
                of_end(i, j) = norm.coeff(end[static_cast<std::size_t>(i)], end[static_cast<std::size_t>(j)]);
        MatrixXd columns(count, snapshots_.cols() * (layers + 1));
        columns.leftCols(snapshots_.cols()) = snapshots_(end, Eigen::all);
        for (Index layer = 0; layer < layers; ++layer)
            columns.middleCols((layer + 1) * snapshots_.cols(), snapshots_.cols()) =
                snapshots_.middleRows(water_.mesh_unknowns + layer * count, count);
        const MatrixXd shapes = column_shapes(of_end, columns); // W

        MatrixXd differences = MatrixXd::Zero(elements, shapes.cols());
        for (Index e = 0; e < elements; ++e) {
            const auto k = static_cast<std::size_t>(e);
            if (place[k] >= 0) differences.row(e) += shapes.row(place[k]);
            if (place[k + 1] >= 0) differences.row(e) -= shapes.row(place[k + 1]);
            differences.row(e) /= r.mesh.nodes[r.far_end[k]].y - r.mesh.nodes[r.far_end[k + 1]].y;
        }
        Eigen::ColPivHouseholderQR<MatrixXd> qr(differences);
        qr.setThreshold(1e-10);
        const MatrixXd momenta = qr.householderQ() * MatrixXd::Identity(elements, qr.rank());

        const Index of_mesh = basis_.cols();
        basis_(end, Eigen::all) = (shapes * (shapes.transpose() * (of_end * basis_(end, Eigen::all)))).eval();
        layers_ = layers * shapes.cols() + with_momenta * momenta.cols();
        basis_.conservativeResizeLike(MatrixXd::Zero(basis_.rows(), of_mesh + layers_));
        Index row = water_.mesh_unknowns, column = of_mesh;
        const auto put = [&](const MatrixXd& part) {
            basis_.block(row, column, part.rows(), part.cols()) = part;
            row += part.rows();
            column += part.cols();
        };
        for (Index layer = 0; layer < layers; ++layer) put(shapes);
        for (Index layer = 0; layer < with_momenta; ++layer) put(momenta);
    }

    /// Shapes over the depth, orthonormal in the norm of the end. They may leave more than those of the mesh: from 1e-4 to a tenth of a
    /// snapshot changes slips of 20 to 200 mm by 1e-4 mm, and saves a third of the layers.
    MatrixXd column_shapes(const MatrixXd& norm, const MatrixXd& columns) const
    {
        const Eigen::LLT<MatrixXd> llt(norm);
        const MatrixXd scaled = llt.matrixU() * columns;
        const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled * scaled.transpose());
        VectorXd left = scaled.colwise().squaredNorm();
        Index count = 0;
        for (; count < norm.rows() && left.maxCoeff() > column_share * kept_; ++count)
            left -= (eigen.eigenvectors().col(norm.rows() - 1 - count).transpose() * scaled).cwiseAbs2().transpose();
        return llt.matrixU().solve(eigen.eigenvectors().rightCols(count));
    }

    /// @returns the worst; error_ is its error
    const Check& check()
    {
        const Check* worst = &checks_.front();
        error_ = 0.0;
        const MatrixXd loads = basis_.transpose() * trials_;
        for (const Check& c : checks_) {
            const std::complex<double> s = growing(c.frequency);
            const MatrixXcd matrix = stiffness_ + s * damping_ + (s * s) * mass_,
                            p = felt_of(basis_ * matrix.partialPivLu().solve(loads.cast<std::complex<double>>()), s);
            for (Index load = 0; load < p.cols(); ++load) {
                const double size = c.exact.col(load).norm(),
                             error = size > 0.0 ? (p.col(load) - c.exact.col(load)).norm() / size : 0.0;
                if (error <= error_) continue;
                error_ = error;
                worst = &c;
            }
        }
        return *worst;
    }

    ReducedWater reduced() const
    {
        const double s = body_.scale, s2 = s * s;
        ReducedWater result;
        result.mass = -s2 * mass_;
        result.damping = -s2 * damping_;
        result.stiffness = -s2 * stiffness_;
        result.velocity_x = s * (basis_.transpose() * water_.flux_x);
        result.velocity_y = s * (basis_.transpose() * water_.flux_y);
        result.displacement_y = s * (basis_.transpose() * water_.end_y);
        const MatrixXd felt = s * on_seen(basis_);
        result.face = felt.topRows(static_cast<Index>(wet_.size()));
        result.floor = felt.bottomRows(static_cast<Index>(water_.floor.size()));
        result.layers = layers_;
        return result;
    }

    const WaterBody& body_;
    const FluidModel& water_;
    WaterReductionOptions options_;
    double highest_, kept_, error_ = 0.0;
    FrequencySolver solver_;
    std::vector<Index> wet_;
    MatrixXd loads_, trials_; ///< on all unknowns of the water
    std::vector<double> frequencies_;
    MatrixXd snapshots_, basis_, mass_, damping_, stiffness_;
    Index layers_ = 0;
    std::vector<Check> checks_;
};

} // namespace

Note ReducedWater::missed_gate() const
{
    return {NoteKind::water_gate_missed, {100.0 * report.error, 100.0 * report.wanted}};
}

ReducedWater reduce_water(const WaterBody& water, const MatrixXd& motions, double highest,
                          const WaterReductionOptions& options)
{
    return WaterReduction(water, motions, highest, options).run();
}

} // namespace damslip::fe2d
