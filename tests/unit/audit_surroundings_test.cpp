// The program in its surroundings: where output goes, what names may do, files that were cut.
#include "agency_files.hpp"
#include "cli/terminal/terminal.hpp"
#include "core/file.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "pages/report/table_text.hpp"
#include "program_answer.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace damslip::audit_surroundings {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file)
{
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A folder with a dry block that slides under one pulse.
class Workplace {
public:
    Workplace() : folder(fs::temp_directory_path() / ("damslip_surroundings_" + std::to_string(::getpid())))
    {
        fs::create_directories(folder);
        std::ofstream(folder / "pulse.csv") << "time_s,accel_m_s2\n0,0\n1,2\n2,0\n3,0\n";
        write_scene("block", "pulse");
    }
    ~Workplace() { fs::remove_all(folder); }
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;

    void write_scene(const std::string& title, const std::string& record) const
    {
        std::ofstream(folder / "block.toml")
            << "title = \"" << title
            << "\"\n[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\n"
               "young_modulus_GPa = 25\n[contact]\nfriction = 0.1\n[[motion.record]]\n"
               "name = \""
            << record << "\"\nhorizontal = \"pulse.csv\"\n";
    }
    std::string in(const std::string& name) const { return (folder / name).string(); }
    ProgramAnswer sweep_to(const std::string& out) const
    {
        return answer_of({"sweep", in("block.toml"), "--out", out});
    }

    const fs::path folder;
};

// ------------------------------------------------------------------ output paths

TEST(Audit, C_a_link_is_written_through)
{
    const Workplace w;
    std::ofstream(w.folder / "real.csv") << "old";
    fs::create_symlink("real.csv", w.folder / "link.csv"); // relative to its own folder
    ASSERT_EQ(w.sweep_to(w.in("link.csv")).code, 0);
    EXPECT_TRUE(fs::is_symlink(w.folder / "link.csv"));
    EXPECT_NE(bytes_of(w.folder / "real.csv").find("slip_m"), std::string::npos);
    fs::create_symlink("new.csv", w.folder / "dangling.csv");
    write_file(w.folder / "dangling.csv", "x");
    EXPECT_EQ(bytes_of(w.folder / "new.csv"), "x");
}

TEST(Audit, C_devices_and_pipes_are_never_replaced)
{
    const Workplace w;
    const std::string record = w.in("pulse.csv");
    ASSERT_EQ(answer_of({"record", "convert", record, "--out", "/dev/null"}).code, 0);
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    ASSERT_EQ(::mkfifo(w.in("pipe").c_str(), 0600), 0);
    std::string taken;
    std::thread reader([&] { taken = bytes_of(w.folder / "pipe"); });
    const ProgramAnswer piped = answer_of({"record", "convert", record, "--out", w.in("pipe")});
    reader.join();
    EXPECT_EQ(piped.code, 0) << piped.talk;
    EXPECT_TRUE(fs::is_fifo(w.folder / "pipe"));
    EXPECT_NE(taken.find("\n2\n"), std::string::npos) << taken;
    const ProgramAnswer swept = w.sweep_to(w.in("pipe")); // a database lies beside the rows of a sweep
    EXPECT_EQ(swept.code, 2);
    EXPECT_NE(swept.talk.find("is a device or a pipe"), std::string::npos) << swept.talk;
    EXPECT_TRUE(fs::is_fifo(w.folder / "pipe"));
}

TEST(Audit, C_a_full_device_is_an_error_of_the_output)
{
    const Workplace w;
    const ProgramAnswer a = answer_of({"record", "convert", w.in("pulse.csv"), "--out", "/dev/full"});
    EXPECT_EQ(a.code, 3);
    EXPECT_NE(a.talk.find("/dev/full"), std::string::npos);
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(Audit, C_a_folder_for_a_file_is_refused_before_anything_is_computed)
{
    const Workplace w;
    fs::create_directory(w.folder / "results");
    const std::string scene = w.in("no_such_scene.toml"); // would be the first error of a command that begins
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"sweep", scene, "--out", w.in("results")},
                                               {"mesh", scene, "--out", w.in("results")},
                                               {"record", "convert", scene, "--out", w.in("results")},
                                               {"record", "generate", "--out", w.in("results")},
                                               {"accuracy", scene, "--svg", w.in("results")},
                                               {"accuracy", scene, "--report", w.in("results")}}) {
        const ProgramAnswer a = answer_of(command);
        EXPECT_EQ(a.code, 2) << command[0];
        EXPECT_NE(a.talk.find("is a folder"), std::string::npos) << a.talk;
    }
    for (const char* command : {"screen", "fe", "modes", "accuracy"}) {
        const ProgramAnswer a = answer_of({command, scene, "--out", w.in("pulse.csv")});
        EXPECT_EQ(a.code, 2) << command;
        EXPECT_NE(a.talk.find("is not a folder"), std::string::npos) << a.talk;
    }
    const ProgramAnswer below = answer_of({"screen", scene, "--out", w.in("pulse.csv/deep/er")});
    EXPECT_EQ(below.code, 2);
    EXPECT_NE(below.talk.find("is not a folder"), std::string::npos) << below.talk;
    EXPECT_EQ(w.sweep_to(w.in("a/b/c.csv")).code, 0); // folders that are missing are made
    EXPECT_TRUE(fs::exists(w.folder / "a/b/c.csv"));
}

