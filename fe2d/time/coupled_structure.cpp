#include "fe2d/time/coupled_structure.hpp"

#include "fe2d/fluid/face_coupling.hpp"
#include "records/measure/response_spectrum.hpp"

#include <cassert>
#include <numbers>

namespace damslip::fe2d {

CoupledPencil coupled_pencil(const Model& model, const FluidModel& water)
{
    assert(model.added_mass.nonZeros() == 0);
    FluidOptions closed = water.options;
    closed.far_end = FarEnd::closed;
    closed.surface = WaterSurface::free;
    closed.bottom_reflection = 1.0;
    closed.bottom_motion = BottomMotion::still;
    const FluidModel basin = build_fluid(water.reservoir, closed);
    CoupledPencil pencil;
    pencil.stiffness = model.stiffness;
    pencil.mass = model.mass;
    pencil.coupling = face_coupling(model.mesh, model.dofs, basin.reservoir, basin.dofs, basin.unknowns());
    pencil.water_stiffness = basin.stiffness;
    pencil.water_mass = basin.mass;
    pencil.inertia_x = model.inertia_x;
    pencil.inertia_y = model.inertia_y;
    pencil.flux_x = basin.flux_x;
    pencil.flux_y = basin.flux_y;
    pencil.structure_mass = model.total_mass;
    return pencil;
}

std::vector<ModalMass> leading_modal_masses(const CoupledModes& modes, int count)
{
    std::vector<ModalMass> masses;
    for (const Eigen::Index k : leading_modes(modes, count))
        masses.push_back({2.0 * std::numbers::pi * modes.frequency[k], modes.effective_mass(0, k)});
    return masses;
}

DampingChoice damping_of(const Scene& scene, const Model& model, const FluidModel& water, const GroundMotion& motion)
{
    const int count = modes_needed(scene.damping);
    if (count == 0) return choose_damping(scene.damping, {}, model.total_mass.x(), {});
    const CoupledModes modes = coupled_modes_up_to(coupled_pencil(model, water), 0.0, count);
    const SpectralAcceleration spectrum = [&](double frequency, double ratio) {
        return records::peak_absolute_acceleration(motion.accel_h, motion.dt, frequency / (2.0 * std::numbers::pi),
                                                   ratio);
    };
    return choose_damping(scene.damping, leading_modal_masses(modes, count), modes.total_mass.x(), spectrum);
}

} // namespace damslip::fe2d
