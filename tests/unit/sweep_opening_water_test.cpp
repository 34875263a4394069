// Rules for the water in the opening base side by side: each slip is that of `fe` on the scene with this rule, and "apart" the largest less the least.
#include "sweep_scene.hpp"

#include "core/file.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace damslip::sweep_tests {
namespace {

using Json = nlohmann::json;

TEST_F(SweepScene, RulesForOpeningWaterAreRunsOfFe)
{
    std::string tall = content("block.toml"); // opens at its heel
    tall.replace(tall.find("[8, 0], [8, 2], [0, 2]"), 22, "[4, 0], [4, 6], [0, 6]");
    tall.replace(tall.find("level_m = 1"), 11, "level_m = 4");
    tall.replace(tall.find("friction = 0.1"), 14, "friction = 0.6");
    write("block.toml", tall);
    write("pulse.csv", "time_s,accel_m_s2\n0,0\n0.1,5\n0.2,5\n0.3,5\n0.4,-4\n0.5,0\n0.6,0\n");
    const Answer answer =
        sweep({"--opening-water", "unchanged,zero,full", "--method", "fe", "--friction", "0.6,0.65", "--record",
               path("pulse.csv"), "--polarity", "1", "--out", path("rules.csv"), "--json"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const Json lines = Json::parse(answer.out)["opening_water"];
    ASSERT_EQ(lines.size(), 2u);
    const std::string text = content("block.toml");
    for (const Json& line : lines) {
        double least = HUGE_VAL, most = 0.0;
        for (const std::string rule : {"unchanged", "zero", "full"}) {
            std::string one = text;
            one.replace(one.find("model = \"linear\"\n"), 17, "model = \"linear\"\nopening = \"" + rule + "\"\n");
            write("one.toml", one);
            const Answer run =
                answer_of({"fe", path("one.toml"), "--friction", std::to_string(line["friction"].get<double>()),
                           "--record", path("pulse.csv"), "--polarity", "1", "--json", "--quiet"});
            ASSERT_EQ(run.code, 0) << run.talk;
            const double slip = std::abs(Json::parse(run.out)["runs"][0]["max_slip_m"].get<double>()) * 1e3;
            EXPECT_NEAR(line[rule + "_mm"].get<double>(), slip, 1e-9 * slip) << rule;
            EXPECT_GT(slip, 1.0);
            least = std::min(least, slip);
            most = std::max(most, slip);
        }
        EXPECT_GT(most - least, 0.01 * most) << "the rules say the same";
        EXPECT_NEAR(line["apart_mm"].get<double>(), most - least, 1e-6 * most);
    }
    EXPECT_NE(content("rules.html").find("Water in the opening base"), std::string::npos);
}

} // namespace
} // namespace damslip::sweep_tests
