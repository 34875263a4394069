// Modes and tied earthquakes beside a second solver. CalculiX is not at hand, so its part is played by calculix_reader.hpp: it reads
// the deck alone, has elements, equations and superposition of its own, and prints what ccx would. Both then compute the same model
// by different code, and what is put wrong in its answer on purpose has to come out as the difference.
#include "verifier_answer.hpp"
#include "second_solver_scene.hpp"

#include <nlohmann/json.hpp>

namespace damslip::calculix_tests {

namespace {

class SecondSolverLinear : public SecondSolver {};

// Wet on massless rock, dry on a rigid base, and with another law of added mass: seven digits are printed, 1e-7.
TEST_F(SecondSolverLinear, FrequenciesOfTheDeckAreOurs)
{
    BlockScene wet, dry, period;
    dry.rock = dry.water = "";
    period.damping = "[damping]\nratio = 0.05\n"; // of no account here
    for (const BlockScene& scene : {wet, dry, period}) {
        const Ready at = ready(scene);
        const auto rows =
            beside(at, SecondAnalysis::modes, 4, printed_modes(frequencies_of(deck(at, SecondAnalysis::modes), 4)));
        ASSERT_EQ(rows.size(), 4u);
        for (const SecondResult& row : rows) EXPECT_LT(row.difference, 2e-7) << row.what;
    }
}

// The added mass of the water lowers every frequency: without the point masses of the deck they are not those of the wet dam.
TEST_F(SecondSolverLinear, PointMassesAreFelt)
{
    const Ready at = ready({});
    Deck read(deck(at, SecondAnalysis::modes));
    EXPECT_GT(read.masses.size(), 5u);
    for (auto& [node, mass] : read.masses) mass *= 1e-6;
    const double dry = DeckModes{DeckModel(read)}.omega[0] / (2.0 * std::numbers::pi);
    const auto rows = beside(at, SecondAnalysis::modes, 1, printed_modes({dry}));
    EXPECT_LT(rows.at(0).ours, 0.97 * rows.at(0).theirs);
    EXPECT_FALSE(rows.at(0).within());
}

TEST_F(SecondSolverLinear, AFrequencyPutWrongIsTheOneOutside)
{
    const Ready at = ready({});
    std::vector<double> f = frequencies_of(deck(at, SecondAnalysis::modes), 4);
    f[2] *= 1.0 + 3e-4;
    const auto rows = beside(at, SecondAnalysis::modes, 4, printed_modes(f));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].what, fmt::format("frequency, mode {}", i + 1));
        EXPECT_EQ(rows[i].within(), i != 2) << rows[i].what;
    }
    EXPECT_NEAR(rows.at(2).difference, 3e-4 / (1.0 + 3e-4), 2e-7);
}

// All modes, exactly, against ours by Newmark's steps of 1 ms: an error of (omega dt)^2/12 a period, 1e-3 over some ten periods. The
// damping, the signs of both components, and the water's inertia have to be right for it.
TEST_F(SecondSolverLinear, CrestOfTheDeckIsOurs)
{
    const Ready at = ready({});
    const auto rows =
        beside(at, SecondAnalysis::tied, 4, printed_crest(crest_of(deck(at, SecondAnalysis::tied)), 0.01));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_GT(rows[0].ours, 1e-4);
    for (const SecondResult& row : rows) EXPECT_LT(row.difference, 2e-3) << row.what;
}

// Dry, damping of both kinds is allowed; CalculiX damps all mass, and here all mass is the dam's.
TEST_F(SecondSolverLinear, CrestWithMassProportionalDampingIsOurs)
{
    BlockScene dry;
    dry.water = "";
    dry.damping = "[damping]\nratio = 0.05\nmass = \"relative\"\n";
    const Ready at = ready(dry);
    const std::string text = deck(at, SecondAnalysis::tied);
    EXPECT_GT(std::stod(Deck(text).steps.at(1).card("MODAL DAMPING").lines.at(0).at(2)), 0.1); // a_M
    for (const SecondResult& row : beside(at, SecondAnalysis::tied, 4, printed_crest(crest_of(text), 0.01)))
        EXPECT_LT(row.difference, 2e-3) << row.what;
}

