#include "cli/explain_command.hpp"

#include "analysis/fe/contact_cost.hpp"
#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/tied_scheme.hpp"
#include "cli/ablate_command.hpp"
#include "core/usage_error.hpp"
#include "pages/fe/acoustic_modes.hpp"
#include "pages/fe/fe_output.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/effect_table.hpp"
#include "scene/effect_plan.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

namespace damslip::cli {

using namespace pages;

namespace {

/// Pairs of nodes of every lift joint.
Table joint_table(const Scene& scene, const fe2d::Mesh& mesh)
{
    Table t;
    t.title = "Lift joints";
    t.columns = {{"joint", "joint", "", 4},
                 {"elevation_m", "elevation", "m", 5},
                 {"length_m", "length", "m", 5},
                 {"pairs", "contact pairs", "", 4}};
    for (std::size_t i = 0; i < scene.lift_joints.size(); ++i)
        t.rows.push_back({scene.lift_joints[i].name, scene.lift_joints[i].elevation, mesh.lifts[i].distance.back(),
                          static_cast<std::int64_t>(mesh.lifts[i].upper_nodes.size())});
    return t;
}

struct ModelTables {
    Table counts, joints;
};

/// Counts of the FE model that a run of this scene would hold, from the assembled matrices themselves; nothing for the rigid block.
std::optional<ModelTables> model_tables(const Ready& ready)
{
    if (ready.plan.method != Method::finite_elements) return std::nullopt;
    const fe2d::Model model = fe2d::build_model(ready.scene, ready.model_options());
    std::optional<fe2d::FluidModel> water;
    if (ready.plan.on(Effect::acoustic_water) && ready.scene.reservoir->level > 0)
        water = fe2d::build_fluid(ready.scene);
    return ModelTables{count_table(model.counts, water ? &*water : nullptr), joint_table(ready.scene, model.mesh)};
}

/// The scene's records for the estimate of seconds; none where a file is not there, which only a run has to have.
Records records_at_hand(const Scene& scene, Method method)
{
    for (const RecordFiles& r : scene.motion.records)
        if (!std::filesystem::exists(r.horizontal)) return nullptr;
    return method == Method::finite_elements ? load_records(scene, method) : nullptr;
}

/// How the water takes part, by the computed first frequency where the scene leaves it open, and what its length and end are good for.
std::vector<std::string> water_notes(const Ready& ready)
{
    const Scene& scene = ready.given;
    std::vector<std::string> notes;
    if (ready.plan.method != Method::finite_elements || !scene.reservoir || scene.reservoir->level <= 0) return notes;
    if (ready.reservoir) notes.push_back(ready.reservoir->reason + "; --reduced takes added mass");
    if (scene.reservoir->model == ReservoirModel::acoustic)
        for (std::string& warning : reservoir_warnings(scene, 20.0)) notes.push_back(std::move(warning));
    return notes;
}

nlohmann::ordered_json cost_json(const ContactCost& cost)
{
    nlohmann::ordered_json j;
    j["parts"] = json_of(cost.parts);
    j["factorisations"] = {{"set_up", cost.parts.rows.size() - 2}, {"by_step_size", 1}};
    j["set_up_seconds"] = cost.set_up_seconds;
    j["seconds_per_step"] = nullptr;
    if (cost.seconds_per_step) j["seconds_per_step"] = *cost.seconds_per_step;
    j["records"] = json_of(cost.records);
    return j;
}

std::string cost_text(const ContactCost& cost)
{
    std::string text =
        pages::text(cost.parts) +
        fmt::format("  {} factorisation{} in the set-up, one for each step size after it; no step "
                    "factorises anew.\n  measured here: set-up {:.2g} s",
                    cost.parts.rows.size() - 2, cost.parts.rows.size() == 3 ? "" : "s", cost.set_up_seconds);
    text += cost.seconds_per_step ? fmt::format(", {:.2g} ms a step of strong shaking.\n", 1e3 * *cost.seconds_per_step)
                                  : ".\n";
    return cost.records.rows.empty() ? text : text + "\n" + pages::text(cost.records);
}

} // namespace

int explain(const ExplainArguments& arguments, const Streams& streams)
{
    if (arguments.ablate) return ablate(arguments, streams);
    const Scene scene = read_run_scene(arguments.inputs, streams);
    if (arguments.method == "fe")
        need_section(scene, "damslip explain --method fe", "leave --method out: the wedge is rigid");
    const std::string hash = scene_hash(scene);
    const Method method = arguments.method == "fe" ? Method::finite_elements : Method::rigid_block;
    const Ready ready = prepare(scene, method, records_at_hand(scene, method), {.stop = streams.stop});
    const EffectPlan& plan = ready.plan;
    const Table table = effect_table(plan);
    const std::optional<ModelTables> model = model_tables(ready);
    std::optional<ContactCost> cost;
    if (method == Method::finite_elements) cost = contact_cost(ready);
    std::vector<std::string> notes = note_texts(scene.notes);
    for (std::string& note : water_notes(ready)) notes.push_back(std::move(note));
    if (plan.method == Method::finite_elements) notes.push_back(time_scheme_note(scene));
    if (streams.form == Form::json) {
        auto j = json_header("explain");
        j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", hash}};
        j["method"] = arguments.method;
        j["effects"] = json_of(table);
        if (model) j["model"] = json_of(model->counts);
        if (model && !model->joints.rows.empty()) j["lift_joints"] = json_of(model->joints);
        if (cost) j["contact"] = cost_json(*cost);
        if (!notes.empty()) j["notes"] = notes;
        streams.out << j.dump(2) << "\n";
        return exit_ok;
    }
    const auto on =
        std::count_if(plan.effects.begin(), plan.effects.end(), [](const PlannedEffect& e) { return e.on; });
    streams.out << scene.title << "\n\n"
                << pages::text(table)
                << fmt::format("\n{} of {} effects on; the others are neither read, built nor stored.\n", on,
                               plan.effects.size());
    if (model)
        streams.out << "\n"
                    << pages::text(model->counts)
                    << "  tied base; `damslip fe` without --base tied keeps both sides of the contact plane.\n";
    if (model && !model->joints.rows.empty()) streams.out << "\n" << pages::text(model->joints);
    if (cost) streams.out << "\n" << cost_text(*cost);
    for (const std::string& note : notes) streams.out << "note: " << note << "\n";
    return exit_ok;
}

} // namespace damslip::cli
