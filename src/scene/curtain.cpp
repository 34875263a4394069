#include "scene/curtain.hpp"

namespace damslip {

double rock_permeability(const Scene& scene)
{
    return scene.foundation ? scene.foundation->permeability : Foundation{}.permeability;
}

bool curtain_changes_stiffness(const Scene& scene)
{
    if (!scene.curtain || !scene.foundation || !scene.curtain->young_modulus) return false;
    const Material& rock = scene.foundation->material;
    return *scene.curtain->young_modulus != rock.young_modulus || scene.curtain->poisson_ratio != rock.poisson_ratio;
}

bool curtain_changes_flow(const Scene& scene)
{
    return scene.curtain && scene.curtain->intact && scene.curtain->permeability != rock_permeability(scene);
}

} // namespace damslip
