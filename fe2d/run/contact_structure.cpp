#include "fe2d/run/contact_structure.hpp"

#include "fe2d/solver/dense_product.hpp"
#include "fe2d/time/structure_system.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// A matrix of the dam in the corner of a larger one, and another one added.
SparseMatrix corner_and(const SparseMatrix& dam, const SparseMatrix& water)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (Index column = 0; column < dam.outerSize(); ++column)
        for (SparseMatrix::InnerIterator it(dam, column); it; ++it) entries.emplace_back(it.row(), column, it.value());
    SparseMatrix corner(water.rows(), water.cols());
    corner.setFromTriplets(entries.begin(), entries.end());
    return corner + water;
}

/// Water's unknowns stand alone with a number of the dam's size: at rest it takes no part.
SparseMatrix at_rest(const SparseMatrix& dam, Index size)
{
    SparseMatrix alone(size, size);
    const double unit = dam.diagonal().mean();
    for (Index i = dam.rows(); i < size; ++i) alone.insert(i, i) = unit;
    return corner_and(dam, alone);
}

/// A matrix on the unknowns of a model on two unknowns for every node; the fixed ones stand alone with a number.
SparseMatrix by_node(const Model& model, const SparseMatrix& matrix, double alone)
{
    std::vector<Index> place(static_cast<std::size_t>(model.dofs.count));
    std::vector<Eigen::Triplet<double>> entries;
    const auto size = static_cast<Index>(model.dofs.dofs.size());
    for (Index i = 0; i < size; ++i)
        if (const int dof = model.dofs.dofs[static_cast<std::size_t>(i)]; dof != no_dof)
            place[static_cast<std::size_t>(dof)] = i;
        else if (alone != 0.0)
            entries.emplace_back(i, i, alone);
    for (Index column = 0; column < matrix.outerSize(); ++column)
        for (SparseMatrix::InnerIterator it(matrix, column); it; ++it)
            entries.emplace_back(place[static_cast<std::size_t>(it.row())], place[static_cast<std::size_t>(column)],
                                 it.value());
    SparseMatrix result(size, size);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

} // namespace

