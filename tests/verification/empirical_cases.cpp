#include "verification/modules.hpp"

namespace damslip::verification {

void add_empirical_cases(Registry& registry) { (void)registry; }

} // namespace damslip::verification
