#include "sliding/block/slip_stage.hpp"

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "scene/joint_bond.hpp"
#include "sliding/block/base_equations.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {
namespace {

void lose_cohesion_at_slip(SlipStages& stages)
{
    if (stages.front().block.cohesion_force == 0.0) return;
    // The stage at rest keeps its cohesion; a copy without it holds from the first movement on.
    SlipStage moving = stages.front();
    for (SlipStage& stage : stages) stage.block.cohesion_force = 0.0;
    stages.insert(stages.begin(), moving);
    stages.front().friction_slope = 0.0;
}

[[noreturn]] void refuse(const std::string& problem, const std::string& expected, const std::string& fix)
{
    Diagnostic diagnostic;
    diagnostic.problem = problem;
    diagnostic.expected = expected;
    diagnostic.fix = fix;
    throw InputError(diagnostic);
}

} // namespace

SlipStages strength_stages(RigidBlock block, const Contact& contact)
{
    SlipStages stages;
    for (const FrictionOverSlip::Piece& piece : FrictionOverSlip(contact).pieces()) {
        block.friction = piece.friction;
        stages.push_back({piece.from_slip, block, piece.slope, contact.rate, contact.restitution});
    }
    if (contact.cohesion_lost_at_slip) lose_cohesion_at_slip(stages);
    return stages;
}

SlipStages with_block_from(const SlipStages& stages, double from_slip, const RigidBlock& later)
{
    const auto changed = [&](SlipStage stage) {
        const RigidBlock old = stage.block;
        stage.block = later;
        stage.block.friction = old.friction;
        stage.block.cohesion_force = old.cohesion_force;
        return stage;
    };
    SlipStages result;
    bool reached = false;
    for (const SlipStage& stage : stages) {
        if (!reached && stage.from_slip > from_slip) {
            SlipStage middle = changed(result.back());
            middle.block.friction = friction_at(result.back(), from_slip);
            middle.from_slip = from_slip;
            result.push_back(middle);
            reached = true;
        }
        result.push_back(reached ? changed(stage) : stage);
    }
    if (!reached) {
        SlipStage last = changed(result.back());
        last.block.friction = friction_at(result.back(), from_slip);
        last.from_slip = from_slip;
        result.push_back(last);
    }
    return result;
}

double friction_at(const SlipStage& stage, double path)
{
    return std::max(0.0, stage.block.friction + stage.friction_slope * (path - stage.from_slip));
}

void check_stages(const SlipStages& stages)
{
    if (stages.empty())
        refuse("a sliding block needs at least one stage.", "the block at rest first", "give the block");
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const double from = stages[i].from_slip;
        if (!std::isfinite(from) || (i == 0 ? from != 0.0 : from < stages[i - 1].from_slip))
            refuse("slip-dependent strength: slip value " + shortest(from) + " m is not allowed here.",
                   "slip values in m that start at 0 and never decrease", "sort the table by slip");
        check_block(stages[i].block);
        if (stages[i].friction_slope == 0.0) continue;
        if (i + 1 == stages.size())
            refuse("the last friction of a table cannot go on changing with slip.",
                   "a constant value from the last slip on", "add the final point of the table");
        RigidBlock at_end = stages[i].block;
        at_end.friction += stages[i].friction_slope * (stages[i + 1].from_slip - from);
        if (at_end.friction < 0.0 && at_end.friction > -1e-12)
            at_end.friction = 0.0; // round-off of a table that ends at zero
        check_block(at_end);
    }
}

} // namespace damslip::sliding
