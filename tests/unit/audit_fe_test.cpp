// What `damslip fe` may say of a slip: with which motion, how sure, and when nothing.
#include "core/file.hpp"
#include "csv_rows.hpp"
#include "pages/fe/fe_pages.hpp"
#include "program_answer.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <unistd.h>

namespace {

using namespace damslip;
using namespace damslip::cli;
using namespace damslip::pages;
using nlohmann::json;

/// A dam of 20 m on rock, under three pulses of 0.4 s that push it downstream more than upstream.
struct DamFolder {
    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("damslip_audit_fe_" + std::to_string(::getpid()));

    DamFolder()
    {
        std::filesystem::create_directories(folder);
        std::ofstream pulses(folder / "pulses.csv");
        pulses << "time_s,accel_m_s2\n";
        for (int k = 0; k <= 150; ++k) {
            const double t = 0.01 * k, wave = std::sin(2.0 * 3.141592653589793 * t / 0.4);
            pulses << fmt::format("{:.2f},{:.6f}\n", t, t < 1.2 ? (wave > 0 ? 6.0 : 4.0) * wave : 0.0);
        }
    }
    DamFolder(const DamFolder&) = delete;
    DamFolder& operator=(const DamFolder&) = delete;
    ~DamFolder() { std::filesystem::remove_all(folder); }

