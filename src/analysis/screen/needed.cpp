#include "analysis/screen/screening.hpp"

#include "core/parallel.hpp"
#include "core/status.hpp"
#include "scene/scene_text.hpp"
#include "sliding/block/slide_batch.hpp"

#include <cmath>
#include <limits>

namespace damslip {

namespace {

constexpr int looked_at = 33;             ///< frictions between the one that stands and the highest
constexpr double settled_friction = 1e-7; ///< of the bisection [-]

/// The rigid block with one friction after the other.
class Slips {
public:
    Slips(const Ready& ready, const sliding::SkippingMotion& motion, int polarity)
        : ready_(ready), statics_(ready.statics ? *ready.statics : own_), motion_(motion), polarity_(polarity),
          scene_(ready.scene)
    {
    }

    /// Largest slip with that friction [m]; without an end or without an answer: infinite.
    double largest(double friction)
    {
        scene_.contact = ready_.scene.contact; // a residual value that a lower friction has taken down comes back
        scene_.wedge = ready_.scene.wedge;
        set_friction(scene_, friction);
        const RigidModel model = make_rigid_model(scene_, ready_.seepage->profile_of(scene_), std::nullopt, &statics_);
        const sliding::SlideResult slide = slide_model(scene_, model, motion_, polarity_);
        return slide.status == Status::at_rest || slide.status == Status::rocks_first
                   ? slide.max_slip
                   : std::numeric_limits<double>::infinity();
    }

private:
    const Ready& ready_;
    KeptStatics own_;
    KeptStatics& statics_;
    const sliding::SkippingMotion& motion_;
    int polarity_;
    Scene scene_;
};

/// A friction and by how much the block slips more than it may with it [m].
struct Tried {
    double friction = 0.0;
    double excess = 0.0;
};

/// Says of the frictions between one that slips too far and one that does not on which side of the crossing they lie. A
/// secant says where that is; a friction close to it, on the side asked for, then settles all that lie beyond.
class Crossing {
public:
    Crossing(Slips& slips, double allowed, const Tried& more, const Tried& less)
        : slips_(slips), allowed_(allowed), more_(more), less_(less)
    {
    }

    bool slips_more(double friction)
    {
        if (!settled(friction)) try_near_crossing(friction);
        if (!settled(friction)) try_at(friction);
        return friction <= more_.friction;
    }

private:
    bool settled(double friction) const { return friction <= more_.friction || friction >= less_.friction; }

    void try_at(double friction)
    {
        const Tried tried{friction, slips_.largest(friction) - allowed_};
        (tried.excess > 0.0 ? more_ : less_) = tried;
    }
    void try_near_crossing(double friction)
    {
        constexpr double off = 0.02; // of the way from the crossing to the friction
        const double share = more_.excess / (more_.excess - less_.excess);
        if (!std::isfinite(more_.excess) || !(share < 1.0)) return;
        const double crossing = more_.friction + share * (less_.friction - more_.friction);
        const double near = crossing + off * (friction - crossing);
        if (near > more_.friction && near < less_.friction) try_at(near);
    }

    Slips& slips_;
    double allowed_;
    Tried more_, less_;
};

/// The first sample of the largest acceleration that drives it downstream.
void find_peak(const GroundMotion& motion, NeededRow& row)
{
    for (std::size_t k = 0; k < motion.accel_h.size(); ++k) {
        const double drive = row.polarity * motion.accel_h[k];
        if (drive <= row.peak) continue;
        row.peak = drive;
        row.peak_time = motion.dt * static_cast<double>(k);
    }
}

/// Least friction from which on the rigid block's largest slip stays at or below `slip`: all frictions above it that were
/// looked at do. Looked at 33 values between the friction that stands and `highest_friction`, the last crossing by bisection
/// to 1e-7. A slip without an end (runs away, still sliding) is more than any. @returns nothing where even the highest slips more
/// @param slip  largest slip allowed [m], >= 0
std::optional<double> friction_for_slip(const Ready& ready, const sliding::SkippingMotion& motion, int polarity,
                                        double slip)
{
    Slips slips(ready, motion, polarity);
    const auto tried = [&](double friction) { return Tried{friction, slips.largest(friction) - slip}; };
    const double stands = std::max(0.0, ready.rigid_model().critical_friction);
    if (!(stands < highest_friction)) return std::nullopt;
    Tried less = tried(highest_friction);
    if (less.excess > 0.0) return std::nullopt;
    Tried more{stands, std::numeric_limits<double>::infinity()};
    for (int i = looked_at - 1; i >= 0; --i) {
        const Tried here = tried(stands + (highest_friction - stands) * i / looked_at);
        if (here.excess > 0.0) {
            more = here;
            break;
        }
        less = here;
    }
    Crossing crossing(slips, slip, more, less);
    double slides = more.friction, holds = less.friction;
    while (holds - slides > settled_friction) {
        const double middle = 0.5 * (slides + holds);
        (crossing.slips_more(middle) ? slides : holds) = middle;
    }
    return holds;
}

} // namespace

std::vector<NeededRow> needed_rows(const Ready& ready, int jobs)
{
    const Scene& scene = ready.scene;
    if (!scene.criteria.allowable_slip || scene.wedge || !scene.contact.friction_table.empty()) return {};
    const double allowable = *scene.criteria.allowable_slip;
    std::vector<NeededRow> rows;
    std::vector<sliding::SkippingMotion> motions, horizontal;
    for (const RecordPair& pair : ready.records()) {
        motions.emplace_back(ready.motion(pair));
        horizontal.emplace_back(horizontal_only(motions.back().motion()));
        for (const int polarity : {1, -1}) {
            NeededRow& row = rows.emplace_back();
            row.record = motions.back().motion().name;
            row.polarity = polarity;
        }
    }
    parallel_for(rows.size(), jobs, [&](std::size_t i) {
        NeededRow& row = rows[i];
        find_peak(motions[i / 2].motion(), row);
        row.yield = sliding::yield_for_slip(horizontal[i / 2], allowable, row.polarity);
        row.friction = friction_for_slip(ready, motions[i / 2], row.polarity, allowable);
    });
    return rows;
}

} // namespace damslip
