#pragma once

#include <string>

namespace damslip {

std::string program_version(); ///< "0.1.0"

} // namespace damslip
