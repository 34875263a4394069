#include "analysis/prepare/rock_water.hpp"

#include "core/input_error.hpp"
#include "fe2d/seepage/pore_forces.hpp"
#include "fe2d/seepage/seepage.hpp"

namespace damslip {

namespace {

/// Excess pore pressure at the nodes of the model, from the seepage on its own mesh [Pa].
Eigen::VectorXd pore_pressure_on(const Scene& scene, const fe2d::Model& model)
{
    const fe2d::SeepageResult seepage = fe2d::solve_seepage_on(model.mesh, scene, scene_uplift_state(scene));
    if (!seepage.field.solver.ok())
        throw NotConverged(Diagnostic{scene.file.string(), 0, 0,
                                      "the seepage below the dam could not be solved: " + seepage.field.solver.text(),
                                      "permeabilities within some ten orders of magnitude of each other",
                                      "check foundation.permeability_m_s and curtain.permeability_m_s"});
    return fe2d::excess_pore_pressure(seepage.field.head, seepage.unit_weight);
}

} // namespace

bool has_water_in_rock(const Scene& scene)
{
    return scene.stages.pore_pressure != PorePressure::none && scene.foundation.has_value();
}

Eigen::VectorXd rock_water_load(const Scene& scene, const fe2d::Model& model)
{
    if (!has_water_in_rock(scene)) return Eigen::VectorXd::Zero(model.dofs.count);
    return fe2d::pore_pressure_loads(model.mesh, model.dofs, pore_pressure_on(scene, model),
                                     scene.stages.pore_pressure);
}

Eigen::VectorXd water_in_rock(const Scene& scene, const fe2d::Model& model)
{
    if (!has_water_in_rock(scene)) return Eigen::VectorXd::Zero(model.dofs.count);
    return fe2d::water_in_rock(model.mesh, model.dofs, pore_pressure_on(scene, model), scene.stages.pore_pressure);
}

} // namespace damslip
