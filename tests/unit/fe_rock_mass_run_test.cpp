// Sliding on rock with mass: what a run hands to reports, and runs that no step can be made of.
#include "fe2d/model/model.hpp"
#include "program_answer.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

Scene on_rock(RockMass mass, RockBoundary boundary)
{
    Scene scene = test::sliding_dam(0.77, 1.0, 7.5);
    scene.curtain.reset();
    scene.foundation->material.density = mass == RockMass::with_mass ? 2650.0 : 0.0;
    scene.foundation->mass = mass;
    scene.foundation->boundary = boundary;
    return scene;
}

// The last state kept for the report is the end, which the result has too; the first is the rest before the earthquake.
TEST(FeRockMassRun, KeptStatesAreThoseOfTheModel)
{
    for (const auto& [mass, boundary] : {std::pair{RockMass::massless, RockBoundary::fixed},
                                         {RockMass::with_mass, RockBoundary::fixed},
                                         {RockMass::with_mass, RockBoundary::viscous}}) {
        Scene scene = on_rock(mass, boundary);
        RunOptions options = test::options_of(scene);
        scene.time.substeps = 0;
        options.pair_series = PairSeries::every_step;
        const EarthquakeRun run(scene, options);
        const RunResult result = run.run(test::sines(1.0, 4.0));
        const auto states = result.history.states.states();
        ASSERT_GE(states.size(), 2u) << text_of(result.notes);
        const Eigen::VectorXd end = run.displacement_of(states.back());
        ASSERT_EQ(end.size(), run.model().dofs.count);
        EXPECT_EQ(end, result.displacement);
        // At rest K u = R on every unknown that contact does not act on; the largest of the rock's forces for scale.
        const Eigen::VectorXd rest = run.displacement_of(states.front());
        Eigen::VectorXd left = run.model().stiffness * rest - run.stages().last();
        const double scale = left.cwiseAbs().maxCoeff();
        ASSERT_GT(scale, 0.0);
        for (const std::vector<int>* nodes :
             {&run.model().mesh.contact.dam_nodes, &run.model().mesh.contact.rock_nodes})
            for (const int node : *nodes)
                for (const int c : {0, 1})
                    if (const int dof = run.model().dofs(node, c); dof != no_dof) left[dof] = 0.0;
        EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-9 * scale);
    }
}

TEST(FeRockMassRun, TheCommandWritesAllItsFiles)
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("damslip_rock_mass_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "pulse.csv") << "time_s,accel_m_s2\n0,0\n0.1,8\n0.2,-8\n0.3,0\n0.4,0\n";
    for (const char* boundary : {"fixed", "viscous", "absorbing"})
        for (const char* base : {"contact", "tied"}) {
            std::ofstream(folder / "dam.toml")
                << "[section]\nheight_m = 20\nbase_m = 16\ncrest_m = 4\n[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa "
                   "= "
                   "25\n[foundation]\nyoung_modulus_GPa = 20\ndensity_kg_m3 = 2600\nmass = \"with-mass\"\nboundary = \""
                << boundary
                << "\"\n[contact]\nfriction = 0.4\n[mesh]\nsize_m = 4\ncontact_size_m = "
                   "4\n[time]\ndt_s = 0.01\n[[motion.record]]\nhorizontal = "
                   "\"pulse.csv\"\n";
            const std::filesystem::path out = folder / (std::string(boundary) + base);
            const ProgramAnswer a =
                answer_of({"fe", (folder / "dam.toml").string(), "--base", base, "--out", out.string(), "--quiet"});
            EXPECT_EQ(a.code, 0) << a.talk;
            for (const char* file : {"report.html", "summary.json", "fields.pvd"})
                EXPECT_TRUE(std::filesystem::exists(out / file)) << boundary << base << file;
        }
    std::filesystem::remove_all(folder);
}

// A mass beyond all numbers: a status, not a crash.
TEST(FeRockMassRun, StepsThatCannotBeFactorisedAreAStatus)
{
    Scene scene = on_rock(RockMass::massless, RockBoundary::fixed);
    RunOptions options = test::options_of(scene);
    scene.time.substeps = 0;
    options.damping = RayleighConstants{0.0, 0.0};
    scene.dam.density = 1e304;
    const RunResult result = EarthquakeRun(scene, options).run(test::sines(1.0, 1.0));
    EXPECT_NE(result.status, Status::at_rest);
    EXPECT_FALSE(result.notes.empty());
}

// A crest that falls upstream is wet below the highest point: the thrust is that on the whole height of the water.
TEST(FeStaticLoads, WaterReachesOverTheLowEndOfTheCrest)
{
    Scene scene = test::sliding_dam(0.77);
    scene.foundation.reset();
    scene.curtain.reset();
    scene.section.polygon = {{0, 0}, {20, 0}, {14, 12}, {0, 10}};
    scene.mesh.size = scene.mesh.contact_size = 2.0;
    for (const double level : {9.0, 10.5, 11.0, 12.0}) {
        scene.reservoir = Reservoir{.level = level, .model = ReservoirModel::hydrostatic};
        ModelOptions separate;
        separate.base = Base::separate;
        double thrust = 0.0;
        for (const StaticLoad& load : static_loads(scene, build_model(scene, separate)).impounding)
            thrust += load.resultant.x();
        const double wanted = 0.5 * scene.reservoir->density * scene.gravity * level * level;
        EXPECT_NEAR(thrust / wanted, 1.0, 1e-12) << level;
    }
}

} // namespace
