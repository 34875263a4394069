#include "sliding/planes/chain.hpp"

#include "core/version.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Point scaled(double factor, Point a)
{
    return {factor * a.x, factor * a.y};
}
Point sum(Point a, double factor, Point b)
{
    return {a.x + factor * b.x, a.y + factor * b.y};
}

ChainLaw::BlockDirections directions(const ChainBlock& b)
{
    const Point t{std::cos(b.dip), -std::sin(b.dip)}, n{std::sin(b.dip), std::cos(b.dip)};
    return {t, n, sum(scaled(std::cos(b.dilation), t), std::sin(b.dilation), n)};
}
ChainLaw::FaceDirections directions(const ChainInterface& i)
{
    const Point e{std::cos(i.angle), std::sin(i.angle)};
    return {e, {e.y, -e.x}};
}
/// A v with A = m I + M^w.
Point moved(const ChainBlock& b, Point v)
{
    const AddedMassTensor& w = b.added_mass;
    return {(b.mass + w.xx) * v.x + w.xy * v.y, w.xy * v.x + (b.mass + w.yy) * v.y};
}

/// Directions, rates q and senses of the interfaces: what of the chain does not depend on F.
void set_rates(const Chain& chain, ChainLaw& law)
{
    law.of_blocks.resize(chain.blocks.size());
    law.of_faces.resize(chain.interfaces.size());
    for (std::size_t i = 0; i < chain.blocks.size(); ++i) law.of_blocks[i] = directions(chain.blocks[i]);
    for (std::size_t j = 0; j < chain.interfaces.size(); ++j) law.of_faces[j] = directions(chain.interfaces[j]);
    law.path_locked = false;
    law.rates.assign(chain.blocks.size(), 1.0);
    law.senses.assign(chain.interfaces.size(), 0);
    double rate = 1.0; // without dilation, for the senses
    for (std::size_t j = 0; j < chain.interfaces.size(); ++j) {
        const ChainLaw::BlockDirections &before = law.of_blocks[j], &after = law.of_blocks[j + 1];
        const auto& [up, out] = law.of_faces[j];
        const double next = rate * dot(before.along, out) / dot(after.along, out);
        const double rises = dot(sum(scaled(next, after.along), -rate, before.along), up);
        law.senses[j] = std::abs(rises) < 1e-12 ? 0 : rises > 0.0 ? 1 : -1;
        rate = next;
        const Point shut = sum(out, -law.senses[j] * std::tan(chain.interfaces[j].dilation), up);
        law.rates[j + 1] = law.rates[j] * dot(before.movement, shut) / dot(after.movement, shut);
        if (!(law.rates[j + 1] > 0.0)) law.path_locked = true;
    }
    const double dam = law.rates[chain.dam];
    for (double& q : law.rates) q /= dam;
}

/// z = ν - σ μ e of an interface.
Point transfer(const ChainInterface& face, const ChainLaw::FaceDirections& of, int sense, double over)
{
    return sum(of.downstream, -sense * face.friction / over, of.up);
}

/// w of each block. @param strengths  a chain as long, whose strengths take the place of the chain's
/// @returns false: locked
inline bool set_weights(const Chain& chain, const Chain& strengths, double over, const ChainLaw& law, std::vector<Point>& weights)
{
    weights.resize(chain.blocks.size());
    double scale = 1.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const Point w = sum(law.of_blocks[i].along, strengths.blocks[i].friction / over, law.of_blocks[i].normal);
        if (i > 0) {
            const Point z = transfer(strengths.interfaces[i - 1], law.of_faces[i - 1], law.senses[i - 1], over);
            const double here = dot(w, z), before = dot(weights[i - 1], z);
            if (!(here > 0.0) || !(before > 0.0)) return false;
            scale = before / here;
        }
        weights[i] = scaled(scale, w);
    }
    // The scale of the dam's block is 1.
    const double unit = dot(weights[chain.dam], law.of_blocks[chain.dam].along);
    for (Point& w : weights) w = scaled(1.0 / unit, w);
    return true;
}

