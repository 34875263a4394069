#include "analysis/prepare/rigid_rests.hpp"

#include "sliding/block/rigid_block.hpp"
#include "sliding/block/yield.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

namespace {

using sliding::BaseState;
using sliding::RigidBlock;
using sliding::StaticCase;

/// The block with the uplift of the crack that it opens, by its friction.
RigidBlock with_opening(const Scene& scene, const StaticCase& static_case, const BaseState& before,
                        const sliding::SeepageProfile& seepage, RigidBlock block)
{
    if (!scene.uplift || scene.uplift->water.opening == OpeningWater::unchanged) return block;
    const bool vertical =
        scene.motion.vertical && std::any_of(scene.motion.records.begin(), scene.motion.records.end(),
                                             [](const RecordFiles& record) { return record.vertical.has_value(); });
    block.opening = sliding::opening_uplift(scene, static_case, before, block, vertical, seepage);
    return block;
}

StaticCase without_drains(StaticCase static_case)
{
    static_case.uplift.drains = DrainState::ineffective;
    return static_case;
}

class FullHeadBetween final : public sliding::RestBetweenEvents {
public:
    FullHeadBetween(const Scene& scene, const StaticCase& static_case, const BaseState& before, const RigidBlock& block,
                    const sliding::BlockOptions& options)
        : scene_(scene), static_case_(static_case), before_(before), block_(block), options_(options),
          shaken_(static_case), water_(sliding::scene_added_mass(scene, static_case.loads.reservoir_level))
    {
        shaken_.crack =
            sliding::crack_rule_while_open(scene.uplift->water.opening).value_or(CrackRule::seismic_unchanged);
    }

    double crack(sliding::SlipDirection direction, double a_h, double a_v) const override
    {
        const bool downstream = direction == sliding::SlipDirection::downstream;
        const double d = sliding::sign(direction);
        const double slides = (downstream ? yield_downstream(block_) : yield_upstream(block_)).law.at(a_v);
        const double felt = std::min(d * a_h, slides);
        if (!(felt > 0.0)) return 0.0;
        sliding::Force load = before_.load;
        for (const sliding::Load& shaking : earthquake_loads(scene_, water_, d * felt, a_v))
            load += shaking.force.total();
        const sliding::CrackedBase base = shaken_base(scene_, shaken_, before_, load, options_.seepage);
        const sliding::Side opens = downstream ? sliding::Side::heel : sliding::Side::toe;
        return base.crack.side == opens ? base.crack.length : 0.0;
    }

    Rest rest(double heel, double toe) const override
    {
        StaticCase now = static_case_;
        now.opened = heel >= toe ? sliding::Crack{sliding::Side::heel, std::max(heel, before_heel())}
                                 : sliding::Crack{sliding::Side::toe, toe};
        now.uplift.curtain = CurtainState::damaged;
        const BaseState state = sliding::base_state(scene_, now, options_.seepage);
        std::optional<BaseState> later;
        if (scene_.drains && scene_.drains->lost_at_slip)
            later = sliding::base_state(scene_, without_drains(now), options_.seepage);
        RigidStages on_base = rigid_stages(scene_, now, state, later ? &*later : nullptr, options_);
        Note note{NoteKind::rest_after,
                  {state.base.crack.length, std::string(heel >= toe ? "heel" : "toe"), state.base.uplift.force / 1e6,
                   before_.base.uplift.force / 1e6}};
        auto next =
            std::make_shared<const FullHeadBetween>(scene_, now, state, on_base.opening_stages.front().block, options_);
        return {std::move(on_base.opening_stages), std::move(note), std::move(next)};
    }

private:
    double before_heel() const
    {
        return before_.base.crack.side == sliding::Side::heel ? before_.base.crack.length : 0.0;
    }

    Scene scene_;
    StaticCase static_case_;
    BaseState before_;
    RigidBlock block_;
    sliding::BlockOptions options_;
    StaticCase shaken_;
    sliding::AddedMassIntegral water_;
};

} // namespace

RigidStages rigid_stages(const Scene& scene, const StaticCase& static_case, const BaseState& before,
                         const BaseState* later, const sliding::BlockOptions& options)
{
    const std::optional<double> level = static_case.loads.reservoir_level;
    RigidStages made;
    made.block = with_opening(scene, static_case, before, options.seepage,
                              sliding::make_rigid_block(scene, before, level, options));
    made.stages = sliding::strength_stages(made.block, scene.contact);
    if (later)
        made.stages = sliding::with_block_from(made.stages, *scene.drains->lost_at_slip,
                                               sliding::make_rigid_block(scene, *later, level, options));
    made.opening_stages = made.stages;
    if (!made.block.opening) return made;
    for (sliding::SlipStage& stage : made.opening_stages) {
        const bool drains_lost = later && stage.block.uplift != made.block.uplift;
        stage.block = with_opening(scene, drains_lost ? without_drains(static_case) : static_case,
                                   drains_lost ? *later : before, options.seepage, stage.block);
    }
    return made;
}

std::shared_ptr<const sliding::RestBetweenEvents> rests_of(const Scene& scene, const StaticCase& static_case,
                                                           const BaseState& before, const RigidBlock& block,
                                                           const sliding::BlockOptions& options)
{
    if (scene.motion.sequence.empty() || !scene.uplift || scene.uplift->model == UpliftModel::none ||
        scene.uplift->water.after != WaterAfter::full)
        return nullptr;
    return std::make_shared<const FullHeadBetween>(scene, static_case, before, block, options);
}

} // namespace damslip
