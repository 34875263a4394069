#pragma once

#include "fe2d/run/run_watches.hpp"
#include "fe2d/run/dynamic_contact.hpp"

#include <Eigen/Core>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace damslip::fe2d {

/// Everything of one instant of a run that a picture shows: dam, rock, water, and the joints.
struct RunFrame {
    double time = 0.0;                              ///< [s]
    double mean_slip = 0.0;                         ///< of the base, area mean since the static state [m]
    Eigen::VectorXd dam;                            ///< as StoredState::dam [m]
    Eigen::VectorXd rock;                           ///< as StoredState::rock [m]
    Eigen::VectorXd pressure, shear, slip, opening; ///< of the pairs of all planes; signs as PairHistory [Pa, Pa, m, m]
    Eigen::VectorXd
        joint_water;            ///< of the base's pairs, in a joint whose water follows its opening [Pa]; empty: others
    Eigen::VectorXd water;      ///< beyond the static one, at the nodes of acoustic water [Pa]; empty: other water
    std::vector<double> states; ///< of all pairs, ContactState as a number
};

/// How much farther the dam has slid than the steps of a run have found, as a rigid body.
struct SlipChange {
    std::function<double(double time)> at; ///< [s; m]; empty: no change
    Eigen::VectorXd sliding;               ///< displacements of a slide of 1 m, as StoredState::dam [-]
};

/// Frames of one pass of a run at equal intervals, in a file without a name: the memory does not grow with their number,
/// and the file goes with the last who holds it.
class FrameSpool {
public:
    /// @param interval  between frames, > 0 [s] @throws InputError where no file can be had
    explicit FrameSpool(double interval);

    /// Has the interval passed since the frame before? The first row of a history always gives one.
    bool due(double time) const { return count() == 0 || time >= next_ - 1e-9; }
    void add(const RunFrame& frame); ///< @throws InputError when the disk is full
    std::size_t count() const { return places_.size(); }
    double last_time() const { return last_; } ///< of the last frame [s] @pre count() > 0
    RunFrame read(std::size_t index) const;    ///< @pre index < count()
    void slide(SlipChange change) { change_ = std::move(change); } ///< of the frames read from now on

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> file_;
    std::vector<long> places_; ///< of the frames, bytes from the start
    double interval_, next_ = 0.0, last_ = 0.0;
    SlipChange change_;
};

/// Instants of a run whose displacements are kept.
enum class Instant {
    start,
    leans_downstream, ///< crest farthest downstream of the base
    leans_upstream,   ///< crest farthest upstream of it
    slides_fastest,   ///< largest |slip rate| between two rows of the history; not there when nothing slides
    end
};

/// Displacements of one instant as the run has them; EarthquakeRun::displacement_of() makes them those of the model.
struct StoredState {
    Instant instant = Instant::start;
    double time = 0.0;    ///< [s]
    double slip = 0.0;    ///< area mean since the static state [m]
    Eigen::VectorXd dam;  ///< of what moves, in its node order [m]
    Eigen::VectorXd rock; ///< of the rock's contact nodes, plane [m]
};

/// Keeps the states of a run's instants, each when it has come: two vectors are copied where a value exceeds all before.
class StateKeeper {
public:
    /// @param time  in the run's history [s] @param slip  area mean since the static state [m] @param crest_x  since the static state [m]
    void look(const DynamicState& state, double time, double slip, double crest_x);

    void slide(const SlipChange& change);
    /// In order of time. The end is the last state looked at.
    std::vector<StoredState> states() const;

private:
    std::vector<StoredState> kept_; ///< one by Instant; an empty `dam`: none
    double lean_down_ = 0.0, lean_up_ = 0.0, rate_ = 0.0;
};

/// Are the values of every pair kept at every row of the history?
enum class PairSeries {
    none,
    every_step ///< 33 bytes by pair and row
};

/// One lift joint over time.
struct LiftHistory {
    std::vector<double> slip;            ///< area mean of what is above, positive downstream [m]
    std::vector<double> rocking;         ///< rotation of what is above, positive where the upstream end opens [rad]
    std::vector<double> normal_force;    ///< N' [N/m]
    std::vector<double> largest_opening; ///< [m]
    std::vector<double> damaged, broken; ///< of its bond, BondLengths [m]; empty: it has none
};

/// One row of anchors over time.
struct AnchorSeries {
    std::string name;
    std::vector<double> force; ///< N [N/m]
};

/// Values of the base's m pairs over time; value of pair i in row r: [r * pairs + i]. Slips are counted from the static state.
struct PairHistory {
    Eigen::Index pairs = 0;
    std::vector<double> pressure; ///< effective, compression positive [Pa]
    std::vector<double> shear;    ///< on the dam, resisting downstream slip [Pa]
    std::vector<double> slip;     ///< positive downstream [m]
    std::vector<double> opening;  ///< [m]
    ContactStates state;

    std::size_t at(std::size_t row, Eigen::Index pair) const
    {
        return row * static_cast<std::size_t>(pairs) + static_cast<std::size_t>(pair);
    }
};

