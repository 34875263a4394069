#pragma once

#include "cli/contact_tables.hpp"
#include "scene/scene.hpp"

namespace damslip::cli {

/// The scene with rigid sticking and hard contact, everything else the same; none where that is its law already.
std::optional<Scene> with_exact_contact(const Scene& scene);

/// Slip of each run beside that of the same run with exact contact: what penalty, slip tolerance or soft
/// normal contact err by.
Table contact_law_table(const std::vector<ContactRun>& runs);

/// What has to be known of the contact law the scene chooses, one sentence each; none for the default.
std::vector<std::string> contact_law_notes(const Scene& scene);

} // namespace damslip::cli