TEST(Audit, C_output_names_that_break_scripts_are_refused)
{
    const Workplace w;
    for (const char* name : {"a\nrm -rf x.csv", "a\033[2J.csv", "a\x7f.csv"}) {
        const ProgramAnswer a = w.sweep_to(w.in(name));
        EXPECT_EQ(a.code, 2);
        EXPECT_NE(a.talk.find("control character"), std::string::npos) << a.talk;
        EXPECT_EQ(a.talk.find('\033'), std::string::npos);
    }
    fs::copy_file(w.folder / "block.toml", w.folder / "block\nrm x.toml");
    const ProgramAnswer plan = answer_of({"sweep", w.in("block\nrm x.toml"), "--plan", "--out", w.in("rows.csv")});
    EXPECT_EQ(plan.code, 2);
    EXPECT_EQ(plan.out, "");
    const ProgramAnswer script =
        answer_of({"sweep", w.in("block.toml"), "--slurm-array", w.in("job"), "--out", w.in("rows of mine;x.csv")});
    ASSERT_EQ(script.code, 0) << script.talk;
    EXPECT_NE(bytes_of(w.folder / "job").find("--out '"), std::string::npos);
    EXPECT_EQ(w.sweep_to("").code, 2);
    EXPECT_EQ(w.sweep_to(w.in("rows.html")).code, 2); // where the report goes
    EXPECT_EQ(w.sweep_to(w.in(std::string(300, 'x') + ".csv")).code, 2);
}

TEST(Audit, C_nothing_is_left_of_a_file_that_could_not_be_written)
{
    const Workplace w;
    fs::create_directory(w.folder / "there.csv");
    EXPECT_THROW(write_file(w.folder / "there.csv", "x"), InputError);
    EXPECT_THROW(write_file(w.folder / "pulse.csv" / "below.csv", "x"), InputError);
    for (const auto& entry : fs::directory_iterator(w.folder))
        EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
}

// ------------------------------------------------------------------ names

TEST(Audit, C_long_names_make_short_files_that_differ)
{
    const Workplace w;
    const std::string a(300, 'a'), b = std::string(299, 'a') + "b";
    EXPECT_EQ(file_word("rock 1.0 m/s2"), "rock_1.0_m_s2");
    EXPECT_LE(file_word(a).size(), 80u);
    EXPECT_NE(file_word(a), file_word(b));
    EXPECT_EQ(file_word(a), file_word(a));
    w.write_scene("long", a);
    const ProgramAnswer run = answer_of({"fe", w.in("block.toml"), "--base", "tied", "--out", w.in("fe")});
    ASSERT_EQ(run.code, 0) << run.talk;
    EXPECT_TRUE(fs::exists(w.folder / "fe" / ("history_" + file_word(a) + "_+1.csv")));
}

