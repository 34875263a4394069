#include "cli/explain_command.hpp"

#include "cli/usage_error.hpp"
#include "report/table_text.hpp"
#include "scene/effect_plan.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
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

int explain(const ExplainArguments& arguments, const Streams& streams)
{
    const Scene scene = read_scene(arguments.scene);
    const EffectPlan plan =
        make_effect_plan(scene, arguments.method == "fe" ? Method::finite_elements : Method::rigid_block);
    const Table table = effect_table(plan);
    if (streams.form == Form::json) {
        auto j = json_header("explain");
        j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(scene)}};
        j["method"] = arguments.method;
        j["effects"] = json_of(table);
        streams.out << j.dump(2) << "\n";
        return exit_ok;
    }
    const auto on =
        std::count_if(plan.effects.begin(), plan.effects.end(), [](const PlannedEffect& e) { return e.on; });
    streams.out << scene.title << "\n\n"
                << report::text(table)
                << fmt::format("\n{} of {} effects on; the others are neither read, built nor stored.\n", on,
                               plan.effects.size());
    return exit_ok;
}

} // namespace damslip::cli
