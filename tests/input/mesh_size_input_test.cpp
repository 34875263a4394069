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
                    "0.77\n[foundation]\nyoung_modulus_GPa = 30\n[reservoir]\nlevel_m = 60\n" +
                        more,
                    "dam.toml", FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

TEST(MeshSizeInput, AbsurdlySmallElementsAreRefusedBeforeAnythingIsMeshed)
{
    EXPECT_EQ(size_message("[mesh]\ncontact_size_m = 1e-9\n"),
              "dam.toml:13:1: error: mesh.contact_size_m = 1e-09 makes 4.5e+10 elements along the 45 m of the base.\n"
              "  expected: at most 2000 elements there: 0.0225 m or more\n"
              "  fix:      give a larger size, or leave it out");
    for (const char* text : {"[mesh]\nsize_m = 1e-4\n", "[mesh]\nrock_contact_size_m = 1e-9\n", "mesh_size_m = 1e-6\n"})
        EXPECT_NE(size_message(text).find("or more\n  fix:"), std::string::npos) << size_message(text);
    for (const char* text :
         {"[mesh]\nsize_m = 1\ncontact_size_m = 0.1\nrock_contact_size_m = 0.1\n", "mesh_size_m = 0.5\n"})
        EXPECT_EQ(size_message(text), "(accepted)");
}

} // namespace
