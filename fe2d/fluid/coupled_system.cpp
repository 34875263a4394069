#include "fe2d/fluid/coupled_system.hpp"

#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/solver/dense_product.hpp"

#include <Spectra/MatOp/SparseCholesky.h>
#include <Spectra/SymGEigsSolver.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void place(const SparseMatrix& matrix, Index row, Index column, double factor, Triplets& entries)
{
    for (Index j = 0; j < matrix.outerSize(); ++j)
        for (SparseMatrix::InnerIterator entry(matrix, j); entry; ++entry)
            entries.emplace_back(row + entry.row(), column + entry.col(), factor * entry.value());
}

SparseMatrix block_diagonal(const SparseMatrix& first, const SparseMatrix& second, double factor, Triplets entries = {})
{
    place(first, 0, 0, 1.0, entries);
    place(second, first.rows(), first.rows(), factor, entries);
    SparseMatrix matrix(first.rows() + second.rows(), first.rows() + second.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

Eigen::VectorXd water_rows(Index structure, const Eigen::VectorXd& values, double factor)
{
    Eigen::VectorXd all = Eigen::VectorXd::Zero(structure + values.size());
    all.tail(values.size()) = factor * values;
    return all;
}

/// Neighbours above each other in the mesh; what is left over, then the unknowns of the far end in their order.
std::vector<std::array<Index, 2>> pairs_of(const FluidModel& water, Index first)
{
    std::vector<std::array<Index, 2>> pairs;
    const auto columns = static_cast<int>(water.reservoir.surface.size()),
               rows = static_cast<int>(water.reservoir.face.size());
    for (int column = 0; column < columns; ++column) {
        std::vector<Index> unknowns;
        for (int row = 0; row < rows; ++row)
            if (const int unknown = water.dofs(row * columns + column); unknown != no_dof)
                unknowns.push_back(first + unknown);
        for (std::size_t k = 0; k < unknowns.size(); k += 2)
            pairs.push_back({unknowns[k], k + 1 < unknowns.size() ? unknowns[k + 1] : -1});
    }
    for (Index k = water.mesh_unknowns; k < water.unknowns(); k += 2)
        pairs.push_back({first + k, k + 1 < water.unknowns() ? first + k + 1 : -1});
    return pairs;
}

} // namespace

CoupledSystem couple(const SparseMatrix& mass, const SparseMatrix& damping, const SparseMatrix& stiffness,
                     const SparseMatrix& coupling, const FluidModel& water)
{
    const Index n = mass.rows();
    assert(coupling.rows() == n && coupling.cols() == water.unknowns());
    CoupledSystem system;
    system.structure_unknowns = n;
    system.water_unknowns = water.unknowns();
    system.scale = water.options.density * water.options.sound_speed();
    const double s = system.scale, s2 = s * s;
    system.mass = block_diagonal(mass, water.mass, -s2);
    system.stiffness = block_diagonal(stiffness, water.stiffness, -s2);
    Triplets across;
    place(coupling, 0, n, -s, across);
    place(coupling.transpose(), n, 0, -s, across);
    system.damping = block_diagonal(damping, water.damping, -s2, std::move(across));
    system.velocity_x = water_rows(n, water.flux_x, s);
    system.velocity_y = water_rows(n, water.flux_y, s);
    system.displacement_y = water_rows(n, water.end_y, s);
    system.water_pairs = pairs_of(water, n);
    return system;
}

std::vector<Index> unknowns_of_floor(const CoupledSystem& system, const FluidModel& water)
{
    std::vector<Index> unknowns = water.floor;
    for (Index& unknown : unknowns) unknown += system.structure_unknowns;
    return unknowns;
}

using Eigen::VectorXd;

namespace {

constexpr double smallest_dam_share = 1e-3;
constexpr Index most_modes = 400;

using ConstMap = Eigen::Map<const VectorXd>;
using Map = Eigen::Map<VectorXd>;

/// z -> B z.
class Inertia {
public:
    using Scalar = double;
    /// @param water  L factorised
    Inertia(const CoupledPencil& pencil, const LinearSolver& water) : p_(pencil), water_(water) {}
    Index rows() const { return p_.stiffness.rows() + p_.water_mass.rows(); }
    Index cols() const { return rows(); }
    void perform_op(const double* in, double* out) const
    {
        const Index n = p_.stiffness.rows(), m = p_.water_mass.rows();
        const ConstMap u(in, n), q(in + n, m);
        const VectorXd potential = water_.solve(VectorXd(p_.coupling.transpose() * u + p_.water_mass * q));
        Map(out, n) = p_.mass * u + p_.coupling * potential;
        Map(out + n, m) = p_.water_mass * potential;
    }

private:
    const CoupledPencil& p_;
    const LinearSolver& water_;
};

using Cholesky = Spectra::SparseCholesky<double>;

/// diag(K, Q).
SparseMatrix stiffness_of(const CoupledPencil& p)
{
    const Index n = p.stiffness.rows(), m = p.water_mass.rows();
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(p.stiffness.nonZeros() + p.water_mass.nonZeros()));
    for (const auto& [matrix, first] : {std::pair(&p.stiffness, Index{0}), std::pair(&p.water_mass, n)})
        for (Index j = 0; j < matrix->outerSize(); ++j)
            for (SparseMatrix::InnerIterator it(*matrix, j); it; ++it)
                entries.emplace_back(first + it.row(), first + j, it.value());
    SparseMatrix stiffness(n + m, n + m);
    stiffness.setFromTriplets(entries.begin(), entries.end());
    return stiffness;
}

struct Pairs {
    VectorXd values; ///< 1/ω², largest first
    Eigen::MatrixXd vectors;
    bool converged = true;
};

Pairs all_pairs(const Inertia& inertia, const SparseMatrix& stiffness)
{
    const Index n = inertia.rows();
    Eigen::MatrixXd a(n, n);
    for (Index j = 0; j < n; ++j) inertia.perform_op(VectorXd::Unit(n, j).eval().data(), a.col(j).data());
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (a + a.transpose()), Eigen::MatrixXd(stiffness));
    return {solver.eigenvalues().reverse(), solver.eigenvectors().rowwise().reverse()};
}

