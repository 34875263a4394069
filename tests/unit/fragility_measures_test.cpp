// Measures of intensity and designs of a fragility by the program: a level of any measure is a factor of the one record, so that P is that of the same
// factor by PGA; records as they are follow a line by hand; P over the water level is counted in the table of the runs.
#include "csv_rows.hpp"
#include "pulse_study.hpp"

#include "records/measure/measures.hpp"

#include <nlohmann/json.hpp>

#include <numbers>

namespace damslip {
namespace {

using FragilityMeasures = pulse::Study;
using Json = nlohmann::json;

/// [m/s^2]
std::vector<double> pulse_samples()
{
    std::vector<double> accel(54, 0.0);
    std::fill(accel.begin() + 1, accel.begin() + 52, pulse::accel);
    return accel;
}

double spectral(double period)
{
    const std::vector<double> accel = pulse_samples(), periods{period};
    return records::response_spectrum(accel, pulse::dt, periods, 0.05).points.front().pseudo_acceleration;
}

// PGV and CAV of the pulse by hand: 51 dt A. IA: pi / (2 g) A^2 (50 dt + 2 dt / 3), acceleration linear between samples.
TEST_F(FragilityMeasures, ALevelOfAnyMeasureIsAFactorOfTheRecord)
{
    const std::vector<std::string> size{"--samples", "512", "--conditioning", "off", "--json"};
    const Json modes = Json::parse(answer_of({"modes", scene.string(), "--json"}).out);
    const double first = modes["modes"][0]["period_s"], area = 51 * pulse::dt * pulse::accel;
    const double squared = pulse::accel * pulse::accel * (50.0 + 2.0 / 3.0) * pulse::dt;
    struct Measure {
        const char *name, *unit;
        double of_pulse;
        int power = 1;
    };
    Json by_pga;
    for (const Measure& m : {Measure{"PGA", "m_s2", pulse::accel},
                             {"PGV", "m_s", area},
                             {"CAV", "m_s", area},
                             {"IA", "m_s", std::numbers::pi / (2.0 * 9.80665) * squared, 2},
                             {"SA(0.2)", "m_s2", spectral(0.2)},
                             {"avgSA(0.1,0.2,0.4)", "m_s2", std::cbrt(spectral(0.1) * spectral(0.2) * spectral(0.4))},
                             {"SA(T1)", "m_s2", spectral(first)}}) {
        std::string levels;
        for (const double factor : {0.75, 0.875, 1.0})
            levels += fmt::format("{}{}", levels.empty() ? "" : ", ", m.of_pulse * std::pow(factor, m.power));
        write_scene({.intensity = fmt::format("measure = \"{}\"\nlevels_{} = [{}]\n", m.name, m.unit, levels)});
        const ProgramAnswer answer = fragility(size);
        ASSERT_EQ(answer.code, 0) << answer.talk;
        const Json found = Json::parse(answer.out)["probabilities"];
        ASSERT_EQ(found.size(), 3u) << m.name;
        if (by_pga.is_null()) by_pga = found;
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(found[i]["failures"], by_pga[i]["failures"]) << m.name << i;
    }
    const double p = pulse::probability_by_hand(pulse::accel);
    EXPECT_NEAR(by_pga[2]["probability"].get<double>(), p, 1.0 / 128.0); // replicates of 128 in equal parts of F
}

// The other component is a quarter as strong: the geometric mean of both is half of the first, and so are the levels.
TEST_F(FragilityMeasures, GeometricMeanOfBothComponents)
{
    const std::vector<std::string> size{"--samples", "512", "--conditioning", "off", "--json"};
    const Json alone = Json::parse(fragility(size).out)["probabilities"];
    write_file(folder / "other.csv", pulse::record_text(0.25 * pulse::accel));
    write_file(folder / "pairs.csv", "horizontal,other_horizontal\npulse.csv,other.csv\n");
    write_scene({.intensity = "measure = \"PGA\"\ncomponent = \"geomean\"\nlevels_m_s2 = [1.5, 1.75, 2]\n",
                 .suite = "polarity = \"as-recorded\"\nmax_scale = 4\nfiles = \"pairs.csv\"\n"});
    const ProgramAnswer answer = fragility(size);
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const Json both = Json::parse(answer.out)["probabilities"];
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(both[i]["failures"], alone[i]["failures"]) << i;
    EXPECT_GT(both[2]["failures"].get<double>(), 0.0);
}

TEST_F(FragilityMeasures, RecordsThatCannotServeAreNamed)
{
    write_scene({.suite = "polarity = \"as-recorded\"\nfiles = \"suite/*.AT2\"\n"});
    ProgramAnswer answer = fragility({"--samples", "16"});
    EXPECT_EQ(answer.code, 3);
    EXPECT_NE(answer.talk.find("suite/*.AT2\" names no record."), std::string::npos) << answer.talk;
    std::string still = "# units: m/s2\nt,a\n";
    for (int k = 0; k < 20; ++k) still += fmt::format("{},0\n", k * pulse::dt);
    write_file(folder / "still.csv", still);
    write_file(folder / "two.csv", "horizontal\npulse.csv\nstill.csv\n");
    write_scene({.suite = "polarity = \"as-recorded\"\nfiles = \"two.csv\"\n"});
    answer = fragility({"--samples", "16"});
    EXPECT_EQ(answer.code, 3);
    EXPECT_NE(answer.talk.find("still.csv"), std::string::npos) << answer.talk;
    EXPECT_NE(answer.talk.find("of this record is 0."), std::string::npos) << answer.talk;
}

// Thirty pulses as they are, A from 3 to 6 m/s^2. Every one slides by far more than d_0 = 0.1 mm, so that the truncated fit is the line of least
// squares of ln D over ln A with the residuals' root mean square: by hand from the slips by hand of the frictions that were drawn.
TEST_F(FragilityMeasures, ACloudOfRecordsIsALineByHand)
{
    std::string list = "horizontal\n";
    for (int i = 0; i < 30; ++i) {
        const std::string name = fmt::format("pulse{}.csv", i);
        write_file(folder / name, pulse::record_text(3.0 * std::pow(2.0, i / 29.0)));
        list += name + "\n";
    }
    write_file(folder / "pulses.csv", list);
    write_scene({.intensity = "measure = \"PGA\"\ndesign = \"cloud\"\nlevels_m_s2 = [3, 4, 5]\n",
                 .suite = "polarity = \"as-recorded\"\nfiles = \"pulses.csv\"\n",
                 .variable = "kind = \"aleatory\"\nlognormal = { median = 0.15, beta = 0.3 }\n"});
    const ProgramAnswer answer = fragility({"--samples", "64", "--out", out("cloud"), "--quiet"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const auto runs = csv_rows(bytes("cloud", "samples.csv"));
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    std::vector<std::pair<double, double>> points;
    for (const auto& run : runs) {
        const double plateau = std::stod(run.at("intensity_m_s2")),
                     slip = pulse::slip(std::stod(run.at("mu")), plateau);
        EXPECT_NEAR(std::stod(run.at("slip_mm")), 1e3 * slip, 1e-6 * 1e3 * slip);
        const double x = std::log(plateau), y = std::log(slip);
        points.emplace_back(x, y);
        n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    ASSERT_GE(n, 60.0);
    const double b = (sxy - sx * sy / n) / (sxx - sx * sx / n), a = (sy - b * sx) / n;
    double rest = 0.0;
    for (const auto& [x, y] : points) rest += (y - a - b * x) * (y - a - b * x);
    const double sigma = std::sqrt(rest / n);
    const Json found = Json::parse(bytes("cloud", "summary.json"))["probabilities"];
    ASSERT_EQ(found.size(), 3u);
    for (const Json& row : found) {
        const double x = std::log(row["intensity_m_s2"].get<double>());
        const double p = probability::normal_cdf((a + b * x - std::log(pulse::limit)) / sigma);
        EXPECT_NEAR(row["probability"].get<double>(), p, 1e-6) << x;
    }
    EXPECT_NE(bytes("cloud", "report.html").find("<svg"), std::string::npos);
}

// Runs without an answer, here of a dam that would tip first, are neither survivals nor failures: P lies between both.
TEST_F(FragilityMeasures, ACloudCountsRunsWithoutAnAnswer)
{
    std::string list = "horizontal\n";
    for (int i = 0; i < 30; ++i) {
        const std::string name = fmt::format("pulse{}.csv", i);
        write_file(folder / name, pulse::record_text(10.0 * std::pow(2.0, i / 29.0)));
        list += name + "\n";
    }
    write_file(folder / "pulses.csv", list);
    write_scene({.intensity = "measure = \"PGA\"\ndesign = \"cloud\"\nlevels_m_s2 = [12, 18]\n",
                 .suite = "polarity = \"as-recorded\"\nfiles = \"pulses.csv\"\n",
                 .variable = "kind = \"aleatory\"\nlognormal = { median = 1.2, beta = 0.3 }\n"});
    const ProgramAnswer answer = fragility({"--samples", "128", "--out", out("cloud"), "--quiet"});
    EXPECT_EQ(answer.code, 4) << answer.talk;
    int missing = 0;
    for (const auto& run : csv_rows(bytes("cloud", "samples.csv"))) missing += run.at("status") == "rocks first";
    ASSERT_GT(missing, 10);
    for (const Json& row : Json::parse(bytes("cloud", "summary.json"))["probabilities"]) {
        const double low = row["probability_low"], high = row["probability_high"], p = row["probability"];
        EXPECT_EQ(row["missing"].get<double>(), missing);
        EXPECT_LT(low + 0.05, high);
        EXPECT_NEAR(p, 0.5 * (low + high), 1e-12);
    }
}

// OpenQuake has g, cm/s and g s, whatever the levels of the scene are in; SA(T1) has its period there.
TEST_F(FragilityMeasures, OpenQuakesFileHasItsUnits)
{
    const auto file_of = [&](const std::string& intensity) {
        write_scene({.intensity = intensity});
        const ProgramAnswer answer = fragility({"--samples", "256", "--out", out("nrml"), "--quiet"});
        EXPECT_EQ(answer.code, 0) << answer.talk;
        return bytes("nrml", "fragility.xml");
    };
    const auto number = [](const std::string& text, const std::string& name) {
        return std::stod(text.substr(text.find(name + "=\"") + name.size() + 2));
    };
    const std::string in_m_s2 = file_of("measure = \"PGA\"\nlevels_m_s2 = [2.9419950, 3.432327, 3.92266]\n"),
                      in_g = file_of("measure = \"PGA\"\nlevels_g = [0.3, 0.35, 0.4]\n");
    EXPECT_NEAR(number(in_m_s2, "minIML"), 0.3, 1e-9);
    for (const char* name : {"minIML", "maxIML", "mean", "stddev"})
        EXPECT_NEAR(number(in_m_s2, name), number(in_g, name), 1e-5 * number(in_g, name)) << name;
    EXPECT_NEAR(number(file_of("measure = \"PGV\"\nlevels_m_s = [1.3, 1.5, 1.8]\n"), "minIML"), 130.0, 1e-9);
    const double first = Json::parse(answer_of({"modes", scene.string(), "--json"}).out)["modes"][0]["period_s"];
    const std::string at_first = file_of("measure = \"SA(T1)\"\nlevels_m_s2 = [3, 3.5, 4]\n");
    EXPECT_NEAR(std::stod(at_first.substr(at_first.find("imt=\"SA(") + 8)), first, 1e-3 * first);
}

// Places of usace.json rise in P from what the table of the runs counts: share of the runs at a water level that slide too far.
TEST_F(FragilityMeasures, TheFileOfWaterLevelsIsCountedFromTheRuns)
{
    write_scene({.intensity = "measure = \"PGA\"\nlevels_m_s2 = [3]\n",
                 .more =
                     "[reservoir]\nlevel_m = 20\ndensity_kg_m3 = 1000\n[uplift]\nmodel = \"none\"\n"
                     "[[probability.variable]]\nname = \"level\"\nkey = \"reservoir.level_m\"\nkind = \"aleatory\"\n"
                     "discrete = { values = [10, 20, 30], weights = [1, 1, 1] }\n"});
    const ProgramAnswer answer =
        fragility({"--samples", "256", "--conditioning", "off", "--out", out("levels"), "--quiet"});
    ASSERT_EQ(answer.code, 0) << answer.talk;
    std::map<std::string, std::pair<double, double>> counts; // failures and runs by level
    for (const auto& run : csv_rows(bytes("levels", "samples.csv"))) {
        auto& [failed, all] = counts[run.at("level")];
        failed += run.at("slip_mm").empty() || std::stod(run.at("slip_mm")) > 200.0;
        all += 1.0;
    }
    ASSERT_EQ(counts.size(), 3u);
    const Json file = Json::parse(bytes("levels", "usace.json"));
    ASSERT_EQ(file["locations"].size(), 1u);
    const Json& curve = file["locations"][0]["probability-stage"];
    ASSERT_EQ(curve["xvalues"].size(), curve["ydistributions"].size());
    std::vector<double> counted;
    for (const auto& [level, of] : counts)
        if (of.first > 0.0) counted.push_back(of.first / of.second);
    ASSERT_EQ(curve["xvalues"].size(), counted.size());
    for (std::size_t i = 0; i < counted.size(); ++i) {
        EXPECT_NEAR(curve["xvalues"][i].get<double>(), counted[i], 1e-12);
        const Json& stage = curve["ydistributions"][i]["parameters"];
        EXPECT_LE(stage["min"].get<double>(), stage["mostlikely"].get<double>());
        EXPECT_LE(stage["mostlikely"].get<double>(), stage["max"].get<double>());
    }
}

} // namespace
} // namespace damslip
