#pragma once

#include "core/note.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <limits>
#include <string>
#include <vector>

/// Does a dam go on sliding by itself when the ground is at rest?
///
/// Over any time in which the ground rests the static loads alone do work. Of it
///
///     W_T = Σ T Δs
///
/// is that on sliding: the static thrust T on each plane times its mean slip s. (Their work on what deforms, opens and
/// rocks is left out: it comes back whenever the dam passes the same shape again.) Friction takes D_f, damping, radiation
/// and the scheme take D_damp, D_rad, D_num, and the dam keeps
///
///     ΔE = W_T − D_f − D_damp − D_rad − D_num,   χ = W_T / D_f
///
/// A dam that slides under a constant normal force N' has D_f = μ N' Δs = FS T Δs, so χ = 1/FS: with a static factor of
/// safety FS > 1 friction takes more than the thrust gives, and it comes to rest. χ >= 1 with FS > 1 means that it slips
/// while the base is unloaded, so that friction takes less: the thrust pays for the vibration that unloads it.
namespace damslip::fe2d {

/// What a motion on contact planes has come to at one instant; work since its start.
struct SlideInstant {
    double time = 0.0;        ///< [s]
    double slip = 0.0;        ///< of the base, area mean, positive downstream [m]
    double thrust_work = 0.0; ///< W_T, of all planes [J/m]
    double friction = 0.0;    ///< D_f, dissipated by sliding [J/m]
    double other_losses =
        std::numeric_limits<double>::quiet_NaN(); ///< D_damp + D_rad + D_num [J/m]; NaN: there is no ledger
    double normal_force = 0.0;                    ///< N' of the base, compression positive [N/m]
    bool open = false;                            ///< every pair of the base
    double sliding_factor = 0.0; ///< static FS with the strength of this instant, least of all planes [-]
};

/// Length of the windows after the record, and of the rest that ends a run: five periods of the dam, 5/f₁ [s].
/// @param first_frequency  f₁ of the dam on its bonded base [Hz]; 0: not known (imported sides whose nodes do not face each other), 1 s
double slide_window(double first_frequency);

/// What is watched for.
struct SlideLimits {
    double record_end = 0.0;          ///< the ground is at rest from here on [s]
    double static_normal_force = 0.0; ///< N' of the base before the motion [N/m]
    double rate_change = 0.1;         ///< share by which a steady rate falls from window to window at most [-]
};

/// One row for each row of the run's history, of the second before it. An indicator only while the ground moves.
struct SlideHistory {
    std::vector<double> thrust_over_friction; ///< χ [-]; NaN: friction has done no work
    std::vector<double> lift_offs;                 ///< times since the start that every pair of the base came to be open
    std::vector<double> unloaded_share;       ///< of the time: N' < 0.05 of its static value [-]
    std::vector<double> rate;                 ///< of the slip [m/s]
};

/// How a dam slid, with the ground moving and at rest.
struct RunOutFigures {
    double slip_shaking = 0.0;  ///< while the ground moved [m]
    double slip_at_rest = 0.0;  ///< with the ground at rest [m]
    int lift_offs = 0;               ///< in the run-out: times that every pair of the base came to be open
    double lift_off_frequency = 0.0; ///< from the first of them to the last [Hz]; 0: fewer than two
    double rate = 0.0;          ///< of the slip in the last second [m/s]

    // Of the three windows that decided where sliding is self-excited, else of the whole run-out.
    double thrust_over_friction = std::numeric_limits<double>::quiet_NaN(); ///< χ [-]; NaN: it did not slide
    double energy_kept = std::numeric_limits<double>::quiet_NaN();          ///< ΔE [J/m]; NaN: there is no ledger
    double unloaded_share = 0.0;                                            ///< N' < 0.05 of its static value [-]
    double sliding_factor = std::numeric_limits<double>::quiet_NaN(); ///< static FS with the strength at the end [-]

    /// Over a tenth of the slip came with the ground at rest, in more than three lift-offs: a warning, no status.
    bool ratchets() const;
};

/// Follows a run step by step. Sliding is self-excited where, with the ground at rest,
///
///     FS > 1,   ṡ₂ >= (1 − c) ṡ₁,   ṡ₃ >= (1 − c) ṡ₂,   χ >= 1 or ΔE >= 0
///
/// for the rates of three windows that follow one another (with several planes: for the power of the thrust) and the sums
/// over the three; c is SlideLimits::rate_change. c and the number of windows are a judgement: friction alone takes a constant
/// deceleration from the rate, so a dam that slows down falls by more from some window on.
class SlideWatch {
public:
    /// @param window  gives slide_window() of the dam; asked once, after the record
    SlideWatch(const SlideLimits& limits, std::function<double()> window);

    void add(const SlideInstant& now);         ///< after a step; the start first
    void add_row(SlideHistory& history) const; ///< for the present instant
    bool self_excited() const { return self_excited_; }
    /// Another record begins. @param record_end  the ground is at rest from here on [s]
    void next_record(double record_end);
    RunOutFigures figures() const;

private:
    struct Tally : SlideInstant {
        int lift_offs = 0;
        double unloaded = 0.0; ///< time with N' below the share [s]
    };
    double window_end() const;
    bool goes_on() const;
    double chi(const Tally& from, const Tally& to) const;

    SlideLimits limits_;
    std::function<double()> find_window_;
    double window_ = 0.0;       ///< [s]; 0: not asked for yet
    std::vector<Tally> second_; ///< the last one, from `oldest_` on; the present instant at its end
    std::size_t oldest_ = 0;    ///< what stands before it goes when it is more than half
    std::vector<Tally> edges_;  ///< of the windows, the record's end first
    int lift_offs_shaking_ = 0;
    double first_lift_off_ = 0.0, last_lift_off_ = 0.0; ///< of the run-out [s]
    bool self_excited_ = false;
};

/// What there is to say of a run with self-excited sliding: how far the dam slid, why, and what in the scene lets waves leave.
/// @param slip  [m]
std::vector<Note> self_excited_notes(const Scene& scene, double slip, const RunOutFigures& figures);

/// With the whole base open, of a run that goes on after its record; none: empty.
std::vector<Note> lift_off_notes(const RunOutFigures& figures);

} // namespace damslip::fe2d
