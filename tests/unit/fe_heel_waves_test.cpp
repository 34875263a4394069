// Pressure of the reservoir's waves at the heel by added mass: of a rigid wall that the ground moves, and of one that moves on ground at rest.
#include "fe2d/run/base_water.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "fe_scenes.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

// A vertical upstream face: the water is moved by the ground's acceleration with the sign of the wall's, added mass times acceleration, whichever of
// both it is. Vertical motion moves none of it. Without an added mass there are no waves.
TEST(FeHeelWaves, AddedMassTimesTheAccelerationOfTheHeel)
{
    Scene scene = fe2d::test::reference_dam();
    scene.mesh.size = scene.mesh.contact_size = 15.0;
    scene.reservoir = Reservoir{.level = 60.0};
    scene.uplift = Uplift{};
    constexpr double mass = 52.5e3; // [kg/m^2]
    RunOptions options = fe2d::test::options_of(scene);
    options.added_mass = [](Point, double) { return mass; };
    const EarthquakeRun run(scene, options);
    const ContactStructure& structure = run.structure();
    const HeelWaves waves(scene, structure, nullptr, options.added_mass);
    DynamicState state;
    const Eigen::Index unknowns = structure.mass().rows();
    state.u = state.v = state.a = Eigen::VectorXd::Zero(unknowns);
    EXPECT_EQ(waves.pressure(state), 0.0);
    state.ground = {1.5, 0.0};
    const double by_ground = waves.pressure(state);
    EXPECT_NEAR(std::abs(by_ground), 1.5 * mass, 1e-9 * mass);
    state.ground = {0.0, 2.0};
    EXPECT_NEAR(waves.pressure(state), 0.0, 1e-9 * mass);
    // Ground at rest, and the wall itself so accelerated: the total acceleration is what counts.
    state.ground = {0.0, 0.0};
    state.a.setZero();
    for (Eigen::Index i = 0; i < unknowns; i += 2) state.a[i] = -1.5;
    EXPECT_NEAR(waves.pressure(state), by_ground, 1e-9 * mass);
    EXPECT_EQ(HeelWaves(scene, structure, nullptr, {}).pressure(state), 0.0);
}

} // namespace
