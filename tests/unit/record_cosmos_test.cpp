// COSMOS files: fields by their widths, the step of the samples and not of the recorder, channels, gaps.
#include "agency_files.hpp"
#include "core/input_error.hpp"
#include "records/read/read_record.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::records;
using agency_files::Cosmos;
using agency_files::warned;

std::vector<Record> read_cosmos_text(const std::string& text, const ReadOptions& options = {})
{
    return parse_record(text, "c.v2", options);
}

std::string cosmos_error(const std::string& text, const ReadOptions& options = {})
{
    return agency_files::refusal(text, "c.v2", options);
}

TEST(RecordCosmos, unit_step_component_and_lines)
{
    Cosmos file; // 10 ms of the samples; the recorder had 5 ms: real header value 33 must not count
    const Record r = read_cosmos_text(file.text()).at(0);
    EXPECT_EQ(r.acceleration, (std::vector<double>{0.01, -0.02, 0.03}));
    EXPECT_DOUBLE_EQ(r.dt, 0.01);
    EXPECT_EQ(r.source.component, "90 deg");
    EXPECT_EQ(r.source.format, "COSMOS volume 2");
    EXPECT_EQ(r.source.unit, "cm/s2");
    EXPECT_EQ(r.source.first_line, 46u); // 13 + 11 + 18 + 2 + 1 lines above
    EXPECT_EQ(r.source.last_line, 46u);
    EXPECT_FALSE(warned(r, "free field"));
    EXPECT_FALSE(warned(r, "header says"));
}

// Nine samples of ten characters each without a blank between them: two lines.
TEST(RecordCosmos, touching_fields)
{
    Cosmos file;
    file.samples = {-901.12345, -902.5, -903.5, -904.5, -905.5, -906.5, -907.5, -908.5, -909.5};
    const Record r = read_cosmos_text(file.text()).at(0);
    ASSERT_EQ(r.acceleration.size(), 9u);
    EXPECT_DOUBLE_EQ(r.acceleration[0], -9.0112345);
    EXPECT_DOUBLE_EQ(r.acceleration[8], -9.095);
    file.samples = {-901.0, -902.0};
    file.data_line = "      2  acceleration pts, approx 1 secs, units=cm/sec2(04),Format=(8F8.3)";
    std::string text = file.text();
    const std::size_t at = text.find("-901.00000");
    text.replace(at, 20, "-901.000-902.125");
    EXPECT_DOUBLE_EQ(read_cosmos_text(text).at(0).acceleration[1], -9.02125);
}

TEST(RecordCosmos, units_by_code)
{
    const struct {
        int code;
        double factor;
    } codes[] = {{2, 9.80665}, {4, 0.01}, {7, 0.0254}, {10, 0.01}, {11, 0.00980665}, {12, 9.80665e-6}};
    for (const auto& code : codes) {
        Cosmos file;
        file.unit = code.code;
        EXPECT_DOUBLE_EQ(read_cosmos_text(file.text()).at(0).acceleration[0], code.factor) << code.code;
    }
    Cosmos counts;
    counts.unit = 50, counts.volume = 0;
    EXPECT_NE(cosmos_error(counts.text()).find("counts or volts"), std::string::npos);
    Cosmos velocity;
    velocity.unit = 5; // cm/s
    EXPECT_NE(cosmos_error(velocity.text()).find("unit code 5 is no unit of acceleration."), std::string::npos)
        << cosmos_error(velocity.text());
    Cosmos two;
    two.data_line = "      3  acceleration pts, approx 1 secs, units=g (02),Format=(8F10.5)";
    EXPECT_NE(cosmos_error(two.text()).find("c.v2:45: error: unit code 2 here, but 4 in the integer header (line 15)"),
              std::string::npos)
        << cosmos_error(two.text());
}

// A sample with the file's own value for "unknown" is a gap, whatever that value is.
TEST(RecordCosmos, gaps_are_refused)
{
    Cosmos file;
    file.samples = {1.0, -999.0, 3.0};
    EXPECT_NE(cosmos_error(file.text()).find("c.v2:46:11: error: the sample -999 stands for \"unknown\""),
              std::string::npos)
        << cosmos_error(file.text());
    file.unknown = -777; // then -999 is a sample like any other
    EXPECT_DOUBLE_EQ(read_cosmos_text(file.text()).at(0).acceleration[1], -9.99);
    file.samples[1] = -777.0;
    EXPECT_NE(cosmos_error(file.text()).find("stands for"), std::string::npos);
}

