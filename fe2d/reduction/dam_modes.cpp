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

/// The dam alone, in the structure's order without the water's nodes.
struct DamPart {
    std::vector<int> nodes; ///< of the mesh
    SparseMatrix pick;      ///< rows of the dam out of all unknowns
    SparseMatrix stiffness, mass, dam_mass;
    int inner = 0; ///< nodes before those of the plane

    explicit DamPart(const ContactStructure& structure)
        : stiffness(structure.stiffness()), mass(structure.mass()), dam_mass(structure.dam_mass()),
          inner(structure.order().inner)
    {
        const Index all = structure.order().nodes();
        std::vector<Eigen::Triplet<double>> entries;
        for (Index k = 0; k < all; ++k) {
            const int node = structure.order().old_node[static_cast<std::size_t>(k)];
            if (node >= structure.model().mesh.dam_node_count) continue;
            const auto here = static_cast<Index>(2 * nodes.size());
            entries.emplace_back(here, 2 * k, 1.0);
            entries.emplace_back(here + 1, 2 * k + 1, 1.0);
            nodes.push_back(node);
        }
        pick.resize(static_cast<Index>(2 * nodes.size()), 2 * all);
        pick.setFromTriplets(entries.begin(), entries.end());
        inner -= static_cast<int>(all - static_cast<Index>(nodes.size()));
        if (!structure.water()) return;
        for (SparseMatrix* matrix : {&stiffness, &mass, &dam_mass})
            *matrix = SparseMatrix(pick * *matrix * pick.transpose());
    }
    Index unknowns() const { return pick.rows(); }
};

/// Translations and the rotation, M-orthonormal, by modified Gram-Schmidt.
MatrixXd rigid_motions(const ContactStructure& structure, const DamPart& dam)
{
    const Mesh& mesh = structure.model().mesh;
    const Point origin = mesh.nodes[mesh.contact.dam_nodes.front()];
    MatrixXd rigid = MatrixXd::Zero(dam.unknowns(), 3);
    for (Index k = 0; k < rigid.rows() / 2; ++k) {
        const Point at = mesh.nodes[dam.nodes[static_cast<std::size_t>(k)]];
        rigid(2 * k, 0) = rigid(2 * k + 1, 1) = 1.0;
        rigid(2 * k, 2) = -(at.y - origin.y);
        rigid(2 * k + 1, 2) = at.x - origin.x;
    }
    for (int pass = 0; pass < 2; ++pass)
        for (Index i = 0; i < 3; ++i) {
            for (Index j = 0; j < i; ++j) rigid.col(i) -= rigid.col(j).dot(dam.mass * rigid.col(i)) * rigid.col(j);
            rigid.col(i) /= std::sqrt(rigid.col(i).dot(dam.mass * rigid.col(i)));
        }
    return rigid;
}

/// Size of the lowest elastic ω², from above: Rayleigh's quotient of a bending shape without its rigid part.
double elastic_scale(const ContactStructure& structure, const DamPart& dam, const MatrixXd& rigid)
{
    VectorXd x(dam.unknowns());
    const Mesh& mesh = structure.model().mesh;
    for (Index k = 0; k < x.size() / 2; ++k) {
        const Point at = mesh.nodes[dam.nodes[static_cast<std::size_t>(k)]];
        x[2 * k] = at.y * at.y;
        x[2 * k + 1] = -2.0 * at.x * at.y;
    }
    for (int pass = 0; pass < 2; ++pass) x -= rigid * (rigid.transpose() * (dam.mass * x).eval()).eval();
    return x.dot(dam.stiffness * x) / x.dot(dam.mass * x);
}

/// Elastic shapes and their ω², by the whole spectrum: for small models and for nearly all modes.
void all_elastic(const DamPart& dam, Index count, VectorXd& omega2, MatrixXd& shape)
{
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(MatrixXd(dam.stiffness), MatrixXd(dam.mass));
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
    if (face.size() > 0) result.face = face.topRows(count);
    if (rest == 0) return result;
    result.complete = false;
    const MatrixXd softened = on_plane.rightCols(rest) * omega2.tail(rest).cwiseInverse().asDiagonal();
    result.residual.noalias() += softened * on_plane.rightCols(rest).transpose();
    result.residual_crest.noalias() += softened * crest.tail(rest);
    if (face.size() == 0) return result;
    const MatrixXd on_face = face.bottomRows(rest), soft = omega2.tail(rest).cwiseInverse().asDiagonal() * on_face;
    FaceResidual& more = result.face_residual;
    more.flexibility.noalias() += on_face.transpose() * soft;
    more.mass.noalias() += soft.transpose() * soft;
    more.on_plane.noalias() += on_plane.rightCols(rest) * soft;
    more.crest.noalias() += soft.transpose() * crest.tail(rest);
    return result;
}

void DamModes::lengthen(Index count)
{
    const Index all = this->count() + count;
    for (VectorXd* vector : {&omega2, &crest, &ground_x, &ground_y, &dam_x, &dam_y, &momentum})
        vector->conservativeResizeLike(VectorXd::Zero(all));
    on_plane.conservativeResizeLike(MatrixXd::Zero(on_plane.rows(), all));
    dam_mass.conservativeResizeLike(MatrixXd::Zero(all, all));
}

