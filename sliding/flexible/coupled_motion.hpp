#pragma once

#include "sliding/block/line.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/block/slip_totals.hpp"
#include "sliding/block/yield.hpp"
#include "sliding/flexible/flexible_block.hpp"
#include "sliding/flexible/oscillator.hpp"

#include <vector>

namespace damslip::sliding {

/// State of a block that slides and vibrates, and its advance. Used by slide_coupled().
class CoupledMotion {
public:
    CoupledMotion(const SlipStages& stages, const FlexibleBlock& flexible, const SlidingOptions& options);

    /// Ground acceleration linear from a_h.now, a_v.now at `start` to the ends at start + dt.
    void cross(double start, double dt, const Line& a_h, const Line& a_v);

    bool moving() const { return direction_ != 0; }
    /// True when neither slip nor the vibration left can move a block on quiet ground.
    bool at_rest_for_good() const;
    double slip() const { return slid_.downstream - slid_.upstream; }
    double slip_rate() const { return direction_ * rate_; }
    double yield(double a_v) const { return forms().down.yield.law.at(a_v); }
    const OscillatorState& mode() const { return mode_; }
    double peak_acceleration() const { return peak_acceleration_; }
    void write(SlideResult& result) const;

private:
    /// Sliding one way in one stage.
    struct Way {
        Yield yield;
        double coupling; ///< c f [-]
        Oscillator mode; ///< while sliding, inertia 1 - Gamma c f
    };
    struct StageForms {
        Way down, up;
    };
    /// What slides and vibrates h after the start of the step.
    struct Moved {
        OscillatorState mode;
        double path = 0.0, rate = 0.0;
    };

    void step(double h);
    void rest(double& h);
    void move(double& h);
    void rest_until(double h);
    void move_until(double h);
    void start(int direction);
    void stop();
    Moved moved(double h) const;
    double excess(int direction, double h) const;
    double average_acceleration(const OscillatorState& state, double a_h) const;
    void enter_stages();

    Way way_of(const RigidBlock& block, const Yield& yield) const;
    const StageForms& forms() const { return forms_[stage_]; }
    const Way& way(int direction) const { return direction > 0 ? forms().down : forms().up; }
    double a_h(double h) const { return a_h_ + h * a_h_rate_; }
    double a_v(double h) const { return a_v_ + h * a_v_rate_; }
    void elapse(double h);

    FlexibleBlock flexible_;
    bool two_way_;
    double omega_;
    Oscillator free_mode_;
    std::vector<StageForms> forms_;
    std::vector<double> from_slip_;
    double longest_step_;

    double time_ = 0.0, a_h_ = 0.0, a_h_rate_ = 0.0, a_v_ = 0.0, a_v_rate_ = 0.0;
    OscillatorState mode_;
    std::size_t stage_ = 0;
    int direction_ = 0; ///< +1 downstream, -1 upstream, 0 at rest
    double rate_ = 0.0; ///< along the direction [m/s]
    double path_ = 0.0;

    SlipTotals slid_;
    double peak_acceleration_ = 0.0;
};

} // namespace damslip::sliding
