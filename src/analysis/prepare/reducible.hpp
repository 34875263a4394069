#pragma once

#include "core/input_error.hpp"
#include "scene/scene.hpp"

#include <optional>

namespace damslip {

/// What of the scene a reduced run cannot do; nothing where it can.
std::optional<Diagnostic> why_not_reducible(const Scene& scene);

/// @throws UsageError with that
void check_reducible(const Scene& scene);

} // namespace damslip
