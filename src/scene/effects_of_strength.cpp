#include "scene/effect_row.hpp"
#include "scene/friction_over_slip.hpp"
#include "scene/section.hpp"

#include <fmt/format.h>

namespace damslip {

namespace {

Decision decide_strength_loss(const Scene& s, Method)
{
    if (!s.contact.friction_table.empty())
        return {true, "contact.friction_table_m", "strength stages are events of the integration"};
    if (s.contact.residual_friction)
        return {true, "contact.residual_friction", "strength stages are events of the integration"};
    return {false, "no residual_friction, no friction_table_m", ""};
}

RemovalAnswer without_strength_loss(Scene s, const SeepagePoints&)
{
    Contact& c = s.contact;
    c.friction = FrictionOverSlip(c).peak();
    c.friction_table.clear();
    c.residual_friction.reset();
    c.residual_slip = 0.0;
    return Removal{s, fmt::format("friction {:.4g} whatever the slip", c.friction)};
}

} // namespace

std::vector<EffectRow> strength_effects()
{
    return {
        {.name = "cohesion",
         .decide = [](const Scene& s, Method) -> Decision {
             return {s.contact.cohesion > 0,
                     s.contact.cohesion > 0 ? "contact.cohesion_kPa > 0" : "contact.cohesion_kPa = 0",
                     "lost at first slip: one event"};
         },
         .remove = [](Scene s, const SeepagePoints&) -> RemovalAnswer {
             s.contact.cohesion = 0.0;
             s.contact.bond = {};
             return Removal{s, "contact.cohesion_kPa = 0"};
         },
         .leave_out = [](Scene& s, const EffectPlan&) { s.contact.cohesion = 0.0; },
         .named = Effect::cohesion},
        {.name = "strength loss with slip",
         .decide = decide_strength_loss,
         .remove = without_strength_loss,
         .leave_out =
             [](Scene& s, const EffectPlan&) {
                 s.contact.residual_friction.reset();
                 s.contact.friction_table.clear();
             },
         .named = Effect::strength_loss},
        {.name = "inclined base",
         .decide = [](const Scene& s, Method) -> Decision {
             return {base_inclination(s.section) != 0,
                     base_inclination(s.section) != 0 ? "the toe is not level with the heel" : "level base", "none"};
         },
         .remove = [](Scene, const SeepagePoints&) -> RemovalAnswer {
             return Stays{"geometry: a level base is another dam"};
         },
         .named = Effect::inclined_base},
    };
}

} // namespace damslip