/// In the basis of L, diag(K, Q) = L Lᵀ, where inner products need no matrix.
Pairs largest_pairs(Inertia& inertia, const SparseMatrix& stiffness, int count)
{
    const int n = static_cast<int>(inertia.rows()), space = std::max(2 * count + 1, 20);
    if (space >= n) return all_pairs(inertia, stiffness);
    VectorXd start(n); // without symmetry and the same every time
    std::uint32_t state = 20150101u;
    for (double& x : start) {
        state = 1664525u * state + 1013904223u;
        x = static_cast<double>(state) / 2147483648.0 - 1.0;
    }
    Cholesky factor(stiffness);
    if (factor.info() != Spectra::CompInfo::Successful) return {{}, {}, false};
    VectorXd solved(n);
    factor.lower_triangular_solve(start.data(), solved.data()); // energies of both parts of one size
    Spectra::SymGEigsSolver<Inertia, Cholesky, Spectra::GEigsMode::Cholesky> solver(inertia, factor, count, space);
    solver.init(solved.data());
    solver.compute(Spectra::SortRule::LargestAlge, 1000, 1e-12);
    return {solver.eigenvalues(), solver.eigenvectors(), solver.info() == Spectra::CompInfo::Successful};
}

void fill(CoupledModes& modes, const CoupledPencil& p, const Pairs& pairs, Index count)
{
    const Index n = p.stiffness.rows(), m = p.water_mass.rows();
    modes.frequency.resize(count);
    modes.displacement.resize(n, count);
    modes.pressure.resize(m, count);
    modes.water_share.resize(count);
    modes.effective_mass.resize(2, count);
    modes.dam_share.resize(count);
    for (Index k = 0; k < count; ++k) {
        const double w2 = 1.0 / pairs.values[k];
        VectorXd u = pairs.vectors.col(k).head(n), q = pairs.vectors.col(k).tail(m);
        const double water = q.dot(p.water_mass * q), energy = u.dot(p.stiffness * u) + water;
        // zᵀ B z = zᵀ diag(K, Q) z / ω²
        const double norm = std::sqrt(w2 / energy);
        Index largest = 0;
        u.cwiseAbs().maxCoeff(&largest);
        const double factor = n > 0 && u[largest] < 0.0 ? -norm : norm;
        u *= factor;
        q *= factor;
        modes.frequency[k] = std::sqrt(w2) / (2.0 * std::numbers::pi);
        modes.displacement.col(k) = u;
        modes.pressure.col(k) = q;
        modes.water_share[k] = water / energy;
        const double dam = u.dot(p.inertia_x), participation = dam + q.dot(p.flux_x) / w2;
        modes.effective_mass(0, k) = participation * participation;
        modes.dam_share[k] = dam * participation / modes.total_mass.x();
        modes.effective_mass(1, k) = std::pow(u.dot(p.inertia_y) + q.dot(p.flux_y) / w2, 2);
    }
}

} // namespace

