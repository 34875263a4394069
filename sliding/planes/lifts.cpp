#include "sliding/planes/lifts.hpp"

#include "records/measure/measures.hpp"
#include "scene/joint_bond.hpp"
#include "scene/section.hpp"
#include "sliding/block/rigid_block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace damslip::sliding {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// Values between the samples, linear, then zero.
std::vector<double> refined(const std::vector<double>& samples, int parts, std::size_t count)
{
    std::vector<double> out(count, 0.0);
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
        for (int k = 0; k < parts; ++k)
            out[i * static_cast<std::size_t>(parts) + static_cast<std::size_t>(k)] =
                samples[i] + (samples[i + 1] - samples[i]) * k / parts;
    out[(samples.size() - 1) * static_cast<std::size_t>(parts)] = samples.back();
    return out;
}

void add(const std::vector<double>& a, double factor, std::vector<double>& sum)
{
    if (factor != 0.0)
        for (std::size_t i = 0; i < a.size(); ++i) sum[i] += factor * a[i];
}

/// Adds what one component of the ground's motion makes of both places.
void add_component(const std::vector<double>& accel, double dt, const TiedPart& part, bool vertical, JointMotions& motions)
{
    const auto shares = [vertical](const PlaceShares& place, bool up) -> const ModalShares& {
        return vertical ? (up ? place.v_of_v : place.h_of_v) : (up ? place.v_of_h : place.h_of_h);
    };
    const auto add_all = [&](const std::vector<double>& a, const auto& share) {
        add(a, share(shares(part.joint, false)), motions.joint.accel_h);
        add(a, share(shares(part.joint, true)), motions.joint.accel_v);
        add(a, share(shares(part.mean, false)), motions.mean.accel_h);
        add(a, share(shares(part.mean, true)), motions.mean.accel_v);
    };
    std::vector<double> absolute(accel.size());
    for (std::size_t n = 0; n < part.modes.size(); ++n) {
        const double omega = two_pi * part.modes[n].frequency, ratio = part.modes[n].ratio;
        const records::OscillatorStep step(omega, ratio, dt);
        records::OscillatorState state; // relative to ground that moves with `accel`
        for (std::size_t i = 0; i < accel.size(); ++i) {
            if (i > 0) state = step.advance(state, accel[i - 1], accel[i]);
            absolute[i] = -omega * (omega * state.displacement + 2.0 * ratio * state.velocity);
        }
        add_all(absolute, [n](const ModalShares& s) { return s.of_mode[n]; });
    }
    add_all(accel, [](const ModalShares& s) { return s.rest; });
}

} // namespace

JointMotions joint_motions(const GroundMotion& ground, const TiedPart& part, int parts, double tail)
{
    JointMotions motions;
    const double dt = ground.dt / parts;
    const std::size_t count = (ground.accel_h.size() - 1) * static_cast<std::size_t>(parts) + 1 +
                              static_cast<std::size_t>(std::ceil(tail / dt));
    for (GroundMotion* m : {&motions.joint, &motions.mean}) {
        m->name = ground.name;
        m->dt = dt;
        m->accel_h.assign(count, 0.0);
        m->accel_v.assign(count, 0.0);
    }
    add_component(refined(ground.accel_h, parts, count), dt, part, false, motions);
    if (!ground.accel_v.empty()) add_component(refined(ground.accel_v, parts, count), dt, part, true, motions);
    return motions;
}

SlideResult slide_above(const GroundMotion& ground, const TiedPart& part, const SlipStages& stages,
                        const SlideOptions& options)
{
    GroundMotion motion = ground;
    for (double& a : motion.accel_h) a *= options.polarity;
    SlideOptions own = options;
    own.polarity = 1;
    double highest = 0.0, tail = 0.0;
    constexpr double settled = 7.0; // e^-7 of the vibration is left
    for (const TiedMode& mode : part.modes) {
        highest = std::max(highest, mode.frequency);
        const double decay = two_pi * mode.frequency * mode.ratio;
        tail = std::max(tail, decay > 0.0 ? settled / decay : options.sliding.run_out_max);
    }
    tail = std::min(tail, options.sliding.run_out_max);
    constexpr double steps_per_period = 20.0;
    const int parts = std::max(1, static_cast<int>(std::ceil(motion.dt * highest * steps_per_period)));
    const auto larger = [&](int k) {
        const JointMotions motions = joint_motions(motion, part, k, tail);
        SlideResult of_joint = slide(motions.joint, stages, own), of_mean = slide(motions.mean, stages, own);
        return of_mean.max_slip > of_joint.max_slip ? of_mean : of_joint;
    };
    own.history = HistoryOutput::none;
    const double coarse = larger(parts).max_slip;
    own.history = options.history;
    SlideResult fine = larger(2 * parts);
    fine.slip_error = std::abs(fine.max_slip - coarse);
    return fine;
}