/// @param whole  false: without M* and D_v, which a yield at a_v = 0 does not need @param strengths, weights  as of set_weights()
template <bool whole>
inline ChainEquation equation_of(const Chain& chain, const Chain& strengths, double over, const ChainLaw& law, std::vector<Point>& weights)
{
    ChainEquation equation;
    equation.locked = law.path_locked || !set_weights(chain, strengths, over, law, weights);
    if (equation.locked) return equation;
    for (std::size_t i = 0; i < chain.blocks.size(); ++i) {
        const ChainBlock& b = chain.blocks[i];
        const auto& [t, n, movement] = law.of_blocks[i];
        const double cohesion = strengths.blocks[i].cohesion;
        const Point w = weights[i], weight{0.0, -b.mass * chain.gravity};
        equation.drive += dot(w, moved(b, {1.0, 0.0}));
        if constexpr (whole) {
            equation.mass += law.rates[i] * dot(w, moved(b, movement));
            equation.per_a_v -= dot(w, moved(b, {0.0, 1.0}));
        }
        equation.constant += dot(w, sum(sum(sum(b.force, 1.0, weight), b.uplift, n), -cohesion / over * b.length, t));
    }
    for (std::size_t j = 0; j < chain.interfaces.size(); ++j) {
        const ChainInterface& face = chain.interfaces[j];
        const auto& [up, out] = law.of_faces[j];
        const double cohesion = strengths.interfaces[j].cohesion;
        const Point force = sum(scaled(face.water, out), -law.senses[j] * cohesion / over * face.length, up);
        equation.constant += dot(sum(weights[j + 1], -1.0, weights[j]), force);
    }
    return equation;
}

} // namespace

void set_strengths(const Chain& chain, double over, ChainLaw& law)
{
    static_cast<ChainEquation&>(law) = equation_of<true>(chain, chain, over, law, law.weights);
}

void set_law(const Chain& chain, double over, ChainLaw& law)
{
    set_rates(chain, law);
    set_strengths(chain, over, law);
}

double yield_with(const Chain& strengths, const Chain& chain, const ChainLaw& law, std::vector<Point>& weights)
{
    return equation_of<false>(chain, strengths, 1.0, law, weights).yield();
}

ChainLaw chain_law(const Chain& chain, double over)
{
    ChainLaw law;
    set_law(chain, over, law);
    return law;
}

bool ChainForces::stands() const
{
    const auto holds = [](double force) { return force >= 0.0; };
    return std::all_of(normal.begin(), normal.end(), holds) && std::all_of(thrust.begin(), thrust.end(), holds);
}

namespace {

/// Equilibrium of one block after the other, with the thrust of the one before:
/// N (n - μ t) - E z = A a - F - W - U n + c L t - incoming + water and cohesion of the next interface.
/// @param on_block  takes N and the resistance of each block @param on_face  E and X of the interface after it
template <class OnBlock, class OnFace>
void find_forces(const Chain& chain, const ChainLaw& law, double a_h, double a_v, double slip_accel, double over, OnBlock&& on_block,
                 OnFace&& on_face)
{
    Point incoming;
    for (std::size_t i = 0; i < chain.blocks.size(); ++i) {
        const ChainBlock& b = chain.blocks[i];
        const auto& [t, n, movement] = law.of_blocks[i];
        const double friction = b.friction / over, cohesion = b.cohesion / over * b.length;
        Point right = sum(sum(moved(b, sum({-a_h, a_v}, law.rates[i] * slip_accel, movement)), -1.0, b.force), -1.0,
                          {0.0, -b.mass * chain.gravity});
        right = sum(sum(sum(right, -b.uplift, n), cohesion, t), -1.0, incoming);
        const Point base = sum(n, -friction, t);
        double normal_force = dot(right, n);
        if (i < chain.interfaces.size()) {
            const ChainInterface& face = chain.interfaces[i];
            const auto& [up, out] = law.of_faces[i];
            const Point z = transfer(face, law.of_faces[i], law.senses[i], over);
            const Point fixed = sum(scaled(face.water, out), -law.senses[i] * face.cohesion / over * face.length, up);
            right = sum(right, 1.0, fixed);
            // right = N base - E z
            const double determinant = -base.x * z.y + base.y * z.x;
            normal_force = (-right.x * z.y + right.y * z.x) / determinant;
            const double thrust = (base.x * right.y - base.y * right.x) / determinant;
            on_face(thrust, law.senses[i] * (face.cohesion / over * face.length + face.friction / over * thrust));
            incoming = sum(scaled(thrust, z), 1.0, fixed);
        }
        on_block(normal_force, cohesion + friction * normal_force);
    }
}

} // namespace

