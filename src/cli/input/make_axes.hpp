#pragma once

#include "analysis/sweep/sweep_axes.hpp"
#include "cli/input/sweep_arguments.hpp"

namespace damslip::cli {

/// The axes as typed, checked; the scene's own value where nothing is. @throws UsageError
Axes make_axes(const SweepArguments& arguments, const Scene& scene);

} // namespace damslip::cli
