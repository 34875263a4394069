#include "scene/key_parts.hpp"
#include "scene/keys.hpp"

namespace damslip::keys {

std::vector<KeyGroup> motion_groups()
{
    std::vector<KeyGroup> groups;
    Key polarity =
        word("polarity", "both",
             "the one sign on the horizontal components as filed that `fe` and `sweep` run; `screen`, `assess`, "
             "`fragility` run both",
             "-1", at(&Motion::polarity));
    Key pause =
        number("sequence_pause", seconds, Range::between(0, 600), "0",
               "rest between the records of a sequence, beyond the run to rest", "10", at(&Motion::sequence_pause));
    pause.applies = [](const void* motion) { return !static_cast<const Motion*>(motion)->sequence.empty(); };
    groups.push_back(group(
        "motion", "Ground motion. a_h positive upstream drives the dam downstream, a_v positive up.", &Scene::motion,
        {number("scale", none, Range::at_least(0), "1", "factor on all components", "1.5", at(&Motion::scale)),
         number("scale_to_pga", acceleration, Range::above(0), "as recorded",
                "horizontal peak is made equal to this, the vertical by the same factor", "1.0",
                at(&Motion::scale_to_pga)),
         polarity, word("vertical", "true", "false: vertical components are left out", "false", at(&Motion::vertical)),
         word("sequence", "each record alone",
              "names of records that shake the same dam one after the other, each from where the one before left it",
              "[\"main shock\", \"aftershock\"]", at(&Motion::sequence)),
         pause}));
    using R = RecordFiles;
    groups.push_back(list_group<R>(
        "motion.record", "One record: a horizontal component and, if there is one, its vertical.",
        [](Scene& s) -> std::vector<R>& { return s.motion.records; },
        {word("name", "file name", "name in the tables", "\"El Centro NS\"", at(&R::name)),
         word("horizontal", "required", "accelerogram file, relative to the scene file", "\"elcentro_ns.at2\"",
              at(&R::horizontal)),
         word("vertical", "none", "accelerogram file, positive up", "\"elcentro_up.at2\"", at(&R::vertical)),
         word("unit", "the file says", "unit of the samples where the file does not say: g, m/s2, cm/s2, gal, mg",
              "\"g\"", at(&R::unit)),
         number("dt", seconds, Range::above(0), "the file says", "time step of one-column files", "0.02", at(&R::dt)),
         word("column", "the only one",
              "column or channel of the horizontal file where it holds several: its heading, or its number from 1",
              "\"ns_g\"", at(&R::column)),
         word("vertical_column", "the only one", "the same of the vertical file; both may be one file", "\"4\"",
              at(&R::vertical_column)),
         number("magnitude", none, Range::between(2, 10), "none",
                "moment magnitude of the earthquake, for the regressions that ask for it", "6.9", at(&R::magnitude)),
         number("scale", none, Range::at_least(0), "1", "factor on this record, on top of motion.scale", "1.2",
                at(&R::scale))}));
    groups.push_back(group(
        "sliding", "Rigid-block integration; the run-out, after which a run by finite elements ends, too.",
        &Scene::sliding,
        {word("scheme", "exact",
              "of the rigid block: exact (events located) or slammer (the trapezoid scheme of SLAMMER)", "\"slammer\"",
              choice(&SlidingOptions::scheme,
                     std::vector<std::pair<std::string, SlidingScheme>>{{"exact", SlidingScheme::exact},
                                                                        {"slammer", SlidingScheme::slammer}})),
         word("lift_off", "no-friction",
              "while the normal force is zero: no resistance (no-friction) or vertical flight and plastic impact "
              "(ballistic)",
              "\"ballistic\"",
              choice(&SlidingOptions::lift_off,
                     std::vector<std::pair<std::string, LiftOff>>{{"no-friction", LiftOff::no_friction},
                                                                  {"ballistic", LiftOff::ballistic}})),
         word("two_way", "true", "false: no upstream sliding", "false", at(&SlidingOptions::two_way)),
         number("run_out_max", seconds, Range::between(0, 600), "60", "integration after the record's end at most",
                "60", at(&SlidingOptions::run_out_max)),
         number("restitution", none, Range::between(0, 1), "by angular momentum",
                "block that rocks: angular rate after an impact over that before", "0.8",
                at(&SlidingOptions::restitution)),
         number(
             "steady_rate_change", none, Range::half_open(0, 1), "0.1",
             "finite elements: share by which the rate of sliding falls at most from one window of the run-out to the "
             "next where the dam goes on by itself (status self-excited); a judgement",
             "0.1", at(&SlidingOptions::steady_rate_change))}));
    return groups;
}

} // namespace damslip::keys
