#pragma once

#include <ctime>

namespace damslip::cli {

/// Processor time of this process since it was made, all threads: what the wall clock shows on an otherwise idle machine,
/// as rungs run on one thread, but not disturbed by what else the machine does.
class ProcessorTime {
public:
    double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; } ///< [s]

private:
    std::clock_t start_ = std::clock();
};

} // namespace damslip::cli
