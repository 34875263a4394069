#include "fe2d/run/explicit_contact.hpp"
#include "fe2d/solver/dense_algebra.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

/// There is one solution for mu |nt| < nn; only a cohesive shear may lift its own pair where W couples the directions, and then acts
/// with P_n = 0.
ExplicitImpulse solve_pair(const ExplicitPair& w, double free_normal, double free_tangential, double target,
                           double friction, double cohesion, JointOpening separation)
{
    if (separation == JointOpening::allowed && free_normal >= target) return {};
    const double normal = target - free_normal, tangential = -free_tangential;
    const double det = w.nn * w.tt - w.nt * w.nt;
    ExplicitImpulse p;
    p.normal = (w.tt * normal - w.nt * tangential) / det;
    p.tangential = (w.nn * tangential - w.nt * normal) / det;
    if (separation == JointOpening::none && p.normal < 0.0) return {normal / w.nn, 0.0, ContactState::pulled};
    const double strength = cohesion + friction * std::max(p.normal, 0.0);
    p.state = ContactState::stick;
    if (p.normal >= 0.0 && std::abs(p.tangential) <= strength) return p;
    // P_t = -s (c + mu P_n) against a slip of sign s: first the one that sticking would have had to stop, which is right unless W
    // couples the directions strongly.
    const double first = p.tangential < 0.0 ? 1.0 : -1.0;
    for (const double sign : {first, -first}) {
        p.normal = std::max(0.0, (normal + sign * w.nt * cohesion) / (w.nn - sign * friction * w.nt));
        p.tangential = -sign * (cohesion + friction * p.normal);
        p.state = sign > 0.0 ? ContactState::slip_downstream : ContactState::slip_upstream;
        if (sign * (free_tangential + w.nt * p.normal + w.tt * p.tangential) >= 0.0) break;
    }
    return p;
}

namespace {

/// M of one node: (x, y) with a coupling.
Eigen::Matrix2d block_of(const VectorXd& inertia_x, const VectorXd& inertia_y, Index node)
{
    const double coupling = 0.5 * (inertia_y[2 * node] + inertia_x[2 * node + 1]);
    Eigen::Matrix2d block;
    block << inertia_x[2 * node], coupling, coupling, inertia_y[2 * node + 1];
    return block;
}

} // namespace

void ExplicitOperators::make_mass()
{
    const VectorXd &x = structure_.inertia_x(), &y = structure_.inertia_y();
    std::vector<Eigen::Triplet<double>> entries, inverse_entries;
    for (Index node = 0; node < structure_.order().nodes(); ++node) {
        const Eigen::Matrix2d block = block_of(x, y, node), inverted = block.inverse();
        for (Index i = 0; i < 2; ++i)
            for (Index j = 0; j < 2; ++j)
                if (i == j || block(i, j) != 0.0) {
                    entries.emplace_back(2 * node + i, 2 * node + j, block(i, j));
                    inverse_entries.emplace_back(2 * node + i, 2 * node + j, inverted(i, j));
                }
    }
    mass.resize(x.size(), x.size());
    inverse.resize(x.size(), x.size());
    mass.setFromTriplets(entries.begin(), entries.end());
    inverse.setFromTriplets(inverse_entries.begin(), inverse_entries.end());
    damped_ = VectorXd::Zero(x.size());
    for (Index k = 0; k < x.size(); ++k)
        damped_[k] =
            damping_.constants.mass * (k % 2 == 0 ? structure_.dam_inertia_x()[k] : structure_.dam_inertia_y()[k]);
}

void ExplicitOperators::make_pairs()
{
    const Index n = structure_.dam_unknowns(), m = structure_.pairs(), first = n - 2 * structure_.interface();
    std::vector<Eigen::Triplet<double>> entries;
    const ContactPlanes::Matrix& on_interface = structure_.planes().gaps();
    for (Index row = 0; row < on_interface.rows(); ++row)
        for (ContactPlanes::Matrix::InnerIterator it(on_interface, row); it; ++it)
            entries.emplace_back(row, first + it.col(), it.value());
    gaps.resize(2 * m, n);
    gaps.setFromTriplets(entries.begin(), entries.end());
    pull = inverse * SparseMatrix(gaps.transpose());
    const SparseMatrix delassus = gaps * pull;
    pairs.assign(static_cast<std::size_t>(m), {});
    const double scale = delassus.diagonal().maxCoeff();
    for (Index column = 0; column < 2 * m; ++column)
        for (SparseMatrix::InnerIterator it(delassus, column); it; ++it) {
            ExplicitPair& pair = pairs[static_cast<std::size_t>(column % m)];
            if (it.row() == column)
                (column < m ? pair.nn : pair.tt) = it.value();
            else if (it.row() % m == column % m)
                pair.nt = it.value();
            else if (std::abs(it.value()) > 1e-12 * scale)
                separable_ = false;
        }
}

ExplicitOperators::ExplicitOperators(const ContactStructure& structure, const RunDamping& damping)
    : stiffness(structure.stiffness()), structure_(structure), damping_(damping), slip_damping_(structure, damping)
{
    make_mass();
    make_pairs();
    LinearSystem system;
    system.mass = mass;
    system.stiffness = stiffness;
    highest_frequency_ = fe2d::highest_frequency(system);
    double norm = 1.0;
    if (slip_damping_.active()) { // |r|_M² = κ_kk / a_M; |w|² in the inverse: ωᵀ W_tt ω
        const Index m = structure.pairs();
        for (Index k = 0; k < slip_damping_.drag.cols(); ++k) {
            double inverse_norm = 0.0;
            for (Index i = 0; i < m; ++i)
                inverse_norm +=
                    slip_damping_.weights(i, k) * slip_damping_.weights(i, k) * pairs[static_cast<std::size_t>(i)].tt;
            norm += std::sqrt(slip_damping_.drag(k, k) / damping.constants.mass * inverse_norm);
        }
    }
    damping_bound_ =
        damping.constants.stiffness * highest_frequency_ * highest_frequency_ + damping.constants.mass * norm * norm;
}

double ExplicitOperators::limit() const
{
    return 4.0 / (damping_bound_ +
                  std::sqrt(damping_bound_ * damping_bound_ + 4.0 * highest_frequency_ * highest_frequency_));
}

/// C v = a_M M_dam v - P ωᵀ D_t v - D_tᵀ ω (Pᵀ v - κ ωᵀ D_t v) + b_K K v.
void ExplicitOperators::add_damping(const VectorXd& v, const VectorXd& stiffness_product, VectorXd& force) const
{
    force += damped_.cwiseProduct(v) + damping_.constants.stiffness * stiffness_product;
    if (!slip_damping_.active()) return;
    const Index m = structure_.pairs();
    const VectorXd slip = slip_damping_.weights.transpose() * VectorXd(gaps * v).tail(m);
    const VectorXd mean = slip_damping_.momentum.transpose() * v;
    force -= slip_damping_.momentum * slip;
    VectorXd on_pairs = VectorXd::Zero(2 * m);
    on_pairs.tail(m) = slip_damping_.weights * (mean - slip_damping_.drag * slip);
    force -= gaps.transpose() * on_pairs;
}

} // namespace damslip::fe2d
