// The block that rocks and slides, on drawn dams with more friction than they need to slide first.
//
// Energy: what ground and loads put in is what friction and landings take and what still moves. The works are integrated
// beside the motion, the kinetic energy is that of the state: an event at a wrong time, a force left out or a landing that
// gains energy shows. 1e-8 of the largest work: a hundred landings at the round-off of 1e-10 each.
//
// Size: a dam L times as large with the same densities and accelerations does the same L times as far in sqrt(L) of the time
// (scaling_test.cpp); its rotation is the same. Steps are chosen by errors in metres, so not the same bits: 1e-7.
#include "drawn_scene.hpp"
#include "sliding/rocking/rocking.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::property;
using namespace damslip::sliding;

RockingBlock block_of(const Scene& scene)
{
    const StaticCase static_case = scene_static_case(scene);
    const BaseState state = base_state(scene, static_case);
    const std::optional<double> level = static_case.loads.reservoir_level;
    return make_rocking_block(scene, state, scene_added_mass(scene, level),
                              strength_stages(make_rigid_block(scene, state, level), scene.contact));
}

Drawn drawn_to_rock(std::uint32_t seed)
{
    Drawn d = draw(seed, Rock::rigid);
    d.scene.contact.friction *= 1.0 + (seed % 4); // some slide first, some rock first
    d.motion = times(d.motion, 1.0 + (seed % 3));
    return d;
}

TEST(Rocking, EnergyIsKept)
{
    int rocked = 0, slid = 0;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        const Drawn d = drawn_to_rock(seed);
        SlideOptions options;
        if (seed % 5 == 0) options.sliding.restitution = 0.2 * (seed % 6);
        const RockingResult r = rock_and_slide(d.motion, block_of(d.scene), options);
        if (!is_answer(r.slide.status)) ADD_FAILURE() << word(r.slide.status) << ": " << text_of(r.slide.notes.front());
        EXPECT_NEAR(r.energy.imbalance, 0.0, 1e-8);
        EXPECT_GE(r.energy.friction, 0.0);
        EXPECT_GE(r.energy.landings, 0.0);
        EXPECT_NEAR(r.slide.slip, r.slide.downstream_slip - r.slide.upstream_slip, 1e-9);
        rocked += r.landings > 0;
        slid += r.slide.slip != 0.0;
    }
    EXPECT_GE(rocked, 15);
    EXPECT_GE(slid, 15);
}

TEST(Rocking, SlipGoesWithTheLength)
{
    int rocked = 0;
    for (std::uint32_t seed = 1; seed <= 30; ++seed) {
        SCOPED_TRACE(seed);
        const Drawn d = drawn_to_rock(seed), larger = scaled(d, 4.0);
        const RockingResult r = rock_and_slide(d.motion, block_of(d.scene)),
                            l = rock_and_slide(larger.motion, block_of(larger.scene));
        ASSERT_EQ(r.slide.status, l.slide.status);
        if (r.slide.status != Status::at_rest) continue;
        EXPECT_NEAR(l.slide.slip, 4.0 * r.slide.slip, 1e-7 * (1.0 + std::abs(r.slide.slip)));
        EXPECT_NEAR(l.max_toe_rotation, r.max_toe_rotation, 1e-8);
        rocked += r.landings > 0;
    }
    EXPECT_GE(rocked, 5);
}

} // namespace
