#pragma once

#include "core/geometry.hpp"
#include "fe2d/run/contact_structure.hpp"
#include "scene/scene.hpp"

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Where a dam that is computed in one piece would crack.
namespace damslip::fe2d {

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
