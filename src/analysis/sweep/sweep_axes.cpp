#include "analysis/sweep/sweep_axes.hpp"

#include "analysis/prepare/plane_model.hpp"
#include "analysis/prepare/records.hpp"
#include "analysis/sweep/sweep_grid.hpp"
#include "core/text.hpp"
#include "scene/added_mass_formulas.hpp"
#include "scene/findings.hpp"
#include "scene/joint_bond.hpp"
#include "scene/keys.hpp"
#include "scene/rock_mass.hpp"
#include "scene/uplift_models.hpp"
#include "sliding/empirical/regression.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace damslip {

namespace {

std::string reservoir_word(const Scene& scene)
{
    if (!scene.reservoir) return "none";
    switch (scene.reservoir->model) {
    case ReservoirModel::automatic:
        return "auto";
    case ReservoirModel::hydrostatic:
        return "hydrostatic";
    case ReservoirModel::acoustic:
        return "acoustic";
    case ReservoirModel::added_mass:
        break;
    }
    return added_mass_row(scene.added_mass.formula).word;
}

/// "0.65,0.7" with all digits.
std::string joined(const std::vector<double>& values)
{
    std::string text;
    for (const double v : values) text += (text.empty() ? "" : ",") + shortest(v);
    return text;
}

} // namespace

bool Axes::finite_elements() const
{
    return std::any_of(method.begin(), method.end(),
                       [](const SweepMethod& m) { return m.kind == SweepKind::finite_elements; });
}

bool Axes::flexible() const
{
    return std::any_of(method.begin(), method.end(), [](const SweepMethod& m) { return is_flexible(m.kind); });
}

Axes axes_of(const Scene& scene)
{
    Axes axes;
    axes.friction = {scene.contact.friction};
    axes.level = {scene.reservoir ? scene.reservoir->level : 0.0};
    axes.size = axes.scale = {1.0};
    axes.polarity = polarities_of(scene);
    axes.uplift = {scene.uplift ? word(scene.uplift->model) : "none"};
    axes.reservoir = {reservoir_word(scene)};
    axes.method = {sweep_method("rigid")};
    return axes;
}

std::vector<std::string> reservoir_axis_words()
{
    std::vector<std::string> words{"auto", "hydrostatic", "acoustic"};
    for (const AddedMassRow& row : added_mass_rows()) words.push_back(row.word);
    return words;
}

Scene variant(Scene scene, double level, const std::string& uplift, const std::string& reservoir, double size)
{
    if (scene.reservoir) {
        scene.reservoir->level = level;
        if (reservoir == "auto")
            scene.reservoir->model = ReservoirModel::automatic;
        else if (reservoir == "hydrostatic")
            scene.reservoir->model = ReservoirModel::hydrostatic;
        else if (reservoir == "acoustic")
            scene.reservoir->model = ReservoirModel::acoustic;
        else {
            scene.added_mass.formula = named_by<AddedMassFormula>(reservoir, added_mass_rows());
            scene.reservoir->model = ReservoirModel::added_mass;
        }
    }
    if (uplift == "none")
        scene.uplift.reset();
    else {
        if (!scene.uplift) scene.uplift.emplace();
        scene.uplift->model = named_by<UpliftModel>(uplift, uplift_rows());
    }
    return sized(std::move(scene), size);
}

double plane_friction(const Scene& scene, const std::string& plane)
{
    if (plane.empty() || plane == base_plane) return scene.contact.friction;
    for (const Seam& seam : scene.seams)
        if (seam.name == plane) return seam.strength.friction;
    for (const LiftJoint& joint : scene.lift_joints)
        if (joint.name == plane) return joint.strength.friction;
    return scene.lifts ? scene.lifts->strength.friction : scene.contact.friction;
}

Scene with_opening_water(Scene scene, const std::string& opening)
{
    if (opening.empty() || !scene.uplift) return scene;
    for (const auto& [word, rule] : opening_waters())
        if (word == opening) scene.uplift->water.opening = rule;
    return scene;
}

Scene with_mode(Scene scene, std::optional<double> period, std::optional<double> damping)
{
    if (!period && !damping) return scene;
    if (!scene.flexible_block) scene.flexible_block.emplace();
    if (period) {
        scene.flexible_block->period = period;
        scene.flexible_block->of_modes = false;
    }
    if (damping) scene.flexible_block->damping_ratio = *damping;
    return scene;
}

