#include "analysis/accuracy/peak_memory.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace damslip {

namespace {

/// A line of /proc/self/status, "VmRSS:   1234 kB" [bytes].
std::optional<double> status_bytes(const std::string& name)
{
    std::ifstream status("/proc/self/status");
    std::string word;
    double kilobytes = 0.0;
    while (status >> word)
        if (word == name + ":" && status >> kilobytes) return 1024.0 * kilobytes;
    return std::nullopt;
}

bool reset_peak()
{
    std::ofstream clear("/proc/self/clear_refs");
    clear << "5"; // proc(5): the peak becomes the present size
    clear.flush();
    return clear.good();
}

} // namespace

PeakMemory::PeakMemory()
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    if (reset_peak()) before_ = status_bytes("VmRSS");
}

std::optional<double> PeakMemory::bytes() const
{
    const std::optional<double> peak = status_bytes("VmHWM");
    if (!before_ || !peak) return std::nullopt;
    return std::max(0.0, *peak - *before_);
}

} // namespace damslip
