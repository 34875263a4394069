#include "scene/checks.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip::checks {

namespace {

std::string in_quotes(const std::vector<RecordFiles>& records)
{
    std::string list;
    for (const RecordFiles& r : records) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", r.name);
    return list;
}

} // namespace

void check_sequence(const Scene& s, Findings& f)
{
    const std::vector<std::string>& names = s.motion.sequence;
    if (names.empty()) {
        if (f.given("motion.sequence_pause"))
            f.wrong("motion.sequence_pause", "motion.sequence_pause_s is given without motion.sequence.",
                    "both or neither", "add  sequence = [\"main shock\", \"aftershock\"]  , or delete the pause");
        return;
    }
    if (names.size() == 1)
        f.wrong("motion.sequence", fmt::format("motion.sequence = [\"{}\"] is one record.", names.front()),
                "two records or more, one after the other", "name the next one, or delete sequence");
    for (const std::string& name : names)
        if (std::none_of(s.motion.records.begin(), s.motion.records.end(),
                         [&](const RecordFiles& r) { return r.name == name; }))
            f.wrong("motion.sequence",
                    fmt::format("motion.sequence names \"{}\", which no [[motion.record]] is.", name),
                    s.motion.records.empty() ? "names of records; the scene has none"
                                             : "names of records: " + in_quotes(s.motion.records),
                    "correct the name, or give a record this  name");
    const auto refuse = [&](const char* what, const char* fix) {
        f.wrong("motion.sequence", fmt::format("motion.sequence with {}.", what),
                "a sequence for the rigid block on its base, and for finite elements in time", fix);
    };
    if (s.uplift && s.uplift->water.after == WaterAfter::full && s.contact.sliding == JointPath::finite)
        refuse("uplift.after = \"full\" and contact.sliding = \"finite\": the static state between two records is one "
               "of small "
               "sliding",
               "write  after = \"unchanged\"  in [uplift] or  sliding = \"small\"  in [contact]");
    if (s.wedge) refuse("[wedge]", "delete sequence: each record then shakes the wedge as it is");
    if (s.flexible_block) refuse("[flexible_block]", "delete [flexible_block], or sequence");
    if (s.time.scheme == TimeScheme::central_difference || s.time.scheme == TimeScheme::modal)
        refuse(s.time.scheme == TimeScheme::modal ? "time.scheme = \"modal\"" : "time.scheme = \"central-difference\"",
               "write  scheme = \"hht\"  in [time]");
    if (s.sliding.scheme == SlidingScheme::slammer)
        refuse("sliding.scheme = \"slammer\"", "write  scheme = \"exact\"  in [sliding]");
}

} // namespace damslip::checks
