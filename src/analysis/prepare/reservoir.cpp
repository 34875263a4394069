#include "analysis/prepare/reservoir.hpp"

#include "core/input_error.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/seepage/seepage.hpp"
#include "scene/rock_mass.hpp"
#include "sliding/loads/added_mass.hpp"

#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

sliding::WaterColumn water_column(const Scene& scene)
{
    return {scene.reservoir->level, scene.reservoir->density, scene.reservoir->bulk_modulus};
}

double first_frequency(const Scene& scene, const StopAsked& stop)
{
    fe2d::ModelOptions options;
    options.added_mass = added_mass_law(scene);
    stop_if_asked(stop, "the search for the dam's first frequency");
    const fe2d::Model model = fe2d::build_model(with_massless_rock(scene), options);
    stop_if_asked(stop, "the search for the dam's first frequency");
    const fe2d::NaturalModes modes = fe2d::natural_modes(model, 1, {.factorisation = fe2d::Factorisation::supernodal});
    return modes.frequency.size() ? modes.frequency[0] : std::nan("");
}

} // namespace

std::optional<ReservoirChoice> resolve_reservoir_model(Scene& scene, const StopAsked& stop)
{
    if (!scene.reservoir || scene.reservoir->model != ReservoirModel::automatic || scene.reservoir->level <= 0)
        return std::nullopt;
    ReservoirChoice choice{first_frequency(scene, stop), ""};
    const sliding::CompressibilityCriterion c =
        sliding::compressibility_criterion(water_column(scene), choice.frequency);
    scene.reservoir->model = c.compressible_matters ? ReservoirModel::acoustic : ReservoirModel::added_mass;
    choice.reason = fmt::format("reservoir.model = \"auto\": Omega_r = (c/4h)/f_1 = {:.3g} {} 2 with f_1 = {:.4g} Hz "
                                "(3-36), so the water is {}",
                                c.frequency_ratio, c.compressible_matters ? "<" : ">=", choice.frequency,
                                c.compressible_matters ? "acoustic" : "added mass");
    return choice;
}

fe2d::AddedMassLaw added_mass_law(const Scene& scene)
{
    if (!scene.reservoir || scene.reservoir->level <= 0 || scene.reservoir->model == ReservoirModel::hydrostatic ||
        scene.reservoir->model == ReservoirModel::acoustic)
        return {};
    return [method = scene.added_mass, water = water_column(scene)](Point at, double face_angle) {
        return sliding::added_mass_per_area(method, water, water.depth - at.y, face_angle);
    };
}

std::optional<DamPeriod> resolve_dam_period(Scene& scene, const StopAsked& stop)
{
    if (!scene.added_mass.period_of_dam || !added_mass_law(scene)) return std::nullopt;
    DamPeriod result;
    Scene trial = scene;
    trial.added_mass.period_of_dam = false;
    trial.added_mass.period.reset();
    result.incompressible_frequency = first_frequency(trial, stop);
    const double reservoir_period = sliding::reservoir_period(water_column(scene));

    // phi(T) = 1/f_1(T) - T is positive just above T_r, where the mass grows without bound, if a dam period exists, and falls with T.
    const auto period_of = [&](double period) {
        trial.added_mass.period = period;
        ++result.iterations;
        return 1.0 / first_frequency(trial, stop);
    };
    double low = reservoir_period * (1 + 1e-6),
           high = std::max(2.0 / result.incompressible_frequency, 2 * reservoir_period);
    if (!(period_of(low) > low))
        refuse(scene.file,
               fmt::format("added_mass.period_s = \"dam\": the dam's period, {:.4g} s with incompressible "
                           "water, lies below the reservoir's own, 4 h/c = {:.4g} s.",
                           1 / result.incompressible_frequency, reservoir_period),
               "a dam slower than its reservoir: Westergaard's series (3-1) has no real value otherwise",
               "leave period_s out (incompressible water) or use reservoir.model = \"acoustic\"");
    while (period_of(high) > high) high *= 2;
    while (high - low > 1e-9 * high) {
        const double middle = 0.5 * (low + high);
        (period_of(middle) > middle ? low : high) = middle;
        if (result.iterations > 100) break;
    }
    scene.added_mass.period = high;
    scene.added_mass.period_of_dam = false;
    result.frequency = 1.0 / high;
    return result;
}

void check_seepage(const Scene& scene, const fe2d::SeepageResult& result)
{
    if (!result.field.solver.ok())
        throw NotConverged(
            Diagnostic{scene.file.string(), 0, 0,
                       "the seepage below the dam could not be solved: " + text_of(result.field.solver.note()),
                       "permeabilities within some ten orders of magnitude of each other",
                       "check foundation.permeability_m_s and curtain.permeability_m_s"});
}

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
    check_seepage(scene, result);
    return result.profile;
}

} // namespace damslip