    /// @param more  tables after the dam's own
    std::string scene(const std::string& name, const std::string& more, const std::string& contact = "friction = 0.6",
                      const std::string& mesh = "size_m = 2\ncontact_size_m = 1") const
    {
        const std::filesystem::path file = folder / (name + ".toml");
        std::ofstream(file) << "[section]\nheight_m = 20\nbase_m = 16\ncrest_m = 4\n[dam]\ndensity_kg_m3 = 2400\n"
                               "young_modulus_GPa = 25\n[foundation]\nyoung_modulus_GPa = 20\nwidth_m = 80\n"
                               "depth_m = 40\nmass = \"massless\"\n[contact]\n"
                            << contact << "\n[mesh]\n"
                            << mesh << "\n[[motion.record]]\nname = \"pulses\"\nhorizontal = \"pulses.csv\"\n"
                            << more << "\n";
        return file.string();
    }
};

struct FeAnswer {
    int code = 0;
    json j;
    const json& run(std::size_t k = 0) const { return j["runs"][k]; }
};
FeAnswer fe(const std::string& file, std::vector<std::string> more = {})
{
    std::vector<std::string> arguments{"fe", file, "--json", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramAnswer a = answer_of(arguments);
    return {a.code, json::parse(a.out, nullptr, false)};
}

std::string allowable(double millimetres)
{
    return fmt::format("[criteria]\nallowable_slip_mm = {:.17g}\n", millimetres);
}

// Slides of 0.7 mm in pulses of 10 ms: the fifth halving leaves 1.5 % of one of them, factor of safety included.
TEST(Audit, A5_fe_runs_both_polarities_and_names_the_worst)
{
    const DamFolder f;
    const std::string coarse = "[time]\nslip_tolerance = 0.02\n";
    const std::string file = f.scene("dam", coarse);
    const FeAnswer both = fe(file, {"--out", (f.folder / "both").string()});
    ASSERT_EQ(both.code, 0) << both.j;
    ASSERT_EQ(both.j["runs"].size(), 2u);
    EXPECT_EQ(both.run(0)["polarity"], 1);
    EXPECT_EQ(both.run(1)["polarity"], -1);
    const double down = both.run(0)["max_slip_m"], up = both.run(1)["max_slip_m"];
    ASSERT_NE(down, up);
    EXPECT_EQ(both.j["worst"]["polarity"], down > up ? 1 : -1);
    EXPECT_EQ(both.j["worst"]["record"], "pulses");
    EXPECT_NE(both.j["headline"].get<std::string>().find(down > up ? "polarity +1" : "polarity -1"), std::string::npos);
    for (const char* table : {"slip", "counts", "energy"}) {
        ASSERT_EQ(both.j[table].size(), 2u) << table;
        EXPECT_EQ(both.j[table][1]["polarity"], -1) << table;
    }
    for (const char* name : {"history_pulses_+1.csv", "history_pulses_-1.csv", "contact_pulses_-1.csv", "report.html"})
        EXPECT_TRUE(std::filesystem::exists(f.folder / "both" / name)) << name;

    // One that is asked for is run alone, with the same bits, and its file has the record's name.
    const FeAnswer asked = fe(file, {"--polarity", "-1", "--out", (f.folder / "one").string()});
    ASSERT_EQ(asked.j["runs"].size(), 1u);
    EXPECT_EQ(asked.run()["polarity"], -1);
    EXPECT_EQ(asked.run()["slip_mm"], both.run(1)["slip_mm"]);
    EXPECT_TRUE(std::filesystem::exists(f.folder / "one" / "history_pulses.csv"));
    const FeAnswer written = fe(f.scene("written", coarse + "[motion]\npolarity = -1"));
    ASSERT_EQ(written.j["runs"].size(), 1u);
    EXPECT_EQ(written.run()["polarity"], -1);
    EXPECT_EQ(written.run()["slip_mm"], both.run(1)["slip_mm"]);
    EXPECT_EQ(fe(f.scene("plus", coarse + "[motion]\npolarity = 1")).j["runs"].size(), 1u);
    // The resolved scene of a run with both asks for both again.
    EXPECT_EQ(fe((f.folder / "both" / "scene.resolved.toml").string()).run(1)["slip_mm"], both.run(1)["slip_mm"]);
}

TEST(Audit, A5_reduced_runs_take_both_polarities)
{
    const DamFolder f;
    // Slides of 0.7 mm in pulses of 10 ms: the fifth halving leaves 1.06 % of one of them.
    const FeAnswer both = fe(f.scene("dam", "[time]\nslip_tolerance = 0.02"), {"--reduced", "--modes", "6"});
    ASSERT_EQ(both.code, 0) << both.j;
    ASSERT_EQ(both.j["runs"].size(), 2u);
    EXPECT_EQ(both.run(1)["polarity"], -1);
    EXPECT_GT(both.run()["steps"].get<int>(), 100);
    EXPECT_GT(both.run()["dt_s"].get<double>(), 0.0);
    EXPECT_GT(both.run()["seconds"].get<double>(), 0.0);
    const double modes = both.run()["truncation_error_mm"], step = both.run()["slip_error_mm"],
                 mesh = both.run()["mesh_error_mm"];
    EXPECT_NEAR(both.run()["total_error_mm"].get<double>(), modes + step + mesh, 1e-12 * (modes + step + mesh));
    EXPECT_EQ(fe(f.scene("dam", ""), {"--reduced", "--polarity", "1"}).j["runs"].size(), 1u);
}

// The mesh's part against two scenes that a file can hold: the dam's own sizes, and all of them twice, with the same steps.
TEST(Audit, A4_the_mesh_part_is_the_change_against_elements_of_twice_the_size)
{
    const DamFolder f;
    const std::string sizes = "rock_size_m = 10\n";
    const FeAnswer own =
        fe(f.scene("own", "", "friction = 0.6", sizes + "size_m = 2\ncontact_size_m = 1\ngrowth = 1.2"),
           {"--polarity", "1"});
    ASSERT_EQ(own.code, 0) << own.j;
    const json& run = own.run();
    const int parts = own.j["counts"][0]["sub_steps"];
    const std::string steps = fmt::format("[time]\nsubsteps = {}\n", std::lround(std::log2(parts)));
    const FeAnswer twice =
        fe(f.scene("twice", steps, "friction = 0.6", "rock_size_m = 20\nsize_m = 4\ncontact_size_m = 2\ngrowth = 1.4"),
           {"--polarity", "1"});
    const double slip = run["slip_mm"], coarse = twice.run()["slip_mm"];
    ASSERT_GT(std::abs(slip - coarse), 1e-3);
    EXPECT_EQ(run["mesh_error_mm"].get<double>(), 1e3 * std::abs(slip / 1e3 - coarse / 1e3)) << slip << " " << coarse;
    EXPECT_NEAR(run["total_error_mm"].get<double>(),
                run["slip_error_mm"].get<double>() + run["mesh_error_mm"].get<double>(), 1e-12 * slip);
    EXPECT_EQ(run["error_parts"], "step and mesh");
}

TEST(Audit, A4_without_a_coarser_mesh_the_error_says_step_only)
{
    const DamFolder f;
    const std::vector<std::string> one{"--polarity", "1"};
    const auto step_only = [&](const FeAnswer& a, const char* why) {
        ASSERT_EQ(a.j["runs"].size(), 1u) << why;
        EXPECT_TRUE(a.run()["mesh_error_mm"].is_null()) << why;
        EXPECT_EQ(a.run()["error_parts"], "step only") << why;
        EXPECT_EQ(a.run()["total_error_mm"], a.run()["slip_error_mm"]) << why;
        EXPECT_NE(a.j["headline"].get<std::string>().find("(step only)"), std::string::npos) << a.j["headline"];
    };
    const std::string file = f.scene("dam", "");
    step_only(fe(file, {"--polarity", "1", "--no-mesh-error"}), "--no-mesh-error");
    const ProgramAnswer text = answer_of({"fe", file, "--polarity", "1", "--no-mesh-error", "--quiet"});
    EXPECT_NE(text.out.find("step only: --no-mesh-error."), std::string::npos) << text.out;
    step_only(fe(f.scene("coarse", "", "friction = 0.6", "size_m = 3\ncontact_size_m = 3"), one), "too coarse");
    ASSERT_EQ(answer_of({"mesh", file, "--out", (f.folder / "dam.msh").string(), "--quiet"}).code, 0);
    step_only(fe(f.scene("imported", "", "friction = 0.6", "file = \"dam.msh\""), one), "imported");
}

TEST(Audit, A4_a_verdict_needs_the_allowable_outside_the_error)
{
    const DamFolder f;
    const std::vector<std::string> one{"--polarity", "1"};
    const json run = fe(f.scene("dam", ""), one).run();
    const double slip = 1e3 * run["max_slip_m"].get<double>(), error = run["total_error_mm"];
    ASSERT_GT(error, run["slip_error_mm"].get<double>()); // the step alone would decide
    const auto verdict = [&](double millimetres) {
        const FeAnswer a = fe(f.scene("judged", allowable(millimetres)), one);
        EXPECT_EQ(a.code, 0);
        EXPECT_EQ(a.j["verdict"], a.run()["verdict"]);
        return a.run()["verdict"].get<std::string>();
    };
    EXPECT_EQ(verdict(slip + 1.01 * error), "PASS");
    EXPECT_EQ(verdict(slip + 0.99 * error), "undecided");
    EXPECT_EQ(verdict(slip - 0.99 * error), "undecided");
    EXPECT_EQ(verdict(slip - 1.01 * error), "FAIL");
    EXPECT_EQ(run["verdict"], "–"); // without a criterion
}

TEST(Audit, A16_fixed_sub_steps_have_no_error_estimate_and_no_verdict)
{
    const DamFolder f;
    const std::string file = f.scene("fixed", "[time]\nsubsteps = 0\n" + allowable(1e5));
    const FeAnswer a = fe(file);
    EXPECT_EQ(a.code, 0);
    ASSERT_EQ(a.run()["status"], "at rest");
    EXPECT_TRUE(a.run()["slip_error_mm"].is_null());
    EXPECT_TRUE(a.run()["total_error_mm"].is_null());
    EXPECT_EQ(a.run()["error_parts"], "no error estimate");
    EXPECT_EQ(a.run()["verdict"], "undecided");
    EXPECT_NE(a.j["headline"].get<std::string>().find("no error estimate"), std::string::npos) << a.j["headline"];
    EXPECT_NE(answer_of({"fe", file, "--quiet"}).out.find("no error estimate: the step is fixed"), std::string::npos);
    const FeAnswer reduced = fe(file, {"--reduced"});
    EXPECT_EQ(reduced.run()["error_parts"], "no error estimate");
    EXPECT_EQ(reduced.run()["verdict"], "undecided");
}

/// Last less first row of a column of a CSV file with comments; not a number where there is no such column.
double change_of(const std::filesystem::path& file, const std::string& column)
{
    const auto rows = csv_rows(read_file(file));
    if (rows.empty() || !rows.front().contains(column)) return std::nan("");
    return std::stod(rows.back().at(column)) - std::stod(rows.front().at(column));
}

// What goes in is what is stored and dissipated, radiation by the acoustic water included: the columns add up to the imbalance.
TEST(Audit, A17_energies_with_what_is_radiated_add_up)
{
    const DamFolder f;
    const FeAnswer a =
        fe(f.scene("wet", "[reservoir]\nlevel_m = 18\nmodel = \"acoustic\"\n[uplift]\nmodel = \"linear\"",
                   "friction = 0.9"),
           {"--polarity", "1", "--out", (f.folder / "out").string()});
    ASSERT_EQ(a.j["energy"].size(), 1u) << a.j;
    const json& row = a.j["energy"][0];
    const std::filesystem::path history = f.folder / "out" / "history_pulses.csv";
    double left = 0.0, largest = 0.0;
    for (const char* term : {"kinetic_J_m", "strain_J_m", "damping_J_m", "numerical_J_m", "friction_J_m",
                             "radiated_J_m", "external_J_m", "contact_normal_J_m"}) {
        ASSERT_TRUE(row.contains(term)) << term;
        const double change = change_of(history, term);
        const bool given = std::string(term) == "external_J_m" || std::string(term) == "contact_normal_J_m";
        left += given ? -change : change;
        largest = std::max(largest, std::abs(change));
    }
    EXPECT_GT(row["radiated_J_m"].get<double>(), 1e-3 * largest);
    EXPECT_NEAR(left, row["imbalance_J_m"].get<double>(), 1e-12 * largest);
    EXPECT_LT(std::abs(left), 1e-9 * largest);
}

// A dam that slides to and fro: the same steps once as sub-steps of a coarse record, once as the record's own. The largest
// slip is that of the steps, not that of the coarse record's rows.
TEST(Audit, A17_the_largest_slip_is_that_of_all_steps)
{
    Scene scene = fe2d::test::sliding_dam(0.05); // dry: it turns within a step of the record, hardly ever sticking
    scene.reservoir.reset();
    scene.uplift.reset();
    const GroundMotion coarse = fe2d::test::sines(3.0, 3.0, 5, 0.02);
    GroundMotion fine = coarse;
    constexpr int parts = 8;
    fine.dt = coarse.dt / parts;
    for (std::vector<double> GroundMotion::*component : {&GroundMotion::accel_h, &GroundMotion::accel_v}) {
        const std::vector<double>& rows = coarse.*component;
        std::vector<double> all;
        for (std::size_t i = 0; i + 1 < rows.size(); ++i)
            for (int k = 0; k < parts; ++k) all.push_back(rows[i] + (rows[i + 1] - rows[i]) * k / parts);
        if (!rows.empty()) all.push_back(rows.back());
        fine.*component = all;
    }
    fe2d::RunOptions options = fe2d::test::options_of(scene);
    scene.time.substeps = 3;
    const fe2d::RunResult in_parts = fe2d::EarthquakeRun(scene, options).run(coarse);
    scene.time.substeps = 0;
    const fe2d::RunResult whole = fe2d::EarthquakeRun(scene, options).run(fine);
    const auto largest = [](const std::vector<double>& slip) {
        double most = 0.0;
        for (const double s : slip) most = std::max(most, std::abs(s));
        return most;
    };
    ASSERT_GT(whole.max_slip, 1e-3);
    EXPECT_EQ(whole.max_slip, largest(whole.history.slip));
    EXPECT_GT(in_parts.max_slip, largest(in_parts.history.slip)); // the largest falls between two rows
    EXPECT_NEAR(in_parts.max_slip, whole.max_slip, 1e-9 * whole.max_slip);
}

TEST(Audit, B2_a_missed_step_tolerance_is_a_status_without_a_verdict)
{
    const DamFolder f;
    std::ofstream(f.folder / "pulses.csv") << "time_s,accel_m_s2\n0,0\n0.1,3\n0.2,-3\n0.3,0\n0.4,0\n";
    const FeAnswer a = fe(f.scene("missed", allowable(1e4), "friction = 0.4"), {"--polarity", "1"});
    EXPECT_EQ(a.code, 4);
    EXPECT_EQ(a.run()["status"], "tolerance missed");
    EXPECT_GT(a.run()["slip_error_mm"].get<double>(), 0.01 * std::abs(a.run()["slip_mm"].get<double>()));
    EXPECT_EQ(a.run()["verdict"], "–");
    EXPECT_EQ(a.j["verdict"], "–");
    EXPECT_NE(a.j["messages"].dump().find("time.slip_tolerance"), std::string::npos);
}

TEST(Audit, B1_fe_static_failure_is_proven_and_has_no_slip)
{
    const DamFolder f;
    const FeAnswer a = fe(
        f.scene("weak", "[reservoir]\nlevel_m = 20\n[uplift]\nmodel = \"linear\"\n" + allowable(50), "friction = 0.3"));
    EXPECT_EQ(a.code, 0);
    EXPECT_EQ(a.run()["status"], "static failure");
    EXPECT_TRUE(a.run()["slip_mm"].is_null());
    EXPECT_TRUE(a.run()["max_slip_m"].is_null());
    EXPECT_TRUE(a.run()["total_error_mm"].is_null());
    EXPECT_EQ(a.run()["verdict"], "FAIL");
    EXPECT_EQ(a.j["verdict"], "FAIL");
    EXPECT_NE(a.j["headline"].get<std::string>().find("it holds with mu >="), std::string::npos);
}

TEST(Audit, B5_fe_a_slip_longer_than_the_base_runs_away)
{
    const DamFolder f;
    {
        std::ofstream push(f.folder / "pulses.csv");
        push << "time_s,accel_m_s2\n";
        for (int k = 0; k <= 400; ++k) push << fmt::format("{:.2f},{:.3f}\n", 0.01 * k, k == 0 || k > 390 ? 0.0 : 8.0);
    }
    const FeAnswer a = fe(f.scene("away", allowable(50), "friction = 0.2"), {"--polarity", "1"});
    EXPECT_EQ(a.code, 0) << a.j["messages"];
    EXPECT_EQ(a.run()["status"], "runs away");
    EXPECT_TRUE(a.run()["slip_mm"].is_null());
    EXPECT_TRUE(a.run()["max_slip_m"].is_null());
    EXPECT_TRUE(a.j["slip"][0]["slip_mm"].is_null());
    EXPECT_EQ(a.run()["verdict"], "FAIL");
}

/// One run as the program keeps it, without a mesh.
ContactRun made_up_run(Status status, double slip, double step_error)
{
    ContactRun run;
    run.record = "made up";
    run.fe.status = status;
    run.fe.slip = run.fe.max_slip = slip;
    run.fe.slip_error = step_error;
    run.fe.notes = {{NoteKind::rest_falls}};
    run.fe.after.name = "after the earthquake";
    return run;
}

const Cell& cell_of(const Table& table, const std::string& key, std::size_t row = 0)
{
    for (std::size_t j = 0; j < table.columns.size(); ++j)
        if (table.columns[j].key == key) return table.rows.at(row).at(j);
    throw std::out_of_range(key);
}

TEST(Audit, B1_fe_what_is_not_resolved_has_no_slip_no_verdict_and_a_neutral_banner)
{
    Scene scene = fe2d::test::sliding_dam(0.7);
    scene.criteria.allowable_slip = 0.05;
    const std::vector<ContactRun> runs{made_up_run(Status::not_resolved, 0.0, 0.0)};
    const Table table = contact_run_table(runs, scene.criteria.allowable_slip);
    for (const char* key : {"slip_mm", "slip_error_mm", "total_error_mm", "max_slip_m"})
        EXPECT_TRUE(std::holds_alternative<std::monostate>(cell_of(table, key))) << key;
    EXPECT_EQ(cell_of(table, "verdict"), Cell(std::string("–")));
    EXPECT_EQ(exit_code_of(runs), exit_no_answer);
    const pages::Headline headline = fe_headline(scene, runs);
    EXPECT_EQ(headline.outcome, pages::Outcome::unresolved);
    EXPECT_EQ(headline.verdict, "not resolved");

    // A dam that fails in another run fails, and what is not resolved is named.
    const std::vector<ContactRun> two{made_up_run(Status::at_rest, 0.2, 0.001), runs.front()};
    EXPECT_EQ(fe_headline(scene, two).verdict, "FAIL");
    EXPECT_NE(fe_headline(scene, two).sentence.find("It does not stand there"), std::string::npos);
    EXPECT_EQ(exit_code_of(two), exit_no_answer);
    // A slip that would pass does not where another run has no answer.
    const std::vector<ContactRun> small{made_up_run(Status::at_rest, 0.01, 0.001), runs.front()};
    EXPECT_EQ(verdict_of(small, 0.05), damslip::Verdict::none);
    EXPECT_EQ(fe_headline(scene, small).outcome, pages::Outcome::unresolved);
}

TEST(SelfExcited, both_polarities_walk_and_the_remedy_is_said_once)
{
    const Scene scene = fe2d::test::sliding_dam(0.7);
    std::vector<ContactRun> runs{made_up_run(Status::self_excited, 1.5, 0.0),
                                 made_up_run(Status::self_excited, -2.25, 0.0)};
    EXPECT_EQ(fe_headline(scene, runs).sentence,
              "made up: It does not stand there: the sequence ends. made up: Self-excited, too: slid at least 2250 mm.");
    std::vector<std::string> messages;
    pages::add_run_messages(runs, messages);
    EXPECT_EQ(messages, (std::vector<std::string>{"made up: It does not stand there: the sequence ends.",
                                                  "made up: Self-excited, too: slid at least 2250 mm."}));
    // With a slip beside them the first of those that walk says it.
    runs.insert(runs.begin(), made_up_run(Status::at_rest, 0.02, 0.001));
    const std::string sentence = fe_headline(scene, runs).sentence;
    EXPECT_NE(sentence.find("made up: It does not stand there: the sequence ends. made up: Self-excited, too: slid at least 2250 mm."),
              std::string::npos)
        << sentence;
    EXPECT_EQ(sentence.find("It does not stand there"), sentence.rfind("It does not stand there")) << sentence;
}

TEST(Audit, B1_fe_a_state_after_the_earthquake_that_is_not_resolved_is_no_fall)
{
    Scene scene = fe2d::test::sliding_dam(0.7);
    scene.criteria.allowable_slip = 0.05;
    std::vector<ContactRun> runs{made_up_run(Status::at_rest, 0.01, 0.001)};
    EXPECT_EQ(fe_headline(scene, runs).verdict, "PASS");
    runs[0].fe.after.status = fe2d::StageStatus::not_resolved;
    const pages::Headline headline = fe_headline(scene, runs);
    EXPECT_EQ(headline.outcome, pages::Outcome::unresolved);
    EXPECT_EQ(headline.sentence.find("does not stand"), std::string::npos) << headline.sentence;
    EXPECT_EQ(verdict_of(runs, 0.05), damslip::Verdict::none);
    EXPECT_EQ(exit_code_of(runs), exit_no_answer);
    const Table stages = contact_stage_table(runs);
    EXPECT_EQ(cell_of(stages, "status"), Cell(std::string("NOT RESOLVED")));
    EXPECT_TRUE(std::holds_alternative<std::monostate>(cell_of(stages, "slip_mm")));
    runs[0].fe.after.status = fe2d::StageStatus::slides;
    EXPECT_EQ(fe_headline(scene, runs).verdict, "FAIL");
}

TEST(Audit, B5_fe_round_off_of_an_open_base_is_no_force)
{
    ContactRun run = made_up_run(Status::at_rest, 0.01, 0.001);
    fe2d::RunHistory& h = run.fe.history;
    h.time = {0.0, 1.0};
    h.normal_force = {4e7, -3.8e-8};
    h.slip = h.slip_heel = h.slip_middle = h.slip_toe = h.rocking = h.largest_opening = h.open_length = {0.0, 0.0};
    EXPECT_EQ(cell_of(contact_slip_table({run}), "smallest_normal_force_kN_m"), Cell(0.0));
    h.normal_force = {4e7, -4e3}; // not round-off
    EXPECT_EQ(cell_of(contact_slip_table({run}), "smallest_normal_force_kN_m"), Cell(-4.0));
}

} // namespace
