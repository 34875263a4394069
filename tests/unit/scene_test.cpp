#include "core/input_error.hpp"
#include "scene/scene_text.hpp"
#include "scene/read.hpp"
#include "scene/section.hpp"
#include "scene/write.hpp"
#include "source_dir.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

namespace {

using namespace damslip;

const char* const minimal = R"([section]
height_m = 62.5
base_m = 45
crest_m = 12
neck_m = 11
[dam]
density_kg_m3 = 2500
[contact]
friction = 0.77
)";

Scene parse(const std::string& text)
{
    return parse_scene(text, "folder/dam.toml", FileCheck::skip);
}

TEST(Scene, SectionByDimensionsIsTheReferencePolygon)
{
    const Scene scene = parse(minimal);
    const Polyline expected{{0, 0}, {45, 0}, {12, 51.5}, {12, 62.5}, {0, 62.5}};
    EXPECT_EQ(scene.section.polygon, expected);
    EXPECT_DOUBLE_EQ(area(scene.section), 1599.75); // 12 * 62.5 + (45 - 12) * 51.5 / 2
    EXPECT_EQ(upstream_face(scene.section), (Polyline{{0, 0}, {0, 62.5}}));
    EXPECT_EQ(downstream_face(scene.section), (Polyline{{45, 0}, {12, 51.5}, {12, 62.5}}));
}

// What is found wrong after reading has the line of the key or table that it names.
TEST(Scene, AMessageWithoutALineGetsThatOfItsKey)
{
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("damslip line " + std::to_string(::getpid()) + ".toml");
    std::ofstream(file) << "# a comment\n" << minimal << "sliding = \"finite\"\n[reservoir]\nlevel_m = 40\n[[seam]]\nname = \"A\"\n[[seam]]\n"
                        << "name = \"B\"\nexit = \"toe\"\n";
    const auto line = [&](const std::string& problem, const std::string& fix = "") {
        return with_line(Diagnostic{file.string(), 0, 0, problem, "", fix}).line;
    };
    EXPECT_EQ(line("contact.sliding = \"finite\" with [lifts]."), 11);
    EXPECT_EQ(line("reservoir.level is above."), 13); // with its unit in the file
    EXPECT_EQ(line("the dam, see [reservoir], is dry."), 12);
    EXPECT_EQ(line("seam[2] \"B\" ends there."), 16);
    EXPECT_EQ(line("seam[2].exit is unknown."), 18);
    EXPECT_EQ(line("[[seam]] is not followed."), 14);
    EXPECT_EQ(line("nothing is found.", "write it in [dam]"), 7);
    EXPECT_EQ(line("no.such key, nor [uplift] e.g. 3.5 of seam[7]."), 0);
    EXPECT_EQ(with_line(Diagnostic{file.string(), 3, 0, "contact.sliding", {}, {}}).line, 3); // it has one
    std::filesystem::remove(file);
    EXPECT_EQ(line("contact.sliding"), 0);
}

TEST(Scene, AbsentTablesStayAbsent)
{
    const Scene scene = parse(minimal);
    EXPECT_FALSE(scene.reservoir || scene.tailwater || scene.silt || scene.ice || scene.uplift || scene.drains ||
                 scene.curtain || scene.foundation);
    EXPECT_EQ(scene.title, "dam");
}

TEST(Scene, OtherUnitsGiveTheSameScene)
{
    std::string text = minimal;
    text.replace(text.find("height_m = 62.5"), 15, "height_mm = 62500");
    text.replace(text.find("density_kg_m3 = 2500"), 20, "density_t_m3 = 2.5");
    const Scene scene = parse(text);
    EXPECT_DOUBLE_EQ(scene.section.polygon[3].y, 62.5);
    EXPECT_DOUBLE_EQ(scene.dam.density, 2500);
    text.replace(text.find("friction = 0.77"), 15, "friction_deg = 45");
    EXPECT_NEAR(parse(text).contact.friction, 1.0, 1e-15);
}

TEST(Scene, CurtainWithWaterMeansSeepageUplift)
{
    const Scene scene = parse(std::string(minimal) + "[curtain]\ndistance_m = 7\n[reservoir]\n");
    ASSERT_TRUE(scene.uplift);
    EXPECT_EQ(scene.uplift->model, UpliftModel::seepage);
    EXPECT_DOUBLE_EQ(scene.reservoir->level, 62.5);
    EXPECT_DOUBLE_EQ(scene.reservoir->length, 62.5); // absorbing far end: one depth
}

