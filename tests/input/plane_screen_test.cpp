// Planes in `screen` and `sweep`: the dam "D" on a seam, and lifts through a dam.
#include "core/csv.hpp"
#include "program_answer.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <unistd.h>

namespace {

using namespace damslip;

std::string seam_scene()
{
    const std::string records = std::string(source_dir()) + "/records/data/ec8_3.0";
    return "[section]\nheight_m = 62.5\nbase_m = 45\ncrest_m = 12\nneck_m = 11\n[dam]\ndensity_kg_m3 = 2500\n"
           "[contact]\nfriction = 0.9\n[reservoir]\nlevel_m = 62.5\n[uplift]\nmodel = \"drains\"\n"
           "[drains]\ndistance_m = 6\nefficiency = 0.8\ndepth_m = 12\n"
           "[foundation]\nyoung_modulus_GPa = 20\ndensity_kg_m3 = 2650\n"
           "[lifts]\nspacing_m = 20\nfriction = 0.75\n"
           "[[seam]]\nname = \"clay\"\ndepth_m = 8\nfriction = 0.7\n[seam.wedge]\nfriction_deg = 40\n"
           "[criteria]\nallowable_slip_mm = 100\n"
           "[[motion.record]]\nname = \"ec8\"\nhorizontal = \"" +
           records + "_h.csv\"\nvertical = \"" + records + "_v.csv\"\n";
}

class PlaneScreen : public testing::Test {
protected:
    void SetUp() override
    {
        file = std::filesystem::temp_directory_path() / ("damslip_plane_screen_" + std::to_string(::getpid()) + ".toml");
        std::ofstream(file) << seam_scene();
    }
    void TearDown() override { std::filesystem::remove(file); }