ContactStructure::ContactStructure(const Model& model, JointPath range, const WaterBody* water, RockBody rock)
    : model_(model), water_(water), planes_(model.mesh, rock == RockBody::moving ? BelowBase::block : BelowBase::apart),
      rock_moves_(rock == RockBody::moving)
{
    const Mesh& mesh = model.mesh;
    const Index dam = dam_dof_count(mesh, model.dofs), solid = rock_moves_ ? 2 * mesh.node_count() : dam;
    assert(dam == 2 * mesh.dam_node_count && "the dam must be free: Base::separate");
    const auto part = [&](const SparseMatrix& matrix, double alone) {
        return rock_moves_ ? by_node(model, matrix, alone) : SparseMatrix(matrix.topLeftCorner(dam, dam));
    };
    const auto part_of = [&](const VectorXd& vector) {
        return rock_moves_ ? nodal_values(model.dofs, vector) : VectorXd(vector.head(dam));
    };
    const SparseMatrix stiffness = part(model.stiffness, model.stiffness.diagonal().mean()),
                       mass = part(model.moving_mass(), 0.0), edges = part(model.edge_damping, 0.0);
    size_ = water_ ? water_->size : solid;
    if (water_) {
        const SparseMatrix all = corner_and(stiffness, water_->stiffness) + water_->damping + water_->mass;
        order_water(tied(all, planes_.ties()));
        stiffness_ = order_.to_new(corner_and(stiffness, water_->stiffness));
        mass_ = order_.to_new(corner_and(mass, water_->mass));
        edge_damping_ = order_.to_new(corner_and(edges, SparseMatrix(size_, size_)));
        gyration_ = order_.to_new(water_->damping) + edge_damping_;
        velocity_x_ = order_.to_new(water_->velocity_x);
        velocity_y_ = order_.to_new(water_->velocity_y);
        displacement_y_ = order_.to_new(water_->displacement_y);
        for (Index node = solid / 2; node < order_.nodes(); ++node)
            water_nodes_.push_back(order_.new_node[static_cast<std::size_t>(node)]);
    } else {
        order_ = interface_last(tied(stiffness, planes_.ties()), planes_.nodes());
        stiffness_ = order_.to_new(stiffness);
        mass_ = order_.to_new(mass);
        gyration_ = edge_damping_ = order_.to_new(edges);
    }
    find_ties();
    for (Index node = dam / 2; node < solid / 2; ++node)
        rock_nodes_.push_back(order_.new_node[static_cast<std::size_t>(node)]);
    find_anchors();
    if (model.added_mass.nonZeros() > 0)
        added_mass_ =
            order_
                .to_new(corner_and(SparseMatrix(model.added_mass.topLeftCorner(dam, dam)), SparseMatrix(size_, size_)))
                .pruned();
    of_added_mass_ = FewRows(added_mass_);
    inertia_x_ = order_.to_new(extended(part_of(model.inertia_x)));
    inertia_y_ = order_.to_new(extended(part_of(model.inertia_y)));
    VectorXd unit_x = VectorXd::Zero(mass_.rows()), unit_y = unit_x;
    for (Index k = 0; k < unit_x.size(); k += 2) unit_x[k] = unit_y[k + 1] = 1.0;
    const SparseMatrix own_mass = dam_mass();
    dam_inertia_x_ = own_mass * unit_x;
    dam_inertia_y_ = own_mass * unit_y;
    regular_ = true;
    if (rock_moves_) return; // the static stages are another structure's
    static_factor_.emplace(water_ ? order_.to_new(at_rest(stiffness, water_->size)) : stiffness_, order_.inner, 0, 0,
                           ties_);
    if (mesh.has_rock()) {
        const ContactPlane& contact = mesh.contact;
        slides_far_ = range == JointPath::finite;
        if (slides_far_)
            pairing_.emplace(contact.distance, contact.rock_distance);
        else if (!contact.matching)
            pairing_.emplace(contact.distance, contact.rock_node_distance);
        condense_rock(slides_far_ ? contact.rock_line : contact.rock_nodes);
    }
    regular_ = static_factor_->regular() && (!has_rock() || (rock_factor_->regular() && rock_flexibility_.size() > 0));
}

/// Nodes of the water's floor behind all others inside, where it is the rock's.
void ContactStructure::order_water(const SparseMatrix& pattern)
{
    std::vector<int> last;
    for (const Index unknown : water_->water.floor) {
        floor_.push_back(water_->place[static_cast<std::size_t>(unknown)]);
        const int node = static_cast<int>(floor_.back() / 2);
        if (std::find(last.begin(), last.end(), node) == last.end()) last.push_back(node);
    }
    floor_nodes_ = static_cast<int>(last.size());
    last.insert(last.end(), planes_.nodes().begin(), planes_.nodes().end());
    order_ = interface_last(pattern, last);
    order_.inner += floor_nodes_;
    for (Index& unknown : floor_) unknown = 2 * order_.new_node[static_cast<std::size_t>(unknown / 2)] + unknown % 2;
}

/// In the structure's order, and the gaps of any displacement.
void ContactStructure::find_ties()
{
    std::vector<Eigen::Triplet<double>> entries;
    const Index first = inner_unknowns();
    const ContactPlanes::Matrix& of_jumps = planes_.gaps();
    std::vector<int> below(static_cast<std::size_t>(interface()), -1);
    for (const Tie& tie : planes_.ties()) {
        ties_.push_back({order_.new_node[tie.upper], order_.new_node[tie.lower]});
        below[static_cast<std::size_t>(ties_.back().upper - order_.inner)] = ties_.back().lower;
    }
    for (Index row = 0; row < of_jumps.rows(); ++row)
        for (ContactPlanes::Matrix::InnerIterator it(of_jumps, row); it; ++it) {
            entries.emplace_back(row, first + it.col(), it.value());
            if (const int lower = below[static_cast<std::size_t>(it.col() / 2)]; lower >= 0)
                entries.emplace_back(row, 2 * lower + it.col() % 2, -it.value());
        }
    gaps_.resize(of_jumps.rows(), dam_unknowns());
    gaps_.setFromTriplets(entries.begin(), entries.end());
}

