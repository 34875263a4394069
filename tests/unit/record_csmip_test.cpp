// CSMIP/CDMG volumes 1 and 2: samples under their line, pairs of time and acceleration, channels, units in words.
#include "agency_files.hpp"
#include "core/input_error.hpp"
#include "records/read/read_record.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::records;
using agency_files::Csmip;
using agency_files::fields;
using agency_files::warned;

constexpr double one_g = 9.80665;

std::string csmip_error(const std::string& text, const ReadOptions& options = {})
{
    return agency_files::refusal(text, "c.v1", options);
}

const std::string points = "    9 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)\r\n";
const std::vector<double> nine{1, -2, 3, -4, 5, -6, 7, -8, 9};

TEST(RecordCsmip, volume_two_passes_over_velocity_and_displacement)
{
    Csmip file;
    file.data = points + fields(nine, 8, 10, 3) +
                "    9 POINTS OF VELOC DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC)\r\n" + fields(nine, 8, 10, 3);
    const Record r = parse_record(file.text(), "c").at(0);
    ASSERT_EQ(r.acceleration.size(), 9u);
    EXPECT_DOUBLE_EQ(r.acceleration[8], 0.09);
    EXPECT_DOUBLE_EQ(r.dt, 0.02);
    EXPECT_EQ(r.source.format, "CSMIP volume 2");
    EXPECT_EQ(r.source.component, "90 DEG");
    EXPECT_EQ(r.source.title, "TEST EARTHQUAKE, TEST STATION");
    EXPECT_EQ(r.source.first_line, 47u); // 25 + 7 + 13 + 1 lines above
}

// Volume 1 has fields of 9 characters and volume 2 of 10; a format in the line beats both. Touching fields show which.
TEST(RecordCsmip, field_widths)
{
    const std::string touching9 =
        "-1.000001-2.000002-3.000003-4.000004-5.000005-6.000006-7.000007-8.000008\r\n-9.000009\r\n";
    Csmip raw;
    raw.corrected = false;
    raw.data = "9 POINTS OF ACCEL DATA EQUALLY SPACED AT .005 SEC.  (UNITS: G)\r\n" + touching9;
    const Record r = parse_record(raw.text(), "c").at(0);
    EXPECT_EQ(r.source.format, "CSMIP volume 1");
    ASSERT_EQ(r.acceleration.size(), 9u);
    EXPECT_DOUBLE_EQ(r.acceleration[1], -2.000002 * one_g);
    EXPECT_DOUBLE_EQ(r.acceleration[8], -9.000009 * one_g);
    Csmip named;
    named.data = "    3 points of accel data equally spaced at  .005 sec, in cm/sec2. (8f6.2)\n 10.25-20.50 30.75\n";
    EXPECT_DOUBLE_EQ(parse_record(named.text(), "c").at(0).acceleration[1], -0.205);
}

TEST(RecordCsmip, channels_chosen_by_name_or_number)
{
    Csmip east, up;
    east.data = points + fields(nine, 8, 10, 3);
    up.component = " UP", up.data = points + fields({9, 8, 7, 6, 5, 4, 3, 2, 1}, 8, 10, 3);
    const std::string text = east.text() + up.text() + "\r\n\r\n\x1a\x1a\x1a"; // blank lines and end-of-file marks
    const auto all = parse_record(text, "c");
    ASSERT_EQ(all.size(), 2u);
    ReadOptions options;
    for (const char* column : {"up", "2"}) {
        options.column = column;
        EXPECT_DOUBLE_EQ(parse_record(text, "c", options).at(0).acceleration[0], 0.09);
    }
    options.column = "90"; // first word of "90 DEG"
    EXPECT_DOUBLE_EQ(parse_record(text, "c", options).at(0).acceleration[0], 0.01);
    up.component = " DOWN";
    EXPECT_TRUE(warned(parse_record(up.text(), "c").at(0), "positive downwards"));
}

