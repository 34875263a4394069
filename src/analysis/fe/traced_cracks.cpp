#include "analysis/fe/traced_cracks.hpp"

#include "fe2d/mesh/faces.hpp"
#include "scene/joint_bond.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace damslip {

namespace {

constexpr double shear_strength = 2.0; ///< c over f_t of concrete: a judgement
constexpr double telling = 0.3;        ///< share of f_t from which on σ₁ about a pair says where the crack goes
using fe2d::steepest_path;
constexpr std::ptrdiff_t more_damaged = 3; ///< pairs, so that a path that has settled is drawn anew
constexpr double valid = 3.0;          ///< elements from its line that directions on it still hold for a path

double x_on(const Polyline& face, double y)
{
    std::size_t i = 1;
    while (i + 1 < face.size() && face[i].y < y) ++i;
    const Point a = face[i - 1], b = face[i];
    return b.y == a.y ? b.x : a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
}

/// What a path may not leave: off the base, the crest and the lines above and below it.
class Room {
public:
    Room(const Scene& scene, const std::string& name, double start)
        : up_(upstream_face(scene.section)), down_(downstream_face(scene.section))
    {
        const double low = std::max(up_.front().y, down_.front().y), high = std::min(up_.back().y, down_.back().y);
        margin_ = 0.02 * (high - low);
        low_ = low + margin_, high_ = high - margin_;
        for (const std::vector<LiftJoint>* lines : {&scene.lift_joints, &scene.tied_lifts})
            for (const LiftJoint& line : *lines) {
                if (line.name == name) continue;
                const Polyline path = line.path.empty() ? Polyline{{up_.front().x, line.elevation}} : line.path;
                (path.front().y > start ? above_ : below_).push_back(path);
            }
    }
    const Polyline& face(bool upstream) const { return upstream ? up_ : down_; }
    double inside(Point p) const
    {
        double low = low_, high = high_;
        for (const Polyline& line : below_) low = std::max(low, fe2d::height_on(line, p.x) + margin_);
        for (const Polyline& line : above_) high = std::min(high, fe2d::height_on(line, p.x) - margin_);
        return std::clamp(p.y, std::min(low, high), high);
    }

private:
    Polyline up_, down_;
    std::vector<Polyline> above_, below_;
    double low_ = 0.0, high_ = 0.0, margin_ = 0.0;
};

/// From a face on, as far as `slope(point)` knows that of the path, rising downstream; in steps of a length. @returns points from the
/// face to the tip, the last one on the other face where it goes on so far
template <class Slope>
Polyline tip_path(const Room& room, bool from_upstream, double start, double step, Slope&& slope)
{
    const double way = from_upstream ? 1.0 : -1.0;
    Polyline path{{x_on(room.face(from_upstream), start), start}};
    for (;;) {
        const Point last = path.back();
        const std::optional<double> rise = slope(last);
        if (!rise) return path;
        Point next{last.x + way * step, 0.0};
        next.y = room.inside({next.x, last.y + way * step * std::clamp(*rise, -steepest_path, steepest_path)});
        const double end = x_on(room.face(!from_upstream), next.y);
        if (way * (end - next.x) <= 0.5 * step) {
            path.push_back({end, next.y});
            return path;
        }
        path.push_back(next);
    }
}

/// From face to face, upstream first: what the two ends know of it, and straight in between.
Polyline joined(const Room& room, const TracedCrack& crack, Polyline from, Polyline to, double step)
{
    const double way = crack.from_upstream ? 1.0 : -1.0;
    const bool whole = way * (x_on(room.face(!crack.from_upstream), from.back().y) - from.back().x) < 1e-9;
    if (!whole && !to.empty()) {
        // Points in between, so that the room is kept.
        const Point a = from.back(), b = to.back();
        const int parts = std::max(1, static_cast<int>(std::abs(b.x - a.x) / step));
        for (int k = 1; k < parts; ++k) {
            const double t = static_cast<double>(k) / parts;
            Point p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
            p.y = room.inside(p);
            from.push_back(p);
        }
        from.insert(from.end(), to.rbegin(), to.rend());
    }
    if (!crack.from_upstream) std::reverse(from.begin(), from.end());
    for (int k = 0; k < 3; ++k) { // bends over an element or two, as its rows take them
        const Polyline sharp = from;
        for (std::size_t i = 1; i + 1 < from.size(); ++i) from[i].y = 0.25 * (sharp[i - 1].y + 2.0 * sharp[i].y + sharp[i + 1].y);
    }
    return from;
}

const LiftJoint* line_of(const Scene& scene, const std::string& name)
{
    for (const LiftJoint& joint : scene.lift_joints)
        if (joint.name == name) return &joint;
    return nullptr;
}

void put(Scene& scene, const TracedCrack& crack, Polyline path)
{
    const auto old = std::find_if(scene.lift_joints.begin(), scene.lift_joints.end(),
                                  [&](const LiftJoint& j) { return j.name == crack.name; });
    LiftJoint joint;
    if (old != scene.lift_joints.end()) {
        joint = *old;
        scene.lift_joints.erase(old);
    }
    joint.name = crack.name;
    joint.elevation = path.front().y;
    joint.path = std::move(path);
    const double strength = *scene.dam.tensile_strength;
    joint.strength.friction = scene.dam.crack_friction;
    joint.strength.cohesion = shear_strength * strength;
    joint.strength.bond.tensile_strength = strength;
    joint.strength.bond.tension_energy = scene.dam.tension_energy;
    joint.strength.bond.shear_energy = scene.dam.shear_energy;
    const auto place = std::find_if(scene.lift_joints.begin(), scene.lift_joints.end(),
                                    [&](const LiftJoint& j) { return j.elevation > joint.elevation; });
    scene.lift_joints.insert(place, std::move(joint));
}

double element_length(const Scene& scene)
{
    Contact strength;
    strength.bond.tensile_strength = *scene.dam.tensile_strength;
    strength.bond.tension_energy = scene.dam.tension_energy;
    return bond_element_length(strength, *joint_modulus(scene, false));
}

/// Damaged pairs.
std::ptrdiff_t cracked(const std::vector<fe2d::PathTension>& pairs)
{
    return std::count_if(pairs.begin(), pairs.end(), [](const fe2d::PathTension& pair) { return pair.damaged; });
}

/// Has the crack begun at the end of its line, too, before it came there from the other one?
bool begins_at(const std::vector<fe2d::PathTension>& pairs, bool upstream)
{
    const fe2d::PathTension& end = upstream ? pairs.front() : pairs.back();
    return end.damaged && std::any_of(pairs.begin(), pairs.end(), [&](const fe2d::PathTension& pair) {
               return !pair.damaged || pair.time > end.time;
           });
}

} // namespace

