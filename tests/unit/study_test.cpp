// `damslip study`: its grid, findings and files on a small dam.
#include "studies/goldgruber_2015/study_findings.hpp"
#include "sweep_scene.hpp"
#include "verifier_answer.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace damslip::sweep_tests {

namespace {

// Steps of 5 mm for a hundredth of friction: 80, 35, 35, 20 and 5 mm from one friction of the study to the next.
TEST(StudyFindings, ProgressiveFromTheFirstSteepStep)
{
    EXPECT_DOUBLE_EQ(study::progressive_from({0, 1, 2, 38, 300, 700}), 0.77);
    EXPECT_DOUBLE_EQ(study::progressive_from({0, 79, 115, 200, 400, 500}), 0.84); // 36 > 35 mm
    EXPECT_DOUBLE_EQ(study::progressive_from({0, 79, 113, 140, 400, 500}),
                     0.70); // 34 and 27 mm are not enough, 260 > 20 mm are
    EXPECT_TRUE(std::isnan(study::progressive_from({0, 0, 0, 1, 2, 3})));
    EXPECT_DOUBLE_EQ(study::progressive_from({0, 1, 2, NAN, NAN, NAN}), 0.77); // slides statically below
}

TEST(StudyFindings, SlipsReadAsNumbers)
{
    EXPECT_EQ(study::slip_list({0.0, 0.0271, 3.04, 41.7, NAN}), "0, 0.027, 3.0, 42, – mm");
}

class Study : public SweepScene {
protected:
    void SetUp() override
    {
        SweepScene::SetUp();
        std::string pulse = "time_s,accel_m_s2\n";
        for (int i = 0; i <= 40; ++i)
            pulse += std::to_string(0.05 * i) + "," + std::to_string(1.5 * std::sin(3.0 * i)) + "\n";
        write("shake.csv", pulse);
        write(
            "dam.toml",
            "[section]\nheight_m = 62.5\nbase_m = 45\ncrest_m = 12\nneck_m = 11\n[dam]\ndensity_kg_m3 = 2500\n"
            "young_modulus_GPa = 25\npoisson_ratio = 0.17\n[foundation]\nyoung_modulus_GPa = 30\npoisson_ratio = 0.2\n"
            "width_m = 300\ndepth_m = 100\nmass = \"massless\"\n[curtain]\ndistance_m = 7\ndepth_m = 30\n"
            "thickness_m = 1\nyoung_modulus_GPa = 27\npoisson_ratio = 0.2\n[reservoir]\nlength_m = 150\n"
            "[contact]\nfriction = 0.84\n[mesh]\nsize_m = 12\ncontact_size_m = 9\n[sliding]\nrun_out_max_s = 1\n"
            "[[motion.record]]\nname = \"shake\"\nhorizontal = \"shake.csv\"\nvertical = \"shake.csv\"\n");
    }
    Answer study(const std::string& out, std::vector<std::string> more) const
    {
        return verifier_answer(
            with({"study", path("dam.toml"), "--out", path(out), "--method", "rigid,rigid-v,fe-whole-steps"}, more));
    }
};

TEST_F(Study, WritesRowsFindingsAndAReport)
{
    const Answer a = study("one", {"--json"});
    ASSERT_TRUE(a.code == 0 || a.code == 4) << a.talk; // a coarse run may still slide when the short run-out ends
    const auto j = nlohmann::json::parse(a.out);
    EXPECT_EQ(j["rows"].size(), 6u * 3 * 3 * 2 * 3);
    EXPECT_EQ(j["modes"]["table_4_3"].size(), 10u);
    EXPECT_EQ(j["settings"].size(), 12u); // six steps, two waters
    EXPECT_EQ(j["findings"].size(), 23u);
    for (const auto& finding : j["findings"]) EXPECT_FALSE(finding["printed"].get<std::string>().empty());

    // Statics alone decide which frictions fail: 0.753 (linear), 0.687 (printed) and 0.647 (seepage, of a coarse mesh here).
    for (const auto& row : j["rows"])
        if (row["method"] == "fe-whole-steps") {
            EXPECT_EQ(row["status"] == "static failure",
                      row["friction"].get<double>() < row["critical_friction"].get<double>());
        }
    const std::string page = content("one/report.html");
    for (const char* figure : {"Figures 4-6 and 4-7", "Figure 4-13", "Figure 4-19", "Tables 4-3 and 4-4"})
        EXPECT_NE(page.find(figure), std::string::npos) << figure;

    // Any number of threads gives the same bytes.
    ASSERT_EQ(study("two", {"--json", "--jobs", "1"}).out, a.out);
    EXPECT_EQ(content("two/report.html"), page);
    EXPECT_EQ(content("two/findings.csv"), content("one/findings.csv"));
}

// Why twice the size slides otherwise: stiffness per length does not know the size, mass grows with its square. With four times the
// moduli of dam, rock, curtain and water all frequencies are those of size 1; weight, water and uplift grow like the mass, so that
// accelerations and with them the slips are the same, whatever the size. To the contact solver's tolerance, 1e-5 at worst here.
TEST_F(Study, TwiceTheSizeWithTheSameFrequenciesSlidesAsFar)
{
    std::string stiff = content("dam.toml");
    for (const auto& [one, four] : {std::pair{"= 25\n", "= 100\n"},
                                    {"= 30\npoisson", "= 120\npoisson"},
                                    {"= 27\n", "= 108\n"},
                                    {"length_m = 150", "length_m = 150\nbulk_modulus_MPa = 8800"}})
        stiff.replace(stiff.find(one), std::string(one).size(), four);
    write("stiff.toml", stiff);
    for (const char* water : {"westergaard", "acoustic"}) {
        const auto slip = [&](const char* scene, const char* size) {
            const Answer a =
                answer_of({"sweep", path(scene), "--friction", "0.7", "--scale", "4", "--uplift", "seepage",
                           "--reservoir", water, "--size", size, "--method", "fe-whole-steps", "--json"});
            return nlohmann::json::parse(a.out)["rows"][0]["slip_m"].get<double>();
        };
        const double small = slip("dam.toml", "1");
        EXPECT_GT(small, 1e-3) << water;
        EXPECT_NEAR(slip("stiff.toml", "2"), small, 1e-4 * small) << water;
        EXPECT_GT(std::abs(slip("dam.toml", "2") - small), 1e-2 * small) << water; // it is the frequencies that matter
    }
}

TEST_F(Study, RefusesADamWithoutCurtain)
{
    const Answer a = verifier_answer({"study", path("block.toml"), "--out", path("none")});
    EXPECT_EQ(a.code, 2);
    for (const char* words : {"block.toml: error: damslip study needs ", "[curtain]", "damslip sweep"})
        EXPECT_NE(a.talk.find(words), std::string::npos) << a.talk;
}

} // namespace

} // namespace damslip::sweep_tests