/// Upper blocks take theirs from the lower ones.
void ContactStructure::find_anchors()
{
    const Mesh& mesh = model_.mesh;
    anchor_.assign(static_cast<std::size_t>(order_.nodes()), 2 * order_.new_node[mesh.contact.dam_nodes.front()]);
    for (Index k = 1; k < planes_.count(); ++k)
        for (std::size_t node = 0; node < planes_.above(k).size(); ++node)
            if (planes_.above(k)[node])
                anchor_[static_cast<std::size_t>(order_.new_node[node])] =
                    2 * order_.new_node[mesh.lifts[static_cast<std::size_t>(k - 1)].upper_nodes.front()];
}

void ContactStructure::condense_rock(const std::vector<int>& contact_nodes)
{
    // Two unknowns for every rock node; the fixed ones stand alone with a 1 of the size of the others.
    const Mesh& mesh = model_.mesh;
    const int first = mesh.dam_node_count, nodes = mesh.node_count() - first;
    std::vector<int> unknown_of(model_.dofs.count, -1);
    const double unit = model_.stiffness.diagonal().tail(model_.dofs.count - 2 * first).mean();
    std::vector<Eigen::Triplet<double>> entries;
    for (int node = 0; node < nodes; ++node)
        for (const int c : {0, 1}) {
            const int dof = model_.dofs(first + node, c);
            if (dof == no_dof)
                entries.emplace_back(2 * node + c, 2 * node + c, unit);
            else
                unknown_of[dof] = 2 * node + c;
        }
    for (int column = 2 * first; column < model_.stiffness.outerSize(); ++column)
        for (SparseMatrix::InnerIterator it(model_.stiffness, column); it; ++it)
            entries.emplace_back(unknown_of[it.row()], unknown_of[column], it.value());
    SparseMatrix rock(2 * nodes, 2 * nodes);
    rock.setFromTriplets(entries.begin(), entries.end());
    std::vector<int> interface;
    for (const int node : contact_nodes) interface.push_back(node - first);
    rock_count_ = static_cast<Index>(interface.size());
    rock_order_ = interface_last(rock, interface);
    rock_factor_.emplace(rock_order_.to_new(rock), rock_order_.inner);
    if (!rock_factor_->regular()) return;
    rock_stiffness_ = plane().to_plane(rock_factor_->schur());
    const Eigen::LLT<Eigen::MatrixXd> llt(rock_stiffness_);
    if (llt.info() != Eigen::Success) return;
    rock_flexibility_ = llt.solve(Eigen::MatrixXd::Identity(rock_stiffness_.rows(), rock_stiffness_.cols()));
}

std::size_t ContactStructure::rock_bytes() const
{
    if (!has_rock()) return 0;
    return rock_factor_->bytes() +
           sizeof(double) * static_cast<std::size_t>(rock_stiffness_.size() + rock_flexibility_.size());
}

namespace {

/// Loads of the rock's nodes, two components each, the fixed ones zero.
VectorXd loads_by_node(const Model& model, const VectorXd& load)
{
    const int first = model.mesh.dam_node_count, nodes = model.mesh.node_count() - first;
    VectorXd all = VectorXd::Zero(2 * nodes);
    for (int node = 0; node < nodes; ++node)
        for (const int c : {0, 1})
            if (const int dof = model.dofs(first + node, c); dof != no_dof) all[2 * node + c] = load[dof];
    return all;
}

} // namespace

