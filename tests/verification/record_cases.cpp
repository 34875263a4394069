#include "verification/modules.hpp"

namespace damslip::verification {

void add_record_cases(Registry& registry) { (void)registry; }

} // namespace damslip::verification
