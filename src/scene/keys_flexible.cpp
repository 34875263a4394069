#include "scene/key_parts.hpp"
#include "scene/keys.hpp"

namespace damslip::keys {

KeyGroup flexible_block_group()
{
    using M = FlexibleMass;
    const Units line_mass{{"kg_m", 1.0}, {"t_m", 1000.0}};
    Key period =
        number("period", seconds, Range::half_open(0, 100), "regressions.period_s",
               "period of the mode on a base that does not slide; \"modes\": period and mass ratio of the tied "
               "finite-element model, water included",
               "0.3", {});
    period.slot = [](void* object) -> Slot {
        auto* m = static_cast<M*>(object);
        return NumberOrWord{&m->period, &m->of_modes, "modes"};
    };
    return optional_group(
        "flexible_block",
        "The sliding mass as one mode that vibrates on its base, beside the rigid block. Of `mass_ratio`, "
        "`shape_exponent` and `modal_load_kg_m` with `modal_mass_kg_m` one at most. Without this table "
        "regressions.period_s "
        "above 0 alone follows the block with all defaults.",
        &Scene::flexible_block,
        {period,
         number("damping", none, Range::between(0, 0.5), "0.05", "damping ratio of the mode", "0.1",
                at(&M::damping_ratio)),
         number("mass_ratio", none, Range::half_open(0, 0.95), "8/π² = 0.81 (uniform shear column)",
                "effective mass of the mode over the sliding mass, L²/(M M_1)", "0.7", at(&M::mass_ratio)),
         number("shape_exponent", none, Range::half_open(0, 10), "none",
                "n of the shape ψ = (y/H)^n: L and M_1 by integration over section and added mass", "1.5",
                at(&M::shape_exponent)),
         number("modal_load", line_mass, Range::above(0), "none", "L = Σ m ψ, water included", "2e6",
                at(&M::modal_load)),
         number("modal_mass", line_mass, Range::above(0), "none", "M_1 = Σ m ψ², water included", "1e6",
                at(&M::modal_mass)),
         word("mode", "both", "vibration first and slip after it (decoupled), both at once (coupled), or both analyses",
              "\"coupled\"",
              choice(&M::method,
                     std::vector<std::pair<std::string, FlexibleMethod>>{{"both", FlexibleMethod::both},
                                                                         {"decoupled", FlexibleMethod::decoupled},
                                                                         {"coupled", FlexibleMethod::coupled}}))});
}

} // namespace damslip::keys
