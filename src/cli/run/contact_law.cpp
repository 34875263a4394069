#include "cli/run/contact_law.hpp"

namespace damslip::cli {

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
