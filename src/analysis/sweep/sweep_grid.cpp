#include "analysis/sweep/sweep_grid.hpp"

#include "analysis/fe/contact_runs.hpp"
#include "analysis/prepare/plane_model.hpp"
#include "core/parallel.hpp"
#include "scene/rock_mass.hpp"
#include "scene/scene_text.hpp"
#include "scene/uplift_models.hpp"

#include <algorithm>
#include <cmath>

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
            restore_lift_joints(here_, ready_.given);
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
    Scene here =
        variant(scene, axes.level[at.level], axes.uplift[at.uplift], axes.reservoir[at.reservoir], axes.size[at.size]);
    for (const auto& [word, rule] : opening_waters())
        if (here.uplift && word == axes.opening[at.opening]) here.uplift->water.opening = rule;
    here.planes.slides_on = axes.plane[at.plane];
    if (!here.flexible_block && !(axes.period.empty() && axes.damping.empty())) here.flexible_block.emplace();
    if (!axes.period.empty()) {
        here.flexible_block->period = axes.period[at.period];
        here.flexible_block->of_modes = false;
    }
    if (!axes.damping.empty()) here.flexible_block->damping_ratio = axes.damping[at.damping];
    return here;
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

namespace {

/// Median and band of a regression; the status says what is the matter with them, if anything. A block that does not stand
/// has none.
RowResults regression_results(const sliding::Regression& regression, const sliding::RegressionInputs& inputs,
                              sliding::StaticState state)
{
    if (state != sliding::StaticState::at_rest) {
        RowResults none;
        none.status = word(sliding::status_of(state));
        return none;
    }
    const sliding::RegressionResult r = sliding::evaluate(regression, inputs);
    const auto metres = [](const std::optional<double>& value_cm) {
        return value_cm ? std::optional(*value_cm * units::cm) : std::nullopt;
    };
    RowResults results;
    results.slip = results.max_slip = metres(r.median_cm);
    results.slip_low = metres(r.minus_sd_cm);
    results.slip_high = metres(r.plus_sd_cm);
    if (r.status != sliding::RegressionStatus::ok) results.status = sliding::reason(r);
    return results;
}

sliding::SlideResult slide(const Scene& scene, const Grid& grid, const GridIndex& at,
                           const sliding::SkippingMotion& motion, sliding::HistoryOutput output)
{
    const int polarity = grid.axes.polarity[at.polarity];
    if (grid.axes.method[at.method].kind == SweepKind::rocking)
        return rock_model(scene, grid.model(at), motion.motion(), polarity, output).slide;
    if (const SweepKind kind = grid.axes.method[at.method].kind; is_flexible(kind))
        return slide_model(scene, *grid.flexible[grid.tasks.variant(at)], grid.model(at), motion.motion(), polarity,
                           kind == SweepKind::coupled ? FlexibleMethod::coupled : FlexibleMethod::decoupled, output)
            .slide;
    return slide_model(scene, grid.model(at), motion, polarity, output);
}

/// What has become of an anchor by the end: "snapped", "yielded" (at any time), else "elastic".
std::string anchor_end(const AnchorHistory& history)
{
    if (history.state == AnchorState::snapped) return "snapped";
    return history.plastic_strain > 0.0 ? "yielded" : "elastic";
}

/// Slip after each event of a sequence as far as it has one, and the anchors of a row that has a slip.
void add_events_and_anchors(const std::vector<EventSlip>& events, const std::vector<AnchorOutcome>& anchors,
                            RowResults& results)
{
    for (const EventSlip& event : events)
        if (reported(event.status, event.slip)) results.event_slips.push_back(event.slip);
    if (!results.slip) return;
    for (const AnchorOutcome& anchor : anchors)
        results.anchors.push_back({anchor.name, anchor.history.largest_force, anchor_end(anchor.history)});
}

void fill(const sliding::SlideResult& r, RowResults& results)
{
    results.slip = reported(r.status, r.slip);
    results.max_slip = reported(r.status, r.max_slip);
    results.upstream_slip = reported(r.status, r.upstream_slip);
    if (r.slip_error > 0.0) results.slip_error = reported(r.status, r.slip_error);
    results.status = word(r.status);
    add_events_and_anchors(r.events, r.anchors, results);
}

RowResults block_results(const Scene& scene, const Grid& grid, const GridIndex& at,
                         const sliding::SkippingMotion& motion, SlipHistory& history)
{
    const bool keep = grid.tasks.rows() <= most_rows_with_history;
    const sliding::SlideResult r =
        slide(scene, grid, at, motion, keep ? sliding::HistoryOutput::samples : sliding::HistoryOutput::none);
    if (keep && reported(r.status, r.slip)) history = slip_history(r.history.time, r.history.slip);
    RowResults results;
    fill(r, results);
    return results;
}

void finish(const Grid& grid, const GridIndex& at, FinishedRow& row)
{
    row.results.yield = grid.yield(at);
    row.results.critical_friction = grid.model(at).critical_friction;
    const std::optional<Status> status = status_of(row);
    row.good = !status || is_answer(*status); // others are remarks: the method does not apply
}

/// A plain block under the horizontal motion, without a history: rows of several frictions can go together.
bool may_go_together(const Grid& grid, const GridIndex& at)
{
    const SweepKind kind = grid.axes.method[at.method].kind;
    return (kind == SweepKind::rigid || (kind == SweepKind::rigid_vertical && grid.motion(at).has_vertical())) &&
           grid.tasks.rows() > most_rows_with_history;
}

/// Computes a row of the rigid block or of a regression. @param scene  for its [sliding] options
FinishedRow rigid_row(const Scene& scene, const Grid& grid, std::size_t id)
{
    const GridIndex at = grid.tasks.index(id);
    const SweepMethod& method = grid.axes.method[at.method];
    FinishedRow row{id, true, {}, {}};
    RowResults& results = row.results;
    if (method.kind == SweepKind::regression)
        results = regression_results(*sliding::find_regression(method.id), grid.inputs_of(at), grid.model(at).state);
    else if (method.kind == SweepKind::rigid)
        results = block_results(scene, grid, at, grid.horizontal(at), row.history);
    else if (method.kind == SweepKind::rocking && grid.model(at).wedge)
        results.status = "no block that rocks";
    else if (method.kind != SweepKind::rigid_vertical || grid.motion(at).has_vertical())
        results = block_results(scene, grid, at, grid.motion(at), row.history);
    else
        results.status = "no vertical component";
    finish(grid, at, row);
    return row;
}

} // namespace

