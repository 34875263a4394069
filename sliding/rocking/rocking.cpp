#include "sliding/rocking/rocking.hpp"

#include "core/text.hpp"
#include "scene/section.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "sliding/rocking/rocking_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::sliding {

namespace {

/// The resultant of the static loads acts outside the base.
bool tips_statically(const RockingBlock& block)
{
    const RockingStage& first = block.stages.front();
    return corner(block, first, Stance::toe).moment > 0.0 || corner(block, first, Stance::heel).moment < 0.0;
}

Status status_of(const RockingMotion& motion, const RockingBlock& block, StaticState state)
{
    if (motion.unresolved()) return Status::not_resolved;
    if (state != StaticState::at_rest) return status_of(state);
    if (tips_statically(block)) return Status::overturns;
    if (motion.overturned()) return Status::overturned;
    return motion.at_rest() ? Status::at_rest : Status::sliding_at_end;
}

void add_notes(const RockingMotion& motion, const SlideOptions& options, RockingResult& result)
{
    std::vector<Note>& notes = result.slide.notes;
    if (result.slide.status == Status::overturned)
        notes.push_back({NoteKind::turned_over, {result.overturned_time}});
    if (result.slide.status == Status::sliding_at_end)
        notes.push_back({NoteKind::still_moving, {options.sliding.run_out_max}});
    if (result.slide.status == Status::not_resolved)
        notes.push_back({motion.jammed() ? NoteKind::jammed_corner : NoteKind::many_events_at, {result.slide.end_time}});
    if (result.slide.lift_offs > 0)
        notes.push_back({NoteKind::lost_weight, {std::int64_t{result.slide.lift_offs}}});
}

} // namespace

void RockingMotion::add_sample(double time, RockingResult& result) const
{
    SlideHistory& history = result.slide.history;
    history.time.push_back(time);
    history.slip.push_back(y_[slip]);
    history.slip_rate.push_back(y_[slip_rate]);
    history.normal_force.push_back(pressed_ ? std::max(0.0, instant(0.0, y_).normal) : 0.0);
    result.rotation.push_back(y_[turn]);
    result.uplift.push_back(stance_ == Stance::base ? block_.stages[stage_].slip.block.uplift
                                                    : standing(0.0).force_n - block_.force_n);
}

void RockingMotion::write(RockingResult& result) const
{
    std::vector<double> rotation = std::move(result.rotation), uplift = std::move(result.uplift);
    SlideHistory history = std::move(result.slide.history);
    result = seen_;
    result.rotation = std::move(rotation);
    result.uplift = std::move(uplift);
    SlideResult& r = result.slide;
    r.history = std::move(history);
    r.accuracy = SlideAccuracy::series;
    r.slip = y_[slip];
    slid_.write(r, time_, sliding_);
    r.wet_length = longest_wet_;
    r.max_gap = block_.length *
                std::sin(std::min(0.5 * std::numbers::pi, std::max(seen_.max_toe_rotation, seen_.max_heel_rotation)));
    RockingEnergy& e = result.energy;
    e.ground = y_[work_ground];
    e.loads = y_[work_loads];
    e.friction = y_[work_friction];
    e.landings = landing_loss_;
    e.kinetic = kinetic_energy(standing(0.0), y_[turn], y_[slip_rate], y_[turn_rate]);
    const double left = first_energy_ + e.ground + e.loads - e.kinetic - e.friction - e.landings;
    e.imbalance = largest_work_ > 0.0 ? left / largest_work_ : 0.0;
}

