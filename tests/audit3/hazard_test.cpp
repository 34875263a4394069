// Fragility, hazard curves and target spectra: what the third audit found misleading. The block of pulse_study.hpp: P by hand.
#include "pulse_study.hpp"

#include "analysis/fragility/fragility_estimate.hpp"
#include "analysis/fragility/hazard_file.hpp"
#include "core/input_error.hpp"
#include "records/generate/wavelet_match.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace damslip {
namespace {

using Json = nlohmann::json;

class Audit3Hazard : public pulse::Study {
protected:
    /// The block at these levels, under a hazard curve of PGA in m/s2 of four points: 0.02, 1e-3, 2e-5, 1e-7 per year at 0.5, 2, 3.5, 8.
    void write_hazard(const std::string& levels, const std::string& more = "") const
    {
        write_file(folder / "h.csv", "pga_m_s2,annual_rate\n0.5,0.02\n2,1e-3\n3.5,2e-5\n8,1e-7\n");
        write_scene({.intensity = fmt::format("measure = \"PGA\"\nlevels_m_s2 = [{}]\n", levels),
                     .more = "[hazard]\ncurve = \"h.csv\"\n" + more});
    }
    struct Rates {
        double lower, upper;
        std::string sentence; ///< of the limit
    };
    Rates rates() const
    {
        const ProgramAnswer answer = fragility({"--samples", "256", "--conditioning", "off", "--out", out("rates")});
        EXPECT_EQ(answer.code, 0) << answer.talk;
        const Json row = Json::parse(bytes("rates", "summary.json"))["rates"][0];
        const std::size_t at = answer.out.rfind("slip > 200 mm");
        return {row["rate_lower"], row["rate_upper"], answer.out.substr(at, answer.out.find('\n', at) - at)};
    }
};

/// H log-log between the points of write_hazard().
double hazard(double x)
{
    const probability::HazardCurve curve({0.5, 2.0, 3.5, 8.0}, {0.02, 1e-3, 2e-5, 1e-7});
    return curve.rate_at(x);
}

// Below the lowest level P lies between 0 and P there, above the highest between P there and 1: the range holds what finer levels find. All fail at
// the lowest level: everything between its own tail and the curve's first rate is possible. An own rate of all earthquakes reaches further down.
TEST_F(Audit3Hazard, A4_WhatLiesOutsideTheLevelsIsBoundedByTheHazardCurve)
{
    write_hazard("3, 3.2, 3.4, 3.6, 3.8, 4, 4.5, 5, 6, 8");
    const Rates wide = rates();
    write_hazard("4, 5, 6, 8");
    const Rates part = rates();
    EXPECT_LT(part.lower, wide.lower);
    EXPECT_GT(part.upper, wide.upper);
    const double p4 = pulse::probability_by_hand(4.0); // at the lowest level, at least
    EXPECT_NEAR(part.upper - part.lower, p4 * (0.02 - hazard(4.0)), 0.03 * 0.02);
    EXPECT_NE(part.sentence.find(
                  fmt::format("{:.3g} to {:.3g} per year by earthquakes above 0.5 m/s2", part.lower, part.upper)),
              std::string::npos)
        << part.sentence;

    write_hazard("7, 8"); // P = 1 at both
    const Rates fail = rates();
    EXPECT_NEAR(fail.lower, hazard(7.0), 1e-12);
    EXPECT_NEAR(fail.upper, 0.02, 1e-12);
    write_hazard("7, 8", "all_events = 0.5\n");
    const Rates all = rates();
    EXPECT_NEAR(all.upper, 0.5, 1e-12);
    EXPECT_EQ(all.sentence.find("earthquakes above"), std::string::npos) << all.sentence;

    write_hazard("2, 3"); // hardly any fails: all but the tail is known
    const Rates low = rates();
    EXPECT_NEAR(low.upper - low.lower, hazard(3.0), 0.02 * hazard(3.0));
}

// Shares that fall from level to level by more than the draws explain: nothing is claimed of what lies outside.
TEST_F(Audit3Hazard, A4_OfSharesThatFallNothingIsClaimedOutside)
{
    const probability::HazardCurve curve({0.1, 1.0}, {1e-2, 1e-4});
    const std::vector<double> x{0.3, 0.6}, p{0.5, 0.1};
    const probability::AnnualRate growing = probability::annual_rate(curve, x, p),
                                  not_growing = probability::annual_rate(curve, x, p, {}, false);
    EXPECT_DOUBLE_EQ(growing.below_upper, 0.5 * (1e-2 - curve.rate_at(0.3)));
    EXPECT_DOUBLE_EQ(not_growing.below_upper, 1e-2 - curve.rate_at(0.3));
    EXPECT_DOUBLE_EQ(growing.above_lower, 0.1 * curve.rate_at(0.6));
    EXPECT_EQ(not_growing.above_lower, 0.0);
    EXPECT_EQ(not_growing.above_upper, growing.above_upper);
}

/// D > 1 m where z_e + 0.8 z_i > -c, z_e of the epistemic and z_i of the aleatory variable: P = Phi(c / sqrt(1.64)).
FragilityRuns runs_by_hand(const FragilityPlan& plan, double c)
{
    FragilityRuns runs = no_runs(plan, plan.samples.size());
    for (std::size_t id = 0; id < plan.samples.size(); ++id) {
        const FragilityDraw draw = plan.draws[plan.samples[id].draw];
        const auto z = [&](std::size_t v) { return std::log(std::get<double>(draw.values[v])) / 0.2; };
        FinishedRow row;
        row.id = id;
        row.results.status = word(Status::at_rest);
        row.results.slip = row.results.max_slip = std::exp(z(0) + 0.8 * z(1) + c);
        runs.rows.put(row);
    }
    return runs;
}

FragilityPlan plan_of_both_kinds(std::uint64_t seed, std::size_t samples)
{
    FragilityInput input;
    input.probability.seed = seed;
    input.probability.sampling = SamplingInput::random;
    input.probability.replicates = 1;
    input.probability.variables = {pulse::lognormal("e", "contact.friction", 1.0, 0.2, VariableKind::epistemic),
                                   pulse::lognormal("i", "dam.density_kg_m3", 1.0, 0.2)};
    input.intensity.levels = {pulse::accel};
    input.limits = {{LimitQuantity::slip, 1.0, "slip"}};
    static const SceneText text = pulse::scene();
    static const ShakingSuite suite = pulse::suite(text);
    return plan_fragility(input, suite, {samples, 0}, text.file(), [](const std::string&) { return 1.0; });
}

// All epistemic draws share the inner ones: their runs are no independent trials. 400 seeds, exact P 0.53058: 93 to 98 % of the intervals of 95 % hold
// it; counted run by run (Wilson) half of them would.
TEST_F(Audit3Hazard, A15_IntervalsOfOneReplicateHoldTheExactProbability)
{
    const double exact = 0.53058, c = probability::normal_quantile(exact) * std::sqrt(1.64);
    int held = 0, by_runs = 0;
    constexpr int seeds = 400;
    for (int seed = 1; seed <= seeds; ++seed) {
        const FragilityPlan plan = plan_of_both_kinds(static_cast<std::uint64_t>(seed), 900);
        const FragilityRuns runs = runs_by_hand(plan, c);
        const LevelEstimate level = estimate_fragility(plan, runs, nullptr, {}).limits.front().levels.front();
        held += level.sampling.contains(exact);
        by_runs += probability::wilson(level.z, level.n).contains(exact);
    }
    EXPECT_GE(held, 0.93 * seeds);
    EXPECT_LE(held, 0.98 * seeds);
    EXPECT_LT(by_runs, 0.6 * seeds);
}

TEST_F(Audit3Hazard, A15_MoreSamplesAreMoreDrawsOfBothKinds)
{
    EXPECT_EQ(plan_of_both_kinds(1, 128).inner, 16u);
    const FragilityPlan plan = plan_of_both_kinds(1, 65'536);
    EXPECT_EQ(plan.inner, 256u);
    EXPECT_EQ(plan.outer, 256u);
}

const char* const points = "0.01,0.02\n0.1,1e-3\n0.5,2e-5\n2,1e-7\n"; // in g, per year

HazardWish wish_of(const std::string& measure = "PGA")
{
    HazardWish wish;
    wish.measure = *parse_intensity(measure);
    wish.level_unit = 9.80665;
    wish.level_unit_text = "g";
    return wish;
}

struct Refusal {
    std::string problem, fix;
};
Refusal refusal(const std::string& text, const HazardWish& wish, const std::string& file = "h.csv")
{
    try {
        (void)parse_hazard_file(text, file, wish);
    } catch (const InputError& error) {
        return {error.diagnostics().front().problem, error.diagnostics().front().fix};
    }
    return {"no error", ""};
}

// The same curve in many words: 1e-3 per year at 0.1 g.
TEST_F(Audit3Hazard, B2_HeadingsSayMeasureUnitAndKind)
{
    struct File {
        std::string text;
        std::string measure = "PGA";
    };
    const std::string in_m_s2 = "0.0980665,0.02\n0.980665,1e-3\n4.903325,2e-5\n19.6133,1e-7\n";
    std::string gal = in_m_s2, poe, annual, period;
    for (const auto& [x, h] : {std::pair{0.01, 0.02}, {0.1, 1e-3}, {0.5, 2e-5}, {2.0, 1e-7}}) {
        poe += fmt::format("{},{:.17g}\n", x, -std::expm1(-50.0 * h));
        annual += fmt::format("{},{:.17g}\n", x, -std::expm1(-h));
        period += fmt::format("{},{:.17g}\n", 100.0 * x, 1.0 / h);
    }
    const std::string nrml =
        "<?xml version=\"1.0\"?>\n<nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\"><hazardCurves IMT=\"SA\" "
        "saPeriod=\"0.5\" investigationTime=\"50.0\"><IMLs>0.01\n0.1 0.5</IMLs><hazardCurve><gml:Point><gml:pos>10 "
        "45</gml:pos></gml:Point><poEs>0.63212055882855767 0.048770575499285991 "
        "0.00099950016662500845</poEs></hazardCurve></hazardCurves></nrml>";
    const std::string usgs =
        "{\"status\":\"success\",\"response\":[{\"metadata\":{\"imt\":{\"value\":\"SA0P5\"},\"xlabel\":\"Ground Motion "
        "(g)\",\"ylabel\":\"Annual Frequency of Exceedence\",\"xvalues\":[0.01,0.1,0.5]},"
        "\"data\":[{\"component\":\"Total\",\"yvalues\":[0.02,0.001,0.00002]}]}]}";
    const std::string usgs_new =
        "{\"response\":{\"hazardCurves\":[{\"imt\":{\"value\":\"PGA\"},\"data\":["
        "{\"component\":\"Fault\",\"values\":{\"xs\":[1],\"ys\":[1]}},"
        "{\"component\":\"Total\",\"values\":{\"xs\":[0.01,0.1,0.5],\"ys\":[0.02,0.001,0.00002]}}]}]}}";
    for (const File& file :
         {File{"pga_g,annual_rate\n" + std::string(points)},
          {"PGA [m/s2],mean annual rate of exceedance\n" + in_m_s2},
          {"Peak ground acceleration (m/s²);AFE\n0,0980665;0,02\n0,980665;0,001\n4,903325;0,00002\n"},
          {"Sa(0.5s) [g]\trate\n0.01\t0.02\n0.1\t1e-3\n0.5\t2e-5\n", "SA(0.5)"},
          {"psa_0.5_g,annual_rate\n" + std::string(points), "SA(0.5)"},
          {"pga_g,poe_50_years\n" + poe},
          {"# investigation_time=50\npga_g,probability of exceedance\n" + poe},
          {"pga_g,annual probability of exceedance\n" + annual},
          {"PGA [%g],return period (years)\n" + period},
          {"lambda,pga_g\n0.02,0.01\n1e-3,0.1\n2e-5,0.5\n"},
          {"pga_g,SA(0.5)_g,rate\n0.5,0.01,0.02\n1,0.1,1e-3\n3,0.5,2e-5\n", "SA(0.5)"},
          {"# investigation_time=50\nimt,iml,poe\nPGA,0.01,0.63212055882855767\nPGA,0.1,0.048770575499285991\n"
           "SA(1.0),0.01,0.5\nSA(1.0),0.1,0.02\n"},
          {nrml, "SA(0.5)"},
          {usgs, "SA(0.5)"},
          {usgs_new}}) {
        const HazardFile read = parse_hazard_file(file.text, "h.csv", wish_of(file.measure));
        EXPECT_NEAR(read.curve.rate_at(0.1 * 9.80665), 1e-3, 1e-12) << file.text;
        EXPECT_NEAR(read.curve.rate().front(), 0.02, 1e-12) << file.text;
    }
    // SA(T1): of the file's period within 5 %, with a note.
    HazardWish first = wish_of("SA(T1)");
    first.first_period = 0.51;
    EXPECT_EQ(parse_hazard_file("sa(0.5)_g,rate\n" + std::string(points), "h.csv", first).notes.size(), 1u);
    first.first_period = 0.6;
    EXPECT_NE(refusal("sa(0.5)_g,rate\n" + std::string(points), first).problem.find("T1 = 0.6 s"), std::string::npos);
    // What the file does not say is taken for granted with a note.
    EXPECT_EQ(parse_hazard_file("im,rate\n" + std::string(points), "h.csv", wish_of()).notes.size(), 2u);
}

TEST_F(Audit3Hazard, B2_WhatIsNotKnownOrContradictsIsRefusedWithAWayOut)
{
    const auto expect_refused = [](const std::string& text, const std::string& problem, const std::string& fix) {
        const Refusal said = refusal(text, wish_of());
        EXPECT_EQ(said.problem, problem) << text;
        EXPECT_NE(said.fix.find(fix), std::string::npos) << said.fix;
    };
    const std::string rows = points;
    expect_refused("a,annual_rate\n" + rows, "the heading \"a\" is not known.", "pga_g,annual_rate");
    expect_refused("pga_g,value\n" + rows, "the heading \"value\" is not known.", "pga_g,annual_rate");
    expect_refused("ln_pga,rate\n" + rows, "the heading \"ln_pga\" is not known.", "pga_g,annual_rate");
    expect_refused("pga_g,rate_84\n" + rows, "the heading \"rate_84\" is not known.", "pga_g,annual_rate");
    expect_refused("Sa(0.5s) [g],rate\n" + rows, "the hazard curve is of SA(0.5), the levels are of PGA.",
                   "change intensity.measure");
    expect_refused("pga_cm_s,rate\n" + rows, "PGA in cm/s.", "correct the heading");
    expect_refused("# imt='PGV'\npga_g,rate\n" + rows, "the heading \"pga_g\" is of PGA, the file says PGV.",
                   "correct one of them");
    expect_refused("imt,iml,poe\nPGA,0.01,0.6\nPGA,0.1,0.04\n",
                   "probabilities of exceedance without the time they are of.", "# investigation_time=50");
    expect_refused("pga_g,poe_50\n0.01,60\n0.1,4\n", "poe = 60 at 0.01 g.", "divide per cent by 100");
    expect_refused("pga_g,rate,return_period\n0.01,1,1\n", "\"rate\" and \"return_period\" are the same.", "delete");
    expect_refused(rows, "the first line holds numbers.", "pga_g,annual_rate");
    expect_refused("{\"a\":1}", "this JSON has no hazard curves as the USGS web services write them.",
                   "pga_g,annual_rate");
    expect_refused("<a/>", "this XML has no hazardCurves with IMLs and poEs.", "pga_g,annual_rate");
}

// poe = 1 tells no rate: such points are passed over. Of several sites one is chosen, and the message's own fix does it.
TEST_F(Audit3Hazard, B2_SeveralSitesAndCertainPoints)
{
    const std::string head = "#,,,,,\"generated_by='engine', investigation_time=50.0, imt='PGA'\"\n"
                             "lon,lat,depth,poe-0.005,poe-0.01,poe-0.1,poe-2\n";
    const HazardFile one = parse_hazard_file(head + "10,45,0,1,0.632121,0.0487706,0\n", "h.csv", wish_of());
    EXPECT_NEAR(one.curve.rate().front(), 0.02, 1e-7);
    EXPECT_EQ(one.curve.x().size(), 2u);
    EXPECT_EQ(one.notes.size(), 3u);
    const std::string two = head + "10,45,0,1,0.632121,0.0487706,0\n11,45,0,1,0.5,0.02,0\n";
    EXPECT_EQ(refusal(two, wish_of()).problem, "the file has 2 sites.");
    EXPECT_EQ(refusal(two, wish_of()).fix, "write in [hazard]  site = [10, 45]");
    HazardWish wish = wish_of();
    wish.site = {11.0, 45.0};
    EXPECT_NEAR(parse_hazard_file(two, "h.csv", wish).curve.rate().front(), std::log(2.0) / 50.0, 1e-12);
    wish.site = {11.3, 45.0};
    EXPECT_EQ(refusal(two, wish).fix, "the nearest is  site = [11, 45]");
}

// The whole way: a curve in m/s2, and the site of the scene.
TEST_F(Audit3Hazard, B2_AHazardCurveInOtherUnitsGivesTheSameRate)
{
    write_hazard("3, 4, 5, 6");
    const double si = rates().lower;
    write_file(folder / "h.csv",
               fmt::format("PGA [g],return_period\n{:.17g},50\n{:.17g},1e3\n{:.17g},5e4\n{:.17g},1e7\n", 0.5 / 9.80665,
                           2 / 9.80665, 3.5 / 9.80665, 8 / 9.80665));
    EXPECT_NEAR(rates().lower, si, 1e-12);
    write_hazard("3, 4, 5, 6", "site = [14.5, 46.05]\n");
    EXPECT_NE(fragility({"--samples", "64"}).out.find("hazard.site is not used"), std::string::npos);
    write_hazard("3, 4, 5, 6", "site = [14.5, 146]\n");
    const ProgramAnswer refused = fragility({"--samples", "64"});
    EXPECT_EQ(refused.code, 3);
    EXPECT_NE(refused.talk.find("hazard.site is not allowed."), std::string::npos) << refused.talk;
}

// A target spectrum in other words: the same shape; a velocity spectrum is no spectrum of accelerations.
TEST_F(Audit3Hazard, B2_TargetSpectraSayPeriodOrFrequency)
{
    const auto shape = [](const std::string& text) {
        return records::parse_target_spectrum(text, "s.csv").amplification;
    };
    const auto by_period = shape("period_s,sa_g\n0.01,0.2\n0.1,0.5\n0.5,0.4\n2.5,0.1\n");
    for (const std::string text :
         {"# of a code\nfrequency_hz,psa_m_s2\n0.4,0.1\n2,0.4\n10,0.5\n100,0.2\n",
          "f [Hz];Sa [%g]\n100;20,0\n10;50,0\n2;40,0\n0,4;10,0\n",
          "T [ms]\tSa (gal)\n10\t200\n100\t500\n500\t400\n2500\t100\n",
          "sa_g,period_s\n0.2,0.01\n0.5,0.1\n0.4,0.5\n0.1,2.5\n", "0.01 0.2\n0.1 0.5\n0.5 0.4\n2.5 0.1\n"}) {
        const auto other = shape(text);
        for (const double t : {0.02, 0.1, 0.3, 1.0}) EXPECT_NEAR(other(t), by_period(t), 1e-12) << text << t;
    }
    for (const std::string heading : {"period_s,psv_cm_s", "x,y", "T,Sd", "period_s,period_s", "frequency,velocity"})
        EXPECT_THROW((void)shape(heading + "\n0.01,0.2\n0.1,0.5\n2.5,0.1\n"), InputError) << heading;
}

// The headline says whose answer it is: a rigid block bounds no elastic dam.
TEST_F(Audit3Hazard, A5_TheHeadlineNamesTheMethod)
{
    const ProgramAnswer block = fragility({"--samples", "64", "--out", out("a5")});
    EXPECT_NE(block.out.find("by the rigid block: no bound for an elastic dam\n"), std::string::npos) << block.out;
    EXPECT_NE(bytes("a5", "report.html").find("; by the rigid block: no bound for an elastic dam."), std::string::npos);
    const ProgramAnswer elements =
        fragility({"--method", "fe", "--samples", "16", "--conditioning", "off", "--out", out("a5fe")});
    EXPECT_NE(elements.out.find("by finite elements\n"), std::string::npos) << elements.out;
    EXPECT_EQ(bytes("a5fe", "report.html").find("no bound for an elastic dam"), std::string::npos);
}

// The page says what its numbers hold for; a table for each limit, its columns without those of missing runs where none is missing. Files keep one table.
TEST_F(Audit3Hazard, C_ThePageHasLimitsOfValidityAndATableForEachLimit)
{
    write_scene({.more = "[[limit]]\nquantity = \"slip\"\nabove_mm = 50\n"});
    const ProgramAnswer answer = fragility({"--samples", "64", "--out", out("c")});
    const std::string page = bytes("c", "report.html");
    EXPECT_NE(page.find("Limits of validity"), std::string::npos);
    for (const char* title : {"Probabilities: slip &gt; 200 mm", "Probabilities: slip &gt; 50 mm"})
        EXPECT_NE(page.find(title), std::string::npos) << title;
    EXPECT_EQ(answer.out.find("missing survive"), std::string::npos) << answer.out;
    std::istringstream lines(answer.out);
    for (std::string line; std::getline(lines, line);) {
        std::size_t width = 0;
        for (const char c : line) width += (static_cast<unsigned char>(c) & 0xC0) != 0x80; // characters of UTF-8
        EXPECT_LE(width, 110u) << line;
    }
    EXPECT_EQ(bytes("c", "fragility.csv").find("limit,intensity_m_s2,probability,") == std::string::npos, false);
    const std::string page_of_elements = [&] {
        fragility({"--method", "fe", "--samples", "16", "--conditioning", "off", "--out", out("cfe")});
        return bytes("cfe", "report.html");
    }();
    EXPECT_NE(page_of_elements.find("concrete and rock are linear elastic"), std::string::npos);
}

TEST_F(Audit3Hazard, C_TheReportIsPrintedByMergeNotByAPart)
{
    const std::string pdf = (folder / "f.pdf").string();
    const ProgramAnswer part = fragility({"--out", out("p"), "--shard", "0/2", "--pdf", pdf});
    EXPECT_EQ(part.code, 2);
    EXPECT_NE(part.talk.find("--pdf together with --shard."), std::string::npos) << part.talk;
    const std::string help = answer_of({"fragility", "--help"}).out;
    EXPECT_NE(help.find("--pdf"), std::string::npos);
    EXPECT_NE(help.find("examples/fragility/dam.toml"), std::string::npos) << help;
}

// A variable's name is a heading of samples.csv: no formula for a spreadsheet. A title with a control character leaves the XML well-formed.
TEST_F(Audit3Hazard, D9_NamesAreNoFormulasAndNoControlCharactersInFiles)
{
    std::string text = read_file(scene);
    const auto put = [&text](const std::string& old, const std::string& instead) {
        ASSERT_NE(text.find(old), std::string::npos) << old;
        text.replace(text.find(old), old.size(), instead);
    };
    put("title = \"block\"", "title = \"bl\\u001bock & <dam>\"");
    put("name = \"mu\"", "name = \"=1+\\u00071,x\"");
    write_file(scene, text);
    ASSERT_EQ(fragility({"--samples", "64", "--out", out("d9")}).code, 0);
    const std::string samples = bytes("d9", "samples.csv");
    EXPECT_NE(samples.find(",\"'=1+␇1,x\","), std::string::npos) << samples.substr(0, 400);
    const std::string xml = bytes("d9", "fragility.xml");
    EXPECT_NE(xml.find("<description>bl␛ock &amp; &lt;dam&gt;</description>"), std::string::npos) << xml;
    EXPECT_TRUE(std::none_of(xml.begin(), xml.end(),
                             [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t'; }));
}

} // namespace
} // namespace damslip
