#include "analysis/sweep/sweep_grid.hpp"

#include "core/parallel.hpp"
#include "scene/rock_mass.hpp"
#include "scene/scene_text.hpp"

namespace damslip {

namespace {

/// What a run of the method stands on: the scene's rock, or what its law puts in place of it.
std::string rock_of(const Scene& scene, const SweepMethod& method)
{
    if (method.kind != SweepKind::finite_elements) return "";
    const Scene here = with_law(scene, method.law, {});
    return rock_words(called_for(make_effect_plan(here, Method::finite_elements), here));
}

/// The mode of the flexible block in each variant, as the scene of the rigid block has it.
void find_modes(Grid& grid, const Scene& scene)
{
    const TaskList& tasks = grid.tasks;
    for (std::size_t i = 0; i < tasks.variants(); ++i) {
        const Scene given = variant_of(scene, grid.axes, tasks.index(i * tasks.rows_of_model()));
        Scene here = called_for(make_effect_plan(given, Method::rigid_block), given);
        resolve_flexible_modes(here);
        grid.flexible.push_back(flexible_block(here));
    }
}

/// Rigid models of one variant, friction after friction: what does not depend on it is made once.
class VariantModels {
public:
    /// @param vary_friction  of what the block slides on
    VariantModels(Scene given, const Records& records, const PrepareOptions& options, bool vary_friction)
        : vary_friction_(vary_friction), ready_(prepare(std::move(given), Method::rigid_block, records, options)),
          profile_(ready_.seepage->profile_of(ready_.scene)), here_(ready_.scene)
    {
    }

