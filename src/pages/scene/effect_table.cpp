#include "pages/scene/effect_table.hpp"

namespace damslip::pages {

Table effect_table(const EffectPlan& plan)
{
    using E = PlannedEffect;
    return table_of<E>(plan.method == Method::rigid_block ? "Effect plan, rigid block" : "Effect plan, finite elements",
                       {{{"effect", "effect"}, &E::name},
                        {{"on", "on"}, &E::on},
                        {{"reason", "because"}, &E::reason},
                        {{"cost", "cost"}, &E::cost}},
                       plan.effects);
}

} // namespace damslip::pages
