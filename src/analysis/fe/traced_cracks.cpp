#include "analysis/fe/traced_cracks.hpp"

#include "scene/joint_bond.hpp"
#include "scene/mesh_sizes.hpp"
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
        for (const Polyline& line : below_) low = std::max(low, at(line, p.x) + margin_);
        for (const Polyline& line : above_) high = std::min(high, at(line, p.x) - margin_);
        return std::clamp(p.y, std::min(low, high), high);
    }
    static double at(const Polyline& line, double x)
    {
        if (x <= line.front().x) return line.front().y;
        for (std::size_t i = 1; i < line.size(); ++i)
            if (x <= line[i].x)
                return line[i - 1].y + (x - line[i - 1].x) / (line[i].x - line[i - 1].x) * (line[i].y - line[i - 1].y);
        return line.back().y;
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
    const auto ends_at_other = [&](const Polyline& p) { return way * (x_on(room.face(!crack.from_upstream), p.back().y) - p.back().x) < 1e-9; };
    while (!to.empty() && !ends_at_other(from) && to.size() > 1 && way * (to.back().x - from.back().x) < step) to.pop_back();
    if (!ends_at_other(from) && !to.empty()) {
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

bool draw_paths_anew(Scene& scene, const std::vector<const fe2d::RunResult*>& runs, std::vector<TracedCrack>& cracks)
{
    const double least = telling * *scene.dam.tensile_strength, element = element_length(scene);
    const std::vector<LiftJoint> joints = scene.lift_joints;
    bool moved = false;
    for (TracedCrack& crack : cracks) {
        if (crack.passes >= most_path_passes) continue;
        std::size_t place = 0; // among the paths
        for (const LiftJoint& j : joints) {
            if (j.name == crack.name) break;
            place += !j.path.empty();
        }
        const std::vector<fe2d::PathTension>* longest = nullptr;
        for (const fe2d::RunResult* run : runs)
            if (run->cracks.paths.size() > place &&
                (!longest || cracked(run->cracks.paths[place]) > cracked(*longest)))
                longest = &run->cracks.paths[place];
        if (!longest) continue;
        const std::vector<fe2d::PathTension>& pairs = *longest;
        const std::ptrdiff_t now = cracked(pairs);
        if (now == 0 || (crack.settled && now <= crack.damaged + more_damaged)) continue;
        std::vector<bool> known(pairs.size(), false); // without a gap from a start
        const auto mark = [&](bool upstream) {
            for (std::size_t i = 0; i < pairs.size(); ++i) {
                const std::size_t k = upstream ? i : pairs.size() - 1 - i;
                if (!pairs[k].damaged) break;
                known[k] = true;
            }
        };
        if (!crack.other && !crack.alone && begins_at(pairs, !crack.from_upstream))
            crack.other = (crack.from_upstream ? pairs.back() : pairs.front()).at.y;
        mark(crack.from_upstream);
        if (crack.other) mark(!crack.from_upstream);
        // Where the path leaves its line, what was found on the line beyond says nothing of it: the next pass knows more.
        const Polyline line = line_of(scene, crack.name)->path;
        const auto slope_of = [](Point a, Point b) { return (b.y - a.y) / (b.x - a.x); };
        const double at_upstream = slope_of(line[0], line[1]), at_downstream = slope_of(line.end()[-2], line.end()[-1]);
        double last = crack.from_upstream ? at_upstream : at_downstream;
        bool left = false, ever_left = false;
        const auto slope_at = [&](Point p) -> std::optional<double> {
            const double x = p.x;
            left = left || std::abs(p.y - Room::at(line, x)) > valid * element;
            ever_left = ever_left || left;
            if (left) return std::nullopt;
            const auto next = std::min_element(pairs.begin(), pairs.end(), [x](const auto& a, const auto& b) {
                return std::abs(a.at.x - x) < std::abs(b.at.x - x);
            });
            if (!known[static_cast<std::size_t>(next - pairs.begin())]) return std::nullopt;
            const double slope = std::tan(next->angle);
            if (next->stress >= least && std::abs(slope) <= steepest_path) last = slope;
            return last; // else straight on: it was sheared
        };
        const Room room(scene, crack.name, crack.start);
        const auto straight_on = [&](Point p) { return std::optional(slope_at(p).value_or(last)); };
        Polyline from = crack.other ? tip_path(room, crack.from_upstream, crack.start, element, slope_at)
                                    : tip_path(room, crack.from_upstream, crack.start, element, straight_on);
        last = crack.from_upstream ? at_downstream : at_upstream, left = false;
        Polyline to = crack.other ? tip_path(room, !crack.from_upstream, *crack.other, element, slope_at) : Polyline();
        // Each end as far as it got there first.
        const auto first_at = [&](double x) {
            return std::min_element(pairs.begin(), pairs.end(), [x](const auto& a, const auto& b) {
                       return std::abs(a.at.x - x) < std::abs(b.at.x - x);
                   })->time;
        };
        if (crack.other) {
            const auto rising = [&](Polyline& tip) { // times rise towards the tip
                std::size_t n = 1;
                for (double t = 0.0; n < tip.size() && first_at(tip[n].x) >= t; ++n) t = first_at(tip[n].x);
                tip.resize(n);
            };
            rising(from);
            rising(to);
            const double way = crack.from_upstream ? 1.0 : -1.0;
            const auto too_steep = [&] {
                const double apart = way * (to.back().x - from.back().x);
                return apart < element || std::abs(to.back().y - from.back().y) > steepest_path * apart;
            };
            // Two tips that have come to meet are joined from a little before.
            const auto points = static_cast<std::ptrdiff_t>(from.size() + to.size());
            for (std::ptrdiff_t k = points / 5; k > 0 && too_steep() && std::min(from.size(), to.size()) > 1; --k)
                (k % 2 == 0 ? from : to).pop_back();
            if (too_steep()) {
                crack.other.reset();
                crack.alone = true;
                last = crack.from_upstream ? at_upstream : at_downstream, left = false;
                from = tip_path(room, crack.from_upstream, crack.start, element, straight_on);
                to.clear();
            }
        }
        const Polyline path = joined(room, crack, std::move(from), std::move(to), element);
        ++crack.passes;
        crack.change = 0.0;
        for (std::size_t i = 0; i < pairs.size(); ++i)
            if (known[i]) crack.change = std::max(crack.change, std::abs(Room::at(path, pairs[i].at.x) - pairs[i].at.y));
        crack.settled = (crack.other || !ever_left) && crack.change < element;
        crack.damaged = now;
        if (crack.settled) continue;
        put(scene, crack, path);
        moved = true;
    }
    return moved;
}

} // namespace damslip
