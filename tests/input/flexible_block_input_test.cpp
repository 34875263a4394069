// Flexible blocks that cannot be, through the library; strength that changes with slip; periods beyond reason.
#include "core/input_error.hpp"
#include "scene/read.hpp"
#include "sliding/flexible/flexible_mode.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace damslip;
using namespace damslip::sliding;

SlipStages soft_block(double friction = 0.1, double inclination = 0.0)
{
    RigidBlock block;
    block.mass = 1.0;
    block.gravity = 10.0;
    block.friction = friction;
    block.base_inclination = inclination;
    return {{0.0, block, 0.0}};
}

GroundMotion soft_motion(double dt = 0.01)
{
    GroundMotion motion;
    motion.dt = dt;
    for (int k = 0; k < 400; ++k) motion.accel_h.push_back(3.0 * std::sin(0.1 * k));
    return motion;
}

std::string flexible_message(const FlexibleBlock& flexible, const SlipStages& stages = soft_block())
{
    try {
        slide_coupled(soft_motion(), stages, flexible);
        slide_decoupled(soft_motion(), stages, flexible);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

TEST(FlexibleBlockInput, RangesAreSaid)
{
    EXPECT_EQ(flexible_message({0.4, 0.05, 0.8}), "(accepted)");
    for (const double period : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        EXPECT_NE(flexible_message({period, 0.05, 0.8}).find("period"), std::string::npos) << period;
    for (const double damping : {-0.01, 0.51, std::nan("")})
        EXPECT_NE(flexible_message({0.4, damping, 0.8}).find("damping ratio"), std::string::npos) << damping;
    for (const double ratio : {0.0, 0.96, std::nan("")})
        EXPECT_NE(flexible_message({0.4, 0.05, ratio}).find("mass ratio"), std::string::npos) << ratio;
}

// mu = 1.5 on 40 degrees: f = cos + mu sin = 1.73, c f = 1.33, Gamma c f = 1.06.
TEST(FlexibleBlockInput, JammedBlockIsRefused)
{
    EXPECT_NE(flexible_message({0.4, 0.05, 0.8}, soft_block(1.5, 0.698)).find("jams a block"), std::string::npos);
    EXPECT_EQ(flexible_message({0.4, 0.05, 0.3}, soft_block(1.5, 0.698)), "(accepted)");
}

// A period far below the sample interval must neither hang nor explode: it is the rigid block.
TEST(FlexibleBlockInput, TinyPeriodEnds)
{
    const double rigid = slide(soft_motion(), soft_block()).slip;
    const FlexibleBlock stiff{1e-6, 0.05, 0.8};
    EXPECT_NEAR(slide_decoupled(soft_motion(), soft_block(), stiff).slide.slip, rigid, 1e-3 * std::abs(rigid));
    EXPECT_TRUE(std::isfinite(slide_coupled(soft_motion(), soft_block(), stiff).slide.slip));
}

TEST(FlexibleBlockInput, StaticSlidingIsSaid)
{
    const FlexibleSlide r = slide_coupled(soft_motion(), soft_block(0.1, 0.2), {0.4, 0.05, 0.8});
    EXPECT_EQ(r.slide.status, Status::static_failure);
    EXPECT_EQ(r.slide.notes.size(), 1u);
}

// Cohesion gone at the first slip: less resistance than with it kept, more slip; the first start is the same.
TEST(FlexibleBlockInput, CohesionIsLostAtFirstSlip)
{
    SlipStages kept = soft_block(0.1);
    kept[0].block.cohesion_force = 0.5;
    SlipStages lost = kept;
    lost.push_back({0.0, soft_block(0.1)[0].block, 0.0});
    const FlexibleBlock block{0.4, 0.05, 0.8};
    const FlexibleSlide a = slide_coupled(soft_motion(), kept, block), b = slide_coupled(soft_motion(), lost, block);
    EXPECT_GT(a.slide.phases, 0);
    EXPECT_DOUBLE_EQ(a.slide.first_slip_time, b.slide.first_slip_time);
    EXPECT_GT(b.slide.downstream_slip, a.slide.downstream_slip);
}

// Turning the record around turns the slip around on a level base.
TEST(FlexibleBlockInput, PolarityMirrors)
{
    SlideOptions other;
    other.polarity = -1;
    const FlexibleBlock block{0.4, 0.05, 0.8};
    EXPECT_EQ(slide_coupled(soft_motion(), soft_block(), block).slide.slip,
              -slide_coupled(soft_motion(), soft_block(), block, other).slide.slip);
}

} // namespace
