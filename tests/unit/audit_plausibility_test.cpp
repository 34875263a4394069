// Values that are allowed but not those of real dams are noted, with what they may have been meant as; --strict refuses them.

#include "program_answer.hpp"
#include "scene/plausible.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <unistd.h>

namespace damslip::plausibility_tests {

namespace {

constexpr const char* dam_text = "[section]\nheight_m = 60\nbase_m = 45\ncrest_m = 6\n"
                                 "[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa = 25\n"
                                 "[contact]\nfriction = 0.8\n";

/// Water asks for a word on the uplift; what it is does not matter here.
std::vector<Diagnostic> notes_of(std::string text)
{
    if (text.find("[reservoir]") != std::string::npos) text += "[uplift]\nmodel = \"none\"\n";
    return parse_scene(text, "dam.toml", FileCheck::skip).notes;
}

/// The only note of a scene, on one line.
std::string only_note_of(const std::string& text)
{
    const std::vector<Diagnostic> notes = notes_of(text);
    EXPECT_EQ(notes.size(), 1u);
    return notes.empty() ? "" : note_text(notes.front());
}

/// The dam with one line replaced.
std::string dam_with(const std::string& old_line, const std::string& new_line)
{
    std::string text = dam_text;
    const std::size_t at = text.find(old_line);
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, old_line.size(), new_line);
}

std::string content_of(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
}

/// A folder with a dam, the same with its Young's modulus in MPa by mistake, and short pulses.
class Folder {
public:
    Folder()
    {
        std::filesystem::create_directories(at);
        write("pulse.csv", "time_s,accel_m_s2\n0,0\n0.5,2\n1,0\n1.5,-2\n2,0\n");
        write("up.csv", "time_s,accel_m_s2\n0,0\n0.5,0.5\n1,0\n1.5,-0.5\n2,0\n");
        const std::string motion = "[[motion.record]]\nhorizontal = \"pulse.csv\"\n";
        write("dam.toml", dam_text + motion);
        write("stiff.toml", dam_with("young_modulus_GPa = 25", "young_modulus_GPa = 28000") + motion);
    }
    ~Folder() { std::filesystem::remove_all(at); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    void write(const std::string& name, const std::string& text) const { std::ofstream(at / name) << text; }
    std::string path(const std::string& name) const { return (at / name).string(); }

    const std::filesystem::path at =
        std::filesystem::temp_directory_path() / ("damslip_plausible_" + std::to_string(::getpid()));
};

TEST(Audit, A18_a_dam_as_it_should_be_has_no_note)
{
    EXPECT_TRUE(notes_of(dam_text).empty());
}

TEST(Audit, A18_a_value_one_unit_step_away_is_named_with_its_place_range_and_source)
{
    EXPECT_EQ(
        only_note_of(dam_with("young_modulus_GPa = 25", "young_modulus_GPa = 28000")),
        "dam.toml:7: dam.young_modulus_GPa = 28000 is unusual. Usual: 10 ... 50 GPa (ACI 207.1R). 28 GPa if MPa was "
        "meant:  young_modulus_MPa = 28000.");
    EXPECT_EQ(
        only_note_of(dam_with("young_modulus_GPa = 25", "young_modulus_MPa = 20")),
        "dam.toml:7: dam.young_modulus_MPa = 20, 0.02 GPa, is unusual. Usual: 10 ... 50 GPa (ACI 207.1R). 20 GPa if "
        "GPa was meant:  young_modulus_GPa = 20.");
    EXPECT_EQ(
        only_note_of(std::string(dam_text) + "[reservoir]\nlevel_m = 55\ndensity_kg_m3 = 1\n"),
        "dam.toml:12: reservoir.density_kg_m3 = 1 is unusual. Usual: 990 ... 1100 kg/m3 (CRC Handbook). 1000 kg/m3 "
        "if t/m3 was meant:  density_t_m3 = 1.");
    EXPECT_EQ(
        only_note_of(std::string(dam_text) + "cohesion_MPa = 300\n"),
        "dam.toml:10: contact.cohesion_MPa = 300, 300000 kPa, is unusual. Usual: 1 ... 3000 kPa (EPRI 1992). 300 kPa "
        "if kPa was meant:  cohesion_kPa = 300.");
    EXPECT_EQ(only_note_of(std::string(dam_text) + "[foundation]\nyoung_modulus_GPa = 20\npermeability_m_s = 1e3\n"),
              "dam.toml:12: foundation.permeability_m_s = 1000 is unusual. Usual: 1e-12 ... 0.01 m/s (Freeze & Cherry "
              "1979). 0.001 m/s if the minus of the exponent is missing.");
}

TEST(Audit, A18_angles_per_cent_and_the_unit_g_are_steps_too)
{
    const auto has = [](const std::string& note, const std::string& part) {
        EXPECT_NE(note.find(part), std::string::npos) << note;
    };
    has(only_note_of(dam_with("friction = 0.8", "friction_deg = 0.7")),
        "0.7 if the plain number was meant:  friction = 0.7");
    has(only_note_of(dam_with("friction = 0.8", "friction = 7")), "0.7 if the decimal point is one place off");
    has(only_note_of(std::string(dam_text) + "[motion]\nscale_to_pga_g = 4\n"),
        "4 m/s2 if m/s2 was meant:  scale_to_pga_m_s2 = 4");
    has(only_note_of(std::string(dam_text) + "[damping]\nratio = 0.5\n"), "0.05 if the decimal point is one place off");
    has(only_note_of(std::string(dam_text) + "[uplift]\nmodel = \"points\"\npoints_m = [[0, 1.5], [45, 0]]\n"),
        "uplift.points_m with the second entry 1.5");
}

TEST(Audit, A18_levels_are_looked_at_beside_the_crest_and_each_other)
{
    const std::string water = std::string(dam_text) + "[reservoir]\nlevel_m = 75\novertopped = true\n";
    EXPECT_EQ(only_note_of(water),
              "dam.toml:11: reservoir.level_m = 75 is 15 m above the crest at 60 m. Usual: up to the "
              "crest, 60 m; higher only at a spillway, or in a flood that overtops the dam (EM "
              "1110-2-2200). Check datum and unit: levels are measured from the heel.");
    const std::string tail = std::string(dam_text) + "[reservoir]\nlevel_m = 20\n[tailwater]\nlevel_m = 30\n";
    EXPECT_NE(only_note_of(tail).find("tailwater.level_m = 30 is above reservoir.level_m = 20."), std::string::npos);
    const std::string flood = std::string(dam_text) + "[reservoir]\nlevel_m = 55\novertopped = true\n[[combination]]\nname = \"flood\"\n"
                                                      "kind = \"extreme\"\nreservoir_level_m = ";
    EXPECT_TRUE(notes_of(flood + "63\n").empty());
    EXPECT_EQ(notes_of(flood + "75\n").size(), 1u);
    EXPECT_EQ(notes_of(std::string(dam_text) + "[drains]\ndistance_m = 30\n").size(), 1u); // far from the heel
}

TEST(Audit, A18_every_number_has_a_usual_range_with_a_source_or_a_reason_for_none)
{
    std::set<std::string, std::less<>> without, used, known;
    for (const NoUsualRange& key : no_usual_range()) without.insert(std::string(key.key));
    for (const UsualSource& source : usual_sources()) known.insert(std::string(source.name));
    SectionInput section;
    Scene scene;
    for (const KeyGroup& group : key_groups(section))
        for (const Key& key : group.keys) {
            const std::string name = group.name + "." + key.name;
            if (key.units.empty()) continue;
            EXPECT_NE(key.usual.has_value(), without.contains(name)) << name;
            without.erase(name);
            if (!key.usual) continue;
            EXPECT_LT(key.usual->low, key.usual->high) << name;
            for (const double end : {key.usual->low, key.usual->high}) // an end that is not allowed itself may be one
                EXPECT_TRUE(key.range.contains(end) || end == key.range.low || end == key.range.high)
                    << name << ": usual " << end << ", allowed " << key.range.text();
            std::istringstream sources(key.usual->source);
            for (std::string source; std::getline(sources >> std::ws, source, ';');) {
                EXPECT_TRUE(known.contains(source)) << name << ": " << source;
                used.insert(source);
            }
        }
    EXPECT_TRUE(without.empty()) << *without.begin() << " is no key";
    EXPECT_EQ(used, known);
}

TEST(Audit, A18_shipped_scenes_raise_no_note)
{
    int scenes = 0;
    for (const char* below : {"/examples", "/tests/report"})
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(source_dir() + std::string(below))) {
            if (entry.path().extension() != ".toml" || entry.path().parent_path().filename() == "criteria") continue;
            ++scenes;
            for (const std::string& note : note_texts(read_scene(entry.path()).notes)) ADD_FAILURE() << note;
        }
    EXPECT_GE(scenes, 16);
}

TEST(Audit, A18_schema_and_key_page_carry_the_range_and_its_source)
{
    const auto schema = nlohmann::json::parse(answer_of({"schema"}).out);
    const auto& modulus = schema["properties"]["dam"]["properties"];
    EXPECT_EQ(modulus["young_modulus_GPa"]["usual"]["maximum"], 50.0);
    EXPECT_EQ(modulus["young_modulus_MPa"]["usual"]["minimum"], 10'000.0);
    EXPECT_EQ(modulus["young_modulus_GPa"]["usual"]["source"], "ACI 207.1R");
    EXPECT_NEAR(schema["properties"]["contact"]["properties"]["friction_deg"]["usual"]["maximum"].get<double>(), 58.0,
                0.1);
    const std::string page = answer_of({"schema", "--markdown"}).out;
    EXPECT_NE(page.find("| 10 ... 50 (ACI 207.1R) |"), std::string::npos);
    EXPECT_NE(page.find("| ACI 207.1R | ACI Committee 207"), std::string::npos);
}

TEST(Audit, A18_notes_reach_standard_error_text_json_and_report)
{
    const Folder folder;
    const std::string part = "dam.young_modulus_GPa = 28000 is unusual.";
    const ProgramAnswer text = answer_of({"screen", folder.path("stiff.toml"), "--out", folder.path("out")});
    ASSERT_EQ(text.code, 0) << text.talk;
    EXPECT_NE(text.talk.find("note: " + folder.path("stiff.toml") + ":7: " + part), std::string::npos) << text.talk;
    EXPECT_NE(text.out.find(part), std::string::npos);
    EXPECT_NE(content_of(folder.at / "out" / "report.html").find(part), std::string::npos);
    const auto has_note = [&](const std::vector<std::string>& arguments, const char* key) {
        const ProgramAnswer a = answer_of(arguments);
        EXPECT_NE(a.talk.find(part), std::string::npos) << arguments[0];
        EXPECT_NE(nlohmann::json::parse(a.out)[key].dump().find(part), std::string::npos) << arguments[0] << a.out;
    };
    has_note({"screen", folder.path("stiff.toml"), "--json"}, "warnings");
    has_note({"sweep", folder.path("stiff.toml"), "--json"}, "notes");
    has_note({"explain", folder.path("stiff.toml"), "--json"}, "notes");
    has_note({"mesh", folder.path("stiff.toml"), "--json"}, "notes");
    EXPECT_TRUE(answer_of({"screen", folder.path("stiff.toml"), "--quiet"}).talk.empty());
    EXPECT_EQ(answer_of({"screen", folder.path("dam.toml")}).talk.find("unusual"), std::string::npos);
}

TEST(Audit, A18_strict_refuses_before_anything_is_computed)
{
    const Folder folder;
    for (const char* command : {"screen", "fe", "sweep", "modes", "mesh", "explain", "accuracy"}) {
        std::vector<std::string> arguments{command, folder.path("stiff.toml"), "--strict"};
        const ProgramAnswer a = answer_of(arguments);
        EXPECT_EQ(a.code, 3) << command << a.talk;
        EXPECT_EQ(a.out, "") << command;
        EXPECT_NE(a.talk.find(folder.path("stiff.toml") +
                              ":7:21: error: dam.young_modulus_GPa = 28000 is unusual.\n"
                              "  expected: 10 ... 50 GPa (ACI 207.1R)\n"
                              "  fix:      28 GPa if MPa was meant:  young_modulus_MPa = 28000"),
                  std::string::npos)
            << command << a.talk;
    }
    EXPECT_EQ(answer_of({"screen", folder.path("dam.toml"), "--strict"}).code, 0);
    EXPECT_EQ(answer_of({"screen", folder.path("dam.toml"), "--strict", "--friction", "7"}).code, 3);
    EXPECT_EQ(answer_of({"sweep", folder.path("dam.toml"), "--strict", "--scale", "0,5"}).code, 3);
}

TEST(Audit, A18_values_of_the_command_line_are_looked_at_like_their_keys)
{
    const Folder folder;
    const auto talk = [&](std::vector<std::string> arguments) {
        const ProgramAnswer a = answer_of(arguments);
        EXPECT_EQ(a.code, 0) << a.talk;
        return a.talk;
    };
    EXPECT_NE(
        talk({"screen", folder.path("dam.toml"), "--friction", "7"})
            .find("note: --friction 7 is unusual. Usual: 0.1 ... 1.6 (Skempton 1985; Barton & Choubey 1977). 0.7 if "
                  "the decimal point is one place off."),
        std::string::npos);
    EXPECT_NE(talk({"screen", folder.path("dam.toml"), "--scale", "100"}).find("--scale 100 is unusual."),
              std::string::npos);
    EXPECT_NE(talk({"sweep", folder.path("dam.toml"), "--friction-deg", "2,35"})
                  .find("--friction-deg 2, 0.0349208, is unusual. Usual: 0.1 ... 1.6 (Skempton 1985; Barton & Choubey "
                        "1977). Check value and unit."),
              std::string::npos);
    EXPECT_NE(
        talk({"sweep", folder.path("dam.toml"), "--size", "1,10"}).find("--size 10: a height of 600 m is unusual."),
        std::string::npos);
}

TEST(Audit, A18_a_decimal_comma_is_not_read_as_two_frictions)
{
    const Folder folder;
    const ProgramAnswer a = answer_of({"sweep", folder.path("dam.toml"), "--friction", "0,7"});
    EXPECT_EQ(a.code, 2);
    EXPECT_EQ(a.out, "");
    EXPECT_EQ(a.talk, "error: --friction 0,7 is read as two values, 0 and 7, and neither is usual.\n"
                      "  expected: 0.1 ... 1.6 (Skempton 1985; Barton & Choubey 1977)\n"
                      "  fix:      a decimal comma? write  --friction 0.7 ; for the two values  --friction 0.0,7\n");
    EXPECT_EQ(answer_of({"sweep", folder.path("dam.toml"), "--friction", "0.0,7"}).code, 0);
    const ProgramAnswer scale = answer_of({"sweep", folder.path("dam.toml"), "--scale", "0,5"});
    EXPECT_EQ(scale.code, 0);
    EXPECT_NE(scale.talk.find("A decimal comma? write  --scale 0.5."), std::string::npos) << scale.talk;
    for (const char* list : {"0,84,0,77", "0,65:1,0:0,05"}) {
        const ProgramAnswer b = answer_of({"sweep", folder.path("dam.toml"), "--friction", list});
        EXPECT_EQ(b.code, 2) << list;
        EXPECT_NE(b.talk.find("decimal point"), std::string::npos) << b.talk;
    }
}

/// Standard input for as long as it lives.
class StandardInput {
public:
    explicit StandardInput(const std::string& text) : text_(text), before_(std::cin.rdbuf(text_.rdbuf())) {}
    ~StandardInput()
    {
        std::cin.rdbuf(before_);
        std::cin.clear();
    }

private:
    std::istringstream text_;
    std::streambuf* before_;
};

TEST(Audit, C_screen_reads_the_scene_from_standard_input)
{
    const Folder folder;
    const std::vector<std::string> record{"--record", folder.path("pulse.csv"), "--json"};
    const auto with_scene = [&](const std::string& scene) {
        std::vector<std::string> arguments{"screen", scene};
        arguments.insert(arguments.end(), record.begin(), record.end());
        return answer_of(arguments);
    };
    folder.write("plain.toml", dam_text);
    const ProgramAnswer of_file = with_scene(folder.path("plain.toml"));
    ProgramAnswer of_input;
    {
        const StandardInput input(dam_text);
        of_input = with_scene("-");
    }
    ASSERT_EQ(of_input.code, 0) << of_input.talk;
    const auto a = nlohmann::json::parse(of_file.out), b = nlohmann::json::parse(of_input.out);
    EXPECT_EQ(a["displacements"], b["displacements"]);
    EXPECT_EQ(b["scene"]["file"], "standard input");

    const StandardInput wrong("[contact]\nfriction = -1\n");
    const ProgramAnswer refused = with_scene("-");
    EXPECT_EQ(refused.code, 3);
    EXPECT_NE(refused.talk.find("standard input:2:12: error: contact.friction = -1 is not allowed."), std::string::npos)
        << refused.talk;
}

TEST(Audit, C_standard_input_cannot_be_read_by_the_commands_of_a_plan)
{
    const Folder folder;
    const StandardInput input(dam_text);
    const ProgramAnswer a =
        answer_of({"sweep", "-", "--record", folder.path("pulse.csv"), "--out", folder.path("r.csv"), "--plan"});
    EXPECT_EQ(a.code, 2) << a.talk;
    EXPECT_NE(a.talk.find("--plan with a scene from standard input."), std::string::npos) << a.talk;
}

TEST(Audit, C_a_record_without_vertical_component_stands_beside_one_that_has_it)
{
    const Folder folder;
    std::filesystem::copy(folder.at / "pulse.csv", folder.at / "other.csv");
    const auto slips = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"screen", folder.path("dam.toml"), "--friction", "0.2", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramAnswer a = answer_of(arguments);
        EXPECT_EQ(a.code, 0) << a.talk;
        return nlohmann::json::parse(a.out);
    };
    const auto both = slips(
        {"--record", folder.path("pulse.csv"), folder.path("other.csv"), "--vertical", "none", folder.path("up.csv")});
    EXPECT_FALSE(both["records"][0].contains("vertical"));
    EXPECT_TRUE(both["records"][1].contains("vertical"));
    const auto alone = slips({"--record", folder.path("other.csv"), "--vertical", folder.path("up.csv")});
    EXPECT_EQ(both["displacements"][2], alone["displacements"][0]);

    const ProgramAnswer short_of_one =
        answer_of({"screen", folder.path("dam.toml"), "--record", folder.path("pulse.csv"), folder.path("other.csv"),
                   "--vertical", folder.path("up.csv")});
    EXPECT_EQ(short_of_one.code, 2);
    EXPECT_NE(short_of_one.talk.find("none for a record without one"), std::string::npos) << short_of_one.talk;
}

TEST(Audit, C_the_resolved_scene_has_the_sizes_of_elements_and_gives_the_same_bits)
{
    const Folder folder;
    folder.write("block.toml", "[section]\npolygon_m = [[0, 0], [8, 0], [8, 2], [0, 2]]\n[dam]\ndensity_kg_m3 = 2500\n"
                               "young_modulus_GPa = 25\n[foundation]\nyoung_modulus_GPa = 20\nmass = \"massless\"\n"
                               "[contact]\nfriction = 0.1\n[reservoir]\nlevel_m = 1\nmodel = "
                               "\"acoustic\"\n[uplift]\nmodel = \"none\"\n[damping]\nmethod = \"none\"\n[mesh]\nsize_m = 1\n"
                               "[time]\ndt_s = 0.02\nsubsteps = 1\n[[motion.record]]\nhorizontal = \"pulse.csv\"\n");
    const ProgramAnswer first = answer_of(
        {"fe", folder.path("block.toml"), "--polarity", "1", "--no-mesh-error", "--out", folder.path("first")});
    ASSERT_EQ(first.code, 0) << first.talk;
    const std::string resolved = content_of(folder.at / "first" / "scene.resolved.toml");
    for (const char* size :
         {"\nsize_m = 1.0\n", "\ncontact_size_m = 0.13333333333333333\n", "\nrock_size_m = ", "\nmesh_size_m = 0.05\n"})
        EXPECT_NE(resolved.find(size), std::string::npos) << size << resolved;
    const ProgramAnswer second = answer_of({"fe", folder.path("first/scene.resolved.toml"), "--polarity", "1",
                                            "--no-mesh-error", "--out", folder.path("second")});
    ASSERT_EQ(second.code, 0) << second.talk;
    const std::array hashes{scene_hash(read_scene(folder.path("block.toml"))),
                            scene_hash(read_scene(folder.path("first/scene.resolved.toml")))};
    const auto resolved_hash = [&](const char* run) {
        return nlohmann::json::parse(content_of(folder.at / run / "summary.json"))["scene"]["resolved_hash"];
    };
    EXPECT_TRUE(resolved_hash("first").is_string());
    EXPECT_EQ(resolved_hash("first"), resolved_hash("second"));
    int compared = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.at / "first")) {
        if (entry.path().extension() != ".csv") continue;
        ++compared;
        std::string as_second = content_of(entry.path()); // but for the hash of the input, which is another file now
        const std::size_t at = as_second.find(hashes[0]);
        ASSERT_NE(at, std::string::npos) << entry.path();
        as_second.replace(at, hashes[0].size(), hashes[1]);
        EXPECT_EQ(as_second, content_of(folder.at / "second" / entry.path().filename())) << entry.path();
    }
    EXPECT_GE(compared, 4);
    EXPECT_EQ(resolved, content_of(folder.at / "second" / "scene.resolved.toml"));
}

} // namespace

} // namespace damslip::plausibility_tests
