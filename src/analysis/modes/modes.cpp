#include "analysis/modes/modes.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "fe2d/damping/damping.hpp"
#include "fe2d/rock/radiating_rock.hpp"
#include "fe2d/time/structure_system.hpp"
#include "records/measure/response_spectrum.hpp"
#include "scene/rock_mass.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <numbers>

namespace damslip {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// The mode of a number from 1, or the last there is.
Eigen::Index mode_at(const fe2d::NaturalModes& modes, int number)
{
    return std::min<Eigen::Index>(number - 1, modes.frequency.size() - 1);
}

/// @param total_mass  in x [kg/m]
fe2d::ModifiedRayleigh modified_damping(const Scene& scene, double total_mass, const fe2d::NaturalModes& modes,
                                        const GroundMotion& motion)
{
    std::vector<fe2d::ModalMass> masses;
    for (Eigen::Index i = 0; i < modes.frequency.size(); ++i)
        masses.push_back({two_pi * modes.frequency[i], modes.effective_mass(0, i)});
    fe2d::ModifiedRayleighOptions options;
    options.ratio = scene.damping.ratio;
    options.first_mode = static_cast<std::size_t>(mode_at(modes, scene.damping.first_mode));
    options.ordinary_mode = static_cast<std::size_t>(mode_at(modes, scene.damping.second_mode));
    options.total_mass = total_mass;
    const auto spectral_acceleration = [&](double w, double ratio) {
        return records::peak_absolute_acceleration(motion.accel_h, motion.dt, w / two_pi, ratio);
    };
    return fe2d::modified_rayleigh(masses, spectral_acceleration, options);
}

std::optional<DampingOfModes> damping_of_modes(const Scene& scene, double total_mass, const fe2d::NaturalModes& modes,
                                               const std::vector<RecordPair>& records)
{
    if (modes.frequency.size() == 0 || scene.damping.ratio <= 0) return std::nullopt;
    DampingOfModes d;
    d.first_mode = mode_at(modes, scene.damping.first_mode);
    d.second_mode = mode_at(modes, scene.damping.second_mode);
    d.first_frequency = two_pi * modes.frequency[d.first_mode];
    d.second_frequency = two_pi * modes.frequency[d.second_mode];
    d.rayleigh = fe2d::rayleigh_constants(scene.damping.ratio, d.first_frequency, d.second_frequency);
    for (const RecordPair& pair : records)
        d.modified.push_back({pair.files.name, modified_damping(scene, total_mass, modes, ground_motion(scene, pair))});
    return d;
}

/// On the rock of the scene, as in tied runs; damped by Rayleigh's constants, where the scene damps at all.
void find_transfer(const Ready& ready, std::vector<double> frequencies, ModesResult& m)
{
    fe2d::RayleighConstants damping{};
    if (m.damping && m.scene.damping.method != DampingMethod::none) damping = m.damping->rayleigh;
    const fe2d::FluidModel* water = m.water ? &*m.water : nullptr;
    if (frequencies.empty())
        for (int k = 1; k <= 200; ++k) frequencies.push_back(0.1 * k);
    if (rock_radiates(m.scene)) {
        const fe2d::Mesh& mesh = m.model.mesh;
        m.radiating =
            fe2d::radiating_rock_of(m.scene, mesh, mesh.contact.rock_nodes, ready.wave_frequency(), cache_folder());
        if (!m.radiating->rock.report.passed())
            throw NotConverged(Diagnostic{m.scene.file.string(), 0, 0, text_of(m.radiating->rock.report.missed_gate()),
                                          "transfer functions on rock that is right", "or run without --frf"});
        const fe2d::RockBelow rock{m.radiating->rock, damping.stiffness};
        m.transfer =
            fe2d::transfer_functions(m.model, fe2d::dam_on_free_base(m.model, damping), water, frequencies, &rock);
        return;
    }
    const auto on = [&](const fe2d::Model& model) {
        return fe2d::transfer_functions(model, fe2d::structure_system(model, damping).system, water, frequencies);
    };
    if (!rock_is_boxed(m.scene)) {
        m.transfer = on(m.model);
        return;
    }
    fe2d::ModelOptions moving = ready.model_options();
    if (rock_edges_are_viscous(m.scene)) moving.edges = fe2d::RockEdges::free;
    m.transfer = on(fe2d::build_model(m.scene, moving));
}

} // namespace

fe2d::NaturalModes as_natural_modes(const fe2d::CoupledModes& modes, const std::vector<Eigen::Index>& leading)
{
    fe2d::NaturalModes natural;
    natural.frequency = modes.frequency(leading);
    natural.effective_mass = modes.effective_mass(Eigen::all, leading);
    natural.effective_share = modes.effective_share(Eigen::all, leading);
    return natural;
}

bool ModesResult::complete() const
{
    if (coupled) return coupled->status == fe2d::CoupledModesStatus::ok;
    return modes.status == fe2d::ModesStatus::ok || modes.status == fe2d::ModesStatus::no_mass;
}

ModesResult compute_modes(const Ready& ready, const ModesOptions& options)
{
    ModesResult m;
    m.scene = ready.scene;
    m.count = options.count;
    m.choice = ready.reservoir;
    m.period = ready.dam_period;
    m.model = fe2d::build_model(with_massless_rock(m.scene), ready.model_options());
    double total_mass = m.model.total_mass.x();
    if (is_acoustic(m.scene)) {
        m.water = fe2d::build_fluid(m.scene);
        const int leading = std::max({5, m.scene.damping.first_mode, m.scene.damping.second_mode});
        m.coupled = fe2d::coupled_modes_up_to(fe2d::coupled_pencil(m.model, *m.water), coupled_modes_to, leading);
        m.leading = fe2d::leading_modes(*m.coupled, leading);
        m.modes = as_natural_modes(*m.coupled, m.leading);
        total_mass = m.coupled->total_mass.x();
    } else {
        m.modes = fe2d::natural_modes(m.model, options.count.value_or(usual_modes));
    }
    if (options.damping || options.transfer)
        m.damping = damping_of_modes(m.scene, total_mass, m.modes, ready.records());
    if (options.transfer) find_transfer(ready, options.frequencies, m);
    return m;
}

} // namespace damslip