VectorXd ContactStructure::to_order(const VectorXd& all) const
{
    return order_.to_new(extended(all.head(2 * model_.mesh.dam_node_count)));
}

SplitLoad ContactStructure::split(const VectorXd& load) const
{
    SplitLoad result;
    result.dam = to_order(load);
    result.rock = VectorXd::Zero(2 * rock_count_);
    if (!has_rock()) return result;
    VectorXd rock = rock_order_.to_new(loads_by_node(model_, load));
    rock_factor_->forward(rock);
    result.rock = plane().to_plane(VectorXd(rock.tail(2 * rock_count_)));
    return result;
}

VectorXd ContactStructure::extended(const VectorXd& dam) const
{
    VectorXd result = VectorXd::Zero(size_);
    result.head(dam.size()) = dam;
    return result;
}

VectorXd ContactStructure::with_rock_to_order(const VectorXd& all) const
{
    assert(rock_moves_);
    return order_.to_new(extended(nodal_values(model_.dofs, all)));
}

VectorXd ContactStructure::with_rock_to_model(const VectorXd& ordered) const
{
    assert(rock_moves_);
    const VectorXd nodal = order_.to_old(ordered);
    VectorXd all = VectorXd::Zero(model_.dofs.count);
    for (std::size_t i = 0; i < model_.dofs.dofs.size(); ++i)
        if (const int dof = model_.dofs.dofs[i]; dof != no_dof) all[dof] = nodal[static_cast<Index>(i)];
    return all;
}

void ContactStructure::clear_water(VectorXd& vector) const
{
    for (const Index node : water_nodes_) vector.segment<2>(2 * node).setZero();
}

SparseMatrix ContactStructure::of_dam(const SparseMatrix& matrix) const
{
    if (!water_) return matrix;
    VectorXd keep = VectorXd::Ones(matrix.rows());
    clear_water(keep);
    return SparseMatrix(keep.asDiagonal() * matrix * keep.asDiagonal()).pruned();
}

SparseMatrix ContactStructure::dam_mass() const
{
    SparseMatrix own = added_mass_.nonZeros() > 0 ? SparseMatrix(mass_ - added_mass_) : mass_;
    if (!water_ && !rock_moves_) return own;
    VectorXd keep = VectorXd::Ones(own.rows());
    clear_water(keep);
    clear_rock(keep);
    return SparseMatrix(keep.asDiagonal() * own * keep.asDiagonal()).pruned();
}

void ContactStructure::clear_rock(VectorXd& vector) const
{
    for (const Index node : rock_nodes_) vector.segment<2>(2 * node).setZero();
}

void ContactStructure::leave_dam_mass(VectorXd& product, const VectorXd& x) const
{
    of_added_mass_.subtract_product(x, product);
    clear_water(product);
    clear_rock(product);
}

void ContactStructure::take_off_translations(const VectorXd& u, VectorXd& deformation) const
{
    deformation.resize(u.size());
    for (Index node = 0; node < order_.nodes(); ++node)
        deformation.segment<2>(2 * node) =
            u.segment<2>(2 * node) - u.segment<2>(anchor_[static_cast<std::size_t>(node)]);
    for (const auto* nodes : {&water_nodes_, &rock_nodes_}) // these do not slide
        for (const Index node : *nodes) deformation.segment<2>(2 * node) = u.segment<2>(2 * node);
}

