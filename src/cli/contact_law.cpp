#include "cli/contact_law.hpp"

#include <cmath>

namespace damslip::cli {

std::optional<Scene> with_exact_contact(const Scene& scene)
{
    if (scene.contact.enforcement == ContactEnforcement::exact && scene.contact.normal == NormalContact::hard)
        return std::nullopt;
    Scene exact = scene;
    exact.contact.normal = NormalContact::hard;
    exact.contact.enforcement = ContactEnforcement::exact;
    exact.contact.tangential_stiffness.reset();
    return exact;
}

Table contact_law_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Error of the contact law";
    t.columns = {{"record", "record", "", 4},
                 {"slip_mm", "slip", "mm", 5},
                 {"slip_exact_mm", "slip, exact", "mm", 5},
                 {"status_exact", "exact run", "", 4},
                 {"law_error_mm", "error", "mm", 3},
                 {"law_error_percent", "error", "%", 3}};
    for (const ContactRun& r : runs) {
        if (!r.exact) continue;
        const double error = r.fe.slip - r.exact->slip;
        t.rows.push_back({r.record, 1e3 * r.fe.slip, 1e3 * r.exact->slip, word(r.exact->status), 1e3 * error,
                          r.exact->slip != 0.0 ? Cell(100.0 * error / std::abs(r.exact->slip)) : Cell()});
    }
    t.notes.push_back("slip without its elastic part; exact: the same run, but pairs that stick do not give way and "
                      "the joint is hard across.");
    return t;
}

std::vector<std::string> contact_law_notes(const Scene& scene)
{
    if (scene.contact.normal == NormalContact::exponential)
        return {"contact.normal = \"exponential\": openings are clearances of the two sides, of the order of "
                "clearance_at_zero_pressure_m under pressure too, negative where the pressure is above "
                "pressure_at_zero_clearance; a pair is open where it carries none."};
    if (scene.contact.separation == JointOpening::allowed) return {};
    return {"contact.separation = \"none\": the joint carries tension without shear, so its compressed part carries "
            "more than the resultant. This lowers the slip, and a rigid dam no longer slides as a rigid block."};
}

} // namespace damslip::cli
