// SMC files: header blocks by their columns, missing-value codes, the remarks about site and problems.
#include "agency_files.hpp"
#include "core/input_error.hpp"
#include "records/read/read_record.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::records;
using agency_files::Smc;
using agency_files::warned;

std::string smc_error(const std::string& text, const ReadOptions& options = {})
{
    return agency_files::refusal(text, "s.smc", options);
}

TEST(RecordSmc, samples_step_and_names)
{
    const Record r = parse_record(Smc{}.text(), "s").at(0);
    EXPECT_EQ(r.acceleration, (std::vector<double>{0.015, -0.0225, 0.03}));
    EXPECT_DOUBLE_EQ(r.dt, 0.005);
    EXPECT_EQ(r.source.component, "360");
    EXPECT_EQ(r.source.format, "SMC volume 2");
    EXPECT_EQ(r.source.title, "Test event, Test place");
    EXPECT_EQ(r.source.first_line, 30u); // 11 + 6 + 10 + 2 lines above
    EXPECT_FALSE(warned(r, "dam"));
    Smc raw;
    raw.first = "1 UNCORRECTED ACCELEROGRAM";
    EXPECT_EQ(parse_record(raw.text(), "s").at(0).source.format, "SMC volume 1");
}

// " 1.5057E+0-2.2223E+0": eight fields of ten, one digit of exponent, no blank before a minus.
TEST(RecordSmc, touching_fields_with_exponents)
{
    Smc file;
    file.points = 9;
    file.data = " 1.5057E+0-2.2223E+0-1.9234E+0-3.1562E+0-3.2440E+0-3.5638E+0-5.1941E+0-5.7933E+1\n-2.8745E-1\n";
    const Record r = parse_record(file.text(), "s").at(0);
    ASSERT_EQ(r.acceleration.size(), 9u);
    EXPECT_DOUBLE_EQ(r.acceleration[7], -0.57933);
    EXPECT_DOUBLE_EQ(r.acceleration[8], -0.0028745);
}

TEST(RecordSmc, orientation_without_the_word)
{
    Smc file;
    file.component = "";
    EXPECT_EQ(parse_record(file.text(), "s").at(0).source.component, "360");
    file.vertical = 0;
    EXPECT_EQ(parse_record(file.text(), "s").at(0).source.component, "up");
    file.vertical = 180;
    EXPECT_TRUE(warned(parse_record(file.text(), "s").at(0), "positive downwards"));
}

TEST(RecordSmc, buildings_and_bridges_are_remarked)
{
    Smc file;
    file.structure = 1;
    EXPECT_TRUE(warned(parse_record(file.text(), "s").at(0), "recorded in a building"));
    file.structure = 2;
    file.place_on_bridge = 1;
    EXPECT_TRUE(warned(parse_record(file.text(), "s").at(0), "recorded on a bridge"));
    file.place_on_bridge = 0; // beside it
    EXPECT_FALSE(warned(parse_record(file.text(), "s").at(0), "bridge"));
}

// The header's largest and smallest sample: what the samples do not reach was cut or is in another unit.
TEST(RecordSmc, peaks_of_the_header_are_those_of_the_samples)
{
    Smc file;
    file.largest = 3.0;
    file.smallest = -2.25;
    EXPECT_DOUBLE_EQ(parse_record(file.text(), "s").at(0).acceleration[2], 0.03);
    file.largest = 30.0;
    const std::string refused = smc_error(file.text());
    EXPECT_NE(refused.find("0.3"), std::string::npos) << refused;
    EXPECT_NE(refused.find("0.03"), std::string::npos) << refused;
}

TEST(RecordSmc, dams_and_problems_are_remarked)
{
    Smc file;
    file.structure = 3;
    file.place_on_dam = 0;
    EXPECT_FALSE(warned(parse_record(file.text(), "s").at(0), "dam"));
    const char* places[] = {"at the base of a dam", "on the crest of a dam", "on the abutment of a dam"};
    for (int place = 1; place <= 3; ++place) {
        file.place_on_dam = place;
        EXPECT_TRUE(warned(parse_record(file.text(), "s").at(0), places[place - 1]));
    }
    file.place_on_dam = -32768;
    EXPECT_TRUE(warned(parse_record(file.text(), "s").at(0), "at an unknown place of a dam"));
    file.problem = 1;
    EXPECT_TRUE(warned(parse_record(file.text(), "s").at(0), "marks this record with a problem"));
    EXPECT_FALSE(warned(parse_record(Smc{}.text(), "s").at(0), "problem"));
}

// Such bytes stand in the station code of some files; anywhere else they mean a binary file.
TEST(RecordSmc, nul_bytes_in_the_station_code)
{
    Smc file;
    file.station = std::string("AB\0\0", 4);
    EXPECT_EQ(parse_record(file.text(), "s").at(0).acceleration.size(), 3u);
    std::string binary = file.text();
    EXPECT_EQ(parse_record(binary + std::string(80, '\0'), "s").at(0).acceleration.size(), 3u); // filled up by DOS
    binary.insert(binary.size() - 12, 1, '\0');
    EXPECT_NE(smc_error(binary).find("NUL bytes"), std::string::npos);
}

TEST(RecordSmc, refused)
{
    Smc star;
    star.first = "*";
    EXPECT_NE(smc_error(star.text()).find("s.smc:1: error: the file does not say what it holds"), std::string::npos);
    for (const char* first : {"3 VELOCITY", "4 DISPLACEMENT", "5 RESPONSE SPECTRA"}) {
        Smc other;
        other.first = first;
        EXPECT_NE(smc_error(other.text()).find("this file holds no acceleration"), std::string::npos) << first;
    }
    Smc fast;
    for (const double rate : {1e30, 0.0, -200.0}) {
        fast.rate = rate;
        EXPECT_NE(smc_error(fast.text()).find("s.smc:18:16: error: "), std::string::npos) << smc_error(fast.text());
    }
    Smc gap;
    gap.data = "  1.70E+38       1.0       2.0\n";
    EXPECT_NE(smc_error(gap.text()).find("s.smc:30:1: error: the sample 1.7e+38 stands for \"unknown\""),
              std::string::npos)
        << smc_error(gap.text());
    Smc cut;
    cut.points = 40;
    EXPECT_NE(smc_error(cut.text()).find("s.smc:14: error: number of samples = 40, but 3 values follow"),
              std::string::npos);
    Smc comments;
    comments.comments = 2;
    std::string text = comments.text();
    text.replace(text.find("| 1 2 3"), 1, "x");
    EXPECT_NE(smc_error(text).find("this is no comment"), std::string::npos);
    ReadOptions g;
    g.unit = "g";
    EXPECT_NE(smc_error(Smc{}.text(), g).find("the file says its unit is cm/s2, but g was given"), std::string::npos);
    const std::string whole = Smc{}.text();
    for (std::size_t size = 40; size < whole.size() - 20; size += 89)
        EXPECT_NE(smc_error(whole.substr(0, size)).find("s.smc:"), std::string::npos) << size;
}

} // namespace
