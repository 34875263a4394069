#include "analysis/fe/mesh_error.hpp"

#include "analysis/fe/contact_runs.hpp"
#include "core/input_error.hpp"
#include "scene/mesh_sizes.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

constexpr double twice = 2.0; ///< the size of all elements

void no_answer(Status status, const std::string& message, MeshError& result)
{
    result.check = MeshCheck::no_answer;
    result.reason =
        fmt::format("the mesh's part of the error is not known: on elements of twice the size the run ends \"{}\" ({})",
                    word(status), message);
}

} // namespace

CoarserMesh::CoarserMesh(const Ready& ready, bool wanted, Answer progress, Watch& watch, int modes)
    : ready_(ready), wanted_(wanted), progress_(std::move(progress)), watch_(watch), modes_(modes)
{
}

/// What can be said without a run.
bool CoarserMesh::known_to_fail(Status status, double step_error, MeshError& result) const
{
    if (status != Status::at_rest || std::isnan(step_error)) {
        result.check = MeshCheck::no_slip;
        if (status_row(status).slip != SlipMeaning::none)
            result.reason =
                "step only: elements of twice the size are run for slips that are final and within the step's "
                "tolerance";
    } else if (!wanted_) {
        result.check = MeshCheck::left_out;
        result.reason = "step only: --no-mesh-error";
    } else if (ready_.scene.mesh.file) {
        result.check = MeshCheck::imported;
        result.reason = "step only: the mesh is imported (mesh.file)";
    } else if (elements_on_base(ready_.scene) < twice * least_elements) {
        result.check = MeshCheck::too_coarse;
        result.reason = fmt::format("step only: elements of twice the size would leave fewer than {:g} on the base",
                                    least_elements);
    } else
        return false;
    return true;
}

/// The model on the coarser mesh. @returns false where there is none, with the reason
bool CoarserMesh::make(MeshError& result, bool reduced)
{
    const std::lock_guard lock(mutex_); // others who need the same model wait for it
    if (!full_ && why_not_.empty()) {
        Scene scene = ready_.scene;
        scale_mesh(twice, scene);
        const Ready coarse = ready_.with(std::move(scene));
        try {
            fe2d::RunOptions options = coarse.run_options(watch_);
            options.progress = progress_;
            options.reducing_rock = tell_of_large_box(watch_);
            full_ = std::make_unique<const fe2d::EarthquakeRun>(coarse.scene, options);
            if (reduced) reduced_ = std::make_unique<const fe2d::ReducedRun>(*full_, coarse.scene, options, modes_);
        } catch (const Interrupted& stopped) { // the run it was for is finished: its slip is kept
            full_.reset();
            no_answer(Status::interrupted, stopped.what(), result);
            return false;
        } catch (const InputError& error) {
            const std::string& problem = error.diagnostics().front().problem;
            why_not_ = "step only: no mesh of elements of twice the size: " + problem;
        } catch (const NotConverged& error) {
            why_not_ = "step only: no model on elements of twice the size: " + error.diagnostic().problem;
        }
    }
    if (why_not_.empty()) return true;
    result.check = MeshCheck::too_coarse;
    result.reason = why_not_;
    return false;
}

MeshError CoarserMesh::error_of(const fe2d::EarthquakeRun& model, const fe2d::RunResult& run,
                                const GroundMotion& motion)
{
    MeshError result;
    const bool few_modes = run.modes > 0;
    if (known_to_fail(run.status, run.slip_error, result) || !make(result, few_modes)) return result;
    const fe2d::RunResult coarse =
        few_modes ? reduced_->run(motion, {}, run.halvings, fe2d::TruncationEstimate::left_out)
                  : full_->run_at(motion, model.steps_of(run));
    if (coarse.status != Status::at_rest || coarse.lifts.size() != run.lifts.size()) {
        no_answer(coarse.status, text_of(coarse.notes), result);
        return result;
    }
    result.check = MeshCheck::done;
    result.base = std::abs(run.slip - (run.correction ? run.correction->slip : 0.0) - coarse.slip); // at the same steps
    for (std::size_t k = 0; k < run.lifts.size(); ++k)
        result.lifts.push_back(std::abs(run.lifts[k].slip - coarse.lifts[k].slip));
    return result;
}

void scale_mesh(double factor, Scene& scene)
{
    const MeshSizes sizes = mesh_sizes(scene);
    scene.mesh.size = factor * sizes.dam;
    scene.mesh.contact_size = factor * sizes.contact;
    if (scene.mesh.rock_contact_size) *scene.mesh.rock_contact_size *= factor;
    if (scene.mesh.rock_size) *scene.mesh.rock_size *= factor;
    scene.mesh.growth = 1.0 + factor * (scene.mesh.growth - 1.0);
    if (has_water(scene)) scene.reservoir->mesh_size = factor * water_mesh_size(*scene.reservoir);
}

double elements_on_base(const Scene& scene)
{
    return base_length(scene.section) / mesh_sizes(scene).contact;
}

} // namespace damslip
