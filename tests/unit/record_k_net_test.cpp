// K-NET and KiK-net files: counts, factor and offset; labels; directions.
#include "agency_files.hpp"
#include "core/input_error.hpp"
#include "records/read/read_record.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::records;
using agency_files::KNet;
using agency_files::warned;

/// 100 samples: an offset of 8000 counts with +-100 around it, so that the mean is 8000.
KNet one_second()
{
    KNet file;
    for (int k = 0; k < 100; ++k) file.counts.push_back(8000 + (k % 2 ? -100 : 100));
    return file;
}

std::string k_net_error(const std::string& text)
{
    try {
        parse_record(text, "k.NS");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

// 100 counts * 3920/6182761 gal = 0.063402 gal = 0.00063402 m/s^2, the factor applied once.
TEST(RecordKNet, counts_factor_and_offset)
{
    const Record r = parse_record(one_second().text(), "k").at(0);
    ASSERT_EQ(r.acceleration.size(), 100u);
    EXPECT_DOUBLE_EQ(r.dt, 0.01);
    const double expected = 100.0 * 3920.0 / 6182761.0 * 0.01;
    EXPECT_NEAR(r.acceleration[0], expected, 1e-15);
    EXPECT_NEAR(r.acceleration[99], -expected, 1e-15);
    EXPECT_EQ(r.source.component, "N-S");
    EXPECT_EQ(r.source.title, "2011/03/11 14:46:00, station TST001");
    EXPECT_EQ(r.source.first_line, 18u);
    EXPECT_TRUE(warned(r, "sensor offset of 0.05072 m/s2 taken off: the mean of the record"));
    EXPECT_FALSE(warned(r, "largest sample"));
    EXPECT_FALSE(warned(r, "constant offset"));
}

// 30 s with an event of +500 counts from 15 s on: the offset is the mean of the quiet first 10 s, not of the whole.
TEST(RecordKNet, offset_from_before_the_event)
{
    KNet file;
    file.duration = "30", file.peak = "0.317";
    for (int k = 0; k < 3000; ++k) file.counts.push_back(k < 1500 ? 200 : 700);
    const Record r = parse_record(file.text(), "k").at(0);
    EXPECT_NEAR(r.acceleration[0], 0.0, 1e-15);
    EXPECT_NEAR(r.acceleration[2999], 500.0 * 3920.0 / 6182761.0 * 0.01, 1e-15);
    EXPECT_TRUE(warned(r, "the mean of the first 10 s"));
    EXPECT_FALSE(warned(r, "largest sample"));
    file.peak = "0.3";
    EXPECT_TRUE(warned(parse_record(file.text(), "k").at(0), "the largest sample is 0.00317 m/s2"));
}

TEST(RecordKNet, directions_of_surface_and_borehole)
{
    const char* names[] = {"N-S borehole", "E-W borehole", "U-D borehole", "N-S surface", "E-W surface", "U-D surface"};
    KNet file = one_second();
    for (int k = 1; k <= 6; ++k) {
        file.direction = std::to_string(k);
        const Record r = parse_record(file.text(), "k").at(0);
        EXPECT_EQ(r.source.component, names[k - 1]);
        EXPECT_EQ(warned(r, "borehole"), k <= 3);
    }
    file.direction = "7";
    EXPECT_NE(k_net_error(file.text()).find("k.NS:13:19: error: the direction '7' is not known"), std::string::npos);
}

TEST(RecordKNet, spelling_of_labels_and_values)
{
    KNet file = one_second();
    file.frequency = "100 Hz", file.duration = "1.0", file.factor = "3920 (gal)/6182761";
    std::string text = file.text();
    text.replace(text.find("Station Lon. "), 13, "Station Long."); // both spellings are about
    EXPECT_EQ(parse_record(text, "k").at(0).acceleration.size(), 100u);
}

TEST(RecordKNet, refused)
{
    KNet file = one_second();
    file.counts.pop_back();
    EXPECT_NE(
        k_net_error(file.text()).find("k.NS:12: error: number of samples (frequency times duration) = 100, but 99"),
        std::string::npos);
    file = one_second();
    for (const char* factor : {"3920/6182761", "3920(gal)", "x", "3920(gal)/0"}) {
        file.factor = factor;
        EXPECT_NE(k_net_error(file.text()).find("k.NS:14:19: error: the scale factor"), std::string::npos) << factor;
    }
    file = one_second();
    file.frequency = "Hz";
    EXPECT_NE(k_net_error(file.text()).find("k.NS:11:19: error: the sampling frequency"), std::string::npos);
    std::string text = one_second().text();
    text.replace(text.find("Scale Factor"), 12, "Scale Fcator");
    EXPECT_NE(k_net_error(text).find("the header has no line \"scale factor\""), std::string::npos);
    text = one_second().text();
    text.replace(text.find("     8100"), 9, "     81x0");
    EXPECT_NE(k_net_error(text).find("k.NS:18:6: error: '81x0"), std::string::npos) << k_net_error(text);
    const std::string whole = one_second().text();
    for (std::size_t size = 20; size < whole.size() - 10; size += 61)
        EXPECT_NE(k_net_error(whole.substr(0, size)).find("k.NS:"), std::string::npos) << size;
}

} // namespace