TEST(Audit, C_names_are_no_formulas_for_spreadsheets)
{
    const Workplace w;
    Table t;
    t.columns = {{"name", "", "", 4}, {"value", "", "", 4}};
    for (const char* name : {"=1+1", "+1", "-1", "@SUM(A1)", "plain", "a=b"})
        t.rows.push_back({std::string(name), -1.5});
    EXPECT_EQ(pages::csv(t), "name,value\n'=1+1,-1.5\n'+1,-1.5\n'-1,-1.5\n'@SUM(A1),-1.5\nplain,-1.5\na=b,-1.5\n");
    t.rows = {{std::string("\t=1"), 2.0}, {std::string("\r=1"), 2.0}};
    EXPECT_EQ(pages::csv(t), "name,value\n␉=1,2\n␍=1,2\n");
    EXPECT_EQ(pages::csv({}, {"record x\n=1+1"}), "# record x␊=1+1\n\n");

    w.write_scene("formula", "=HYPERLINK(1)");
    ASSERT_EQ(answer_of({"sweep", w.in("block.toml"), "--shard", "0/1", "--out", w.in("rows.csv")}).code, 0);
    ASSERT_EQ(answer_of({"sweep", "--merge", w.in("rows.0-of-1.sqlite"), "--out", w.in("merged.csv")}).code, 0);
    EXPECT_NE(bytes_of(w.folder / "merged.csv").find(",'=HYPERLINK(1),"), std::string::npos);
    EXPECT_EQ(bytes_of(w.folder / "merged.html").find("'=HYPERLINK"), std::string::npos);
}

TEST(Audit, C_names_cannot_steer_a_terminal)
{
    const Workplace w;
    w.write_scene("\\u001B[2J\\u001B[31mPASS\\u009B1m\\nslip 0 mm", "\\u001B]0;x\\u0007\\u202Egnp");
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"screen", w.in("block.toml")},
                                               {"explain", w.in("block.toml")},
                                               {"sweep", w.in("block.toml")},
                                               {"screen", w.in("block.toml"), "--json"},
                                               {"screen", w.in("block.toml"), "--\033[2J"},
                                               {"\033[2Jscreen"}}) {
        const ProgramAnswer a = answer_of(command);
        for (const std::string& text : {a.out, a.talk})
            for (const char* steering : {"\033", "\a", "\xC2\x9B", "\xE2\x80\xAE"})
                EXPECT_EQ(text.find(steering), std::string::npos) << command[0] << ": " << text.substr(0, 300);
    }
    const ProgramAnswer a = answer_of({"screen", w.in("block.toml")});
    EXPECT_EQ(a.out.substr(0, a.out.find('\n')).find("␛[2J␛[31mPASS\uFFFD1m slip 0 mm"), 0u);
}

TEST(Audit, C_visible_streams_see_characters_that_come_in_pieces)
{
    std::ostringstream sink;
    cli::VisibleStream stream(sink);
    for (const char c : std::string("a\xC2\x9B"
                                    "b\xE2\x80\xAE"
                                    "c — ü \tx\n"))
        stream << c;
    stream.flush();
    EXPECT_EQ(sink.str(), "a\uFFFD"
                          "b\uFFFD"
                          "c — ü \tx\n");
}

// ------------------------------------------------------------------ progress, interruption, output that fails

