// From a scene to its slip there is one way: `fe`, a sweep of one row, the library and a model level of `accuracy` give the same
// bits; so do `screen`, a sweep of one row, the library and a model level for the rigid block.
#include "analysis/accuracy/model_level_runner.hpp"
#include "analysis/fe/variants.hpp"
#include "analysis/screen/screening.hpp"
#include "analysis/sweep/sweep_run.hpp"
#include "core/file.hpp"
#include "scene/read.hpp"

#include "program_answer.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace damslip {

namespace {

struct OneScene {
    const char* name;
    const char* water;  ///< of [reservoir]; empty: no reservoir
    const char* tables; ///< the rest
    const char* model_level;   ///< how `accuracy` names it
};

void PrintTo(const OneScene& scene, std::ostream* out)
{
    *out << scene.name;
}

/// Each leaves something to be decided, or another way in the program.
const OneScene scenes[] = {
    {"rigid_ground_without_water", "", "[time]\nsubsteps = 1\n", "fe-dry:scene"},
    {"added_mass_on_rock", "model = \"added-mass\"",
     "[foundation]\nyoung_modulus_GPa = 20\nmass = \"massless\"\n[time]\nsubsteps = 1\n", "fe-added-mass:scene"},
    {"auto_is_acoustic", "model = \"auto\"",
     "[foundation]\nyoung_modulus_GPa = 20\nmass = \"massless\"\n[time]\nsubsteps = 1\n", "fe-acoustic:scene"},
    {"period_of_the_dam", "model = \"added-mass\"", "[added_mass]\nperiod_s = \"dam\"\n[time]\nsubsteps = 1\n",
     "fe-added-mass:scene"},
    {"seepage_and_modified_rayleigh", "model = \"added-mass\"",
     "[foundation]\nyoung_modulus_GPa = 20\nmass = \"massless\"\n[curtain]\ndistance_m = 2\n"
     "depth_m = 8\n[uplift]\nmodel = \"seepage\"\n"
     "[stages]\npore_pressure = \"effective\"\n[damping]\nmethod = \"modified-rayleigh\"\n[time]\nsubsteps = 1\n",
     "fe-added-mass:scene"},
    {"penalty_and_lift_joint", "model = \"hydrostatic\"",
     "[[lift_joint]]\nelevation_m = 8\nfriction = 0.6\n[time]\nsubsteps = 1\n", "fe-hydrostatic:scene"}};

class OneWay : public testing::TestWithParam<OneScene> {
protected:
    OneWay()
    {
        const std::filesystem::path data = std::filesystem::path(source_dir()) / "tests/report";
        const OneScene& s = GetParam();
        std::string text =
            "[section]\nheight_m = 20\nbase_m = 16\ncrest_m = 4\nneck_m = 4\n[dam]\n"
            "density_kg_m3 = 2400\nyoung_modulus_GPa = 25\n[contact]\nfriction = 0.7\n[mesh]\n"
            "size_m = 4\ncontact_size_m = 2\n[motion]\npolarity = 1\n[[motion.record]]\nname = \"one\"\n";
        text += "horizontal = \"" + (data / "pulses_h.csv").string() + "\"\nvertical = \"" +
                (data / "pulses_v.csv").string() + "\"\n" + s.tables;
        if (*s.water) text += std::string("[reservoir]\nlevel_m = 15\n") + s.water + "\n";
        if (*s.water && std::string(s.tables).find("[uplift]") == std::string::npos)
            text += "[uplift]\nmodel = \"linear\"\n";
        write_file(file, text);
    }
    nlohmann::json answer(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.begin() + 1, file.string());
        arguments.insert(arguments.end(), {"--json", "--quiet"});
        const ProgramAnswer answer = answer_of(arguments);
        EXPECT_EQ(answer.code, 0) << answer.out << answer.talk;
        return nlohmann::json::parse(answer.out);
    }
    ModelLevelResult model_level(const std::string& id) const
    {
        const Watch nobody;
        const Scene scene = read_scene(file);
        return ModelLevelRunner(scene, load_records(scene, Method::finite_elements), 0.0, nobody).run(parse_model_level(id).value());
    }
    FinishedRow only_row(const std::string& method) const
    {
        Watch watch;
        const Scene scene = read_scene(file);
        Axes axes = axes_of(scene);
        axes.method = {sweep_method(method)};
        const SweepOutcome outcome = run_sweep(make_sweep(scene, axes), watch);
        EXPECT_EQ(outcome.rows.size(), 1u);
        return outcome.rows.at(0);
    }

    std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / (std::string("one_way_") + GetParam().name + ".toml");
};

TEST_P(OneWay, FiniteElementsGiveTheSameBits)
{
    Watch watch;
    const Ready ready = prepare(read_scene(file), Method::finite_elements);
    const std::vector<ContactRun> runs = ContactRuns(ready, {.mesh_error = false}, watch).run();
    ASSERT_EQ(runs.size(), 1u);
    const double slip = runs[0].fe.slip;
    ASSERT_GT(std::abs(slip), 1e-5) << text_of(runs[0].fe.notes); // else all would agree on nothing
    EXPECT_EQ(answer({"fe", "--no-mesh-error"})["runs"][0]["slip_mm"], 1e3 * slip);
    EXPECT_EQ(answer({"sweep", "--method", "fe"})["rows"][0]["slip_m"], slip);
    EXPECT_EQ(only_row("fe").results.slip, slip);
    EXPECT_EQ(run_worst({"the scene itself", ready.given}, ready, runs[0], watch).slip, slip);
    const ModelLevelResult model_level = this->model_level(GetParam().model_level);
    ASSERT_TRUE(model_level.done()) << model_level.remark;
    EXPECT_EQ(model_level.slip(0), slip);
}

TEST_P(OneWay, TheRigidBlockGivesTheSameBits)
{
    const Ready ready = prepare(read_scene(file), Method::rigid_block);
    const Screening screening = run_screening(ready, 1);
    const SlipRow& row = screening.slips.at(0);
    ASSERT_EQ(row.polarity, 1);
    const double slip = row.with_vertical.value().slip;
    ASSERT_GT(slip, 1e-5);
    EXPECT_EQ(answer({"screen"})["displacements"][0]["slip_hv_mm"], 1e3 * slip);
    EXPECT_EQ(answer({"sweep", "--method", "rigid-v"})["rows"][0]["slip_m"], slip);
    const ModelLevelResult model_level = this->model_level("rigid:h+v");
    ASSERT_TRUE(model_level.done()) << model_level.remark;
    EXPECT_EQ(model_level.slip(0), slip);
}

INSTANTIATE_TEST_SUITE_P(SixScenes, OneWay, testing::ValuesIn(scenes),
                         [](const auto& info) { return std::string(info.param.name); });

} // namespace

} // namespace damslip
