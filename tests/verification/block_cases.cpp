#include "verification/modules.hpp"

namespace damslip::verification {

void add_block_cases(Registry& registry) { (void)registry; }

} // namespace damslip::verification
