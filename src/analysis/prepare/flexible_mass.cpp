#include "analysis/prepare/flexible_mass.hpp"

#include "analysis/prepare/reservoir.hpp"
#include "core/input_error.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "fe2d/time/structure_system.hpp"
#include "scene/effect_plan.hpp"
#include "scene/section.hpp"
#include "sliding/flexible/flexible_mode.hpp"
#include "sliding/loads/added_mass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip {

void refuse_modes(const Scene& scene, const std::string& what)
{
    throw NotConverged(
        Diagnostic{scene.file.string(), 0, 0, what, "modes of the dam on a bonded base", "see  damslip modes SCENE"});
}

namespace {

/// Force of still water that the ground pushes with -1 m/s^2: H L^-1 flux.
Eigen::VectorXd static_water(const Scene& scene, const fe2d::CoupledPencil& pencil, const Eigen::VectorXd& flux)
{
    fe2d::LinearSolver solver;
    if (!solver.factorise(pencil.water_stiffness).ok()) refuse_modes(scene, "the water: " + text_of(solver.report().note()));
    return pencil.coupling * solver.solve(flux);
}

} // namespace

ModalForces modal_forces(const Scene& scene, const fe2d::Model& model, const fe2d::NaturalModes& modes,
                         const fe2d::CoupledModes* coupled, const fe2d::FluidModel* water, ModalDirection direction)
{
    ModalForces f;
    Eigen::MatrixXd shape;
    const Eigen::Index axis = direction == ModalDirection::horizontal ? 0 : 1;
    Eigen::VectorXd participation, rigid = axis == 0 ? model.inertia_x : model.inertia_y;
    f.frequency = coupled ? coupled->frequency : modes.frequency;
    const Eigen::VectorXd omega_squared = (2.0 * std::numbers::pi * f.frequency).array().square();
    if (coupled) {
        const fe2d::CoupledPencil pencil = fe2d::coupled_pencil(model, *water);
        shape = coupled->displacement;
        const Eigen::VectorXd& flux = axis == 0 ? pencil.flux_x : pencil.flux_y;
        participation = shape.transpose() * rigid;
        participation += ((coupled->pressure.transpose() * flux).array() / omega_squared.array()).matrix();
        rigid += static_water(scene, pencil, flux);
        f.total_mass = coupled->total_mass[axis];
    } else {
        shape = modes.shape;
        participation = modes.participation.row(axis).transpose();
        f.total_mass = model.total_mass[axis];
    }
    if (f.frequency.size() == 0) refuse_modes(scene, "the dam has no mode.");
    f.effective_mass = participation.array().square();
    const Eigen::VectorXd factor = participation.array() / omega_squared.array();
    f.displacement = shape * factor.asDiagonal();
    f.force = model.stiffness * f.displacement;
    f.residual = rigid - f.force.rowwise().sum();
    f.residual_mass = f.total_mass - f.effective_mass.sum();
    return f;
}

std::vector<Unknown> unknowns_of(const fe2d::Model& model)
{
    std::vector<Unknown> list(static_cast<std::size_t>(model.dofs.count));
    for (int node = 0; node < model.mesh.node_count(); ++node)
        for (int c = 0; c < 2; ++c)
            if (const int dof = model.dofs(node, c); dof != fe2d::no_dof)
                list[static_cast<std::size_t>(dof)] = {model.mesh.nodes[static_cast<std::size_t>(node)], c};
    return list;
}

namespace {

/// Dam and the water that moves with it, horizontally [kg/m].
double moving_mass(const Scene& scene)
{
    const std::optional<double> level = scene.reservoir ? std::optional(scene.reservoir->level) : std::nullopt;
    return scene.dam.density * area(scene.section) + sliding::scene_added_mass(scene, level).xx;
}

sliding::StrainColumn column_of(const FlexibleMass& mass)
{
    return {*mass.height, *mass.shear_velocity, mass.damping_ratio, mass.base_velocity.value_or(0.0),
            mass.reference_strain.value_or(0.0)};
}

double mass_ratio(const Scene& scene, double otherwise)
{
    const FlexibleMass& m = *scene.flexible_block;
    if (m.mass_ratio) return *m.mass_ratio;
    if (m.shape_exponent) return sliding::power_shape(scene, *m.shape_exponent).mass_ratio();
    if (m.modal_load && m.modal_mass) return *m.modal_load * *m.modal_load / (moving_mass(scene) * *m.modal_mass);
    return otherwise;
}

} // namespace

bool has_laws_of_rigid_blocks(const Scene& scene)
{
    return !scene.anchors.empty() || scene.contact.rate.active() || scene.contact.restitution > 0.0 ||
           !scene.motion.sequence.empty();
}

