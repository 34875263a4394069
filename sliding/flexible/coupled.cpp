#include "core/input_error.hpp"
#include "core/text.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/roots.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/block/slip_motion.hpp"
#include "sliding/flexible/flexible_mode.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
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
    const ModeState& mode() const { return mode_; }
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
        ModeState mode;
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
    double average_acceleration(const ModeState& state, double a_h) const;
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
    ModeState mode_;
    std::size_t stage_ = 0;
    int direction_ = 0; ///< +1 downstream, -1 upstream, 0 at rest
    double rate_ = 0.0; ///< along the direction [m/s]
    double path_ = 0.0;

    SlipTotals slid_;
    double peak_acceleration_ = 0.0;
};

CoupledMotion::CoupledMotion(const SlipStages& stages, const FlexibleBlock& flexible, const SlidingOptions& options)
    : flexible_(flexible), two_way_(options.two_way), omega_(2.0 * std::numbers::pi / flexible.period),
      free_mode_(omega_, flexible.damping_ratio, 1.0)
{
    double inertia = 1.0;
    for (const SlipStage& stage : stages) {
        const Way down = way_of(stage.block, yield_downstream(stage.block));
        const Way up = way_of(stage.block, yield_upstream(stage.block));
        inertia = std::min(inertia, 1.0 - flexible.mass_ratio * std::max(down.coupling, up.coupling));
        forms_.push_back({down, up});
        from_slip_.push_back(stage.from_slip);
    }
    longest_step_ = flexible.period * std::sqrt(inertia) / 40.0;
}

CoupledMotion::Way CoupledMotion::way_of(const RigidBlock& block, const Yield& yield) const
{
    const double coupling = std::cos(block.base_inclination) * yield.factor;
    return {yield, coupling, Oscillator(omega_, flexible_.damping_ratio, 1.0 - flexible_.mass_ratio * coupling)};
}

double CoupledMotion::average_acceleration(const ModeState& state, double a_h) const
{
    return (1.0 - flexible_.mass_ratio) * a_h + flexible_.mass_ratio * free_mode_.restoring(state);
}

/// Excess of a resting block over its yield a time h from now, were it to rest until then. While the block slides, s''
/// is a positive multiple of the same expression, which does not jump at start and stop.
double CoupledMotion::excess(int direction, double h) const
{
    if (direction < 0 && !two_way_) return -1.0;
    const ModeState state = h > 0.0 ? free_mode_.after(mode_, a_h_, a_h_rate_, h) : mode_;
    return direction * average_acceleration(state, a_h(h)) - way(direction).yield.law.at(a_v(h));
}

void CoupledMotion::cross(double start, double dt, const Line& a_h, const Line& a_v)
{
    time_ = start;
    a_h_ = a_h.now;
    a_v_ = a_v.now;
    a_h_rate_ = (a_h.end - a_h.now) / dt;
    a_v_rate_ = (a_v.end - a_v.now) / dt;
    const double steps = std::clamp(std::ceil(dt / longest_step_), 1.0, 1000.0);
    for (double k = 0.0; k < steps; ++k) step(dt / steps);
}

/// One look: from event to event until the step is used up. Every event but the last few uses up time; a block that
/// starts and stops within a look without getting anywhere rests.
void CoupledMotion::step(double h)
{
    for (int events = 0; h > 0.0 && events < 64; ++events)
        if (moving())
            move(h);
        else
            rest(h);
    if (h > 0.0) moving() ? move_until(h) : rest_until(h);
}

void CoupledMotion::rest(double& h)
{
    for (const int direction : {1, -1}) {
        double begin = 0.0;
        if (excess(direction, 0.0) <= 0.0) {
            double reached = h;
            if (excess(direction, h) <= 0.0) reached = 0.5 * h;
            if (excess(direction, reached) <= 0.0) continue;
            begin = bracketed_root([&](double t) { return excess(direction, t); }, 0.0, reached);
        }
        rest_until(begin);
        h -= begin;
        start(direction);
        if (h > 0.0 && moved(h).rate <= 0.0 && moved(0.5 * h).rate <= 0.0) { // no way made that could be seen
            direction_ = 0;
            --slid_.phases;
            rest_until(h);
            h = 0.0;
        }
        return;
    }
    rest_until(h);
    h = 0.0;
}