TEST(Scene, ResolvedSceneReadsBackBitForBit)
{
    const std::string text = std::string(minimal) +
                             "cohesion_kPa = 0.3\nresidual_friction_deg = 31.7\nresidual_slip_mm = 7.3\n"
                             "[reservoir]\nlevel_ft = 200\n[uplift]\ncrack = \"static\"\n[silt]\nlevel_m = "
                             "9.7\nsubmerged_unit_weight_kN_m3 = 9.1\n"
                             "pressure_coefficient = 0.45\n[ice]\nforce_kN_m = 133.3\n[[force]]\nname = \"gate "
                             "\\\"A\\\"\"\nx_ft = 3.3\nforce_x_kN_m = 0.1\n"
                             "[[motion.record]]\nhorizontal = \"a.csv\"\nunit = \"g\"\n[[combination]]\nname = "
                             "\"flood\"\nkind = \"unusual\"\ncrack = \"static\"\n"
                             "[added_mass]\nperiod_s = \"dam\"\nzangar_table_deg = [[0, 0.73], [29.9, "
                             "0.5]]\n[foundation]\nyoung_modulus_GPa = 30\n"
                             "[expect]\nyield_acceleration_m_s2 = { value = 0.1, digits = 3, source = \"by hand\" }\n";
    const Scene first = parse(text);
    const std::string resolved = resolved_toml(first);
    const Scene second = parse_scene(resolved, "elsewhere/dam.toml", FileCheck::skip);
    EXPECT_EQ(resolved_toml(second), resolved);
    EXPECT_EQ(first.contact.cohesion, second.contact.cohesion);
    EXPECT_EQ(*first.contact.residual_friction, *second.contact.residual_friction);
    EXPECT_EQ(first.reservoir->level, second.reservoir->level);
    EXPECT_EQ(first.forces[0].at.x, second.forces[0].at.x);
    EXPECT_EQ(first.added_mass.zangar_table, second.added_mass.zangar_table);
    EXPECT_EQ(scene_hash(first), scene_hash(second));
}

TEST(Scene, HashChangesWithTheModelOnly)
{
    const Scene scene = parse(minimal);
    std::string other = minimal;
    EXPECT_EQ(scene_hash(scene), scene_hash(parse("# a comment\n" + other)));
    other.replace(other.find("0.77"), 4, "0.78");
    EXPECT_NE(scene_hash(scene), scene_hash(parse(other)));
}

const char* const of_project = R"([project]
name = "Review"
client = "Owner of the dam"
author = "Name of the engineer"
checker = "Name of the \"second\" checker"
date = "2026-01-31"
revision = "B"
notes = "first line\nsecond"
)";

TEST(Scene, AProjectIsReadAndWrittenAndIsNoPartOfTheHash)
{
    const Scene with = parse(of_project + std::string(minimal));
    EXPECT_EQ(with.project.client, "Owner of the dam");
    EXPECT_EQ(with.project.checker, "Name of the \"second\" checker");
    EXPECT_EQ(with.project.revision, "B");
    const Scene again = parse(resolved_toml(with));
    EXPECT_EQ(again.project.notes, with.project.notes);
    EXPECT_EQ(again.project.date, "2026-01-31");
    const Scene without = parse(minimal);
    EXPECT_EQ(resolved_toml(without).find("[project]"), std::string::npos);
    EXPECT_EQ(scene_hash(with), scene_hash(without)) << "another revision of the report has the same numbers";
}

TEST(Scene, ADateOfAProjectIsAText)
{
    try {
        parse("[project]\ndate = 2026-01-31\n" + std::string(minimal));
        FAIL() << "a date without quotes was taken";
    } catch (const InputError& error) {
        const std::string what = error.what();
        EXPECT_NE(what.find("project.date = a date"), std::string::npos) << what;
        EXPECT_NE(what.find("a text in quotes"), std::string::npos) << what;
    }
}

TEST(Scene, KeyDocumentationIsCurrent)
{
    std::ifstream in(std::string(source_dir()) + "/docs/scene-keys.md");
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    EXPECT_TRUE(text == scene_keys_markdown()) << "make it again: damslip schema --markdown > docs/scene-keys.md";
}

} // namespace
