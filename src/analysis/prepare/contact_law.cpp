#include "analysis/prepare/contact_law.hpp"

#include "scene/rock_mass.hpp"
#include "scene/water.hpp"

#include <fmt/format.h>

namespace damslip {

std::vector<std::string> contact_law_notes(const Scene& scene)
{
    std::vector<std::string> notes;
    if (base_taken_as_dry(scene))
        notes.push_back(
            "The base is taken as dry although there is water on the dam: no answer here counts any uplift.");
    if (scene.contact.normal == NormalContact::exponential)
        notes.push_back("contact.normal = \"exponential\": openings are clearances of the two sides, of the order of "
                        "clearance_at_zero_pressure_m under pressure too, negative where the pressure is above "
                        "pressure_at_zero_clearance; a pair is open where it carries none.");
    else if (scene.contact.separation == JointOpening::none)
        notes.push_back(
            "contact.separation = \"none\": the joint carries tension without shear, so its compressed part carries "
            "more than the resultant. This lowers the slip, and a rigid dam no longer slides as a rigid block.");
    return notes;
}

std::optional<std::string> base_note(const Scene& scene)
{
    switch (rock_kind(scene)) {
    case RockKind::rigid:
        return "rigid base: no radiation damping; an elastic dam may slide on it without end";
    case RockKind::massless:
        return fmt::format(
            "massless rock keeps all waves: slips come out too large, often by half and more;  damslip fe "
            "{} --rock radiating  lets them leave",
            scene.file.empty() ? "SCENE" : scene.file.string());
    case RockKind::boxed:
    case RockKind::radiating:
        break;
    }
    return std::nullopt;
}

} // namespace damslip
