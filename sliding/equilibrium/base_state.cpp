#include "sliding/equilibrium/base_state.hpp"

#include "scene/joint_bond.hpp"
#include "scene/section.hpp"

namespace damslip::sliding {

BaseFrame base_frame(const Scene& scene)
{
    const Point a = heel(scene.section), b = toe(scene.section);
    const double length = base_length(scene.section);
    const Point t{(b.x - a.x) / length, (b.y - a.y) / length};
    return {length, base_inclination(scene.section), t, {-t.y, t.x}};
}

BaseLoad base_load(const BaseFrame& frame, const Force& force)
{
    return {-(force.x * frame.n.x + force.y * frame.n.y), force.moment};
}

double shear(const BaseFrame& frame, const Force& force)
{
    return force.x * frame.t.x + force.y * frame.t.y;
}

StaticCase scene_static_case(const Scene& scene)
{
    StaticCase static_case;
    static_case.loads = scene_load_case(scene);
    static_case.uplift = scene_uplift_state(scene);
    if (scene.uplift) static_case.crack = scene.uplift->crack;
    return static_case;
}

CrackUplift crack_uplift(const Scene& scene, const UpliftState& state, double factor, const SeepageProfile& seepage)
{
    return [&scene, state, factor, seepage](const Crack& crack) {
        PressureProfile profile = uplift_profile(scene, state, crack, seepage);
        for (ProfilePoint& p : profile.points) p.pressure *= factor;
        return profile;
    };
}

BaseState base_state(const Scene& scene, const StaticCase& static_case, const SeepageProfile& seepage)
{
    BaseState state;
    state.frame = base_frame(scene);
    state.loads = static_loads(scene, static_case.loads);
    state.load = resultant(state.loads);
    state.opened = static_case.opened;
    state.dowel_force = dowel_force(scene, static_case.loads.anchors);
    const BaseLoad load = base_load(state.frame, state.load);
    const CrackUplift uplift = crack_uplift(scene, static_case.uplift, static_case.uplift_factor, seepage);
    if (static_case.crack == CrackRule::none) {
        state.base = uncracked_base(load, state.frame.length, uplift(static_case.opened));
        state.base.crack = static_case.opened;
    } else {
        state.base = cracked_base(load, state.frame.length, uplift, static_case.opened, crack_events(scene));
    }
    return state;
}

std::vector<AnchorBar> base_anchors(const Scene& scene)
{
    std::vector<AnchorBar> bars;
    for (const Anchor& anchor : scene.anchors)
        if (anchor.joint.empty()) bars.push_back(anchor_bar(anchor, FrictionOverSlip(scene.contact).peak()));
    return bars;
}

double dowel_force(const Scene& scene, AnchorForce which)
{
    double sum = 0.0;
    for (const Anchor& anchor : scene.anchors) {
        if (!anchor.joint.empty() || !anchor.dowel) continue;
        const AnchorBar bar = anchor_bar(anchor, FrictionOverSlip(scene.contact).peak());
        sum += bar.dowel * dowel_share(force_of(anchor, which) / bar.yield_force);
    }
    return sum;
}

RigidBlock make_rigid_block(const Scene& scene, const BlockOptions& options)
{
    StaticCase static_case = scene_static_case(scene);
    if (options.crack) static_case.crack = *options.crack;
    static_case.uplift.drains = options.drains;
    static_case.uplift.curtain = options.curtain;
    return make_rigid_block(scene, base_state(scene, static_case, options.seepage), static_case.loads.reservoir_level,
                            options);
}

RigidBlock make_rigid_block(const Scene& scene, const BaseState& state, std::optional<double> reservoir_level,
                            const BlockOptions& options)
{
    const AddedMassIntegral water = scene_added_mass(scene, reservoir_level);
    RigidBlock block;
    block.mass = dam_mass(scene);
    block.added_mass = {water.xx, water.xy, water.yy};
    block.gravity = scene.gravity;
    for (const Load& load : state.loads) {
        const Force force = load.force.total();
        block.horizontal_force += force.x;
        // The weight is the block's own; only what a load factor changes of it is left here.
        block.vertical_force -= load.kind == LoadKind::weight ? force.y + block.mass * block.gravity : force.y;
    }
    block.uplift = state.base.uplift.force;
    block.cohesion_force = options.cohesion.value_or(scene.contact.cohesion) * state.cohesive_length();
    block.friction = options.friction.value_or(FrictionOverSlip(scene.contact).peak());
    block.dowel_force = state.dowel_force;
    block.base_inclination = state.frame.inclination;
    return block;
}

} // namespace damslip::sliding