MatrixXd DamModes::attach(const FaceResidual& rest, const MatrixXd& pressures, const MatrixXd& mass,
                          MatrixXd& flexibility)
{
    constexpr double smallest = 1e-4; // of the water's own
    const MatrixXd soft = pressures.transpose() * rest.flexibility * pressures;
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> share(0.5 * (soft + soft.transpose()), mass);
    const Index kept = static_cast<Index>((share.eigenvalues().array() > smallest).count());
    if (kept == 0) return MatrixXd(0, pressures.cols());
    const MatrixXd loads = pressures * share.eigenvectors().rightCols(kept),
                   moving = loads.transpose() * rest.mass * loads;
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(
        MatrixXd(share.eigenvalues().tail(kept).asDiagonal()), 0.5 * (moving + moving.transpose()));
    const MatrixXd amplitudes = loads * modes.eigenvectors(); // pressures that make each mode
    lengthen(kept);
    omega2.tail(kept) = modes.eigenvalues();
    on_plane.rightCols(kept) = rest.on_plane * amplitudes;
    const MatrixXd softened = on_plane.rightCols(kept) * omega2.tail(kept).cwiseInverse().asDiagonal();
    flexibility.noalias() -= softened * on_plane.rightCols(kept).transpose();
    if (rest.crest.size() > 0) { // of the dam
        crest.tail(kept) = amplitudes.transpose() * rest.crest;
        residual_crest.noalias() -= softened * crest.tail(kept);
        dam_mass.bottomRightCorner(kept, kept).setIdentity();
    }
    return amplitudes.transpose() * rest.flexibility * pressures;
}

std::vector<Index> face_pressures(const WaterBody& water)
{
    std::vector<Index> columns;
    for (Index column = 0; column < water.coupling.outerSize(); ++column)
        if (water.coupling.col(column).nonZeros() > 0) columns.push_back(column);
    return columns;
}

DamModes dam_modes(const ContactStructure& structure, int elastic)
{
    DamModes modes;
    const Plane& plane = structure.plane();
    const DamPart dam(structure);
    const Index n = dam.unknowns(), m = plane.pairs(), possible = n - 3;
    const Index count = std::clamp<Index>(elastic, 1, possible);
    const MatrixXd rigid = rigid_motions(structure, dam);

    // K + σM with a σ far below all elastic ω²: regular, and its flexibility less that of the modes kept is the
    // residual flexibility up to a share σ/ω² of the modes left out.
    const double shift = 1e-4 * elastic_scale(structure, dam, rigid);
    const InterfaceFactor factor(dam.stiffness + shift * dam.mass, dam.inner);
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
        all_elastic(dam, count, omega2, elastic_shape);
        modes.regular = true;
    } else {
        LanczosPairs pairs = lanczos(solve, dam.mass, rigid, static_cast<int>(count), 1e-9);
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
    const Index crest = 2 * (std::find(dam.nodes.begin(), dam.nodes.end(), mesh.crest.back()) - dam.nodes.begin());
    modes.crest = shape.row(crest).transpose();
    modes.ground_x = shape.transpose() * (dam.pick * structure.inertia_x());
    modes.ground_y = shape.transpose() * (dam.pick * structure.inertia_y());
    VectorXd translation(n);
    for (Index k = 0; k < n; k += 2) translation.segment<2>(k) = plane.tangent;
    modes.dam_mass = shape.transpose() * (dam.dam_mass * shape).eval();
    modes.dam_x = shape.transpose() * (dam.pick * structure.dam_inertia_x());
    modes.dam_y = shape.transpose() * (dam.pick * structure.dam_inertia_y());
    modes.momentum = shape.transpose() * (dam.dam_mass * translation).eval();
    MatrixXd loads; // H on the dam, by the pressures on the face
    if (structure.water()) {
        const std::vector<Index> pressures = face_pressures(*structure.water());
        loads.resize(n, static_cast<Index>(pressures.size()));
        for (Index k = 0; k < loads.cols(); ++k)
            loads.col(k) =
                dam.pick *
                structure.to_order(VectorXd(structure.water()->coupling.col(pressures[static_cast<std::size_t>(k)])));
        modes.face = shape.transpose() * loads;
        const Index shapes = loads.cols();
        modes.face_residual = {MatrixXd::Zero(shapes, shapes), MatrixXd::Zero(shapes, shapes),
                               MatrixXd::Zero(2 * m, shapes), VectorXd::Zero(shapes)};
    }

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
    if (loads.cols() == 0) return modes;
    MatrixXd rest(n, loads.cols());
    for (Index k = 0; k < loads.cols(); ++k) rest.col(k) = solve(loads.col(k));
    rest -= shape * (shape.transpose() * (dam.mass * rest).eval()).eval();
    modes.face_residual.flexibility = loads.transpose() * rest;
    modes.face_residual.mass = rest.transpose() * (dam.mass * rest).eval();
    for (Index k = 0; k < rest.cols(); ++k)
        modes.face_residual.on_plane.col(k) = plane.to_plane(VectorXd(rest.col(k).tail(2 * m)));
    modes.face_residual.crest = rest.row(crest).transpose();
    return modes;
}

} // namespace damslip::fe2d
