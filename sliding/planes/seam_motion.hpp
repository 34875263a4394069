#pragma once

#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/planes/chain.hpp"

#include <vector>

/// A body on its seam that slides both ways: downstream it pushes the wedge, upstream it leaves the wedge where it is, and meets it
/// again with a plastic impact. A wedge that slows down less than the body parts from it and slides on alone;
/// that gap is short and narrow, so the water stays what it was in the shut face.
namespace damslip::sliding {

/// Strengths and water from one accumulated slip on; two stages of one slip: the second holds from the first movement on.
struct SeamStage {
    double from_slip = 0.0; ///< [m]
    Chain chain;            ///< body and wedge; of as many blocks as the body: there is no wedge
    Chain body;             ///< the body alone, once it has moved upstream and the gap is full: the first blocks of the chain
    double growth = 0.0;    ///< κ: of the chain's yield at rest over the slip that body and wedge make together [1/s^2]
    bool parts = true;      ///< the wedge may run ahead of the body
};

/// Work on the bodies relative to the ground [J/m]; all of it is their kinetic energy and what impacts took.
struct SeamLedger {
    double ground = 0.0;            ///< of the ground's motion, by inertia, added mass included
    double weight = 0.0, loads = 0.0; ///< of weights, with κ that of rock which crosses the kink; of static forces, water on the faces among them
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
    std::size_t body_blocks = 1; ///< of the ledger's planes those of the body, which come first
    int impacts = 0;
    int partings = 0;            ///< times that the wedge ran ahead of the body
    SeamLedger ledger;
    double least_pressure = 0.0; ///< least N or E while it slides [N/m]; below 0: a block floats or an interface opens
};

/// Upstream yield of the body alone, |s''| = factor (-a_h - a_y); infinite where it is locked.
Yield yield_upstream_alone(const Chain& body);

/// The body as it slides upstream: friction the other way round, so the equations are those of negative strengths. No block rides
/// down on its dilation.
Chain going_upstream(Chain body);

/// The range of a motion of that polarity.
inline AccelRange turned(const AccelRange& range, int polarity)
{
    return polarity < 0 ? AccelRange{-range.h_max, -range.h_min, range.v_min, range.v_max} : range;
}

/// Does some sample of the motion let the wedge slide without being pushed, or slow down less than the body?
/// @returns false: surely the two never part
bool may_run_ahead(const SkippingMotion& motion, const std::vector<SeamStage>& stages, int polarity);

/// Exact between events as slide(): start, stop, stages, parting, and the closing of the gap are roots in time. The wedge parts
/// where the face between it and the body would have to pull; its friction stops it. An impact is plastic: the rate v of the body and w of the wedge, both as slip of the body, become
/// [M*_body v + (M*_chain - M*_body) w]/M*_chain. Scheme and lift-off of the options are not used, no histories.
/// @param stages  at least one @param options  two_way: upstream, too
/// @param works  left out: of the ledger what impacts took alone, and no least pressure; the slide is the same
SeamSlide slide_seam(const SkippingMotion& motion, const std::vector<SeamStage>& stages, const SlideOptions& options,
                     SeamWorks works = SeamWorks::booked);
SeamSlide slide_seam(const GroundMotion& motion, const std::vector<SeamStage>& stages, const SlideOptions& options,
                     SeamWorks works = SeamWorks::booked);

} // namespace damslip::sliding
