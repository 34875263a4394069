#pragma once

#include "core/geometry.hpp"
#include "core/status.hpp"
#include "fe2d/run/contact_structure.hpp"
#include "scene/scene.hpp"

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <optional>
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

/// Where a dam that is computed in one piece would crack.
/// The largest index of a tied lift: 1 where a pair of its nodes would part or slip, were it a joint.
struct TiedLift {
    std::string name;       ///< the scene's
    double elevation = 0.0; ///< [m]
    double index = 0.0;     ///< [-]
    double time = 0.0;      ///< [s]
    double distance = 0.0;  ///< from the upstream face [m]
};

/// Where a crack goes. A pair of a traced crack keeps σ₁ of the step before it was damaged; a whole pair keeps the largest σ₁ so far.
struct PathTension {
    Point at;             ///< [m]
    bool damaged = false; ///< the pair has come to its strength
    double stress = 0.0;  ///< σ₁ about it, mean over a characteristic length [Pa]
    double angle = 0.0;   ///< of a crack across σ₁, from the horizontal, rising downstream positive, -π/2 ... π/2 [rad]
    double time = 0.0;    ///< [s]
};

/// The largest principal tension away from base, lift joints and tied lifts, and what tied lifts come to. Static state included.
struct CrackFigures {
    std::vector<TiedLift> lifts; ///< in the order of Scene::tied_lifts
    double stress = 0.0;         ///< σ₁, mean over about a characteristic length, tension positive [Pa]
    double time = 0.0;           ///< [s]
    Point at;                    ///< [m]
    double angle = 0.0;          ///< of a crack across it, as PathTension::angle [rad]
    std::vector<std::vector<PathTension>> paths; ///< of the traced cracks, in the order of the lift joints
    PathTension seed;            ///< on a face, across which a crack would not be steeper than steepest_path
    double strength = std::numeric_limits<double>::infinity(); ///< f_t of concrete whose cracks are traced, while more may come [Pa]
    bool known = false;          ///< a run in time steps was watched

    bool cracks() const { return seed.stress >= strength; } ///< a face away from all lines
    bool wakes() const; ///< has a tied lift reached wake_index, or concrete its strength? Then another model has one more line
};

inline constexpr double steepest_path = 1.0; ///< tangent of a path that rows of elements can follow

/// Index from which on a tied lift is a joint in another run: below 1, so that nothing of it would have moved.
inline constexpr double wake_index = 0.8;

/// Where a traced crack has begun on a face: it relieves the face, no other begins within its reach.
struct CrackStart {
    Point at;
    double reach = 0.0; ///< [m]
};

/// Linear functionals of the dam's displacements, made once for a structure.
///
/// Tied lifts: the forces of the pair at a node of the line are half the difference of the internal forces of the elements
/// above and below it, f = ½ Σ_above K_e (u + b_K v) - ½ Σ_below K_e (u + b_K v); inertia and weight of the two half elements
/// cancel where these are of one size. Less the water's p A, they are held against the law of the joint as it is before it has
/// moved (JOINTS 1): √((tension/f_t A)² + ((|λ_t| - μ λ_n)/(c A))²), without bond |λ_t|/(μ λ_n + c A).
///
/// Stresses: means over the elements whose centres lie within ℓ_ch/2 of that of one element, ℓ_ch = E' G/f_t² with
/// G = 200 N/m and f_t = 2 MPa where the scene has none, at most a tenth of the height. Longer elements: that of the element at its centre. Left out: within
/// ℓ_ch of a line, where a tip is singular and the line has a law of its own, and elements with a node on one.
class CrackLines {
public:
    CrackLines(const Scene& scene, const ContactStructure& structure, double stiffness_damping,
               const std::vector<CrackStart>& begun = {});

    CrackFigures none_yet() const { return none_yet_; }

private:
    friend class CrackWatch;
    struct Row {
        int begin = 0, end = 0; ///< of `node_`, `block_`
    };
    struct PairOfLine {
        Row force; ///< rows of x and y
        double area = 0.0, distance = 0.0;
        double water = 0.0; ///< p A [N/m]
    };
    struct Line {
        std::vector<PairOfLine> pairs;
        double friction = 0.0, cohesion = 0.0, tension = 0.0; ///< μ, c, f_t of the pairs [-, Pa, Pa]
        bool bonded = false;                                  ///< breaks by energy
        bool together = false;                                ///< c is lost of the whole line at once
        double increase = 1.0;                                ///< of its bond in motion, Bond::dynamic_increase [-]
        /// @param felt  u + b_K v
        double index(const CrackLines& of, const Eigen::VectorXd& felt, bool moving, double& distance) const;
    };
    struct Patch {
        Row stress;
        Point at;
        bool on_face = false;
        bool seeds = true; ///< no crack has begun next to it
    };
    struct Tension {
        double stress = 0.0, angle = 0.0;
    };
    struct Block {
        double x[3], y[3]; ///< two or three rows, by the displacement of a node in x and in y
    };
    void add_line(const Scene& scene, const ContactStructure& structure, const LiftJoint& lift,
                  const std::vector<int>& nodes);
    void add_patches(const Scene& scene, const ContactStructure& structure, const std::vector<CrackStart>& begun);
    void add_paths(const Scene& scene, const ContactStructure& structure);
    double crack_length(const Scene& scene, const ContactStructure& structure) const;
    Patch patch_about(const ContactStructure& structure, const std::vector<int>& elements, Point at);
    Tension tension_of(const Patch& patch, const Eigen::VectorXd& u) const;

    std::vector<int> node_;   ///< first unknown of a node
    std::vector<Block> block_;
    std::vector<Line> lines_;
    std::vector<Patch> patches_; ///< those on the faces first
    std::vector<std::vector<Patch>> paths_; ///< about the pairs of the traced cracks
    std::vector<Eigen::Index> first_pair_;         ///< of each of them, among those of the structure
    std::size_t on_face_ = 0;
    CrackFigures none_yet_;
    double stiffness_damping_;
};

/// Follows one run. Lines near their strength and patches on the faces are looked at in every step; all lines every 4th step;
/// all patches every 16th step, and where those on the faces come to more than ever before.
class CrackWatch {
public:
    explicit CrackWatch(const CrackLines& lines) : lines_(lines), last_(lines.lines_.size(), 1.0) {}
    /// @param damage  of all pairs' bonds; null: there are none
    void look(double time, const Eigen::VectorXd& u, const Eigen::VectorXd& v, const Eigen::VectorXd* damage,
              CrackFigures& figures);

private:
    static bool take(const CrackLines::Tension& now, double time, PathTension& largest);
    void look_at_paths(double time, const Eigen::VectorXd& u, const Eigen::VectorXd* damage, CrackFigures& figures);
    void look_at(const CrackLines::Patch& patch, double time, const Eigen::VectorXd& u, CrackFigures& figures) const;

    const CrackLines& lines_;
    std::vector<double> last_; ///< index of each line when it was looked at
    Eigen::VectorXd felt_;     ///< u + b_K v
    std::vector<std::vector<CrackLines::Tension>> before_; ///< of the paths, a step before
    double on_face_ = 0.0;     ///< largest so far [Pa]
    long steps_ = 0;
};

} // namespace damslip::fe2d
