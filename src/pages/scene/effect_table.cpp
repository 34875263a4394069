#include "pages/scene/effect_table.hpp"

namespace damslip::pages {

Table effect_table(const EffectPlan& plan)
{
    Table table;
    table.title = plan.method == Method::rigid_block ? "Effect plan, rigid block" : "Effect plan, finite elements";
    table.columns = {
        {"effect", "effect", "", 4}, {"on", "on", "", 4}, {"reason", "because", "", 4}, {"cost", "cost", "", 4}};
    for (const PlannedEffect& e : plan.effects) table.rows.push_back({e.name, e.on, e.reason, e.cost});
    return table;
}

} // namespace damslip::pages
