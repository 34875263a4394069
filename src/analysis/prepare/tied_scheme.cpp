#include "analysis/prepare/tied_scheme.hpp"

#include "fe2d/time/modal_run.hpp"
#include "scene/rock_mass.hpp"

#include <fmt/format.h>

namespace damslip {

namespace {

constexpr const char* auto_key = "time.scheme = \"auto\": ";

/// Rock whose damping no real modes separate; empty: none.
std::string rock_obstacle(const Scene& scene)
{
    if (rock_radiates(scene)) return "rock that lets waves out: real modes do not separate the equations";
    if (rock_edges_are_viscous(scene))
        return "a dashpot on every node of the rock's edges: real modes do not separate the equations";
    return {};
}

} // namespace

TiedScheme tied_scheme(const Scene& scene, const GroundMotion& motion, const fe2d::TiedRunOptions& options)
{
    const TimeOptions& time = scene.time;
    if (time.scheme != TimeScheme::automatic) return {time.scheme, {}};
    if (const std::string obstacle = rock_obstacle(scene); !obstacle.empty())
        return {TimeScheme::hht, fmt::format("{}HHT, since there is {}", auto_key, obstacle)};
    if (const std::string obstacle = fe2d::modal_obstacle(options); !obstacle.empty())
        return {TimeScheme::hht, fmt::format("{}HHT, since there is {}", auto_key, obstacle)};
    const double steps = motion.dt / options.dt.value_or(motion.dt) * static_cast<double>(motion.accel_h.size() - 1);
    if (steps < fe2d::modal_break_even)
        return {TimeScheme::hht,
                fmt::format("{}HHT, since {:.0f} steps cost less than finding modes", auto_key, steps)};
    return {TimeScheme::modal,
            fmt::format("{}superposition of modes, since a bonded base makes the model linear and {:.0f} direct steps "
                        "cost more than its modes",
                        auto_key, steps)};
}

std::string time_scheme_note(const Scene& scene)
{
    switch (scene.time.scheme) {
    case TimeScheme::automatic:
        if (const std::string obstacle = rock_obstacle(scene); !obstacle.empty())
            return fmt::format("{}HHT; {}", auto_key, obstacle);
        return scene.reservoir && scene.reservoir->model == ReservoirModel::acoustic
                   ? "time.scheme = \"auto\": HHT; with acoustic water real modes do not separate the equations"
                   : fmt::format(
                         "time.scheme = \"auto\": HHT where the base slides; superposition of modes on a bonded base "
                         "(fe --base tied) and a motion of {} steps or more",
                         fe2d::modal_break_even);
    case TimeScheme::hht:
        return "time.scheme = \"hht\": implicit, stable at any step";
    case TimeScheme::newmark:
        return "time.scheme = \"newmark\": implicit, no numerical damping of what the step does not resolve at gamma = "
               "0.5";
    case TimeScheme::central_difference:
        return "time.scheme = \"central-difference\": explicit, lumped mass, steps of at most 0.9 of the stability "
               "limit; sliding on "
               "a rigid base only";
    case TimeScheme::modal:
        break;
    }
    return "time.scheme = \"modal\": superposition of modes; for fe --base tied only, a base that slides has none";
}

} // namespace damslip
