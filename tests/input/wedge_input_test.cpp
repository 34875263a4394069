// Wedges that cannot be.
#include "core/input_error.hpp"
#include "sliding/wedge/wedge.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace damslip;
using namespace damslip::sliding;

Wedge good_wedge()
{
    Wedge w;
    w.mass = 1e5;
    w.first = {0.8, 1.8, 10.0, 0.5, 1e4, 0.0};
    w.second = {1.2, 4.1, 10.0, 0.5, 1e4, 0.0};
    return w;
}

TEST(WedgeInput, WhatCannotBeIsRefused)
{
    EXPECT_NO_THROW(wedge_state(good_wedge()));
    const auto refused = [](auto&& change) {
        Wedge w = good_wedge();
        change(w);
        EXPECT_THROW(wedge_state(w), InputError);
    };
    refused([](Wedge& w) { w.mass = 0.0; });
    refused([](Wedge& w) { w.mass = std::nan(""); });
    refused([](Wedge& w) { w.first.dip = 1.6; });
    refused([](Wedge& w) { w.first.dip = -0.1; });
    refused([](Wedge& w) { w.second.friction = -0.1; });
    refused([](Wedge& w) { w.second.cohesion = std::nan(""); });
    refused([](Wedge& w) { w.first.water_force = -1.0; });
    refused([](Wedge& w) { w.second = w.first; }); // parallel
}

TEST(WedgeInput, NoYieldIsInfinite)
{
    Wedge w = good_wedge();
    w.first.cohesion = w.second.cohesion = 1e9;
    EXPECT_TRUE(std::isinf(wedge_yield(w, {1.0, 0.0, 0.0}).acceleration));
    GroundMotion motion;
    motion.dt = 0.01;
    motion.accel_h = {0.0, 50.0, 0.0};
    EXPECT_EQ(slide_wedge(motion, wedge_yield(w, {1.0, 0.0, 0.0})).slip, 0.0);
}

} // namespace
