#include "sliding/rocking/rocking_block.hpp"

#include "scene/section.hpp"
#include "sliding/block/base_equations.hpp"
#include "sliding/equilibrium/shaken_base.hpp"

#include <cmath>

namespace damslip::sliding {

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
    block.cohesion = rigid.cohesion_force > 0.0 ? scene.contact.cohesion : 0.0;
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

} // namespace damslip::sliding
