#include "sliding/block/rigid_block.hpp"

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "scene/joint_bond.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace damslip::sliding {

namespace {

void require(bool holds, std::vector<Diagnostic>& found, const char* what, double value, const char* expected,
             const char* fix)
{
    if (holds) return;
    Diagnostic diagnostic;
    diagnostic.problem = std::string("rigid block: ") + what + " = " + shortest(value) + " is not allowed.";
    diagnostic.expected = expected;
    diagnostic.fix = fix;
    found.push_back(diagnostic);
}

void check_sliding_mass(const BaseEquations& equations, double friction, SlipDirection direction,
                        std::vector<Diagnostic>& found)
{
    const double mass = sliding_mass(equations, friction, direction);
    require(
        mass > 0.0, found,
        direction == SlipDirection::downstream ? "mass felt by downstream sliding, m + M_w k cos(theta)"
                                               : "mass felt by upstream sliding, m + M_w k cos(theta)",
        mass,
        "more than 0 kg/m; otherwise friction and added mass jam the block and rigid-body motion has no unique answer",
        "use a flatter base, less friction or less added mass");
}

} // namespace

BaseEquations base_equations(const RigidBlock& block)
{
    const double c = std::cos(block.base_inclination);
    const double s = std::sin(block.base_inclination);
    const double weight = block.mass * block.gravity + block.vertical_force;
    const AddedMassTensor& w = block.added_mass;

    // Products with A = m I + M^w: columns A x and A y first, then their components along t and n.
    const double Axx = block.mass + w.xx, Axy = w.xy, Ayy = block.mass + w.yy;
    const double tAx = c * Axx - s * Axy, tAy = c * Axy - s * Ayy;
    const double nAx = s * Axx + c * Axy, nAy = s * Axy + c * Ayy;

    BaseEquations e;
    e.drive = {c * block.horizontal_force + s * weight, tAx, -tAy};
    e.normal = {c * weight - s * block.horizontal_force - block.uplift, -nAx, nAy};
    // t.t = 1, t.n = 0 and n.n = 1 are put in by hand: the block's own mass leaves no round-off in the products.
    e.mass_tt = block.mass + c * c * w.xx - 2.0 * c * s * w.xy + s * s * w.yy + block.chain_mass;
    e.mass_tn = c * s * (w.xx - w.yy) + (c * c - s * s) * w.xy;
    e.mass_nn = block.mass + s * s * w.xx + 2.0 * c * s * w.xy + c * c * w.yy;
    return e;
}

double sliding_mass(const BaseEquations& equations, double friction, SlipDirection direction)
{
    return equations.mass_tt + sign(direction) * friction * equations.mass_tn;
}

GroundLinear excess_drive(const BaseEquations& e, const RigidBlock& block, SlipDirection direction)
{
    const double d = sign(direction);
    return {d * e.drive.constant - block.cohesion_force - block.dowel_force - block.friction * e.normal.constant,
            d * e.drive.per_a_h - block.friction * e.normal.per_a_h,
            d * e.drive.per_a_v - block.friction * e.normal.per_a_v};
}

GroundLinear free_normal_force(const BaseEquations& e)
{
    const double ratio = e.mass_tn / e.mass_tt;
    return {e.normal.constant + ratio * e.drive.constant, e.normal.per_a_h + ratio * e.drive.per_a_h,
            e.normal.per_a_v + ratio * e.drive.per_a_v};
}

