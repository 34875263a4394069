// The same question gets the same answer from every command: polarities, the state after the earthquake, interrupts, budgets.
#include "analysis/assess/assess.hpp"
#include "pages/assess/assess_pages.hpp"
#include "pages/fe/fe_pages.hpp"
#include "program_answer.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <unistd.h>

namespace {

using namespace damslip;
using nlohmann::json;

/// Pulses of 0.4 s, stronger to one side than to the other, so that the polarities slip differently.
class Audit3Answer : public ::testing::Test {
protected:
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("damslip_audit3_answer_" + std::to_string(::getpid()));

    void SetUp() override
    {
        std::filesystem::create_directories(folder);
        std::ofstream pulses(folder / "pulses.csv");
        pulses << "time_s,accel_m_s2\n";
        for (int k = 0; k <= 150; ++k) {
            const double t = 0.01 * k, wave = std::sin(2.0 * 3.141592653589793 * t / 0.4);
            pulses << fmt::format("{:.2f},{:.6f}\n", t, t < 1.2 ? (wave > 0 ? 6.0 : 4.0) * wave : 0.0);
        }
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string write(const std::string& name, const std::string& text) const
    {
        std::ofstream(folder / (name + ".toml")) << text;
        return (folder / (name + ".toml")).string();
    }
    static std::string dam(const std::string& contact, const std::string& more = "")
    {
        return "[section]\nheight_m = 20\nbase_m = 16\ncrest_m = 4\n[dam]\ndensity_kg_m3 = 2400\n"
               "young_modulus_GPa = 25\n[foundation]\nyoung_modulus_GPa = 20\nwidth_m = 80\n"
               "depth_m = 40\nmass = \"massless\"\n[contact]\n" +
               contact + "\n[mesh]\nsize_m = 4\ncontact_size_m = 2\n" + more +
               "\n[[motion.record]]\nname = \"pulses\"\nhorizontal = \"pulses.csv\"\n";
    }
    static const std::string& water()
    {
        static const std::string text = "[reservoir]\nlevel_m = 18\nmodel = \"added-mass\"\n[uplift]\nmodel = \"linear\"\n";
        return text;
    }
    /// Water that pushes it downstream, and a fixed step.
    static const std::string& pushed()
    {
        static const std::string text = "[reservoir]\nlevel_m = 14\nmodel = \"added-mass\"\n[uplift]\nmodel = \"linear\"\n"
                                        "[time]\nsubsteps = 1\n";
        return text;
    }
    static json answer(std::vector<std::string> arguments, int code = 0)
    {
        arguments.push_back("--json");
        arguments.push_back("--quiet");
        const ProgramAnswer a = answer_of(arguments);
        EXPECT_EQ(a.code, code) << a.talk << a.out.substr(a.out.size() - std::min<std::size_t>(a.out.size(), 1500));
        return json::parse(a.out, nullptr, false);
    }
    /// Text of an answer that is refused.
    static std::string refusal(const std::vector<std::string>& arguments)
    {
        const ProgramAnswer a = answer_of(arguments);
        EXPECT_TRUE(a.code == 2 || a.code == 3) << a.code << a.out.substr(0, 400);
        return a.talk + a.out;
    }
};

bool says(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// Slips [mm] of screen by the label of the polarity.
double screened(const json& j, int polarity)
{
    for (const json& row : j["displacements"])
        if (row["polarity"] == polarity) return row["slip_h_mm"].get<double>();
    return -1.0;
}

TEST_F(Audit3Answer, A12_OneMeaningOfPolarity)
{
    const std::string as_filed = write("filed", dam("friction = 0.8", pushed()));
    const std::string flipped = write("flipped", dam("friction = 0.8", pushed() + "[motion]\npolarity = -1"));
    const json screen = answer({"screen", as_filed}), screen_flipped = answer({"screen", flipped});
    const double plus = screened(screen, 1), minus = screened(screen, -1);
    EXPECT_GT(std::abs(plus - minus), 0.05 * std::max(plus, minus)); // the test can tell them apart
    EXPECT_EQ(screened(screen_flipped, 1), plus);
    EXPECT_EQ(screened(screen_flipped, -1), minus);

    const auto fe_runs = [&](const std::string& scene, std::vector<std::string> more = {}) {
        std::vector<std::string> all{"fe", scene, "--no-mesh-error"};
        all.insert(all.end(), more.begin(), more.end());
        return answer(all)["runs"];
    };
    const json both = fe_runs(as_filed), one = fe_runs(flipped), asked = fe_runs(flipped, {"--polarity", "1"});
    ASSERT_EQ(both.size(), 2u);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one[0]["polarity"], -1);
    EXPECT_EQ(asked[0]["polarity"], 1);
    for (const json& run : {both[0], both[1], one[0], asked[0]}) {
        const int polarity = run["polarity"].get<int>();
        EXPECT_NEAR(run["slip_rigid_mm"].get<double>(), polarity > 0 ? plus : minus, 1e-6) << polarity;
        EXPECT_EQ(run["slip_mm"], (polarity > 0 ? both[0] : both[1])["slip_mm"]);
    }

    const auto sweep_rows = [&](const std::string& scene, const std::vector<std::string>& more) {
        std::vector<std::string> all{"sweep", scene};
        all.insert(all.end(), more.begin(), more.end());
        return answer(all)["rows"];
    };
    for (const json& row : sweep_rows(flipped, {"--polarity", "both"}))
        EXPECT_NEAR(1e3 * row["slip_m"].get<double>(), row["polarity"] == 1 ? plus : minus, 1e-9);
    EXPECT_NEAR(1e3 * sweep_rows(flipped, {"--polarity", "1"})[0]["slip_m"].get<double>(), plus, 1e-9);
    const json own = sweep_rows(flipped, {});
    ASSERT_EQ(own.size(), 1u);
    EXPECT_EQ(own[0]["polarity"], -1);
    EXPECT_NEAR(1e3 * own[0]["slip_m"].get<double>(), minus, 1e-9);
}

TEST_F(Audit3Answer, A12_AssessRunsBothPolaritiesOfFiniteElements)
{
    const std::string flipped = write("flipped", dam("friction = 0.8", pushed() + "[motion]\npolarity = -1"));
    Watch nobody;
    const Assessment a = assess(read_scene(flipped), {60.0, 1}, nobody);
    ASSERT_EQ(a.runs.size(), 2u);
    for (const ContactRun& run : a.runs) {
        ASSERT_TRUE(run.rigid);
        EXPECT_NEAR(run.rigid->slip, a.screening.slips[run.polarity > 0 ? 0 : 1].horizontal.slip, 1e-9) << run.polarity;
    }
    EXPECT_EQ(a.runs.front().polarity, 1);
}

TEST_F(Audit3Answer, A2_SweepRunsBothPolaritiesAndSaysSo)
{
    const std::string scene = write("dam", dam("friction = 0.6", "[reservoir]\nlevel_m = 14\nmodel = \"added-mass\"\n[uplift]\nmodel = \"linear\"\n[criteria]\nallowable_slip_mm = 20"));
    const ProgramAnswer plain = answer_of({"sweep", scene, "--friction", "0.4:0.9:0.1", "--out", folder / "rows.csv"});
    const ProgramAnswer both = answer_of({"sweep", scene, "--friction", "0.4:0.9:0.1", "--polarity", "both", "--out",
                                          folder / "both.csv"});
    EXPECT_EQ(plain.code, 0);
    EXPECT_TRUE(says(plain.talk, "Friction for a slip of 20 mm at most, both polarities")) << plain.talk;
    EXPECT_TRUE(says(plain.talk, "12 rows")) << plain.talk;
    const auto table = [](const std::string& talk) {
        const std::size_t at = talk.find("Friction for");
        return talk.substr(at, talk.find("12 rows") - at);
    };
    EXPECT_EQ(table(plain.talk), table(both.talk));
    const ProgramAnswer one = answer_of({"sweep", scene, "--friction", "0.4:0.9:0.1", "--polarity", "1", "--out", folder / "one.csv"});
    EXPECT_TRUE(says(one.talk, "polarity +1 alone")) << one.talk;
    const std::string wrong = refusal({"sweep", scene, "--polarity", "2"});
    EXPECT_TRUE(says(wrong, "both")) << wrong;
}

/// A dam whose base opens in the earthquake and does not slide: its bond is gone where it has opened.
TEST_F(Audit3Answer, A3_BondIsLostWhereTheJointHasOpened)
{
    const std::string strength = "friction = 0.9\ncohesion_kPa = 900", fixed = "\n[motion]\nscale = 0.5\n[time]\nsubsteps = 1\n";
    const auto after = [&](const std::string& crack) {
        const std::string scene = write("bond_" + crack, dam(strength, water() + "crack = \"" + crack + "\"" + fixed));
        const json j = answer({"fe", scene, "--polarity", "1", "--no-mesh-error"});
        const json& stage = j["stages"].back();
        EXPECT_EQ(stage["stage"], "after the earthquake");
        const double open = j["slip"][0]["largest_open_length_m"].get<double>(), n = stage["normal_force_kN_m"].get<double>(),
                     t = stage["shear_force_kN_m"].get<double>(), factor = stage["sliding_factor"].get<double>();
        EXPECT_GT(open, 0.5);
        EXPECT_LT(factor, (0.9 * n + 900.0 * 16.0) / t - 1e-6);         // not the whole base
        EXPECT_LE(factor, (0.9 * n + 900.0 * (16.0 - open)) / t + 1e-3); // nor what opened
        EXPECT_GE(factor, 0.9 * n / t - 1e-9);
        return std::pair(factor, n);
    };
    const auto [dry, n_dry] = after("none");
    const auto [wet, n_wet] = after("static");
    EXPECT_LT(n_wet, n_dry - 1.0); // full head in the crack
    EXPECT_LT(wet, dry);
}

TEST_F(Audit3Answer, A3_HeadlineJoinsSlipAndLoadCombinations)
{
    const std::string more = water() + "[criteria]\nallowable_slip_mm = 5000\n[[combination]]\nname = \"usual\"\n"
                                       "required_sliding_factor = 30\n";
    const std::string scene = write("joined", dam("friction = 0.8", more + "[time]\nsubsteps = 1\n"));
    const json screen = answer({"screen", scene}), fe = answer({"fe", scene, "--no-mesh-error"});
    const std::string words = screen["verdict"].get<std::string>();
    EXPECT_TRUE(says(words, "load combinations: FAIL usual ")) << words;
    EXPECT_TRUE(says(words, " < 30.0")) << words;
    EXPECT_EQ(fe["verdict"], "FAIL");
    const ProgramAnswer text = answer_of({"fe", scene, "--no-mesh-error", "--quiet"});
    EXPECT_TRUE(says(text.out, words.substr(words.find("load combinations")))) << text.out;
    const json assessed = answer({"assess", scene, "--budget", "10"});
    EXPECT_EQ(assessed["verdict"], "FAIL");
    EXPECT_TRUE(says(assessed["headline"].get<std::string>(), words.substr(words.find("load combinations"))));
}

TEST_F(Audit3Answer, A5_HeadlineOfTheRigidBlockIsNoBound)
{
    const json screen = answer({"screen", write("dam", dam("friction = 0.6", "[criteria]\nallowable_slip_mm = 5000")), "--rigid-only"});
    EXPECT_TRUE(says(screen["headline"].get<std::string>(), "by the rigid block: no bound for an elastic dam"));
    EXPECT_EQ(screen["verdict"], "Below the allowable as a rigid block; elasticity not checked.");
}

TEST_F(Audit3Answer, A8_GateOrOvertoppedIsAsked)
{
    const auto scene = [&](const std::string& how) {
        return write("gated", "[section]\npolygon_m = [[0,0],[20,0],[9,14],[5,16],[0,16]]\n[dam]\ndensity_kg_m3 = 2400\n"
                              "young_modulus_GPa = 25\n[reservoir]\nlevel_m = 22\nmodel = \"hydrostatic\"\n" + how +
                                  "[drains]\ndistance_m = 3\nefficiency = 0.5\n[contact]\nfriction = 1.0\n[mesh]\nsize_m = 4\n[time]\nsubsteps = 1\n[motion]\nscale = 0.1\n"
                                  "[[motion.record]]\nhorizontal = \"pulses.csv\"\n");
    };
    const std::string asks = refusal({"screen", scene("")});
    EXPECT_TRUE(says(asks, "6 m above the crest at 16 m") && says(asks, "[gate]") && says(asks, "overtopped = true")) << asks;
    const json gated = answer({"screen", scene("[gate]\ntop_m = 22.5\n")})["limit_equilibrium"][0];
    EXPECT_NEAR(gated["shear_force_kN_per_m"].get<double>(), 2374.0, 0.1); // ½·9.81·22²
    EXPECT_NEAR(gated["normal_force_effective_kN_per_m"].get<double>(), 3868.1, 0.5);
    EXPECT_NEAR(gated["sliding_factor"].get<double>(), 1.629, 5e-4);
    const json over = answer({"screen", scene("overtopped = true\n")})["limit_equilibrium"][0];
    EXPECT_NEAR(over["sliding_factor"].get<double>(), 1.894, 5e-4);
    const json fe = answer({"fe", scene("[gate]\ntop_m = 22.5\n"), "--polarity", "1", "--no-mesh-error"});
    for (const json& stage : fe["stages"])
        if (stage["stage"] == "uplift") {
            EXPECT_NEAR(stage["shear_force_kN_m"].get<double>(), 2374.0, 0.1);
            EXPECT_NEAR(stage["normal_force_kN_m"].get<double>(), 3868.1, 0.5);
        }
    EXPECT_TRUE(says(refusal({"screen", scene("[gate]\ntop_m = 20\n")}), "top of the gates"));
}

/// Aftershock on a base that has lost its uplift relief: the main shock's slip is known.
TEST_F(Audit3Answer, A9_MainShockKeepsItsSlip)
{
    const std::string text = "[section]\nheight_m = 20\nbase_m = 16\ncrest_m = 4\n[dam]\ndensity_kg_m3 = 2400\n"
                             "[reservoir]\nlevel_m = 19.5\nmodel = \"hydrostatic\"\n[uplift]\nmodel = \"drains\"\n"
                             "after = \"full\"\n[drains]\ndistance_m = 2\nefficiency = 0.9\n[contact]\nfriction = 0.82\n"
                             "[motion]\nsequence = [\"main\", \"after\"]\n";
    const auto record = [](const std::string& name, const std::string& more = "") {
        return "[[motion.record]]\nname = \"" + name + "\"\nhorizontal = \"pulses.csv\"\n" + more;
    };
    const ProgramAnswer a =
        answer_of({"screen", write("sequence", text + record("main") + record("after", "scale = 40\n")), "--json", "--quiet"});
    const json j = json::parse(a.out, nullptr, false);
    ASSERT_TRUE(j.contains("events")) << a.talk;
    const json& main = j["events"][0];
    EXPECT_EQ(main["event"], "main");
    EXPECT_EQ(main["status"], "at rest");
    EXPECT_TRUE(main["slip_so_far_mm"].is_number()) << j["events"].dump(1) << j["warnings"].dump(1);
    bool fails = false; // the scene is one in which the whole run has no slip
    for (const json& row : j["displacements"]) fails = fails || row["status"] != "at rest";
    EXPECT_TRUE(fails) << j["displacements"].dump(1);
}

TEST_F(Audit3Answer, A10_CompressedLength)
{
    const json rows = answer({"screen", write("cracked", dam("friction = 0.9", water() + "crack = \"static\""))})
        ["limit_equilibrium"];
    for (const json& e : rows) {
        ASSERT_TRUE(e.contains("compressed_length_m"));
        if (!e["toe_stress_kPa"].is_number() || e["crack_rule"] == "none") continue;
        const double heel = e["heel_stress_kPa"].get<double>(), toe = e["toe_stress_kPa"].get<double>();
        EXPECT_NEAR(0.5 * (heel + toe) * e["compressed_length_m"].get<double>(),
                    e["normal_force_effective_kN_per_m"].get<double>(), 0.01);
    }
}

TEST_F(Audit3Answer, C_MessagesAsk)
{
    const std::string degrees = refusal({"screen", write("deg", dam("friction = 45"))});
    EXPECT_TRUE(says(degrees, "degrees? write  friction_deg = 45")) << degrees;
    const ProgramAnswer mega = answer_of({"screen", write("mpa", dam("friction = 0.9\ncohesion_kPa = 0.3"))});
    EXPECT_TRUE(says(mega.talk + mega.out, "cohesion_MPa = 0.3")) << mega.talk;
    const std::string third = refusal({"screen", write("third", dam("friction = 0.9", "[[combination]]\nname = \"usual\"\n"
                                                                    "required_resultant = \"middle third\"\n"))});
    EXPECT_TRUE(says(third, "required_resultant = \"kern\"")) << third;
    EXPECT_FALSE(says(third, "write  required_resultant = \"base\"")) << third;
    for (const std::string command : {"screen", "fe"}) {
        const std::string outside = refusal({command, write("force", dam("friction = 0.9", "[[force]]\nname = \"crane\"\nx_m = 30\n"
                                                                         "y_m = 5\nforce_x_kN_m = 10\nforce_y_kN_m = 0\n"))});
        EXPECT_TRUE(says(outside, "outside the dam")) << outside;
    }
}

ContactRun run_of(int polarity, Status status, double slip_mm)
{
    ContactRun r;
    r.record = "pulses";
    r.polarity = polarity;
    r.both = true;
    r.fe.status = status;
    r.fe.slip = r.fe.max_slip = 1e-3 * slip_mm;
    r.fe.slip_error = 1e-4;
    r.mesh.check = MeshCheck::done;
    r.mesh.base = 1e-4;
    return r;
}

TEST_F(Audit3Answer, D1_NoLargestSlipWhereAPolarityHasNoAnswer)
{
    const Scene scene = read_scene(write("dam", dam("friction = 0.6")));
    const std::vector<ContactRun> runs{run_of(1, Status::at_rest, 184.2), run_of(-1, Status::self_excited, 409.4)};
    const pages::Headline fe = pages::fe_headline(scene, runs, {});
    EXPECT_FALSE(says(fe.sentence, "at most")) << fe.sentence;
    EXPECT_TRUE(says(fe.sentence, "polarity -1 self-excited")) << fe.sentence;
    EXPECT_EQ(exit_code_of(runs), 4);

    Assessment a;
    a.ready = prepare(scene, Method::rigid_block);
    a.screening = run_screening(a.ready, 1);
    a.fe = a.ready;
    a.runs = runs;
    judge_assessment(a);
    EXPECT_FALSE(a.recommended);
    EXPECT_EQ(exit_code_of(a), 4);
    EXPECT_TRUE(says(pages::assess_headline(a).sentence, "polarity -1 self-excited"));
    a.runs.back().fe.status = Status::at_rest;
    judge_assessment(a);
    ASSERT_TRUE(a.recommended);
    EXPECT_EQ(exit_code_of(a), 0);
    a.interrupted = true;
    judge_assessment(a);
    EXPECT_FALSE(a.recommended);
    EXPECT_EQ(exit_code_of(a), 4);
}

/// A flexible block that takes longer than the budget does not keep the finite elements from running.
TEST_F(Audit3Answer, D7_FiniteElementsBeforeADearFlexibleBlock)
{
    // 4,000 samples and water that enters the opening base at its mouth: the dearest law of the block that vibrates.
    std::ofstream motion(folder / "long.csv");
    motion << "time_s,accel_m_s2\n";
    for (int k = 0; k <= 200; ++k)
        motion << fmt::format("{:.2f},{:.6f}\n", 0.01 * k, 9.0 * std::sin(2.0 * 3.141592653589793 * k / 20.0));
    motion.close();
    std::string text = dam("friction = 1.2", water() + "opening = \"mouth\"\nmouth_speed_m_s = 5\n[regressions]\n"
                                               "period_s = 0.1\n[time]\nsubsteps = 4");
    text.replace(text.find("pulses.csv"), 10, "long.csv");
    const auto start = std::chrono::steady_clock::now();
    const json a = answer({"assess", write("dear", text), "--budget", "6"});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_LT(seconds, 30.0);
    ASSERT_TRUE(a["recommended"].is_object()) << a["notes"].dump(1);
    EXPECT_EQ(a["recommended"]["level"], "finite elements");
}

/// A user who stops it some time after it has begun.
class StopsSoon final : public Watch {
public:
    bool stop_asked() const override { return ++asked_ > 300; }

private:
    mutable std::atomic<int> asked_{0};
};

TEST_F(Audit3Answer, D2_InterruptedAssessmentRecommendsNothing)
{
    const Scene scene = read_scene(write("long", dam("friction = 0.5", water() + "[time]\ndt_s = 0.0002")));
    StopsSoon user;
    const Assessment a = assess(scene, {60.0, 1}, user);
    EXPECT_TRUE(a.interrupted);
    EXPECT_FALSE(a.recommended);
    EXPECT_EQ(exit_code_of(a), 4);
    EXPECT_TRUE(says(pages::assess_headline(a).sentence, "Interrupted"));
    for (const LeftOut& part : a.left_out) EXPECT_NE(part.why, "the time was over") << part.what;
}

} // namespace
