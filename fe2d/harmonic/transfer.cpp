#include "fe2d/harmonic/transfer.hpp"

#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/fluid/face_coupling.hpp"
#include "fe2d/harmonic/harmonic_solver.hpp"

#include <numbers>

namespace damslip::fe2d {

std::vector<TransferPoint> transfer_functions(const Model& model, const StructureSystem& structure,
                                              const FluidModel* water, const std::vector<double>& frequencies)
{
    const Eigen::Index n = structure.system.size();
    CoupledSystem system;
    if (water) {
        const SparseMatrix coupling =
            face_coupling(model.mesh, model.dofs, water->reservoir, water->dofs, water->unknowns());
        system = couple(structure.system.mass, structure.system.damping, structure.system.stiffness,
                        SparseMatrix(coupling.topRows(n)), *water);
    } else {
        system.mass = structure.system.mass;
        system.damping = structure.system.damping;
        system.stiffness = structure.system.stiffness;
        system.structure_unknowns = n;
        system.velocity_x = Eigen::VectorXd::Zero(n);
    }
    HarmonicSolver solver(system.mass, system.damping, system.stiffness);
    const int crest = model.dofs(model.mesh.crest.back(), 0);
    std::vector<TransferPoint> points;
    for (const double frequency : frequencies) {
        TransferPoint point;
        point.frequency = frequency;
        const double w = 2.0 * std::numbers::pi * frequency;
        const std::complex<double> rate(0.0, w);
        point.regular = solver.factorise(w);
        if (point.regular) {
            Eigen::VectorXcd load = system.velocity_x.cast<std::complex<double>>() / rate;
            load.head(n) -= model.inertia_x.head(n);
            const Eigen::VectorXcd z = solver.solve(load);
            point.crest = 1.0 - w * w * z[crest];
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
