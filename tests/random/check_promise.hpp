#pragma once

#include "random/check_run.hpp"

#include <cstdint>

namespace damslip::random {

/// Runs `screen` and `fe` of a scene and looks for answers that promise more than they hold:
///
/// - a slip beside a status that has none, or from a stage or a step that was not resolved;
/// - exit code 0 although an answer is missing, or one is there whose step leaves more open than time.slip_tolerance;
/// - PASS or FAIL although the allowable slip lies within the error, or the error is not known.
///
/// Then other commands, the quick ones and `turn` of the dear ones, each as text or as --json. Of every one:
///
/// - exit code 0, 2, 3 or 4; an error names the file, what is expected and what to do; with --json standard output is one object;
/// - no "inf" or "nan" in a sentence, a table or an object;
/// - no slip beside a status that has none, wherever the object has both.
///
/// And one number of the scene by which the rigid block goes is made a twentieth larger: `screen` has another answer.
CheckedRuns check_promise(const std::filesystem::path& scene, std::uint32_t turn);

} // namespace damslip::random
