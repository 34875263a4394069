#pragma once

#include "sliding/block/slide.hpp"

namespace damslip::sliding {

/// What a block has slipped so far, flat on its base or on a corner.
struct SlipTotals {
    double downstream = 0.0, upstream = 0.0;  ///< sums of the movements, >= 0 [m]
    double largest = 0.0;                     ///< |slip| on the way [m]
    double peak_rate = 0.0;                   ///< |slip rate| [m/s]
    double first_time = 0.0, last_time = 0.0; ///< first start, last stop [s]; meaningful with phases > 0
    double start_path = 0.0;                  ///< path slipped before the latest movement [m]
    int phases = 0;                           ///< movements
    int lift_offs = 0;                        ///< times that N' reached zero

    /// A movement begins. @param path  slipped so far [m]
    void begin(double time, double path)
    {
        start_path = path;
        if (++phases == 1) first_time = time;
    }
    /// It ends; one in which nothing moved is taken back.
    void end(double time, double path)
    {
        if (path == start_path)
            --phases;
        else
            last_time = time;
    }

    /// @param now  end of the motion [s] @param moving  it slides then
    void write(SlideResult& result, double now, bool moving) const
    {
        result.max_slip = largest;
        result.downstream_slip = downstream;
        result.upstream_slip = upstream;
        result.peak_slip_rate = peak_rate;
        result.phases = phases;
        result.lift_offs = lift_offs;
        result.end_time = now;
        if (phases == 0) return;
        result.first_slip_time = first_time;
        result.last_slip_time = moving ? now : last_time;
    }
};

} // namespace damslip::sliding
