#include "scene/checks.hpp"

#include "core/number.hpp"
#include "scene/section.hpp"
#include "scene/uplift_row.hpp"

#include <cmath>
#include <fmt/format.h>

namespace damslip::checks {

void check_base(const Scene& s, Findings& f)
{
    const double base = base_length(s.section);
    if (s.curtain && s.curtain->distance + s.curtain->thickness > base)
        f.wrong("curtain.distance",
                fmt::format("the curtain ends outside the base: {} + {}, base length = {} m.",
                            value("curtain.distance_m", s.curtain->distance),
                            value("curtain.thickness_m", s.curtain->thickness), shortest(base)),
                "distance_m + thickness_m at most the base length", "lessen curtain.distance_m");
    if (s.curtain && s.foundation && s.curtain->depth >= s.foundation->depth)
        f.wrong("curtain.depth",
                fmt::format("{} reaches through the rock box, {}.", value("curtain.depth_m", s.curtain->depth),
                            value("foundation.depth_m", s.foundation->depth)),
                "curtain.depth_m below foundation.depth_m", "deepen the box or shorten the curtain");
    if (s.foundation && s.foundation->width < 1.2 * base)
        f.wrong("foundation.width",
                fmt::format("{} is too narrow for a base of {} m.", value("foundation.width_m", s.foundation->width),
                            shortest(base)),
                "at least 1.2 x base; 5 to 7 x base is usual", "widen the box");
    if (s.foundation)
        for (const auto& [key, extent] :
             {std::pair("width", s.foundation->width), std::pair("depth", s.foundation->depth)})
            if (extent > 100 * base)
                f.wrong(fmt::format("foundation.{}", key),
                        fmt::format("foundation.{}_m = {} is more than a hundred times the base of {} m.", key,
                                    shortest(extent), shortest(base)),
                        fmt::format("at most 100 x base, {} m; 2 to 7 x base is usual", shortest(100 * base)),
                        "check the unit, or lessen the box");
    if (s.drains && s.drains->distance >= base)
        f.wrong("drains.distance",
                fmt::format("{} is not within the base of {} m.", value("drains.distance_m", s.drains->distance),
                            shortest(base)),
                "0 ... below the base length", "measure along the base from the heel");
    if (s.drains && s.drains->depth && s.foundation && *s.drains->depth >= s.foundation->depth)
        f.wrong("drains.depth",
                fmt::format("{} reaches through the rock box, {}.", value("drains.depth_m", *s.drains->depth),
                            value("foundation.depth_m", s.foundation->depth)),
                "drains.depth_m below foundation.depth_m", "deepen the box or shorten the drains");
    if (!s.uplift) return;
    if (const UpliftRow& row = uplift_row(s.uplift->model); !has_what_it_needs(s, row))
        f.wrong("uplift.model", fmt::format("uplift.model = \"{}\" needs {}.", row.word, row.needs), row.needs,
                fmt::format("add {} or choose another uplift.model", row.needs));
    if (s.uplift->model != UpliftModel::points && !s.uplift->points.empty())
        f.wrong("uplift.points", "uplift.points_m is given, but uplift.model is not \"points\".",
                "model = \"points\" with points_m", "write  model = \"points\"  or delete points_m");
    const auto& p = s.uplift->points;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p[i].x < 0 || p[i].x > base * (1 + 1e-12) || (i && p[i].x < p[i - 1].x)) {
            f.wrong("uplift.points",
                    fmt::format("uplift.points_m has the distance {} at place {}.", shortest(p[i].x), i + 1),
                    fmt::format("distances along the base from 0 to {} m, not decreasing", shortest(base)),
                    "put the points in order from heel to toe");
            break;
        }
    if (!p.empty() && (p.front().x != 0 || std::abs(p.back().x - base) > 1e-9 * base))
        f.wrong("uplift.points",
                fmt::format("uplift.points_m covers {} to {} m.", shortest(p.front().x), shortest(p.back().x)),
                fmt::format("from 0 (heel) to {} (toe)", shortest(base)), "add the missing end");
}

} // namespace damslip::checks