    RigidModel at(double friction)
    {
        here_.contact = ready_.scene.contact;
        here_.wedge = ready_.scene.wedge;
        const bool on_plane = !here_.planes.slides_on.empty();
        if (on_plane) {
            here_.seams = ready_.scene.seams;
            here_.lifts = ready_.scene.lifts;
            here_.lift_joints = ready_.given.lift_joints; // they replace lifts
        }
        if (vary_friction_ && (on_plane || friction != ready_.given.contact.friction)) {
            if (!on_plane && !ready_.given.contact.friction_table.empty()) set_friction(ready_.given, friction); // refuses
            set_friction(here_, friction);
        }
        return make_rigid_model(here_, profile_, std::nullopt, ready_.statics.get());
    }

private:
    bool vary_friction_;
    Ready ready_;
    sliding::SeepageProfile profile_;
    Scene here_;
};

} // namespace

Scene variant_of(const Scene& scene, const Axes& axes, const GridIndex& at)
{
    Scene here = with_opening_water(
        variant(scene, axes.level[at.level], axes.uplift[at.uplift], axes.reservoir[at.reservoir], axes.size[at.size]),
        axes.opening[at.opening]);
    const auto value = [](const std::vector<double>& axis, std::size_t i) {
        return axis.empty() ? std::nullopt : std::optional(axis[i]);
    };
    here.planes.slides_on = axes.plane[at.plane];
    return with_mode(std::move(here), value(axes.period, at.period), value(axes.damping, at.damping));
}

Grid begin_grid(const Scene& scene, const Axes& axes, const TaskList& tasks, const Records& records)
{
    Grid grid;
    grid.axes = axes;
    grid.tasks = tasks;
    for (std::size_t i = 0; i < axes.size.size(); ++i) grid.seepage.push_back(std::make_shared<SeepageSource>());
    for (std::size_t i = 0; i < tasks.variants(); ++i) grid.statics.push_back(std::make_shared<KeptStatics>());
    hold_models(grid, scene, records, 0, 0, 1);
    for (const SweepMethod& method : axes.method) grid.rocks.push_back(rock_of(scene, method));
    for (const Anchor& anchor : scene.anchors) grid.anchors.push_back(anchor.name);
    if (axes.flexible()) find_modes(grid, scene);
    for (const RecordPair& pair : *records) {
        grid.records.push_back(pair.files.name);
        if (!pair.parts.empty()) grid.events.clear();
        for (const RecordPair& part : pair.parts) grid.events.push_back(part.files.name);
        for (const double scale : axes.scale) {
            const GroundMotion motion = ground_motion(scene, pair, scale);
            grid.measured.push_back(regression_inputs(pair, motion, grid.models.front(), scene.regressions.period));
            grid.horizontal_motions.emplace_back(horizontal_only(motion));
            grid.motions.emplace_back(motion);
        }
    }
    for (std::size_t i = 0; i < tasks.motions(); ++i)
        grid.pgas.push_back(grid.inputs_of(tasks.index(i * tasks.method)).pga_g * units::standard_gravity);
    return grid;
}

void hold_models(Grid& grid, const Scene& scene, const Records& records, std::size_t first, std::size_t last, int jobs)
{
    const Axes& axes = grid.axes;
    const TaskList& tasks = grid.tasks;
    grid.first_friction = first;
    const std::size_t variants = tasks.variants(), frictions = last - first + 1;
    grid.models.clear();
    grid.models.resize(frictions * variants);
    const auto threads = static_cast<std::size_t>(thread_count(jobs));
    const std::size_t parts = std::min(frictions, (threads + variants - 1) / variants); // of the frictions of a variant
    parallel_for(variants * parts, jobs, [&](std::size_t i) {
        const std::size_t part = i / variants, v = i % variants;
        const GridIndex at = tasks.index(v * tasks.rows_of_model());
        PrepareOptions options;
        options.seepage = grid.seepage[at.size];
        options.statics = grid.statics[v];
        VariantModels models(variant_of(scene, axes, at), records, options, axes.plane_friction.empty());
        for (std::size_t k = part * frictions / parts; k < (part + 1) * frictions / parts; ++k)
            grid.models[k * variants + v] = models.at(axes.friction[first + k]);
    });
}

Grid make_grid(const Scene& scene, const Axes& axes, const TaskList& tasks, const Records& records, int jobs)
{
    Grid grid = begin_grid(scene, axes, tasks, records);
    if (axes.friction.size() > 1) hold_models(grid, scene, records, 0, axes.friction.size() - 1, jobs);
    return grid;
}

namespace {

void scale(std::optional<double>& length, double factor)
{
    if (length) *length *= factor;
}

void scale_rock(Scene& scene, double factor)
{
    if (scene.foundation) {
        scene.foundation->width *= factor;
        scene.foundation->depth *= factor;
        for (Point& p : scene.foundation->ground) p = {p.x * factor, p.y * factor};
    }
    if (scene.curtain) {
        scene.curtain->distance *= factor;
        scene.curtain->depth *= factor;
        scene.curtain->thickness *= factor;
    }
    if (scene.drains) {
        scene.drains->distance *= factor;
        scale(scene.drains->depth, factor);
        scale(scene.drains->gallery_level, factor);
    }
    if (scene.uplift)
        for (Point& p : scene.uplift->points) p.x *= factor; // y is a share of the pressure at the heel
}

void scale_water(Scene& scene, double factor)
{
    if (scene.reservoir) {
        scene.reservoir->level *= factor;
        scene.reservoir->length *= factor;
        scale(scene.reservoir->mesh_size, factor);
    }
    if (scene.gate) scene.gate->top *= factor;
    if (scene.tailwater) scene.tailwater->level *= factor;
    if (scene.silt) scene.silt->level *= factor;
    if (scene.ice) scene.ice->level *= factor;
}

void scale_planes(Scene& scene, double factor)
{
    for (LiftJoint& joint : scene.lift_joints) joint.elevation *= factor;
    if (scene.lifts) {
        Lifts& lifts = *scene.lifts;
        for (std::optional<double>* length :
             {&lifts.spacing, &lifts.from, &lifts.to, &lifts.drains_distance, &lifts.gallery_level})
            scale(*length, factor);
        for (double& elevation : lifts.elevations) elevation *= factor;
        for (Point& p : lifts.points) p.x *= factor; // y is an amplification
    }
    for (Seam& seam : scene.seams) {
        for (Point& p : seam.points) p = {p.x * factor, p.y * factor};
        scale(seam.depth, factor);
        for (Point& p : seam.uplift_points) p.x *= factor;
        if (seam.wedge) seam.wedge->distance *= factor;
    }
}

} // namespace

Scene sized(Scene scene, double factor)
{
    if (factor == 1.0) return scene;
    for (Point& p : scene.section.polygon) p = {p.x * factor, p.y * factor};
    for (Point& p : scene.section.thickness) p.x *= factor;
    scale_rock(scene, factor);
    scale_water(scene, factor);
    for (PointForce& force : scene.forces) force.at = {force.at.x * factor, force.at.y * factor};
    scale_planes(scene, factor);
    for (Anchor& anchor : scene.anchors) { // forces with the weight, so that the anchored dam stays similar
        anchor.distance *= factor;
        anchor.free_length *= factor;
        anchor.area *= factor * factor;
        anchor.prestress *= factor * factor;
    }
    for (Combination& c : scene.combinations) {
        scale(c.reservoir_level, factor);
        scale(c.tailwater_level, factor);
        for (Point& p : c.k_profile) p.x *= factor;
    }
    scale(scene.mesh.size, factor);
    scale(scene.mesh.contact_size, factor);
    scale(scene.mesh.rock_contact_size, factor);
    scale(scene.mesh.rock_size, factor);
    scene.mesh.file_unit *= factor;
    return scene;
}

} // namespace damslip
