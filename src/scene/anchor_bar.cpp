#include "scene/anchor_bar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace damslip {

double AnchorBar::stretch(double gap, double slip) const
{
    // l² - L² over l + L: no digits are lost where the bar is long and the slip small.
    const double change = gap * (2.0 * length * cosine + gap) + slip * (2.0 * length * sine + slip);
    const double now = std::hypot(length * cosine + gap, length * sine + slip);
    return change / (now + length);
}

BarDirection AnchorBar::direction(double gap, double slip) const
{
    const double across = length * cosine + gap, along = length * sine + slip, now = std::hypot(across, along);
    return {across / now, along / now};
}

double AnchorBar::slip_to_yield() const
{
    // (L sin ψ + s)² = (L + stretch)² - (L cos ψ)²
    const double more = stretch_to_yield() * (2.0 * length + stretch_to_yield()), start = length * std::abs(sine);
    return more / (std::sqrt(start * start + more) + start);
}

AnchorBar anchor_bar(const Anchor& anchor, double friction)
{
    AnchorBar bar;
    bar.name = anchor.name;
    bar.length = anchor.free_length;
    bar.sine = std::sin(anchor.inclination);
    bar.cosine = std::cos(anchor.inclination);
    bar.axial_stiffness = anchor.young_modulus * anchor.area;
    bar.yield_force = anchor.yield_strength * anchor.area;
    bar.prestress = anchor.prestress;
    bar.rupture_strain = anchor.rupture_strain;
    if (anchor.dowel)
        bar.dowel = bar.yield_force / std::numbers::sqrt3 * std::max(0.0, bar.cosine - friction * std::abs(bar.sine));
    return bar;
}

DowelChord dowel_chord(int number)
{
    constexpr double step = 0.5 * std::numbers::pi / dowel_chords;
    DowelChord chord;
    chord.from = std::sin(number * step);
    chord.to = number + 1 == dowel_chords ? 1.0 : std::sin((number + 1) * step);
    const double f_from = std::cos(number * step),
                 f_to = number + 1 == dowel_chords ? 0.0 : std::cos((number + 1) * step);
    chord.per_share = (f_to - f_from) / (chord.to - chord.from);
    chord.constant = f_from - chord.per_share * chord.from;
    return chord;
}

double dowel_share(double share)
{
    constexpr double step = 0.5 * std::numbers::pi / dowel_chords;
    const double n = std::clamp(share, 0.0, 1.0);
    const DowelChord chord = dowel_chord(std::min(dowel_chords - 1, static_cast<int>(std::asin(n) / step)));
    return std::max(0.0, chord.constant + chord.per_share * n);
}

AnchorState AnchorHistory::state_at(const AnchorBar& bar, double at_stretch) const
{
    if (state == AnchorState::snapped) return state;
    const double trial = trial_force(bar, at_stretch);
    if (trial < 0.0) return AnchorState::slack;
    return trial > bar.yield_force ? AnchorState::yields : AnchorState::elastic;
}

void AnchorHistory::stretch_to(const AnchorBar& bar, double to)
{
    if (state == AnchorState::snapped) return;
    stretch = to;
    largest_stretch = std::max(largest_stretch, to);
    const double trial = trial_force(bar, to);
    if (trial > bar.yield_force) {
        const double more = (trial - bar.yield_force) / bar.axial_stiffness;
        plastic_strain += more;
        plastic_work += bar.yield_force * more * bar.length;
    }
    force = std::clamp(trial, 0.0, bar.yield_force);
    largest_force = std::max(largest_force, force);
}

void AnchorHistory::snap(const AnchorBar& bar, double time)
{
    loss = stored(bar);
    force = 0.0;
    state = AnchorState::snapped;
    snapped_at = time;
}

AnchorHistory anchor_at_lock_off(const AnchorBar& bar)
{
    AnchorHistory history;
    history.force = history.largest_force = bar.prestress;
    return history;
}

} // namespace damslip
