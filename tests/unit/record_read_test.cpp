// Every way a good file may look, and that what is read is what is written.
#include "core/input_error.hpp"
#include "records/read/read_record.hpp"
#include "records/record.hpp"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::records;

constexpr double g = 9.80665;

Record one(std::string_view content, const ReadOptions& options = {})
{
    std::vector<Record> records = parse_record(content, "test.txt", options);
    EXPECT_EQ(records.size(), 1u);
    return records.front();
}

void expect_samples(const Record& r, double dt, const std::vector<double>& accel)
{
    EXPECT_DOUBLE_EQ(r.dt, dt);
    ASSERT_EQ(r.acceleration.size(), accel.size());
    for (std::size_t k = 0; k < accel.size(); ++k) EXPECT_DOUBLE_EQ(r.acceleration[k], accel[k]) << k;
}

const std::string at2_new = "PEER NGA STRONG MOTION DATABASE RECORD\n"
                            "Imperial Valley-06, 10/15/1979, El Centro Array #6, 230\n"
                            "ACCELERATION TIME SERIES IN UNITS OF G\n";

TEST(RecordRead, at2_with_assignments)
{
    const Record r =
        one(at2_new + "NPTS=    6, DT=   .0050 SEC,\n"
                      "   .1000000E-02  -.2000000E-02   .3000000E-02  -.4000000E-02   .5000000E-02\n   .6000000E-02\n");
    expect_samples(r, 0.005, {0.001 * g, -0.002 * g, 0.003 * g, -0.004 * g, 0.005 * g, 0.006 * g});
    EXPECT_EQ(r.source.format, "PEER AT2");
    EXPECT_EQ(r.source.unit, "g");
    EXPECT_EQ(r.source.component, "230");
    EXPECT_EQ(r.source.first_line, 5u);
    EXPECT_EQ(r.source.sha256.size(), 64u);
}

TEST(RecordRead, at2_with_numbers_first)
{
    expect_samples(one(at2_new + "3 0.0100 NPTS, DT\n 0.1 0.2 0.3"), 0.01, {0.1 * g, 0.2 * g, 0.3 * g});
    expect_samples(one(at2_new + "3, 0.0100, NPTS, DT\r\n 0.1 0.2\r\n 0.3\r\n"), 0.01, {0.1 * g, 0.2 * g, 0.3 * g});
    expect_samples(one(at2_new + "NPTS=3,DT=0.01SEC\n 0.1 0.2 0.3"), 0.01, {0.1 * g, 0.2 * g, 0.3 * g});
}

// Negatives stuck to the number before them, Fortran D exponents, a leading plus, a leading point.
TEST(RecordRead, at2_number_spellings)
{
    expect_samples(one(at2_new + "NPTS= 5, DT= .01 SEC\n 1.2-5.6 +.5 1.0D-1-.2E-01"), 0.01,
                   {1.2 * g, -5.6 * g, 0.5 * g, 0.1 * g, -0.02 * g});
}

// An older header with another DT above the one that counts: the last line that names NPTS and DT wins.
TEST(RecordRead, at2_with_an_old_header_on_top)
{
    const Record r =
        one("OLD HEADER\nNPTS= 99, DT= .02 SEC\nVELOCITY\n" + at2_new + "NPTS= 2, DT= .005 SEC\n0.1 0.2\n");
    expect_samples(r, 0.005, {0.1 * g, 0.2 * g});
}

TEST(RecordRead, at2_in_other_units)
{
    const std::string head = "TITLE\nSTATION\nACCELERATION IN UNITS OF CM/SEC/SEC\nNPTS= 2, DT= .01\n100 -50\n";
    expect_samples(one(head), 0.01, {1.0, -0.5});
    const std::string silent = "TITLE\nSTATION\nACCELERATION\nNPTS= 2, DT= .01\n100 -50\n";
    ReadOptions gal;
    gal.unit = "gal";
    expect_samples(one(silent, gal), 0.01, {1.0, -0.5});
}

