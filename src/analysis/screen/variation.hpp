#pragma once

#include "analysis/screen/screening.hpp"

/// Around the scene, computed when a report asks for it: yield acceleration over friction and water level, slip over
/// friction, and the slides of one record with their histories.
namespace damslip {

/// Yield acceleration over friction or level, a curve for each uplift model the scene has the data for, its own first.
struct YieldVariation {
    struct Curve {
        std::string uplift;        ///< "uplift drains, as given"
        std::vector<double> yield; ///< downstream [m/s^2]
    };
    std::vector<double> at; ///< friction [-], or level above the heel [m]
    std::vector<Curve> curves;
};
YieldVariation yields_by_friction(const Scene& scene, const Screening& s);
YieldVariation yields_by_level(const Scene& scene, const Screening& s); ///< @pre scene.reservoir

/// The scene whose uplift of model "seepage" is given as the profile that the screening has found, so that variants of it
/// need no further solution. With a tailwater above the toe p over p_heel holds for the scene's own levels only.
Scene with_solved_uplift(const Scene& scene, const Screening& s);

/// Largest slip of the worse polarity, with the vertical component where a record has one.
struct SlipVariation {
    std::vector<double> friction;
    std::vector<std::vector<double>> slip; ///< of each friction, of each record [m]; NaN: none
};
/// @param jobs  threads, 0: all cores
/// @returns nothing without records, or for a scene whose friction is a table over slip
std::optional<SlipVariation> slips_by_friction(const Scene& scene, const Screening& s,
                                               const std::vector<GroundMotion>& motions, int jobs);

/// The slides of one record with their histories, each with the polarity that is worse.
struct RecordHistories {
    struct Slide {
        int polarity = 1;
        sliding::SlideResult slide;
    };
    struct Flexible {
        int polarity = 1; ///< worse by the analysis that is judged
        FlexibleSlips slips;
    };
    struct Rocking {
        int polarity = 1; ///< the one that slips further
        sliding::RockingResult motion;
    };
    Slide horizontal;                   ///< without the vertical component
    std::optional<Slide> with_vertical; ///< where the record has one
    std::optional<Flexible> flexible;   ///< where the sliding mass is flexible
    std::optional<Rocking> rocking;     ///< where the block was free to rock, with the vertical component
};
/// @param motion  of record `number`
RecordHistories record_histories(const Scene& scene, const Screening& s, const GroundMotion& motion,
                                 std::size_t number);

} // namespace damslip
