#include "fe2d/run/earthquake_pass.hpp"

#include <cmath>

namespace damslip::fe2d {

namespace {

/// Energy that contact or the scheme has made up, beyond what the ground and the weights gave: of contact a twentieth of
/// it, or what lifts the dam by a tenth of a millimetre (landings at the end of coarse steps give and take as much). A stable
/// scheme with beta < gamma/2 lends some of the kinetic energy and takes it back; an unstable one soon has given many times
/// all else.
bool diverges(const DynamicContact& dynamics)
{
    const Energy& energy = dynamics.energy();
    const double given = std::abs(energy.external) + std::abs(energy.friction);
    const double little = 1e-4 * dynamics.static_normal_force();
    return !std::isfinite(energy.kinetic) || energy.contact_normal > little + 0.05 * given ||
           -energy.numerical > little + 10.0 * given;
}

} // namespace

long PassSteps::rows(double time) const
{
    return static_cast<long>(std::ceil(time / row - 1e-9));
}

double PassSteps::time(long row_before, int part) const
{
    return (static_cast<double>(row_before) + static_cast<double>(part) / parts) * row;
}

EarthquakePass::EarthquakePass(DynamicContact start, PlayedGround ground, const PassSteps& steps,
                               const Strength& at_start, const RunResult& so_far, PairSeries series,
                               double frame_interval, const std::optional<HistoryBefore>& before, SlideWatch watching)
    : steps_(steps), dynamics_(std::move(start)), ground_(std::move(ground)), strength_(at_start), result_(so_far),
      recorder_(before ? HistoryRecorder(dynamics_, result_.history, series, *before)
                       : HistoryRecorder(dynamics_, result_.history, series, frame_interval)),
      probe_(dynamics_.structure().planes(), so_far.rest(), dynamics_.state().contact.slip),
      watch_(std::move(watching)), record_rows_(steps.rows(ground_.end())),
      all_rows_(record_rows_ + steps.rows(steps.run_out)), rest_rows_(steps.rows(steps.rest_time)),
      shown_rows_(steps.rows(ground_.samples_end()))
{
    if (before) dynamics_.count_slips_from(before->slip_zero);
    result_.dt = steps.step();
    result_.status = Status::sliding_at_end;
    if (!before) result_.events.clear(); // of a coarser pass
    if (const MotionEvent* event = ground_.event())
        result_.events.push_back({event->name, 0.0, ground_.end(), 0.0, 0.0});
    watch_.add(probe_.instant(dynamics_, strength_.law()));
    recorder_.reserve(static_cast<std::size_t>(record_rows_) + 1);
    add_row();
    going_ = all_rows_ > 0;
}

void EarthquakePass::after_step()
{
    strength_.follow(dynamics_.state().contact);
    watch_.add(probe_.instant(dynamics_, strength_.law()));
}

void EarthquakePass::add_row()
{
    recorder_.add();
    watch_.add_row(result_.history.slide);
}

void EarthquakePass::end(Status status)
{
    result_.status = status;
    going_ = false;
}

void EarthquakePass::after_row(long n, bool stopped)
{
    add_row();
    if (stopped)
        end(Status::interrupted);
    else if (!dynamics_.within_reach())
        end(Status::left_plane);
    else if (diverges(dynamics_))
        end(Status::diverged);
    else if (n + 1 >= record_rows_ + rest_rows_ && at_rest(result_.history, steps_.rest_time))
        rest(n);
    else if (watch_.self_excited())
        end(Status::self_excited);
    if (n + 1 >= all_rows_) going_ = false; // still sliding
}

/// The end, or of a sequence the pause before its next record.
void EarthquakePass::rest(long n)
{
    if (!ground_.more()) return end(Status::at_rest);
    if (at_rest_since_ < 0) at_rest_since_ = n + 1;
    if (n + 1 < at_rest_since_ + steps_.rows(ground_.pause())) return;
    result_.events.back().slip = result_.history.slip.back();
    ground_.next(static_cast<double>(n + 1) * steps_.row);
    result_.events.push_back({ground_.event()->name, ground_.start(), ground_.end(), 0.0, 0.0});
    watch_.next_record(ground_.end());
    record_rows_ = steps_.rows(ground_.end());
    all_rows_ = record_rows_ + steps_.rows(steps_.run_out);
    at_rest_since_ = -1;
}

RunResult& EarthquakePass::finish()
{
    recorder_.finish();
    result_.run_out = watch_.figures();
    result_.events_left = ground_.left();
    return result_;
}

} // namespace damslip::fe2d