    std::filesystem::path file;
};

TEST_F(PlaneScreen, SaysWhichPlaneGoverns)
{
    const ProgramAnswer answer = answer_of({"screen", file.string(), "--json"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const auto j = nlohmann::json::parse(answer.out);
    ASSERT_EQ(j["planes"].size(), 5u); // base, lifts at 20, 40 and 60 m, seam
    EXPECT_EQ(j["planes"][0]["plane"], "base");
    EXPECT_EQ(j["planes"][1]["plane"], "lift at 20 m");
    EXPECT_EQ(j["planes"][4]["plane"], "clay");
    EXPECT_EQ(j["lifts"].size(), 3u);
    EXPECT_EQ(j["blocks"].size(), 2u);
    // Closed forms of a level seam with one smooth wedge, searched.
    EXPECT_NEAR(j["seams"][0]["factor"].get<double>(), 1.235701938, 1e-9);
    EXPECT_NEAR(j["seams"][0]["alpha_deg"].get<double>(), 13.0894, 1e-3);
    EXPECT_NEAR(j["seams"][0]["factor_without_wedge"].get<double>(), 1.187663694, 1e-9);
    EXPECT_EQ(j["verdict"].get<std::string>().rfind("FAIL on ", 0), 0u) << j["verdict"];
    EXPECT_NE(j["headline"].get<std::string>().find("lift at 20 m by slip"), std::string::npos) << j["headline"];
}

// What governs and what is to be looked at is of the plane that fails, with F and the required F, not their ratio.
TEST_F(PlaneScreen, TheAnswerSpeaksOfThePlaneThatGoverns)
{
    const ProgramAnswer answer = answer_of({"screen", file.string(), "--brief"});
    EXPECT_NE(answer.out.find("governs: lift at 20 m, record ec8, polarity "), std::string::npos) << answer.out;
    EXPECT_NE(answer.out.find("base: record ec8, polarity "), std::string::npos) << answer.out;
    EXPECT_EQ(answer.out.find("look at: friction: "), std::string::npos) << answer.out;
    const auto sentence = [&](const std::string& more, const std::string& friction) {
        std::string text = seam_scene();
        text.replace(text.find("friction = 0.7\n"), 14, "friction = " + friction);
        std::ofstream(file) << text << more;
        return nlohmann::json::parse(answer_of({"screen", file.string(), "--json"}).out);
    };
    const auto judged = sentence("[[combination]]\nname = \"usual\"\nrequired_sliding_factor = 1.5\n[planes]\ngoverns = \"factor\"\n", "0.7");
    const std::string headline = judged["headline"];
    EXPECT_NE(headline.find("lift at 20 m governs by factor of safety (F 1.151, required 1.5 in usual)"),
              std::string::npos)
        << headline;
    EXPECT_NE(headline.find("limit-equilibrium checks of other planes fail."), std::string::npos) << headline;
    EXPECT_NE(judged["verdict"].get<std::string>().find("FAIL on lift at 20 m, clay by factor of safety"), std::string::npos) << judged["verdict"];
    EXPECT_EQ(judged["verdict"].get<std::string>().find("Slip: FAIL"), std::string::npos) << judged["verdict"];
    EXPECT_EQ(sentence("", "0.3")["headline"].get<std::string>().find("The dam slides on clay without any earthquake. On its base it slides "), 0u);
}

/// The sweep slides the same stages by the same function.
TEST_F(PlaneScreen, SweepsThePlane)
{
    const ProgramAnswer screened = answer_of({"screen", file.string(), "--json"});
    const ProgramAnswer swept =
        answer_of({"sweep", file.string(), "--plane", "base,lift at 20 m,clay", "--method", "rigid-v"});
    ASSERT_EQ(swept.code, 0) << swept.talk;
    const CsvTable rows = parse_csv(swept.out.substr(swept.out.find("id,")));
    const auto at = [&](const std::string& key) {
        return std::size_t(std::find(rows.heading.cells.begin(), rows.heading.cells.end(), key) - rows.heading.cells.begin());
    };
    std::map<std::string, double> largest, friction;
    for (const CsvLine& row : rows.rows) {
        if (row.cells.size() < rows.heading.cells.size()) continue;
        double& slip = largest[row.cells[at("plane")]];
        slip = std::max(slip, std::stod(row.cells[at("max_slip_m")]));
        friction[row.cells[at("plane")]] = std::stod(row.cells[at("friction")]);
    }
    ASSERT_EQ(largest.size(), 3u) << swept.out;
    EXPECT_EQ(friction["clay"], 0.7);
    EXPECT_EQ(friction["lift at 20 m"], 0.75);
    for (const auto& plane : nlohmann::json::parse(screened.out)["planes"])
        if (largest.contains(plane["plane"])) {
            EXPECT_EQ(plane["slip_m"].get<double>(), largest[plane["plane"]]) << plane;
        }
    const ProgramAnswer wrong = answer_of({"sweep", file.string(), "--plane", "clai"});
    EXPECT_NE((wrong.talk + wrong.out).find("Did you mean clay?"), std::string::npos) << wrong.talk;
}

/// Finite elements slide on the base and on seams, not on few modes, and have one angle of the wedge.
TEST_F(PlaneScreen, SweepsByFiniteElementsNameWhatTheyDoNotFollow)
{
    const auto said = [&](const std::string& plane, const std::string& method, const std::string& friction) {
        const ProgramAnswer answer =
            answer_of({"sweep", file.string(), "--plane", plane, "--method", method, "--friction", friction});
        EXPECT_EQ(answer.code, 2) << answer.out;
        return answer.talk;
    };
    EXPECT_NE(said("base,lift at 20 m", "rigid,fe", "0.8").find("take \"lift at 20 m\" out"), std::string::npos);
    EXPECT_NE(said("clay", "fe-reduced", "0.8").find("--plane with --method fe-reduced."), std::string::npos);
    const std::string searched = said("base,clay", "rigid,fe", "0.8,0.9");
    EXPECT_NE(searched.find("on \"clay\", whose wedge is searched for."), std::string::npos) << searched;
    EXPECT_NE(searched.find("angle_deg = 25"), std::string::npos) << searched;
}

/// Every lift vibrates with the dam: factor, yield and slip are those of its own motion, in `screen` as in `sweep`.
TEST_F(PlaneScreen, LiftsSlideInTwoSteps)
{
    const auto planes_of = [&](const std::string& keys) {
        std::string text = seam_scene();
        const std::string lifts = "[lifts]\nspacing_m = 20\n", dam = "[dam]\n";
        text.replace(text.find(lifts), lifts.size(), lifts + keys);
        text.replace(text.find(dam), dam.size(), dam + "young_modulus_GPa = 25\n");
        std::ofstream(file) << text;
        const ProgramAnswer answer = answer_of({"screen", file.string(), "--rigid-only", "--json"});
        EXPECT_EQ(answer.code, 0) << answer.talk;
        return nlohmann::json::parse(answer.out);
    };
    const auto still = planes_of(""), modes = planes_of("amplification = \"modes\"\n");
    for (std::size_t i = 0; i < 3; ++i) {
        const auto &a = still["lifts"][i], &b = modes["lifts"][i];
        EXPECT_EQ(a["amplification"], 1.0);
        EXPECT_GT(b["amplification"].get<double>(), 1.3);
        EXPECT_GT(b["joint_peak_m_s2"].get<double>(), a["joint_peak_m_s2"].get<double>());
        EXPECT_LT(b["factor"].get<double>(), a["factor"].get<double>());
        EXPECT_EQ(b["factor_static"], a["factor_static"]);
        EXPECT_GT(b["slip_mm"].get<double>(), a["slip_mm"].get<double>());
    }
    EXPECT_GT(modes["lifts"][2]["amplification"].get<double>(), modes["lifts"][1]["amplification"].get<double>());
    const ProgramAnswer swept = answer_of({"sweep", file.string(), "--plane", "lift at 40 m", "--method", "rigid-v"});
    ASSERT_EQ(swept.code, 0) << swept.talk;
    const CsvTable rows = parse_csv(swept.out.substr(swept.out.find("id,")));
    const auto slip = std::find(rows.heading.cells.begin(), rows.heading.cells.end(), "max_slip_m") - rows.heading.cells.begin();
    double largest = 0.0;
    for (const CsvLine& row : rows.rows)
        if (row.cells.size() == rows.heading.cells.size())
            largest = std::max(largest, std::stod(row.cells[std::size_t(slip)]));
    EXPECT_EQ(largest, modes["planes"][2]["slip_m"].get<double>());
}

TEST_F(PlaneScreen, TheWorstPlaneIsPartOfAnAssessment)
{
    const ProgramAnswer answer = answer_of({"assess", file.string(), "--budget", "1", "--json"});
    const auto j = nlohmann::json::parse(answer.out);
    EXPECT_EQ(j["verdict"], "FAIL");
    EXPECT_NE(j["headline"].get<std::string>().find("FAIL on lift at 20 m"), std::string::npos) << j["headline"];
    ASSERT_FALSE(j["planes"].empty());
    for (const auto& row : j["planes"]) EXPECT_NE(row["governs"], "");
}

TEST_F(PlaneScreen, FragilityDrawsTheFrictionOfAPlane)
{
    const auto answer = [&](const std::string& plane, const std::string& key) {
        std::ofstream(file) << seam_scene() + "[probability]\nseed = 3\nreplicates = 2\nsampling = \"random\"\n"
                                              "[[probability.variable]]\nkey = \"" + key +
                                   "\"\nuniform = { min = 0.6, max = 1.0 }\n"
                                   "[intensity]\nlevels_g = [0.3]\n"
                                   "[[limit]]\nabove_mm = 20\n" + plane;
        return answer_of({"fragility", file.string(), "--samples", "32", "--json"});
    };
    const auto p = [&](const std::string& plane, const std::string& key) {
        const ProgramAnswer a = answer(plane, key);
        EXPECT_EQ(a.code, 0) << a.talk;
        return nlohmann::json::parse(a.out)["probabilities"][0]["probability"].get<double>();
    };
    const double seam = p("plane = \"clay\"\n", "seam[clay].friction"), base = p("", "seam[clay].friction"),
                 any = p("plane = \"any\"\n", "seam[clay].friction"), lifts = p("plane = \"any\"\n", "lifts.friction");
    EXPECT_GT(seam, 0.0);
    EXPECT_LT(seam, 1.0);
    EXPECT_EQ(base, 0.0); // its own friction is 0.9
    EXPECT_GE(any, seam);
    EXPECT_GT(lifts, 0.0);
    const auto refused = [&](const std::string& plane) { return answer(plane, "seam[clay].friction").talk; };
    EXPECT_NE(refused("plane = \"clai\"\n").find("names no plane of the scene"), std::string::npos);
    EXPECT_NE(refused("plane = \"clay\"\n[[limit]]\nabove_mm = 50\n").find("one plane, or any, for all limits"), std::string::npos);
}

/// The key's underside as a level seam with a smooth wedge: T = [μ(W₁ - U₁) + c L]/F + P_p(F).
TEST(KeyedBase, IsAChain)
{
    const ProgramAnswer answer = answer_of({"screen", std::string(source_dir()) + "/examples/keyed_base.toml", "--json"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const auto seam = nlohmann::json::parse(answer.out)["seams"][0];
    const double factor = seam["factor"], alpha = seam["alpha_deg"].get<double>() * 3.14159265358979323846 / 180.0;
    const double water = 9810.0, depth = 2.0, base = 24.0, length = depth / std::sin(alpha), all = base + length;
    // Drains 3 m from the heel, E 0.7: the head there is 0.3 of the linear one, and linear on to the exit.
    const double drain = 3.0, at_drain = 0.3 * 28.0 * (1.0 - drain / all);
    const double at_kink = at_drain * length / (all - drain) + depth;
    const double u1 = 0.5 * water * (drain * (30.0 + at_drain + depth) + (base - drain) * (at_drain + depth + at_kink)),
                 u2 = 0.5 * water * length * at_kink;
    const double w1 = 9.81 * (2400.0 * 0.5 * 30.0 * (4.0 + 24.0) + 2600.0 * base * depth);
    const double w2 = 9.81 * 2600.0 * 0.5 * depth * depth / std::tan(alpha);
    const double phi = std::atan(std::tan(40.0 * 3.14159265358979323846 / 180.0) / factor);
    const double passive = w2 * std::tan(phi + alpha) - u2 * std::sin(phi) / std::cos(phi + alpha);
    EXPECT_NEAR(((0.75 * (w1 - u1) + 30e3 * base) / factor + passive) / (0.5 * water * 30.0 * 30.0), 1.0, 1e-9);
}

TEST(KeyedBase, APolygonWithAKeySaysHowToGoOn)
{
    const auto file = std::filesystem::temp_directory_path() / ("damslip_keyed_base_" + std::to_string(::getpid()) + ".toml");
    std::ofstream(file) << "section = { polygon_m = [[0,0],[6,0],[6,-2],[10,-2],[10,0],[24,0],[4,30],[0,30]] }\n"
                           "dam = { density_kg_m3 = 2400 }\ncontact = { friction = 0.8 }\n";
    const ProgramAnswer answer = answer_of({"screen", file.string()});
    std::filesystem::remove(file);
    EXPECT_NE(answer.talk.find("[[seam]] depth_m = 2  with  [seam.wedge]"), std::string::npos) << answer.talk;
}

} // namespace
