// ESM and ITACA files: keys with many and with empty values, kinds that share the header, the count.
#include "agency_files.hpp"
#include "core/input_error.hpp"
#include "records/read/read_record.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::records;
using agency_files::Esm;

std::string esm_error(const std::string& text, const ReadOptions& options = {})
{
    return agency_files::refusal(text, "e.ASC", options);
}

TEST(RecordEsm, samples_step_and_names)
{
    const Record r = parse_record(Esm{}.text(), "e").at(0);
    EXPECT_EQ(r.acceleration, (std::vector<double>{0.01, -0.03, 0.025}));
    EXPECT_DOUBLE_EQ(r.dt, 0.005);
    EXPECT_EQ(r.source.component, "HNE");
    EXPECT_EQ(r.source.title, "TEST, station TST");
    EXPECT_EQ(r.source.first_line, 16u);
    for (const std::string& warning : r.warnings) EXPECT_EQ(warning.find("largest"), std::string::npos);
}

TEST(RecordEsm, peak_of_the_header_is_compared)
{
    Esm file;
    file.pga = "-3.2";
    bool found = false;
    const Record r = parse_record(file.text(), "e").at(0);
    for (const std::string& warning : r.warnings)
        found |= warning == "the largest sample is 0.03 m/s2, the file's header says 0.032 m/s2";
    EXPECT_TRUE(found);
    file.pga = ""; // empty values are about everywhere
    EXPECT_EQ(parse_record(file.text(), "e").at(0).acceleration.size(), 3u);
}

// Velocity, displacement and spectra have the same header: the kind decides, and where it is empty the unit.
TEST(RecordEsm, other_kinds_are_refused)
{
    Esm file;
    for (const char* type : {"VELOCITY", "DISPLACEMENT", "ACCELERATION RESPONSE SPECTRUM", "SA"}) {
        file.type = type;
        EXPECT_NE(esm_error(file.text()).find("e.ASC:14: error: the file holds "), std::string::npos) << type;
    }
    file.type = "", file.units = "cm/s";
    EXPECT_NE(esm_error(file.text()).find("e.ASC:11: error: the unit 'cm/s' is not known"), std::string::npos);
    file.units = "";
    EXPECT_NE(esm_error(file.text()).find("does not say the unit"), std::string::npos);
    file.pga = ""; // which says the unit too, and would contradict the one given
    ReadOptions options;
    options.unit = "m/s2";
    EXPECT_DOUBLE_EQ(parse_record(file.text(), "e", options).at(0).acceleration[0], 1.0);
}

TEST(RecordEsm, refused)
{
    Esm file;
    file.count = "4";
    EXPECT_NE(esm_error(file.text()).find("e.ASC:8: error: NDATA = 4, but 3 values follow"), std::string::npos);
    file.count = "";
    EXPECT_NE(esm_error(file.text()).find("e.ASC:8: error: NDATA is '', no number"), std::string::npos);
    file = Esm{};
    file.dt = "0";
    EXPECT_NE(esm_error(file.text()).find("e.ASC:9: error: the time step 0 s"), std::string::npos);
    file = Esm{};
    file.values = "1.0\n2.0 3.0\n4.0\n";
    EXPECT_NE(esm_error(file.text()).find("e.ASC:17:1: error: '2.0 3.0' is not one number"), std::string::npos);
    file.values = "1.0\nNaN\n4.0\n";
    EXPECT_NE(esm_error(file.text()).find("e.ASC:17:1: error: the sample is 'NaN'"), std::string::npos);
    EXPECT_NE(esm_error("EVENT_NAME: x\nUNITS: cm/s^2\n1\n").find("the header has no line SAMPLING_INTERVAL_S"),
              std::string::npos);
}

} // namespace
