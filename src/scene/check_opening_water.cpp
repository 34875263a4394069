#include "scene/checks.hpp"

#include "scene/opening_water.hpp"

#include <fmt/format.h>
#include <string>
#include <vector>

namespace damslip::checks {

namespace {

/// Keys that only one rule reads.
void check_keys_of_rule(const JointWaterLaw& law, Findings& f)
{
    if (law.opening == OpeningWater::mouth && !law.mouth_speed)
        f.wrong("uplift.opening", "uplift.opening = \"mouth\" without uplift.mouth_speed_m_s.",
                "the speed at which water enters the crack, above 0 [m_s]: no value of it is agreed on",
                "add  mouth_speed_m_s = 5  (and try others), or write  opening = \"full\"");
    std::vector<std::pair<std::string, const char*>> idle; // keys, and the rule that reads them
    if (law.opening == OpeningWater::unchanged && law.mouth_speed) idle.emplace_back("mouth_speed", "mouth");
    if (law.opening != OpeningWater::reynolds)
        for (const char* key : {"joint_clearance", "water_viscosity", "cavitation_pressure", "wet_end"})
            if (f.given(std::string("uplift.") + key)) idle.emplace_back(key, "reynolds");
    for (const auto& [key, rule] : idle) {
        Diagnostic note;
        note.problem = fmt::format("uplift.{} is not read with uplift.opening = \"{}\".", key, word(law.opening));
        note.expected = fmt::format("opening = \"{}\", the only rule that reads it", rule);
        note.fix = fmt::format("keep it for  sweep --opening-water {} , or delete it", rule);
        f.note("uplift." + key, note);
    }
}

} // namespace

void check_opening_water(const Scene& s, Findings& f)
{
    if (!s.uplift) return;
    const JointWaterLaw& law = s.uplift->water;
    check_keys_of_rule(law, f);
    if (!law.follows()) return;
    if (law.opening == OpeningWater::reynolds && drains_shear_off(s))
        f.wrong("drains.lost_at_slip", "drains.lost_at_slip_m with uplift.opening = \"reynolds\".",
                "drains that hold, whose pressure the flow along the joint knows; or another rule of the water",
                "delete lost_at_slip_m in [drains], or write  opening = \"full\"  in [uplift]");
    const bool opens = law.opening != OpeningWater::unchanged;
    const std::string key = opens ? "uplift.opening" : "uplift.after";
    const std::string said =
        opens ? fmt::format("uplift.opening = \"{}\"", word(law.opening)) : "uplift.after = \"full\"";
    if (s.uplift->model == UpliftModel::none)
        f.wrong(key, fmt::format("{} with uplift.model = \"none\".", said),
                "an uplift model: a dry base has no water to follow its opening",
                fmt::format("write  model = \"linear\" , or delete {}", opens ? "opening" : "after"));
    if (!s.reservoir && !s.tailwater)
        f.wrong(key, fmt::format("{} with neither [reservoir] nor [tailwater].", said),
                "water before one end of the base at least", "add [reservoir] with its level_m, or delete the key");
    if (opens && s.sliding.scheme == SlidingScheme::slammer)
        f.wrong("sliding.scheme", fmt::format("sliding.scheme = \"slammer\" with {}.", said),
                "scheme = \"exact\": that of SLAMMER has one yield acceleration",
                "delete scheme in [sliding], or opening in [uplift]");
    if (law.wet_end == WetEndPressure::with_waves && !s.reservoir)
        f.wrong("uplift.wet_end", "uplift.wet_end = \"with-waves\" without [reservoir].",
                "a reservoir whose waves reach the heel", "add [reservoir], or write  wet_end = \"still\"");
}

} // namespace damslip::checks