std::vector<fe2d::CrackStart> starts_of(const Scene& scene, const std::vector<TracedCrack>& cracks)
{
    std::vector<fe2d::CrackStart> starts;
    for (const TracedCrack& crack : cracks) {
        const Polyline& path = line_of(scene, crack.name)->path;
        const double reach = 0.5 * std::hypot(path.back().x - path.front().x, path.back().y - path.front().y);
        if (crack.from_upstream || crack.other) starts.push_back({path.front(), reach});
        if (!crack.from_upstream || crack.other) starts.push_back({path.back(), reach});
    }
    return starts;
}

Scene with_traced_crack(Scene scene, const fe2d::RunResult& seed, std::vector<TracedCrack>& cracks)
{
    const fe2d::PathTension& found = seed.cracks.seed;
    const Polyline up = upstream_face(scene.section), down = downstream_face(scene.section);
    const double width = x_on(down, found.at.y) - x_on(up, found.at.y), step = element_length(scene);
    const bool upstream = found.at.x - x_on(up, found.at.y) <= x_on(down, found.at.y) - found.at.x;
    // Through the place itself: back along its direction to the face.
    const double slope = std::tan(found.angle);
    double y = found.at.y;
    for (int k = 0; k < 20; ++k) y = found.at.y + slope * (x_on(upstream ? up : down, y) - found.at.x);
    for (TracedCrack& crack : cracks) {
        if (crack.from_upstream == upstream || crack.other || crack.alone) continue;
        const Polyline& path = line_of(scene, crack.name)->path;
        if (std::abs((upstream ? path.front() : path.back()).y - y) > width) continue;
        const Room room(scene, crack.name, crack.start);
        crack.other = room.inside({found.at.x, y});
        crack.settled = false;
        const Polyline start{upstream ? path.back() : path.front()};
        put(scene, crack, joined(room, crack, start, {{x_on(upstream ? up : down, *crack.other), *crack.other}}, step));
        return scene;
    }
    TracedCrack crack;
    crack.name = fmt::format("crack {}", cracks.size() + 1);
    crack.from_upstream = upstream;
    crack.time = found.time;
    const Room room(scene, crack.name, y);
    crack.start = room.inside({found.at.x, y});
    put(scene, crack, joined(room, crack, tip_path(room, upstream, crack.start, step, [slope](Point) { return std::optional(slope); }),
                             {}, step));
    cracks.push_back(std::move(crack));
    return scene;
}

