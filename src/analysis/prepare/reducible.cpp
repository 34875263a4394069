#include "analysis/prepare/reducible.hpp"

#include "core/usage_error.hpp"
#include "scene/rock_mass.hpp"

#include <fmt/format.h>

namespace damslip {

std::optional<Diagnostic> why_not_reducible(const Scene& scene)
{
    if (scene.contact.sliding == JointPath::finite)
        return Diagnostic{scene.file.string(),
                          0,
                          0,
                          "--reduced with contact.sliding = \"finite\".",
                          "contact.sliding = \"small\", the modes are those of one place on the rock",
                          "run without --reduced, or write  sliding = \"small\"  in [contact]"};
    if (scene.mesh.rock_contact_size)
        return Diagnostic{scene.file.string(),
                          0,
                          0,
                          "--reduced with mesh.rock_contact_size_m.",
                          "facing nodes on both sides of the plane",
                          "run without --reduced, or delete rock_contact_size_m"};
    if (scene.reservoir && scene.reservoir->model == ReservoirModel::acoustic)
        return Diagnostic{scene.file.string(),
                          0,
                          0,
                          "--reduced with reservoir.model = \"acoustic\".",
                          "\"added-mass\", \"hydrostatic\" or \"auto\", the modes are those of the dam alone",
                          "run without --reduced, or write  model = \"added-mass\"  in [reservoir]"};
    if (scene.time.scheme == TimeScheme::modal || scene.time.scheme == TimeScheme::central_difference)
        return Diagnostic{
            scene.file.string(),
            0,
            0,
            fmt::format("--reduced with time.scheme = \"{}\".",
                        scene.time.scheme == TimeScheme::modal ? "modal" : "central-difference"),
            "scheme = \"auto\", \"hht\" or \"newmark\": a reduced run has its modes anyway, and steps them implicitly",
            "run without --reduced, or delete scheme in [time]"};
    if (rock_has_mass(scene))
        return Diagnostic{scene.file.string(),
                          0,
                          0,
                          "--reduced with foundation.mass = \"with-mass\".",
                          "mass = \"massless\", the modes are those of the dam alone",
                          "run without --reduced, or write  mass = \"massless\"  in [foundation]"};
    if (scene.time.stepping == Stepping::adaptive)
        return Diagnostic{scene.file.string(),
                          0,
                          0,
                          "--reduced with time.stepping = \"adaptive\".",
                          "stepping = \"uniform\", sub-steps of a reduced run are all alike",
                          "run without --reduced, or delete stepping in [time]"};
    if (!scene.lift_joints.empty())
        return Diagnostic{scene.file.string(),
                          0,
                          0,
                          fmt::format("--reduced with {} [[lift_joint]].", scene.lift_joints.size()),
                          "no [[lift_joint]], the modes are those of a dam of one piece",
                          "run without --reduced, or delete the [[lift_joint]]"};
    if (scene.contact.normal == NormalContact::exponential)
        return Diagnostic{scene.file.string(),
                          0,
                          0,
                          "--reduced with contact.normal = \"exponential\".",
                          "contact.normal = \"hard\", the reduced base has no springs across it",
                          "run without --reduced, or write  normal = \"hard\"  in [contact]"};
    return std::nullopt;
}

void check_reducible(const Scene& scene)
{
    if (const auto why_not = why_not_reducible(scene)) throw UsageError(*why_not);
}

} // namespace damslip
