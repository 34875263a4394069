// Contact runs on imported meshes: the slip of the program's own mesh, read from a file.
#include "core/file.hpp"
#include "fe2d/gmsh/gmsh.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "fe_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <unistd.h>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

/// Two seconds of a sine that makes the dam slide.
GroundMotion sine_pulses()
{
    GroundMotion motion;
    motion.dt = 0.02;
    for (int i = 0; i <= 100; ++i) motion.accel_h.push_back(4.0 * std::sin(2 * std::numbers::pi * 1.5 * motion.dt * i));
    motion.accel_v.assign(motion.accel_h.size(), 0.0);
    return motion;
}

double contact_slip_of(Scene scene)
{
    RunOptions options;
    scene.time.substeps = 1;
    const RunResult result = EarthquakeRun(scene, options).run(sine_pulses());
    EXPECT_EQ(result.status, Status::at_rest) << text_of(result.notes);
    return result.slip;
}

/// A sixth of the base along the dam's side of it.
Scene coarse_dam()
{
    Scene scene = test::reference_dam_on_rock();
    scene.mesh.size = scene.mesh.contact_size = 7.5;
    scene.curtain.reset();
    scene.reservoir = Reservoir{.level = 55.0, .model = ReservoirModel::hydrostatic};
    scene.contact.friction = 0.7;
    return scene;
}

/// The slip with the scene's own mesh, written and read again.
double slip_of_the_file(Scene scene, BaseNodes base, GmshVersion version)
{
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("damslip-gmsh-" + std::to_string(::getpid()) + ".msh");
    write_file(file, gmsh_text(export_mesh(build_mesh(scene), base), version));
    scene.mesh = {};
    scene.mesh.file = file;
    const double slip = contact_slip_of(scene);
    std::filesystem::remove(file);
    return slip;
}

// The same equations; nodes of the base are placed and, where they were shared, numbered with other round-off.
TEST(FeGmshRun, TheSlipIsThatOfTheOwnMesh)
{
    const Scene scene = coarse_dam();
    const double own = contact_slip_of(scene);
    ASSERT_GT(own, 1e-3);
    EXPECT_NEAR(slip_of_the_file(scene, BaseNodes::twice, GmshVersion::v4_1) / own, 1.0, 1e-8);
    EXPECT_NEAR(slip_of_the_file(scene, BaseNodes::shared, GmshVersion::v2_2) / own, 1.0, 1e-8);
}

// Six elements of the dam over nine of the rock: the sides are paired by the mortar integral, not node to node.
TEST(FeGmshRun, TheSidesOfTheBaseNeedNotMatch)
{
    Scene scene = coarse_dam();
    scene.damping.mass_coefficient = 1.8; // modes, which would give them, need facing nodes
    scene.damping.stiffness_coefficient = 8e-4;
    const double matching = contact_slip_of(scene);
    scene.mesh.rock_contact_size = 5.0;
    const double own = contact_slip_of(scene);
    ASSERT_NE(own, matching);
    EXPECT_NEAR(own / matching, 1.0, 0.05); // what a finer rock changes
    EXPECT_NEAR(slip_of_the_file(scene, BaseNodes::twice, GmshVersion::v4_1) / own, 1.0, 1e-8);
}

} // namespace
