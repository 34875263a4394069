#pragma once

#include <vector>

namespace damslip::records {

/// Adds sin^2(pi x)(c0 + c1 x), x = t/duration, such that the piecewise-linear record ends with zero velocity and
/// displacement.
void end_at_rest(std::vector<double>& accel);

/// Makes max |a| equal to `pga`, not by scaling but locally: the largest sample is raised if it is below, samples above are cut, and
/// each change d of a sample is paid by -d/2 at both neighbours, which leaves final velocity and displacement as they are. A factor
/// near 1 does the rest. @param accel  not zero throughout, ends at rest
void set_peak(std::vector<double>& accel, double pga);

/// Rounds to multiples of 1e-6 m/s^2, towards zero where `pga` would be passed; the sample of largest |a| keeps its value. Files stay
/// small, and differences in the last digits of mathematical libraries do not show.
void round_samples(std::vector<double>& accel, double pga);

} // namespace damslip::records