void add_rigid_rows(const Scene& scene, const Grid& grid, std::span<const std::size_t> ids,
                    std::vector<FinishedRow>& rows)
{
    GridIndex at = grid.tasks.index(ids.front());
    if (!may_go_together(grid, at)) {
        for (const std::size_t id : ids) rows.push_back(rigid_row(scene, grid, id));
        return;
    }
    const std::size_t rows_of_friction = grid.tasks.rows() / grid.tasks.friction;
    std::vector<GridIndex> places;
    std::vector<const RigidModel*> models;
    for (const std::size_t id : ids) {
        at.friction = id / rows_of_friction;
        places.push_back(at);
        models.push_back(&grid.model(at));
    }
    const bool vertical = grid.axes.method[at.method].kind == SweepKind::rigid_vertical;
    const std::vector<sliding::SlideResult> slides =
        slide_models(scene, models, vertical ? grid.motion(at) : grid.horizontal(at), grid.axes.polarity[at.polarity]);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        FinishedRow& row = rows.emplace_back();
        row.id = ids[i];
        fill(slides[i], row.results);
        finish(grid, places[i], row);
    }
}

FinishedRow fe_row(std::size_t id, const fe2d::RunResult& run, bool with_history)
{
    RowResults results;
    results.slip = reported(run.status, run.slip);
    results.max_slip = reported(run.status, run.max_slip);
    results.slip_error = reported(run.status, run.slip_error);
    if (results.slip && run.modes > 0 && std::isfinite(run.truncation_error))
        results.truncation_error = run.truncation_error;
    if (!run.stages.empty() && std::isfinite(run.stages.back().critical_friction))
        results.critical_friction = run.stages.back().critical_friction;
    results.status = word(run.status);
    for (const fe2d::LiftResult& lift : run.lifts)
        if (results.slip) results.lift_slip = std::max(results.lift_slip.value_or(0.0), lift.largest_slip);
    results.slid_at_least = slid_at_least(run.status, run.slip);
    add_events_and_anchors(run.events, run.anchors, results);
    if (!run.history.time.empty()) { // it was shaken
        const fe2d::RunOutFigures& f = run.run_out;
        if (std::isfinite(f.thrust_over_friction)) results.thrust_over_friction = f.thrust_over_friction;
        results.lift_offs = f.lift_offs;
        results.lift_off_frequency = f.lift_off_frequency;
        results.unloaded_share = f.unloaded_share;
        results.end_rate = f.rate;
        results.slip_shaking = f.slip_shaking;
        results.slip_at_rest = f.slip_at_rest;
    }
    SlipHistory history;
    if (with_history && results.slip) history = slip_history(run.history.time, run.history.slip);
    return {id, is_answer(run.status), std::move(results), std::move(history)};
}

RowResults not_run()
{
    RowResults results;
    results.status = word(Status::interrupted);
    return results;
}

std::optional<Status> status_of(const FinishedRow& row)
{
    return status_of_word(row.results.status);
}

} // namespace damslip