CoupledMotion::Moved CoupledMotion::moved(double h) const
{
    const Way& w = way(direction_);
    const double f = w.yield.factor, c_f = w.coupling, gamma = flexible_.mass_ratio;
    const double yield_now = w.yield.law.at(a_v_), yield_rate = w.yield.law.per_a_v * a_v_rate_;
    Moved m;
    m.mode = w.mode.after(mode_, (1.0 - c_f) * a_h_ + c_f * direction_ * yield_now,
                          (1.0 - c_f) * a_h_rate_ + c_f * direction_ * yield_rate, h);
    // w'' = f (+-(a_h - Gamma x'') - a_y), integrated once and twice.
    const double a0 = direction_ * a_h_ - yield_now, a1 = direction_ * a_h_rate_ - yield_rate;
    m.rate = rate_ + f * ((a0 + 0.5 * a1 * h) * h - direction_ * gamma * (m.mode.v - mode_.v));
    m.path =
        rate_ * h + f * ((0.5 * a0 + a1 * h / 6.0) * h * h - direction_ * gamma * (m.mode.x - mode_.x - mode_.v * h));
    return m;
}

void CoupledMotion::move(double& h)
{
    const auto rate = [&](double t) { return moved(t).rate; };
    double end = h;
    if (rate(0.5 * h) < 0.0) end = 0.5 * h;
    bool stops = rate(end) < 0.0;
    if (stops) {
        // A block that has just started has rate zero now: the root sought is the later one.
        double begin = 0.0;
        if (rate_ <= 0.0) {
            begin = 0.5 * end;
            while (begin > 1e-12 * end && rate(begin) <= 0.0) begin *= 0.5;
        }
        end = rate(begin) > 0.0 ? bracketed_root(rate, begin, end) : 0.0;
    }
    if (stage_ + 1 < from_slip_.size() && path_ + moved(end).path > from_slip_[stage_ + 1]) {
        const double target = from_slip_[stage_ + 1];
        end = bracketed_root([&](double t) { return path_ + moved(t).path - target; }, 0.0, end);
        stops = false;
        move_until(end);
        path_ = std::max(path_, target);
        enter_stages();
    } else {
        move_until(end);
    }
    h -= end;
    if (stops) stop();
}

void CoupledMotion::elapse(double h)
{
    a_h_ += h * a_h_rate_;
    a_v_ += h * a_v_rate_;
    time_ += h;
}

void CoupledMotion::rest_until(double h)
{
    if (h > 0.0) mode_ = free_mode_.after(mode_, a_h_, a_h_rate_, h);
    elapse(h);
    peak_acceleration_ = std::max(peak_acceleration_, std::abs(average_acceleration(mode_, a_h_)));
}

void CoupledMotion::move_until(double h)
{
    const Moved m = moved(h);
    const double before = rate_;
    mode_ = m.mode;
    rate_ = std::max(0.0, m.rate);
    const double path = std::max(0.0, m.path);
    path_ += path;
    (direction_ > 0 ? slid_.downstream : slid_.upstream) += path;
    slid_.largest = std::max(slid_.largest, std::abs(slip()));
    elapse(h);
    const Way& w = way(direction_);
    const double excess_now = direction_ * average_acceleration(mode_, a_h_) - w.yield.law.at(a_v_);
    // Of a sliding block: k - c s'' with k = a_y + s''/f and s'' = f excess/(1 - Gamma c f); a_y on a level base.
    const double average =
        w.yield.law.at(a_v_) + (1.0 - w.coupling) * excess_now / (1.0 - flexible_.mass_ratio * w.coupling);
    peak_acceleration_ = std::max(peak_acceleration_, std::abs(average));
    slid_.peak_rate = std::max({slid_.peak_rate, before, rate_});
}

void CoupledMotion::start(int direction)
{
    direction_ = direction;
    rate_ = 0.0;
    slid_.begin(time_, path_);
    enter_stages();
}

void CoupledMotion::stop()
{
    direction_ = 0;
    rate_ = 0.0;
    slid_.last_time = time_;
}

void CoupledMotion::enter_stages()
{
    while (stage_ + 1 < from_slip_.size() && path_ >= from_slip_[stage_ + 1]) ++stage_;
}

bool CoupledMotion::at_rest_for_good() const
{
    // The energy (x'/omega)^2 + x^2 of a free vibration does not grow; |restoring| <= omega^2 (1 + 2 zeta) amplitude.
    const double amplitude = std::hypot(mode_.x, mode_.v / omega_);
    const double bound = flexible_.mass_ratio * omega_ * omega_ * (1.0 + 2.0 * flexible_.damping_ratio) * amplitude;
    return !moving() && bound <= forms().down.yield.law.constant &&
           (!two_way_ || bound <= forms().up.yield.law.constant);
}

void CoupledMotion::write(SlideResult& result) const
{
    result.slip = slip();
    slid_.write(result, time_, moving());
}

