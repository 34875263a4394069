#include "analysis/prepare/seepage_source.hpp"

#include "core/usage_error.hpp"
#include "fe2d/seepage/seepage.hpp"

namespace damslip {

sliding::SeepageProfile SeepageSource::profile_of(const Scene& scene)
{
    return [this, scene](const sliding::UpliftState& state) {
        const std::lock_guard lock(mutex_);
        const Key key{state.reservoir_level, state.tailwater_level, state.drains, state.curtain};
        const auto known = profiles_.find(key);
        return known != profiles_.end() ? known->second : profiles_.emplace(key, solve(scene, state)).first->second;
    };
}

sliding::PressureProfile SeepageSource::solve(const Scene& scene, const sliding::UpliftState& state)
{
    fe2d::SeepageState water;
    water.reservoir_level = state.reservoir_level;
    water.tailwater_level = state.tailwater_level;
    water.drains =
        state.drains == sliding::DrainState::effective ? fe2d::DrainState::as_scene : fe2d::DrainState::ineffective;
    water.curtain =
        state.curtain == sliding::CurtainState::intact ? fe2d::CurtainState::as_scene : fe2d::CurtainState::ruptured;
    const fe2d::SeepageResult result = fe2d::solve_seepage(scene, water);
    if (!result.field.solver.ok())
        throw NotConverged(Diagnostic{scene.file.string(), 0, 0,
                                      "the seepage below the dam could not be solved: " + result.field.solver.text(),
                                      "permeabilities within some ten orders of magnitude of each other",
                                      "check foundation.permeability_m_s and curtain.permeability_m_s"});
    sliding::PressureProfile profile;
    for (const fe2d::BasePressure& p : result.profile) profile.points.push_back({p.distance, p.pressure});
    return profile;
}

} // namespace damslip