ChainForces chain_forces(const Chain& chain, const ChainLaw& law, double a_h, double a_v, double slip_accel, double over)
{
    ChainForces forces;
    const auto on_block = [&](double normal, double resistance) {
        forces.normal.push_back(normal);
        forces.resistance.push_back(resistance);
    };
    const auto on_face = [&](double thrust, double shear) {
        forces.thrust.push_back(thrust);
        forces.shear.push_back(shear);
    };
    find_forces(chain, law, a_h, a_v, slip_accel, over, on_block, on_face);
    return forces;
}

const char* word(ChainStatus status)
{
    switch (status) {
    case ChainStatus::stands: return "stands";
    case ChainStatus::locked: return "locked";
    case ChainStatus::floats: return "floats";
    case ChainStatus::opens: return "opens";
    }
    return "";
}

ChainStatus chain_status(const Chain& chain, const ChainLaw& law, double a_h, double a_v, double over)
{
    if (law.locked || !std::isfinite(a_h)) return ChainStatus::locked;
    bool floats = false, opens = false;
    find_forces(
        chain, law, a_h, a_v, 0.0, over, [&](double normal, double) { floats = floats || normal < 0.0; },
        [&](double thrust, double) { opens = opens || thrust < 0.0; });
    return floats ? ChainStatus::floats : opens ? ChainStatus::opens : ChainStatus::stands;
}

double chain_factor(const Chain& chain, double a_h, double a_v)
{
    ChainLaw law;
    set_rates(chain, law);
    if (law.path_locked) return infinite;
    const auto missing = [&](double factor) { // to sliding at this F; falls as F grows
        set_strengths(chain, factor, law);
        return law.yield(a_v) - a_h;
    };
    double high = 1.0;
    while (missing(high) > 0.0)
        if ((high *= 2.0) > 1e9) return infinite;
    double low = 0.5 * high;
    while (!(missing(low) > 0.0))
        if ((low *= 0.5) < 1e-9) return 0.0;
    // A locked chain has an infinite yield, so the lock is above zero: halved until the secant has a finite end.
    double at_low = missing(low);
    while (!std::isfinite(at_low) && high - low > 1e-15 * high) {
        const double middle = 0.5 * (low + high), value = missing(middle);
        (value > 0.0 ? low : high) = middle;
        if (value > 0.0) at_low = value;
    }
    return high - low > 1e-15 * high ? bracketed_root(missing, low, high) : high;
}

std::vector<double> resistance_shares(const Chain& chain, const ChainLaw& law, const ChainForces& forces)
{
    std::vector<double> power;
    double all = 0.0;
    for (std::size_t i = 0; i < chain.blocks.size(); ++i)
        power.push_back(std::max(0.0, forces.resistance[i] * law.rates[i] * std::cos(chain.blocks[i].dilation)));
    for (std::size_t j = 0; j < chain.interfaces.size(); ++j) {
        const Point apart = sum(scaled(law.rates[j + 1], law.of_blocks[j + 1].movement), -law.rates[j],
                                law.of_blocks[j].movement);
        power.push_back(std::max(0.0, forces.shear[j] * dot(apart, law.of_faces[j].up)));
    }
    for (const double p : power) all += p;
    for (double& p : power) p = all > 0.0 ? p / all : 0.0;
    return power;
}

RigidBlock chain_block(const Chain& chain, const ChainLaw& law)
{
    RigidBlock block;
    if (!std::isfinite(law.yield())) {
        block.mass = 1.0;
        block.gravity = chain.gravity;
        block.cohesion_force = 1e9 * chain.gravity;
        return block;
    }
    block.mass = law.drive;
    block.chain_mass = law.mass - law.drive;
    block.gravity = chain.gravity;
    block.friction = std::max(0.0, -law.per_a_v / law.drive);
    block.horizontal_force = law.constant + block.friction * law.drive * chain.gravity;
    return block;
}

double yield_growth(const Chain& chain, double density)
{
    if (chain.interfaces.empty()) return 0.0;
    const ChainLaw law = chain_law(chain);
    const auto shifted = [&](double slip) { // masses once the dam's block has slipped so far
        Chain after = chain;
        for (std::size_t j = 0; j < chain.interfaces.size(); ++j) {
            const ChainInterface& face = chain.interfaces[j];
            const double crossed =
                density * face.length * slip * law.rates[j] * dot(law.of_blocks[j].movement, law.of_faces[j].downstream);
            after.blocks[j].mass -= crossed;
            after.blocks[j + 1].mass += crossed;
        }
        return chain_law(after).yield();
    };
    constexpr double step = 1e-2;
    return (shifted(step) - shifted(-step)) / (2.0 * step);
}

