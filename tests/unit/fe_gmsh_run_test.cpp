// Contact runs on imported meshes: the slip of the program's own mesh, read from a file.
#include "core/file.hpp"
#include "fe2d/gmsh/write_gmsh.hpp"
#include "fe2d/mesh/export_mesh.hpp"
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

double contact_slip_of(const Scene& scene)
{
    RunOptions options;
    options.halvings = 1;
    const RunResult result = EarthquakeRun(scene, options).run(sine_pulses());
    EXPECT_EQ(result.status, RunStatus::at_rest) << result.message;
    return result.slip;
}

TEST(FeGmshRun, TheSlipIsThatOfTheOwnMesh)
{
    Scene scene = test::reference_dam_on_rock();
    scene.mesh.size = scene.mesh.contact_size = 7.5;
    scene.curtain.reset();
    scene.reservoir = Reservoir{.level = 55.0, .model = ReservoirModel::hydrostatic};
    scene.contact.friction = 0.7;
    const double own = contact_slip_of(scene);
    ASSERT_GT(own, 1e-3);
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("damslip-gmsh-" + std::to_string(::getpid()) + ".msh");
    const Mesh mesh = build_mesh(scene);
    for (const auto& [base, version] :
         {std::pair{BaseNodes::twice, GmshVersion::v4_1}, {BaseNodes::shared, GmshVersion::v2_2}}) {
        write_file(file, gmsh_text(export_mesh(mesh, base), version));
        Scene imported = scene;
        imported.mesh = {};
        imported.mesh.file = file;
        // The same equations; nodes of the base are placed and, where they were shared, numbered with other round-off.
        EXPECT_NEAR(contact_slip_of(imported) / own, 1.0, 1e-8);
    }
    std::filesystem::remove(file);
}

} // namespace
