#pragma once

#include <cstdint>

namespace damslip::fe2d {

/// Where a run stands, for a progress line.
struct RunProgress {
    double time = 0.0, end = 0.0; ///< [s]
    std::int64_t step = 0, steps = 0;
};

enum class RunAnswer { go_on, stop };

} // namespace damslip::fe2d
