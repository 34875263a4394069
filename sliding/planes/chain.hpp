#pragma once

#include "core/geometry.hpp"
#include "sliding/block/rigid_block.hpp"

#include <limits>
#include <numbers>
#include <vector>

/// A sliding plane that is a polyline: a chain of rigid blocks, one on each segment, which slide together. Virtual weights
/// remove the normal forces, so that yield, factor of safety and motion are those of one block with other numbers. -D/H is
/// Sarma's critical acceleration (Sarma 1979) and the upper bound of Donald & Chen (1997) in one.
///
/// Signs as for one block: x downstream, y up; segment i has t = (cos θ, -sin θ), n = (sin θ, cos θ), θ positive where it
/// dips downstream. Interface j lies between block j and block j + 1.
namespace damslip::sliding {

inline double dot(Point a, Point b)
{
    return a.x * b.x + a.y * b.y;
}

/// One block on its segment.
struct ChainBlock {
    double dip = 0.0;           ///< θ [rad]
    double length = 0.0;        ///< L of the segment [m]
    double mass = 0.0;          ///< m [kg/m]
    AddedMassTensor added_mass; ///< M^w of water that moves with it [kg/m]
    Point force;                ///< static, without its weight and without uplift [N/m]
    double uplift = 0.0;        ///< U of the water on the segment [N/m]
    double friction = 0.0;      ///< μ [-]
    double cohesion = 0.0;      ///< c [Pa]
    double dilation = 0.0;      ///< ψ, at most the friction angle [rad]
};

/// The face between a block and the next.
struct ChainInterface {
    double angle = 0.5 * std::numbers::pi; ///< of its way up, from the downstream horizontal [rad]; π/2: vertical
    double length = 0.0;                   ///< d [m]
    double friction = 0.0;                 ///< 0 with cohesion 0: smooth [-]
    double cohesion = 0.0;                 ///< [Pa]
    double dilation = 0.0;                 ///< ψ [rad]
    double water = 0.0;                    ///< force of the water in it, normal to it [N/m]
};

struct Chain {
    std::vector<ChainBlock> blocks;         ///< from upstream to downstream, at least one
    std::vector<ChainInterface> interfaces; ///< one less
    double gravity = 9.81;                  ///< in weights [m/s^2]
    std::size_t dam = 0;                    ///< the block whose slip is s
};

/// The chain as one equation, M* s'' = H a_h + D + D_v a_v, scaled so that the weight of the dam's block is t + μ n.
struct ChainEquation {
    double drive = 0.0;                    ///< H [kg/m]; not above 0, or locked: no acceleration makes it slide
    double mass = 0.0;                     ///< M* [kg/m]
    double constant = 0.0, per_a_v = 0.0;  ///< D [N/m], D_v [kg/m]
    bool locked = false;                   ///< a block is wedged in: α + φ + δ >= 90° at an interface

    /// Yield acceleration at a vertical acceleration [m/s^2]; infinite where locked.
    double yield(double a_v = 0.0) const
    {
        return locked || !(drive > 0.0) ? std::numeric_limits<double>::infinity() : -(constant + per_a_v * a_v) / drive;
    }
    /// H/M*: acceleration of the slip over that of the ground above the yield [-].
    double factor() const { return locked ? 0.0 : drive / mass; }
};

/// With what it was made of.
struct ChainLaw : ChainEquation {
    std::vector<Point> weights;            ///< w of each block, scaled [-]
    std::vector<double> rates;             ///< q, speed over its segment over that of the dam's block [-]
    std::vector<int> senses;               ///< σ of each interface: 1 where the downstream side rises against it, -1, 0

