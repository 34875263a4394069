// Records of a folder, a pattern or a list, paired by their names.
#include "analysis/prepare/record_list.hpp"
#include "core/input_error.hpp"
#include "program_answer.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace damslip {

namespace {

using Kind = records::Component;

TEST(ComponentName, is_read_from_the_ways_agencies_name_files)
{
    const struct {
        const char* file;
        Kind kind;
        const char* base;
    } rows[] = {{"RSN6_IMPVALL.I_I-ELC180.AT2", Kind::horizontal, "RSN6_IMPVALL.I_I-ELC"},
                {"RSN6_IMPVALL.I_I-ELC-UP.AT2", Kind::vertical, "RSN6_IMPVALL.I_I-ELC"},
                {"RSN4863_CHUETSU_65036EW.AT2", Kind::horizontal, "RSN4863_CHUETSU_65036"},
                {"RSN4863_CHUETSU_65036UD.AT2", Kind::vertical, "RSN4863_CHUETSU_65036"},
                {"backup.csv", Kind::none, "backup"}, // no separator: not guessed
                {"rock_2.0_long_h.csv", Kind::horizontal, "rock_2.0_long"},
                {"rock_2.0_long_v.csv", Kind::vertical, "rock_2.0_long"},
                {"AKT0010311091313.EW", Kind::horizontal, "AKT0010311091313"},
                {"AKT0010311091313.UD2", Kind::vertical, "AKT0010311091313.2"}, // at the surface
                {"station_H1.txt", Kind::horizontal, "station"},
                {"station-vert.txt", Kind::vertical, "station"},
                {"elcentro_1940_ns.txt", Kind::horizontal, "elcentro_1940"},
                {"pulse.csv", Kind::none, "pulse"},
                {"run_1940.csv", Kind::none, "run_1940"}, // a year is no azimuth
                {"ab999.at2", Kind::none, "ab999"}};
    for (const auto& row : rows) {
        const std::vector<ComponentName> names = component_names(row.file);
        const ComponentName found = *std::ranges::find(names, true, &ComponentName::alone);
        EXPECT_EQ(found.kind, row.kind) << row.file;
        EXPECT_EQ(found.base, row.base) << row.file;
    }
}

class RecordFolder : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip suite " + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        for (const char* name : {"a_h.csv", "a_v.csv", "b090.csv", "b000.csv", "b-up.csv", "alone.csv", "c_up.csv"})
            write(name, "time_s,accel_m_s2\n0,0\n1," + std::to_string(1 + name[0] % 3) + "\n2,0\n3,0\n");
        write("readme.md", "no record");
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }

    std::filesystem::path folder;
};

TEST_F(RecordFolder, components_of_a_station_are_one_event_with_one_vertical)
{
    const RecordList list = record_list(folder.string());
    ASSERT_EQ(list.records.size(), 4u);
    const struct {
        const char *name, *vertical, *event, *other;
    } rows[] = {{"a_h", "a_v.csv", "a", ""},
                {"alone", "", "alone", ""},
                {"b000", "b-up.csv", "b", "b090.csv"},
                {"b090", "b-up.csv", "b", "b000.csv"}};
    const auto name_of = [](const std::optional<std::filesystem::path>& file) {
        return file ? file->filename().string() : std::string();
    };
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(list.records[i].name, rows[i].name);
        EXPECT_EQ(name_of(list.records[i].vertical), rows[i].vertical);
        EXPECT_EQ(name_of(list.records[i].other_horizontal), rows[i].other);
        EXPECT_EQ(list.events[i], rows[i].event);
    }
    ASSERT_EQ(list.notes.size(), 3u); // c_up.csv has no horizontal component
    EXPECT_NE(list.notes[0].find("c_up.csv"), std::string::npos);
    EXPECT_EQ(list.notes[1], "without a vertical component: alone.");
    EXPECT_EQ(list.notes[2], "neither header nor name says the component, taken as horizontal: alone.csv.");
    EXPECT_EQ(record_list((folder / "b*.csv").string()).records.size(), 2u);
    EXPECT_TRUE(record_list((folder / "z*").string()).records.empty());
}

