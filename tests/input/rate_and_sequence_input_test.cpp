// Friction over the rate, restitution and sequences that contradict other keys.
#include "core/input_error.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

std::string message_of(const std::string& tables)
{
    try {
        parse_scene("[section]\nheight_m = 62.5\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n" + tables, "dam.toml",
                    FileCheck::skip);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

std::string contact_message(const std::string& keys)
{
    return message_of("[contact]\nfriction = 0.77\n" + keys);
}

constexpr const char* two_records = "[[motion.record]]\nname = \"a\"\nhorizontal = \"a.csv\"\n"
                                    "[[motion.record]]\nname = \"b\"\nhorizontal = \"b.csv\"\n";

std::string motion_message(const std::string& keys, const std::string& more = "")
{
    return message_of("[contact]\nfriction = 0.77\n[motion]\n" + keys + two_records + more);
}

TEST(RateInput, RatioAndRateBelongTogether)
{
    EXPECT_EQ(contact_message("kinetic_friction_ratio = 0.8\n"),
              "dam.toml:8:1: error: contact.kinetic_friction_ratio = 0.8 without contact.characteristic_rate_m_s.\n"
              "  expected: both: the rate v_c says how fast friction goes from mu to mu_k\n"
              "  fix:      add  characteristic_rate_m_s = 0.01  , or delete kinetic_friction_ratio");
    EXPECT_EQ(contact_message("relaxation_time_s = 0.1\n"),
              "dam.toml:8:1: error: contact.relaxation_time_s is given, but contact.kinetic_friction_ratio is not.\n"
              "  expected: the keys of friction over the rate together, with a ratio that is not 1\n"
              "  fix:      add  kinetic_friction_ratio = 0.8  , or delete relaxation_time_s");
    EXPECT_EQ(contact_message("kinetic_friction_ratio = 0.8\ncharacteristic_rate_mm_s = 10\n"), "(accepted)");
}

TEST(RateInput, SlammerKnowsNeither)
{
    EXPECT_EQ(contact_message("kinetic_friction_ratio = 0.8\ncharacteristic_rate_m_s = 0.01\n[sliding]\nscheme = "
                              "\"slammer\"\n"),
              "dam.toml:11:1: error: sliding.scheme = \"slammer\" with contact.kinetic_friction_ratio = 0.8.\n"
              "  expected: scheme = \"exact\": SLAMMER knows neither friction over the rate nor rebounds\n"
              "  fix:      write  scheme = \"exact\"  in [sliding]");
}

TEST(SequenceInput, NamesAreRecords)
{
    EXPECT_EQ(motion_message("sequence = [\"a\", \"c\"]\n"),
              "dam.toml:9:1: error: motion.sequence names \"c\", which no [[motion.record]] is.\n"
              "  expected: names of records: \"a\", \"b\"\n"
              "  fix:      correct the name, or give a record this  name");
    EXPECT_EQ(motion_message("sequence = [\"a\"]\n"), "dam.toml:9:1: error: motion.sequence = [\"a\"] is one record.\n"
                                                      "  expected: two records or more, one after the other\n"
                                                      "  fix:      name the next one, or delete sequence");
    EXPECT_EQ(motion_message("sequence = [\"a\", \"b\", \"a\"]\nsequence_pause_s = 5\n"), "(accepted)");
}

TEST(SequenceInput, PauseNeedsSequence)
{
    EXPECT_EQ(motion_message("sequence_pause_s = 5\n"),
              "dam.toml:9:1: error: motion.sequence_pause_s is given without motion.sequence.\n"
              "  expected: both or neither\n"
              "  fix:      add  sequence = [\"main shock\", \"aftershock\"]  , or delete the pause");
}

TEST(SequenceInput, RestsBetweenRecordsAreOfSmallSliding)
{
    const std::string message = message_of("[contact]\nfriction = 0.77\nsliding = \"finite\"\n[reservoir]\nlevel_m = "
                                           "60\n[uplift]\nmodel = \"linear\"\nafter = "
                                           "\"full\"\n[motion]\nsequence = [\"a\", \"b\"]\n" +
                                           std::string(two_records));
    EXPECT_NE(message.find("motion.sequence with uplift.after = \"full\" and contact.sliding = \"finite\""),
              std::string::npos)
        << message;
}

TEST(SequenceInput, NotWithSlammerOrExplicitSteps)
{
    EXPECT_EQ(motion_message("sequence = [\"a\", \"b\"]\n", "[sliding]\nscheme = \"slammer\"\n"),
              "dam.toml:9:1: error: motion.sequence with sliding.scheme = \"slammer\".\n"
              "  expected: a sequence for the rigid block on its base, and for finite elements in time\n"
              "  fix:      write  scheme = \"exact\"  in [sliding]");
}

} // namespace
