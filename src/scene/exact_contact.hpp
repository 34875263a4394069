#pragma once

#include "scene/scene.hpp"

#include <optional>

namespace damslip {

/// The scene with rigid sticking and hard contact, everything else the same; none where that is its law already.
std::optional<Scene> with_exact_contact(const Scene& scene);

} // namespace damslip