CoupledModes coupled_modes(const CoupledPencil& pencil, int count)
{
    CoupledModes modes;
    LinearSolver water;
    modes.solver = water.factorise(pencil.water_stiffness);
    if (!modes.solver.ok()) {
        modes.status = CoupledModesStatus::solver_failed;
        return modes;
    }
    modes.total_mass = pencil.structure_mass;
    modes.total_mass.x() += pencil.flux_x.dot(water.solve(pencil.flux_x));
    modes.total_mass.y() += pencil.flux_y.dot(water.solve(pencil.flux_y));
    Inertia inertia(pencil, water);
    const Pairs pairs = largest_pairs(inertia, stiffness_of(pencil), count);
    const Index found = std::min<Index>(count, pairs.values.size());
    if (!pairs.converged && found == 0) modes.solver = LinearSolver().factorise(pencil.stiffness); // it may say why
    if (!pairs.converged || found < std::min<Index>(count, inertia.rows()))
        modes.status = CoupledModesStatus::not_converged;
    fill(modes, pencil, pairs, found);
    modes.effective_share = modes.total_mass.cwiseInverse().asDiagonal() * modes.effective_mass;
    return modes;
}

namespace {

void keep(CoupledModes& modes, Index count)
{
    modes.frequency.conservativeResize(count);
    modes.displacement.conservativeResize(Eigen::NoChange, count);
    modes.pressure.conservativeResize(Eigen::NoChange, count);
    modes.water_share.conservativeResize(count);
    modes.dam_share.conservativeResize(count);
    modes.effective_mass.conservativeResize(Eigen::NoChange, count);
    modes.effective_share.conservativeResize(Eigen::NoChange, count);
}

} // namespace

CoupledModes coupled_modes_up_to(const CoupledPencil& pencil, double frequency, int leading)
{
    const auto limit =
        static_cast<int>(std::min<Index>(pencil.stiffness.rows() + pencil.water_mass.rows(), most_modes));
    // where only leading modes are asked for, half of the lowest are: twice as many are likely to hold them
    for (int count = std::min(frequency > 0.0 ? 24 : 2 * leading + 2, limit);; count = std::min(2 * count, limit)) {
        CoupledModes modes = coupled_modes(pencil, count);
        const Index found = modes.frequency.size();
        const std::vector<Index> chosen = leading_modes(modes, leading);
        const bool enough =
            static_cast<int>(chosen.size()) == leading && found > 0 && modes.frequency[found - 1] > frequency;
        if (modes.status != CoupledModesStatus::ok || count == limit || enough) {
            const Index below =
                std::count_if(modes.frequency.begin(), modes.frequency.end(), [=](double f) { return f <= frequency; });
            keep(modes, std::max(below, chosen.empty() ? 0 : chosen.back() + 1));
            return modes;
        }
    }
}

std::vector<Index> leading_modes(const CoupledModes& modes, int count)
{
    std::vector<Index> leading;
    for (Index k = 0; k < modes.frequency.size() && static_cast<int>(leading.size()) < count; ++k)
        if (modes.dam_share[k] >= smallest_dam_share) leading.push_back(k);
    return leading;
}

