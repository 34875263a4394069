#include "analysis/screen/screening.hpp"
#include "cli/command.hpp"
#include "core/input_error.hpp"
#include "core/statistics.hpp"
#include "program_answer.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace {

using namespace damslip;

/// A folder with a dry 2500 kg/m3 block on friction 0.1 and one triangular pulse of 2 m/s2 over 2 s.
class CliScene : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip_cli_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "pulse.csv") << "time_s,accel_m_s2\n0,0\n1,2\n2,0\n3,0\n";
        std::ofstream(folder / "block.toml")
            << "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = "
               "0.1\n[[motion.record]]\nhorizontal = \"pulse.csv\"\n";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string scene() const { return (folder / "block.toml").string(); }
    std::filesystem::path folder;
};

// Downstream a_y = mu g = 0.981. Triangle a = 2t rising, 2(2 - t) falling. Sliding starts at t1 = a_y/2, relative acceleration a - a_y.
// Rest is reached at t2 > 1 where the velocity integral vanishes: with q = 2 - a_y the velocity gained up to the second crossing
// tc = 2 - a_y/2 is V = q^2/2 (two triangles of height q and width q/2). After tc the deceleration grows as 2(t - tc) until t = 2,
// where it is a_y; V - (a_y/2)^2 is left and stops under the constant a_y.
double triangle_slip(double a_y)
{
    const double q = 2 - a_y, w = q / 2; // half width of the part above yield
    const double v_peak = q * w;         // speed at tc: area of the triangle of base 2w and height q
    const double s1 =
        q * w * w / 6 + (q * w / 2) * w + q * w * w / 3; // rise: q w^2/6; fall: at speed q w/2, plus q w^2 (1/2 - 1/6)
    const double t2 = a_y / 2;                           // from tc to t = 2
    const double v2 = v_peak - t2 * t2;                  // 2 t^2 / 2
    const double s2 = v_peak * t2 - t2 * t2 * t2 / 3;
    return s1 + s2 + v2 * v2 / (2 * a_y);
}

