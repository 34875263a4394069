#include "sliding/rocking/corner.hpp"

#include <cmath>

namespace damslip::sliding {

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