namespace {

/// One matrix of the depth column by its entries (i, j, value), i and j counted over the column's nodes.
struct ColumnMatrices {
    Triplets flow;      ///< M₁ = ∫NN/ρ dy
    Triplets mass;      ///< Q_y
    Triplets damping;   ///< A_y
    Triplets stiffness; ///< L_y
};

ColumnMatrices column_matrices(const EndColumn& column, const FluidOptions& water)
{
    ColumnMatrices m;
    for (std::size_t e = 0; e + 1 < column.y.size(); ++e) {
        const double h = column.y[e] - column.y[e + 1];
        for (const std::size_t i : {e, e + 1})
            for (const std::size_t j : {e, e + 1}) {
                const double product = h * (i == j ? 1.0 / 3.0 : 1.0 / 6.0);
                m.flow.emplace_back(i, j, product / water.density);
                m.mass.emplace_back(i, j, product / water.bulk_modulus);
                m.stiffness.emplace_back(i, j, (i == j ? 1.0 : -1.0) / (h * water.density));
            }
    }
    const auto bottom = static_cast<Index>(column.y.size()) - 1;
    if (column.bottom_admittance != 0.0) m.damping.emplace_back(bottom, bottom, column.bottom_admittance);
    if (column.surface_mass != 0.0) m.mass.emplace_back(0, 0, column.surface_mass);
    return m;
}

/// Builds the layers one behind the other.
class Layers {
public:
    Layers(const EndColumn& column, const FluidOptions& water, Index first)
        : column_(column), water_(water), matrices_(column_matrices(column, water)), near_(column.place), next_(first)
    {
    }

    /// A layer of real length.
    void add_decay(double length)
    {
        step();
        differences(matrices_.flow, 1.0 / length, end_.entries.stiffness);
        sums(matrices_.mass, 0.25 * length, end_.entries.mass);
        sums(matrices_.damping, 0.25 * length, end_.entries.damping);
        sums(matrices_.stiffness, 0.25 * length, end_.entries.stiffness);
        load(0.5 * length, end_.acceleration_load);
    }

    /// A layer of the length 2c/(s cos θ); its momenta come later, all together.
    void add_cosine(double cosine)
    {
        const double beta = water_.sound_speed() / (2.0 * cosine);
        step();
        differences(matrices_.flow, 0.25 / beta, end_.entries.damping);
        sums(matrices_.mass, beta, end_.entries.damping);
        sums(matrices_.damping, beta, end_.entries.stiffness);
        load(2.0 * beta, end_.velocity_load);
        momenta_.push_back({beta, near_, far_});
    }

    AbsorbingEnd finish()
    {
        for (const Momentum& layer : momenta_) add_momenta(layer);
        return std::move(end_);
    }

private:
    struct Momentum {
        double beta;
        std::vector<Index> near, far;
    };

    /// New unknowns behind the last layer; those at p = 0 stay so.
    void step()
    {
        if (!far_.empty()) near_ = far_;
        far_ = near_;
        for (Index& unknown : far_)
            if (unknown >= 0) {
                unknown = next_++;
                ++end_.pressures;
            }
    }

    static void put(Triplets& entries, Index row, Index column, double value)
    {
        if (row >= 0 && column >= 0) entries.emplace_back(row, column, value);
    }

    void pairs(const Triplets& matrix, double factor, double mixed, Triplets& entries) const
    {
        for (const auto& entry : matrix)
            for (const auto* side : {&near_, &far_})
                for (const auto* other : {&near_, &far_})
                    put(entries, (*side)[static_cast<std::size_t>(entry.row())],
                        (*other)[static_cast<std::size_t>(entry.col())],
                        factor * (side == other ? 1.0 : mixed) * entry.value());
    }
    void sums(const Triplets& matrix, double factor, Triplets& entries) const { pairs(matrix, factor, 1.0, entries); }
    void differences(const Triplets& matrix, double factor, Triplets& entries) const
    {
        pairs(matrix, factor, -1.0, entries);
    }

    void load(double factor, Triplets& entries) const
    {
        if (column_.bottom_load == 0.0) return;
        put(entries, near_.back(), 0, factor * column_.bottom_load);
        put(entries, far_.back(), 0, factor * column_.bottom_load);
    }

