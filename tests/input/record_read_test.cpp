// Every kind of bad record file, and what its user is told: place, problem, and what to do.
#include "core/input_error.hpp"
#include "records/read/read_record.hpp"

#include <gtest/gtest.h>
#include <ostream>

namespace {

using namespace damslip;
using namespace damslip::records;

struct BadRecord {
    const char* name;
    std::string content;
    ReadOptions options;
    std::string message; ///< first line of the error
    std::string fix;     ///< part of the fix
};

std::ostream& operator<<(std::ostream& out, const BadRecord& bad)
{
    return out << bad.name;
}

ReadOptions given(std::string unit, std::optional<double> dt = {}, std::string column = "")
{
    return {std::move(unit), dt, UnevenTime::refuse, std::move(column)};
}

/// Times of 0.01 s with two decimals, line `odd_line` (from 0) so many times.
std::string hundredths(int count, int odd_line, int times)
{
    std::string text;
    for (int k = 0; k < count; ++k)
        for (int copy = 0; copy < (k == odd_line ? times : 1); ++copy)
            text += std::to_string(k / 100) + "." + std::to_string(k / 10 % 10) + std::to_string(k % 10) + " 1\n";
    return text;
}

const std::string peer = "PEER NGA\nSTATION, 230\nACCELERATION TIME SERIES IN UNITS OF G\n";

const std::vector<BadRecord> bad_records{
    // What is no text record at all
    {"empty", "", {}, "x.txt: error: the file is empty.", "downloaded completely"},
    {"blank", " \n\t\r\n", {}, "x.txt: error: the file is empty.", "downloaded completely"},
    {"zip", "PK\x03\x04rest", {}, "x.txt: error: this is a compressed file.", "unpack it"},
    {"gzip", "\x1f\x8b rest", {}, "x.txt: error: this is a compressed file.", "unpack it"},
    {"utf16",
     "\xff\xfe"
     "1",
     {},
     "x.txt: error: this is UTF-16 text.",
     "UTF-8"},
    {"binary",
     std::string("1 2\0 3", 6),
     {},
     "x.txt: error: the file holds NUL bytes: it is binary, not text.",
     "export the record"},
    {"latin1",
     "\xe9t\xe9\n",
     {},
     "x.txt:1: error: no accelerogram is recognised; the file starts with 'été'.",
     "convert"},
    {"html",
     "<!DOCTYPE html>\n1 2\n",
     {},
     "x.txt:1: error: this looks like web page (HTML or XML), which is not read.",
     "download"},
    {"words",
     "hello\nworld\n",
     {},
     "x.txt:1: error: no accelerogram is recognised; the file starts with 'hello'.",
     "convert"},
    {"cosmos",
     "Corrected acceleration (Format v01.20 with 13 text lines)\n1 2\n",
     {},
     "x.txt:2: error: no line with \"integer-header values\" follows.",
     "looks cut"},
    {"smc", "2 CORRECTED ACCELEROGRAM\n1 2\n", {}, "x.txt:2: error: the file ends within its header.", "looks cut"},
    {"csmip",
     "UNCORRECTED ACCELEROGRAM DATA\n1 2\n",
     {},
     "x.txt:2: error: the file ends within its header.",
     "looks cut"},
    {"knet",
     "Origin Time       2011/03/11\n1 2\n",
     {},
     "x.txt:2: error: the header does not end: no line \"Memo.\".",
     "anew"},
    {"esm",
     "EVENT_NAME: x\n1\n",
     {},
     "x.txt: error: the file does not say the unit of its accelerations, and none was given.",
     "--units"},
    // PEER AT2
    {"velocity",
     "PEER\nS\nVELOCITY TIME SERIES IN UNITS OF CM/S\nNPTS= 2, DT= .01 SEC\n1 2\n",
     {},
     "x.txt:3: error: 'VELOCITY TIME SERIES IN UNITS OF CM/S': this file holds no acceleration.",
     ".AT2 file"},
    {"displacement",
     "PEER\nS\nDISPLACEMENT TIME HISTORY IN UNITS OF CM\nNPTS= 2, DT= .01 SEC\n1 2\n",
     {},
     "x.txt:3: error: 'DISPLACEMENT TIME HISTORY IN UNITS OF CM': this file holds no acceleration.",
     ".AT2 file"},
    {"at2_no_unit",
     "PEER\nS\nACCELERATION\nNPTS= 2, DT= .01 SEC\n1 2\n",
     {},
     "x.txt: error: the file does not say the unit of its accelerations, and none was given.",
     "--units"},
    {"at2_unknown_unit",
     "PEER\nS\nACCELERATION IN UNITS OF FURLONGS\nNPTS= 2, DT= .01 SEC\n1 2\n",
     {},
     "x.txt:3: error: the unit 'FURLONGS' is not known.",
     "correct the line"},
    {"at2_unit_conflict", peer + "NPTS= 2, DT= .01 SEC\n1 2\n", given("cm/s2"),
     "x.txt:3: error: the file says its unit is g, but cm/s2 was given.", "--units"},
    {"at2_dt_conflict", peer + "NPTS= 2, DT= .01 SEC\n1 2\n", given("", 0.02),
     "x.txt:4: error: the file says dt = 0.01 s, but dt = 0.02 s was given.", "--dt"},
    {"at2_cut",
     peer + "NPTS= 5, DT= .01 SEC\n1 2 1\n",
     {},
     "x.txt:4: error: NPTS = 5, but 3 values follow.",
     "looks cut"},
    {"at2_more",
     peer + "NPTS= 2, DT= .01 SEC\n1 2 1\n",
     {},
     "x.txt:4: error: NPTS = 2, but 3 values follow.",
     "remove"},
    {"at2_no_npts",
     peer + "NPTS= , DT= .01 SEC\n1 2 1\n",
     {},
     "x.txt:4: error: no number for NPTS in 'NPTS= , DT= .01 SEC'.",
     "correct the line"},
    {"at2_no_dt",
     peer + "3 NPTS, DT\n1 2 1\n",
     {},
     "x.txt:4: error: no number for DT in '3 NPTS, DT'.",
     "correct the line"},
    {"at2_npts_negative",
     peer + "NPTS= -3, DT= .01 SEC\n1 2 1\n",
     {},
     "x.txt:4: error: NPTS = -3 is not allowed: a whole number from 2 to 5000000 is.",
     "correct"},
    {"at2_npts_huge",
     peer + "NPTS= 99999999999, DT= .01 SEC\n1 2 1\n",
     {},
     "x.txt:4: error: NPTS = 99999999999 is not allowed: a whole number from 2 to 5000000 is.",
     "correct"},
    {"at2_npts_fraction",
     peer + "NPTS= 2.5, DT= .01 SEC\n1 2\n",
     {},
     "x.txt:4: error: NPTS = 2.5 is not allowed: a whole number from 2 to 5000000 is.",
     "correct"},
    {"at2_dt_zero",
     peer + "NPTS= 2, DT= 0 SEC\n1 2\n",
     {},
     "x.txt:4: error: the time step 0 s in the file is not allowed.",
     "seconds"},
    {"at2_dt_in_ms",
     peer + "NPTS= 2, DT= 5 MSEC\n1 2\n",
     {},
     "x.txt:4: error: DT is followed by 'MSEC', not by SEC.",
     "correct"},
    {"at2_nan", peer + "NPTS= 3, DT= .01 SEC\n1 NaN 1\n", {}, "x.txt:5:3: error: the sample is 'NaN'.", "by hand"},
    {"at2_inf", peer + "NPTS= 3, DT= .01 SEC\n1 2\n-inf\n", {}, "x.txt:6:1: error: the sample is '-inf'.", "by hand"},
    {"at2_stars",
     peer + "NPTS= 3, DT= .01 SEC\n1 ******** 1\n",
     {},
     "x.txt:5:3: error: '********' stands where a number did not fit its field when the file was written.",
     "anew"},
    {"at2_word",
     peer + "NPTS= 3, DT= .01 SEC\n1 2 end\n",
     {},
     "x.txt:5:5: error: 'end' is not a number.",
     "correct it"},
    {"at2_glued_word",
     peer + "NPTS= 3, DT= .01 SEC\n1 2x 3\n",
     {},
     "x.txt:5:3: error: '2x' is not a number.",
     "correct it"},
    {"at2_overflow",
     peer + "NPTS= 3, DT= .01 SEC\n1 1e999 3\n",
     {},
     "x.txt:5:3: error: '1e999' is too large to be read as a number.",
     "correct it"},
    {"at2_raw_counts",
     peer + "NPTS= 2, DT= .01 SEC\n1 20000\n",
     {},
     "x.txt:5:3: error: the sample 20000 g = 1.961e+05 m/s2 is no ground acceleration.",
     "check the unit"},
    // Unit and step of plain text
    {"no_unit",
     "# dt: 0.01 s\n1\n2\n",
     {},
     "x.txt: error: the file does not say the unit of its accelerations, and none was given.",
     "# units: g"},
    {"unknown_unit",
     "# units: ft\n# dt: 0.01 s\n1\n2\n",
     {},
     "x.txt:1: error: the unit 'ft' is not known.",
     "correct the line"},
    {"unknown_given_unit", "# dt: 0.01 s\n1\n2\n", given("parsec"),
     "x.txt: error: the unit 'parsec' given for this file is not known.", "motion.record.unit"},
    {"unit_conflict", "# units: g\n# dt: 0.01 s\n1\n2\n", given("m/s2"),
     "x.txt:1: error: the file says its unit is g, but m/s2 was given.", "leave the given unit out"},
    {"unit_twice",
     "# units: g\n# units: gal\n# dt: 0.01\n1\n2\n",
     {},
     "x.txt:2: error: unit = gal here, but g in line 1.",
     "wrong line"},
    {"dt_conflict", "# units: g\n# dt: 0.01 s\n1\n2\n", given("", 0.02),
     "x.txt:2: error: the file says dt = 0.01 s, but dt = 0.02 s was given.", "leave the given one out"},
    {"dt_negative",
     "# units: g\n# dt: -0.01 s\n1\n2\n",
     {},
     "x.txt:2: error: the time step -0.01 s in the file is not allowed.",
     "seconds"},
    {"dt_given_too_long", "# units: g\n1\n2\n", given("", 20.0),
     "x.txt: error: the time step 20 s given for this file is not allowed.", "seconds"},
    {"dt_garbled",
     "# units: g\n# dt: 100 Hz\n1\n2\n",
     {},
     "x.txt:2: error: the time step '100 Hz' is not understood.",
     "correct the line"},
    {"n_garbled",
     "# n: many\n# units: g\n# dt: 0.01\n1\n2\n",
     {},
     "x.txt:1: error: the number of samples 'many' is not understood.",
     "correct the line"},
    {"n_mismatch",
     "# units: g\n# dt: 0.02 s\n# n: 5\n1 2\n3 4\n",
     {},
     "x.txt:3: error: n = 5, but 4 values follow.",
     "looks cut"},
    {"one_column_no_dt", "1\n2\n3\n", given("g"), "x.txt:1: error: one number a line and no time step.", "--dt"},
    {"three_columns_no_dt", "1 2 3\n4 5 6\n", given("g"),
     "x.txt:1: error: 3 numbers a line, without headings and without a time step.", "heading line"},
    {"three_columns_time_first", "0 1 2\n1 3 1\n2 1 2\n", given("g", 0.01),
     "x.txt:1: error: 3 numbers a line without headings, and the first rises like a time.", "heading line"},
    {"ragged_no_dt", "1 2 3\n4 5\n", given("g"),
     "x.txt:1: error: 3 numbers a line, without headings and without a time step.", "heading line"},
    {"one_sample", "# units: g\n# dt: 0.01\n1\n", {}, "x.txt:3: error: the record has 1 sample.", "complete"},
    // Times
    {"time_falls", "0 1\n0.02 1\n0.01 1\n", given("g"), "x.txt:3:1: error: the time 0.01 s does not follow 0.02 s.",
     "state the time step"},
    {"time_stands", "0 1\n0.02 1\n0.02 1\n", given("g"), "x.txt:3:1: error: the time 0.02 s does not follow 0.02 s.",
     "correct the times"},
    {"time_uneven", "0 1\n0.02 1\n0.05 1\n0.07 1\n", given("g"),
     "x.txt:3:1: error: the time step is uneven: 0.03 s here, 0.0233333 s on average (29 % off).", "--resample"},
    {"time_uneven_with_dt", "0 1\n0.02 1\n0.05 1\n0.07 1\n", given("g", 0.02),
     "x.txt:3:1: error: the time step is uneven: 0.03 s here, 0.0233333 s on average (29 % off).", "--resample"},
    // A line that is missing or stands twice is as far off as times that are rounded.
    {"line_missing", hundredths(2000, 1000, 0), given("g"),
     "x.txt:1001:1: error: one step of 0.02 s among 1997 of 0.01 s: a line is missing above this one.", "--dt"},
    {"line_twice", hundredths(2000, 1000, 2), given("g"),
     "x.txt:1002:1: error: one step of 0 s among 1999 of 0.01 s: this line stands twice.", "delete the line"},
    {"line_missing_in_short_record", hundredths(300, 100, 0), given("g"),
     "x.txt:101:1: error: one step of 0.02 s among 297 of 0.01 s: a line is missing above this one.", "--resample"},
    {"line_missing_with_dt", hundredths(2000, 1000, 0), given("g", 0.01),
     "x.txt:1001:1: error: one step of 0.02 s among 1997 of 0.01 s: a line is missing above this one.", "--resample"},
    {"lines_missing_and_twice", hundredths(1000, 200, 0) + "10.00 1\n10.00 1\n", given("g"),
     "x.txt:201:1: error: one step of 0.02 s among 998 of 0.01 s: a line is missing above this one, and one step more "
     "is odd.",
     "put in what is missing"},
    {"lines_missing", hundredths(1000, 200, 0) + "10.20 1\n", given("g"),
     "x.txt:201:1: error: one step of 0.02 s among 997 of 0.01 s: a line is missing above this one, and one step more "
     "is odd.",
     "put in what is missing"},
    {"twenty_lines_missing", hundredths(1000, 1000, 0) + "10.20 1\n", given("g"),
     "x.txt:1001:1: error: one step of 0.21 s among 999 of 0.01 s: 20 lines are missing above this one.", "--resample"},
    {"time_far_off", hundredths(1000, 1000, 0) + "99.99 1\n", given("g"),
     "x.txt:1001:1: error: the time step is uneven: 90 s here, 0.09999 s on average (9e+04 % off).", "--resample"},
    {"time_against_dt", "0 1\n0.02 1\n0.04 1\n", given("g", 0.01),
     "x.txt:1: error: the time column steps by 0.02 s, but dt = 0.01 s is stated.", "--dt"},
    {"time_step_too_long", "0 1\n20 1\n40 1\n", given("g"),
     "x.txt: error: the time step 20 s of this file is not allowed.", "seconds"},
    {"one_row", "0 1\n", given("g"), "x.txt:1: error: there is one line of numbers only.", "complete"},
    // Columns and headings
    {"no_acceleration", "time_s,vel_m_s\n0,1\n1,2\n", given("g"),
     "x.txt:1: error: no column of acceleration among 1 'time_s', 2 'vel_m_s'.", "--column"},
    {"no_time",
     "acc_g,vel_m_s\n0,1\n1,2\n",
     {},
     "x.txt:1: error: no time column among 1 'acc_g', 2 'vel_m_s', and no time step is stated.",
     "--dt"},
    {"no_such_column", "time_s,acc_g\n0,1\n1,2\n", given("", {}, "up"), "x.txt:1: error: there is no column 'up'.",
     "--column"},
    {"heading_without_unit",
     "time,acc\n0,1\n1,2\n",
     {},
     "x.txt: error: the file does not say the unit of its accelerations, and none was given.",
     "--units"},
    {"heading_unit_conflict",
     "# units: m/s2\ntime_s,acc_g\n0,1\n1,2\n",
     {},
     "x.txt:1: error: unit 'm/s2' here, but 'g' in the heading of line 2.",
     "correct one"},
    {"heading_unit_with_slash_against_given", "time_s,accel_cm/s2\n0,1\n1,2\n", given("m/s2"),
     "x.txt:1: error: the file says its unit is cm/s2, but m/s2 was given.", "leave the given unit out"},
    {"heading_unit_of_velocity", "time_s,accel_mm/s\n0,1\n1,2\n", given("m/s2"),
     "x.txt:1: error: the unit 'mm/s' is not known.", "correct the line"},
    {"quoted_heading_unit_against_given", "\"time (s)\"\t\"acc (mg)\"\n0\t1\n1\t2\n", given("g"),
     "x.txt:1: error: the file says its unit is mg, but g was given.", "leave the given unit out"},
    {"row_too_short", "time_s,acc_g\n0,1\n1\n", {}, "x.txt:3: error: 1 values under 2 headings.", "fill the line in"},
    {"field_empty", "time_s,acc_g\n0,1\n1,,\n", {}, "x.txt:3:3: error: a value is missing here.", "fill it in"},
    {"first_row_is_nan", "0,nan\n0.1,1\n0.2,1\n", given("g"),
     "x.txt:1: error: '0,nan' is neither a row of numbers nor a heading.", "correct the line"},
    {"first_sample_is_stars", "# dt: 0.1\n****\n1\n2\n", given("g"),
     "x.txt:2:1: error: '****' stands where a number did not fit its field when the file was written.", "anew"},
    {"nan_in_column", "time_s,acc_g\n0,1\n1,nan\n", {}, "x.txt:3:3: error: the sample is 'nan'.", "by hand"},
    {"footer",
     "time_s,acc_g\n0,1\n1,2\nend\n",
     {},
     "x.txt:4:1: error: 'end' is not a number.",
     "start the line with #"},
    {"too_large",
     "time_s,acc_m_s2\n0,1\n1,1e300\n",
     {},
     "x.txt:3:3: error: the sample 1e+300 m/s2 = 1e+300 m/s2 is no ground acceleration.",
     "check the unit"},
    {"comma_or_comma", "0,1\n2,3\n4,5\n", given("g", 0.01),
     "x.txt:1:1: error: '0,1' may be one number with a decimal comma or two numbers.", "heading line"},
    {"thousands", "0,0;1.234,5\n0,1;1\n", given("g"), "x.txt:1:5: error: '1.234,5' has both a comma and a point.",
     "rewrite"},
};

class BadRecordFile : public testing::TestWithParam<BadRecord> {};

TEST_P(BadRecordFile, is_refused_with_its_message)
{
    try {
        parse_record(GetParam().content, "x.txt", GetParam().options);
        FAIL() << "was accepted";
    } catch (const InputError& error) {
        ASSERT_EQ(error.diagnostics().size(), 1u);
        const std::string text = error.what();
        EXPECT_EQ(text.substr(0, text.find('\n')), GetParam().message);
        EXPECT_NE(error.diagnostics()[0].fix.find(GetParam().fix), std::string::npos) << error.diagnostics()[0].fix;
        EXPECT_FALSE(error.diagnostics()[0].expected.empty());
    }
}

INSTANTIATE_TEST_SUITE_P(all, BadRecordFile, testing::ValuesIn(bad_records),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(BadRecordFile, several_columns_need_a_choice)
{
    const std::string path = testing::TempDir() + "/damslip_three_columns.csv";
    {
        std::FILE* file = std::fopen(path.c_str(), "w");
        ASSERT_NE(file, nullptr);
        std::fputs("time_s,ns_g,ew_g\n0,0,1\n0.1,3,4\n", file);
        std::fclose(file);
    }
    try {
        read_record(path);
        FAIL() << "was accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostics()[0].problem, "the file holds 2 accelerograms: ns_g, ew_g.");
        EXPECT_NE(error.diagnostics()[0].fix.find("--column"), std::string::npos);
    }
    EXPECT_THROW(read_record(path + ".missing"), InputError);
}

} // namespace