TEST(Audit, C_progress_has_lines_where_there_is_no_terminal)
{
    std::ostringstream out, talk;
    const cli::Streams streams{out, talk};
    {
        cli::Progress progress(streams, "fe", 4, std::chrono::milliseconds(0));
        progress.phase("set-up");
        progress.advance(1);
    }
    EXPECT_EQ(talk.str().substr(0, 10), "fe: set-up");
    EXPECT_NE(talk.str().find("\nfe: 25 %, "), std::string::npos) << talk.str();
    EXPECT_NE(talk.str().find("s left\nfe: stopped at 25 % after "), std::string::npos) << talk.str();
    EXPECT_EQ(talk.str().find('\r'), std::string::npos);
    talk.str("");
    {
        cli::Progress progress(streams, "sweep", 1);
        progress.advance(1);
    }
    EXPECT_EQ(talk.str().find("sweep: 100 %, "), 0u) << talk.str();
    talk.str("");
    const cli::Streams quiet{out, talk, cli::Form::text, true};
    {
        cli::Progress progress(quiet, "sweep", 1, std::chrono::milliseconds(0));
        progress.phase("set-up");
        progress.advance(1);
    }
    EXPECT_EQ(talk.str(), "");
    EXPECT_EQ(out.str(), "");
}

TEST(Audit, C_set_up_of_finite_elements_can_be_stopped)
{
    const Workplace w;
    const Scene scene = read_scene(w.in("block.toml"));
    for (int most = 0; most < 20; ++most) { // at whichever question the answer is yes
        int asked = 0;
        fe2d::RunOptions options;
        options.stop = [&] { return asked++ >= most; };
        try {
            const fe2d::EarthquakeRun run(scene, options);
            EXPECT_GT(most, 5); // several questions before it is ready
            return;
        } catch (const Interrupted& stop) {
            EXPECT_NE(std::string(stop.what()).find("set-up"), std::string::npos);
        }
    }
    FAIL() << "asks for ever";
}

TEST(Audit, C_output_that_cannot_be_written_has_its_own_code)
{
    const Workplace w;
    std::ofstream full("/dev/full");
    std::ostringstream talk;
    EXPECT_EQ(cli::run_program({"screen", w.in("block.toml")}, full, talk, false), 3);
    EXPECT_NE(talk.str().find("standard output could not be written"), std::string::npos);
    EXPECT_EQ(talk.str().find("internal"), std::string::npos);
    std::ofstream full_again("/dev/full");
    EXPECT_EQ(cli::run_program({"--help"}, full_again, talk, false), 3);
}

// ------------------------------------------------------------------ records

std::string at2(const std::string& samples, int count)
{
    return "PEER NGA\nTEST, 2000, HERE, 90\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  " + std::to_string(count) +
           ", DT= .0100 SEC\n" + samples;
}

std::string refusal(const std::string& text)
{
    return agency_files::refusal(text, "r", {});
}

TEST(Audit, C_an_at2_file_cut_in_its_last_exponent_is_refused)
{
    const std::string whole = "  .1234567E-02 -.2345678E-02  .3456789E-02  .4567890E-02  .5678901E-02\n"
                              "  .1234567E-02 -.2345678E-02  .3456789E-02  .4567890E-02  .4800000E-17\n";
    EXPECT_EQ(refusal(at2(whole, 10)), "");
    for (const std::size_t cut : {2u, 3u, 4u, 5u, 6u, 9u}) { // within exponent and mantissa
        const std::string text = at2(whole.substr(0, whole.size() - cut), 10);
        EXPECT_NE(refusal(text).find("r:6:59: error: "), std::string::npos) << cut << refusal(text);
    }
    // An editor may have put the line end back.
    EXPECT_NE(refusal(at2(whole.substr(0, whole.size() - 2) + "\n", 10)).find("the file looks cut here"),
              std::string::npos);
    // Whole numbers without the last line end, and numbers of differing length.
    EXPECT_EQ(refusal(at2(whole.substr(0, whole.size() - 1), 10)), "");
    EXPECT_EQ(refusal(at2("0.1 0.25 -0.125 1e-05 0.5 0.1 0.2 0.3 1e-3 0", 10)), "");
}

