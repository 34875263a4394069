#include "analysis/prepare/reducible.hpp"

#include "core/usage_error.hpp"
#include "scene/first_joint_law.hpp"
#include "scene/rock_mass.hpp"

#include <fmt/format.h>

namespace damslip {

std::optional<Diagnostic> why_not_reducible(const Scene& scene)
{
    const auto not_with = [&scene](const std::string& what, const char* expected, const std::string& otherwise) {
        return Diagnostic{scene.file.string(),
                          0,
                          0,
                          "--reduced with " + what + ".",
                          expected,
                          "run without --reduced, or " + otherwise};
    };
    if (scene.contact.sliding == JointPath::finite)
        return not_with("contact.sliding = \"finite\"",
                        "contact.sliding = \"small\", the modes are those of one place on the rock",
                        "write  sliding = \"small\"  in [contact]");
    if (scene.mesh.rock_contact_size)
        return not_with("mesh.rock_contact_size_m", "facing nodes on both sides of the plane",
                        "delete rock_contact_size_m");
    if (scene.reservoir && scene.reservoir->model == ReservoirModel::acoustic)
        return not_with("reservoir.model = \"acoustic\"",
                        "\"added-mass\", \"hydrostatic\" or \"auto\", the modes are those of the dam alone",
                        "write  model = \"added-mass\"  in [reservoir]");
    if (scene.time.scheme == TimeScheme::modal || scene.time.scheme == TimeScheme::central_difference)
        return not_with(fmt::format("time.scheme = \"{}\"",
                                    scene.time.scheme == TimeScheme::modal ? "modal" : "central-difference"),
                        "scheme = \"auto\", \"hht\" or \"newmark\": a reduced run has its modes anyway, and steps them "
                        "implicitly",
                        "delete scheme in [time]");
    if (rock_is_boxed(scene))
        return not_with(
            fmt::format("foundation.boundary = \"{}\"", rock_edges_are_viscous(scene) ? "viscous" : "fixed"),
            "boundary = \"absorbing\", rock that is reduced to the base as the dam is, or massless rock",
            "write  boundary = \"absorbing\"  in [foundation]");
    if (scene.time.stepping == Stepping::adaptive)
        return not_with("time.stepping = \"adaptive\"",
                        "stepping = \"uniform\", sub-steps of a reduced run are all alike",
                        "delete stepping in [time]");
    if (!scene.motion.sequence.empty())
        return not_with("motion.sequence", "each record alone: a reduced run starts from rest",
                        "delete sequence in [motion]");
    if (scene.contact.restitution > 0.0)
        return not_with(fmt::format("contact.restitution = {:g}", scene.contact.restitution),
                        "restitution = 0, impacts of a reduced run come to rest", "delete restitution");
    if (!scene.lift_joints.empty())
        return not_with(fmt::format("{} [[lift_joint]]", scene.lift_joints.size()),
                        "no [[lift_joint]], the modes are those of a dam of one piece", "delete the [[lift_joint]]");
    if (scene.contact.normal == NormalContact::exponential)
        return not_with("contact.normal = \"exponential\"",
                        "contact.normal = \"hard\", the reduced base has no springs across it",
                        "write  normal = \"hard\"  in [contact]");
    if (const std::string law = first_joint_law(scene); !law.empty())
        return not_with(law, "contact by friction and cohesion alone, the reduced base has no other laws",
                        "leave it out");
    return std::nullopt;
}

void check_reducible(const Scene& scene)
{
    if (const auto why_not = why_not_reducible(scene)) throw UsageError(*why_not);
}

} // namespace damslip
