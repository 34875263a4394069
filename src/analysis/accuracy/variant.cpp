#include "analysis/accuracy/variant.hpp"

#include "analysis/fe/mesh_scale.hpp"
#include "scene/exact_contact.hpp"
#include "scene/rock_mass.hpp"

namespace damslip {

namespace {

void set_element(std::string_view word, Scene& scene)
{
    if (word == "q8") scene.mesh.element = ElementKind::q8;
    if (word == "q9") scene.mesh.element = ElementKind::q9;
    if (word == "t6") scene.mesh.element = ElementKind::t6;
}

void set_water(RungWater water, Scene& scene)
{
    if (!scene.reservoir) return;
    switch (water) {
    case RungWater::dry:
        break;
    case RungWater::hydrostatic:
        scene.reservoir->model = ReservoirModel::hydrostatic;
        break;
    case RungWater::added_mass:
        scene.reservoir->model = ReservoirModel::added_mass;
        break;
    case RungWater::acoustic:
        scene.reservoir->model = ReservoirModel::acoustic;
        break;
    }
}

void set_rock(const Rung& rung, Scene& scene)
{
    if (!scene.foundation) return;
    if (rung.rock == RungRock::massless) scene = with_massless_rock(scene);
    if (rung.rock == RungRock::radiating) scene = with_radiating_rock(scene);
    scene.foundation->wave_box *= rung.wave_box;
}

} // namespace

Scene scene_of(const Scene& given, const Rung& rung)
{
    Scene scene = given;
    if (rung.family == RungFamily::regression) return scene;
    if (rung.family == RungFamily::rigid) {
        scene.sliding.scheme = rung.scheme == RigidScheme::slammer ? SlidingScheme::slammer : SlidingScheme::exact;
        if (rung.components == Components::horizontal) scene.motion.vertical = false;
        return scene;
    }
    set_water(rung.water, scene);
    if (rung.step == StepChoice::as_the_scene) return scene;
    scene = with_exact_contact(scene).value_or(scene);
    scene.time.substeps.reset();
    scene.time.stepping = rung.step == StepChoice::adaptive ? Stepping::adaptive : Stepping::uniform;
    if (rung.step == StepChoice::fixed) scene.time.substeps = rung.halvings;
    if (rung.mesh != 1.0) scale_mesh(rung.mesh, scene);
    set_element(rung.element, scene);
    if (rung.tangential_stiffness) {
        scene.contact.enforcement = ContactEnforcement::penalty;
        scene.contact.tangential_stiffness = rung.tangential_stiffness;
    }
    set_rock(rung, scene);
    if (rung.alpha) {
        scene.time.scheme = TimeScheme::hht;
        scene.time.alpha = *rung.alpha;
    }
    return scene;
}

} // namespace damslip