    struct BlockDirections {
        Point along, normal, movement; ///< t, n, and t turned up by the dilation
    };
    struct FaceDirections {
        Point up, downstream; ///< e, ν
    };
    std::vector<BlockDirections> of_blocks;
    std::vector<FaceDirections> of_faces;
    bool path_locked = false; ///< whatever the strengths: dilation lets a block go nowhere
};

/// @param over  F, which all strengths are divided by, those of interfaces too [-]
ChainLaw chain_law(const Chain& chain, double over = 1.0);
/// The same in the memory of another law.
void set_law(const Chain& chain, double over, ChainLaw& law);

/// Makes `law` that of the same chain with other strengths: directions, rates and senses stay, dilation must be as it was.
void set_strengths(const Chain& chain, double over, ChainLaw& law);

/// The yield that the chain would have with the strengths of another one, as long and with the same dilation.
/// @param law  of the chain @param weights  memory
double yield_with(const Chain& strengths, const Chain& chain, const ChainLaw& law, std::vector<Point>& weights);

/// What acts between the blocks and on their segments.
struct ChainForces {
    std::vector<double> normal;      ///< N of each block, effective [N/m]; below 0: it floats
    std::vector<double> resistance;  ///< R = c L + μ N [N/m]
    std::vector<double> thrust;      ///< E of each interface, effective [N/m]; below 0: it opens
    std::vector<double> shear;       ///< X of each interface, with its sign [N/m]
    bool stands() const;             ///< no N and no E below 0
};

/// @param law  of the chain and of the same `over`
/// @param a_h, a_v  ground acceleration [m/s^2]; @param slip_accel  s'' [m/s^2]; 0 at the yield
ChainForces chain_forces(const Chain& chain, const ChainLaw& law, double a_h, double a_v, double slip_accel = 0.0,
                         double over = 1.0);

enum class ChainStatus {
    stands,
    locked, ///< no acceleration moves it: its strengths wedge the blocks in
    floats, ///< a block would have to pull on its segment
    opens   ///< an interface would have to pull: what is upstream of it stays behind
};
/// @param over  F, as of `law`
ChainStatus chain_status(const Chain& chain, const ChainLaw& law, double a_h, double a_v, double over = 1.0);
const char* word(ChainStatus status);

/// Factor of safety: the largest F with yield(F) = a_h, one F on all strengths. With smooth interfaces the wedge method of
/// USACE EM 1110-2-2200 and of CADAM3D, with friction in them Sarma's (1979).
/// @returns infinite where no F, however large, lets it slide; 0 where it cannot be held
double chain_factor(const Chain& chain, double a_h = 0.0, double a_v = 0.0);

/// Power of each resistance at the state `forces` over their sum [-]: that of the segments, then that of the interfaces.
std::vector<double> resistance_shares(const Chain& chain, const ChainLaw& law, const ChainForces& forces);

/// The block that moves as the chain does in downstream direction: level, M = H, chain_mass = M* - H, friction D_v/H and a
/// horizontal force that gives the yield. Its N' is no force of the chain; it never lifts off above a_v = -g. For a locked chain
/// a block that 1e9 g do not move.
RigidBlock chain_block(const Chain& chain, const ChainLaw& law);

/// Growth of the yield acceleration over the slip while rock crosses the interfaces [1/s^2]; level and smooth
/// κ = ρ g d [tan(φ + α) - μ]/Σm.
/// @param density  of the rock [kg/m^3]
double yield_growth(const Chain& chain, double density);

/// Chains as long as each other, a seam with its wedge at many angles: their yields side by side, with the bits of ChainLaw::yield().
class YieldScan {
public:
    /// @param law  of the chain
    void add(const Chain& chain, const ChainLaw& law);

    /// Of each chain with the strengths of another one, as long and with the same dilation; infinite where locked [m/s^2].
    std::vector<double> yields(const Chain& strengths) const;

private:
    struct Points {
        std::vector<double> x, y;
        void add(Point p) { x.push_back(p.x), y.push_back(p.y); }
    };
    struct Block {
        Points along, normal, inertia, load; ///< t, n, A (1, 0), F + W + U n
        std::vector<double> length;
    };
    struct Face {
        Points up, downstream, water; ///< e, ν, U ν
        std::vector<double> sense, length;
    };
    std::vector<Block> blocks_;
    std::vector<Face> faces_;
    std::vector<double> open_; ///< of each chain: 1, or 0 where dilation locks it
    std::size_t dam_ = 0;
};

} // namespace damslip::sliding
