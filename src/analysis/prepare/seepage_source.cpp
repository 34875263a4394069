#include "analysis/prepare/seepage_source.hpp"

#include "core/usage_error.hpp"
#include "fe2d/seepage/seepage.hpp"

namespace damslip {

sliding::SeepageProfile SeepageSource::profile_of(const Scene& scene)
{
    return [this, scene](const UpliftState& state) {
        const std::lock_guard lock(mutex_);
        const Key key{state.reservoir_level, state.tailwater_level, state.drains, state.curtain};
        const auto known = profiles_.find(key);
        return known != profiles_.end() ? known->second : profiles_.emplace(key, solve(scene, state)).first->second;
    };
}

PressureProfile SeepageSource::uplift_of(const Scene& scene)
{
    if (!scene.uplift) return {};
    return sliding::uplift_profile(scene, scene_uplift_state(scene), {}, profile_of(scene));
}

PressureProfile SeepageSource::solve(const Scene& scene, const UpliftState& state)
{
    const fe2d::SeepageResult result = fe2d::solve_seepage(scene, state);
    if (!result.field.solver.ok())
        throw NotConverged(Diagnostic{scene.file.string(), 0, 0,
                                      "the seepage below the dam could not be solved: " + result.field.solver.text(),
                                      "permeabilities within some ten orders of magnitude of each other",
                                      "check foundation.permeability_m_s and curtain.permeability_m_s"});
    return result.profile;
}

} // namespace damslip