namespace {

/// What inertia and water of the part above a joint make of a horizontal or vertical acceleration of the ground.
struct MovedPart {
    double mass = 0.0;       ///< Σ m A [kg/m]
    Point centre;            ///< where it acts [m]
    AddedMassIntegral water; ///< weighted alike
};

/// The face with corners at these levels, where what is integrated along it has kinks. @param levels  x: level [m]
Polyline with_levels(const Polyline& face, const std::vector<Point>& levels)
{
    Polyline more{face.front()};
    for (std::size_t i = 1; i < face.size(); ++i) {
        const Point a = face[i - 1], b = face[i];
        std::vector<double> shares;
        for (const Point p : levels)
            if ((p.x - a.y) * (b.y - p.x) > 0.0) shares.push_back((p.x - a.y) / (b.y - a.y));
        std::sort(shares.begin(), shares.end());
        for (const double share : shares) more.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
        more.push_back(b);
    }
    return more;
}

MovedPart moved_part(const Scene& scene, const Scene& part, double elevation, const std::function<double(double)>& share)
{
    MovedPart moved;
    // Five points of Gauss on parts of each piece between two corners of the section, whose width is linear there.
    constexpr std::array<std::array<double, 2>, 5> gauss{{{-0.9061798459386640, 0.2369268850561891},
                                                          {-0.5384693101056831, 0.4786286704993665},
                                                          {0.0, 0.5688888888888889},
                                                          {0.5384693101056831, 0.4786286704993665},
                                                          {0.9061798459386640, 0.2369268850561891}}};
    const Polyline& polygon = part.section.polygon;
    if (!share) {
        moved.mass = dam_mass(part);
        moved.centre = centroid(part.section);
    } else {
        std::vector<double> levels;
        for (const Point p : polygon) levels.push_back(p.y);
        if (scene.lifts)
            for (const Point p : scene.lifts->points) levels.push_back(p.x - elevation);
        for (const Point p : part.section.thickness)
            if (p.x < crest_level(part.section)) levels.push_back(p.x);
        std::sort(levels.begin(), levels.end());
        constexpr int parts = 8;
        double x = 0.0, y = 0.0;
        for (std::size_t i = 1; i < levels.size(); ++i)
            for (int k = 0; k < parts; ++k) {
                const double low = std::max(0.0, levels[i - 1]), step = (levels[i] - low) / parts;
                if (!(step > 0.0)) continue;
                for (const auto& [place, weight] : gauss) {
                    const double level = low + step * (k + 0.5 + 0.5 * place);
                    double left = std::numeric_limits<double>::infinity(), right = -left;
                    for (std::size_t c = 0; c < polygon.size(); ++c) {
                        const Point a = polygon[c], b = polygon[(c + 1) % polygon.size()];
                        if ((a.y < level) == (b.y < level)) continue;
                        const double at = a.x + (level - a.y) / (b.y - a.y) * (b.x - a.x);
                        left = std::min(left, at), right = std::max(right, at);
                    }
                    if (!(right > left)) continue;
                    const double mass = 0.5 * weight * step * scene.dam.density * (right - left) *
                                        share_above(part.section, level) * share(level + elevation);
                    moved.mass += mass;
                    x += mass * 0.5 * (left + right);
                    y += mass * level;
                }
            }
        moved.centre = {x / moved.mass, y / moved.mass};
    }
    if (scene.reservoir && part.reservoir && scene.reservoir->model != ReservoirModel::hydrostatic) {
        Polyline face = upstream_face(part.section);
        const Point origin = {face.front().x - part.section.polygon.front().x, elevation};
        for (Point& p : face) p = {p.x, p.y + elevation};
        if (share && scene.lifts->amplification == Amplification::points) face = with_levels(face, scene.lifts->points);
        moved.water = integrate_added_mass(
            scene.added_mass, {scene.reservoir->level, scene.reservoir->density, scene.reservoir->bulk_modulus}, face, share);
        // Moments about the upstream end of the joint.
        AddedMassIntegral& w = moved.water;
        w.horizontal_moment = {w.horizontal_moment.x + origin.y * w.xx, w.horizontal_moment.y + origin.y * w.xy};
    }
    return moved;
}

/// By the modes: all of it alike, at their arm.
void amplify(const LiftAmplification& by, MovedPart& moved)
{
    moved.mass *= by.mean;
    moved.centre.y *= by.arm;
    AddedMassIntegral& w = moved.water;
    for (double* part : {&w.xx, &w.xy, &w.yy}) *part *= by.mean;
    for (Point* moment : {&w.horizontal_moment, &w.vertical_moment})
        *moment = {moment->x * by.mean * by.arm, moment->y * by.mean * by.arm};
}

/// Tangent of the angle of a face from the vertical, at the joint.
double tangent(const Polyline& face)
{
    const Point a = face[0], b = face[1];
    return b.y != a.y ? (b.x - a.x) / (b.y - a.y) : 0.0;
}

CrackRule crack_rule(const Scene& scene, bool shaken)
{
    const CrackRule rule = scene.uplift ? scene.uplift->crack : CrackRule::none;
    if (!shaken) return CrackRule::fixed_static;
    return rule == CrackRule::none || rule == CrackRule::fixed_static ? CrackRule::seismic_unchanged : rule;
}

LiftState lift_state(const Scene& part, const LiftJoint& joint, const MovedPart& moved, double uplift_share,
                     CrackRule rule, const GroundState& ground)
{
    StaticCase static_case = scene_static_case(part);
    static_case.uplift_factor = uplift_share;
    static_case.crack = CrackRule::none;
    const BaseState before = base_state(part, static_case);
    Force load = before.load + force_at(moved.centre, moved.mass * ground.a_h, -moved.mass * ground.a_v);
    if (moved.water.xx > 0.0) load += hydrodynamic_force(moved.water, -ground.a_h, ground.a_v).total();

    LiftState state;
    const double length = before.frame.length, width = before.frame.share;
    const auto put_stresses = [&](const Force& under) { // of a beam that has not cracked
        state.base = uncracked_base(base_load(before.frame, under), length, before.base.profile);
        const double mean = state.base.effective_normal / (length * width);
        const double bending = 6.0 * mean * (0.5 - state.base.resultant_distance / length);
        state.heel_stress = mean + bending;
        state.toe_stress = mean - bending;
        return std::min(state.heel_stress, state.toe_stress) < -joint.strength.bond.tensile_strength;
    };
    const bool cracks_at_rest = put_stresses(before.load);
    if (put_stresses(load)) {
        static_case.crack = rule;
        const bool shaken = ground.a_h != 0.0 || ground.a_v != 0.0;
        StaticCase no_tension = static_case;
        no_tension.crack = cracks_at_rest ? CrackRule::fixed_static : CrackRule::none;
        const BaseState rest = base_state(part, no_tension);
        state.base = shaken ? shaken_base(part, static_case, rest, load, {}) : rest.base;
    }
    state.normal = state.base.effective_normal;
    state.shear = shear(before.frame, load);
    const FrictionOverSlip friction(joint.strength);
    const bool through = state.base.status == CrackStatus::through || state.base.status == CrackStatus::open;
    const double bonded = through ? 0.0 : width * (length - state.base.crack.length);
    const auto over_shear = [&](double mu, double cohesion) {
        return (cohesion * bonded + mu * std::max(0.0, state.normal) + before.dowel_force) / std::abs(state.shear);
    };
    state.factor = over_shear(friction.peak(), joint.strength.cohesion);
    state.factor_residual =
        over_shear(friction.residual(), joint.strength.cohesion_lost_at_slip ? 0.0 : joint.strength.cohesion);

    // Along the faces: σ sec²φ - p tan²φ with the total stress of the beam and the water on the face.
    const auto along_face = [&](double effective, double level, double tangent, double end) {
        const double water = std::max(0.0, level) * water_unit_weight(part);
        const double total = effective + pressure_at(before.base.profile, end) / width, square = tangent * tangent;
        return total * (1.0 + square) - water * square;
    };
    state.upstream_face_stress = along_face(state.heel_stress, part.reservoir ? part.reservoir->level : 0.0,
                                            tangent(upstream_face(part.section)), 0.0);
    state.downstream_face_stress = along_face(state.toe_stress, part.tailwater ? part.tailwater->level : 0.0,
                                              tangent(downstream_face(part.section)), length);
    return state;
}

} // namespace

