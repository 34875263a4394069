// Opening water under the rigid block (D8, A14, D7): the slip does not depend on where the record has samples.
#include "analysis/prepare/rigid_model.hpp"
#include "sliding/flexible/flexible_mode.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace damslip;

/// A triangular dam under water, its crack filled by a rule.
Scene wet_dam(OpeningWater opening, double friction)
{
    Scene scene;
    scene.section = {{{0, 0}, {15, 0}, {2, 20}, {0, 20}}};
    scene.dam.density = 2400.0;
    scene.contact.friction = friction;
    scene.reservoir.emplace();
    scene.reservoir->level = 16.7;
    scene.reservoir->model = ReservoirModel::added_mass;
    scene.uplift.emplace().model = UpliftModel::linear;
    scene.uplift->water.opening = opening;
    if (opening == OpeningWater::mouth) scene.uplift->water.mouth_speed = 3.0;
    return scene;
}

/// Bursts of 3 s in both components, samples on straight lines between 150 knots.
GroundMotion bursts(int parts)
{
    constexpr int knots = 150;
    const auto value = [](int k, double peak, double hertz, double phase) {
        const double t = 0.02 * k;
        return peak * std::sin(3.14159265358979 * t / 3.0) * std::sin(2 * 3.14159265358979 * hertz * t + phase);
    };
    GroundMotion motion;
    motion.dt = 0.02 / parts;
    for (int k = 0; k < knots; ++k)
        for (int i = 0; i < parts; ++i) {
            const double x = static_cast<double>(i) / parts;
            motion.accel_h.push_back((1 - x) * value(k, 5.5, 1.7, 0.3) + x * value(k + 1, 5.5, 1.7, 0.3));
            motion.accel_v.push_back((1 - x) * value(k, 2.4, 4.1, 0.0) + x * value(k + 1, 2.4, 4.1, 0.0));
        }
    motion.accel_h.push_back(value(knots, 5.5, 1.7, 0.3));
    motion.accel_v.push_back(value(knots, 2.4, 4.1, 0.0));
    return motion;
}

double largest_slip(const Scene& scene, const GroundMotion& motion, int polarity = 1)
{
    return sliding::slide(motion, make_rigid_model(scene, {}).stages, {scene.sliding, polarity}).max_slip;
}

TEST(Audit3, D8_OpeningWaterDoesNotKnowTheSamples)
{
    for (const OpeningWater opening : {OpeningWater::zero, OpeningWater::full})
        for (const int polarity : {1, -1}) {
            const Scene scene = wet_dam(opening, 0.95);
            const double own = largest_slip(scene, bursts(1), polarity);
            EXPECT_GT(own, 1e-4);
            for (const int parts : {2, 5})
                EXPECT_NEAR(largest_slip(scene, bursts(parts), polarity), own, 1e-9 * own) << parts;
        }
}

TEST(Audit3, A14_WaterOnItsWayDoesNotKnowTheSamples)
{
    for (const double lag : {0.0, 0.05}) {
        Scene scene = wet_dam(OpeningWater::mouth, 0.95);
        if (lag > 0.0) scene.contact.rate = {0.9, 0.05, lag, {}};
        const double own = largest_slip(scene, bursts(1));
        EXPECT_GT(own, 1e-4);
        for (const int parts : {2, 16}) EXPECT_NEAR(largest_slip(scene, bursts(parts)), own, 1e-6 * own) << parts;
    }
}

TEST(Audit3, A14_WaterOnItsWayStatesAnError)
{
    const Scene scene = wet_dam(OpeningWater::mouth, 0.95);
    const sliding::SlideResult r = sliding::slide(bursts(1), make_rigid_model(scene, {}).stages);
    EXPECT_GT(r.slip_error, 0.0);
    EXPECT_LT(r.slip_error, 0.02 * r.max_slip);
    const Scene full = wet_dam(OpeningWater::full, 0.95);
    EXPECT_EQ(sliding::slide(bursts(1), make_rigid_model(full, {}).stages).slip_error, 0.0);
}

/// It took 14 to 46 s, for the block at rest was followed in pieces of its vibration.
TEST(Audit3, D7_AFlexibleBlockOnWaterOnItsWayIsQuick)
{
    for (const OpeningWater opening : {OpeningWater::full, OpeningWater::mouth}) {
        const Scene scene = wet_dam(opening, 0.95);
        const auto start = std::chrono::steady_clock::now();
        const sliding::FlexibleSlide r =
            sliding::slide_decoupled(bursts(1), make_rigid_model(scene, {}).stages, {.period = 0.1}, {});
        EXPECT_GT(r.slide.max_slip, 1e-4);
        EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 4.0);
    }
}

} // namespace