void check_block(const RigidBlock& b)
{
    std::vector<Diagnostic> found;
    const AddedMassTensor& w = b.added_mass;
    require(std::isfinite(b.mass) && b.mass > 0.0, found, "mass", b.mass, "more than 0 kg/m",
            "check section and density");
    require(std::isfinite(b.friction) && b.friction >= 0.0, found, "friction", b.friction, "a number >= 0",
            "check contact.friction");
    require(std::isfinite(b.cohesion_force) && b.cohesion_force >= 0.0, found, "cohesion force", b.cohesion_force,
            ">= 0 N/m", "check contact.cohesion");
    require(std::isfinite(b.dowel_force) && b.dowel_force >= 0.0, found, "dowel force", b.dowel_force, ">= 0 N/m",
            "check the anchors");
    require(std::isfinite(b.gravity) && b.gravity > 0.0, found, "gravity", b.gravity, "more than 0 m/s^2",
            "check site.gravity");
    require(std::abs(b.base_inclination) < 0.5 * std::numbers::pi, found, "base inclination in rad", b.base_inclination,
            "between -90 and 90 degrees", "check the base of the section");
    require(std::isfinite(w.xx) && w.xx >= 0.0, found, "added mass xx", w.xx, ">= 0 kg/m", "check the reservoir");
    require(std::isfinite(w.yy) && w.yy >= 0.0, found, "added mass yy", w.yy, ">= 0 kg/m", "check the reservoir");
    require(std::isfinite(w.xy) && w.xy * w.xy <= w.xx * w.yy * (1.0 + 1e-12), found, "added mass xy", w.xy,
            "xy^2 <= xx yy: a sum of m n n^T", "check the reservoir");
    for (const double force : {b.vertical_force, b.horizontal_force, b.uplift})
        require(std::isfinite(force), found, "a static force", force, "a finite force in N/m", "check the loads");
    if (found.empty()) {
        const BaseEquations equations = base_equations(b);
        check_sliding_mass(equations, b.friction, SlipDirection::downstream, found);
        check_sliding_mass(equations, b.friction, SlipDirection::upstream, found);
    }
    if (!found.empty()) throw InputError(std::move(found));
}

double OpeningUplift::at(SlipDirection direction, double a_v) const
{
    const std::vector<double>& change = direction == SlipDirection::downstream ? downstream : upstream;
    if (a_v <= accel_v.front()) return change.front();
    if (a_v >= accel_v.back()) return change.back();
    const auto after =
        static_cast<std::size_t>(std::upper_bound(accel_v.begin(), accel_v.end(), a_v) - accel_v.begin());
    const double share = (a_v - accel_v[after - 1]) / (accel_v[after] - accel_v[after - 1]);
    return change[after - 1] + share * (change[after] - change[after - 1]);
}

double OpeningUplift::per_accel_v(SlipDirection direction) const
{
    if (accel_v.size() < 2) return 0.0;
    const double step = 0.5 * (accel_v[1] - accel_v[0]);
    return (at(direction, step) - at(direction, -step)) / (2.0 * step);
}

double OpeningUplift::largest() const
{
    return std::max({0.0, *std::max_element(downstream.begin(), downstream.end()),
                     *std::max_element(upstream.begin(), upstream.end())});
}

double OpeningUplift::largest(SlipDirection direction, double a_v_min, double a_v_max) const
{
    const auto change = [&](double a_v) {
        return slow ? slow->sliding(direction, a_v, slow->first(direction)).change : at(direction, a_v);
    };
    double most = std::max(change(a_v_min), change(a_v_max));
    for (const double a_v : accel_v)
        if (a_v_min < a_v && a_v < a_v_max) most = std::max(most, change(a_v));
    return most;
}

double OpeningUplift::next_bend(const Line& a_v, double from) const
{
    constexpr double round_off = 1e-12;
    double next = 1.0;
    for (const double bend : accel_v) {
        const double share = (bend - a_v.now) / (a_v.end - a_v.now);
        if (share > from + round_off && share < 1.0 - round_off) next = std::min(next, share);
    }
    return next;
}

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