TEST_F(CliScene, ScreenFindsTheSlipOfATriangularPulse)
{
    const ProgramAnswer a = answer_of({"screen", scene(), "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto j = nlohmann::json::parse(a.out);
    EXPECT_EQ(j["schema"], "damslip.screen/1");
    const double slip = j["displacements"][0]["slip_h_mm"].get<double>() / 1000;
    EXPECT_NEAR(slip, triangle_slip(0.981), 1e-12 * slip);
    EXPECT_EQ(j["displacements"][0]["polarity"], 1);
    EXPECT_NEAR(j["displacements"][1]["slip_h_mm"].get<double>() / 1000, -slip,
                1e-12 * slip); // dry block: the mirror image
    EXPECT_NEAR(j["yield"][0]["yield_acceleration_m_s2"].get<double>(), 0.981, 1e-15);
}

TEST_F(CliScene, ScreenWritesItsFilesAndTheResolvedSceneReproducesThem)
{
    const std::string first = (folder / "one").string(), second = (folder / "two").string();
    ASSERT_EQ(answer_of({"screen", scene(), "--out", first}).code, 0);
    ASSERT_EQ(answer_of({"screen", first + "/scene.resolved.toml", "--out", second}).code, 0);
    const auto content = [](const std::string& file) {
        std::ifstream in(file);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    EXPECT_EQ(content(first + "/displacements.csv"), content(second + "/displacements.csv"));
    EXPECT_NE(content(first + "/displacements.csv").find("slip_h_mm"), std::string::npos);
}

TEST_F(CliScene, SweepRowsDoNotDependOnTheNumberOfThreads)
{
    const std::vector<std::string> arguments{"sweep",   scene(), "--friction", "0.02:0.3:0.01",
                                             "--scale", "1,2",   "--polarity", "1,-1"};
    auto with_jobs = [&](const char* jobs) {
        std::vector<std::string> a = arguments;
        a.insert(a.end(), {"--jobs", jobs});
        return answer_of(a);
    };
    const ProgramAnswer one = with_jobs("1"), three = with_jobs("3");
    ASSERT_EQ(one.code, 0) << one.talk;
    EXPECT_EQ(one.out, three.out);
    EXPECT_EQ(std::count(one.out.begin(), one.out.end(), '\n'), 3 + 1 + 29 * 2 * 2);
}

TEST_F(CliScene, ExplainNamesEveryEffectOnce)
{
    const ProgramAnswer a = answer_of({"explain", scene(), "--json"});
    ASSERT_EQ(a.code, 0);
    const auto j = nlohmann::json::parse(a.out);
    EXPECT_EQ(j["effects"].size(), 42u);
    for (const auto& e : j["effects"]) {
        const bool expected = e["effect"] == "upstream sliding" || e["effect"] == "run-out";
        EXPECT_EQ(e["on"].get<bool>(), expected) << e["effect"];
    }
}

TEST_F(CliScene, FeSlidesAStiffBlockLikeTheRigidBlock)
{
    // A squat, very stiff block on a rigid base under the triangular pulse: slip within 1 % of the rigid block's exact one (the FE slip
    // is within 1 % of its limit in the time step by default, and the elastic deformation is of the order of 1e-6 m).
    std::ofstream(folder / "stiff.toml")
        << "[section]\npolygon_m = [[0, 0], [8, 0], [8, 2], [0, 2]]\n[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = "
           "2500\n[contact]\nfriction = 0.1\n"
           "[mesh]\nsize_m = 1\n[[motion.record]]\nhorizontal = \"pulse.csv\"\n";
    const ProgramAnswer a = answer_of(
        {"fe", (folder / "stiff.toml").string(), "--polarity", "1", "--json", "--out", (folder / "fe").string()});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto j = nlohmann::json::parse(a.out);
    EXPECT_EQ(j["base"], "contact");
    EXPECT_EQ(j["runs"][0]["unresolved"], 0);
    EXPECT_NEAR(j["runs"][0]["slip_mm"].get<double>(), 1e3 * triangle_slip(0.981), 10 * triangle_slip(0.981));
    EXPECT_NEAR(j["runs"][0]["slip_rigid_mm"].get<double>(), 1e3 * triangle_slip(0.981), 1e-9);
    for (const char* file : {"summary.json", "history_pulse.csv", "base_pulse.csv", "contact_pulse.csv",
                             "states_pulse.csv", "fields.pvd", "scene.resolved.toml"})
        EXPECT_TRUE(std::filesystem::exists(folder / "fe" / file)) << file;

    // A block that slides as a whole: the same slip at heel, middle and toe, all steps solved, energy of the ground
    // into friction.
    const auto& slip = j["slip"][0];
    for (const char* where : {"slip_heel_mm", "slip_middle_mm", "slip_toe_mm"})
        EXPECT_NEAR(slip[where].get<double>(), slip["slip_mm"].get<double>(), 1e-3 * slip["slip_mm"].get<double>());
    const auto& counts = j["counts"][0];
    EXPECT_EQ(counts["steps"], counts["newton"].get<int>() + counts["worst_violator"].get<int>() +
                                   counts["gauss_seidel"].get<int>() + counts["lemke"].get<int>());
    EXPECT_EQ(counts["factorisations"], 1);
    EXPECT_NEAR(j["energy"][0]["friction_J_m"].get<double>(), 0.1 * 16 * 2500 * 9.81 * triangle_slip(0.981),
                0.01 * 0.1 * 16 * 2500 * 9.81 * triangle_slip(0.981)); // mu G s, s within 1 %

    // One letter per pair; the last instant of contact_pulse.csv is the end.
    std::ifstream states(folder / "fe" / "states_pulse.csv");
    std::string line, last;
    while (std::getline(states, line)) {
        if (line.starts_with("#") || line.starts_with("time_s")) continue;
        ASSERT_EQ(line.size() - line.find(',') - 1, j["contact_pairs"].get<std::size_t>()) << line;
        last = line;
    }
    EXPECT_EQ(last.find_first_of("duo"), std::string::npos) << last; // at rest
    std::ifstream pairs(folder / "fe" / "contact_pulse.csv");
    while (std::getline(pairs, line)) last = line;
    EXPECT_TRUE(last.ends_with(",s")) << last;
}

TEST_F(CliScene, SweepSetsUpFiniteElementsOnceForAllFrictions)
{
    // The stiff block of the test above with a horizontal force of a twentieth of its weight: mu below 0.05 cannot hold
    // it, whatever the motion, and both methods say so with the same critical friction. Steps of dt/32 leave a bit more than
    // 1 % of one slip, factor of safety included: 2 % are asked for.
    std::ofstream(folder / "stiff.toml")
        << "[section]\npolygon_m = [[0, 0], [8, 0], [8, 2], [0, 2]]\n[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = "
           "2500\n[contact]\nfriction = 0.1\n[[force]]\nforce_x_kN_m = 19.62\ny_m = 1\n"
           "[mesh]\nsize_m = 1\ncontact_size_m = 1\n[time]\nslip_tolerance = 0.02\n"
           "[[motion.record]]\nhorizontal = \"pulse.csv\"\n";
    const auto with_jobs = [&](const char* jobs) {
        return answer_of({"sweep", (folder / "stiff.toml").string(), "--friction", "0.03,0.1,0.12", "--polarity",
                          "1,-1", "--method", "rigid,fe", "--json", "--jobs", jobs});
    };
    const ProgramAnswer one = with_jobs("1"), three = with_jobs("3");
    ASSERT_EQ(one.code, 0) << one.talk;
    EXPECT_EQ(one.out, three.out);
    const auto j = nlohmann::json::parse(one.out);
    EXPECT_EQ(j["counts"]["set_ups"], 1);
    EXPECT_EQ(j["counts"]["runs"], 6);
    EXPECT_EQ(j["counts"]["static_failures"], 2);
    ASSERT_EQ(j["rows"].size(), 12u);
    for (std::size_t k = 0; k < 12; k += 2) {
        const auto &rigid = j["rows"][k], &fe = j["rows"][k + 1];
        EXPECT_EQ(rigid["method"], "rigid");
        EXPECT_EQ(fe["method"], "fe");
        EXPECT_NEAR(fe["critical_friction"].get<double>(), 0.05, 1e-12); // 19.62 / (16 * 2.5 * 9.81)
        EXPECT_NEAR(rigid["critical_friction"].get<double>(), 0.05, 1e-12);
        if (k < 4) {
            EXPECT_EQ(fe["status"], "static failure");
            EXPECT_TRUE(fe["slip_m"].is_null());
        } else {
            EXPECT_NEAR(fe["slip_m"].get<double>(), rigid["slip_m"].get<double>(),
                        fe["slip_error_m"].get<double>() + 0.01 * std::abs(rigid["slip_m"].get<double>()));
        }
    }
    ASSERT_EQ(j["comparison"].size(), 3u);
    EXPECT_EQ(j["comparison"][0]["motions"], 0);
    EXPECT_EQ(j["comparison"][0]["static_failures"], 2);
    EXPECT_EQ(j["comparison"][2]["motions"], 2);
    EXPECT_NEAR(j["comparison"][2]["ratio_of_means"].get<double>(), 1.0, 0.02);
}

TEST_F(CliScene, FeTiedWritesStagesAndHistory)
{
    std::ofstream(folder / "tied.toml")
        << "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = "
           "25\n[contact]\nfriction = 0.1\n[mesh]\nsize_m = 1\n"
           "[[motion.record]]\nhorizontal = \"pulse.csv\"\ndt_s = 1\n[time]\ndt_s = 0.01\n";
    const ProgramAnswer a = answer_of(
        {"fe", (folder / "tied.toml").string(), "--base", "tied", "--json", "--out", (folder / "tied").string()});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto j = nlohmann::json::parse(a.out);
    EXPECT_NEAR(j["stages"][0]["force_y_kN_m"].get<double>(), -40 * 2.5 * 9.81, 1e-9); // weight of the triangle
    EXPECT_EQ(j["runs"][0]["steps"], 300);
    for (const char* file : {"history_pulse_+1.csv", "history_pulse_-1.csv"})
        EXPECT_TRUE(std::filesystem::exists(folder / "tied" / file)) << file;
    EXPECT_EQ(j["verdict"], "–");
    EXPECT_EQ(j["headline"].get<std::string>().find("On a base that is bonded to the rock"), 0u) << j["headline"];
}

// The same level from both commands, of the same flags and beside the same records.
TEST_F(CliScene, FeAndScreenHaveTheSameResponseSpectrum)
{
    std::ofstream(folder / "elastic.toml")
        << "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = 25\npoisson_ratio = "
           "0.2\n[contact]\nfriction = 0.8\n[mesh]\nsize_m = 2\n[[motion.record]]\nhorizontal = "
           "\"pulse.csv\"\nvertical = "
           "\"pulse.csv\"\n";
    std::ofstream(folder / "shape.csv") << "period_s,s_a\n0,1\n0.1,2.5\n0.4,2.5\n2,0.5\n";
    const std::string scene = (folder / "elastic.toml").string(), shape = (folder / "shape.csv").string();
    const auto answer = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
        words.insert(words.end(), {"--response-spectrum", "--json", "-q"});
        words.insert(words.end(), more.begin(), more.end());
        const ProgramAnswer a = answer_of(words);
        EXPECT_EQ(a.code, 0) << a.talk;
        return nlohmann::json::parse(a.out)["response_spectrum"];
    };
    for (const std::vector<std::string>& more : {std::vector<std::string>{},
                                                 {"--spectrum", shape, "--spectrum-pga", "1"},
                                                 {"--spectrum", shape, "--spectrum-pga", "1", "--spectrum-vertical",
                                                  shape, "--spectrum-vertical-pga", "0.5"}}) {
        const auto screen = answer({"screen", scene}, more), fe = answer({"fe", scene, "--base", "tied"}, more);
        EXPECT_EQ(screen, fe);
        EXPECT_GT(fe["rows"][0]["base_shear_kN_m"].get<double>(), 0.0);
        EXPECT_EQ(fe.contains("components"),
                  more.size() != 4); // the record's and the given vertical, not of one spectrum
    }
}

TEST_F(CliScene, ExplainCountsAreThoseOfTheRun)
{
    // The example with added mass by name: "auto" makes it acoustic for modes, while contact runs keep added mass. On
    // massless rock, which is condensed.
    std::ifstream in(std::string(source_dir()) + "/examples/reference_dam_profile.toml");
    std::string text((std::istreambuf_iterator<char>(in)), {});
    for (std::size_t at = 0; (at = text.find("../records", at)) != std::string::npos; at += 10)
        text.replace(at, 10, std::string(source_dir()) + "/records");
    text.insert(text.find("[reservoir]") + 11, "\nmodel = \"added-mass\"");
    text.insert(text.find("[foundation]") + 12, "\nmass = \"massless\"");
    const std::string file = (folder / "added_mass.toml").string();
    std::ofstream(file) << text;
    const auto plan = nlohmann::json::parse(answer_of({"explain", file, "--method", "fe", "--json"}).out);
    const auto modes = nlohmann::json::parse(answer_of({"modes", file, "--count", "1", "--json"}).out);
    EXPECT_EQ(plan["model"], modes["model"]);
    EXPECT_EQ(plan["model"].size(), 5u); // dam, foundation, curtain, added mass, sum

    // The contact run: rock and dam become two unknowns a pair; their sum is the tied model's unknowns and the base's own.
    const auto& parts = plan["contact"]["parts"];
    ASSERT_EQ(parts.size(), 4u); // rock, dam at rest, dam in motion, contact problem
    const auto contact = parts[3]["unknowns"].get<std::int64_t>();
    EXPECT_EQ(parts[0]["become"], contact);
    EXPECT_EQ(parts[0]["unknowns"].get<std::int64_t>() + parts[2]["unknowns"].get<std::int64_t>(),
              plan["model"][4]["unknowns"].get<std::int64_t>() + contact);
    EXPECT_EQ(parts[3]["bytes"], 8 * contact * contact);
    for (const auto& part : parts) EXPECT_GE(part["bytes"].get<std::int64_t>(), 8 * contact * contact) << part["part"];
    EXPECT_EQ(plan["contact"]["factorisations"]["set_up"], 2);
    EXPECT_GT(plan["contact"]["seconds_per_step"].get<double>(), 0.0);
    EXPECT_EQ(plan["contact"]["records"][0]["steps"], 2000); // 20 s by 0.01 s; the run-out is not counted

    // Koyna has neither water nor rock nor curtain: the dam is all there is.
    const auto bare = nlohmann::json::parse(
        answer_of({"explain", std::string(source_dir()) + "/examples/koyna.toml", "--method", "fe", "--json"})
            .out);
    ASSERT_EQ(bare["model"].size(), 2u);
    EXPECT_EQ(bare["model"][0]["effect"], "dam");
    EXPECT_EQ(bare["model"][0]["unknowns"], bare["model"][1]["unknowns"]);
}

// The example's joint at 51.5 m is 12 m long; the FE effects name it, limit equilibrium says that it leaves it out.
TEST_F(CliScene, LiftJointsAreExplainedAndLeftOutOfScreening)
{
    const std::string file = std::string(source_dir()) + "/examples/cracked_upper_block.toml";
    const ProgramAnswer a = answer_of({"explain", file, "--method", "fe", "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto plan = nlohmann::json::parse(a.out);
    ASSERT_EQ(plan["lift_joints"].size(), 1u);
    EXPECT_EQ(plan["lift_joints"][0]["joint"], "neck");
    EXPECT_NEAR(plan["lift_joints"][0]["length_m"].get<double>(), 12.0, 1e-9);
    EXPECT_GE(plan["lift_joints"][0]["pairs"].get<int>(), 8);
    const auto screened = nlohmann::json::parse(answer_of({"screen", file, "--json"}).out);
    EXPECT_NE(screened["warnings"].dump().find("[[lift_joint]] is not in the slip of the sliding block: "),
              std::string::npos);
    EXPECT_NEAR(screened["lift_joints"][0]["critical_friction"].get<double>(), 593505.0 / (3237300.0 - 647460.0), 1e-9);
    const ProgramAnswer reduced = answer_of({"fe", file, "--reduced"});
    EXPECT_EQ(reduced.code, 2);
    EXPECT_NE(reduced.talk.find("cannot take 1 [[lift_joint]]."), std::string::npos) << reduced.talk;
}

TEST_F(CliScene, ReducedFeRunPrintsSlipWithItsError)
{
    // The stiff block above: its modes play no part, so few of them give the same slip, and the estimate says so.
    std::ofstream(folder / "stiff.toml")
        << "[section]\npolygon_m = [[0, 0], [8, 0], [8, 2], [0, 2]]\n[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = "
           "2500\n[contact]\nfriction = 0.1\n"
           "[mesh]\nsize_m = 1\n[[motion.record]]\nhorizontal = \"pulse.csv\"\n";
    const ProgramAnswer a = answer_of({"fe", (folder / "stiff.toml").string(), "--reduced", "--modes", "4",
                                       "--polarity", "1", "--json", "--out", (folder / "reduced").string()});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto run = nlohmann::json::parse(a.out)["runs"][0];
    EXPECT_EQ(run["modes"], 4);
    EXPECT_EQ(run["unresolved"], 0);
    EXPECT_NEAR(run["slip_mm"].get<double>(), 1e3 * triangle_slip(0.981), 10 * triangle_slip(0.981));
    EXPECT_LT(run["truncation_error_mm"].get<double>(), 1e-3 * run["slip_mm"].get<double>());
    for (const char* file : {"summary.json", "history_pulse.csv"})
        EXPECT_TRUE(std::filesystem::exists(folder / "reduced" / file)) << file;
    EXPECT_NE(answer_of({"fe", (folder / "stiff.toml").string(), "--modes", "4"}).code, 0); // without --reduced
}

TEST_F(CliScene, AnEffectOfZeroStrengthChangesNothing)
{
    const std::string block =
        "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = "
        "25\n[contact]\nfriction = 0.4\n[mesh]\nsize_m = 1\n[foundation]\nyoung_modulus_GPa = 20\nmass = \"massless\"\n"
        "[[motion.record]]\nhorizontal = \"pulse.csv\"\n[time]\ndt_s = 0.01\n";
    const auto run = [&](const std::string& name, const std::string& more) {
        std::ofstream(folder / name) << block << more;
        return nlohmann::json::parse(
            answer_of({"fe", (folder / name).string(), "--base", "tied", "--json"}).out)["runs"][0];
    };
    const auto plain = run("plain.toml", "");
    for (const char* nothing :
         {"[reservoir]\nlevel_m = 0\n", "[tailwater]\nlevel_m = 0\n", "[ice]\nforce_kN_m = 0\nlevel_m = 9\n",
          "[[force]]\ny_m = 5\n", "[curtain]\ndistance_m = 2\ndepth_m = 5\nyoung_modulus_GPa = 20\n"}) {
        const auto with = run("with.toml", nothing);
        for (const char* key : {"peak_crest_x_mm", "peak_crest_accel_x_m_s2", "peak_base_shear_kN_m"})
            // The same mesh, the same matrices: no zero that is added may show.
            EXPECT_NEAR(with[key].get<double>(), plain[key].get<double>(), 1e-12 * plain[key].get<double>())
                << nothing << key;
    }
}

TEST_F(CliScene, ScaleThatOverflowsIsRefusedWithAFix)
{
    const ProgramAnswer a = answer_of({"screen", scene(), "--scale", "1e308"});
    EXPECT_EQ(a.code, 3);
    EXPECT_NE(a.talk.find("fix:"), std::string::npos) << a.talk;
    EXPECT_NE(a.talk.find("--scale"), std::string::npos) << a.talk;
}

// Full water on friction 0.1: the block needs no earthquake to slide, and no slip is a result.
TEST_F(CliScene, StaticSlidingHasNoSlip)
{
    std::ofstream(folder / "block.toml", std::ios::app) << "[reservoir]\nlevel_m = 10\n[uplift]\nmodel = \"none\"\n";
    const auto j = nlohmann::json::parse(answer_of({"screen", scene(), "--json"}).out);
    for (const auto& row : j["displacements"]) {
        EXPECT_EQ(row["status"], "static failure");
        for (const char* key : {"slip_h_mm", "max_slip_m", "upstream_slip_mm"}) EXPECT_TRUE(row[key].is_null()) << key;
    }
    EXPECT_EQ(j["displacements"].size(), 2u);
    for (const auto& row : j["statistics"]) { // counted by name, never averaged
        EXPECT_EQ(row["n"], 0);
        EXPECT_TRUE(row["median_mm"].is_null());
        EXPECT_EQ(row["without_slip"], "1 static failure");
    }
    EXPECT_NE(answer_of({"screen", scene()}).out.find("slides statically: no slip is given"), std::string::npos);
}

TEST_F(CliScene, ModesGiveTheFrequencies)
{
    const ProgramAnswer a =
        answer_of({"modes", std::string(source_dir()) + "/examples/koyna.toml", "--count", "2", "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto j = nlohmann::json::parse(a.out);
    EXPECT_NEAR(j["modes"][0]["frequency_Hz"].get<double>(), 3.07, 0.1); // Chopra & Chakrabarti (1973), 3 %
}

TEST(Cli, HelpNamesAnExampleForEveryCommand)
{
    for (const char* command : {"screen", "sweep", "fe", "modes", "explain", "verify", "schema", "completion"}) {
        const ProgramAnswer a = answer_of({command, "--help"});
        EXPECT_EQ(a.code, 0);
        EXPECT_NE(a.out.find("Example:"), std::string::npos) << command;
    }
    EXPECT_NE(answer_of({"--help"}).out.find("Exit codes:"), std::string::npos);
    EXPECT_EQ(answer_of({"--version"}).code, 0);
}

TEST(Cli, HelpShowsTheWholeCommand)
{
    using Line = std::vector<std::string>;
    for (const Line& line : {Line{}, Line{"fe"}, Line{"sweep"}, Line{"man"}, Line{"record"}, Line{"record", "info"}}) {
        std::string usage = "Usage: damslip";
        for (const std::string& word : line) usage += " " + word;
        Line asked = line;
        asked.push_back("--help");
        EXPECT_NE(answer_of(asked).out.find(usage + " "), std::string::npos) << usage;
    }
}

TEST(Cli, SchemaIsJsonAndClosed)
{
    const auto j = nlohmann::json::parse(answer_of({"schema"}).out);
    EXPECT_FALSE(j["additionalProperties"].get<bool>());
    EXPECT_TRUE(j["properties"]["contact"]["properties"].contains("friction_deg"));
    EXPECT_TRUE(j["properties"]["motion"]["properties"].contains("record"));
}

TEST(Cli, CompletionKnowsCommandsAndFlags)
{
    for (const char* shell : {"bash", "zsh", "fish"}) {
        const std::string text = answer_of({"completion", shell}).out;
        EXPECT_NE(text.find("screen"), std::string::npos);
        EXPECT_NE(text.find(std::string(shell) == "fish" ? "-l record" : "--record"), std::string::npos);
    }
}

TEST(Cli, NoFlagTakesWhatIsNoNumber)
{
    int flags = 0;
    for (const cli::CommandSummary& command : cli::command_summaries())
        for (const cli::OptionSummary& option : command.options) {
            if (!option.value.starts_with("FLOAT")) continue;
            ++flags;
            for (const std::string value : {"nan", "-nan", "inf", "-inf", "1e999"}) {
                std::vector<std::string> words;
                std::istringstream names(command.name);
                for (std::string word; names >> word;) words.push_back(word);
                words.push_back(option.name + "=" + value);
                try {
                    cli::parse_arguments(words, cli::commands());
                    ADD_FAILURE() << command.name << " takes " << words.back();
                } catch (const UsageError& error) {
                    const std::string said = error.what();
                    EXPECT_NE(said.find(option.name + ": " + value + " is not allowed"), std::string::npos) << said;
                    EXPECT_NE(said.find("number"), std::string::npos) << said;
                }
            }
        }
    EXPECT_GT(flags, 50); // screen, fe, sweep, regress, record ...: the loop has met them
}

TEST(Cli, BoundsOfADecimalFlagAreSaid)
{
    for (const std::string value : {"0.9", "1001", "tall"}) try {
            cli::parse_arguments({"init", "dam.toml", "--height", value}, cli::commands());
            ADD_FAILURE() << value;
        } catch (const UsageError& error) {
            EXPECT_NE(std::string(error.what()).find("--height: " + value + " is not allowed: a number from 1 to 1000"),
                      std::string::npos)
                << error.what();
        }
    EXPECT_NO_THROW(cli::parse_arguments({"init", "dam.toml", "--height", "1000"}, cli::commands()));
}

TEST(Cli, PercentilesInterpolateBetweenOrderStatistics)
{
    EXPECT_DOUBLE_EQ(percentile({3, 1, 2}, 0.5), 2);
    EXPECT_DOUBLE_EQ(percentile({1, 2, 3, 4}, 0.5), 2.5);
    EXPECT_DOUBLE_EQ(percentile({0, 10}, 0.16), 1.6);
    EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
}

} // namespace