LiftJoint lift_at(const Scene& scene, double elevation)
{
    for (const LiftJoint& joint : scene.lift_joints)
        if (std::abs(joint.elevation - elevation) < same_level) return joint;
    const Lifts& lifts = scene.lifts.value();
    return {fmt::format("lift at {:.10g} m", elevation), elevation, lifts.strength,
            lifts.uplift == LiftUplift::none ? JointWater::none : JointWater::linear};
}

Scene scene_above_made_lift(const Scene& scene, const LiftJoint& joint)
{
    const Lifts& lifts = scene.lifts.value();
    Scene part = scene_above(scene, joint);
    if (lifts.uplift != LiftUplift::drains) return part;
    part.uplift->model = UpliftModel::drains;
    Drains& drains = part.drains.emplace();
    drains.distance = lifts.drains_distance.value_or(0.0);
    drains.efficiency = lifts.drains_efficiency;
    if (lifts.gallery_level) drains.gallery_level = *lifts.gallery_level - joint.elevation;
    return part;
}

double amplification_at(const Scene& scene, double elevation)
{
    if (!scene.lifts) return 1.0;
    const Lifts& lifts = *scene.lifts;
    switch (lifts.amplification) {
    case Amplification::constant:
    case Amplification::modes:
        return 1.0;
    case Amplification::power: {
        const double share = std::clamp(elevation / crest_level(scene.section), 0.0, 1.0);
        return 1.0 + (lifts.crest_amplification - 1.0) * std::pow(share, lifts.exponent);
    }
    case Amplification::points:
        break;
    }
    const std::vector<Point>& points = lifts.points;
    if (points.empty() || elevation <= points.front().x) return points.empty() ? 1.0 : points.front().y;
    for (std::size_t i = 1; i < points.size(); ++i)
        if (elevation <= points[i].x)
            return points[i - 1].y + (points[i].y - points[i - 1].y) * (elevation - points[i - 1].x) /
                                         (points[i].x - points[i - 1].x);
    return points.back().y;
}