namespace {

[[noreturn]] void refuse_yield(const std::string& problem, const std::string& expected, const std::string& fix)
{
    throw InputError(Diagnostic{"", 0, 0, problem, expected, fix});
}

void check_points(const std::vector<YieldPoint>& points)
{
    if (points.empty()) refuse_yield("no yield acceleration is given.", "one at least, at path 0", "give one");
    if (points.front().path != 0.0)
        refuse_yield("the first path of the yield acceleration is " + shortest(points.front().path) + " m.", "0 m",
                     "begin with the yield of a block that has not slipped");
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!(points[i].yield >= 0.0) || !std::isfinite(points[i].yield))
            refuse_yield("the yield acceleration " + shortest(points[i].yield) + " m/s2 is not allowed.",
                         "a number >= 0", "a slope that slides by itself has no slip: give the yield it has at rest");
        if (!std::isfinite(points[i].path) || (i > 0 && points[i].path < points[i - 1].path))
            refuse_yield("the path " + shortest(points[i].path) + " m of the yield acceleration is not allowed here.",
                         "paths that ascend", "sort the points by their path");
    }
}

} // namespace

SlipStages stages_of_yield(const std::vector<YieldPoint>& points)
{
    check_points(points);
    RigidBlock block;
    block.mass = 1.0;
    block.gravity = 1.0;
    SlipStages stages;
    for (std::size_t i = 0; i < points.size(); ++i) {
        block.friction = points[i].yield;
        double slope = 0.0;
        if (i + 1 < points.size()) {
            const double length = points[i + 1].path - points[i].path;
            // Of two points at one path the later one holds as soon as the block moves.
            if (length > 0.0) slope = (points[i + 1].yield - points[i].yield) / length;
        }
        stages.push_back({points[i].path, block, slope});
    }
    return stages;
}

namespace {

Yield yield(const RigidBlock& block, SlipDirection direction)
{
    const BaseEquations equations = base_equations(block);
    GroundLinear excess = excess_drive(equations, block, direction);
    if (block.opening) {
        excess.constant += block.friction * block.opening->at(direction, 0.0);
        excess.per_a_v += block.friction * block.opening->per_accel_v(direction);
    }
    const double per_driving_accel = sign(direction) * excess.per_a_h; // upstream sliding is driven by -a_h
    // q.A x below this is a cancellation of cos(theta) -+ mu sin(theta): the direction is taken as jammed.
    const double round_off =
        1e-15 * (std::abs(equations.drive.per_a_h) + block.friction * std::abs(equations.normal.per_a_h));
    if (per_driving_accel <= round_off) {
        const double infinity = std::numeric_limits<double>::infinity();
        return {{excess.constant > 0.0 ? -infinity : infinity, 0.0}, 0.0};
    }
    return {{-excess.constant / per_driving_accel, -excess.per_a_v / per_driving_accel},
            per_driving_accel / sliding_mass(equations, block.friction, direction)};
}

} // namespace

Yield yield_downstream(const RigidBlock& block)
{
    return yield(block, SlipDirection::downstream);
}

Yield yield_upstream(const RigidBlock& block)
{
    return yield(block, SlipDirection::upstream);
}

double yield_acceleration(const RigidBlock& block, double a_v)
{
    return yield_downstream(block).law.at(a_v);
}

double static_normal_force(const RigidBlock& block)
{
    return base_equations(block).normal.constant;
}

StaticState static_state(const RigidBlock& block)
{
    const BaseEquations equations = base_equations(block);
    if (equations.normal.constant <= 0.0) return StaticState::lifts_off;
    if (excess_drive(equations, block, SlipDirection::downstream).constant > 0.0) return StaticState::slides_downstream;
    if (excess_drive(equations, block, SlipDirection::upstream).constant > 0.0) return StaticState::slides_upstream;
    return StaticState::at_rest;
}

Status status_of(StaticState state)
{
    if (state == StaticState::at_rest) return Status::at_rest;
    return state == StaticState::lifts_off ? Status::floats : Status::static_failure;
}

double critical_friction(const RigidBlock& block)
{
    const BaseEquations equations = base_equations(block);
    if (equations.normal.constant <= 0.0) return std::numeric_limits<double>::infinity();
    return std::max(0.0, (std::abs(equations.drive.constant) - block.cohesion_force - block.dowel_force) /
                             equations.normal.constant);
}

} // namespace damslip::sliding
