#include "scene/planes.hpp"

#include "scene/section.hpp"

#include <algorithm>
#include <cmath>

namespace damslip {

double lowest_lift(const Section& section)
{
    return std::max(heel(section).y, toe(section).y);
}

std::vector<double> made_lifts(const Lifts& lifts, const Section& section)
{
    if (!lifts.spacing) return lifts.elevations;
    const double low = lowest_lift(section), high = crest_level(section), step = *lifts.spacing;
    const double from = lifts.from.value_or(low + step), to = std::min(lifts.to.value_or(high) + same_level, high - same_level);
    std::vector<double> list;
    for (double y = from; y <= to; y = from + static_cast<double>(list.size()) * step) list.push_back(y);
    return list;
}

std::vector<double> lift_elevations(const Scene& scene)
{
    std::vector<double> all;
    for (const LiftJoint& joint : scene.lift_joints) all.push_back(joint.elevation);
    if (scene.lifts)
        for (const double y : made_lifts(*scene.lifts, scene.section))
            if (std::none_of(all.begin(), all.end(), [y](double other) { return std::abs(y - other) < same_level; }))
                all.push_back(y);
    std::sort(all.begin(), all.end());
    return all;
}

double base_level(const Section& section, double x)
{
    const Point a = heel(section), b = toe(section);
    return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

Polyline ground_line(const Scene& scene)
{
    const Point first = heel(scene.section), last = toe(scene.section);
    const Polyline given = scene.foundation ? scene.foundation->ground : Polyline{};
    Polyline line{first, last};
    for (const Point p : given)
        if (p.x > last.x) line.push_back(p);
    Polyline upstream;
    for (const Point p : given)
        if (p.x < first.x) upstream.push_back(p);
    line.insert(line.begin(), upstream.begin(), upstream.end());
    return line;
}

double ground_level(const Polyline& ground, double x)
{
    if (x <= ground.front().x) return ground.front().y;
    for (std::size_t i = 1; i < ground.size(); ++i)
        if (const Point &a = ground[i - 1], &b = ground[i]; x <= b.x)
            return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
    return ground.back().y;
}

Polyline seam_path(const Scene& scene, const Seam& seam)
{
    if (!seam.depth) return seam.points;
    const Point a{heel(scene.section).x, heel(scene.section).y - *seam.depth}, end = toe(scene.section);
    const double slope = -std::tan(seam.dip);
    const auto at = [&](double x) { return Point{x, a.y + slope * (x - a.x)}; };
    if (seam.exit != SeamExit::daylight) return {a, at(end.x + (seam.wedge ? seam.wedge->distance : 0.0))};
    const Polyline ground = ground_line(scene);
    const double far = end.x + 100.0 * (end.x - a.x);
    double from = end.x;
    const auto above = [&](double x) { return at(x).y - ground_level(ground, x); };
    if (above(from) >= 0.0) return {a, at(from)};
    std::vector<double> corners;
    for (const Point& corner : ground)
        if (corner.x > from && corner.x < far) corners.push_back(corner.x);
    corners.push_back(far);
    for (const double to : corners) { // ground and seam are straight from corner to corner
        const double low = above(from), high = above(to);
        if (high >= 0.0) return {a, at(from + (to - from) * low / (low - high))};
        from = to;
    }
    return {a, at(end.x)};
}

const Contact& base_strength(const Scene& scene)
{
    return scene.seam_body ? scene.seam_body->strengths.front() : scene.contact;
}

std::vector<LiftJoint> joints_of(const Scene& scene)
{
    std::vector<LiftJoint> joints = scene.lift_joints;
    if (!scene.seam_body) return joints;
    const std::vector<LiftJoint>& own = scene.seam_body->interfaces; // the first is the base
    joints.insert(joints.end(), own.begin() + 1, own.end());
    joints.insert(joints.begin(), own.front());
    return joints;
}

} // namespace damslip
