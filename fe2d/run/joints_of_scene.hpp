#pragma once

#include "fe2d/contact/joint_laws.hpp"
#include "fe2d/run/contact_planes.hpp"
#include "scene/scene.hpp"

namespace damslip::fe2d {

/// The laws that base and lift joints have beside hard contact and Coulomb's friction; none where the scene names none.
/// @param base  strength of the base, in place of the scene's
JointLaws joint_laws(const Scene& scene, const Contact& base, const ContactPlanes& planes);

/// @throws InputError  where friction that falls with the rate does not lag behind it
void check_friction_over_rate(const Scene& scene);
/// @throws InputError  where landings of a dam by finite elements cannot have a restitution
void check_rebounds(const Scene& scene);

} // namespace damslip::fe2d
