#pragma once

#include <optional>

namespace damslip {

/// Growth of the process' resident memory from when this object was made to the peak since. Linux only: the peak is
/// reset through /proc/self/clear_refs. Memory that the allocator kept from before is handed back first, so that it does
/// not hide what is used anew.
class PeakMemory {
public:
    PeakMemory();
    std::optional<double> bytes() const; ///< none: this system does not say

private:
    std::optional<double> before_;
};

} // namespace damslip
