#include "fe2d/run/slide_watch.hpp"

#include "scene/rock_mass.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::fe2d {

namespace {

constexpr double unloaded_below = 0.05;  ///< of the static N' [-]
constexpr double indicator_time = 1.0;   ///< before each row of the history [s]
constexpr std::size_t usual_steps = 256; ///< twice those of that time, where steps are not short
constexpr std::size_t windows = 3;       ///< that have to go on alike
constexpr double ratchet_share = 0.1;     ///< of the slip [-]
constexpr int ratchet_lift_offs = 3;
constexpr double smallest_change = 1e-9; ///< of times [s]; of work: lifts of the dam by a nanometre are none [m]

} // namespace

double slide_window(double first_frequency)
{
    return first_frequency > 0.0 ? 5.0 / first_frequency : 1.0;
}

bool RunOutFigures::ratchets() const
{
    return std::abs(slip_at_rest) > ratchet_share * std::abs(slip_shaking + slip_at_rest) && lift_offs > ratchet_lift_offs;
}

SlideWatch::SlideWatch(const SlideLimits& limits, std::function<double()> window)
    : limits_(limits), find_window_(std::move(window))
{
    second_.reserve(usual_steps);
}

double SlideWatch::window_end() const
{
    return edges_.front().time + static_cast<double>(edges_.size()) * window_;
}

void SlideWatch::add(const SlideInstant& now)
{
    Tally next{now};
    if (!second_.empty()) {
        const Tally& last = second_.back();
        next.lift_offs = last.lift_offs + (now.open && !last.open);
        const bool unloaded = now.normal_force < unloaded_below * limits_.static_normal_force;
        next.unloaded = last.unloaded + (unloaded ? now.time - last.time : 0.0);
        if (!edges_.empty() && next.lift_offs > last.lift_offs) {
            if (last.lift_offs == lift_offs_shaking_) first_lift_off_ = now.time;
            last_lift_off_ = now.time;
        }
    }
    second_.push_back(next);
    while (second_.size() - oldest_ > 2 && second_[oldest_ + 1].time <= now.time - indicator_time + smallest_change)
        ++oldest_;
    if (2 * oldest_ > second_.size()) { // it stays within the store it has
        second_.erase(second_.begin(), second_.begin() + static_cast<std::ptrdiff_t>(oldest_));
        oldest_ = 0;
    }
    if (now.time < limits_.record_end - smallest_change) return;
    if (edges_.empty()) {
        edges_.push_back(next);
        lift_offs_shaking_ = next.lift_offs;
        return;
    }
    if (window_ == 0.0) window_ = find_window_();
    if (now.time < window_end() - smallest_change) return;
    edges_.push_back(next);
    self_excited_ = goes_on();
}

void SlideWatch::next_record(double record_end)
{
    limits_.record_end = record_end;
    edges_.clear();
}

double SlideWatch::chi(const Tally& from, const Tally& to) const
{
    const double friction = to.friction - from.friction;
    if (friction <= smallest_change * limits_.static_normal_force) return std::numeric_limits<double>::quiet_NaN();
    return (to.thrust_work - from.thrust_work) / friction;
}

bool SlideWatch::goes_on() const
{
    if (edges_.size() <= windows || !(edges_.back().sliding_factor > 1.0)) return false;
    const Tally *first = &edges_.back() - windows, *last = &edges_.back();
    double before = 0.0;
    for (const Tally* edge = first; edge != last; ++edge) {
        const double power = (edge[1].thrust_work - edge->thrust_work) / (edge[1].time - edge->time);
        if (!(power > 0.0) || power < (1.0 - limits_.rate_change) * before) return false;
        before = power;
    }
    const double work = last->thrust_work - first->thrust_work, friction = last->friction - first->friction;
    if (work <= smallest_change * limits_.static_normal_force) return false; // no thrust: nothing pays
    return work >= friction || work - friction - (last->other_losses - first->other_losses) >= 0.0;
}

void SlideWatch::add_row(SlideHistory& history) const
{
    const Tally &from = second_[oldest_], &now = second_.back();
    const double time = now.time - from.time;
    const auto share = [&](double change) { return time > 0.0 ? change / time : 0.0; };
    history.thrust_over_friction.push_back(chi(from, now));
    history.lift_offs.push_back(now.lift_offs);
    history.unloaded_share.push_back(share(now.unloaded - from.unloaded));
    history.rate.push_back(share(now.slip - from.slip));
}

RunOutFigures SlideWatch::figures() const
{
    RunOutFigures figures;
    if (second_.empty()) return figures;
    const Tally& now = second_.back();
    figures.sliding_factor = now.sliding_factor;
    const double last_second = now.time - second_[oldest_].time;
    if (last_second > 0.0) figures.rate = (now.slip - second_[oldest_].slip) / last_second;
    figures.slip_shaking = edges_.empty() ? now.slip : edges_.front().slip;
    if (edges_.empty()) return figures;
    figures.slip_at_rest = now.slip - figures.slip_shaking;
    figures.lift_offs = now.lift_offs - lift_offs_shaking_;
    if (figures.lift_offs > 1) figures.lift_off_frequency = (figures.lift_offs - 1) / (last_lift_off_ - first_lift_off_);
    const Tally& from = self_excited_ ? *(&edges_.back() - windows) : edges_.front();
    figures.thrust_over_friction = chi(from, now);
    figures.energy_kept =
        now.thrust_work - from.thrust_work - (now.friction - from.friction) - (now.other_losses - from.other_losses);
    if (now.time > from.time) figures.unloaded_share = (now.unloaded - from.unloaded) / (now.time - from.time);
    return figures;
}

std::vector<Note> lift_off_notes(const RunOutFigures& figures)
{
    if (figures.lift_offs == 0) return {};
    return {{NoteKind::lift_offs, {std::int64_t{figures.lift_offs}, figures.lift_off_frequency}}};
}

namespace {

/// The change of the scene that lets waves leave.
Note remedy(const Scene& scene)
{
    const std::string file = scene.file.string();
    if (!scene.foundation) return {NoteKind::no_slip_give_rock, {file}};
    if (!rock_has_mass(scene)) return {NoteKind::no_slip_let_radiate, {file}};
    if (scene.foundation->boundary == RockBoundary::fixed) return {NoteKind::no_slip_free_edge, {file}};
    return {NoteKind::no_slip_radiates};
}

} // namespace

std::vector<Note> self_excited_notes(const Scene& scene, double slip, const RunOutFigures& f)
{
    Note all{NoteKind::self_excited_no_friction, {1e3 * std::abs(slip), 1e3 * std::abs(f.rate), f.sliding_factor}};
    if (std::isfinite(f.thrust_over_friction)) {
        all.kind = NoteKind::self_excited;
        all.values.push_back(f.thrust_over_friction);
    }
    std::vector<Note> notes{std::move(all)};
    for (Note& note : lift_off_notes(f)) notes.push_back(std::move(note));
    notes.push_back(remedy(scene));
    return notes;
}

} // namespace damslip::fe2d