TEST(RecordCosmos, lines_of_the_header_that_are_not_understood)
{
    std::string text = Cosmos{}.text();
    text.replace(text.find("  1 Comment line(s)"), 3, " -1");
    EXPECT_NE(cosmos_error(text).find("c.v2:43: error: the number of comment lines is not understood."),
              std::string::npos)
        << cosmos_error(text);
    Cosmos file;
    file.data_line = "      3  acceleration pts, approx 1 secs, units=cm/sec2(04)";
    EXPECT_NE(cosmos_error(file.text()).find("c.v2:45: error:"), std::string::npos) << cosmos_error(file.text());
    EXPECT_NE(cosmos_error(file.text()).find("Format=(8F10.5)"), std::string::npos) << cosmos_error(file.text());
}

TEST(RecordCosmos, length_by_both_conventions)
{
    Cosmos file;
    for (const double length : {0.03, 0.02}) { // npts dt, (npts - 1) dt
        file.length_s = length;
        EXPECT_FALSE(warned(read_cosmos_text(file.text()).at(0), "header says"));
    }
    file.length_s = 70.0;
    EXPECT_TRUE(warned(read_cosmos_text(file.text()).at(0), "the header says 70 s, but 3 samples of 0.01 s"));
}

TEST(RecordCosmos, channels_and_what_is_passed_over)
{
    Cosmos east, up, displacement;
    east.with_velocity = true;
    up.azimuth = 400, up.samples = {4.0, 5.0};
    displacement.quantity = 3, displacement.unit = 6;
    const std::string text = east.text() + displacement.text() + up.text();
    const auto records = read_cosmos_text(text);
    ASSERT_EQ(records.size(), 2u);
    EXPECT_EQ(records[0].acceleration.size(), 3u); // not the velocity below
    EXPECT_EQ(records[1].source.component, "up");
    EXPECT_DOUBLE_EQ(records[1].acceleration[1], 0.05);
    EXPECT_TRUE(warned(records[0], "no acceleration"));
    ReadOptions options;
    for (const char* column : {"UP", "2"}) {
        options.column = column;
        const auto chosen = read_cosmos_text(text, options);
        ASSERT_EQ(chosen.size(), 1u);
        EXPECT_EQ(chosen[0].source.component, "up");
    }
    options.column = "90";
    EXPECT_EQ(read_cosmos_text(text, options).at(0).source.component, "90 deg");
    options.column = "45";
    EXPECT_NE(cosmos_error(text, options).find("there is no one channel '45'"), std::string::npos);
}

TEST(RecordCosmos, odd_orientations)
{
    const struct {
        int azimuth, in_structure;
        const char* name;
    } cases[] = {{360, -999, "360 deg"},
                 {401, -999, "down"},
                 {402, -999, "vertical, sense unknown"},
                 {700, -999, "H1, azimuth unknown"},
                 {-999, 90, "90 deg to the structure"},
                 {2000, -999, "123 deg"}}; // text line 9
    for (const auto& c : cases) {
        Cosmos file;
        file.azimuth = c.azimuth, file.azimuth_in_structure = c.in_structure;
        EXPECT_EQ(read_cosmos_text(file.text()).at(0).source.component, c.name);
    }
    Cosmos same;
    const auto twice = read_cosmos_text(same.text() + same.text());
    EXPECT_EQ(twice.at(0).source.component, "90 deg (channel 1)");
    EXPECT_EQ(twice.at(1).source.component, "90 deg (channel 2)");
}

TEST(RecordCosmos, warnings_of_site_and_direction)
{
    Cosmos file;
    file.station = 12, file.problem = 2, file.azimuth = 401;
    const Record r = read_cosmos_text(file.text()).at(0);
    EXPECT_TRUE(warned(r, "recorded on a dam"));
    EXPECT_TRUE(warned(r, "unfixed problem"));
    EXPECT_TRUE(warned(r, "positive downwards"));
}

TEST(RecordCosmos, cut_and_overlong_files)
{
    Cosmos file;
    file.data_line = "      9  acceleration pts, approx 1 secs, units=cm/sec2(04),Format=(8F10.5)";
    EXPECT_NE(cosmos_error(file.text()).find("c.v2:45: error: number of samples = 9, but 3 values follow"),
              std::string::npos);
    file.samples.assign(24, 1.0); // three lines where two are stated
    file.data_line = "     16  acceleration pts, approx 1 secs, units=cm/sec2(04),Format=(8F10.5)";
    EXPECT_NE(cosmos_error(file.text()).find("more numbers follow in line 48"), std::string::npos);
    const std::string whole = Cosmos{}.text();
    for (std::size_t size = 70; size < whole.find("      3  accel"); size += 97) // never a crash, always a place
        EXPECT_NE(cosmos_error(whole.substr(0, size)).find("c.v2:"), std::string::npos) << size;
    Cosmos no_step;
    no_step.dt_ms = -999;
    EXPECT_NE(cosmos_error(no_step.text()).find("time step of the samples"), std::string::npos);
    Cosmos velocity;
    velocity.quantity = 2;
    EXPECT_NE(cosmos_error(velocity.text()).find("the file holds no acceleration"), std::string::npos);
}

} // namespace