std::string text_of(const Axes& axes)
{
    std::vector<std::string> methods;
    for (const SweepMethod& m : axes.method) methods.push_back(m.id);
    const std::string opening =
        has_opening_axis(axes) ? fmt::format("opening water {}; ", fmt::join(axes.opening, ",")) : "";
    std::string mode;
    if (!axes.period.empty()) mode += fmt::format("period {}; ", joined(axes.period));
    if (!axes.damping.empty()) mode += fmt::format("damping {}; ", joined(axes.damping));
    if (has_plane_axis(axes))
        mode += fmt::format("plane {}; own friction {}; ", fmt::join(axes.plane, ","), joined(axes.plane_friction));
    return opening + mode +
           fmt::format("friction {}; level {}; uplift {}; reservoir {}; size {}; scale {}; polarity {}; method {}",
                       joined(axes.friction), joined(axes.level), fmt::join(axes.uplift, ","),
                       fmt::join(axes.reservoir, ","), joined(axes.size), joined(axes.scale),
                       fmt::join(axes.polarity, ","), fmt::join(methods, ","));
}

namespace {

std::vector<SweepMethod> make_list()
{
    const auto fe = [](const char* id, FeLaw law) { return SweepMethod{id, SweepKind::finite_elements, law, false}; };
    std::vector<SweepMethod> list{{"rigid", SweepKind::rigid, FeLaw::scene, false},
                                  {"rigid-v", SweepKind::rigid_vertical, FeLaw::scene, false},
                                  {"rocking", SweepKind::rocking, FeLaw::scene, false},
                                  {"decoupled", SweepKind::decoupled, FeLaw::scene, false},
                                  {"coupled", SweepKind::coupled, FeLaw::scene, false},
                                  fe("fe", FeLaw::scene),
                                  fe("fe-exact", FeLaw::exact),
                                  fe("fe-penalty", FeLaw::penalty),
                                  fe("fe-slip-tolerance", FeLaw::slip_tolerance),
                                  fe("fe-whole-steps", FeLaw::whole_steps),
                                  fe("fe-goldgruber-2015", FeLaw::goldgruber_2015),
                                  fe("fe-radiating", FeLaw::radiating),
                                  fe("fe-massless", FeLaw::massless),
                                  {"fe-reduced", SweepKind::finite_elements, FeLaw::scene, true}};
    for (const sliding::Regression& r : sliding::regressions())
        list.push_back({std::string(r.id), SweepKind::regression, FeLaw::scene, false});
    return list;
}

} // namespace

const std::vector<SweepMethod>& sweep_method_list()
{
    static const std::vector<SweepMethod> list = make_list();
    return list;
}

std::vector<std::string> sweep_methods()
{
    std::vector<std::string> ids;
    for (const SweepMethod& m : sweep_method_list()) ids.push_back(m.id);
    return ids;
}

const SweepMethod& sweep_method(const std::string& id)
{
    const auto& list = sweep_method_list();
    return *std::find_if(list.begin(), list.end(), [&](const SweepMethod& m) { return m.id == id; });
}

Methods methods_of(const std::vector<SweepMethod>& list)
{
    Methods set = 0;
    for (const SweepMethod& method : list)
        set |= method.kind == SweepKind::regression        ? methods::regressions
               : method.kind != SweepKind::finite_elements ? methods::rigid
               : method.reduced                            ? methods::reduced
                                                           : methods::fe;
    return set;
}

Scene with_law(Scene scene, FeLaw law, std::optional<double> penalty_stiffness)
{
    if (law == FeLaw::scene) return scene;
    if (law == FeLaw::whole_steps) {
        scene.time.substeps = 0;
        return scene;
    }
    if (law == FeLaw::radiating) return with_radiating_rock(std::move(scene));
    if (law == FeLaw::massless) return with_massless_rock(std::move(scene));
    scene.contact.normal = NormalContact::hard;
    if (law == FeLaw::penalty) {
        scene.contact.enforcement = ContactEnforcement::penalty;
        if (penalty_stiffness) scene.contact.tangential_stiffness = penalty_stiffness;
        return scene;
    }
    scene.contact.tangential_stiffness.reset();
    scene.contact.enforcement = law == FeLaw::exact ? ContactEnforcement::exact : ContactEnforcement::slip_tolerance;
    if (law == FeLaw::goldgruber_2015) {
        scene.analysis.preset = AnalysisPreset::goldgruber_2015;
        apply_preset(scene, [](const char*) { return true; }); // whatever the scene says
    }
    return scene;
}

} // namespace damslip