TEST(Audit, C_other_files_cut_in_their_last_number_are_refused)
{
    const std::string cut = "the file looks cut";
    const std::string column = "# dt: 0.01 s\n# units: m/s2\n0.1234\n-0.2345\n0.3456\n0.4567\n-0.5678";
    EXPECT_EQ(refusal(column), "");
    EXPECT_NE(refusal(column.substr(0, column.size() - 2)).find(cut), std::string::npos);
    const std::string pairs = "time_s,accel_g\n0.00,1.0E-04\n0.01,2.0E-04\n0.02,-3.0E-04\n0.03,4.0E-04\n0.04,4.8E-17\n";
    EXPECT_EQ(refusal(pairs), "");
    EXPECT_NE(refusal(pairs.substr(0, pairs.size() - 2)).find(cut), std::string::npos);

    agency_files::Esm esm;
    esm.count = "5", esm.pga = "-3.0", esm.values = "1.000000\n-3.000000\n2.500000\n1.250000\n-1.000";
    EXPECT_NE(refusal(esm.text()).find(cut), std::string::npos) << refusal(esm.text());
    esm.values += "000\n";
    EXPECT_EQ(refusal(esm.text()), "");

    agency_files::Smc smc;
    smc.data = "    1.5000   -2.2500    3.0000\n";
    EXPECT_EQ(refusal(smc.text()), "");
    smc.data = "    1.5000   -2.2500    3.00";
    EXPECT_NE(refusal(smc.text()).find(cut), std::string::npos) << refusal(smc.text());
}

TEST(Audit, C_a_unit_line_against_the_peak_of_the_header_is_refused)
{
    agency_files::Esm esm; // samples 1, -3, 2.5; "PGA_CM/S^2: -3.0"
    EXPECT_EQ(refusal(esm.text()), "");
    esm.units = "g";
    const std::string said = refusal(esm.text());
    EXPECT_NE(said.find("the largest sample is 29.42 m/s2, the file's header says 0.03 m/s2 (samples in g)"),
              std::string::npos)
        << said;
    EXPECT_NE(said.find("r:12: error"), std::string::npos) << said;
    esm.units = "m/s^2";
    EXPECT_NE(refusal(esm.text()), "");

    agency_files::KNet k_net;
    for (int k = 0; k < 100; ++k) k_net.counts.push_back(k == 50 ? 100 : 0);
    EXPECT_EQ(refusal(k_net.text()), "");
    k_net.peak = "61.5"; // a thousand times what the samples are
    EXPECT_NE(refusal(k_net.text()).find("the file's header says"), std::string::npos);

    agency_files::Csmip csmip;
    csmip.data = "        8 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)\r\n" +
                 agency_files::fields({1, 2, 3, 4, 5, 6, 7, -8}, 8, 10, 3);
    EXPECT_EQ(refusal(csmip.text()), "");
    std::string text = csmip.text();
    text.replace(text.find("TEXT\r\n"), 4, "PEAK ACCELERATION =   -8.0 CM/SEC/SEC     AT   .140 SEC");
    EXPECT_EQ(refusal(text), "");
    text.replace(text.find("(UNITS: CM/SEC/SEC)"), 19, "(UNITS: G)");
    EXPECT_NE(refusal(text).find("the file's header says 0.08 m/s2"), std::string::npos) << refusal(text);

    agency_files::Cosmos cosmos; // samples 1, -2, 3 cm/s2; real header value 64
    std::string with_peak = cosmos.text();
    const std::size_t reals = with_peak.find("Real-header");
    std::size_t row = with_peak.find('\n', reals) + 1; // 6 values of 13 characters a line: 64 is the fourth of line 11
    for (int k = 0; k < 10; ++k) row = with_peak.find('\n', row) + 1;
    with_peak.replace(row + 3 * 13, 13, "     3.000000");
    EXPECT_EQ(refusal(with_peak), "");
    with_peak.replace(row + 3 * 13, 13, "     0.003060"); // as if the samples were mg
    EXPECT_NE(refusal(with_peak).find("the file's header says"), std::string::npos);
}

} // namespace
} // namespace damslip::audit_surroundings
