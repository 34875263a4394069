#include "fe2d/reduction/dam_modes.hpp"
#include "fe2d/solver/dense_product.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Eigenpairs of B y = θ y, B self-adjoint in the inner product of M, largest θ first.
struct LanczosPairs {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors; ///< M-orthonormal columns
    bool converged = false;
    int applications = 0;
};

/// Without symmetry and the same every time: a linear congruential sequence in -1 ... 1.
VectorXd start_vector(Index n)
{
    VectorXd v(n);
    std::uint32_t state = 20150101u;
    for (double& x : v) {
        state = 1664525u * state + 1013904223u;
        x = static_cast<double>(state) / 2147483648.0 - 1.0;
    }
    return v;
}

/// Lanczos (1950) without restart, with full reorthogonalisation, a second time where the first one cancels (Daniel, Gragg,
/// Kaufman & Stewart 1976), from a fixed start: same problem, same bits.
/// @param multiply  x -> M^-1-self-adjoint operator applied to (M x), given M x
/// @param deflated  M-orthonormal columns that the search leaves out
/// @param tolerance  of the residual over the largest θ's own size [-]
LanczosPairs lanczos(const std::function<VectorXd(const VectorXd& mass_times_x)>& multiply,
                     const Eigen::SparseMatrix<double>& mass, const MatrixXd& deflated, int count, double tolerance)
{
    const Index n = mass.rows(), rigid = deflated.cols(), limit = std::min<Index>(n - rigid, 6 * count + 60);
    // Columns: deflated, then Lanczos vectors; both are kept M-orthonormal to everything before.
    MatrixXd basis(n, rigid + limit + 1), mass_basis(n, rigid + limit + 1);
    basis.leftCols(rigid) = deflated;
    mass_basis.leftCols(rigid) = mass * deflated;
    Index used = rigid;
    const auto append = [&](VectorXd x) {
        for (int pass = 0; pass < 2; ++pass) { // once more only where the first pass left little
            const double before = x.norm();
            x -= basis.leftCols(used) * (mass_basis.leftCols(used).transpose() * x).eval();
            if (x.norm() > 0.5 * before) break;
        }
        const VectorXd mx = mass * x;
        const double norm = std::sqrt(std::max(0.0, x.dot(mx)));
        if (norm > 0.0) {
            basis.col(used) = x / norm;
            mass_basis.col(used) = mx / norm;
            ++used;
        }
        return norm;
    };
    LanczosPairs result;
    append(start_vector(n));
    VectorXd diagonal(limit), below(limit);
    Index next_check = std::min<Index>(limit, 2 * count + 10);
    for (Index j = 0; j < limit; ++j) {
        VectorXd y = multiply(mass_basis.col(rigid + j));
        ++result.applications;
        diagonal[j] = y.dot(mass_basis.col(rigid + j));
        y -= diagonal[j] * basis.col(rigid + j);
        if (j > 0) y -= below[j - 1] * basis.col(rigid + j - 1);
        below[j] = append(y);
        const bool exhausted = j + 1 == limit || below[j] == 0.0;
        if (j + 1 < next_check && !exhausted) continue;
        next_check = j + 1 + 10;
        Eigen::SelfAdjointEigenSolver<MatrixXd> ritz;
        ritz.computeFromTridiagonal(diagonal.head(j + 1), below.head(j));
        const Index found = std::min<Index>(count, j + 1);
        const double worst = (below[j] * ritz.eigenvectors().row(j).tail(found)).cwiseAbs().maxCoeff();
        result.converged = found == count && worst <= tolerance * ritz.eigenvalues()[j + 1 - found];
        if (!result.converged && !exhausted) continue;
        result.values = ritz.eigenvalues().tail(found).reverse();
        result.vectors = basis.middleCols(rigid, j + 1) * ritz.eigenvectors().rightCols(found).rowwise().reverse();
        break;
    }
    return result;
}

/// Translations and the rotation, M-orthonormal, by modified Gram-Schmidt.
MatrixXd rigid_motions(const ContactStructure& structure)
{
    const Mesh& mesh = structure.model().mesh;
    const Point origin = mesh.nodes[mesh.contact.dam_nodes.front()];
    MatrixXd rigid = MatrixXd::Zero(structure.dam_unknowns(), 3);
    for (Index k = 0; k < rigid.rows() / 2; ++k) {
        const Point at = mesh.nodes[structure.order().old_node[static_cast<std::size_t>(k)]];
        rigid(2 * k, 0) = rigid(2 * k + 1, 1) = 1.0;
        rigid(2 * k, 2) = -(at.y - origin.y);
        rigid(2 * k + 1, 2) = at.x - origin.x;
    }
    for (int pass = 0; pass < 2; ++pass)
        for (Index i = 0; i < 3; ++i) {
            for (Index j = 0; j < i; ++j)
                rigid.col(i) -= rigid.col(j).dot(structure.mass() * rigid.col(i)) * rigid.col(j);
            rigid.col(i) /= std::sqrt(rigid.col(i).dot(structure.mass() * rigid.col(i)));
        }
    return rigid;
}

/// Size of the lowest elastic ω², from above: Rayleigh's quotient of a bending shape without its rigid part.
double elastic_scale(const ContactStructure& structure, const MatrixXd& rigid)
{
    VectorXd x(structure.dam_unknowns());
    const Mesh& mesh = structure.model().mesh;
    for (Index k = 0; k < x.size() / 2; ++k) {
        const Point at = mesh.nodes[structure.order().old_node[static_cast<std::size_t>(k)]];
        x[2 * k] = at.y * at.y;
        x[2 * k + 1] = -2.0 * at.x * at.y;
    }
    for (int pass = 0; pass < 2; ++pass) x -= rigid * (rigid.transpose() * (structure.mass() * x).eval()).eval();
    return x.dot(structure.stiffness() * x) / x.dot(structure.mass() * x);
}

