#include "sliding/equilibrium/opening_crack.hpp"

#include "core/units.hpp"
#include "sliding/block/base_equations.hpp"
#include "sliding/equilibrium/mouth_water.hpp"
#include "sliding/equilibrium/shaken_base.hpp"

#include <algorithm>

namespace damslip::sliding {

namespace {

constexpr int scan_steps = 24;
constexpr int table_steps = 10; ///< of 0.1 g, up and down

/// The block at the edge of sliding, with the crack of the same instant.
class EdgeOfSliding {
public:
    EdgeOfSliding(const Scene& scene, const StaticCase& static_case, const BaseState& before, const RigidBlock& block,
                  const SeepageProfile& seepage)
        : scene_(scene), static_case_(static_case), before_(before), seepage_(seepage),
          equations_(base_equations(block)), friction_(block.friction),
          cohesion_(block.cohesion_force + block.dowel_force),
          water_(scene_added_mass(scene, static_case.loads.reservoir_level))
    {
    }

    /// Change of U where sliding in a direction begins.
    double change(SlipDirection direction, double a_v) const
    {
        // Slides for certain where it would without any uplift.
        const double u = before_.base.uplift.force;
        const double at_rest = excess(direction, 0.0, a_v, -u), per_accel = excess(direction, 1.0, a_v, -u) - at_rest;
        if (!(per_accel > 0.0) || at_rest >= 0.0) return 0.0;
        const double last = -at_rest / per_accel;
        const auto slides = [&](double a) { return excess(direction, a, a_v, opened(direction, a, a_v)) >= 0.0; };
        double not_yet = 0.0, already = last;
        for (int k = 1; k < scan_steps; ++k) {
            const double a = last * k / scan_steps;
            if (slides(a)) {
                already = a;
                break;
            }
            not_yet = a;
        }
        while (already - not_yet > 1e-13 * last) {
            const double middle = not_yet + 0.5 * (already - not_yet);
            if (middle <= not_yet || middle >= already) break;
            (slides(middle) ? already : not_yet) = middle;
        }
        return opened(direction, not_yet, a_v);
    }

private:
    /// What drives beyond the resistance. @param change  of the uplift
    double excess(SlipDirection direction, double a, double a_v, double change) const
    {
        const double d = sign(direction), a_h = d * a;
        return d * equations_.drive.at(a_h, a_v) - cohesion_ - friction_ * (equations_.normal.at(a_h, a_v) - change);
    }
    double opened(SlipDirection direction, double a, double a_v) const
    {
        Force load = before_.load;
        for (const Load& shaking : earthquake_loads(scene_, water_, sign(direction) * a, a_v))
            load += shaking.force.total();
        return shaken_base(scene_, static_case_, before_, load, seepage_).uplift.force - before_.base.uplift.force;
    }

    const Scene& scene_;
    const StaticCase& static_case_;
    const BaseState& before_;
    const SeepageProfile& seepage_;
    BaseEquations equations_;
    double friction_, cohesion_;
    AddedMassIntegral water_;
};

} // namespace

std::optional<CrackRule> crack_rule_while_open(OpeningWater opening)
{
    switch (opening) {
    case OpeningWater::zero:
        return CrackRule::seismic_zero;
    case OpeningWater::full:
    case OpeningWater::mouth:
        return CrackRule::seismic_full;
    case OpeningWater::unchanged:
    case OpeningWater::reynolds:
        break;
    }
    return std::nullopt;
}

std::shared_ptr<const OpeningUplift> opening_uplift(const Scene& scene, const StaticCase& static_case,
                                                    const BaseState& before, const RigidBlock& block, bool vertical,
                                                    const SeepageProfile& seepage)
{
    if (!scene.uplift || scene.uplift->model == UpliftModel::none) return nullptr;
    const std::optional<CrackRule> rule = crack_rule_while_open(scene.uplift->water.opening);
    if (!rule) return nullptr;
    StaticCase shaken = static_case;
    shaken.crack = *rule;
    const EdgeOfSliding edge(scene, shaken, before, block, seepage);
    OpeningUplift table;
    const int steps = vertical ? table_steps : 0;
    for (int k = -steps; k <= steps; ++k) {
        const double a_v = 0.1 * k * units::standard_gravity;
        table.accel_v.push_back(a_v);
        table.downstream.push_back(edge.change(SlipDirection::downstream, a_v));
        table.upstream.push_back(edge.change(SlipDirection::upstream, a_v));
    }
    const JointWaterLaw& law = scene.uplift->water;
    if (law.opening == OpeningWater::mouth)
        table.slow = mouth_water(scene, static_case, before, block, *law.mouth_speed, vertical, seepage);
    return std::make_shared<const OpeningUplift>(std::move(table));
}

} // namespace damslip::sliding
