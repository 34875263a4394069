#pragma once

#include "random/check_run.hpp"

namespace damslip::random {

/// Runs `screen` and `fe` of a scene and looks for answers that promise more than they hold:
///
/// - a slip beside a status that has none, or from a stage or a step that was not resolved;
/// - exit code 0 although an answer is missing, or one is there whose step leaves more open than time.slip_tolerance;
/// - PASS or FAIL although the allowable slip lies within the error, or the error is not known.
CheckedRuns check_promise(const std::filesystem::path& scene);

} // namespace damslip::random
