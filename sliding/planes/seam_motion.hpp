#pragma once

#include "sliding/block/slide.hpp"
#include "sliding/block/yield.hpp"
#include "sliding/planes/chain.hpp"

#include <vector>

/// A body on its seam that slides both ways: downstream it pushes the wedge, upstream it leaves the wedge where it is, and meets it
/// again with a plastic impact.
namespace damslip::sliding {

/// Strengths and water from one accumulated slip on; two stages of one slip: the second holds from the first movement on.
struct SeamStage {
    double from_slip = 0.0; ///< [m]
    Chain chain;            ///< body and wedge; of one block: there is no wedge
    Chain body;             ///< the body alone, the gap before it open: one block
};

/// Work on the bodies relative to the ground [J/m]; all of it is their kinetic energy and what impacts took.
struct SeamLedger {
    double ground = 0.0;            ///< of the ground's motion, by inertia, added mass included
    double weight = 0.0, loads = 0.0; ///< of weights; of static forces, water on the faces among them
    double water = 0.0;             ///< of the uplift and of the water between the blocks
    std::vector<double> planes;     ///< of N, μ N + c L of each block's segment, below 0
    std::vector<double> interfaces; ///< of E and X of each interface, at most 0
    double impact = 0.0;            ///< kinetic energy that impacts took
    double kinetic = 0.0;           ///< at the end
    double largest = 0.0;           ///< kinetic energy on the way

    double work() const;                                                 ///< the sum of all works
    double error() const { return work() - impact - kinetic; }           ///< round-off
};

enum class SeamWorks { booked, left_out };

struct SeamSlide {
    SlideResult slide; ///< of the body; impact_loss is that of the ledger, max_gap the widest gap before the wedge
    int impacts = 0;
    SeamLedger ledger;
    double least_pressure = 0.0; ///< least N or E while it slides [N/m]; below 0: a block floats or an interface opens
};

/// Upstream yield of the body alone, |s''| = factor (-a_h - a_y). @pre one block
Yield yield_upstream_alone(const Chain& body);

/// Exact between events as slide(): start, stop, stages, and the closing of the gap are roots of polynomials in time. After an
/// impact the rate is M*_body/M*_chain of that before. Scheme and lift-off of the options are not used, no histories.
/// @param stages  at least one @param options  two_way: upstream, too
/// @param works  left out: of the ledger what impacts took alone, and no least pressure; the slide is the same
SeamSlide slide_seam(const SkippingMotion& motion, const std::vector<SeamStage>& stages, const SlideOptions& options,
                     SeamWorks works = SeamWorks::booked);
SeamSlide slide_seam(const GroundMotion& motion, const std::vector<SeamStage>& stages, const SlideOptions& options,
                     SeamWorks works = SeamWorks::booked);

} // namespace damslip::sliding
