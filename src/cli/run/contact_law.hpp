#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip::cli {

/// The scene with rigid sticking and hard contact, everything else the same; none where that is its law already.
std::optional<Scene> with_exact_contact(const Scene& scene);

/// What has to be known of the contact law the scene chooses, one sentence each; none for the default.
std::vector<std::string> contact_law_notes(const Scene& scene);

} // namespace damslip::cli