TEST(RecordRead, samples_with_a_comment_header)
{
    const Record r = one("# El Centro, NS\n# units: g\n# dt: 0.02 s\n# n: 5\n# component: NS\n0.1 0.2\n0.3 0.4\n0.5");
    expect_samples(r, 0.02, {0.1 * g, 0.2 * g, 0.3 * g, 0.4 * g, 0.5 * g});
    EXPECT_EQ(r.source.format, "one column");
    EXPECT_EQ(r.source.component, "NS");
    EXPECT_EQ(r.source.title, "El Centro, NS");
}

TEST(RecordRead, unit_and_step_from_the_user)
{
    ReadOptions o;
    o.unit = "cm/s2";
    o.dt = 0.02;
    expect_samples(one("1\n2\n3\n", o), 0.02, {0.01, 0.02, 0.03});
    expect_samples(one("1 2\n3 -4\n-5 6\n", o), 0.02,
                   {0.01, 0.02, 0.03, -0.04, -0.05, 0.06}); // the first column is no time
}

TEST(RecordRead, every_unit)
{
    const auto first = [](const std::string& unit) {
        return one("# dt: 0.01\n# units: " + unit + "\n1\n0\n").acceleration[0];
    };
    for (const char* s : {"g", "G", " g "}) EXPECT_DOUBLE_EQ(first(s), g) << s;
    for (const char* s : {"m/s2", "m/s^2", "m/s/s", "M/SEC/SEC", "m/s**2", "m/sec2", "m s-2", "m/s\xc2\xb2", "m_s2"})
        EXPECT_DOUBLE_EQ(first(s), 1.0) << s;
    for (const char* s : {"cm/s2", "cm/sec/sec", "gal", "Gal", "GALS", "cm/sec^2"})
        EXPECT_DOUBLE_EQ(first(s), 0.01) << s;
    EXPECT_DOUBLE_EQ(first("mg"), 0.001 * g);
    EXPECT_DOUBLE_EQ(first("mm/s2"), 0.001);
}

TEST(RecordRead, two_columns)
{
    ReadOptions o;
    o.unit = "m/s2";
    const std::vector<double> a{0.0, 0.5, -0.25};
    expect_samples(one("0.00 0.0\n0.02 0.5\n0.04 -0.25\n", o), 0.02, a);
    expect_samples(one("0.00\t0.0\n0.02\t0.5\n0.04\t-0.25", o), 0.02, a);
    expect_samples(one("0.00,0.0\n0.02,0.5\n0.04,-0.25\n", o), 0.02, a);
    expect_samples(one("0, 0\n1e-2, 5e-1\n2e-2, -25e-2\n", o), 0.01, a);
    expect_samples(one("0,00;0,0\n0,02;0,5\n0,04;-0,25\n", o), 0.02, a); // decimal commas
    expect_samples(one("0,00 0,0\n0,02 0,5\n0,04 -0,25\n", o), 0.02, a);
    expect_samples(one("\xef\xbb\xbf"
                       "0.00;0.0\r\n0.02;0.5\r\n0.04;-0.25\r\n",
                       o),
                   0.02, a);                                             // byte-order mark, CRLF
    expect_samples(one("0.00 0.0\r0.02 0.5\r0.04 -0.25\r", o), 0.02, a); // CR alone
    o.dt = 0.02;
    expect_samples(one("0.00 0.0\n0.02 0.5\n0.04 -0.25\n", o), 0.02,
                   a); // a time column that agrees with the stated step
    EXPECT_TRUE(one("0.02 0.0\n0.04 0.5\n0.06 -0.25\n", o).warnings.size() <= 1);
}

TEST(RecordRead, times_that_start_late_are_noted)
{
    ReadOptions o;
    o.unit = "m/s2";
    const Record r = one("3.00 0.3\n3.02 -0.3\n3.04 0.0\n", o);
    ASSERT_EQ(r.warnings.size(), 1u);
    EXPECT_EQ(r.warnings[0], "the times start at 3 s; the first sample is taken as time 0");
}