/// Elastic shapes and their ω², by the whole spectrum: for small models and for nearly all modes.
void all_elastic(const ContactStructure& structure, Index count, VectorXd& omega2, MatrixXd& shape)
{
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(MatrixXd(structure.stiffness()),
                                                                    MatrixXd(structure.mass()));
    omega2 = solver.eigenvalues().segment(3, count);
    shape = solver.eigenvectors().middleCols(3, count);
}

} // namespace

DamModes DamModes::first(Index count) const
{
    DamModes result = *this;
    const Index rest = this->count() - count;
    result.omega2 = omega2.head(count);
    result.on_plane = on_plane.leftCols(count);
    result.crest = crest.head(count);
    result.ground_x = ground_x.head(count);
    result.ground_y = ground_y.head(count);
    result.dam_mass = dam_mass.topLeftCorner(count, count);
    result.dam_x = dam_x.head(count);
    result.dam_y = dam_y.head(count);
    result.momentum = momentum.head(count);
    if (rest == 0) return result;
    result.complete = false;
    const MatrixXd softened = on_plane.rightCols(rest) * omega2.tail(rest).cwiseInverse().asDiagonal();
    result.residual.noalias() += softened * on_plane.rightCols(rest).transpose();
    result.residual_crest.noalias() += softened * crest.tail(rest);
    return result;
}

DamModes dam_modes(const ContactStructure& structure, int elastic)
{
    DamModes modes;
    const Plane& plane = structure.plane();
    const Index n = structure.dam_unknowns(), m = plane.pairs(), possible = n - 3;
    const Index count = std::clamp<Index>(elastic, 1, possible);
    const MatrixXd rigid = rigid_motions(structure);

    // K + σM with a σ far below all elastic ω²: regular, and its flexibility less that of the modes kept is the
    // residual flexibility up to a share σ/ω² of the modes left out.
    const double shift = 1e-4 * elastic_scale(structure, rigid);
    const InterfaceFactor factor(structure.stiffness() + shift * structure.mass(), structure.order().inner);
    if (!factor.regular()) return modes;
    const Eigen::LLT<MatrixXd> schur(factor.schur());
    if (schur.info() != Eigen::Success) return modes;
    const auto solve = [&](const VectorXd& b) {
        VectorXd x = b;
        factor.forward(x);
        const VectorXd interface = schur.solve(x.tail(2 * m));
        x.tail(2 * m) = interface;
        factor.backward(x);
        return x;
    };

    MatrixXd shape(n, 3 + count);
    modes.omega2 = VectorXd::Zero(3 + count);
    shape.leftCols(3) = rigid;
    VectorXd omega2;
    MatrixXd elastic_shape;
    if (3 * count > possible) {
        all_elastic(structure, count, omega2, elastic_shape);
        modes.regular = true;
    } else {
        LanczosPairs pairs = lanczos(solve, structure.mass(), rigid, static_cast<int>(count), 1e-9);
        modes.regular = pairs.converged;
        modes.solutions = pairs.applications;
        if (!pairs.converged) return modes;
        omega2 = pairs.values.cwiseInverse().array() - shift;
        elastic_shape = std::move(pairs.vectors);
    }
    modes.omega2.tail(count) = omega2;
    shape.rightCols(count) = elastic_shape;

    modes.on_plane.resize(2 * m, 3 + count);
    for (Index i = 0; i < 3 + count; ++i) modes.on_plane.col(i) = plane.to_plane(VectorXd(shape.col(i).tail(2 * m)));
    const Mesh& mesh = structure.model().mesh;
    const Index crest = 2 * structure.order().new_node[static_cast<std::size_t>(mesh.crest.back())];
    modes.crest = shape.row(crest).transpose();
    modes.ground_x = shape.transpose() * structure.inertia_x();
    modes.ground_y = shape.transpose() * structure.inertia_y();
    VectorXd translation(n);
    for (Index k = 0; k < n; k += 2) translation.segment<2>(k) = plane.tangent;
    const SparseMatrix dam_mass = structure.dam_mass();
    modes.dam_mass = shape.transpose() * (dam_mass * shape).eval();
    modes.dam_x = shape.transpose() * structure.dam_inertia_x();
    modes.dam_y = shape.transpose() * structure.dam_inertia_y();
    modes.momentum = shape.transpose() * (dam_mass * translation).eval();

    modes.complete = count == possible;
    if (modes.complete) {
        modes.residual = MatrixXd::Zero(2 * m, 2 * m);
        modes.residual_crest = VectorXd::Zero(2 * m);
        return modes;
    }
    const MatrixXd softened = modes.on_plane * (modes.omega2.array() + shift).inverse().matrix().asDiagonal();
    const MatrixXd flexibility = plane.to_plane(MatrixXd(schur.solve(MatrixXd::Identity(2 * m, 2 * m))));
    modes.residual = flexibility - softened * modes.on_plane.transpose();
    modes.residual = (0.5 * (modes.residual + modes.residual.transpose())).eval();
    const VectorXd crest_solution = solve(VectorXd::Unit(n, crest));
    modes.residual_crest = plane.to_plane(VectorXd(crest_solution.tail(2 * m))) - softened * modes.crest;
    return modes;
}

} // namespace damslip::fe2d
