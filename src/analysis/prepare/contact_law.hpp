#pragma once

#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace damslip {

/// What has to be known of the contact law the scene chooses and of the water in its joint, one sentence each; none for the
/// default.
std::vector<std::string> contact_law_notes(const Scene& scene);

} // namespace damslip