std::vector<LiftPlane> lift_planes(const Scene& scene, const std::vector<GroundState>& states,
                                   std::span<const LiftAmplification> modes)
{
    const bool uniform = !scene.lifts || scene.lifts->amplification == Amplification::constant ||
                         scene.lifts->amplification == Amplification::modes;
    const std::function<double(double)> share = [&scene](double y) { return amplification_at(scene, y); };
    std::vector<LiftPlane> planes;
    for (const double elevation : lift_elevations(scene)) {
        LiftPlane plane;
        plane.joint = lift_at(scene, elevation);
        plane.name = plane.joint.name;
        plane.elevation = elevation;
        const bool made = std::none_of(scene.lift_joints.begin(), scene.lift_joints.end(),
                                       [&](const LiftJoint& j) { return j.name == plane.name && j.elevation == elevation; });
        const Scene part = made ? scene_above_made_lift(scene, plane.joint) : scene_above(scene, plane.joint);
        const double uplift_share = made && scene.lifts->uplift != LiftUplift::none ? scene.lifts->uplift_share : 1.0;
        plane.length = base_length(part.section);
        const MovedPart alone = moved_part(scene, part, elevation, nullptr);
        MovedPart moved = uniform ? alone : moved_part(scene, part, elevation, share);
        if (!modes.empty()) amplify(modes[planes.size()], moved);
        for (const GroundState& state : states)
            plane.states.push_back(lift_state(part, plane.joint, moved, uplift_share,
                                              crack_rule(scene, state.a_h != 0.0 || state.a_v != 0.0), state));

        StaticCase static_case = scene_static_case(part);
        static_case.uplift_factor = uplift_share;
        static_case.crack = CrackRule::none;
        BaseState state = base_state(part, static_case);
        state.base.crack = plane.states.front().base.crack;
        state.base.uplift = plane.states.front().base.uplift;
        RigidBlock block = make_rigid_block(part, state, std::nullopt);
        block.added_mass = {alone.water.xx, alone.water.xy, alone.water.yy};
        plane.stages = strength_stages(block, plane.joint.strength);
        plane.anchors = base_anchors(part);
        plane.yield = yield_acceleration(plane.stages.front().block);
        plane.joint_amplification = modes.empty() ? amplification_at(scene, elevation) : modes[planes.size()].joint;
        plane.mean_amplification = (moved.mass + moved.water.xx) / (alone.mass + alone.water.xx);
        plane.yield_of_ground = plane.yield / plane.mean_amplification;
        planes.push_back(std::move(plane));
    }
    return planes;
}

} // namespace damslip::sliding
