#include "sliding/block/base_equations.hpp"

#include "core/input_error.hpp"
#include "core/text.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace damslip::sliding {
namespace {

void require(bool holds, std::vector<Diagnostic>& found, const char* what, double value, const char* expected,
             const char* fix)
{
    if (holds) return;
    Diagnostic diagnostic;
    diagnostic.problem = std::string("rigid block: ") + what + " = " + shortest(value) + " is not allowed.";
    diagnostic.expected = expected;
    diagnostic.fix = fix;
    found.push_back(diagnostic);
}

void check_sliding_mass(const BaseEquations& equations, double friction, SlipDirection direction,
                        std::vector<Diagnostic>& found)
{
    const double mass = sliding_mass(equations, friction, direction);
    require(
        mass > 0.0, found,
        direction == SlipDirection::downstream ? "mass felt by downstream sliding, m + M_w k cos(theta)"
                                               : "mass felt by upstream sliding, m + M_w k cos(theta)",
        mass,
        "more than 0 kg/m; otherwise friction and added mass jam the block and rigid-body motion has no unique answer",
        "use a flatter base, less friction or less added mass");
}

} // namespace

BaseEquations base_equations(const RigidBlock& block)
{
    const double c = std::cos(block.base_inclination);
    const double s = std::sin(block.base_inclination);
    const double weight = block.mass * block.gravity + block.vertical_force;
    const AddedMassTensor& w = block.added_mass;

    // Products with A = m I + M^w: columns A x and A y first, then their components along t and n.
    const double Axx = block.mass + w.xx, Axy = w.xy, Ayy = block.mass + w.yy;
    const double tAx = c * Axx - s * Axy, tAy = c * Axy - s * Ayy;
    const double nAx = s * Axx + c * Axy, nAy = s * Axy + c * Ayy;

    BaseEquations e;
    e.drive = {c * block.horizontal_force + s * weight, tAx, -tAy};
    e.normal = {c * weight - s * block.horizontal_force - block.uplift, -nAx, nAy};
    // t.t = 1, t.n = 0 and n.n = 1 are put in by hand: the block's own mass leaves no round-off in the products.
    e.mass_tt = block.mass + c * c * w.xx - 2.0 * c * s * w.xy + s * s * w.yy;
    e.mass_tn = c * s * (w.xx - w.yy) + (c * c - s * s) * w.xy;
    e.mass_nn = block.mass + s * s * w.xx + 2.0 * c * s * w.xy + c * c * w.yy;
    return e;
}

double sliding_mass(const BaseEquations& equations, double friction, SlipDirection direction)
{
    return equations.mass_tt + sign(direction) * friction * equations.mass_tn;
}

GroundLinear excess_drive(const BaseEquations& e, const RigidBlock& block, SlipDirection direction)
{
    const double d = sign(direction);
    return {d * e.drive.constant - block.cohesion_force - block.dowel_force - block.friction * e.normal.constant,
            d * e.drive.per_a_h - block.friction * e.normal.per_a_h,
            d * e.drive.per_a_v - block.friction * e.normal.per_a_v};
}

GroundLinear free_normal_force(const BaseEquations& e)
{
    const double ratio = e.mass_tn / e.mass_tt;
    return {e.normal.constant + ratio * e.drive.constant, e.normal.per_a_h + ratio * e.drive.per_a_h,
            e.normal.per_a_v + ratio * e.drive.per_a_v};
}

void check_block(const RigidBlock& b)
{
    std::vector<Diagnostic> found;
    const AddedMassTensor& w = b.added_mass;
    require(std::isfinite(b.mass) && b.mass > 0.0, found, "mass", b.mass, "more than 0 kg/m",
            "check section and density");
    require(std::isfinite(b.friction) && b.friction >= 0.0, found, "friction", b.friction, "a number >= 0",
            "check contact.friction");
    require(std::isfinite(b.cohesion_force) && b.cohesion_force >= 0.0, found, "cohesion force", b.cohesion_force,
            ">= 0 N/m", "check contact.cohesion");
    require(std::isfinite(b.dowel_force) && b.dowel_force >= 0.0, found, "dowel force", b.dowel_force, ">= 0 N/m",
            "check the anchors");
    require(std::isfinite(b.gravity) && b.gravity > 0.0, found, "gravity", b.gravity, "more than 0 m/s^2",
            "check site.gravity");
    require(std::abs(b.base_inclination) < 0.5 * std::numbers::pi, found, "base inclination in rad", b.base_inclination,
            "between -90 and 90 degrees", "check the base of the section");
    require(std::isfinite(w.xx) && w.xx >= 0.0, found, "added mass xx", w.xx, ">= 0 kg/m", "check the reservoir");
    require(std::isfinite(w.yy) && w.yy >= 0.0, found, "added mass yy", w.yy, ">= 0 kg/m", "check the reservoir");
    require(std::isfinite(w.xy) && w.xy * w.xy <= w.xx * w.yy * (1.0 + 1e-12), found, "added mass xy", w.xy,
            "xy^2 <= xx yy: a sum of m n n^T", "check the reservoir");
    for (const double force : {b.vertical_force, b.horizontal_force, b.uplift})
        require(std::isfinite(force), found, "a static force", force, "a finite force in N/m", "check the loads");
    if (found.empty()) {
        const BaseEquations equations = base_equations(b);
        check_sliding_mass(equations, b.friction, SlipDirection::downstream, found);
        check_sliding_mass(equations, b.friction, SlipDirection::upstream, found);
    }
    if (!found.empty()) throw InputError(std::move(found));
}

} // namespace damslip::sliding