TEST(RecordRead, csv_with_headings)
{
    expect_samples(one("time_s,accel_m_s2\n0,0\n0.1,1\n0.2,2\n"), 0.1, {0, 1, 2});
    expect_samples(one("t [s]; a_h [cm/s2]\n0;0\n0.1;1\n0.2;2\n"), 0.1, {0, 0.01, 0.02});
    expect_samples(one("Time (ms),Acc (g)\n0,0\n5,1\n10,2\n"), 0.005, {0, g, 2 * g});
    expect_samples(one("time accel_g\n0 0\n5e-3 1\n1e-2 2\n"), 0.005, {0, g, 2 * g});
    expect_samples(one("accel_g,time_s,vel_m_s\n0,0,9\n1,0.1,9\n"), 0.1, {0, g});
    expect_samples(one("# units: g\ntime,NS\n0,0\n0.1,1\n"), 0.1, {0, g});
    expect_samples(one("\"time_s\",\"accel_g\"\n0,0\n0.1,1\n"), 0.1, {0, g});
    expect_samples(one("# dt: 0.25 s\naccel_gal\n100\n-100\n"), 0.25, {1, -1});
}

// A unit behind the last underscore, in quotes or without.
TEST(RecordRead, units_of_headings)
{
    const struct {
        const char* unit;
        double factor;
    } rows[] = {{"cm/s2", 0.01},    {"cm/s^2", 0.01},     {"cm/s/s", 0.01},  {"cm/sec2", 0.01},
                {"cm/sec^2", 0.01}, {"cm/sec/sec", 0.01}, {"cm/s**2", 0.01}, {"cm/s\xc2\xb2", 0.01},
                {"m/s2", 1.0},      {"m/s\xc2\xb2", 1.0}, {"M/S/S", 1.0},    {"mm/s2", 0.001},
                {"in/s2", 0.0254},  {"ft/s2", 0.3048},    {"%g", 0.01 * g},  {"g/10", 0.1 * g},
                {"gals", 0.01}};
    for (const auto& row : rows)
        for (const std::string& heading :
             {"time_s,accel_" + std::string(row.unit), "time_s,\"acc_" + std::string(row.unit) + "\""})
            expect_samples(one(heading + "\n0,0\n0.1,2\n"), 0.1, {0, 2 * row.factor});
    expect_samples(one("\"time (s)\"\t\"acc (mg)\"\n0\t0\n0.1\t2\n"), 0.1, {0, 0.002 * g});
    expect_samples(one("\"time s\" \"acc mg\"\n0 0\n0.1 2\n"), 0.1, {0, 0.002 * g});
}

TEST(RecordRead, several_acceleration_columns_are_several_records)
{
    const std::string csv = "time_s,ns_g,ew_g,up_g\n0,0,1,2\n0.1,3,4,5\n";
    const auto all = parse_record(csv, "x.csv");
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[1].source.component, "ew_g");
    ReadOptions o;
    for (const char* choice : {"up_g", "up", "4"}) {
        o.column = choice;
        expect_samples(one(csv, o), 0.1, {2 * g, 5 * g});
    }
}

TEST(RecordRead, uneven_times_on_request)
{
    ReadOptions o;
    o.unit = "m/s2";
    o.uneven = UnevenTime::resample;
    const std::string content = "0.0 0.0\n0.1 1.0\n0.3 3.0\n0.4 0.0\n";
    const Record r = one(content, o);
    expect_samples(r, 0.1, {0, 1, 2, 3, 0});
    ASSERT_GE(r.warnings.size(), 1u);
    EXPECT_EQ(r.warnings.back(), "uneven times resampled: 4 samples became 5 at 0.1 s");
    o.dt = 0.05;
    EXPECT_EQ(one(content, o).acceleration.size(), 9u);
}