    void add_momenta(const Momentum& layer)
    {
        for (std::size_t e = 0; e + 1 < column_.y.size(); ++e) {
            const double h = column_.y[e] - column_.y[e + 1];
            const Index w = next_++;
            ++end_.momenta;
            end_.entries.damping.emplace_back(w, w, -water_.density * h / layer.beta);
            for (const auto* side : {&layer.near, &layer.far})
                for (const auto& [node, sign] : {std::pair{e, 1.0}, std::pair{e + 1, -1.0}}) {
                    put(end_.entries.stiffness, w, (*side)[node], sign);
                    put(end_.entries.stiffness, (*side)[node], w, sign);
                }
        }
    }

    const EndColumn& column_;
    const FluidOptions& water_;
    ColumnMatrices matrices_;
    std::vector<Index> near_, far_;
    Index next_;
    std::vector<Momentum> momenta_;
    AbsorbingEnd end_;
};

} // namespace

AbsorbingEnd absorbing_end(const EndColumn& column, const FluidOptions& water, Index first)
{
    assert(column.y.size() > 1 && column.y.size() == column.place.size());
    const double depth = column.y.front() - column.y.back();
    Layers layers(column, water, first);
    for (const double decay : water.layers.decays) layers.add_decay(2.0 * depth / decay);
    for (const double cosine : water.layers.cosines) layers.add_cosine(cosine);
    return layers.finish();
}

namespace {

/// Entries of a matrix of the coupled system at their new places.
SparseMatrix moved(const SparseMatrix& matrix, const std::vector<Index>& to, Index size, Triplets entries = {})
{
    for (Index column = 0; column < matrix.outerSize(); ++column)
        for (SparseMatrix::InnerIterator it(matrix, column); it; ++it)
            entries.emplace_back(to[static_cast<std::size_t>(it.row())], to[static_cast<std::size_t>(column)],
                                 it.value());
    SparseMatrix result(size, size);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

VectorXd moved(const VectorXd& vector, const std::vector<Index>& to, Index size)
{
    VectorXd result = VectorXd::Zero(size);
    for (Index i = 0; i < vector.size(); ++i) result[to[static_cast<std::size_t>(i)]] = vector[i];
    return result;
}

} // namespace

WaterBody::WaterBody(const Scene& scene, const Model& model, WaterBeside beside)
    : water(build_fluid(scene)),
      dam_unknowns(2 * (beside == WaterBeside::dam ? model.mesh.dam_node_count : model.mesh.node_count()))
{
    assert(model.added_mass.nonZeros() == 0);
    const Index n = dam_unknowns;
    const Index dam = 2 * model.mesh.dam_node_count;
    coupling = face_coupling(model.mesh, model.dofs, water.reservoir, water.dofs, water.unknowns()).topRows(dam);
    coupling.conservativeResize(n, coupling.cols());
    const SparseMatrix none(n, n);
    const CoupledSystem system = couple(none, none, none, coupling, water);
    scale = system.scale;
    size = n + 2 * static_cast<Index>(system.water_pairs.size());

    std::vector<Index> to(static_cast<std::size_t>(system.size()));
    for (Index i = 0; i < n; ++i) to[static_cast<std::size_t>(i)] = i;
    Triplets alone; // stiffness of unknowns without a partner: any negative number
    const double unit = system.stiffness.diagonal().minCoeff();
    for (std::size_t pair = 0; pair < system.water_pairs.size(); ++pair)
        for (const std::size_t c : {0, 1}) {
            const Index here = n + static_cast<Index>(2 * pair + c), unknown = system.water_pairs[pair][c];
            if (unknown < 0)
                alone.emplace_back(here, here, unit);
            else
                to[static_cast<std::size_t>(unknown)] = here;
        }
    place.assign(to.begin() + n, to.end());
    mass = moved(system.mass, to, size);
    damping = moved(system.damping, to, size);
    stiffness = moved(system.stiffness, to, size, alone);
    velocity_x = moved(system.velocity_x, to, size);
    velocity_y = moved(system.velocity_y, to, size);
    displacement_y = moved(system.displacement_y, to, size);
}

} // namespace damslip::fe2d
