// Allocations of memory per time step, once the first ten steps are done: the aim is none.
#include "step_allocations.hpp"

#include <cstdio>

namespace {

using damslip::test::CountedRun;

void count(const char* name, CountedRun which)
{
    constexpr std::size_t first_steps = 10; // make operators and work space
    const damslip::test::StepAllocations counted = damslip::test::count_allocations(which, 2.0, 0.5);
    const auto steps = static_cast<double>(counted.by_step.size() - first_steps);
    std::printf("%-32s %10.3f %16ld %12.3f\n", name, static_cast<double>(counted.after(first_steps)) / steps,
                counted.steps_with_some(first_steps), 1e3 * counted.slip);
}

} // namespace

int main()
{
    std::printf("%-32s %10s %16s %12s\n", "steps 10 to 2000 of", "a step", "steps with some", "slip [mm]");
    count("exact contact, massless rock", CountedRun::massless);
    count("exact contact, radiating rock", CountedRun::radiating);
    count("reduced, 12 modes", CountedRun::reduced);
    return 0;
}