// 1e-3 of the step is still even: printed times are rounded.
TEST(RecordRead, rounded_times_are_even)
{
    ReadOptions o;
    o.unit = "g";
    std::string content;
    for (int k = 0; k < 300; ++k) content += std::to_string(k / 128.0) + " 0.1\n"; // 6 decimals
    EXPECT_NEAR(one(content, o).dt, 1.0 / 128.0, 2e-9);
}

// Steps that are rounded to one or two units of the last digit, at equal distances: 80, 1024 and 101 samples a second. Where the
// distances are long, a line might be missing: the step has to be stated.
TEST(RecordRead, rounded_steps_are_no_missing_lines)
{
    ReadOptions o;
    o.unit = "g";
    const auto times = [](double dt, int decimals, int count) {
        std::string content;
        for (int k = 0; k < count; ++k) {
            char line[40];
            std::snprintf(line, sizeof line, "%.*f 0.1\n", decimals, k * dt);
            content += line;
        }
        return content;
    };
    EXPECT_NEAR(one(times(0.0125, 2, 2000), o).dt, 0.0125, 1e-9);
    EXPECT_NEAR(one(times(1.0 / 1024.0, 3, 3000), o).dt, 1.0 / 1024.0, 1e-6);
    EXPECT_NEAR(one(times(1.0 / 101.0, 2, 2000), o).dt, 1.0 / 101.0, 1e-5);
    const std::string rare = times(0.01001, 2, 1500);
    EXPECT_THROW(one(rare, o), InputError);
    o.dt = 0.01001;
    EXPECT_EQ(one(rare, o).acceleration.size(), 1500u);
}

TEST(RecordRead, missing_line_on_request_is_interpolated)
{
    ReadOptions o;
    o.unit = "m/s2";
    o.uneven = UnevenTime::resample;
    std::string content;
    for (int k = 0; k < 40; ++k)
        if (k != 25) content += "0." + std::to_string(k / 10) + std::to_string(k % 10) + " " + std::to_string(k) + "\n";
    const Record r = one(content, o);
    ASSERT_EQ(r.acceleration.size(), 40u);
    EXPECT_NEAR(r.acceleration[25], 25.0, 1e-9);
}

TEST(RecordRead, warnings)
{
    EXPECT_NE(one("# units: g\n# dt: 0.01\n4\n-4\n").warnings.at(0).find("PGA is 4 g"), std::string::npos);
    EXPECT_NE(one("# units: g\n# dt: 0.01\n0.5\n-0.3\n").warnings.at(0).find("constant offset"), std::string::npos);
    EXPECT_EQ(one("# units: g\n# dt: 0.01\n0\n0\n").warnings.at(0), "all samples are zero");
    EXPECT_EQ(one("El Centro\n# units: g\n# dt: 0.01\n1 -1\n1 -1\n").warnings.at(0), "line 1 skipped: 'El Centro'");
}

TEST(RecordRead, own_files_read_back_bit_for_bit)
{
    Record r{"pair",
             1.0 / 128.0,
             {0.0, 1.0 / 3.0, -2e-17, 123.456789012345678, -9999.0, 5e-324},
             {},
             {"a note\nwith a line end"}};
    r.source.title = "title, with: colon";
    r.source.component = "h";
    for (const std::string& content : {record_csv(r), record_csv_with_time(r)}) {
        const Record back = one(content);
        EXPECT_EQ(back.dt, r.dt);
        EXPECT_EQ(back.acceleration, r.acceleration);
        EXPECT_EQ(back.name, "pair");
        EXPECT_EQ(back.source.title, r.source.title);
        EXPECT_EQ(back.source.component, "h");
    }
    const Record at2 = one(record_at2(r));
    EXPECT_EQ(at2.dt, r.dt);
    for (std::size_t k = 0; k < r.acceleration.size(); ++k)
        EXPECT_NEAR(at2.acceleration[k], r.acceleration[k], 5.01e-8 * std::abs(r.acceleration[k]) + 1e-100) << k;
    EXPECT_EQ(at2.source.component, "h");
}

} // namespace
