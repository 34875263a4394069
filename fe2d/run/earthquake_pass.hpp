#pragma once

#include "fe2d/run/earthquake_run.hpp"
#include "fe2d/run/ground_input.hpp"
#include "fe2d/run/slide_probe.hpp"

namespace damslip::fe2d {

/// The steps of a pass: rows of the history, and equal parts of each.
struct PassSteps {
    double row = 0.0;       ///< [s]
    int parts = 1;          ///< steps in a row
    double run_out = 0.0;   ///< at most [s]
    double rest_time = 0.0; ///< without slip, after which the dam is at rest [s]

    double step() const { return row / parts; }   ///< [s]
    long rows(double time) const;                 ///< that reach `time`
    double time(long row_before, int part) const; ///< end of a step [s]
    friend bool operator==(const PassSteps&, const PassSteps&) = default;
};

/// One run through the earthquake with steps of one size: the dam in motion, the ground below it, and what is written of both.
/// Several passes with the same steps go on side by side (EarthquakeRun::shake), each with a ground and an end of its own.
class EarthquakePass {
public:
    /// @param so_far  static stages and, with `before`, the history that goes on
    EarthquakePass(DynamicContact start, PlayedGround ground, const PassSteps& steps, const Strength& at_start,
                   const RunResult& so_far, PairSeries series, double frame_interval,
                   const std::optional<HistoryBefore>& before, SlideWatch watching);
    EarthquakePass(const EarthquakePass&) = delete; // the recorder points into it
    EarthquakePass& operator=(const EarthquakePass&) = delete;

    bool going() const { return going_; }
    bool makes_steps() const { return going_ && dynamics_.within_reach(); }
    DynamicContact& dynamics() { return dynamics_; }
    DynamicContact::Lane lane(double time) { return {&dynamics_, &strength_.law(), ground_.at(time), {}}; }
    long shown_rows() const { return shown_rows_; } ///< of all samples of the motion
    const Strength& strength() const { return strength_; }

    void after_step();
    /// Writes row n and finds out whether the pass goes on. @param stopped  somebody asked for an end
    void after_row(long n, bool stopped);
    /// What is known when the passes have come to their end.
    RunResult& finish();

private:
    void add_row();
    void end(Status status);
    void rest(long n);

    PassSteps steps_;
    DynamicContact dynamics_;
    PlayedGround ground_;
    Strength strength_;
    RunResult result_;
    HistoryRecorder recorder_;
    SlideProbe probe_;
    SlideWatch watch_;
    long record_rows_, all_rows_, rest_rows_; ///< to the end of the record; with the run-out; at rest
    long shown_rows_;
    long at_rest_since_ = -1; ///< row, of a sequence with more to come; -1: it moves
    bool going_ = true;
};

} // namespace damslip::fe2d