std::optional<sliding::FlexibleBlock> flexible_block(const Scene& scene)
{
    sliding::FlexibleBlock block;
    if (!scene.flexible_block) {
        if (scene.regressions.period <= 0.0 || scene.wedge || has_laws_of_rigid_blocks(scene)) return std::nullopt;
        block.period = scene.regressions.period;
        return block;
    }
    block.period = scene.flexible_block->period.value_or(scene.regressions.period);
    block.damping_ratio = scene.flexible_block->damping_ratio;
    block.mass_ratio = mass_ratio(scene, block.mass_ratio);
    if (scene.flexible_block->height) {
        sliding::StrainColumn column = column_of(*scene.flexible_block);
        column.reference_strain = 0.0;
        return strain_compatible(column, GroundMotion{}, block.mass_ratio).block;
    }
    return block;
}

std::optional<sliding::StrainCompatible> column_under(const Scene& scene, const sliding::FlexibleBlock& flexible,
                                                      const GroundMotion& motion)
{
    if (!scene.flexible_block || !scene.flexible_block->height) return std::nullopt;
    return strain_compatible(column_of(*scene.flexible_block), motion, flexible.mass_ratio);
}

std::string mass_ratio_words(const Scene& scene)
{
    if (!scene.flexible_block) return "of a uniform shear column, the default";
    const FlexibleMass& m = *scene.flexible_block;
    if (m.mass_ratio) return "as the scene gives it";
    if (m.shape_exponent) return fmt::format("of the shape (y/H)^{:.4g}, water included", *m.shape_exponent);
    if (m.modal_load) return "L²/(M M₁) of the scene's L and M₁";
    return "of a uniform shear column, the default";
}

sliding::FlexibleSlide slide_model(const Scene& scene, const sliding::FlexibleBlock& flexible, const RigidModel& model,
                                   const GroundMotion& motion, int polarity, FlexibleMethod method,
                                   sliding::HistoryOutput history)
{
    const sliding::SlideOptions options{scene.sliding, polarity, history};
    const std::optional<sliding::StrainCompatible> column = column_under(scene, flexible, motion);
    const sliding::FlexibleBlock& mode = column ? column->block : flexible;
    sliding::FlexibleSlide found = method == FlexibleMethod::coupled
                                       ? sliding::slide_coupled(motion, model.stages, mode, options)
                                       : sliding::slide_decoupled(motion, model.stages, mode, options);
    if (column && !column->settled) {
        found.slide.status = Status::not_resolved;
        found.slide.notes.push_back({NoteKind::strain_not_settled,
                                     {column->velocity, 100.0 * column->strain, std::int64_t{column->iterations}}});
        return found;
    }
    check_length(model, found.slide);
    check_tipping(model, std::max(found.peak_acceleration, peak_of(motion.accel_h)), found.slide);
    return found;
}

std::string resolve_flexible_modes(Scene& scene)
{
    if (!scene.flexible_block || !scene.flexible_block->of_modes) return "";
    Scene tied = called_for(make_effect_plan(scene, Method::finite_elements), scene);
    if (tied.reservoir && tied.reservoir->model == ReservoirModel::acoustic)
        tied.reservoir->model = ReservoirModel::added_mass;
    resolve_dam_period(tied);
    fe2d::ModelOptions options;
    options.added_mass = added_mass_law(tied);
    const fe2d::NaturalModes modes = fe2d::natural_modes(fe2d::build_model(tied, options), 5);
    if (modes.frequency.size() == 0)
        throw NotConverged(Diagnostic{scene.file.string(), 0, 0,
                                      "flexible_block.period_s = \"modes\": no mode was found: " + text_of(modes.solver.note()),
                                      "a model whose modes the solver finds", "give the period as a number"});
    Eigen::Index best = 0;
    for (Eigen::Index i = 1; i < modes.frequency.size(); ++i)
        if (modes.effective_share(0, i) > modes.effective_share(0, best)) best = i;
    FlexibleMass& mass = *scene.flexible_block;
    mass.period = 1.0 / modes.frequency[best];
    mass.mass_ratio = modes.effective_share(0, best);
    mass.of_modes = false;
    return fmt::format(
        "flexible_block.period_s = \"modes\": mode {} of the tied model{}, T_s = {:.5g} s, effective mass "
        "{:.4g} kg/m, mass ratio {:.4g}",
        best + 1, tied.reservoir ? " with added mass" : "", *mass.period, modes.effective_mass(0, best),
        *mass.mass_ratio);
}

} // namespace damslip
