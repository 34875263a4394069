#pragma once

#include "sliding/block/slide.hpp"

#include <memory>
#include <string>

namespace damslip::sliding {

/// The static state of the block between two records of a sequence: water at rest in what has cracked so far.
class RestBetweenEvents {
public:
    virtual ~RestBetweenEvents() = default;

    /// The crack that opens with sliding in a direction (downstream: at the heel), under (a_h, a_v) [m/s²]; a block that slides
    /// has the crack of its own acceleration, no longer one [m].
    virtual double crack(SlipDirection direction, double a_h, double a_v) const = 0;

    struct Rest {
        SlipStages stages;                             ///< as many as before, from the same paths on
        std::string note;                              ///< what it stands on, for people
        std::shared_ptr<const RestBetweenEvents> next; ///< from there on
    };
    /// With cracks of these lengths [m]. Its first block says whether it stands (static_state()).
    virtual Rest rest(double heel, double toe) const = 0;
};

/// slide() of a sequence with such a state after each record but the last: slip, its path and the strength lost with it,
/// friction that lags and anchors go on, the motion itself has come to rest. A block that does not stand there ends the
/// sequence with the status of its static state. @param rests  null: as slide()
SlideResult slide(const GroundMotion& motion, const SlipStages& stages, const SlideOptions& options,
                  const RestBetweenEvents* rests);

} // namespace damslip::sliding
