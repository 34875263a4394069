#pragma once

#include "core/parallel.hpp"
#include "fe2d/assembly/assemble.hpp"
#include "scene/scene.hpp"
#include "sliding/uplift/uplift.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>

namespace damslip::fe2d {
struct SeepageResult; // fe2d/seepage/seepage.hpp
} // namespace damslip::fe2d

namespace damslip {

/// The scene's hydrodynamic mass as the FE model takes it; empty where the reservoir is hydrostatic, acoustic or absent.
fe2d::AddedMassLaw added_mass_law(const Scene& scene);

/// What became of reservoir.model = "auto".
struct ReservoirChoice {
    double frequency = 0.0; ///< first natural frequency with added mass [Hz]
    std::string reason;     ///< one sentence with the numbers
};

/// Decides reservoir.model = "auto" by the compressibility criterion (3-36) on the computed first frequency: acoustic where Omega_r < 2, else
/// added mass. Nothing where the scene says itself what it wants.
/// @throws Interrupted
std::optional<ReservoirChoice> resolve_reservoir_model(Scene& scene, const StopAsked& stop = {});

/// How added_mass.period_s = "dam" came out.
struct DamPeriod {
    double frequency = 0.0; ///< f_1 with the added mass of its own period [Hz]
    int iterations = 0;
    double incompressible_frequency = 0.0; ///< f_1 with T = infinity [Hz]
};

/// Finds the period of the dam with the added mass that belongs to it: the root of T = 1/f_1(T), bracketed between the reservoir's own
/// period, where the mass is infinite, and the incompressible answer. The scene gets the value as added_mass.period.
/// @returns nothing, the scene as it was, where the period is not asked for or no added mass acts: without a reservoir, with an
/// empty, hydrostatic or acoustic one.
/// @throws InputError where the dam is so stiff that its period lies below the reservoir's; Interrupted
std::optional<DamPeriod> resolve_dam_period(Scene& scene, const StopAsked& stop = {});

/// @throws NotConverged where the seepage below the dam has lost its accuracy
void check_seepage(const Scene& scene, const fe2d::SeepageResult& result);

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
