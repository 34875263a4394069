// The rigid block under every law of its joint: what its slip owes to the samples of the record, to the sign of the motion, to
// the scale of lengths, and to the order of tables.
#include "analysis/prepare/rigid_model.hpp"
#include "drawn_scene.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace {

using namespace damslip;
using namespace damslip::property;

/// A law of the joint, for a scene whose lengths are `length` times those drawn.
struct Law {
    std::string name;
    std::function<void(Scene&, double length)> put;
    double tolerance = 1e-9; ///< of the slip: what samples on the same lines may change
    bool by_hand = true;     ///< a symmetric dry block can have it
};

void with_water(Scene& s, OpeningWater opening)
{
    s.uplift->water.opening = opening;
}

std::vector<Law> laws()
{
    std::vector<Law> all;
    all.push_back({"friction alone", [](Scene&, double) {}});
    all.push_back({"cohesion", [](Scene& s, double l) { s.contact.cohesion = 20e3 * l; }});
    all.push_back({"residual friction at a slip", [](Scene& s, double l) {
                       s.contact.residual_friction = 0.9 * s.contact.friction;
                       s.contact.residual_slip = 2e-3 * l;
                   }});
    all.push_back({"residual friction along a line", [](Scene& s, double l) {
                       s.contact.residual_friction = 0.9 * s.contact.friction;
                       s.contact.residual_slip = 5e-3 * l;
                       s.contact.residual_path = Interpolation::linear;
                   }});
    all.push_back({"friction table", [](Scene& s, double l) {
                       const double mu = s.contact.friction;
                       s.contact.friction_table = {{0.0, mu}, {1e-3 * l, 0.95 * mu}, {4e-3 * l, 0.9 * mu}};
                   }});
    all.push_back({"friction over the rate", [](Scene& s, double l) {
                       s.contact.rate.kinetic_ratio = 0.9;
                       s.contact.rate.characteristic_rate = 0.05 * std::sqrt(l);
                   }});
    all.push_back({"friction that lags in time", [](Scene& s, double l) {
                       s.contact.rate.kinetic_ratio = 0.9;
                       s.contact.rate.characteristic_rate = 0.05 * std::sqrt(l);
                       s.contact.rate.relaxation_time = 0.05 * std::sqrt(l);
                   }});
    all.push_back({"friction that lags in slip", [](Scene& s, double l) {
                       s.contact.rate.kinetic_ratio = 0.9;
                       s.contact.rate.characteristic_rate = 0.05 * std::sqrt(l);
                       s.contact.rate.relaxation_slip = 1e-3 * l;
                   }});
    all.push_back({"flight", [](Scene& s, double) { s.sliding.lift_off = LiftOff::ballistic; }});
    all.push_back({"flight and rebound", [](Scene& s, double) {
                       s.sliding.lift_off = LiftOff::ballistic;
                       s.contact.restitution = 0.3;
                   }});
    all.push_back({"one way", [](Scene& s, double) { s.sliding.two_way = false; }, 1e-9, false});
    all.push_back({"anchors", [](Scene& s, double l) {
                       Anchor anchor;
                       anchor.distance = 1.0 * l;
                       anchor.free_length = 5.0 * l;
                       anchor.area = 1e-4 * l;
                       anchor.young_modulus = 200e9 * l;
                       anchor.yield_strength = 400e6 * l;
                       anchor.prestress = 20e3 * l * l;
                       s.anchors = {anchor};
                   }});
    all.push_back({"water: zero", [](Scene& s, double) { with_water(s, OpeningWater::zero); }, 1e-9, false});
    all.push_back({"water: full", [](Scene& s, double) { with_water(s, OpeningWater::full); }, 1e-9, false});
    all.push_back({"water: mouth", [](Scene& s, double l) {
                       with_water(s, OpeningWater::mouth);
                       s.uplift->water.mouth_speed = 5.0 * std::sqrt(l);
                   }, 1e-6, false});
    all.push_back({"water: mouth, friction over the rate", [](Scene& s, double l) {
                       with_water(s, OpeningWater::mouth);
                       s.uplift->water.mouth_speed = 20.0 * std::sqrt(l);
                       s.contact.rate.kinetic_ratio = 0.9;
                       s.contact.rate.characteristic_rate = 0.05 * std::sqrt(l);
                       s.contact.rate.relaxation_time = 0.05 * std::sqrt(l);
                   }, 1e-6, false});
    return all;
}

