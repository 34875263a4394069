#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip {

/// What has to be known of the contact law the scene chooses and of the water in its joint, one sentence each; none for the
/// default.
std::vector<std::string> contact_law_notes(const Scene& scene);

/// What has to be known first of a slip by finite elements on a base that gives no way; none where there is rock.
std::optional<std::string> rigid_base_note(const Scene& scene);

} // namespace damslip
