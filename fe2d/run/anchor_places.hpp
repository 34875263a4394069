#pragma once

#include "fe2d/contact/anchor_law.hpp"
#include "fe2d/run/contact_planes.hpp"
#include "scene/scene.hpp"

namespace damslip::fe2d {

/// The scene's anchors on the pairs next to where they cross their joints. @returns null for a scene without any
std::unique_ptr<AnchorLaw> anchors_on(const Scene& scene, const ContactPlanes& planes);

} // namespace damslip::fe2d
