#pragma once

#include "scene/scene.hpp"
#include "sliding/uplift/uplift.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <tuple>

namespace damslip {

/// Uplift profiles by the seepage solver for the rigid block, each state of water, curtain and drains solved once. For one scene and
/// variants of it that differ in levels, strength and uplift model only. Safe from several threads.
class SeepageSource {
public:
    /// For uplift.model = "seepage" of this scene; the function keeps a reference to this object.
    /// It throws InputError when the base does not fit the rock box, NotConverged when the solver loses its accuracy.
    sliding::SeepageProfile profile_of(const Scene& scene);

    /// Uplift under the closed base, in the scene's own state of water, curtain and drains; empty where the scene has none.
    PressureProfile uplift_of(const Scene& scene);

    std::size_t solutions() const { return profiles_.size(); }

private:
    using Key = std::tuple<std::optional<double>, std::optional<double>, DrainState, CurtainState>;
    PressureProfile solve(const Scene& scene, const UpliftState& state);

    std::mutex mutex_;
    std::map<Key, PressureProfile> profiles_;
};

} // namespace damslip
