#include "analysis/screen/given_yield_runs.hpp"

#include "sliding/flexible/flexible_slide.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

GivenYieldRow given_yield_run(const GivenYieldBlock& block, const sliding::SlipStages& stages,
                              const GroundMotion& motion, const std::string& method)
{
    GivenYieldRow row;
    row.record = motion.name;
    row.method = method;
    for (const double a : motion.accel_h) row.pga = std::max(row.pga, std::abs(a));
    row.largest_acceleration = row.pga;
    if (method != "rigid") {
        row.mode = block.flexible;
        if (block.column) {
            const sliding::StrainCompatible found =
                strain_compatible(*block.column, motion, block.flexible->mass_ratio);
            row.mode = found.block;
            row.settled = found.settled;
        }
        row.largest_acceleration = 0.0;
    }
    sliding::SlideOptions options;
    options.sliding.two_way = block.two_way;
    for (const int polarity : {1, -1}) {
        options.polarity = polarity;
        sliding::SlideResult& slide = polarity > 0 ? row.normal : row.inverse;
        if (!row.mode) {
            slide = sliding::slide(motion, stages, options);
            continue;
        }
        sliding::FlexibleSlide found = method == "coupled"
                                           ? sliding::slide_coupled(motion, stages, *row.mode, options)
                                           : sliding::slide_decoupled(motion, stages, *row.mode, options);
        row.largest_acceleration = std::max(row.largest_acceleration, found.peak_acceleration);
        slide = std::move(found.slide);
    }
    if (!row.settled) row.normal.status = row.inverse.status = Status::not_resolved;
    return row;
}

} // namespace

Status GivenYieldRow::status() const
{
    const int one = status_row(normal.status).exit_code, other = status_row(inverse.status).exit_code;
    if (one != other) return worse_exit_code(one, other) == one ? normal.status : inverse.status;
    return normal.status == Status::at_rest ? inverse.status : normal.status;
}

std::vector<GivenYieldRow> given_yield_runs(const GivenYieldBlock& block, const std::vector<GroundMotion>& motions,
                                            const std::vector<std::string>& methods)
{
    const sliding::SlipStages stages = sliding::stages_of_yield(block.yield);
    std::vector<GivenYieldRow> rows;
    for (const GroundMotion& motion : motions) {
        GroundMotion horizontal = motion;
        horizontal.accel_v.clear();
        for (const std::string& method : methods) {
            rows.push_back(given_yield_run(block, stages, horizontal, method));
            rows.back().yield = block.yield.front().yield;
        }
    }
    return rows;
}

} // namespace damslip
