#include "scene/effect_row.hpp"

#include <fmt/format.h>

namespace damslip {

namespace {

std::string table_there(bool there, const std::string& table)
{
    return there ? "[" + table + "] is given" : "no [" + table + "]";
}

RemovalAnswer without_tailwater(Scene s, const SeepagePoints&)
{
    s.tailwater.reset();
    for (Combination& c : s.combinations) c.tailwater_level.reset();
    return Removal{s, "no [tailwater]"};
}

RemovalAnswer without_ice(Scene s, const SeepagePoints&)
{
    s.ice.reset();
    for (Combination& c : s.combinations) c.ice = false;
    return Removal{s, "no [ice]"};
}

} // namespace

std::vector<EffectRow> load_effects()
{
    return {
        {.name = "hydrostatic thrust",
         .decide = [](const Scene& s, Method) -> Decision {
             return {s.reservoir.has_value(), table_there(s.reservoir.has_value(), "reservoir"),
                     "exact face integrals"};
         },
         .remove = [](Scene, const SeepagePoints&) -> RemovalAnswer {
             return Stays{"without water it is another load, not another model: give the scene no [reservoir]"};
         },
         .leave_out = [](Scene& s, const EffectPlan&) { s.reservoir.reset(); },
         .named = Effect::hydrostatic_thrust},
        {.name = "tailwater",
         .decide = [](const Scene& s, Method) -> Decision {
             return {s.tailwater.has_value(), table_there(s.tailwater.has_value(), "tailwater"),
                     "exact face integrals"};
         },
         .remove = without_tailwater,
         .leave_out = [](Scene& s, const EffectPlan&) { s.tailwater.reset(); },
         .named = Effect::tailwater},
        {.name = "silt",
         .decide = [](const Scene& s, Method) -> Decision {
             return {s.silt.has_value(), table_there(s.silt.has_value(), "silt"), "one force"};
         },
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.silt.reset();
             return Removal{s, "no [silt]"};
         },
         .leave_out = [](Scene& s, const EffectPlan&) { s.silt.reset(); },
         .named = Effect::silt},
        {.name = "ice",
         .decide = [](const Scene& s, Method) -> Decision {
             return {s.ice.has_value(), s.ice ? "[ice] is given; acts in the combinations that name it" : "no [ice]",
                     "one force"};
         },
         .remove = without_ice,
         .leave_out = [](Scene& s, const EffectPlan&) { s.ice.reset(); },
         .named = Effect::ice},
        {.name = "user forces",
         .decide = [](const Scene& s, Method) -> Decision {
             return {!s.forces.empty(),
                     s.forces.empty() ? "no [[force]]" : fmt::format("{} [[force]]", s.forces.size()),
                     "one force each"};
         },
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.forces.clear();
             return Removal{s, "no [[force]]"};
         },
         .leave_out = [](Scene& s, const EffectPlan&) { s.forces.clear(); },
         .named = Effect::user_forces},
    };
}

} // namespace damslip
