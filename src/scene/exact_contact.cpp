#include "scene/exact_contact.hpp"

namespace damslip {

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

} // namespace damslip