void YieldScan::add(const Chain& chain, const ChainLaw& law)
{
    blocks_.resize(chain.blocks.size());
    faces_.resize(chain.interfaces.size());
    dam_ = chain.dam;
    open_.push_back(law.path_locked ? 0.0 : 1.0);
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        const ChainBlock& b = chain.blocks[i];
        const ChainLaw::BlockDirections& of = law.of_blocks[i];
        const Point on_it{b.force.x, b.force.y - b.mass * chain.gravity};
        blocks_[i].along.add(of.along);
        blocks_[i].normal.add(of.normal);
        blocks_[i].inertia.add({b.mass + b.added_mass.xx, b.added_mass.xy});
        blocks_[i].load.add({on_it.x + b.uplift * of.normal.x, on_it.y + b.uplift * of.normal.y});
        blocks_[i].length.push_back(b.length);
    }
    for (std::size_t j = 0; j < faces_.size(); ++j) {
        const ChainInterface& face = chain.interfaces[j];
        const ChainLaw::FaceDirections& of = law.of_faces[j];
        faces_[j].up.add(of.up);
        faces_[j].downstream.add(of.downstream);
        faces_[j].water.add({face.water * of.downstream.x, face.water * of.downstream.y});
        faces_[j].sense.push_back(law.senses[j]);
        faces_[j].length.push_back(face.length);
    }
}

DAMSLIP_TWO_LEVELS std::vector<double> YieldScan::yields(const Chain& strengths) const
{
    const std::size_t count = open_.size();
    std::vector<double> open = open_, drive(count), constant(count), unit(count);
    std::vector<Points> weights(blocks_.size()); // not yet scaled to that of the dam's block
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        const double friction = strengths.blocks[b].friction;
        Points& w = weights[b];
        w.x.resize(count), w.y.resize(count);
        DAMSLIP_INDEPENDENT
        for (std::size_t i = 0; i < count; ++i) {
            w.x[i] = block.along.x[i] + friction * block.normal.x[i];
            w.y[i] = block.along.y[i] + friction * block.normal.y[i];
        }
        if (b == 0) continue;
        const Face& face = faces_[b - 1];
        const Points& last = weights[b - 1];
        const double of_face = strengths.interfaces[b - 1].friction;
        DAMSLIP_INDEPENDENT
        for (std::size_t i = 0; i < count; ++i) {
            const double rubs = -face.sense[i] * of_face;
            const Point z{face.downstream.x[i] + rubs * face.up.x[i], face.downstream.y[i] + rubs * face.up.y[i]};
            const double here = w.x[i] * z.x + w.y[i] * z.y, before = last.x[i] * z.x + last.y[i] * z.y, scale = before / here;
            open[i] = here > 0.0 && before > 0.0 ? open[i] : 0.0;
            w.x[i] *= scale;
            w.y[i] *= scale;
        }
    }
    const Points &of_dam = weights[dam_], &along_dam = blocks_[dam_].along;
    for (std::size_t i = 0; i < count; ++i) unit[i] = 1.0 / (of_dam.x[i] * along_dam.x[i] + of_dam.y[i] * along_dam.y[i]);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        const double cohesion = strengths.blocks[b].cohesion;
        Points& w = weights[b];
        DAMSLIP_INDEPENDENT
        for (std::size_t i = 0; i < count; ++i) {
            w.x[i] *= unit[i];
            w.y[i] *= unit[i];
            const double bond = -cohesion * block.length[i];
            drive[i] += w.x[i] * block.inertia.x[i] + w.y[i] * block.inertia.y[i];
            constant[i] += w.x[i] * (block.load.x[i] + bond * block.along.x[i]) + w.y[i] * (block.load.y[i] + bond * block.along.y[i]);
        }
    }
    for (std::size_t j = 0; j < faces_.size(); ++j) {
        const Face& face = faces_[j];
        const double cohesion = strengths.interfaces[j].cohesion;
        const Points &before = weights[j], &after = weights[j + 1];
        DAMSLIP_INDEPENDENT
        for (std::size_t i = 0; i < count; ++i) {
            const double bond = -face.sense[i] * cohesion * face.length[i];
            constant[i] += (after.x[i] - before.x[i]) * (face.water.x[i] + bond * face.up.x[i]) +
                           (after.y[i] - before.y[i]) * (face.water.y[i] + bond * face.up.y[i]);
        }
    }
    constexpr double locked = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) constant[i] = open[i] > 0.0 && drive[i] > 0.0 ? -constant[i] / drive[i] : locked;
    return constant;
}

} // namespace damslip::sliding
