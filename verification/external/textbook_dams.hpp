#pragma once

#include "verification/external/external.hpp"

namespace damslip::external {

/// Worked gravity dams of a textbook, each as the text of a scene that goes through the functions of `screen`.
Source textbook_dams_source();

} // namespace damslip::external
