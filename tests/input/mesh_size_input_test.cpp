// Element sizes that no machine could hold.
#include "core/input_error.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

std::string size_message(const std::string& more)
{
    try {
        parse_scene("[section]\nheight_m = 62.5\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = "
                    "0.77\n[foundation]\nyoung_modulus_GPa = 30\nmass = \"massless\"\n[reservoir]\nlevel_m = 60\n" +
                        more + "[uplift]\nmodel = \"none\"\n",
                    "dam.toml", FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

TEST(MeshSizeInput, AbsurdlySmallElementsAreRefusedBeforeAnythingIsMeshed)
{
    EXPECT_EQ(size_message("[mesh]\ncontact_size_m = 1e-9\n"),
              "dam.toml:14:1: error: mesh.contact_size_m = 1e-09 makes 4.5e+10 elements along the 45 m of the base.\n"
              "  expected: at most 2000 elements there: 0.0225 m or more\n"
              "  fix:      give a larger size, or leave it out");
    for (const char* text : {"[mesh]\nsize_m = 1e-4\n", "[mesh]\nrock_contact_size_m = 1e-9\n", "mesh_size_m = 1e-6\n"})
        EXPECT_NE(size_message(text).find("or more\n  fix:"), std::string::npos) << size_message(text);
    for (const char* text :
         {"[mesh]\nsize_m = 1\ncontact_size_m = 0.1\nrock_contact_size_m = 0.1\n", "mesh_size_m = 0.5\n"})
        EXPECT_EQ(size_message(text), "(accepted)");
}

TEST(MeshSizeInput, RockAndWaterWithoutEndAreRefused)
{
    for (const char* text : {"length_m = 1e9\n", "[foundation]\nwidth_m = 1e9\nyoung_modulus_GPa = 30\n",
                             "[foundation]\ndepth_m = 1e9\nyoung_modulus_GPa = 30\n"}) {
        const std::string table = text[0] == '[' ? "" : "[reservoir]\nlevel_m = 60\n";
        try {
            parse_scene("[section]\nheight_m = 62.5\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = "
                        "0.77\n" +
                            table + text + "[uplift]\nmodel = \"none\"\n",
                        "dam.toml", FileCheck::skip);
            ADD_FAILURE() << text << " is accepted";
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(" is more than a hundred times the "), std::string::npos)
                << error.what();
        }
    }
    EXPECT_EQ(size_message("length_m = 6000\n"), "(accepted)");
}

TEST(MeshSizeInput, StepsThatNeverEndAndStepsChosenTwiceAreRefused)
{
    EXPECT_NE(size_message("[time]\ndt_s = 1e-12\n").find("1e-07"), std::string::npos);
    EXPECT_EQ(size_message("[time]\nstepping = \"adaptive\"\nsubsteps = 2\n"),
              "dam.toml:15:1: error: time.substeps is given with time.stepping = \"adaptive\".\n"
              "  expected: substeps with stepping = \"uniform\"; the adaptive step is chosen by slip_tolerance\n"
              "  fix:      delete substeps, or write  stepping = \"uniform\"");
}

} // namespace
