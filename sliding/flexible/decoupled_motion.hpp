#pragma once

#include "sliding/block/line.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/block/slip_motion.hpp"
#include "sliding/flexible/flexible_block.hpp"
#include "sliding/flexible/oscillator.hpp"

namespace damslip::sliding {

/// A rigid block under the average acceleration k of a mass whose vibration does not know of the slip, and its advance.
/// Used by slide_decoupled().
///
/// Between two samples k = a_h + Gamma r is a line and a free vibration r = -x''. The block takes it in pieces, in each as
/// the line with k's own mean and first moment: integrated once and twice that line is k's closed form, so the rate and
/// the path at the end of a piece without an event are exact, however long the piece. Where something may start, stop or
/// change the piece is halved until k differs from the line by 1e-6 of its size at most.
class DecoupledMotion {
public:
    /// @param stages  kept by the caller for as long as this lives
    DecoupledMotion(const SlipStages& stages, const FlexibleBlock& flexible, const SlideOptions& options);

    /// Ground acceleration linear from a_h.now, a_v.now at `start` to the ends at start + dt.
    void cross(double start, double dt, const Line& a_h, const Line& a_v);

    /// True when the block rests and what is left of the vibration cannot move it on quiet ground.
    bool at_rest_for_good() const;
    double average_acceleration(double a_h) const; ///< k now [m/s^2]
    double peak_acceleration() const { return peak_acceleration_; }
    const SlipMotion& block() const { return block_; }

private:
    /// A part of a sample interval.
    struct Piece {
        double start = 0.0, length = 0.0;
        Line a_h, a_v;
        OscillatorState begin, end; ///< of the mode
        int halvings = 0;
    };
    /// What a piece's k is like.
    struct Course {
        Line k;           ///< at its ends
        double vibration; ///< bound of |r| [m/s^2]
        double bend;      ///< bound of the distance of k from its chord [m/s^2]
    };

    Course course_of(const Piece& piece) const;
    Line line_of(const Piece& piece, const Course& course) const;
    bool halve_again(const Piece& piece, const Course& course) const;
    bool rests_through(const Piece& piece, const Course& course) const;
    bool may_stop_unseen(const Piece& piece, const Course& course, const Line& line, double lowest_rate) const;
    void take(const Piece& piece);
    void take_halves(const Piece& piece);
    void look_for_peak(const Piece& piece);
    std::pair<Piece, Piece> halves_of(const Piece& piece) const;
    double vibration(const OscillatorState& state, double a_h, double a_h_rate) const;

    FlexibleBlock flexible_;
    double omega_;
    Oscillator mode_;
    SlipMotion block_, before_;  ///< before_: at the start of the piece being taken
    double factor_ = 1.0;        ///< largest slip acceleration per excess ground acceleration [-]
    double yield_per_a_v_ = 0.0; ///< largest change of the yield with a_v [-]

    OscillatorState state_;
    double peak_acceleration_ = 0.0;
};

} // namespace damslip::sliding
