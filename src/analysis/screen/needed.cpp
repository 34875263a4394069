#include "analysis/screen/needed.hpp"

#include "analysis/prepare/rigid_model.hpp"
#include "core/parallel.hpp"
#include "core/status.hpp"
#include "scene/with_friction.hpp"
#include "sliding/block/yield_for_slip.hpp"

#include <cmath>
#include <limits>

namespace damslip {

namespace {

constexpr int looked_at = 33;             ///< frictions between the one that stands and the highest
constexpr double settled_friction = 1e-7; ///< of the bisection [-]

/// Largest slip of the rigid block with that friction [m]; without an end or without an answer: infinite.
double largest_slip(const Ready& ready, KeptStatics& statics, const sliding::SkippingMotion& motion, int polarity,
                    double friction)
{
    const Scene scene = with_friction(ready.scene, friction);
    const RigidModel model = make_rigid_model(scene, ready.seepage->profile_of(scene), std::nullopt, &statics);
    const sliding::SlideResult slide = slide_model(scene, model, motion, polarity);
    return slide.status == Status::at_rest || slide.status == Status::rocks_first
               ? slide.max_slip
               : std::numeric_limits<double>::infinity();
}

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

} // namespace

std::optional<double> friction_for_slip(const Ready& ready, const sliding::SkippingMotion& motion, int polarity,
                                        double slip)
{
    KeptStatics own;
    KeptStatics& statics = ready.statics ? *ready.statics : own;
    const auto slips_more = [&](double friction) {
        return largest_slip(ready, statics, motion, polarity, friction) > slip;
    };
    const double stands = std::max(0.0, ready.rigid_model().critical_friction);
    if (!(stands < highest_friction) || slips_more(highest_friction)) return std::nullopt;
    double more = stands, less = highest_friction;
    for (int i = looked_at - 1; i >= 0; --i) {
        const double friction = stands + (highest_friction - stands) * i / looked_at;
        if (!slips_more(friction)) {
            less = friction;
            continue;
        }
        more = friction;
        break;
    }
    while (less - more > settled_friction) {
        const double middle = 0.5 * (more + less);
        (slips_more(middle) ? more : less) = middle;
    }
    return less;
}

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