TEST_F(RecordFolder, a_list_says_it_all)
{
    write("list.csv",
          "# two of them\nhorizontal,vertical,event,weight,scale\na_h.csv,,e1,2,1.5\nb000.csv,b-up.csv,e1,1,1\n");
    const RecordList list = record_list((folder / "list.csv").string());
    ASSERT_EQ(list.records.size(), 2u);
    EXPECT_EQ(list.events, (std::vector<std::string>{"e1", "e1"}));
    EXPECT_EQ(list.weights, (std::vector<double>{2.0, 1.0}));
    EXPECT_EQ(list.records[0].scale, 1.5);
    EXPECT_FALSE(list.records[0].vertical);
    write("pairs.csv", "horizontal,other_horizontal\nb000.csv,b090.csv\na_h.csv,\n");
    const RecordList pairs = record_list((folder / "pairs.csv").string());
    EXPECT_EQ(pairs.records[0].other_horizontal, folder / "b090.csv");
    EXPECT_FALSE(pairs.records[1].other_horizontal);
    write("bad.csv", "horizontal,weigth\na_h.csv,1\n");
    EXPECT_THROW(record_list((folder / "bad.csv").string()), InputError);
    write("gone.csv", "horizontal\nnowhere.csv\n");
    EXPECT_THROW(record_list((folder / "gone.csv").string()), InputError);
}