/// Values at the record's steps (and in the run-out at the same interval), the start included. Slips are counted from
/// the static state.
struct RunHistory {
    std::vector<double> time;        ///< [s]
    std::vector<double> ground_h;    ///< positive upstream [m/s²]
    std::vector<double> ground_v;    ///< positive up [m/s²]
    std::vector<double> slip;        ///< area mean, positive downstream [m]
    std::vector<double> slip_heel;   ///< of the first pair [m]
    std::vector<double> slip_middle; ///< half-way between heel and toe [m]
    std::vector<double> slip_toe;    ///< of the last pair [m]
    std::vector<double> rocking;     ///< rotation of the base over the rock, positive where the heel opens [rad]
    std::vector<double>
        crest_x; ///< upstream end of the crest relative to the ground, since the static state, downstream [m]
    std::vector<double> normal_force;    ///< N' = Σλ_n, of contact alone [N/m]
    std::vector<double> shear_force;     ///< on the dam, resisting downstream slip: -Σλ_t, of contact alone [N/m]
    std::vector<double> normal_position; ///< of N' from the heel [m]; NaN while the whole base is open
    std::vector<double> moment;          ///< of λ_n about the middle of the base, positive towards the toe [N m/m]
    std::vector<double> open_length;     ///< [m]
    std::vector<double> slipping_length; ///< [m]
    std::vector<double> largest_opening; ///< [m]
    // Of water that follows the opening of the base; empty without it.
    std::vector<double> crack_length;   ///< of the run of open pairs from the heel to its tip [m]
    std::vector<double> wet_length;     ///< how far water has come in it; opening mouth [m]
    std::vector<float> joint_pressure;  ///< of the base's m pairs, row by row [Pa]
    std::vector<Energy> energy;         ///< [J/m]
    std::vector<double> imbalance;      ///< [J/m]
    std::vector<LiftHistory> lifts;     ///< from bottom to top
    std::vector<AnchorSeries> anchors;  ///< in the order of the scene
    SlideHistory slide;                 ///< what pays for the sliding; rows of `time`
    PairHistory by_pair;                ///< rows of `time`; empty with PairSeries::none
    StateKeeper states;                 ///< displacements of some instants; empty with PairSeries::none
    std::shared_ptr<FrameSpool> frames; ///< null: not asked for
};

/// Slides the dam farther, as a rigid body: slips of the base and of its pairs, crest, kept instants and frames.
/// @param change  by row [m] @param sliding  as SlipChange::sliding @param level  horizontal part of the slide [-]
void slide(const std::vector<double>& change, const Eigen::VectorXd& sliding, double level, RunHistory& history);

/// Rotation of the base over the rock [rad]: the slope of the area-weighted least-squares line through the openings,
///
///     θ = -Σ A_i (d_i - d̄) g_i / Σ A_i (d_i - d̄)²,   d̄ = Σ A_i d_i / Σ A_i
///
/// positive where the heel opens more than the toe, zero for a joint that is shut.
/// @param opening  of the plane's pairs [m]
double base_rotation(const Plane& plane, const Eigen::VectorXd& opening);

/// base_rotation() of one plane, again and again.
class BaseRotation {
public:
    explicit BaseRotation(const Plane& plane);
    double of(const Eigen::Ref<const Eigen::VectorXd>& opening) const; ///< of the plane's pairs [m]; [rad]

private:
    Eigen::VectorXd moments_; ///< A_i (d_i - d̄) / Σ A_i
    double inertia_;          ///< Σ A_i (d_i - d̄)² / Σ A_i
};

/// Has the mean slip stayed the same, to 1e-4 of it or 0.1 µm, for the rest time? Both histories [s, m] of one length.
bool at_rest(const std::vector<double>& time, const std::vector<double>& slip, double rest_time);
/// The same of base and lift joints.
bool at_rest(const RunHistory& history, double rest_time);

/// Where a history goes on that another motion has begun.
struct HistoryBefore {
    double time = 0.0;         ///< added to that of the states [s]
    Energy spent;              ///< added to what is summed over the steps [J/m]
    double imbalance = 0.0;    ///< [J/m]
    Eigen::VectorXd slip_zero; ///< slips of all pairs from which slips are counted [m]
    double crest_zero = 0.0;   ///< displacement of the crest from which it is counted [m]
};

/// Writes the rows of a history while a run goes on.
class HistoryRecorder {
public:
    /// @param frame_interval  of RunHistory::frames [s]; 0: none
    HistoryRecorder(const ContactMotion& dynamics, RunHistory& history, PairSeries series = PairSeries::none,
                    double frame_interval = 0.0);
    /// Adds rows to a history. @param before  what its rows are counted from
    HistoryRecorder(const ContactMotion& dynamics, RunHistory& history, PairSeries series, const HistoryBefore& before);

    void reserve(std::size_t rows); ///< that many will come at least: none of them has to look for memory
    void add();                     ///< a row for the present state
    void finish();                  ///< the present state as the last frame, where frames are kept

private:
    void add_lifts(const Eigen::VectorXd& force);
    void add_anchors();
    void add_pairs(const Eigen::VectorXd& force);
    void add_frame(const Eigen::VectorXd& force);

    const ContactMotion& dynamics_;
    RunHistory& history_;
    PairSeries series_;
    Eigen::VectorXd start_;     ///< slips of all pairs that they are counted from [m]
    Eigen::VectorXd to_middle_; ///< weights of the one or two pairs nearest to the middle of the base [-]
    Eigen::Index crest_ = 0;
    double crest_start_ = 0.0;
    HistoryBefore before_;                 ///< of the first motion: nothing
    std::vector<BaseRotation> rotations_;  ///< by plane
    Eigen::VectorXd slip_, contact_force_; ///< of the row at hand
};

} // namespace damslip::fe2d