// A history that is 2 % too large is outside in both rows, by 2 % of its own peak.
TEST_F(SecondSolverLinear, ACrestPutWrongIsOutsideByAsMuch)
{
    const Ready at = ready({});
    std::vector<double> x = crest_of(deck(at, SecondAnalysis::tied));
    for (double& value : x) value *= 1.02;
    const auto rows = beside(at, SecondAnalysis::tied, 4, printed_crest(x, 0.01));
    for (const SecondResult& row : rows) {
        EXPECT_FALSE(row.within()) << row.what;
        EXPECT_NEAR(row.difference, 0.02 / 1.02, 2e-3) << row.what;
    }
}

// Steps of 1/128 s do not fit into the seven digits of a time: 1.0234375 is printed as 1.023438, later than our row. It is still that
// row: what is wrong there alone has to show.
TEST_F(SecondSolverLinear, TimesRoundedByThePrinterAreFound)
{
    write_record(1.0 / 128.0, 1.25);
    BlockScene scene;
    scene.time = "[time]\nscheme = \"newmark\"\ndt_s = 0.0009765625\n";
    const Ready at = ready(scene);
    std::vector<double> x = crest_of(deck(at, SecondAnalysis::tied));
    const double peak =
        std::abs(*std::max_element(x.begin(), x.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
    std::string right = printed_crest(x, 1.0 / 128.0);
    for (const SecondResult& row : beside(at, SecondAnalysis::tied, 4, right)) EXPECT_TRUE(row.within()) << row.what;
    ASSERT_LT(std::abs(x.at(131)), 0.7 * peak);
    x.at(131) += std::copysign(0.2 * peak, x.at(131));
    const auto rows = beside(at, SecondAnalysis::tied, 4, printed_crest(x, 1.0 / 128.0));
    EXPECT_NEAR(rows.at(1).difference, 0.2, 3e-3);
}

// The whole way of a user: deck by the command, results by the command, exit code 0; 4 with one frequency put wrong.
TEST_F(SecondSolverLinear, TheCommandWritesTheDeckAndComparesTheResults)
{
    const std::string scene = (folder / "block.toml").string(), inp = (folder / "block.inp").string(),
                      dat = (folder / "block.dat").string();
    write_file(scene, BlockScene{}.text());
    const std::vector<std::string> modes{"mesh", scene, "--to", "calculix", "--analysis", "modes", "--modes", "3"};
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> all = modes;
        all.insert(all.end(), more.begin(), more.end());
        return verifier_answer(all);
    };
    const ProgramAnswer written = with({"--out", inp});
    ASSERT_EQ(written.code, 0) << written.talk;
    EXPECT_NE(written.talk.find("written: " + inp + " (CalculiX, modes)"), std::string::npos) << written.talk;
    const std::string text = read_file(inp);
    EXPECT_EQ(text, deck(ready({}), SecondAnalysis::modes, 3));
    std::vector<double> f = frequencies_of(text, 3);
    write_file(dat, printed_modes(f));
    const ProgramAnswer good = with({"--results", dat});
    EXPECT_EQ(good.code, 0) << good.talk;
    EXPECT_NE(good.out.find("Beside CalculiX"), std::string::npos) << good.out;
    f[1] *= 1.001;
    write_file(dat, printed_modes(f));
    const ProgramAnswer bad = with({"--results", dat, "--json"});
    EXPECT_EQ(bad.code, 4);
    const auto rows = nlohmann::json::parse(bad.out)["second_solver"];
    ASSERT_EQ(rows.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(rows[i]["within"], i != 1);
        EXPECT_NEAR(rows[i]["calculix"].get<double>(), f[i], 1e-6 * f[i]);
    }
    EXPECT_NEAR(rows[1]["difference"].get<double>(), 0.001 / 1.001, 1e-6);
}

} // namespace

} // namespace damslip::calculix_tests
