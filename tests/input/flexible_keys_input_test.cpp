// [flexible_block]: every key, what excludes what, and what is said.
#include "core/input_error.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

const std::string flexible_base_text =
    "[section]\nheight_m = 20\nbase_m = 40\n[dam]\ndensity_kg_m3 = 2000\n[contact]\nfriction = 0.2\n";

std::string flexible_said(const std::string& keys, const std::string& more = "")
{
    try {
        parse_scene(flexible_base_text + more + "[flexible_block]\n" + keys, "f.toml", FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

void flexible_expect(const std::string& said, const std::string& words)
{
    EXPECT_NE(said.find(words), std::string::npos) << said;
}

TEST(FlexibleKeys, AreRead)
{
    const Scene s =
        parse_scene(flexible_base_text + "[flexible_block]\nperiod_ms = 300\ndamping = 0.1\nmodal_load_t_m = 2\n"
                                         "modal_mass_kg_m = 900\nmode = \"coupled\"\n",
                    "f.toml", FileCheck::skip);
    EXPECT_DOUBLE_EQ(*s.flexible_block->period, 0.3);
    EXPECT_DOUBLE_EQ(s.flexible_block->damping_ratio, 0.1);
    EXPECT_DOUBLE_EQ(*s.flexible_block->modal_load, 2000.0);
    EXPECT_DOUBLE_EQ(*s.flexible_block->modal_mass, 900.0);
    EXPECT_EQ(s.flexible_block->method, FlexibleMethod::coupled);
    const std::string resolved = resolved_toml(s);
    EXPECT_EQ(resolved_toml(parse_scene(resolved, "f.toml", FileCheck::skip)), resolved);
}

TEST(FlexibleKeys, RangesAreSaid)
{
    for (const char* keys :
         {"period_s = 0", "period_s = 101", "period_s = \"mode\"", "period_s = 1\ndamping = 0.6",
          "period_s = 1\nmass_ratio = 0", "period_s = 1\nmass_ratio = 0.96", "period_s = 1\nshape_exponent = 0",
          "period_s = 1\nmodal_load_kg_m = 0\nmodal_mass_kg_m = 1",
          "period_s = 1\nmodal_load_kg_m = 1\nmodal_mass_kg_m = nan", "period_s = 1\nmode = \"three\""})
        flexible_expect(flexible_said(keys), "is not allowed.");
    flexible_expect(flexible_said("period = 0.3"), "has no unit in its name");
    flexible_expect(flexible_said("periode_s = 0.3"), "Did you mean flexible_block.period_s?");
}

TEST(FlexibleKeys, WhatExcludesWhat)
{
    flexible_expect(flexible_said("damping = 0.1"), "flexible_block.period_s is missing.");
    EXPECT_EQ(flexible_said("damping = 0.1", "[regressions]\nperiod_s = 0.3\n"), "(accepted)");
    flexible_expect(flexible_said("period_s = 1\nmodal_load_kg_m = 5"), "are not both given.");
    flexible_expect(flexible_said("period_s = 1\nmass_ratio = 0.5\nshape_exponent = 1.5"),
                    "gives the mass ratio in more than one way.");
    flexible_expect(flexible_said("period_s = \"modes\""), "needs dam.young_modulus_GPa.");
    const std::string stiff = "[dam]\ndensity_kg_m3 = 2000\nyoung_modulus_GPa = 20\n";
    const auto with_modulus = [&](const std::string& keys) {
        std::string text = flexible_base_text;
        text.replace(text.find("[dam]\ndensity_kg_m3 = 2000\n"), 27, stiff);
        try {
            parse_scene(text + "[flexible_block]\n" + keys, "f.toml", FileCheck::skip);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("(accepted)");
    };
    EXPECT_EQ(with_modulus("period_s = \"modes\""), "(accepted)");
    flexible_expect(with_modulus("period_s = \"modes\"\nmass_ratio = 0.8"), "together with flexible_block.period_s");
}

} // namespace
