#include "analysis/sweep/sweep_grid.hpp"

#include "core/parallel.hpp"
#include "scene/rock_mass.hpp"
#include "scene/with_friction.hpp"

namespace damslip {

namespace {

/// What a run of the method stands on: the scene's rock, or what its law puts in place of it.
std::string rock_of(const Scene& scene, const SweepMethod& method)
{
    if (method.kind != SweepKind::finite_elements) return "";
    const Scene here = with_law(scene, method.law, {});
    return rock_words(called_for(make_effect_plan(here, Method::finite_elements), here));
}

} // namespace

Scene variant_of(const Scene& scene, const Axes& axes, const GridIndex& at)
{
    return with_opening_water(
        variant(scene, axes.level[at.level], axes.uplift[at.uplift], axes.reservoir[at.reservoir], axes.size[at.size]),
        axes.opening[at.opening]);
}

Grid make_grid(const Scene& scene, const Axes& axes, const TaskList& tasks, const Records& records, int jobs)
{
    Grid grid;
    grid.axes = axes;
    grid.tasks = tasks;
    std::vector<std::shared_ptr<SeepageSource>> seepage; // one serves one geometry
    for (std::size_t i = 0; i < axes.size.size(); ++i) seepage.push_back(std::make_shared<SeepageSource>());
    grid.models.resize(axes.friction.size() * tasks.variants());
    const std::size_t rows_of_model = tasks.motions() * tasks.method; // ids of one model are consecutive
    parallel_for(grid.models.size(), jobs, [&](std::size_t i) {
        const GridIndex at = tasks.index(i * rows_of_model);
        Scene here = variant_of(scene, axes, at);
        if (axes.friction[at.friction] != here.contact.friction)
            here = with_friction(std::move(here), axes.friction[at.friction]);
        PrepareOptions options;
        options.seepage = seepage[at.size];
        grid.models[i] = prepare(std::move(here), Method::rigid_block, records, options).rigid_model();
    });
    for (const SweepMethod& method : axes.method) grid.rocks.push_back(rock_of(scene, method));
    for (const RecordPair& pair : *records) {
        grid.records.push_back(pair.files.name);
        for (const double scale : axes.scale) {
            const GroundMotion motion = ground_motion(scene, pair, scale);
            grid.measured.push_back(regression_inputs(pair, motion, grid.models.front(), scene.regressions.period));
            grid.horizontal_motions.emplace_back(horizontal_only(motion));
            grid.motions.emplace_back(motion);
        }
    }
    return grid;
}

} // namespace damslip
