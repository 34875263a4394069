#include "verification/external/external.hpp"

#include <cmath>

namespace damslip::external {

bool Result::within() const
{
    return std::isfinite(ours) && std::abs(ours - theirs) <= accuracy;
}

} // namespace damslip::external
