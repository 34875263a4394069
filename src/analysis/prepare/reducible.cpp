#include "analysis/prepare/reducible.hpp"

#include "analysis/prepare/reservoir.hpp"
#include "core/input_error.hpp"
#include "fe2d/element/elastic.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/reduction/corrected_run.hpp"
#include "fe2d/seepage/seepage.hpp"
#include "fe2d/seepage/seepage_mesh.hpp"
#include "records/measure/measures.hpp"
#include "scene/joint_bond.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

std::optional<Diagnostic> why_not_reducible(const Scene& scene)
{
    const auto not_with = [&scene](const std::string& what, const char* expected, const std::string& otherwise) {
        return Diagnostic{scene.file.string(),
                          0,
                          0,
                          "A reduced run cannot take " + what + ".",
                          expected,
                          "run without --reduced, or " + otherwise};
    };
    if (scene.seam_body)
        return not_with(fmt::format("--plane \"{}\"", scene.seam_body->name),
                        "the base as the plane, the modes are those of a dam of one piece", "leave --plane out");
    if (scene.contact.sliding == JointPath::finite)
        return not_with("contact.sliding = \"finite\"",
                        "contact.sliding = \"small\", the modes are those of one place on the rock",
                        "write  sliding = \"small\"  in [contact]");
    if (scene.mesh.rock_contact_size)
        return not_with("mesh.rock_contact_size_m", "facing nodes on both sides of the plane",
                        "delete rock_contact_size_m");
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

void set_corrector(const Scene& scene, fe2d::RunOptions& options)
{
    const bool corrects = scene.time.stepping == Stepping::automatic && !scene.time.substeps && !with_exact_contact(scene) &&
                          scene.tied_lifts.empty() && scene.dam.crack != BodyCrack::traced && !why_not_reducible(scene);
    options.corrector = corrects ? fe2d::corrected_run : decltype(options.corrector)();
}

namespace {

constexpr double elements_per_wave = 8.0;
constexpr double share_of_record = 0.95;

/// Longest edge of the rock's elements [m].
double longest_edge(const fe2d::Mesh& mesh)
{
    double longest = 0.0;
    for (const fe2d::Element& element : mesh.elements) {
        if (element.region == fe2d::Region::dam) continue;
        const auto corner = fe2d::corners(mesh, element);
        for (int i = 0; i < element.size(); ++i) {
            const Point a = corner[static_cast<std::size_t>(i)],
                        b = corner[static_cast<std::size_t>((i + 1) % element.size())];
            longest = std::max(longest, std::hypot(b.x - a.x, b.y - a.y));
        }
    }
    return longest;
}

} // namespace

std::vector<std::string> rock_warnings(const Scene& scene, const fe2d::Mesh& mesh, const GroundMotion& motion)
{
    std::vector<std::string> warnings;
    if (!rock_is_boxed(scene)) return warnings;
    const fe2d::ElasticWaves c =
        fe2d::elastic_waves(fe2d::elastic_material(scene.foundation->material, scene, "foundation"));
    if (!rock_edges_are_viscous(scene)) {
        const double depth = scene.foundation->depth;
        warnings.push_back(fmt::format(
            "foundation.boundary = \"fixed\": the record moves the edges of the rock box, whose waves do not leave: it "
            "resonates at {:.3g} Hz (shear, c_s/4H) and {:.3g} Hz (compression, c_p/4H) and above; \"viscous\" lets "
            "them go",
            0.25 * c.s / depth, 0.25 * c.p / depth));
    }
    const double base = base_length(scene.section);
    if (rock_edges_are_viscous(scene) && scene.foundation->depth < 4.0 * base)
        warnings.push_back(
            fmt::format("the rock box is {:.3g} base lengths deep: dashpots below it lack the stiffness of deeper rock "
                        "for waves longer than the box; 4 or more, {:.3g} m, move the slip by few per cent",
                        scene.foundation->depth / base, 4.0 * base));
    const double size = longest_edge(mesh);
    const auto check = [&](const std::vector<double>& accel, double speed, const char* which) {
        if (accel.empty()) return;
        const double frequency = records::frequency_below(accel, motion.dt, share_of_record);
        const double elements = frequency > 0.0 ? speed / (frequency * size) : elements_per_wave;
        if (elements < elements_per_wave)
            warnings.push_back(fmt::format("rock elements of up to {:.3g} m: {:.2g} to a {} wave of {:.3g} Hz, below "
                                           "which {:.0f} % of the record's "
                                           "energy lies; {:.0f} are wanted: mesh.rock_size_m of {:.3g} m or less",
                                           size, elements, which, frequency, 100.0 * share_of_record, elements_per_wave,
                                           size * elements / elements_per_wave));
    };
    check(motion.accel_h, c.s, "shear");
    check(motion.accel_v, c.p, "compression");
    return warnings;
}

namespace {

/// Excess pore pressure at the nodes of the model, from the seepage on its own mesh [Pa].
Eigen::VectorXd pore_pressure_on(const Scene& scene, const fe2d::Model& model)
{
    const fe2d::SeepageResult seepage = fe2d::solve_seepage_on(model.mesh, scene, scene_uplift_state(scene));
    check_seepage(scene, seepage);
    return fe2d::excess_pore_pressure(seepage.field.head, seepage.unit_weight);
}

} // namespace

bool has_water_in_rock(const Scene& scene)
{
    return scene.stages.pore_pressure != PorePressure::none && scene.foundation.has_value();
}

Eigen::VectorXd rock_water_load(const Scene& scene, const fe2d::Model& model)
{
    if (!has_water_in_rock(scene)) return Eigen::VectorXd::Zero(model.dofs.count);
    return fe2d::pore_pressure_loads(model.mesh, model.dofs, pore_pressure_on(scene, model),
                                     scene.stages.pore_pressure);
}

Eigen::VectorXd water_in_rock(const Scene& scene, const fe2d::Model& model)
{
    if (!has_water_in_rock(scene)) return Eigen::VectorXd::Zero(model.dofs.count);
    return fe2d::water_in_rock(model.mesh, model.dofs, pore_pressure_on(scene, model), scene.stages.pore_pressure);
}

} // namespace damslip