Pairing::Matrix ContactStructure::trace(double slip) const
{
    const Index m = pairs(), n = rock_count_;
    std::vector<Eigen::Triplet<double>> entries;
    if (matching()) {
        for (Index i = 0; i < n; ++i) {
            entries.emplace_back(i, i, 1.0);
            entries.emplace_back(m + i, n + i, 1.0);
        }
    } else if (has_rock()) {
        const Pairing::Matrix weights = pairing_->weights(slip);
        for (Index i = 0; i < weights.rows(); ++i)
            for (Pairing::Matrix::InnerIterator it(weights, i); it; ++it) {
                entries.emplace_back(i, it.col(), it.value());
                entries.emplace_back(m + i, n + it.col(), it.value());
            }
    }
    Pairing::Matrix result(2 * m, 2 * n);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

VectorXd ContactStructure::rock_load(const SplitLoad& load, const Pairing::Matrix& trace) const
{
    if (load.joint.size() == 0) return load.rock;
    return load.rock + trace.transpose() * load.joint;
}

VectorXd ContactStructure::assemble(const VectorXd& dam, const VectorXd& rock, const VectorXd& load) const
{
    VectorXd all(model_.dofs.count);
    const Index moving = 2 * model_.mesh.dam_node_count;
    all.head(moving) = order_.to_old(dam).head(moving);
    if (!has_rock()) return all;
    VectorXd inner = rock_order_.to_new(loads_by_node(model_, load));
    rock_factor_->forward(inner);
    inner.tail(2 * rock_count_) = plane().to_interface(rock);
    rock_factor_->backward(inner);
    const VectorXd by_node = rock_order_.to_old(inner);
    const int first = model_.mesh.dam_node_count, nodes = model_.mesh.node_count() - first;
    for (int node = 0; node < nodes; ++node)
        for (const int c : {0, 1})
            if (const int dof = model_.dofs(first + node, c); dof != no_dof) all[dof] = by_node[2 * node + c];
    return all;
}

namespace {

constexpr double round_off = 1e-13; ///< weights below are zero [-]

double shortest(const std::vector<double>& places)
{
    double result = places.back() - places.front();
    for (std::size_t k = 0; k + 1 < places.size(); ++k) result = std::min(result, places[k + 1] - places[k]);
    return result;
}

} // namespace

Pairing::Pairing(std::vector<double> dam, std::vector<double> rock) : dam_(std::move(dam)), rock_(std::move(rock))
{
    assert(dam_.size() > 1 && rock_.size() > 1);
}

bool Pairing::reaches(double slip) const
{
    const double slack = 1e-9 * (rock_.back() - rock_.front());
    return slip >= reach_upstream() - slack && slip <= reach_downstream() + slack;
}

double Pairing::smallest_element() const
{
    return std::min(shortest(dam_), shortest(rock_));
}

Pairing::Matrix Pairing::weights(double slip) const
{
    assert(reaches(slip));
    const auto m = dam_.size(), n = rock_.size();
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> area(m, 0.0);
    for (std::size_t i = 0; i + 1 < m; ++i) {
        area[i] += 0.5 * (dam_[i + 1] - dam_[i]);
        area[i + 1] += 0.5 * (dam_[i + 1] - dam_[i]);
    }
    for (std::size_t i = 0; i + 1 < m; ++i) {
        const double left = dam_[i] + slip, right = dam_[i + 1] + slip, length = right - left;
        auto next = std::upper_bound(rock_.begin(), rock_.end(), left);
        auto j = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, next - rock_.begin() - 1));
        for (j = std::min(j, n - 2); j + 1 < n; ++j) {
            const bool first = j == 0, last = j + 2 == n; // the outermost elements take what round-off leaves outside
            const double begin = first ? left : std::max(left, rock_[j]),
                         end = last ? right : std::min(right, rock_[j + 1]);
            if (end > begin) {
                // ψ N is quadratic: two points of Gauss are exact.
                const double half = 0.5 * (end - begin), middle = 0.5 * (end + begin);
                for (const double sign : {-1.0, 1.0}) {
                    const double x = middle + sign * half / std::sqrt(3.0);
                    const double xi = (x - left) / length, eta = (x - rock_[j]) / (rock_[j + 1] - rock_[j]);
                    for (const auto& [node, dual] : {std::pair{i, 2.0 - 3.0 * xi}, std::pair{i + 1, 3.0 * xi - 1.0}}) {
                        entries.emplace_back(node, j, half * dual * (1.0 - eta) / area[node]);
                        entries.emplace_back(node, j + 1, half * dual * eta / area[node]);
                    }
                }
            }
            if (!(rock_[j + 1] < right)) break;
        }
    }
    Matrix result(static_cast<Index>(m), static_cast<Index>(n));
    result.setFromTriplets(entries.begin(), entries.end());
    result.prune([](Index, Index, double value) { return std::abs(value) > round_off; });
    return result;
}

