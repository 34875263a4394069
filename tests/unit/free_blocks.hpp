#pragma once

#include "records/record.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/planes/chain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

/// The blocks of a chain as free bodies on stiff springs that cannot pull, integrated by small explicit steps: equilibrium of each
/// block by itself, with Coulomb's friction on each contact. There is no chain law, no rate that blocks share, and no rule for impacts:
/// dashpots beside the springs make them plastic.
namespace damslip {

struct FreeBlocks {
    double slip = 0.0, max_slip = 0.0; ///< of the dam's block, downstream along its segment [m]
    double max_gap = 0.0;              ///< widest opening of the last interface, normal to it [m]
    int openings = 0;                  ///< times that the last interface opened after it had been shut, by more than 0.1 mm
};

struct FreeBlocksOptions {
    double stiffness = 2e12; ///< of each contact, normal and along it [N/m per m]
    double step = 1e-5;      ///< [s]
    double moved = 0.0;      ///< mass whose weight crosses the last interface per slip while it is shut [kg/m per m]
    double run_out = 6.0;    ///< after the record [s]
};

namespace free_blocks {

/// Spring and dashpot with a slider: normal force, and a force along it that friction limits.
struct Contact {
    Point along, normal; ///< of the body on it
    double friction = 0.0, cohesion = 0.0, stiffness = 0.0, dashpot = 0.0;
    double slid = 0.0; ///< of the slider [m]

    /// Force on the body. @param u, v  of the body over what it lies on
    Point force(Point u, Point v)
    {
        using sliding::dot;
        const double normal_force = std::max(0.0, -stiffness * dot(u, normal) - dashpot * dot(v, normal));
        const double limit = normal_force > 0.0 ? friction * normal_force + cohesion : 0.0;
        double shear = -stiffness * (dot(u, along) - slid) - 0.2 * dashpot * dot(v, along);
        if (std::abs(shear) > limit) {
            shear = std::copysign(limit, shear);
            slid = dot(u, along) + (shear + 0.2 * dashpot * dot(v, along)) / stiffness;
        }
        return {normal_force * normal.x + shear * along.x, normal_force * normal.y + shear * along.y};
    }
};

} // namespace free_blocks

inline FreeBlocks slide_freely(const sliding::Chain& chain, const GroundMotion& motion, const FreeBlocksOptions& options = {})
{
    using free_blocks::Contact;
    using sliding::dot;
    const std::size_t count = chain.blocks.size();
    const auto contact = [&](Point along, Point normal, double friction, double cohesion, double mass) {
        constexpr double over_critical = 1.5;
        return Contact{along, normal, friction, cohesion, options.stiffness,
                       over_critical * 2.0 * std::sqrt(options.stiffness * mass)};
    };
    std::vector<Contact> segments, faces;
    for (const sliding::ChainBlock& b : chain.blocks)
        segments.push_back(contact({std::cos(b.dip), -std::sin(b.dip)}, {std::sin(b.dip), std::cos(b.dip)}, b.friction,
                                   b.cohesion * b.length, b.mass));
    for (std::size_t j = 0; j + 1 < count; ++j) { // of the block downstream on the one upstream
        const sliding::ChainInterface& f = chain.interfaces[j];
        const Point e{std::cos(f.angle), std::sin(f.angle)};
        faces.push_back(contact(e, {e.y, -e.x}, f.friction, f.cohesion * f.length,
                                std::min(chain.blocks[j].mass, chain.blocks[j + 1].mass)));
    }
    std::vector<Point> u(count), v(count), rest(count), force(count);
    FreeBlocks out;
    const double ramp = 2.0, record = static_cast<double>(motion.accel_h.size() - 1) * motion.dt;
    const auto ground = [&](const std::vector<double>& samples, double t) {
        const double place = std::max(t, 0.0) / motion.dt;
        const auto i = static_cast<std::size_t>(place);
        return t < 0.0 || i + 1 >= samples.size() ? 0.0 : samples[i] + (samples[i + 1] - samples[i]) * (place - static_cast<double>(i));
    };
    double crossed = 0.0;
    bool shut = true, open = false;
    const long first = -static_cast<long>(ramp / options.step), end = static_cast<long>((record + options.run_out) / options.step);
    for (long k = first; k < end; ++k) {
        const double t = static_cast<double>(k) * options.step;
        const double loaded = t >= 0.0 ? 1.0 : 0.5 - 0.5 * std::cos(std::numbers::pi * (t + ramp) / ramp);
        const double a_h = ground(motion.accel_h, t), a_v = ground(motion.accel_v, t);
        if (k == 0) rest = u;
        for (std::size_t i = 0; i < count; ++i) {
            const sliding::ChainBlock& b = chain.blocks[i];
            const double lifted = !shut ? 0.0 : i + 1 == count ? crossed : i + 2 == count ? -crossed : 0.0;
            const Point on = segments[i].force(u[i], v[i]), n = segments[i].normal;
            force[i] = {on.x + loaded * (b.force.x + b.uplift * n.x) + b.mass * a_h + b.added_mass.xx * a_h - b.added_mass.xy * a_v,
                        on.y + loaded * (b.force.y + b.uplift * n.y - (b.mass + lifted) * chain.gravity) - (b.mass + lifted) * a_v +
                            b.added_mass.xy * a_h - b.added_mass.yy * a_v};
        }
        for (std::size_t j = 0; j + 1 < count; ++j) {
            const Point f = faces[j].force({u[j + 1].x - u[j].x, u[j + 1].y - u[j].y}, {v[j + 1].x - v[j].x, v[j + 1].y - v[j].y});
            const Point n = faces[j].normal;
            const double water = loaded * chain.interfaces[j].water;
            force[j + 1] = {force[j + 1].x + f.x + water * n.x, force[j + 1].y + f.y + water * n.y};
            force[j] = {force[j].x - f.x - water * n.x, force[j].y - f.y - water * n.y};
        }
        for (std::size_t i = 0; i < count; ++i) {
            const sliding::ChainBlock& b = chain.blocks[i];
            const double xx = b.mass + b.added_mass.xx, yy = b.mass + b.added_mass.yy, xy = b.added_mass.xy, all = xx * yy - xy * xy;
            const double calm = t < 0.0 ? 0.999 : 1.0; // nothing swings when the record begins
            v[i] = {calm * v[i].x + options.step * (yy * force[i].x - xy * force[i].y) / all,
                    calm * v[i].y + options.step * (xx * force[i].y - xy * force[i].x) / all};
            u[i] = {u[i].x + options.step * v[i].x, u[i].y + options.step * v[i].y};
        }
        if (t < 0.0) continue;
        const std::size_t dam = chain.dam;
        out.slip = dot({u[dam].x - rest[dam].x, u[dam].y - rest[dam].y}, segments[dam].along);
        out.max_slip = std::max(out.max_slip, std::abs(out.slip));
        if (count < 2) continue;
        const Point n = faces.back().normal, apart{u[count - 1].x - u[count - 2].x, u[count - 1].y - u[count - 2].y};
        const double gap = dot(apart, n);
        out.max_gap = std::max(out.max_gap, gap);
        if (gap > 1e-4 && !open) ++out.openings;
        open = gap > 0.0 && (open || gap > 1e-4);
        shut = gap <= 0.0;
        if (shut) {
            crossed += options.moved * options.step * std::max(0.0, v[count - 2].x * n.x + v[count - 2].y * n.y);
        }
    }
    return out;
}

} // namespace damslip