namespace {

using Pairs = std::vector<fe2d::PathTension>;

const fe2d::PathTension& nearest(const Pairs& pairs, double x)
{
    return *std::min_element(pairs.begin(), pairs.end(), [x](const auto& a, const auto& b) {
        return std::abs(a.at.x - x) < std::abs(b.at.x - x);
    });
}

/// What a run tells of the path of a crack: the directions at pairs of its line that are damaged, without a gap from a start.
class Drawing {
public:
    Drawing(const Scene& scene, const TracedCrack& crack, const Pairs& pairs)
        : pairs_(pairs), known_(pairs.size(), false), line_(line_of(scene, crack.name)->path), room_(scene, crack.name, crack.start),
          element_(element_length(scene)), least_(telling * *scene.dam.tensile_strength)
    {
        mark(crack.from_upstream);
        if (crack.other) mark(!crack.from_upstream);
    }

    /// The path anew. Two tips that do not come to meet on a path that rows can follow go on alone.
    Polyline path(TracedCrack& crack)
    {
        if (crack.other) {
            Polyline from = tip(crack.from_upstream, crack.start, Beyond::ends),
                     to = tip(!crack.from_upstream, *crack.other, Beyond::ends);
            cut_where_met(from);
            cut_where_met(to);
            if (meet(from, to, crack.from_upstream ? 1.0 : -1.0))
                return joined(room_, crack, std::move(from), std::move(to), element_);
            crack.other.reset();
            crack.alone = true;
        }
        return joined(room_, crack, tip(crack.from_upstream, crack.start, Beyond::straight), {}, element_);
    }

    /// Largest distance of the path from its line, where the crack has come by [m].
    double change(const Polyline& path) const
    {
        double largest = 0.0;
        for (std::size_t i = 0; i < pairs_.size(); ++i)
            if (known_[i]) largest = std::max(largest, std::abs(fe2d::height_on(path, pairs_[i].at.x) - pairs_[i].at.y));
        return largest;
    }
    bool left_line() const { return ever_left_; } ///< by more than `valid` elements: the line says no more of the path there

private:
    enum class Beyond { ends, straight };

    void mark(bool upstream)
    {
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            const std::size_t k = upstream ? i : pairs_.size() - 1 - i;
            if (!pairs_[k].damaged) break;
            known_[k] = true;
        }
    }