FewRows::FewRows(const SparseMatrix& matrix) : begin_{0}
{
    const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = matrix;
    for (int row = 0; row < by_rows.outerSize(); ++row) {
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(by_rows, row); it; ++it) {
            column_.push_back(static_cast<int>(it.col()));
            value_.push_back(it.value());
        }
        if (static_cast<int>(column_.size()) == begin_.back()) continue;
        row_.push_back(row);
        begin_.push_back(static_cast<int>(column_.size()));
    }
}

void FewRows::subtract_product(const Eigen::VectorXd& x, Eigen::VectorXd& y) const
{
    for (std::size_t k = 0; k < row_.size(); ++k) {
        double sum = 0.0;
        for (int e = begin_[k]; e < begin_[k + 1]; ++e) sum += value_[e] * x[column_[e]];
        y[row_[k]] -= sum;
    }
}

using Eigen::MatrixXd;

namespace {

constexpr int largest_space = 60;         ///< vectors; a few frequencies take ten to twenty
constexpr double largest_error = 1e-13;   ///< of 1/ω², relative
constexpr double least_new_length = 1e-14; ///< of a new vector's length to the old one's; below, the space is complete

bool is_plain(const ContactStructure& structure)
{
    return structure.regular() && structure.planes().count() == 1 && !structure.rock_moves() &&
           (!structure.has_rock() || structure.matching());
}

/// The dam on what holds its base.
class TiedStiffness {
public:
    explicit TiedStiffness(const ContactStructure& structure) : factor_(structure.static_factor())
    {
        if (!structure.has_rock()) return;
        const auto& gaps = structure.planes().gaps(); // square: turns the interface to the plane's axes
        const MatrixXd rock = structure.rock_stiffness() * gaps;
        base_.emplace(factor_.schur() + gaps.transpose() * rock);
    }

    bool regular() const { return !base_ || base_->info() == Eigen::Success; }

    VectorXd solve(VectorXd load) const
    {
        const Index base = load.size() - factor_.inner_unknowns();
        factor_.forward(load);
        if (base_)
            load.tail(base) = base_->solve(load.tail(base)).eval();
        else
            load.tail(base).setZero();
        factor_.backward(load);
        return load;
    }

private:
    const InterfaceFactor& factor_;
    std::optional<Eigen::LLT<MatrixXd>> base_; ///< nothing: rigid
};

/// A motion that no mode is orthogonal to but by accident: it changes from unknown to unknown by numbers of a linear
/// congruential sequence, the same every time.
VectorXd start_motion(Index n)
{
    VectorXd motion(n);
    std::uint32_t state = 20150101u;
    for (Index i = 0; i < n; ++i) {
        state = 1664525u * state + 1013904223u;
        motion[i] = (i % 2 == 0 ? 1.0 : 0.5) * (0.5 + static_cast<double>(state) / 4294967296.0);
    }
    return motion;
}

/// The largest `count` eigenvalues, descending, if their errors are small enough.
/// @param last  length of the next vector
std::optional<VectorXd> converged(const VectorXd& diagonal, const VectorXd& off, double last, Index count)
{
    const Index size = diagonal.size();
    if (size <= count) return std::nullopt;
    Eigen::SelfAdjointEigenSolver<MatrixXd> solver;
    solver.computeFromTridiagonal(diagonal, off.head(size - 1));
    const VectorXd values = solver.eigenvalues().reverse();
    for (Index i = 0; i < count; ++i) {
        const double residual = std::abs(last * solver.eigenvectors()(size - 1, size - 1 - i));
        double gap = values[i] - values[i + 1] - residual;
        if (i > 0) gap = std::min(gap, values[i - 1] - values[i] - residual);
        const double error = gap > 0.0 ? std::min(residual, residual * residual / gap) : residual;
        if (!(error <= largest_error * values[i])) return std::nullopt;
    }
    return values.head(count);
}

} // namespace

