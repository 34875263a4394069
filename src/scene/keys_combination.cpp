#include "scene/key_parts.hpp"
#include "scene/keys.hpp"

namespace damslip::keys {

namespace {

std::vector<Key> combination_keys()
{
    using C = Combination;
    std::vector<Key> keys{
        word("name", "required", "name in the tables", "\"flood\"", at(&C::name)),
        word(
            "kind", "usual", "how probable: decides which required values apply", "\"unusual\"",
            choice(&C::kind, std::vector<std::pair<std::string, CombinationKind>>{{"usual", CombinationKind::usual},
                                                                                  {"unusual", CombinationKind::unusual},
                                                                                  {"extreme", CombinationKind::extreme},
                                                                                  {"post-seismic",
                                                                                   CombinationKind::post_seismic}})),
        word("follows", "the extreme combination after which its sliding factor is smallest",
             "post-seismic: name of the extreme combination that opened the joint", "\"seismic\"", at(&C::follows)),
        number("reservoir_level", length, Range::at_least(0), "reservoir.level_m", "water surface above the heel", "63",
               at(&C::reservoir_level)),
        number("tailwater_level", length, Range::at_least(0), "tailwater.level_m", "tailwater surface above the heel",
               "5", at(&C::tailwater_level)),
        word("ice", "false", "the [ice] thrust acts", "true", at(&C::ice)),
        word("drains_effective", "true", "false: drains without effect", "false", at(&C::drains_effective)),
        word("curtain_intact", "true", "false: ruptured curtain, linear uplift", "false", at(&C::curtain_intact)),
        word("residual_strength", "false", "true: residual friction, no cohesion", "true", at(&C::residual_strength)),
        word("gates_open", "false", "true: the gates of [gate] are open, the water flows over the crest", "true",
             at(&C::gates_open)),
        word("crack", "uplift.crack", "uplift in a base crack", "\"static\"",
             optional_choice(&C::crack, crack_rules())),
        number("friction", friction, Range::above(0), "contact.friction", "Coulomb mu", "0.84", at(&C::friction)),
        number("cohesion", stress, Range::at_least(0), "contact.cohesion_kPa", "cohesion on the compressed length",
               "100", at(&C::cohesion)),
        number("k_h", none, Range::between(-5, 5), "0",
               "seismic coefficient a_h / 9.80665 m/s2, positive drives downstream", "0.1", at(&C::k_h)),
        number("k_v", none, Range::between(-5, 5), "0",
               "seismic coefficient a_v / 9.80665 m/s2, positive up: makes the dam heavier", "-0.05", at(&C::k_v)),
        number("pga_fraction", none, Range::half_open(0, 2), "none",
               "in place of k_h: share of the largest PGA of the records, drives downstream", "0.67",
               at(&C::pga_fraction)),
        number("pga_v_fraction", none, Range::between(0, 2), "none",
               "in place of k_v: share of the records' largest vertical acceleration; it lightens the dam", "0.3",
               at(&C::pga_v_fraction)),
        number("weight_factor", none, Range::above(0), "1", "load factor on the dam's weight", "0.9",
               at(&C::weight_factor)),
        number("water_factor", none, Range::at_least(0), "1", "load factor on the water pressure", "1.1",
               at(&C::water_factor)),
        number("uplift_factor", none, Range::at_least(0), "1", "load factor on the uplift", "1.1",
               at(&C::uplift_factor)),
        number("silt_factor", none, Range::at_least(0), "1", "load factor on the silt thrust", "1.1",
               at(&C::silt_factor)),
        number("ice_factor", none, Range::at_least(0), "1", "load factor on the ice thrust", "1.1", at(&C::ice_factor)),
        number("required_sliding_factor", none, Range::above(0), "from criteria.document, else none",
               "required factor of safety against sliding", "1.5", at(&C::required_sliding_factor)),
        number("required_flotation_factor", none, Range::above(0), "none",
               "required factor of safety against flotation", "1.2", at(&C::required_flotation_factor)),
        number("required_overturning_factor", none, Range::above(0), "none",
               "required factor of safety against overturning", "1.5", at(&C::required_overturning_factor)),
        word("required_resultant", "none", "where the resultant must lie: kern (the middle third), middle-half, or base (anywhere within it)", "\"middle-half\"",
             at(&C::required_resultant)),
        word("source", "empty", "document the required values are taken from", "\"EM 1110-2-2100, table 3-2\"",
             at(&C::source))};
    return keys;
}

} // namespace

KeyGroup combination_group()
{
    return list_group<Combination>(
        "combination",
        "A load combination of the limit equilibrium. None given: usual, seismic and post-seismic are made from the "
        "scene.",
        [](Scene& s) -> std::vector<Combination>& { return s.combinations; }, combination_keys());
}

} // namespace damslip::keys
