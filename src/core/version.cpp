#include "core/version.hpp"

namespace damslip {

std::string program_version()
{
    return DAMSLIP_VERSION;
}

} // namespace damslip
