#include "analysis/sweep/sweep_method.hpp"

#include "scene/preset.hpp"
#include "scene/rock_mass.hpp"
#include "sliding/empirical/regression.hpp"

#include <algorithm>

namespace damslip {

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
