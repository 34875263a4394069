#include "verification/modules.hpp"

namespace damslip::verification {

void add_equilibrium_cases(Registry& registry) { (void)registry; }

} // namespace damslip::verification