RockingResult rock_and_slide(const GroundMotion& motion, const RockingBlock& block, const SlideOptions& options,
                             const RockingStart& start)
{
    check_motion(motion);
    SlipStages stages;
    for (const RockingStage& stage : block.stages) stages.push_back(stage.slip);
    check_stages(stages);
    const bool vertical = !motion.accel_v.empty();
    const auto a_h = [&](std::size_t k) { return options.polarity * motion.accel_h[k]; };
    const auto a_v = [&](std::size_t k) { return vertical ? motion.accel_v[k] : 0.0; };
    const bool keep = options.history == HistoryOutput::samples;

    RockingResult result;
    RockingMotion state(block, options, start);
    const std::size_t last = motion.accel_h.size() - 1;
    if (keep) state.add_sample(0.0, result);
    for (std::size_t k = 0; k < last && !state.finished(); ++k) {
        state.cross(static_cast<double>(k) * motion.dt, motion.dt, {a_h(k), a_h(k + 1)}, {a_v(k), a_v(k + 1)});
        if (keep) state.add_sample(static_cast<double>(k + 1) * motion.dt, result);
    }
    const StaticState standing = static_state(stages.front().block);
    const double end = static_cast<double>(last) * motion.dt, longest = options.sliding.run_out_max;
    if (standing == StaticState::at_rest && !tips_statically(block))
        for (double elapsed = 0.0; elapsed < longest && !state.at_rest() && !state.finished(); elapsed += motion.dt) {
            const double step = std::min(motion.dt, longest - elapsed);
            state.cross(end + elapsed, step, {}, {});
            if (keep) state.add_sample(end + elapsed + step, result);
        }
    state.write(result);
    result.slide.status = status_of(state, block, standing);
    add_notes(state, options, result);
    return result;
}

namespace {

/// Where the face crosses the level y, its lowest crossing; the end of the face above or below it.
double face_x(const Polyline& face, double y)
{
    for (std::size_t i = 0; i + 1 < face.size(); ++i) {
        const Point &a = face[i], &b = face[i + 1];
        if ((y >= a.y) == (y >= b.y)) continue;
        return a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
    }
    return y < face.front().y ? face.front().x : face.back().x;
}

/// The point of the block at which a load acts: where the lines of its horizontal and its vertical part cross; a part that
/// is missing leaves the point on the face, crest or centroid that carries the load.
Point acts_at(const Scene& scene, const Load& load, std::size_t& point_forces)
{
    const Force &h = load.force.horizontal, &v = load.force.vertical;
    if (load.kind == LoadKind::point_force) return scene.forces[point_forces++].at;
    if (load.kind == LoadKind::weight) return centroid(scene.section);
    Point at{0.0, crest_level(scene.section)};
    if (h.x != 0.0) at.y = -h.moment / h.x;
    const bool downstream = load.kind == LoadKind::tailwater;
    at.x = v.y != 0.0 ? v.moment / v.y
                      : face_x(downstream ? downstream_face(scene.section) : upstream_face(scene.section), at.y);
    return at;
}

/// Sum of force . point over the static loads, about the heel; the same in any axes.
double virial(const Scene& scene, const std::vector<Load>& loads)
{
    double sum = 0.0;
    std::size_t point_forces = 0;
    for (const Load& load : loads) {
        const Point at = acts_at(scene, load, point_forces);
        sum += load.force.horizontal.x * at.x + load.force.vertical.y * at.y;
    }
    return sum;
}

BaseAddedMass in_base_directions(const AddedMassIntegral& w, const BaseFrame& frame)
{
    const double c = frame.t.x, s = frame.n.x; // t = (c, -s), n = (s, c)
    const double xr = -w.horizontal_moment.x - w.vertical_moment.x;
    const double yr = -w.horizontal_moment.y - w.vertical_moment.y;
    return {c * c * w.xx - 2.0 * c * s * w.xy + s * s * w.yy,
            c * s * (w.xx - w.yy) + (c * c - s * s) * w.xy,
            s * s * w.xx + 2.0 * c * s * w.xy + c * c * w.yy,
            c * xr - s * yr,
            s * xr + c * yr,
            w.rotation};
}

double uplift_distance(const BaseState& state)
{
    const UpliftResultant& u = state.base.uplift;
    return u.force > 0.0 ? u.moment_about_heel / u.force : 0.0;
}

} // namespace

