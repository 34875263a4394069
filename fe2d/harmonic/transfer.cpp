#include "fe2d/harmonic/transfer.hpp"

#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/fluid/face_coupling.hpp"
#include "fe2d/harmonic/harmonic_solver.hpp"
#include "fe2d/solver/dense_algebra.hpp"
#include "fe2d/time/structure_system.hpp"

#include <Eigen/QR>

#include <numbers>

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

} // namespace damslip::fe2d
