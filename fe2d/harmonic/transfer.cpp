#include "fe2d/harmonic/transfer.hpp"

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/time/structure_system.hpp"

#include <Eigen/QR>
#include <array>
#include <cassert>
#include <numbers>
#include <umfpack.h>
#include <vector>

namespace damslip::fe2d {

namespace {

/// What the rock puts on the unknowns of the base and on φ of the water's floor, where that is its own; empty without. With its
/// compliance F = [F_b, F_bf; F_fb, F_f], p = h φ, h = iω s on v: the base's forces eliminated,
///
///     [K, -K F_bf h; -h F_fb K, -h² (F_f - F_fb K F_bf)],   K = F_b⁻¹
/// @param scale  s [Pa s/m]
Eigen::MatrixXcd dynamic_stiffness(const RockBelow* below, double frequency, double scale)
{
    if (!below) return {};
    const Eigen::Index n = below->rock.interface(), base = below->rock.base(), floor = below->rock.floor;
    const Eigen::MatrixXcd compliance =
        below->rock.response(frequency, below->stiffness_damping, Eigen::MatrixXd::Identity(n, n));
    if (floor == 0) return compliance.inverse();
    const std::complex<double> h(0.0, frequency * scale);
    const Eigen::MatrixXcd stiffness = compliance.topLeftCorner(base, base).inverse(),
                           across = stiffness * compliance.topRightCorner(base, floor);
    Eigen::MatrixXcd block(n, n);
    block.topLeftCorner(base, base) = stiffness;
    block.topRightCorner(base, floor) = -h * across;
    block.bottomLeftCorner(floor, base) = -h * across.transpose();
    block.bottomRightCorner(floor, floor) =
        -h * h * (compliance.bottomRightCorner(floor, floor) - compliance.bottomLeftCorner(floor, base) * across);
    return block;
}

/// Displacement of the crest's upstream end in x beyond the rigid motion that fits the base's nodes best.
std::complex<double> deflection(const Model& model, const Eigen::VectorXcd& z)
{
    const int crest = model.mesh.crest.back();
    const std::complex<double> of_crest = z[model.dofs(crest, 0)];
    if (!model.mesh.has_rock()) return of_crest;
    const std::vector<int>& base = model.mesh.contact.dam_nodes;
    const auto n = static_cast<Eigen::Index>(base.size());
    Eigen::MatrixXcd rigid = Eigen::MatrixXcd::Zero(2 * n, 3); // x, y, rotation from x to y about the crest
    Eigen::VectorXcd motion(2 * n);
    const Point about = model.mesh.nodes[static_cast<std::size_t>(crest)];
    for (Eigen::Index i = 0; i < n; ++i) {
        const int node = base[static_cast<std::size_t>(i)];
        const Point at = model.mesh.nodes[static_cast<std::size_t>(node)];
        rigid(2 * i, 0) = rigid(2 * i + 1, 1) = 1.0;
        rigid(2 * i, 2) = about.y - at.y;
        rigid(2 * i + 1, 2) = at.x - about.x;
        for (const int c : {0, 1}) motion[2 * i + c] = z[model.dofs(node, c)];
    }
    return of_crest - Eigen::VectorXcd(rigid.colPivHouseholderQr().solve(motion))[0];
}

} // namespace

std::vector<TransferPoint> transfer_functions(const Model& model, const LinearSystem& structure,
                                              const FluidModel* water, const std::vector<double>& frequencies,
                                              const RockBelow* rock)
{
    const Eigen::Index n = structure.size();
    CoupledSystem system;
    if (water) {
        const SparseMatrix coupling =
            face_coupling(model.mesh, model.dofs, water->reservoir, water->dofs, water->unknowns());
        system =
            couple(structure.mass, structure.damping, structure.stiffness, SparseMatrix(coupling.topRows(n)), *water);
    } else {
        system.mass = structure.mass;
        system.damping = structure.damping;
        system.stiffness = structure.stiffness;
        system.structure_unknowns = n;
        system.velocity_x = Eigen::VectorXd::Zero(n);
    }
    std::vector<Eigen::Index> moved = rock ? unknowns_of_base(model) : std::vector<Eigen::Index>();
    if (water)
        for (const Eigen::Index unknown : unknowns_of_floor(system, *water)) moved.push_back(unknown);
    HarmonicSolver solver(system.mass, system.damping, system.stiffness, moved);
    const int crest = model.dofs(model.mesh.crest.back(), 0);
    std::vector<TransferPoint> points;
    for (const double frequency : frequencies) {
        TransferPoint point;
        point.frequency = frequency;
        const double w = 2.0 * std::numbers::pi * frequency;
        const std::complex<double> rate(0.0, w);
        point.regular = solver.factorise(w, dynamic_stiffness(rock, w, system.scale));
        if (point.regular) {
            Eigen::VectorXcd load = system.velocity_x.cast<std::complex<double>>() / rate;
            load.head(n) -= model.inertia_x.head(n);
            const Eigen::VectorXcd z = solver.solve(load);
            point.crest = 1.0 - w * w * z[crest];
            point.deflection = -w * w * deflection(model, z);
            if (water)
                point.water_force =
                    system.scale * rate *
                    (water->force_x.cast<std::complex<double>>().transpose() * z.tail(system.water_unknowns)).value();
        }
        points.push_back(point);
    }
    return points;
}

using Eigen::Index;

struct HarmonicSolver::Implementation {
    // One pattern for all three; UMFPACK takes real and imaginary parts apart.
    Eigen::SparseMatrix<double> mass, damping, stiffness;
    Eigen::VectorXd real, imaginary;
    std::vector<Index> block_places; ///< of the dense block's entries among those of the pattern, by columns
    void* symbolic = nullptr;
    void* numeric = nullptr;
    std::array<double, UMFPACK_CONTROL> control{};
    bool regular = false;