TEST_F(RecordFolder, a_list_has_a_heading_for_each_field)
{
    const auto refused = [&](const std::string& text) -> std::string {
        write("list.csv", text);
        try {
            record_list((folder / "list.csv").string());
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    for (const auto& [text, words] :
         {std::pair<std::string, std::string>{"horizontal,scale\na_h.csv,1,5\n",
                                              "list.csv:2: error: 3 fields below 2 headings."},
          {"horizontal\na_h.csv,a_v.csv\n", "list.csv:2: error: 2 fields below 1 heading."},
          {"horizontal,horizontal\na_h.csv,a_v.csv\n", "list.csv:1: error: the column horizontal stands twice."},
          {"horizontal,scale,scale\na_h.csv,1,3\n", "list.csv:1: error: the column scale stands twice."}})
        EXPECT_NE(refused(text).find(words), std::string::npos) << refused(text);
    EXPECT_EQ(refused("horizontal,vertical,scale\na_h.csv,a_v.csv,2,,\nb000.csv\n"), ""); // nothing is lost
}

TEST_F(RecordFolder, a_list_of_seeds_is_made_first)
{
    write("seeds.csv", "name,seed,pga_m_s2,duration_s,event,weight,vertical\nx,1,2,5,quake,3,no\n");
    RecordList list = record_list((folder / "seeds.csv").string());
    ASSERT_EQ(list.records.size(), 1u);
    EXPECT_EQ(list.records[0].name, "x");
    EXPECT_EQ(list.records[0].horizontal, folder / "seeds" / "x_h.csv");
    EXPECT_EQ(list.events, std::vector<std::string>{"quake"});
    EXPECT_EQ(list.weights, std::vector<double>{3.0});
    EXPECT_NE(list.made.find("1 of 1"), std::string::npos) << list.made;
    EXPECT_TRUE(record_list((folder / "seeds.csv").string()).made.empty());
    const std::filesystem::path index = folder / "seeds" / ".damslip-index.csv";
    const ProgramAnswer first = answer_of({"record", "suite", (folder / "seeds.csv").string()});
    ASSERT_EQ(first.code, 0) << first.talk;
    EXPECT_TRUE(std::filesystem::exists(index));
    EXPECT_EQ(answer_of({"record", "suite", (folder / "seeds.csv").string()}).out, first.out);
}

constexpr const char* listed_block =
    "[section]\nheight_m = 10\nbase_m = 20\n[dam]\ndensity_kg_m3 = 2000\n[contact]\nfriction = 0.1\n";

/// All that `screen` warns of.
std::string screen_warnings(const std::vector<std::string>& arguments)
{
    std::vector<std::string> all{"screen", "--rigid-only", "--json"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const ProgramAnswer a = answer_of(all);
    EXPECT_EQ(a.code, 0) << a.talk;
    return a.code == 0 ? nlohmann::json::parse(a.out)["warnings"].dump() : "";
}

TEST_F(RecordFolder, components_against_their_headers_are_named)
{
    const std::string samples = "# units: m/s2\n# dt: 0.1 s\n0\n2\n-2\n0\n";
    write("p.csv", "# component: v\n" + samples);
    write("q.csv", "# component: h\n" + samples);
    const auto scene = [&](const std::string& horizontal, const std::string& vertical) {
        write("dam.toml", listed_block + ("[[motion.record]]\nhorizontal = \"" + horizontal + "\"\nvertical = \"" +
                                          vertical + "\"\n"));
        return (folder / "dam.toml").string();
    };
    const std::string p = "p.csv: vertical by its header (v), taken as horizontal.",
                      q = "q.csv: horizontal by its header (h), taken as vertical.";
    const std::string swapped = screen_warnings({scene("p.csv", "q.csv")});
    EXPECT_NE(swapped.find(p), std::string::npos) << swapped;
    EXPECT_NE(swapped.find(q), std::string::npos) << swapped;
    EXPECT_EQ(screen_warnings({scene("q.csv", "p.csv")}).find("by its header"), std::string::npos);
    write("list.csv", "horizontal\np.csv\n");
    const std::string list = (folder / "list.csv").string();
    const std::string listed = screen_warnings({scene("q.csv", "p.csv"), "--records", list});
    EXPECT_NE(listed.find(p), std::string::npos) << listed;
    const ProgramAnswer slide = answer_of({"slide", "--yield-g", "0.05", "--records", list});
    EXPECT_NE(slide.talk.find(p), std::string::npos) << slide.talk;
}

TEST_F(RecordFolder, factors_on_a_stated_peak_are_named)
{
    const auto warned = [&](const std::string& motion, const std::string& record,
                            const std::vector<std::string>& more) {
        write("dam.toml",
              listed_block + ("[motion]\n" + motion + "[[motion.record]]\nhorizontal = \"a_h.csv\"\n" + record));
        std::vector<std::string> arguments{(folder / "dam.toml").string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return screen_warnings(arguments);
    };
    const std::string pga = "scale_to_pga_m_s2 = 3\n",
                      words = "motion.scale_to_pga = 3 m/s2 is followed by a factor of 2";
    EXPECT_EQ(warned(pga, "", {}).find("scale_to_pga"), std::string::npos);
    EXPECT_EQ(warned("scale = 2\n", "scale = 2\n", {}).find("scale_to_pga"), std::string::npos);
    for (const std::string& said :
         {warned(pga + "scale = 2\n", "", {}), warned(pga, "scale = 2\n", {}), warned(pga, "", {"--scale", "2"})}) {
        EXPECT_NE(said.find(words), std::string::npos) << said;
        EXPECT_NE(said.find("is 6 m/s2 (0.6118 g)"), std::string::npos) << said;
    }
}

TEST_F(RecordFolder, records_of_the_command_line_take_the_scenes_place)
{
    write("dam.toml", "[section]\nheight_m = 10\nbase_m = 20\n[dam]\ndensity_kg_m3 = 2000\n[contact]\nfriction = 0.1\n"
                      "[[motion.record]]\nhorizontal = \"alone.csv\"\n");
    const std::string scene = (folder / "dam.toml").string();
    const ProgramAnswer a = answer_of({"screen", scene, "--records", (folder / "b*").string(), "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto answer = nlohmann::json::parse(a.out);
    ASSERT_EQ(answer["records"].size(), 2u);
    EXPECT_EQ(answer["records"][0]["name"], "b000");
    EXPECT_FALSE(answer["records"][0]["vertical"].is_null());
    const ProgramAnswer none = answer_of({"screen", scene, "--records", (folder / "z*").string()});
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.talk.find("there is no record"), std::string::npos) << none.talk;
    const ProgramAnswer twice =
        answer_of({"screen", scene, "--records", folder.string(), "--record", (folder / "a_h.csv").string()});
    EXPECT_EQ(twice.code, 2);
}

} // namespace

} // namespace damslip
