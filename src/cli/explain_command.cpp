#include "cli/explain_command.hpp"

#include "cli/fe_inputs.hpp"
#include "cli/fe_output.hpp"
#include "cli/usage_error.hpp"
#include "report/table_text.hpp"
#include "scene/effect_plan.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

namespace damslip::cli {

Table effect_table(const EffectPlan& plan)
{
    Table table;
    table.title = plan.method == Method::rigid_block ? "Effect plan, rigid block" : "Effect plan, finite elements";
    table.columns = {
        {"effect", "effect", "", 4}, {"on", "on", "", 4}, {"reason", "because", "", 4}, {"cost", "cost", "", 4}};
    for (const PlannedEffect& e : plan.effects) table.rows.push_back({e.name, e.on, e.reason, e.cost});
    return table;
}

namespace {

/// Counts of the FE model that a run of this scene would hold, from the assembled matrices themselves; nothing for the rigid block.
std::optional<Table> model_table(const Scene& scene, const EffectPlan& plan)
{
    if (plan.method != Method::finite_elements) return std::nullopt;
    fe2d::ModelOptions options;
    options.added_mass = added_mass_law(scene);
    return count_table(fe2d::build_model(called_for(plan, scene), options).counts);
}

} // namespace

int explain(const ExplainArguments& arguments, const Streams& streams)
{
    const Scene scene = read_scene(arguments.scene);
    const EffectPlan plan =
        make_effect_plan(scene, arguments.method == "fe" ? Method::finite_elements : Method::rigid_block);
    const Table table = effect_table(plan);
    const std::optional<Table> model = model_table(scene, plan);
    if (streams.form == Form::json) {
        auto j = json_header("explain");
        j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(scene)}};
        j["method"] = arguments.method;
        j["effects"] = json_of(table);
        if (model) j["model"] = json_of(*model);
        streams.out << j.dump(2) << "\n";
        return exit_ok;
    }
    const auto on =
        std::count_if(plan.effects.begin(), plan.effects.end(), [](const PlannedEffect& e) { return e.on; });
    streams.out << scene.title << "\n\n"
                << report::text(table)
                << fmt::format("\n{} of {} effects on; the others are neither read, built nor stored.\n", on,
                               plan.effects.size());
    if (model)
        streams.out << "\n"
                    << report::text(*model)
                    << "  tied base; `damslip fe` without --base tied keeps both sides of the contact plane.\n";
    return exit_ok;
}

} // namespace damslip::cli