namespace {

void add_sample(const CoupledMotion& block, double time, double a_v, FlexibleSlide& result)
{
    SlideHistory& history = result.slide.history;
    history.time.push_back(time);
    history.slip.push_back(block.slip());
    history.slip_rate.push_back(block.slip_rate());
    history.yield.push_back(block.yield(a_v));
    result.deflection.push_back(block.mode().x);
    result.deflection_rate.push_back(block.mode().v);
}

/// Stages without slope. What follows the last stage has no end to cut towards: it keeps its first friction.
SlipStages in_steps(const SlipStages& stages)
{
    SlipStages out;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const SlipStage& stage = stages[i];
        const bool cut = stage.friction_slope != 0.0 && i + 1 < stages.size();
        const int parts = cut ? 100 : 1;
        const double length = cut ? (stages[i + 1].from_slip - stage.from_slip) / parts : 0.0;
        for (int k = 0; k < parts; ++k) {
            SlipStage part = stage;
            part.from_slip = stage.from_slip + k * length;
            if (cut) part.block.friction = friction_at(stage, part.from_slip + 0.5 * length);
            part.friction_slope = 0.0;
            out.push_back(part);
        }
    }
    return out;
}

[[noreturn]] void refuse(const std::string& problem, const std::string& expected)
{
    Diagnostic wrong;
    wrong.file = "flexible_block";
    wrong.problem = problem;
    wrong.expected = expected;
    throw InputError(wrong);
}

} // namespace

void check_flexible(const FlexibleBlock& flexible, const SlipStages& stages)
{
    check_stages(stages);
    if (!(flexible.period > 0.0) || !std::isfinite(flexible.period))
        refuse("the period " + shortest(flexible.period) + " s is not allowed.", "a period > 0 s");
    if (!(flexible.damping_ratio >= 0.0 && flexible.damping_ratio <= 0.5))
        refuse("the damping ratio " + shortest(flexible.damping_ratio) + " is not allowed.", "0 ... 0.5");
    if (!(flexible.mass_ratio > 0.0 && flexible.mass_ratio <= 0.95))
        refuse("the mass ratio " + shortest(flexible.mass_ratio) + " is not allowed.", "> 0, at most 0.95");
    for (const SlipStage& stage : stages)
        for (const Yield& yield : {yield_downstream(stage.block), yield_upstream(stage.block)}) {
            const double coupling = std::cos(stage.block.base_inclination) * yield.factor;
            if (1.0 - flexible.mass_ratio * coupling < 0.01)
                refuse("friction " + shortest(stage.block.friction) +
                           " on a base this steep jams a block with the mass "
                           "ratio " +
                           shortest(flexible.mass_ratio) + ": 1 - Gamma c f is not above 0.01.",
                       "a smaller mass_ratio, less friction or a flatter base");
        }
}

void note_vibration(const SlideOptions& options, SlideResult& result)
{
    result.status = Status::sliding_at_end;
    result.notes.push_back({NoteKind::still_vibrating, {options.sliding.run_out_max}});
}

FlexibleSlide slide_coupled(const GroundMotion& motion, const SlipStages& stages, const FlexibleBlock& flexible,
                            const SlideOptions& options)
{
    check_motion(motion);
    check_flexible(flexible, stages);
    FlexibleSlide result;
    if (const StaticState still = static_state(stages.front().block); still != StaticState::at_rest) {
        result.slide.status = status_of(still);
        result.slide.notes.push_back({NoteKind::vibration_not_followed});
        return result;
    }
    const bool vertical = !motion.accel_v.empty(), history = options.history == HistoryOutput::samples;
    const double dt = motion.dt;
    const auto a_h = [&](std::size_t k) { return options.polarity * motion.accel_h[k]; };
    const auto a_v = [&](std::size_t k) { return vertical ? motion.accel_v[k] : 0.0; };
    CoupledMotion block(in_steps(stages), flexible, options.sliding);
    if (history) add_sample(block, 0.0, a_v(0), result);
    const std::size_t last = motion.accel_h.size() - 1;
    for (std::size_t k = 0; k < last; ++k) {
        block.cross(static_cast<double>(k) * dt, dt, {a_h(k), a_h(k + 1)}, {a_v(k), a_v(k + 1)});
        if (history) add_sample(block, static_cast<double>(k + 1) * dt, a_v(k + 1), result);
    }
    const double end = static_cast<double>(last) * dt;
    for (double t = 0.0; t < options.sliding.run_out_max && !block.at_rest_for_good(); t += dt) {
        block.cross(end + t, std::min(dt, options.sliding.run_out_max - t), {}, {});
        if (history) add_sample(block, end + std::min(t + dt, options.sliding.run_out_max), 0.0, result);
    }
    block.write(result.slide);
    result.peak_acceleration = block.peak_acceleration();
    if (block.moving()) {
        result.slide.status = Status::sliding_at_end;
        result.slide.notes.push_back({NoteKind::still_sliding, {options.sliding.run_out_max}});
    } else if (!block.at_rest_for_good()) {
        note_vibration(options, result.slide);
    }
    return result;
}

} // namespace damslip::sliding