RockingBlock make_rocking_block(const Scene& scene, const BaseState& state, const AddedMassIntegral& water,
                                const SlipStages& stages, const BaseState* later)
{
    const RigidBlock& rigid = stages.front().block;
    const BaseFrame& frame = state.frame;
    RockingBlock block;
    block.mass = rigid.mass;
    block.inertia = scene.dam.density * polar_moment(scene.section);
    block.length = frame.length;
    block.base_inclination = rigid.base_inclination;
    const Point c = centroid(scene.section), from = heel(scene.section);
    const Point g{c.x - from.x, c.y - from.y};
    block.centroid = {g.x * frame.t.x + g.y * frame.t.y, g.x * frame.n.x + g.y * frame.n.y};
    block.water = in_base_directions(water, frame);
    const BaseEquations e = base_equations(rigid); // the sliding block's own sums, so that both slide alike
    block.force_t = e.drive.constant;
    block.force_n = -(e.normal.constant + rigid.uplift);
    block.moment = -moment_about(state.load, from);
    block.virial = virial(scene, state.loads) - (state.load.x * from.x + state.load.y * from.y);
    block.cohesion = rigid.cohesion_force > 0.0 ? frame.share * scene.contact.cohesion : 0.0; // per metre of dam
    block.crack = state.base.crack;
    for (const SlipStage& stage : stages)
        block.stages.push_back({stage, uplift_distance(later && stage.block.uplift != rigid.uplift ? *later : state)});
    return block;
}

RockingMouth rocking_mouth(const Scene& scene, const StaticCase& static_case, const BaseState& before,
                           std::shared_ptr<const SlowWater> flat, const SeepageProfile& seepage)
{
    const double length = before.frame.length, inside = 0.25 * length;
    const CrackUplift uplift = crack_uplift(scene, static_case.uplift, static_case.uplift_factor, seepage);
    const auto end = [&](Side side) {
        MouthEnd made;
        made.first = before.base.crack.side == side ? before.base.crack.length : 0.0;
        made.empty = uplift_of_empty_joint(before, side);
        const PressureProfile cracked = uplift({side, 0.5 * length}); // its water stands at the head of this end
        const bool heel = side == Side::heel;
        const std::vector<ProfilePoint> points =
            heel ? part(cracked, 0.0, inside) : part(cracked, length - inside, length);
        made.pressure = heel ? points.front().pressure : points.back().pressure;
        made.gradient = ((heel ? points.back().pressure : points.front().pressure) - made.pressure) / inside;
        return made;
    };
    return {std::move(flat), end(Side::heel), end(Side::toe)};
}

RockingBlock rectangular_block(double width, double height, double density, double gravity, double friction)
{
    RockingBlock block;
    block.mass = density * width * height;
    block.inertia = block.mass * (width * width + height * height) / 12.0;
    block.length = width;
    block.centroid = {0.5 * width, 0.5 * height};
    block.force_n = -block.mass * gravity;
    block.moment = block.mass * gravity * block.centroid.x;
    block.virial = -block.mass * gravity * block.centroid.y;
    RigidBlock rigid;
    rigid.mass = block.mass;
    rigid.gravity = gravity;
    rigid.friction = friction;
    block.stages.push_back({{0.0, rigid, 0.0}, 0.0});
    return block;
}

BaseAcceleration in_base_directions(double base_inclination, double a_h, double a_v)
{
    const double c = std::cos(base_inclination), s = std::sin(base_inclination);
    return {-a_h * c - a_v * s, -a_h * s + a_v * c}; // the ground accelerates by (-a_h, +a_v)
}

Point Corner::turned(double theta) const
{
    const double c = std::cos(theta), s = std::sin(theta);
    return {arm.x * c + arm.y * s, arm.y * c - arm.x * s};
}

double Corner::static_moment(double theta) const
{
    return std::cos(theta) * moment - std::sin(theta) * virial;
}

