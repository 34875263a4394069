// Traps of accelerogram files that the tests by format leave out, each on a file made here.
#include "agency_files.hpp"
#include "records/read/read_record.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::records;
using agency_files::refusal;

// Older files of PEER have the title misspelt; the line that names NPTS need not be the fourth either.
TEST(RecordTraps, At2IsKnownByItsKeywords)
{
    const std::string body =
        "IMPERIAL VALLEY 10/15/79, 230\nACCELERATION TIME HISTORY IN UNITS OF G\nNPTS=2,DT=.01000SEC\n0.1 0.2\n";
    for (const char* title : {"PEER STRONG MOTION DATABASE RECORD. PROCESSING BY PAIFIC ENGINEERING.\n",
                              "PEER\nA SECOND LINE OF TITLE\nA THIRD ONE\n", ""}) {
        const Record r = parse_record(title + body, "x.at2").at(0);
        EXPECT_EQ(r.source.format, "PEER AT2");
        EXPECT_DOUBLE_EQ(r.dt, 0.01);
        EXPECT_DOUBLE_EQ(r.acceleration.at(1), 0.2 * 9.80665);
    }
}

// The station's name and five styles of time hold colons of their own: only the first of a line ends the key.
TEST(RecordTraps, EsmValuesMayHoldColons)
{
    const std::string whole = agency_files::Esm{}.text();
    for (const char* stamp : {"20160824_013632.000", "2016-08-24 01:36:32", "2016/08/24 01:36:32.5", "01:36:32", ""}) {
        std::string text = whole;
        const std::string old = "20160824_013632.000";
        text.replace(text.find(old), old.size(), stamp);
        text.replace(text.find("EVENT_NAME: TEST"), 16, "EVENT_NAME: TEST: NDATA: 7");
        const Record r = parse_record(text, "e.ASC").at(0);
        EXPECT_EQ(r.acceleration.size(), 3u) << stamp;
        EXPECT_EQ(r.source.title, "TEST: NDATA: 7, station TST") << stamp;
    }
}

// Files of USC begin as those of CSMIP but have another layout: refused with a place, never guessed.
TEST(RecordTraps, UscFilesAreNotGuessed)
{
    const auto said = [](const std::string& first) {
        std::string text = first + " DATA OF USC\n";
        for (int k = 0; k < 30; ++k) text += "WORDS\n";
        text += "   1   2   3\n   4   5   6\n";
        return refusal(text, "u.v2", {});
    };
    EXPECT_NE(said("CORRECTED ACCELEROGRAM").find("that of USC shares the first line"), std::string::npos);
    EXPECT_NE(said("UNCORRECTED ACCELEROGRAM").find("u.v2:15:56: error: number of points = 0"), std::string::npos);
}

// Record Time of K-NET is 15 s after the first sample and in Japanese time: the samples start at 0 all the same.
TEST(RecordTraps, KNetTimesDoNotShiftTheSamples)
{
    agency_files::KNet file;
    for (int k = 0; k < 100; ++k) file.counts.push_back(8100 - 2 * (k % 2) * 100);
    const Record before = parse_record(file.text(), "k.NS").at(0);
    std::string text = file.text();
    const std::string old = "2011/03/11 14:47:21";
    text.replace(text.find(old), old.size(), "2011/03/11 14:46:00");
    EXPECT_EQ(parse_record(text, "k.NS").at(0).acceleration, before.acceleration);
}

} // namespace
