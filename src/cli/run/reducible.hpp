#pragma once

#include "scene/scene.hpp"

namespace damslip::cli {

/// @throws UsageError for what a reduced run cannot do
void check_reducible(const Scene& scene);

} // namespace damslip::cli
