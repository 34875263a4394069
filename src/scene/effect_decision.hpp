#pragma once

#include "scene/effect_plan.hpp"

#include <string>

namespace damslip {

/// Why an effect is on or off, and what it costs when on.
struct Decision {
    bool on;
    std::string reason;
    std::string cost;
};

/// Does a run of this method take the effect into account?
Decision decide(Effect effect, const Scene& scene, Method method);

} // namespace damslip