/// Its numbers and all the rest, without the judgement whether a rigid block is the right model.
sliding::SlideResult slip_of(const Scene& scene, const GroundMotion& motion, int polarity = 1)
{
    const RigidModel model = make_rigid_model(scene, {});
    sliding::SlideOptions options{scene.sliding, polarity, sliding::HistoryOutput::none, model.anchors};
    return sliding::slide(sliding::SkippingMotion(motion), model.stages, options);
}

constexpr std::uint32_t first_seed = 501;
constexpr std::uint32_t seeds = 6;

/// For each law and seed: a drawn scene that stands with it.
void each(const std::function<void(const Law&, const Drawn&)>& check)
{
    for (const Law& law : laws())
        for (std::uint32_t seed = first_seed; seed < first_seed + seeds; ++seed) {
            SCOPED_TRACE(law.name + ", seed " + std::to_string(seed));
            check(law, draw(seed, Rock::rigid));
        }
}

TEST(LawInvariants, SamplesOnTheSameLinesChangeNothing)
{
    int slid = 0;
    each([&](const Law& law, Drawn d) {
        law.put(d.scene, 1.0);
        for (const int polarity : {1, -1}) {
            const sliding::SlideResult own = slip_of(d.scene, d.motion, polarity);
            slid += own.max_slip > 1e-4;
            for (const int parts : {2, 3})
                EXPECT_NEAR(slip_of(d.scene, subdivided(d.motion, parts), polarity).max_slip, own.max_slip,
                            law.tolerance * own.max_slip + 1e-13)
                    << parts << ", polarity " << polarity;
        }
    });
    EXPECT_GE(slid, 40);
}

TEST(LawInvariants, TheMirroredRecordIsTheOtherPolarity)
{
    each([&](const Law& law, Drawn d) {
        law.put(d.scene, 1.0);
        GroundMotion mirrored = d.motion;
        for (double& a : mirrored.accel_h) a = -a;
        EXPECT_EQ(slip_of(d.scene, mirrored, 1).slip, slip_of(d.scene, d.motion, -1).slip);
    });
}

TEST(LawInvariants, ADryLevelBlockSlidesTheMirroredWay)
{
    each([&](const Law& law, Drawn d) {
        if (!law.by_hand || law.name == "anchors") return; // a bar leans one way
        d.scene.reservoir.reset();
        d.scene.tailwater.reset();
        d.scene.uplift.reset();
        d.scene.contact.friction = 0.25;
        law.put(d.scene, 1.0);
        EXPECT_EQ(slip_of(d.scene, d.motion, -1).slip, -slip_of(d.scene, d.motion, 1).slip);
    });
}

TEST(LawInvariants, SlipGoesWithTheLength)
{
    each([&](const Law& law, const Drawn& drawn) {
        Drawn d = drawn, large = scaled(drawn, 4.0);
        law.put(d.scene, 1.0);
        law.put(large.scene, 4.0);
        const sliding::SlideResult own = slip_of(d.scene, d.motion), other = slip_of(large.scene, large.motion);
        EXPECT_NEAR(other.max_slip, 4.0 * own.max_slip, 4.0 * (law.tolerance * own.max_slip + 1e-13));
        EXPECT_NEAR(other.end_time, 2.0 * own.end_time, 1e-6);
        EXPECT_EQ(other.lift_offs, own.lift_offs);
    });
}

TEST(LawInvariants, TheOrderOfAnchorsIsNoMatter)
{
    for (std::uint32_t seed = first_seed; seed < first_seed + seeds; ++seed) {
        SCOPED_TRACE(seed);
        Drawn d = draw(seed, Rock::rigid);
        for (const double share : {1.0, 2.0, 3.0}) {
            Anchor anchor;
            anchor.name = std::to_string(share);
            anchor.distance = 0.2 * share;
            anchor.free_length = 3.0 + share;
            anchor.area = 1e-4;
            anchor.yield_strength = 400e6 / share;
            anchor.prestress = 10e3 * share;
            anchor.inclination = 0.1 * share;
            d.scene.anchors.push_back(anchor);
        }
        const double own = slip_of(d.scene, d.motion).max_slip;
        std::swap(d.scene.anchors[0], d.scene.anchors[2]);
        EXPECT_NEAR(slip_of(d.scene, d.motion).max_slip, own, 1e-10 * own);
    }
}

} // namespace
