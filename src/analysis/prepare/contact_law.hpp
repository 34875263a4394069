#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip {

/// What has to be known of the contact law the scene chooses and of the water in its joint, one sentence each; none for the
/// default.
std::vector<std::string> contact_law_notes(const Scene& scene);

/// What has to be known first of a slip by finite elements on a base that lets no wave go; none where the rock radiates.
std::optional<std::string> base_note(const Scene& scene);

} // namespace damslip
