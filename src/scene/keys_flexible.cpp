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
         number("height", length, Range::half_open(0, 1000), "none",
                "H of a uniform shear column: with shear_velocity_m_s in place of the period, T_s = 4 H/V_s", "30",
                at(&M::height)),
         number("shear_velocity", {{"m_s", 1.0}}, Range::half_open(0, 10000), "none",
                "V_s of the column at small strain", "450", at(&M::shear_velocity)),
         number("base_velocity", {{"m_s", 1.0}}, Range::half_open(0, 10000), "none",
                "V_s of the rock below the column: what it radiates is added to the damping, at most 20 %; without it "
                "nothing",
                "1500", at(&M::base_velocity)),
         number("reference_strain", {{"percent", 0.01}}, Range::half_open(0, 100), "none",
                "shear strain at which the column's shear modulus is halved: period and damping follow the strain of "
                "each record "
                "(equivalent linear); without it they stay",
                "0.05", at(&M::reference_strain)),
         word("mode", "both", "vibration first and slip after it (decoupled), both at once (coupled), or both analyses",
              "\"coupled\"",
              choice(&M::method,
                     std::vector<std::pair<std::string, FlexibleMethod>>{{"both", FlexibleMethod::both},
                                                                         {"decoupled", FlexibleMethod::decoupled},
                                                                         {"coupled", FlexibleMethod::coupled}}))});
}

} // namespace damslip::keys