std::optional<VectorXd> tied_frequencies(const ContactStructure& structure, int count)
{
    if (!is_plain(structure) || structure.water() || count < 1) return std::nullopt;
    const TiedStiffness stiffness(structure);
    if (!stiffness.regular()) return std::nullopt;
    const SparseMatrix& mass = structure.mass();
    MatrixXd vectors(mass.rows(), largest_space), momenta = vectors; // q and M q
    VectorXd diagonal(largest_space), off(largest_space);

    VectorXd next = stiffness.solve(mass * start_motion(mass.rows()));
    VectorXd momentum = mass * next;
    double length = std::sqrt(next.dot(momentum));
    for (Index k = 0; k < largest_space; ++k) {
        if (!(length > 0.0)) return std::nullopt;
        vectors.col(k) = next / length;
        momenta.col(k) = momentum / length;
        next = stiffness.solve(momenta.col(k));
        diagonal[k] = next.dot(momenta.col(k));
        for (int twice = 0; twice < 2; ++twice)
            next -= vectors.leftCols(k + 1) * (momenta.leftCols(k + 1).transpose() * next).eval();
        momentum = mass * next;
        length = off[k] = std::sqrt(std::max(0.0, next.dot(momentum)));
        if (!(length > least_new_length * diagonal[0])) return std::nullopt;
        if (const auto found = converged(diagonal.head(k + 1), off, length, count))
            return found->cwiseSqrt().cwiseInverse();
    }
    return std::nullopt;
}

std::optional<CoupledPencil> tied_pencil(const ContactStructure& structure, const FluidModel& water)
{
    if (!is_plain(structure) || !structure.has_rock()) return std::nullopt;
    const Model& model = structure.model();
    const Index dam = 2 * model.mesh.dam_node_count; // its unknowns are the first
    CoupledPencil pencil = coupled_pencil(model, water);
    const auto& gaps = structure.planes().gaps();
    const MatrixXd rock = gaps.transpose() * (structure.rock_stiffness() * gaps).eval();
    const auto unknown = [&](Index k) { // of the interface's k-th
        const NodeOrder& order = structure.order();
        return 2 * order.old_node[static_cast<std::size_t>(order.inner + k / 2)] + k % 2;
    };
    std::vector<Eigen::Triplet<double>> entries;
    for (Index i = 0; i < rock.rows(); ++i)
        for (Index j = 0; j < rock.cols(); ++j)
            entries.emplace_back(unknown(i), unknown(j), 0.5 * (rock(i, j) + rock(j, i)));
    SparseMatrix on_base(dam, dam);
    on_base.setFromTriplets(entries.begin(), entries.end());
    pencil.stiffness = SparseMatrix(pencil.stiffness.topLeftCorner(dam, dam)) + on_base;
    pencil.mass = SparseMatrix(pencil.mass.topLeftCorner(dam, dam));
    pencil.coupling = SparseMatrix(pencil.coupling.topRows(dam));
    pencil.inertia_x = VectorXd(pencil.inertia_x.head(dam));
    pencil.inertia_y = VectorXd(pencil.inertia_y.head(dam));
    pencil.structure_mass = {pencil.inertia_x.sum(), pencil.inertia_y.sum()};
    return pencil;
}

} // namespace damslip::fe2d
