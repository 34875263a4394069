// One list of statuses in all commands: what is printed, whether there is a slip, which exit code follows.
#include "analysis/accuracy/model_level_runner.hpp"
#include "analysis/prepare/ready.hpp"
#include "analysis/screen/screening.hpp"
#include "analysis/sweep/sweep_grid.hpp"
#include "core/status.hpp"
#include "pages/sweep/sweep_pages.hpp"
#include "program_answer.hpp"
#include "scene/read.hpp"
#include "scene/scene_text.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace damslip::audit_status_tests {

namespace {

using nlohmann::json;

std::string text_of(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
}

/// What a block scene differs in.
struct BlockText {
    double friction = 0.4;
    std::string contact;                 ///< further keys of [contact]
    std::string time = "substeps = 0\n"; ///< of [time], beside dt_s
    std::string more;                    ///< further tables
    std::string section = "polygon_m = [[0, 0], [8, 0], [8, 2], [0, 2]]\n";
    double density = 2500.0;
};

/// A folder with a stiff 8 m x 2 m block and a one-sided pulse of 2 m/s^2; its FE runs take some 150 steps.
class Scenes {
public:
    Scenes()
    {
        folder = std::filesystem::temp_directory_path() / ("damslip audit statuses " + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        write("pulse.csv", "time_s,accel_m_s2\n0,0\n1,2\n2,0\n3,0\n");
    }
    ~Scenes() { std::filesystem::remove_all(folder); }
    Scenes(const Scenes&) = delete;
    Scenes& operator=(const Scenes&) = delete;

    std::string path(const std::string& name) const { return (folder / name).string(); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }

    /// @returns the scene's path
    std::string block(const BlockText& b) const
    {
        write("block.toml",
              fmt::format("[section]\n{}[dam]\ndensity_kg_m3 = {}\nyoung_modulus_GPa = 2500\n[contact]\nfriction = {}\n"
                          "{}[mesh]\nsize_m = 1\ncontact_size_m = 1\n[time]\ndt_s = 0.02\n{}{}[[motion.record]]\n"
                          "horizontal = \"pulse.csv\"\n",
                          b.section, b.density, b.friction, b.contact, b.time, b.more));
        return path("block.toml");
    }

    /// The reference dam on massless rock with friction that falls within a tenth of a micrometre a second: no step of the
    /// earthquake has one answer.
    std::string unsolvable_dam() const
    {
        const std::filesystem::path root = source_dir();
        std::string text = text_of(root / "examples/reference_dam.toml");
        for (std::size_t at = 0; (at = text.find("../records/", at)) != std::string::npos;)
            text.replace(at, 3, root.string() + "/");
        text.insert(text.find("friction = 0.77"),
                    "kinetic_friction_ratio = 0.5\ncharacteristic_rate_m_s = 1e-7\nrelaxation_time_s = 1e-4\n");
        text.insert(text.find("[foundation]") + 12, "\nmass = \"massless\"");
        write("unsolvable.toml", text);
        return path("unsolvable.toml");
    }

    /// The example's wedge without cohesion and dry, of planes that are not alike.
    std::string wedge(double first_deg, double second_deg) const
    {
        write("wedge.toml",
              fmt::format("[wedge]\ndensity_kg_m3 = 2500\nheight_m = 40\nface_dip_deg = 65\nface_dip_direction_deg = "
                          "185\nupper_dip_deg = 12\nupper_dip_direction_deg = 195\n[[wedge.plane]]\nname = \"A\"\n"
                          "dip_deg = 45\ndip_direction_deg = 105\nfriction_deg = {}\n[[wedge.plane]]\nname = \"B\"\n"
                          "dip_deg = 70\ndip_direction_deg = 235\nfriction_deg = {}\n[[motion.record]]\nhorizontal = "
                          "\"pulse.csv\"\n",
                          first_deg, second_deg));
        return path("wedge.toml");
    }

private:
    std::filesystem::path folder;
};

json rows_of(const ProgramAnswer& answer, const std::vector<std::string>& keys)
{
    json j = json::parse(answer.out, nullptr, false);
    for (const std::string& key : keys) {
        if (j.is_discarded() || !j.contains(key)) {
            ADD_FAILURE() << "no " << key << " in " << answer.out << answer.talk;
            return json::array({json::object()});
        }
        j = j[key];
    }
    return j;
}

// ---- the list

/// The page's table as the list has it.
std::string table_of_the_list()
{
    std::string table = "| status | exit code | slip | verdict | meaning | what to do |\n"
                        "| --- | --- | --- | --- | --- | --- |\n";
    for (const StatusRow& row : status_rows()) {
        const char* slip = row.slip == SlipMeaning::final         ? "final"
                           : row.slip == SlipMeaning::lower_bound ? "lower bound"
                                                                  : "none";
        const char* verdict = row.judging == Judging::by_slip ? "PASS, FAIL or undecided"
                              : row.judging == Judging::fails ? "FAIL"
                                                              : "none";
        table += fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.word, row.exit_code, slip, verdict, row.meaning,
                             row.remedy);
    }
    return table;
}

TEST(Audit, Statuses_the_page_is_the_list)
{
    const std::string page = text_of(std::filesystem::path(source_dir()) / "docs/statuses.md");
    EXPECT_NE(page.find(table_of_the_list()), std::string::npos) << "docs/statuses.md wants this table:\n"
                                                                 << table_of_the_list();
}

TEST(Audit, Statuses_are_counted_by_name_and_the_worst_exit_code_counts)
{
    StatusCount count;
    EXPECT_EQ(count.words(), "");
    EXPECT_EQ(count.exit_code(), exit_ok);
    count.add(Status::runs_away);
    count.add(Status::static_failure);
    count.add(Status::static_failure);
    EXPECT_EQ(count.words(), "2 static failure, 1 runs away");
    EXPECT_EQ(count.exit_code(), exit_ok);
    count.add(Status::refused);
    EXPECT_EQ(count.exit_code(), exit_input);
    count.add(Status::not_resolved);
    EXPECT_EQ(count.exit_code(), exit_no_answer);
    EXPECT_EQ(count.all(), 5u);
}

// ---- every command meets each status that it can meet cheaply

/// How a command shows one run.
struct Shown {
    std::string name;
    std::vector<std::string> arguments; ///< %: the scene
    std::vector<std::string> rows;      ///< keys down to the rows; the first row is looked at
    std::string slip;                   ///< key of the slip
};

const Shown screened{"screen", {"screen", "%", "--json"}, {"displacements"}, "max_slip_m"};
const Shown swept{"sweep rigid", {"sweep", "%", "--method", "rigid", "--json"}, {"rows"}, "max_slip_m"};
const Shown swept_fe{"sweep fe", {"sweep", "%", "--method", "fe", "--json"}, {"rows"}, "max_slip_m"};
const Shown ablated{"ablate", {"explain", "%", "--ablate", "--json"}, {"ablation", "changes"}, "slip_mm"};
const Shown ablated_fe{
    "ablate fe", {"explain", "%", "--ablate", "--method", "fe", "--json"}, {"ablation", "changes"}, "slip_mm"};

std::vector<std::string> with_scene(std::vector<std::string> arguments, const std::string& scene)
{
    for (std::string& word : arguments)
        if (word == "%") word = scene;
    return arguments;
}

void expect_status(const Shown& shown, const std::string& scene, Status status)
{
    const ProgramAnswer answer = answer_of(with_scene(shown.arguments, scene));
    EXPECT_EQ(answer.code, status_row(status).exit_code) << shown.name << ": " << word(status) << "\n" << answer.talk;
    const json row = rows_of(answer, shown.rows)[0];
    EXPECT_EQ(row.value("status", ""), word(status)) << shown.name;
    if (!row.contains(shown.slip)) return;
    EXPECT_EQ(row[shown.slip].is_null(), status_row(status).slip == SlipMeaning::none)
        << shown.name << ": " << word(status) << " with " << row[shown.slip];
}

/// One model level alone. A model level has a slip only when it came to rest.
void expect_model_level(const std::string& model_level, const std::string& scene, Status status)
{
    const ProgramAnswer answer = answer_of({"accuracy", scene, "--rung", model_level, "--json"});
    EXPECT_EQ(answer.code, status_row(status).exit_code) << model_level << ": " << word(status) << "\n" << answer.talk;
    const json j = json::parse(answer.out, nullptr, false);
    ASSERT_FALSE(j.is_discarded()) << answer.talk;
    EXPECT_EQ(j.value("status", ""), word(status)) << model_level;
    EXPECT_EQ(j["runs"].empty(), status != Status::at_rest) << model_level;
}

TEST(Audit, Statuses_each_command_at_rest)
{
    const Scenes files;
    const std::string scene = files.block({});
    for (const Shown& shown : {screened, swept, swept_fe, ablated, ablated_fe})
        expect_status(shown, scene, Status::at_rest);
    for (const char* model_level : {"rigid:h", "fe-dry:dt"}) expect_model_level(model_level, scene, Status::at_rest);
    EXPECT_EQ(answer_of({"fe", scene, "--json"}).code, exit_ok);
}

TEST(Audit, Statuses_each_command_sliding_at_end)
{
    const Scenes files;
    BlockText b;
    b.friction = 0.06;
    b.more = "[sliding]\nrun_out_max_s = 0.02\n";
    files.write("pulse.csv", "time_s,accel_m_s2\n0,0\n1,2\n2,0\n"); // ends while the block slides
    const std::string scene = files.block(b);
    for (const Shown& shown : {screened, swept, swept_fe, ablated, ablated_fe})
        expect_status(shown, scene, Status::sliding_at_end);
    for (const char* model_level : {"rigid:h", "fe-dry:dt"}) expect_model_level(model_level, scene, Status::sliding_at_end);
}

TEST(Audit, Statuses_each_command_static_failure)
{
    const Scenes files;
    BlockText b;
    b.friction = 0.05;
    b.more = "[[force]]\nforce_x_kN_m = 60\n";
    const std::string scene = files.block(b);
    for (const Shown& shown : {screened, swept, swept_fe, ablated, ablated_fe})
        expect_status(shown, scene, Status::static_failure);
    for (const char* model_level : {"rigid:h", "fe-dry:dt"}) expect_model_level(model_level, scene, Status::static_failure);
    const json screened_rows = rows_of(answer_of({"screen", scene, "--json"}), {"displacements"});
    EXPECT_EQ(screened_rows[0]["verdict"], "FAIL");
    EXPECT_TRUE(screened_rows[0]["upstream_slip_mm"].is_null());
    const json statistics = rows_of(answer_of({"screen", scene, "--json"}), {"statistics"});
    EXPECT_EQ(statistics[0]["n"], 0);
    EXPECT_TRUE(statistics[0]["mean_mm"].is_null());
    EXPECT_EQ(statistics[0]["without_slip"], "1 static failure"); // of one record
}

TEST(Audit, Statuses_each_command_floats)
{
    const Scenes files;
    BlockText b;
    b.density = 400.0;
    b.more = "[reservoir]\nlevel_m = 1.9\nmodel = \"hydrostatic\"\n[tailwater]\nlevel_m = 1.9\n[uplift]\nmodel = "
             "\"linear\"\n";
    const std::string scene = files.block(b);
    for (const Shown& shown : {screened, swept, swept_fe}) expect_status(shown, scene, Status::floats);
    for (const char* model_level : {"rigid:h", "fe-hydrostatic:dt"}) expect_model_level(model_level, scene, Status::floats);
}

TEST(Audit, Statuses_each_command_overturns)
{
    const Scenes files;
    BlockText b;
    b.section = "polygon_m = [[0, 0], [1, 0], [1, 6], [0, 6]]\n";
    b.friction = 2.0;
    b.more = "[reservoir]\nlevel_m = 5.5\nmodel = \"hydrostatic\"\n[uplift]\nmodel = \"none\"\n";
    const std::string scene = files.block(b);
    expect_status(swept_fe, scene, Status::overturns);
    expect_model_level("fe-hydrostatic:dt", scene, Status::overturns);
}

TEST(Audit, Statuses_each_command_tolerance_missed)
{
    const Scenes files;
    BlockText b;
    b.friction = 0.15;
    b.time = "slip_tolerance = 1e-12\n";
    const std::string scene = files.block(b);
    expect_status(swept_fe, scene, Status::tolerance_missed);
    expect_model_level("fe-dry:dt=auto", scene, Status::tolerance_missed);
    const ProgramAnswer answer = answer_of({"sweep", scene, "--method", "fe", "--polarity", "1", "--json"});
    EXPECT_NE(answer.talk.find("1 row has no answer: 1 tolerance missed (row 0)"), std::string::npos) << answer.talk;
    const ProgramAnswer ablation = answer_of(with_scene(ablated_fe.arguments, scene));
    EXPECT_EQ(ablation.code, exit_no_answer); // the step that all its runs share is not what was asked for
    EXPECT_NE(ablation.out.find("tolerance missed"), std::string::npos);
}

TEST(Audit, Statuses_slammers_own_error_decides_nothing)
{
    const Scenes files;
    BlockText b;
    b.friction = 0.15;
    b.more = "[criteria]\nallowable_slip_mm = 1e5\n";
    const std::string scene = files.block(b);
    EXPECT_EQ(rows_of(answer_of({"screen", scene, "--json"}), {"displacements"})[0]["verdict"], "below");
    const ProgramAnswer slammer = answer_of({"screen", scene, "--scheme", "slammer", "--json"});
    EXPECT_EQ(rows_of(slammer, {"displacements"})[0]["verdict"], "undecided");
    EXPECT_EQ(slammer.code, exit_ok);
    EXPECT_NE(
        answer_of({"screen", scene, "--scheme", "slammer"}).out.find("the error of SLAMMER's scheme is not known"),
        std::string::npos);
}

TEST(Audit, Statuses_records_without_a_slip_are_counted_and_not_averaged)
{
    const Scenes files;
    sliding::SlideResult small, large, lost;
    small.max_slip = 0.1;
    large.max_slip = 0.3;
    lost.status = Status::not_resolved;
    lost.max_slip = 0.2;
    EXPECT_EQ(&worse(small, large), &large);
    EXPECT_EQ(&worse(lost, large), &lost);
    lost.status = Status::runs_away;
    EXPECT_EQ(&worse(large, lost), &lost);
    sliding::SlideResult open;
    open.status = Status::not_resolved;
    EXPECT_EQ(&worse(lost, open), &open);

    // Two records, one of which runs away: n, mean and largest are of the other.
    files.write("weak.csv", "time_s,accel_m_s2\n0,0\n1,1.2\n2,0\n3,0\n");
    BlockText b;
    b.friction = 0.02;
    b.more = "[criteria]\nallowable_slip_mm = 1e4\n[[motion.record]]\nhorizontal = \"weak.csv\"\nscale = 0.4\n";
    const ProgramAnswer answer = answer_of({"screen", files.block(b), "--json"});
    EXPECT_EQ(answer.code, exit_ok);
    const json rows = rows_of(answer, {"displacements"}), statistics = rows_of(answer, {"statistics"});
    double largest = 0.0;
    int away = 0;
    for (const json& row : rows) {
        if (row["status"] == "runs away") ++away;
        if (row["max_slip_m"].is_number()) largest = std::max(largest, row["max_slip_m"].get<double>());
    }
    ASSERT_EQ(rows.size(), 4u);
    ASSERT_EQ(away, 2); // both polarities of the strong record
    EXPECT_EQ(statistics[0]["n"], 1);
    EXPECT_EQ(statistics[0]["without_slip"], "1 runs away");
    EXPECT_NEAR(statistics[0]["mean_mm"].get<double>(), 1e3 * largest, 1e-9);
    EXPECT_EQ(statistics[0]["share_above_allowable_percent"], 50.0); // who runs away fails
}

// ---- B1

TEST(Audit, B1_a_sweeps_stage_that_is_not_resolved_is_no_static_failure)
{
    const Scenes files;
    const std::string scene = files.unsolvable_dam();
    const std::vector<std::string> sweep{"sweep", scene, "--method",  "fe-whole-steps",
                                         "--polarity", "1",   "--out", files.path("r.csv")};
    const ProgramAnswer answer = answer_of(sweep);
    EXPECT_EQ(answer.code, exit_no_answer);
    EXPECT_NE(answer.talk.find("3 rows have no answer: 3 not resolved (rows 0, 1, 2)"), std::string::npos)
        << answer.talk;
    const std::string csv = text_of(files.path("r.csv"));
    EXPECT_NE(csv.find(",not resolved,"), std::string::npos) << csv;
    EXPECT_EQ(csv.find("static failure"), std::string::npos) << csv;

    // The same input gives it again: it is finished.
    std::vector<std::string> resumed = sweep;
    resumed.emplace_back("--resume");
    const ProgramAnswer again = answer_of(resumed);
    EXPECT_EQ(again.code, exit_no_answer);
    EXPECT_NE(again.talk.find("3 rows were finished before"), std::string::npos) << again.talk;
    EXPECT_EQ(text_of(files.path("r.csv")), csv);
}

TEST(Audit, B1_rows_take_slip_and_exit_code_from_the_status)
{
    for (const StatusRow& row : status_rows()) {
        fe2d::RunResult run;
        run.status = row.status;
        run.slip = 0.5;
        const FinishedRow finished = fe_row(3, run, false);
        EXPECT_EQ(finished.good, is_answer(row.status)) << row.word;
        EXPECT_EQ(status_of(finished), row.status);
        EXPECT_EQ(finished.results.slip.has_value(), row.slip != SlipMeaning::none) << row.word;
    }
}

// ---- B3

TEST(Audit, B3_a_solver_without_an_answer_is_not_refused_by_accuracy)
{
    const Scenes files;
    const std::string scene = files.unsolvable_dam();
    expect_model_level("fe-added-mass:dt", scene, Status::not_resolved);
    const ProgramAnswer answer = answer_of({"accuracy", scene, "--quick", "--repeats", "1", "--budget", "4", "--json"});
    EXPECT_EQ(answer.code, exit_no_answer);
    const json j = json::parse(answer.out);
    EXPECT_TRUE(j["choice"].is_null());
    bool seen = false;
    for (const json& model_level : j["rungs"]) {
        const std::string id = model_level["rung"];
        if (id.rfind("fe-", 0) != 0 || model_level["status"].is_null()) continue; // null: skipped for want of seconds
        EXPECT_EQ(model_level["status"], "not resolved") << id;
        EXPECT_TRUE(model_level["slip_mm"].is_null()) << id;
        seen = true;
    }
    EXPECT_TRUE(seen);
    EXPECT_EQ(answer.out.find("refused"), std::string::npos);
}

TEST(Audit, B3_a_seepage_that_is_not_solved_is_a_model_level_without_an_answer)
{
    Scene scene = read_scene(std::filesystem::path(source_dir()) / "examples/reference_dam.toml");
    scene.motion.records.resize(1);
    const Records records = load_records(scene, Method::rigid_block);
    const Watch nobody;
    scene.foundation->permeability = std::nan(""); // no solver finds an answer
    const ModelLevelRunner runner(scene, records, 0.0, nobody);
    const ModelLevelResult r = runner.run(parse_model_level("rigid:h").value());
    EXPECT_TRUE(r.ran() && !r.done());
    EXPECT_EQ(r.status, Status::not_resolved);
    EXPECT_NE(r.remark.find("seepage"), std::string::npos) << r.remark;
}

TEST(Audit, B3_whether_a_scene_can_be_reduced_is_asked_without_a_throw)
{
    const Scenes files;
    Scene scene = read_scene(files.block({}));
    EXPECT_FALSE(why_not_reducible(scene));
    EXPECT_NO_THROW(check_reducible(scene));
    scene.contact.sliding = JointPath::finite;
    const std::optional<Diagnostic> why_not = why_not_reducible(scene);
    ASSERT_TRUE(why_not);
    EXPECT_NE(why_not->problem.find("cannot take contact.sliding"), std::string::npos);
    EXPECT_THROW(check_reducible(scene), InputError);
}

TEST(Audit, B3_static_failure_by_all_model_levels_is_an_answer)
{
    const Scenes files;
    BlockText b;
    b.friction = 0.05;
    b.more = "[[force]]\nforce_x_kN_m = 60\n";
    const ProgramAnswer answer = answer_of({"accuracy", files.block(b), "--quick", "--repeats", "1", "--json"});
    EXPECT_EQ(answer.code, exit_ok) << answer.out << answer.talk;
    const json j = json::parse(answer.out);
    EXPECT_TRUE(j["choice"].is_null());
    EXPECT_TRUE(j["top"].is_null());
    ASSERT_FALSE(j["rungs"].empty());
    for (const json& model_level : j["rungs"]) EXPECT_EQ(model_level["status"], "static failure");
}

// ---- B4

TEST(Audit, B4_the_dams_period_without_a_reservoir_is_not_asked_for)
{
    const Scenes files;
    BlockText b;
    b.more = "[added_mass]\nperiod_s = \"dam\"\n";
    const std::string scene = files.block(b);
    Scene read = read_scene(scene);
    EXPECT_FALSE(resolve_dam_period(read));
    EXPECT_FALSE(read.added_mass.period);
    expect_status(swept_fe, scene, Status::at_rest);
    const ProgramAnswer reduced = answer_of({"sweep", scene, "--method", "fe-reduced", "--json"});
    EXPECT_EQ(reduced.code, exit_ok) << reduced.talk;
    expect_model_level("fe-dry:dt", scene, Status::at_rest);
    for (const char* model : {"hydrostatic", "acoustic"}) {
        b.more = fmt::format("[added_mass]\nperiod_s = \"dam\"\n[reservoir]\nlevel_m = 1\nlength_m = 20\nmodel = "
                             "\"{}\"\n[uplift]\nmodel = \"linear\"\n",
                             model);
        read = read_scene(files.block(b));
        EXPECT_FALSE(resolve_dam_period(read)) << model;
    }
    b.more = "[added_mass]\nperiod_s = \"dam\"\n[reservoir]\nlevel_m = 1\nmodel = \"added-mass\"\n[uplift]\nmodel = "
             "\"linear\"\n";
    b.section = "polygon_m = [[0, 0], [4, 0], [4, 40], [0, 40]]\n"; // slower than the metre of water
    read = read_scene(files.block(b));
    read.dam.young_modulus = 25e9;
    ASSERT_TRUE(resolve_dam_period(read));
    EXPECT_GT(*read.added_mass.period, 0.0);
}

// ---- B5

TEST(Audit, B5_a_slip_beyond_the_base_is_no_slip)
{
    const Scenes files;
    BlockText b;
    b.friction = 0.02; // a_y = 0.1962 m/s^2; the pulse leaves it coasting for metres
    b.more = "[criteria]\nallowable_slip_mm = 100\n";
    std::string scene = files.block(b);
    for (const Shown& shown : {screened, swept, ablated}) expect_status(shown, scene, Status::runs_away);
    expect_model_level("rigid:h", scene, Status::runs_away);
    EXPECT_EQ(rows_of(answer_of({"screen", scene, "--json"}), {"displacements"})[0]["verdict"], "FAIL");

    // The same slip on a longer base is one: its slip per area does not depend on the length.
    b.section = "polygon_m = [[0, 0], [80, 0], [80, 2], [0, 2]]\n";
    scene = files.block(b);
    for (const Shown& shown : {screened, swept, ablated}) expect_status(shown, scene, Status::at_rest);
    const json row = rows_of(answer_of({"screen", scene, "--json"}), {"displacements"})[0];
    EXPECT_GT(row["max_slip_m"].get<double>(), 8.0);
    EXPECT_EQ(row["verdict"], "FAIL");
}

TEST(Audit, B5_the_rule_stops_at_the_length_itself)
{
    RigidModel model;
    sliding::SlideResult r;
    r.max_slip = 8.0;
    check_length(model, r);
    EXPECT_EQ(r.status, Status::at_rest); // no length is known
    model.length = 8.0;
    check_length(model, r);
    EXPECT_EQ(r.status, Status::at_rest);
    model.length = std::nextafter(8.0, 0.0);
    check_length(model, r);
    EXPECT_EQ(r.status, Status::runs_away);
    r.status = Status::not_resolved; // says more
    check_length(model, r);
    EXPECT_EQ(r.status, Status::not_resolved);
}

// ---- A15

TEST(Audit, A15_an_unstable_wedge_has_one_yield_acceleration)
{
    const Scenes files;
    const std::string file = files.wedge(15.0, 10.0);
    const ProgramAnswer answer = answer_of({"screen", file, "--json"});
    const json yield = rows_of(answer, {"yield"})[0], row = rows_of(answer, {"displacements"})[0];
    const double a_y = yield["yield_acceleration_m_s2"];
    EXPECT_LT(a_y, 0.0);
    EXPECT_NEAR(a_y, row["yield_over_pga"].get<double>() * row["pga_m_s2"].get<double>(), 1e-12 * std::abs(a_y));
    EXPECT_EQ(row["status"], "static failure");
    EXPECT_TRUE(row["max_slip_m"].is_null());

    // It is the right one: pushed the other way by as much the wedge just stands.
    const Scene scene = read_scene(file);
    const RigidWedge w = make_rigid_wedge(scene);
    EXPECT_NEAR(wedge_state(w.wedge, w.push, a_y).factor_of_safety, 1.0, 1e-12);
    EXPECT_LT(wedge_state(w.wedge, w.push, 0.9 * a_y).factor_of_safety, 1.0);
    EXPECT_GT(wedge_state(w.wedge, w.push, 1.1 * a_y).factor_of_safety, 1.0);
    const json swept_row = rows_of(answer_of({"sweep", file, "--method", "rigid", "--json"}), {"rows"})[0];
    EXPECT_EQ(swept_row["yield_acceleration_m_s2"], yield["yield_acceleration_m_s2"]);
}

TEST(Audit, A15_a_wedge_has_one_critical_friction)
{
    const Scenes files;
    const std::string file = files.wedge(15.0, 10.0);
    const ProgramAnswer answer = answer_of({"screen", file, "--json"});
    const json stability = rows_of(answer, {"wedge"})[0];
    const double critical = stability["critical_friction"];
    const json row = rows_of(answer_of({"sweep", file, "--method", "rigid", "--json"}), {"rows"})[0];
    EXPECT_EQ(row["critical_friction"], stability["critical_friction"]);
    EXPECT_NE(answer.out.find(fmt::format("{:.4g} that would hold it", critical)), std::string::npos);
    // With it, as --friction and sweep set it, the wedge just stands.
    const auto factor = [&](double friction) {
        return make_rigid_wedge(with_friction(read_scene(file), friction)).still.factor_of_safety;
    };
    EXPECT_NEAR(factor(critical), 1.0, 1e-12);

    // Without friction on the first plane there is no share to keep: both get the same.
    const std::string smooth = files.wedge(0.0, 10.0);
    const double both = rows_of(answer_of({"screen", smooth, "--json"}), {"wedge"})[0]["critical_friction"];
    EXPECT_NEAR(make_rigid_wedge(with_friction(read_scene(smooth), both)).still.factor_of_safety, 1.0, 1e-12);
}

// ---- A16

TEST(Audit, A16_sweep_slips_of_fixed_steps_say_that_they_have_no_error_estimate)
{
    const Scenes files;
    BlockText b;
    b.friction = 0.15;
    const std::string scene = files.block(b); // time.substeps = 0
    const ProgramAnswer answer = answer_of({"sweep", scene, "--method", "rigid,fe", "--polarity", "1", "--json"});
    const json rows = rows_of(answer, {"rows"});
    EXPECT_TRUE(rows[0]["remark"].is_null()); // the rigid block has no such error
    EXPECT_TRUE(rows[1]["slip_error_m"].is_null());
    EXPECT_EQ(rows[1]["remark"], pages::no_error_estimate);
    EXPECT_NE(answer.talk.find("1 slip by finite elements has no error estimate"), std::string::npos) << answer.talk;
    EXPECT_TRUE(rows_of(answer, {"comparison"})[0]["largest_slip_error_mm"].is_null()); // not ± 0
    // Both polarities by default: their slips, mirrored, do not cancel.
    const ProgramAnswer both_ways = answer_of({"sweep", scene, "--method", "fe", "--json"});
    EXPECT_NE(both_ways.talk.find("2 slips by finite elements have no error estimate"), std::string::npos);
    const json mean = rows_of(both_ways, {"comparison"})[0];
    const double one = rows_of(answer, {"comparison"})[0]["mean_fe_mm"];
    EXPECT_GT(one, 50.0);
    EXPECT_NEAR(mean["mean_fe_mm"].get<double>(), one, 1e-6 * one);
    EXPECT_NEAR(mean["ratio_of_means"].get<double>(), 1.0, 0.01);

    b.time = "slip_tolerance = 0.1\n";
    const ProgramAnswer chosen =
        answer_of({"sweep", files.block(b), "--method", "fe,fe-whole-steps", "--polarity", "1", "--json"});
    const json both = rows_of(chosen, {"rows"});
    EXPECT_TRUE(both[0]["slip_error_m"].is_number());
    EXPECT_TRUE(both[0]["remark"].is_null());
    EXPECT_EQ(both[1]["remark"], pages::no_error_estimate);
    EXPECT_TRUE(rows_of(chosen, {"comparison"})[0]["largest_slip_error_mm"].is_number());
}

} // namespace

} // namespace damslip::audit_status_tests