    Polyline tip(bool upstream, double start, Beyond beyond)
    {
        const Point a = upstream ? line_[0] : line_.end()[-2], b = upstream ? line_[1] : line_.end()[-1];
        double slope = (b.y - a.y) / (b.x - a.x);
        bool left = false;
        return tip_path(room_, upstream, start, element_, [&](Point p) -> std::optional<double> {
            left = left || std::abs(p.y - fe2d::height_on(line_, p.x)) > valid * element_;
            ever_left_ = ever_left_ || left;
            const fe2d::PathTension& pair = nearest(pairs_, p.x);
            if (left || !known_[static_cast<std::size_t>(&pair - pairs_.data())])
                return beyond == Beyond::straight ? std::optional(slope) : std::nullopt;
            const double found = std::tan(pair.angle); // of a pair that was sheared it says nothing: straight on
            if (pair.stress >= least_ && std::abs(found) <= steepest_path) slope = found;
            return slope;
        });
    }

    /// To where the other crack had come before: times rise towards a tip.
    void cut_where_met(Polyline& tip) const
    {
        std::size_t n = 1;
        for (double before = 0.0; n < tip.size() && nearest(pairs_, tip[n].x).time >= before; ++n)
            before = nearest(pairs_, tip[n].x).time;
        tip.resize(n);
    }

    /// Draws back both tips by up to a fifth until a path that rows can follow joins them. @returns whether there is one
    bool meet(Polyline& from, Polyline& to, double way) const
    {
        const auto apart = [&] {
            const double x = way * (to.back().x - from.back().x);
            return x >= element_ && std::abs(to.back().y - from.back().y) <= steepest_path * x;
        };
        for (std::size_t k = (from.size() + to.size()) / 5; k > 0 && !apart() && std::min(from.size(), to.size()) > 1; --k)
            (k % 2 == 0 ? from : to).pop_back();
        return apart();
    }

    const Pairs& pairs_;
    std::vector<bool> known_;
    Polyline line_;
    Room room_;
    double element_, least_;
    bool ever_left_ = false;
};

/// The pairs of a crack in the run that has cracked most of it; null: no run has its line.
const Pairs* longest(const std::vector<const fe2d::RunResult*>& runs, const std::vector<LiftJoint>& joints, const std::string& name)
{
    std::size_t place = 0; // among the paths
    for (const LiftJoint& joint : joints) {
        if (joint.name == name) break;
        place += !joint.path.empty();
    }
    const Pairs* found = nullptr;
    for (const fe2d::RunResult* run : runs) {
        if (run->cracks.paths.size() <= place) continue;
        const Pairs& pairs = run->cracks.paths[place];
        if (!found || cracked(pairs) > cracked(*found)) found = &pairs;
    }
    return found;
}

} // namespace

bool draw_paths_anew(Scene& scene, const std::vector<const fe2d::RunResult*>& runs, std::vector<TracedCrack>& cracks)
{
    const std::vector<LiftJoint> joints = scene.lift_joints; // as they ran
    bool moved = false;
    for (TracedCrack& crack : cracks) {
        const Pairs* pairs = crack.passes < most_path_passes ? longest(runs, joints, crack.name) : nullptr;
        const std::ptrdiff_t damaged = pairs ? cracked(*pairs) : 0;
        if (damaged == 0 || (crack.settled && damaged <= crack.damaged + more_damaged)) continue;
        if (!crack.other && !crack.alone && begins_at(*pairs, !crack.from_upstream))
            crack.other = (crack.from_upstream ? pairs->back() : pairs->front()).at.y;
        Drawing drawing(scene, crack, *pairs);
        Polyline path = drawing.path(crack);
        ++crack.passes;
        crack.change = drawing.change(path);
        crack.settled = (crack.other || !drawing.left_line()) && crack.change < element_length(scene);
        crack.damaged = damaged;
        if (crack.settled) continue;
        put(scene, crack, std::move(path));
        moved = true;
    }
    return moved;
}

} // namespace damslip
