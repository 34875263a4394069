#pragma once

#include "sliding/block/rigid_block.hpp"

namespace damslip::verification {

/// Water under a block that stands flat: nothing stops it, or it comes nowhere.
class FlatWater final : public sliding::SlowWater {
public:
    /// @param speed  [m/s] @param length  of the base [m]
    FlatWater(double speed, double length, bool open) : speed_(speed), length_(length), open_(open) {}
    double speed() const override { return speed_; }
    double length() const override { return length_; }
    double first(sliding::SlipDirection) const override { return 0.0; }
    double front(sliding::SlipDirection, double, double, double, double come) const override
    {
        return open_ ? come : 0.0;
    }
    sliding::WetCrack sliding(sliding::SlipDirection, double, double wet) const override { return crack(wet); }

private:
    sliding::WetCrack crack(double wet) const { return {open_ ? wet : 0.0, length_, 0.0}; }

    double speed_, length_;
    bool open_;
};

} // namespace damslip::verification