    ~Implementation()
    {
        if (numeric) umfpack_zi_free_numeric(&numeric);
        if (symbolic) umfpack_zi_free_symbolic(&symbolic);
    }
};

namespace {

/// Stored zeros at every pair of the unknowns.
Eigen::SparseMatrix<double> zero_block(std::span<const Index> unknowns, Index size)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (const Index column : unknowns)
        for (const Index row : unknowns) entries.emplace_back(row, column, 0.0);
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

} // namespace

HarmonicSolver::HarmonicSolver(const Matrix& mass, const Matrix& damping, const Matrix& stiffness,
                               std::span<const Index> block_at)
    : implementation_(std::make_unique<Implementation>())
{
    Implementation& s = *implementation_;
    SharedPattern shared = on_one_pattern(mass, damping, stiffness + zero_block(block_at, stiffness.rows()));
    s.mass = std::move(shared.mass);
    s.damping = std::move(shared.damping);
    s.stiffness = std::move(shared.stiffness);
    for (const Index column : block_at)
        for (const Index row : block_at)
            s.block_places.push_back(&s.stiffness.coeffRef(row, column) - s.stiffness.valuePtr());
    umfpack_zi_defaults(s.control.data());
}

HarmonicSolver::~HarmonicSolver() = default;
HarmonicSolver::HarmonicSolver(HarmonicSolver&&) noexcept = default;

bool HarmonicSolver::factorise(double frequency, const Eigen::MatrixXcd& block)
{
    Implementation& s = *implementation_;
    assert(static_cast<std::size_t>(block.size()) == s.block_places.size());
    const auto n = static_cast<int>(s.stiffness.rows());
    s.real = s.stiffness.coeffs() - frequency * frequency * s.mass.coeffs();
    s.imaginary = frequency * s.damping.coeffs();
    for (std::size_t k = 0; k < s.block_places.size(); ++k) {
        const std::complex<double> value = block.data()[k];
        s.real[s.block_places[k]] += value.real();
        s.imaginary[s.block_places[k]] += value.imag();
    }
    const int *columns = s.stiffness.outerIndexPtr(), *rows = s.stiffness.innerIndexPtr();
    if (s.numeric) umfpack_zi_free_numeric(&s.numeric);
    if (!s.symbolic)
        umfpack_zi_symbolic(n, n, columns, rows, s.real.data(), s.imaginary.data(), &s.symbolic, s.control.data(),
                            nullptr);
    s.regular = s.symbolic && umfpack_zi_numeric(columns, rows, s.real.data(), s.imaginary.data(), s.symbolic,
                                                 &s.numeric, s.control.data(), nullptr) == UMFPACK_OK;
    return s.regular;
}

Eigen::VectorXcd HarmonicSolver::solve(const Eigen::VectorXcd& right_hand_side) const
{
    const Implementation& s = *implementation_;
    assert(s.regular && right_hand_side.size() == s.stiffness.rows());
    const Eigen::VectorXd b = right_hand_side.real(), c = right_hand_side.imag();
    Eigen::VectorXd x(b.size()), y(b.size());
    umfpack_zi_solve(UMFPACK_A, s.stiffness.outerIndexPtr(), s.stiffness.innerIndexPtr(), s.real.data(),
                     s.imaginary.data(), x.data(), y.data(), b.data(), c.data(), s.numeric, s.control.data(), nullptr);
    Eigen::VectorXcd solution(b.size());
    solution.real() = x;
    solution.imag() = y;
    return solution;
}

} // namespace damslip::fe2d