Corner corner(const RockingBlock& block, const RockingStage& stage, Stance stance)
{
    const bool toe = stance != Stance::heel;
    const double x = toe ? block.length : 0.0; // of the corner, from the heel
    const std::optional<UpliftResultant>& open = toe ? block.uplift_on_toe : block.uplift_on_heel;
    const bool opened = stance != Stance::base && open;
    const double uplift = opened ? open->force : stage.slip.block.uplift;
    const double about_heel = opened ? open->moment_about_heel : uplift * stage.uplift_distance;
    Corner k;
    k.sense = toe ? 1.0 : -1.0;
    k.arm = {block.centroid.x - x, block.centroid.y};
    k.mass = block.mass;
    // A rotation about a corner x downstream of the heel is one about the heel and x upwards.
    const BaseAddedMass& w = block.water;
    k.water = {w.tt, w.tn, w.nn, w.tr + x * w.tn, w.nr + x * w.nn, w.rr + 2.0 * x * w.nr + x * x * w.nn};
    k.inertia = block.inertia + block.mass * (k.arm.x * k.arm.x + k.arm.y * k.arm.y) + k.water.rr;
    k.force_t = block.force_t;
    k.force_n = block.force_n + uplift;
    k.moment = block.moment - about_heel + k.force_n * x;
    k.virial = block.virial - block.force_t * x;
    return k;
}

UpliftResultant mouth_uplift(const RockingBlock& block, Stance stance, double wet)
{
    const bool from_heel = stance != Stance::heel;
    const MouthEnd& end = from_heel ? block.mouth->at_heel : block.mouth->at_toe;
    const double first = end.first, p = end.pressure, k = end.gradient;
    const double squares = (wet * wet - first * first) / 2.0, cubes = (wet * wet * wet - first * first * first) / 3.0;
    const double force = p * (wet - first) + k * squares;
    const double about_mouth = p * squares + k * cubes;
    const double about_heel = from_heel ? about_mouth : block.length * force - about_mouth;
    return {end.empty.force + force, end.empty.moment_about_heel + about_heel};
}

Corner with_uplift(Corner k, const RockingBlock& block, const UpliftResultant& uplift)
{
    const double x = block.centroid.x - k.arm.x;
    k.force_n = block.force_n + uplift.force;
    k.moment = block.moment - uplift.moment_about_heel + k.force_n * x;
    return k;
}

CornerEquations equations(const Corner& k, double theta, double rate, const BaseAcceleration& a)
{
    const Point rho = k.turned(theta);
    const BaseAddedMass& w = k.water;
    CornerEquations e;
    e.tt = k.mass + w.tt;
    e.tr = k.mass * rho.y + w.tr;
    e.rr = k.inertia;
    e.nt = w.tn;
    e.nr = w.nr - k.mass * rho.x;
    e.push = k.force_t - (k.mass + w.tt) * a.t - w.tn * a.n + k.mass * rate * rate * rho.x;
    e.turn = k.static_moment(theta) - k.mass * (rho.y * a.t - rho.x * a.n) - w.tr * a.t - w.nr * a.n;
    e.press = -k.force_n + (k.mass + w.nn) * a.n + w.tn * a.t - k.mass * rate * rate * rho.y;
    return e;
}

Momentum momentum(const Corner& k, double v_t, double v_n, double rate)
{
    const BaseAddedMass& w = k.water;
    const double tr = k.mass * k.arm.y + w.tr, nr = w.nr - k.mass * k.arm.x;
    return {(k.mass + w.tt) * v_t + w.tn * v_n + tr * rate, w.tn * v_t + (k.mass + w.nn) * v_n + nr * rate,
            tr * v_t + nr * v_n + k.inertia * rate};
}

double kinetic_energy(const Corner& k, double theta, double slip_rate, double rate)
{
    const double tr = k.mass * k.turned(theta).y + k.water.tr;
    return 0.5 * (k.mass + k.water.tt) * slip_rate * slip_rate + tr * slip_rate * rate + 0.5 * k.inertia * rate * rate;
}

} // namespace damslip::sliding
