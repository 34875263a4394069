// Sweeps as a user runs them: the same bytes for any threads, parts, stops and resumptions.
#include "cli/sweep_command.hpp"
#include "store_changes.hpp"
#include "sweep_scene.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <map>
#include <random>
#include <set>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>

namespace damslip::sweep_tests {

namespace {

std::size_t lines_of(const std::string& text)
{
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST_F(SweepScene, AnyNumberOfThreadsGivesTheSameBytes)
{
    const Answer one = sweep(with(grid, {"--jobs", "1"}));
    ASSERT_EQ(one.code, 0) << one.talk;
    EXPECT_EQ(lines_of(one.out), 96u + 4);
    for (const char* jobs : {"2", "4"}) EXPECT_EQ(sweep(with(grid, {"--jobs", jobs})).out, one.out) << jobs;
}

TEST_F(SweepScene, EveryFeMethodGivesItsOwnRow)
{
    const Answer a =
        sweep({"--friction", "0.1", "--method",
               "rigid,fe,fe-exact,fe-penalty,fe-slip-tolerance,fe-goldgruber-2015,fe-reduced,fe-whole-steps",
               "--polarity", "1", "--penalty-stiffness", "1e9", "--truncation-error", "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto rows = nlohmann::json::parse(a.out)["rows"];
    ASSERT_EQ(rows.size(), 16u);
    std::map<std::string, double> slip;
    for (std::size_t i = 0; i < 8; ++i) slip[rows[i]["method"]] = rows[i]["slip_m"].get<double>();
    EXPECT_EQ(slip["fe"], slip["fe-exact"]);       // the scene's law is the exact one
    EXPECT_EQ(slip["fe"], slip["fe-whole-steps"]); // the scene has no sub-steps
    EXPECT_NE(slip["fe"], slip["fe-penalty"]);
    EXPECT_NE(slip["fe-penalty"], slip["fe-slip-tolerance"]);
    EXPECT_NE(slip["fe-slip-tolerance"], slip["fe-goldgruber-2015"]);
    // Nearly rigid block: within 1 % of the rigid one, whose slip is exact.
    EXPECT_NEAR(slip["fe"], slip["rigid"], 0.01 * slip["rigid"]);
    const auto& reduced = rows[6];
    EXPECT_EQ(reduced["method"], "fe-reduced");
    EXPECT_NEAR(reduced["slip_m"].get<double>(), slip["fe"],
                3 * reduced["truncation_error_m"].get<double>() + 1e-6 * slip["fe"]);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_TRUE(rows[i]["truncation_error_m"].is_null());

    // The row is the run of `damslip fe`.
    const Answer fe = answer_of({"fe", path("block.toml"), "--json"});
    ASSERT_EQ(fe.code, 0) << fe.talk;
    EXPECT_EQ(nlohmann::json::parse(fe.out)["runs"][0]["slip_mm"].get<double>(), 1e3 * slip["fe"]);
}

// The estimate is three runs of its own beside the row's: without it the slip has the same bits.
TEST_F(SweepScene, TheErrorOfModesIsEstimatedOnDemand)
{
    const std::vector<std::string> reduced = {"--friction", "0.1,0.12", "--method", "fe-reduced", "--json"};
    const Answer plain = sweep(reduced), estimated = sweep(with(reduced, {"--truncation-error"}));
    ASSERT_EQ(plain.code, 0) << plain.talk;
    ASSERT_EQ(estimated.code, 0) << estimated.talk;
    const auto without = nlohmann::json::parse(plain.out)["rows"], rows = nlohmann::json::parse(estimated.out)["rows"];
    ASSERT_EQ(without.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_TRUE(without[i]["truncation_error_m"].is_null());
        EXPECT_GE(rows[i]["truncation_error_m"].get<double>(), 0.0);
        EXPECT_EQ(without[i]["slip_m"], rows[i]["slip_m"]);
    }
}

TEST_F(SweepScene, SizeAndReservoirReachTheModel)
{
    const Answer a =
        sweep({"--size", "1,2", "--polarity", "1", "--reservoir", "auto,hydrostatic,zangar,acoustic", "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto rows = nlohmann::json::parse(a.out)["rows"];
    ASSERT_EQ(rows.size(), 16u); // 4 waters x 2 sizes x 2 records
    std::set<double> yields;
    for (const auto& row : rows) {
        EXPECT_EQ(row["level_m"].get<double>(), row["size"].get<double>()); // 1 m at size 1
        yields.insert(std::round(row["yield_acceleration_m_s2"].get<double>() * 1e12));
    }
    EXPECT_EQ(yields.size(), 3u); // hydrostatic, Zangar, and Westergaard for auto and acoustic; the size changes none
}

// The slips of a row are those of `damslip fe`, of the lift joint too; without joints the column is empty.
TEST_F(SweepScene, LiftJointsHaveAColumn)
{
    write("joint.toml", content("block.toml") + "[[lift_joint]]\nelevation_m = 1\nfriction = 0.12\n");
    const std::vector<std::string> one{"--friction", "0.1", "--method", "rigid,fe", "--json"};
    const Answer a = answer_of(with({"sweep", path("joint.toml")}, one));
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto rows = nlohmann::json::parse(a.out)["rows"];
    EXPECT_TRUE(rows[0]["lift_joint_slip_m"].is_null()); // the rigid block has no joints
    const Answer fe = answer_of({"fe", path("joint.toml"), "--json"});
    ASSERT_EQ(fe.code, 0) << fe.talk;
    const auto lift = nlohmann::json::parse(fe.out)["lift_joints"][0];
    EXPECT_GT(lift["largest_slip_mm"].get<double>(), 0.0);
    EXPECT_EQ(lift["largest_slip_mm"].get<double>(), 1e3 * rows[1]["lift_joint_slip_m"].get<double>());
    const Answer none = sweep(one);
    EXPECT_TRUE(nlohmann::json::parse(none.out)["rows"][1]["lift_joint_slip_m"].is_null());
}

// Of the method, whatever the scene says; in the comparison, too. What knows no rock has none.
TEST_F(SweepScene, EveryFeRowNamesItsRock)
{
    const std::string methods = "rigid,jibson-1998,fe,fe-reduced,fe-massless,fe-radiating,fe-goldgruber-2015";
    const auto rocks = [&](const std::string& foundation) {
        write("rock.toml", content("block.toml") + foundation);
        const Answer a = answer_of({"sweep", path("rock.toml"), "--method", methods, "--json"});
        EXPECT_EQ(a.code, 0) << a.talk;
        const auto j = nlohmann::json::parse(a.out);
        std::map<std::string, nlohmann::json> names;
        for (const auto& row : j["rows"]) names[row["method"]] = row["rock"];
        for (const auto& row : j["comparison"]) EXPECT_EQ(row["rock"], names[row["method"]]) << row["method"];
        EXPECT_EQ(j["comparison"].size(), 5u);
        return names;
    };
    const std::string massless = "massless rock, which keeps all waves", radiating = "radiating rock";
    std::map<std::string, nlohmann::json> names = rocks("[foundation]\nyoung_modulus_GPa = 2500\n");
    EXPECT_TRUE(names["rigid"].is_null());
    EXPECT_TRUE(names["jibson-1998"].is_null());
    EXPECT_EQ(names["fe"], radiating);
    EXPECT_EQ(names["fe-reduced"], radiating);
    EXPECT_EQ(names["fe-massless"], massless);
    EXPECT_EQ(names["fe-radiating"], radiating);
    EXPECT_EQ(names["fe-goldgruber-2015"], massless);
    names = rocks("[foundation]\nyoung_modulus_GPa = 2500\nmass = \"massless\"\n");
    EXPECT_EQ(names["fe"], massless);
    EXPECT_EQ(names["fe-radiating"], radiating);
    for (const auto& [method, rock] : rocks("")) {
        if (method.starts_with("fe")) {
            EXPECT_EQ(rock, "rigid base") << method;
        }
    }

    // Words with a comma stand between quotes.
    write("rock.toml", content("block.toml") + "[foundation]\nyoung_modulus_GPa = 2500\nmass = \"massless\"\n");
    const Answer csv = answer_of({"sweep", path("rock.toml"), "--method", "fe"});
    EXPECT_NE(csv.out.find(",\"" + massless + "\"\n"), std::string::npos) << csv.out;
}

TEST_F(SweepScene, PartsPutTogetherAreTheWhole)
{
    ASSERT_EQ(sweep(with(grid, {"--out", path("whole.csv")})).code, 0);
    std::vector<std::string> files;
    for (const int count : {2, 5}) {
        files.clear();
        for (int i = 0; i < count; ++i) {
            const Answer part = sweep(
                with(grid, {"--out", path("parts/r.csv"), "--shard", std::to_string(i) + "/" + std::to_string(count)}));
            ASSERT_EQ(part.code, 0) << part.talk;
            files.push_back(path("parts/r." + std::to_string(i) + "-of-" + std::to_string(count) + ".sqlite"));
        }
        std::reverse(files.begin(), files.end());
        std::vector<std::string> merge{"sweep", "--merge"};
        merge.insert(merge.end(), files.begin(), files.end());
        const Answer merged = answer_of(with(merge, {"--out", path("merged.csv")}));
        ASSERT_EQ(merged.code, 0) << merged.talk;
        EXPECT_EQ(content("merged.csv"), content("whole.csv")) << count;
    }
    // Its report has the charts of the whole's; with the scene also section, records and provenance.
    EXPECT_NE(content("merged.html").find("Slip over friction"), std::string::npos);
    EXPECT_EQ(content("merged.html").find("The section, to scale"), std::string::npos);
    std::filesystem::create_directories(folder / "two");
    for (const char* part : {"r.0-of-2.sqlite", "r.1-of-2.sqlite"})
        std::filesystem::copy(folder / "parts" / part, folder / "two" / part);
    const Answer with_scene = sweep({"--merge", path("two"), "--out", path("merged.csv")});
    ASSERT_EQ(with_scene.code, 0) << with_scene.talk;
    EXPECT_NE(content("merged.html").find("The section, to scale"), std::string::npos);
    write("other.toml", content("block.toml") + "[criteria]\nallowable_slip_mm = 1\n");
    const Answer other = answer_of({"sweep", path("other.toml"), "--merge", path("two"), "--out", path("other.csv")});
    EXPECT_EQ(other.code, 2);
    EXPECT_NE(other.talk.find("the parts are not of the scene"), std::string::npos) << other.talk;
    const Answer mixed = answer_of({"sweep", "--merge", path("parts")}); // parts of 2 and of 5
    EXPECT_EQ(mixed.code, 3);
    EXPECT_NE(mixed.talk.find("is not of the same sweep as"), std::string::npos) << mixed.talk;

    std::filesystem::remove(path("parts/r.0-of-2.sqlite"));
    std::filesystem::remove(path("parts/r.1-of-2.sqlite"));
    const Answer folder_of_five = answer_of({"sweep", "--merge", path("parts")});
    EXPECT_EQ(folder_of_five.out, content("whole.csv"));
    std::filesystem::remove(path("parts/r.1-of-5.sqlite"));
    std::filesystem::remove(path("parts/r.4-of-5.sqlite"));
    const Answer gaps = answer_of({"sweep", "--merge", path("parts")});
    EXPECT_EQ(gaps.code, 3);
    EXPECT_NE(gaps.talk.find("2 of 5 parts are missing: 1/5, 4/5."), std::string::npos) << gaps.talk;
    EXPECT_NE(gaps.talk.find("--shard 1/5, --shard 4/5"), std::string::npos) << gaps.talk;
    EXPECT_TRUE(gaps.out.empty());
}

/// The words of a plan's line, as sh splits them, without the program's name.
std::vector<std::string> arguments_of(const std::string& line, const std::filesystem::path& folder)
{
    const auto script = folder / "words.sh";
    std::ofstream(script) << "printf '%s\\n' " << line << "\n";
    std::FILE* pipe = ::popen(("sh " + cli::shell_quoted(script.string())).c_str(), "r");
    std::string text;
    for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
    ::pclose(pipe);
    std::vector<std::string> words;
    std::istringstream in(text);
    for (std::string word; std::getline(in, word);) words.push_back(word);
    words.erase(words.begin());
    return words;
}

TEST_F(SweepScene, TheCommandsOfThePlanMakeTheWhole)
{
    ASSERT_EQ(sweep(with(grid, {"--out", path("whole.csv")})).code, 0);
    const Answer plan = sweep(with(grid, {"--out", path("planned/r.csv"), "--plan"}));
    ASSERT_EQ(plan.code, 0) << plan.talk;
    std::istringstream lines(plan.out);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line); ++count)
        ASSERT_EQ(answer_of(arguments_of(line, folder)).code, 0) << line;
    EXPECT_EQ(count, 2u * 4); // variants x motions
    EXPECT_EQ(answer_of({"sweep", "--merge", path("planned")}).out, content("whole.csv"));
    EXPECT_EQ(lines_of(sweep(with(grid, {"--out", path("r.csv"), "--plan", "--parts", "3"})).out), 3u);
}

TEST_F(SweepScene, TheSlurmScriptIsAScriptWithOneElementPerPart)
{
    const Answer a =
        sweep(with(grid, {"--out", path("r.csv"), "--slurm-array", path("job.sh"), "--parts", "6", "--jobs", "2"}));
    ASSERT_EQ(a.code, 0) << a.talk;
    const std::string script = content("job.sh");
    EXPECT_EQ(script.find("#!/bin/sh\n"), 0u);
    EXPECT_NE(script.find("#SBATCH --array=0-5\n"), std::string::npos);
    EXPECT_NE(script.find("#SBATCH --cpus-per-task=2\n"), std::string::npos);
    // As Slurm runs an element, with a `damslip` that prints what it is asked.
    write("damslip", "#!/bin/sh\nprintf '%s\\n' \"$@\"\n");
    std::filesystem::permissions(folder / "damslip", std::filesystem::perms::owner_all);
    const std::string command = "PATH=" + cli::shell_quoted(folder.string()) +
                                ":$PATH SLURM_ARRAY_TASK_ID=4 SLURM_CPUS_PER_TASK=2 sh " +
                                cli::shell_quoted(path("job.sh"));
    std::FILE* pipe = ::popen(command.c_str(), "r");
    std::string text;
    for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
    EXPECT_EQ(::pclose(pipe), 0);
    EXPECT_NE(text.find("\n" + path("block.toml") + "\n"), std::string::npos) << text;
    EXPECT_NE(text.find("--jobs\n2\n--resume\n--quiet\n--shard\n4/6\n"), std::string::npos) << text;
}

/// Runs the sweep in a process of its own that gets the signal when its database has changed `times` times.
/// @returns the status of waitpid
int run_and_signal(const std::vector<std::string>& arguments, const std::filesystem::path& store, int times, int signal)
{
    const pid_t child = ::fork();
    if (child == 0) ::_exit(answer_of(arguments).code);
    int status = 0;
    std::error_code none;
    auto last = std::filesystem::last_write_time(store, none);
    while (::waitpid(child, &status, WNOHANG) == 0) {
        const auto now = std::filesystem::last_write_time(store, none);
        if (now != last && --times < 0) {
            ::kill(child, signal);
            ::waitpid(child, &status, 0);
            break;
        }
        last = now;
        std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    return status;
}

// Rows come into the database in groups; the killed process has finished some of them and is at some others.
TEST_F(SweepScene, KilledAtRandomMomentsAndResumedGivesTheSameBytes)
{
    const std::vector<std::string> many = with(grid, {"--scale", "0.5,1,1.5"}); // 288 rows
    ASSERT_EQ(sweep(with(many, {"--out", path("whole.csv")})).code, 0);
    const std::vector<std::string> stopped =
        with({"sweep", path("block.toml")}, with(many, {"--out", path("stopped.csv"), "--resume", "--jobs", "2"}));
    std::mt19937 random(20260);
    int kills = 0;
    for (int i = 0; i < 5; ++i)
        kills += WIFSIGNALED(
            run_and_signal(stopped, path("stopped.sqlite"), std::uniform_int_distribution<int>(1, 5)(random), SIGKILL));
    EXPECT_GE(kills, 3);
    EXPECT_FALSE(std::filesystem::exists(path("stopped.csv")));
    const Answer last = answer_of(stopped);
    ASSERT_EQ(last.code, 0) << last.talk;
    EXPECT_NE(last.talk.find("rows were finished before"), std::string::npos) << last.talk;
    EXPECT_EQ(content("stopped.csv"), content("whole.csv"));

    // Resumed once more, all rows are there and the same file is written.
    std::filesystem::remove(path("stopped.csv"));
    const Answer again = answer_of(stopped);
    EXPECT_NE(again.talk.find("288 rows were finished before"), std::string::npos) << again.talk;
    EXPECT_EQ(content("stopped.csv"), content("whole.csv"));
}

// Ctrl-C: runs under way are not results; what was finished stays, no table with gaps is written, exit code 4.
/// Rows that go out part by part: 3,001 frictions x 2 records x 2 polarities = 12,004.
const std::vector<std::string> long_grid{"--friction", "0.05:0.2:0.00005", "--polarity", "1,-1"};

TEST_F(SweepScene, ALongSweepIsTheSameWhateverItsPartsThreadsAndStops)
{
    const Answer whole = sweep(with(long_grid, {"--out", path("long.csv"), "--jobs", "1"}));
    ASSERT_EQ(whole.code, 0) << whole.talk;
    const std::string rows = content("long.csv");
    EXPECT_EQ(lines_of(rows), 12004u + 4);
    EXPECT_NE(content("long.html").find("The first 400 of 12004 rows"), std::string::npos);
    EXPECT_TRUE(sweep(with(long_grid, {"--jobs", "2"})).out == rows);

    for (int i = 0; i < 3; ++i) {
        const Answer part = sweep(with(long_grid, {"--out", path("parts/l.csv"), "--shard", std::to_string(i) + "/3"}));
        ASSERT_EQ(part.code, 0) << part.talk;
    }
    EXPECT_TRUE(answer_of({"sweep", "--merge", path("parts")}).out == rows);

    std::filesystem::remove(folder / "long.csv");
    leave_unfinished(folder / "long.sqlite", 3);
    const Answer again = sweep(with(long_grid, {"--out", path("long.csv"), "--resume"}));
    ASSERT_EQ(again.code, 0) << again.talk;
    EXPECT_NE(again.talk.find("rows were finished before"), std::string::npos) << again.talk;
    EXPECT_TRUE(content("long.csv") == rows);

    // The same rows as in a sweep of few.
    const Answer few = sweep({"--friction", "0.05,0.1,0.2", "--polarity", "1,-1"});
    std::istringstream lines(few.out);
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] == '#' || line[0] == 'i') continue;
        const std::string without_id = line.substr(line.find(','));
        EXPECT_NE(rows.find(without_id + "\n"), std::string::npos) << line;
    }
}

// A disk that is full, as a file that may not grow: refused by name, and what is finished stays.
TEST_F(SweepScene, AFullDiskIsSaidAndResumedGivesTheSameBytes)
{
    ASSERT_EQ(sweep(with(long_grid, {"--out", path("whole.csv")})).code, 0);
    const std::vector<std::string> command =
        with({"sweep", path("block.toml")}, with(long_grid, {"--out", path("full.csv"), "--resume"}));
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit most{400'000, 400'000};
        ::setrlimit(RLIMIT_FSIZE, &most);
        const Answer full = answer_of(command);
        ::_exit(full.talk.find("full.sqlite: error: cannot be written: ") == std::string::npos ? 99 : full.code);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 3);
    EXPECT_FALSE(std::filesystem::exists(path("full.csv")));
    const Answer again = answer_of(command);
    ASSERT_EQ(again.code, 0) << again.talk;
    EXPECT_NE(again.talk.find("rows were finished before"), std::string::npos) << again.talk;
    EXPECT_TRUE(content("full.csv") == content("whole.csv"));
}

TEST_F(SweepScene, InterruptedAndResumedGivesTheSameBytes)
{
    const std::vector<std::string> many = with(grid, {"--scale", "0.5,1,1.5"});
    ASSERT_EQ(sweep(with(many, {"--out", path("whole.csv")})).code, 0);
    const std::vector<std::string> stopped =
        with({"sweep", path("block.toml")}, with(many, {"--out", path("stopped.csv"), "--resume", "--jobs", "2"}));
    const int status = run_and_signal(stopped, path("stopped.sqlite"), 3, SIGINT);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 4);
    EXPECT_FALSE(std::filesystem::exists(path("stopped.csv")));
    EXPECT_EQ(sql(folder / "stopped.sqlite", "SELECT count(*) FROM rows WHERE status = 'interrupted'"), "0");
    EXPECT_EQ(answer_of(stopped).code, 0);
    EXPECT_EQ(content("stopped.csv"), content("whole.csv"));
}

// A sequence and anchors have columns of their own: the figures of `fe`, kept by the database, parts and merging.
TEST_F(SweepScene, EventsAndAnchorsHaveColumns)
{
    const std::string block = content("block.toml"), motion = "[[motion.record]]";
    const std::string anchor = "[[anchor]]\nname = \"bar, long\"\ndistance_m = 4\nfree_length_m = 10\narea_mm2_m = 20\n"
                               "yield_strength_MPa = 500\nrupture_strain = @\n";
    std::string named = block.substr(0, block.find(motion)) +
                        "[motion]\nsequence = [\"first\", \"second\"]\nsequence_pause_s = 1\n" + anchor +
                        "[[motion.record]]\nname = \"first\"\nhorizontal = \"pulse.csv\"\n[[motion.record]]\nname = "
                        "\"second\"\nhorizontal = \"late.csv\"\n";
    const auto with_rupture = [&](const std::string& strain) {
        std::string text = named;
        return text.replace(text.find('@'), 1, strain);
    };
    write("block.toml", with_rupture("0.5"));
    const std::vector<std::string> grid{"--friction", "0.1,0.12", "--polarity", "1", "--method", "rigid,fe"};
    const Answer a = sweep(with(grid, {"--json"}));
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto rows = nlohmann::json::parse(a.out)["rows"];
    ASSERT_EQ(rows.size(), 4u);
    const Answer fe = answer_of({"fe", path("block.toml"), "--json", "--no-mesh-error"});
    ASSERT_EQ(fe.code, 0) << fe.talk;
    const auto run = nlohmann::json::parse(fe.out);
    for (const auto& row : rows) {
        EXPECT_GT(row["slip_after_event_1_m"].get<double>(), 1e-3);
        EXPECT_GT(row["slip_after_event_2_m"].get<double>(), row["slip_after_event_1_m"].get<double>());
        EXPECT_EQ(row["slip_after_event_2_m"], row["slip_m"]) << "at rest after the last event";
        EXPECT_EQ(row["anchor_1_largest_force_N_m"].get<double>(), 1e4) << "A f_y, exactly: it yields";
        EXPECT_EQ(row["anchor_1_state"], "yielded");
        if (row["method"] != "fe" || row["friction"] != 0.1) continue;
        for (std::size_t k = 0; k < 2; ++k)
            EXPECT_DOUBLE_EQ(1e3 * row["slip_after_event_" + std::to_string(k + 1) + "_m"].get<double>(),
                             run["events"][k]["slip_so_far_mm"].get<double>());
    }

    ASSERT_EQ(sweep(with(grid, {"--out", path("whole.csv")})).code, 0);
    std::filesystem::copy_file(folder / "whole.csv", folder / "kept.csv");
    std::filesystem::remove(folder / "whole.csv");
    const Answer again = sweep(with(grid, {"--out", path("whole.csv"), "--resume"}));
    ASSERT_EQ(again.code, 0) << again.talk;
    EXPECT_NE(again.talk.find("4 rows were finished before"), std::string::npos) << again.talk;
    EXPECT_EQ(content("whole.csv"), content("kept.csv"));
    std::filesystem::create_directories(folder / "parts");
    for (const char* shard : {"0/2", "1/2"})
        ASSERT_EQ(sweep(with(grid, {"--out", path("parts/p.csv"), "--shard", shard})).code, 0);
    EXPECT_EQ(answer_of({"sweep", "--merge", path("parts")}).out, content("kept.csv"));

    write("block.toml", with_rupture("0.004"));
    const Answer snapped = sweep(with(grid, {"--json"}));
    ASSERT_EQ(snapped.code, 0) << snapped.talk;
    for (const auto& row : nlohmann::json::parse(snapped.out)["rows"]) EXPECT_EQ(row["anchor_1_state"], "snapped");
}

} // namespace

} // namespace damslip::sweep_tests