// Digitised film: pairs of time and acceleration, here in tenths of g, at uneven times.
TEST(RecordCsmip, uneven_pairs)
{
    Csmip film;
    film.corrected = false, film.points = 6;
    film.data = fields({0.0, 0.0, 0.01, 1.0, 0.03, -1.0, 0.04, 0.0, 0.06, 2.0, 0.07, 0.0}, 10, 7, 3);
    EXPECT_NE(csmip_error(film.text()).find("c.v1:28:29: error: the time step is uneven: 0.02 s here"),
              std::string::npos)
        << csmip_error(film.text());
    ReadOptions options;
    options.uneven = UnevenTime::resample;
    const Record r = parse_record(film.text(), "c", options).at(0);
    EXPECT_NEAR(r.dt, 0.01, 1e-12); // the smallest step
    ASSERT_EQ(r.acceleration.size(), 8u);
    const double tenth = 0.1 * one_g;
    const double expected[] = {0, 1, 0, -1, 0, 1, 2, 0};
    for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(r.acceleration[k], expected[k] * tenth, 1e-9) << k;
    EXPECT_EQ(r.source.unit, "g/10");
    EXPECT_TRUE(warned(r, "6 samples became 8"));

    film.data = fields({0.0, 0.0, 0.02, 1.0, 0.04, -1.0, 0.06, 0.0, 0.08, 2.0, 0.10, 0.0}, 10, 7, 3);
    const Record even = parse_record(film.text(), "c").at(0);
    EXPECT_NEAR(even.dt, 0.02, 1e-15);
    EXPECT_EQ(even.acceleration.size(), 6u);
    film.data = fields({0.0, 0.0, 0.02, 1.0, 0.01, -1.0, 0.06, 0.0, 0.08, 2.0, 0.10, 0.0}, 10, 7, 3);
    EXPECT_NE(csmip_error(film.text()).find("the time 0.01 s does not follow 0.02 s"), std::string::npos);
    film.unit_line = "NO WORD";
    EXPECT_NE(csmip_error(film.text()).find("does not say the unit"), std::string::npos);
}

// Another line of words above the samples: number and step from the numeric header, unit from the text.
TEST(RecordCsmip, extra_line_of_text)
{
    Csmip file;
    file.corrected = false, file.points = 9, file.length_s = 0.08;
    file.unit_line = "UNITS OF UNCOR ACCEL IS G.                 MAX  =   .058 G, AT   9.425 SEC.";
    file.data = "ACCELEROGRAM DATA FOLLOW\r\n" + fields(nine, 8, 9, 6);
    const Record r = parse_record(file.text(), "c").at(0);
    EXPECT_DOUBLE_EQ(r.dt, 0.01);
    EXPECT_DOUBLE_EQ(r.acceleration[8], 9.0 * one_g);
    file.length_s = 0.0;
    EXPECT_NE(csmip_error(file.text()).find("does not say the time step"), std::string::npos);
}

TEST(RecordCsmip, wrong_numbers_of_points)
{
    Csmip file; // the rest of the last line is blank: 11 stated, 9 there
    file.data = "   11 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)\r\n";
    std::string last = fields(nine, 8, 10, 3);
    last.insert(last.size() - 1, 20, ' ');
    file.data += last;
    const Record r = parse_record(file.text(), "c").at(0);
    EXPECT_EQ(r.acceleration.size(), 9u);
    EXPECT_TRUE(warned(r, "11 points are stated, 9 follow"));
    file.data.replace(0, 5, "  200");
    EXPECT_NE(csmip_error(file.text()).find("c.v1:46: error: number of points = 200, but 9 values follow"),
              std::string::npos);
    file.data.replace(0, 5, "    8");
    EXPECT_NE(csmip_error(file.text()).find("more numbers follow in line 48"), std::string::npos);
    file.data.replace(0, 5, " 1e99");
    EXPECT_NE(csmip_error(file.text()).find("is not allowed"), std::string::npos);
}

TEST(RecordCsmip, refused)
{
    EXPECT_NE(
        csmip_error("RESPONSE AND FOURIER AMPLITUDE SPECTRA\nCORRECTED ACCELEROGRAM\nUNCORRECTED ACCELEROGRAM\n1 2\n")
            .find("these are response spectra"),
        std::string::npos);
    Csmip file;
    file.data = "    9 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: G*10)\r\n" + fields(nine, 8, 10, 3);
    EXPECT_NE(csmip_error(file.text()).find("the unit 'g*10' is not known"), std::string::npos);
    file.data = points + fields(nine, 8, 10, 3);
    std::string stars = file.text();
    stars.replace(stars.find("     3.000"), 10, "**********");
    EXPECT_NE(csmip_error(stars).find("c.v1:47:21: error: '**********' stands where"), std::string::npos)
        << csmip_error(stars);
    const std::string whole = file.text();
    for (std::size_t size = 30; size < whole.size() - 120; size += 83)
        EXPECT_NE(csmip_error(whole.substr(0, size)).find("c.v1:"), std::string::npos) << size;
}

} // namespace
