#include "sliding/block/given_yield.hpp"

#include "core/input_error.hpp"
#include "core/text.hpp"

#include <cmath>

namespace damslip::sliding {

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

} // namespace damslip::sliding
