// Records selected and scaled to a target, and matched to it.
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "program_answer.hpp"
#include "records/generate/generate.hpp"
#include "records/generate/wavelet_match.hpp"
#include "records/measure/measures.hpp"
#include "records/read/read_record.hpp"
#include "records/suite/suite.hpp"
#include "source_dir.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numeric>
#include <unistd.h>

namespace damslip {

namespace {

using namespace records;

/// ln of the target plus residuals.
SuiteCandidate candidate_of(const std::string& event, const std::vector<double>& log_target,
                            const std::vector<double>& residual)
{
    SuiteCandidate c{event, log_target};
    for (std::size_t k = 0; k < residual.size(); ++k) c.log_spectrum[k] += residual[k];
    return c;
}

const std::vector<double> three_periods{0.3, 0.9, -0.4}; // ln S_a of a target

TEST(RecordSuite, a_record_of_the_targets_shape_is_scaled_onto_it)
{
    const SuiteCandidate c = candidate_of("a", three_periods, std::vector<double>(3, std::log(0.4)));
    const ChosenRecord chosen = scaled_to_target(c, three_periods, 4.0);
    EXPECT_NEAR(chosen.factor, 2.5, 1e-14);
    EXPECT_NEAR(chosen.misfit, 0.0, 1e-14);
    EXPECT_FALSE(chosen.at_limit);
    const ChosenRecord limited = scaled_to_target(c, three_periods, 2.0);
    EXPECT_NEAR(limited.factor, 2.0, 1e-14);
    EXPECT_NEAR(limited.misfit, std::log(1.25), 1e-14); // what the factor leaves, at every period
    EXPECT_TRUE(limited.at_limit);
}

TEST(RecordSuite, spectra_of_other_periods_are_refused)
{
    const SuiteCandidate c{"a", {0.1, 0.2}};
    EXPECT_THROW(scaled_to_target(c, three_periods, 4.0), InputError);
    EXPECT_THROW(scaled_to_target(SuiteCandidate{"a", {}}, {}, 4.0), InputError);
}

TEST(RecordSuite, the_factor_is_the_least_squares_of_the_logarithms)
{
    const SuiteCandidate c = candidate_of("a", three_periods, {0.3, -0.6, 0.0});
    const ChosenRecord chosen = scaled_to_target(c, three_periods, 4.0);
    EXPECT_NEAR(std::log(chosen.factor), 0.1, 1e-14);
    EXPECT_NEAR(chosen.misfit, std::sqrt((0.16 + 0.25 + 0.01) / 3.0), 1e-14);
}

// a and b are off by the same in opposite ways: their mean is the target. c is nearer to it than either, but alone.
TEST(RecordSuite, a_mean_that_fits_counts_as_much_as_records_that_do)
{
    const std::vector<SuiteCandidate> candidates{candidate_of("a", three_periods, {0.2, -0.2, 0.0}),
                                                 candidate_of("b", three_periods, {-0.2, 0.2, 0.0}),
                                                 candidate_of("c", three_periods, {0.18, -0.18, 0.0})};
    const SuiteSelection pair = select_suite(candidates, three_periods, {.select = 2});
    ASSERT_EQ(pair.chosen.size(), 2u);
    // a + b: mean 0, each 0.08/3. b + c: mean (0.01, -0.01)^2, own (0.08 + 0.0648)/6: smaller
    EXPECT_EQ(pair.chosen[0].record, 1u);
    EXPECT_EQ(pair.chosen[1].record, 2u);
    EXPECT_NEAR(pair.mean_misfit, std::sqrt(2.0 * 0.01 * 0.01 / 3.0), 1e-14);
    EXPECT_NEAR(pair.single_misfit, std::sqrt((0.08 + 0.0648) / 6.0), 1e-14);
    EXPECT_TRUE(pair.exhaustive);
    EXPECT_EQ(select_suite(candidates, three_periods, {.select = 1}).chosen[0].record, 2u);
}

TEST(RecordSuite, components_of_one_event_are_not_both_taken)
{
    const std::vector<SuiteCandidate> candidates{candidate_of("a", three_periods, {0.1, -0.1, 0.0}),
                                                 candidate_of("a", three_periods, {-0.1, 0.1, 0.0}),
                                                 candidate_of("b", three_periods, {0.9, -0.9, 0.0})};
    for (const std::size_t most : {std::size_t{200'000}, std::size_t{0}}) { // all sets, step by step
        const SuiteSelection s = select_suite(candidates, three_periods, {.select = 2, .most_subsets = most});
        EXPECT_EQ(s.exhaustive, most > 0);
        EXPECT_EQ(s.chosen[0].record, 1u); // turns the other way than b
        EXPECT_EQ(s.chosen[1].record, 2u);
    }
    EXPECT_THROW(select_suite(candidates, three_periods, {.select = 3}), InputError);
    EXPECT_THROW(select_suite(candidates, three_periods, {.select = 0}), InputError);
    EXPECT_THROW(select_suite(candidates, three_periods, {.select = 1, .max_scale = 0.5}), InputError);
}

TEST(RecordSuite, step_by_step_comes_near_to_all_sets)
{
    std::vector<SuiteCandidate> candidates;
    for (int i = 0; i < 14; ++i)
        candidates.push_back(candidate_of(std::to_string(i), three_periods,
                                          {0.5 * std::sin(7.0 * i), 0.5 * std::sin(3.0 * i + 1.0), 0.0}));
    const auto objective = [](const SuiteSelection& s) {
        return s.mean_misfit * s.mean_misfit + s.single_misfit * s.single_misfit;
    };
    const SuiteSelection all = select_suite(candidates, three_periods, {.select = 5});
    const SuiteSelection steps = select_suite(candidates, three_periods, {.select = 5, .most_subsets = 0});
    EXPECT_GE(objective(steps), objective(all) * (1.0 - 1e-12));
    EXPECT_LE(objective(steps), 1.1 * objective(all)); // a local optimum: no exchange of one record helps
    std::vector<SuiteCandidate> turned = candidates;   // the order of the files is no argument
    std::reverse(turned.begin(), turned.end());
    EXPECT_NEAR(objective(select_suite(turned, three_periods, {.select = 5})), objective(all), 1e-14);
}

TEST(RecordSuite, of_a_pga_those_that_need_least_scaling)
{
    const std::vector<double> target{std::log(2.0)};
    std::vector<SuiteCandidate> candidates;
    for (const double pga : {0.3, 1.9, 5.0, 2.5, 30.0}) candidates.push_back({std::to_string(pga), {std::log(pga)}});
    const SuiteSelection s = select_suite(candidates, target, {.select = 2, .least_scaling = true});
    EXPECT_EQ(s.chosen[0].record, 1u);
    EXPECT_EQ(s.chosen[1].record, 3u);
    EXPECT_NEAR(s.chosen[1].factor, 0.8, 1e-14);
    EXPECT_NEAR(s.single_misfit, 0.0, 1e-14);
}

double alikeness(const std::vector<double>& a, const std::vector<double>& b)
{
    const double ab = std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    return ab / std::sqrt(std::inner_product(a.begin(), a.end(), a.begin(), 0.0) *
                          std::inner_product(b.begin(), b.end(), b.begin(), 0.0));
}

TEST(RecordSuite, a_match_keeps_the_record_and_meets_spectrum_and_pga)
{
    GenerateOptions options;
    options.seed = 5;
    options.duration = 20.0;
    const Record rock = generate_record(rock_spectrum(), options).record; // of another spectrum
    const TargetSpectrum target = eurocode8_spectrum(Eurocode8Type::type_1, GroundType::A, MotionComponent::horizontal);
    const GeneratedRecord matched = matched_record(rock, target, 1.5, 0.10);
    EXPECT_TRUE(matched.within_tolerance) << matched.worst_deviation << " at " << matched.worst_period << " s";
    EXPECT_EQ(matched.worst_deviation, spectrum_match(matched.record.acceleration, rock.dt, target, 1.5).deviation);
    EXPECT_GT(spectrum_match(rock.acceleration, rock.dt, target, 1.0).deviation,
              0.10); // further off than what is asked for
    const Measures m = measure(matched.record);
    EXPECT_NEAR(m.pga, 1.5, 1e-12);
    EXPECT_NEAR(m.final_velocity, 0.0, 2e-4); // rounding to 1e-6 m/s2
    EXPECT_EQ(matched.record.acceleration.size(), rock.acceleration.size());
    EXPECT_GT(alikeness(matched.record.acceleration, rock.acceleration), 0.7); // of unrelated ones 0
    Record coarse = rock, brief = rock;
    coarse.dt = 0.02;
    EXPECT_THROW(matched_record(coarse, target, 1.5, 0.10), InputError);
    brief.acceleration.resize(400); // 4 s
    EXPECT_THROW(matched_record(brief, target, 1.5, 0.10), InputError);
}

class RecordSuiteCommand : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip suites " + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        for (const char* name : {"rock_1.0", "ec8_3.0"})
            for (const char* component : {"_h.csv", "_v.csv"})
                std::filesystem::copy_file(std::string(source_dir()) + "/records/data/" + name + component,
                                           folder / (std::string(name) + component));
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::filesystem::path folder;
};

TEST_F(RecordSuiteCommand, writes_a_list_that_is_read_back_with_its_factors)
{
    const std::string list = (folder / "lists.csv").string();
    const auto a = answer_of({"record", "suite", (folder / "*_?.csv").string(), "--target-spectrum", "ec8-1",
                              "--target-pga-m-s2", "1.5", "--select", "1", "--out", list, "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto answer = nlohmann::json::parse(a.out);
    EXPECT_EQ(answer["records"].size(), 2u);
    ASSERT_EQ(answer["selected"].size(), 1u);
    EXPECT_EQ(answer["selected"][0]["name"], "ec8_3.0_h"); // made for that spectrum
    const double factor = answer["selected"][0]["factor"];
    EXPECT_NEAR(factor, 0.5, 0.05); // its spectrum follows the target within 10 %
    const auto screened = answer_of(
        {"screen", std::string(source_dir()) + "/examples/reference_dam_profile.toml", "--records", list, "--json"});
    const auto row = nlohmann::json::parse(screened.out)["displacements"][0];
    EXPECT_NEAR(row["pga_m_s2"].get<double>(), factor * answer["records"][0]["pga_m_s2"].get<double>(), 1e-9);
    const auto reported = answer_of({"screen", std::string(source_dir()) + "/examples/reference_dam_profile.toml",
                                     "--records", list, "--out", (folder / "out").string()});
    EXPECT_NE(read_file(folder / "out" / "report.html").find(fmt::format("times {:.6g}", factor)), std::string::npos);
}

// All records, each with its factor; the selection of as many as there are is the same one.
TEST_F(RecordSuiteCommand, the_whole_suite_is_the_selection_of_all)
{
    std::vector<nlohmann::json> answers;
    for (const bool select : {false, true}) {
        std::vector<std::string> line{
            "record", "suite", (folder / "*_?.csv").string(), "--target-spectrum", "rock", "--target-pga-m-s2",
            "1.5",    "--json"};
        if (select) line.insert(line.end(), {"--select", "2"});
        const auto a = answer_of(line);
        ASSERT_EQ(a.code, 0) << a.talk;
        answers.push_back(nlohmann::json::parse(a.out));
        ASSERT_EQ(answers.back()["selected"].size(), 2u);
    }
    EXPECT_EQ(answers[0]["selected"], answers[1]["selected"]);
    EXPECT_EQ(answers[0]["spectra"], answers[1]["spectra"]);
}

// A matched suite meets the target at every period of the match, its PGA, and keeps its verticals, scaled as the records were; a list of it is read back
// as it is.
TEST_F(RecordSuiteCommand, a_matched_suite_meets_the_target_and_is_read_back)
{
    const std::filesystem::path list = folder / "matched" / "suite.csv";
    const auto a = answer_of({"record", "suite", (folder / "*_?.csv").string(), "--target-spectrum", "ec8-1",
                              "--target-pga-m-s2", "1.5", "--match", "--out", list.string()});
    ASSERT_EQ(a.code, 0) << a.talk << a.out;
    EXPECT_NE(a.talk.find("2 records; read it with  --records"), std::string::npos) << a.talk;
    for (const char* name : {"rock_1.0", "ec8_3.0"}) {
        const Record matched = read_record(list.parent_path() / fmt::format("{}_h_matched.csv", name), {});
        EXPECT_NEAR(measure(matched).pga, 1.5, 1e-5) << name;
        const auto target = find_target_spectrum("ec8-1", "ec8-1", GroundType::A, MotionComponent::horizontal);
        ASSERT_TRUE(target.has_value());
        const std::vector<double> periods{0.06, 0.11, 0.3, 0.75, 1.9};
        const ResponseSpectrum spectrum = response_spectrum(matched.acceleration, matched.dt, periods, 0.05);
        for (std::size_t k = 0; k < periods.size(); ++k)
            EXPECT_NEAR(spectrum.points[k].pseudo_acceleration / (1.5 * target->amplification(periods[k])), 1.0, 0.11)
                << name << periods[k]; // 10 % at the periods of the match, of which these are none
        const Record up = read_record(folder / fmt::format("{}_v.csv", name), {}),
                     scaled_up = read_record(list.parent_path() / fmt::format("{}_h_scaled_v.csv", name), {});
        const std::size_t at = a.out.find(fmt::format("{}_h: scaled by ", name));
        ASSERT_NE(at, std::string::npos) << a.out;
        const double factor = std::stod(a.out.substr(at + std::string(name).size() + 13));
        EXPECT_NEAR(measure(scaled_up).pga / measure(up).pga, factor, 1e-3 * factor); // printed with four digits
    }
    const auto screened = answer_of({"screen", std::string(source_dir()) + "/examples/reference_dam_profile.toml",
                                     "--records", list.string(), "--json"});
    ASSERT_EQ(screened.code, 0) << screened.talk;
    for (const auto& row : nlohmann::json::parse(screened.out)["displacements"])
        EXPECT_NEAR(row["pga_m_s2"].get<double>(), 1.5, 1e-5);
}

TEST_F(RecordSuiteCommand, refuses_records_that_cannot_serve)
{
    write_file(folder / "still.csv", "# units: m/s2\nt,a\n0,0\n0.01,0\n0.02,0\n0.03,0\n");
    auto a = answer_of({"record", "suite", (folder / "still.csv").string()});
    EXPECT_EQ(a.code, 3);
    a = answer_of({"record", "suite", (folder / "s*.csv").string()});
    EXPECT_EQ(a.code, 3);
    EXPECT_NE(a.talk.find("this record does not shake."), std::string::npos) << a.talk;
    a = answer_of({"record", "suite", (folder / "*.at2").string()});
    EXPECT_EQ(a.code, 3);
    EXPECT_NE(a.talk.find("*.at2"), std::string::npos) << a.talk;
    std::filesystem::copy_file(folder / "rock_1.0_h.csv", folder / "a,\tb.csv");
    a = answer_of({"record", "suite", (folder / "a*.csv").string(), "--out", (folder / "list.csv").string()});
    EXPECT_EQ(a.code, 3);
    EXPECT_NE(a.talk.find("a list cannot hold this path."), std::string::npos) << a.talk;
    EXPECT_FALSE(std::filesystem::exists(folder / "list.csv"));
    std::filesystem::rename(folder / "a,\tb.csv", folder / "a,b.csv"); // a cell between quotes holds a comma
    a = answer_of({"record", "suite", (folder / "a*.csv").string(), "--out", (folder / "list.csv").string()});
    EXPECT_EQ(a.code, 0) << a.talk;
    a = answer_of({"record", "suite", (folder / "list.csv").string()});
    EXPECT_EQ(a.code, 0) << a.talk;
    EXPECT_NE(a.out.find("a,b"), std::string::npos) << a.out;
    a = answer_of({"record", "suite", (folder / "rock_1.0_h.csv").string(), (folder / "ec8_3.0_h.csv").string()});
    EXPECT_EQ(a.code, 2);
    EXPECT_NE(a.talk.find("record suite has 2 patterns."), std::string::npos) << a.talk;
}

TEST_F(RecordSuiteCommand, refuses_what_it_cannot_do)
{
    const std::string pattern = (folder / "*_?.csv").string();
    const auto refused = [&](std::vector<std::string> flags, const std::string& words) {
        std::vector<std::string> line{"record", "suite", pattern};
        line.insert(line.end(), flags.begin(), flags.end());
        const auto a = answer_of(line);
        EXPECT_NE(a.code, 0) << words;
        EXPECT_NE(a.talk.find(words), std::string::npos) << a.talk;
    };
    refused({"--select", "1"}, "without a target");
    refused({"--target-spectrum", "rock"}, "without --target-pga-m-s2");
    refused({"--target-pga-m-s2", "1", "--select", "3"}, "3 records are wanted of 2 events");
    refused({"--target-pga-m-s2", "1", "--match"}, "--match without --target-spectrum");
    refused({"--target-pga-m-s2", "1", "--target-spectrum", "rock", "--match"}, "--match without --out");
    refused({"--target-pga-m-s2", "1", "--from", "2", "--to", "1"}, "--from 2 --to 1");
    refused({"--target-pga-m-s2", "1", "--max-scale", "0.1"}, "--max-scale 0.1");
}

} // namespace

} // namespace damslip
