// Measures of a suite, kept beside it: the same doubles, worked out once.
#include "core/file.hpp"
#include "records/measure/measures.hpp"
#include "records/suite/suite.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <unistd.h>

namespace damslip::records {
namespace {

class Index : public testing::Test {
protected:
    void SetUp() override
    {
        std::filesystem::create_directories(folder);
        record.name = "sweep, \"up\"";
        record.dt = 0.01;
        for (int i = 0; i <= 1000; ++i) record.acceleration.push_back(std::sin(0.03 * i + 2e-4 * i * i) / 3.0);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("damslip index " + std::to_string(::getpid()));
    Record record;
};

bool same(const Measures& a, const Measures& b)
{
    return a.duration == b.duration && a.pga == b.pga && a.pga_time == b.pga_time && a.pgv == b.pgv && a.pgd == b.pgd &&
           a.final_velocity == b.final_velocity && a.final_displacement == b.final_displacement &&
           a.arias_intensity == b.arias_intensity && a.cumulative_velocity == b.cumulative_velocity &&
           a.duration_5_75 == b.duration_5_75 && a.duration_5_95 == b.duration_5_95 && a.mean_period == b.mean_period;
}

TEST_F(Index, GivesBackTheSameNumbers)
{
    const std::vector<double> periods = {0.0, 0.1, 1.0 / 3.0, 2.0};
    std::vector<double> direct;
    for (const SpectrumPoint& point : response_spectrum(record.acceleration, record.dt, periods, 0.05).points)
        direct.push_back(point.pseudo_acceleration);
    Record zeros = record; // has no mean period
    zeros.acceleration.assign(1001, 0.0);
    {
        SuiteIndex index(folder);
        EXPECT_TRUE(same(index.measures(record), measure(record)));
        EXPECT_TRUE(same(index.measures(zeros), measure(zeros)));
        EXPECT_EQ(index.spectrum(record, std::span(periods).first(3)), std::vector(direct.begin(), direct.begin() + 3));
        EXPECT_EQ(index.computed(), 5u);
        index.keep();
    }
    SuiteIndex again(folder);
    EXPECT_TRUE(same(again.measures(record), measure(record)));
    EXPECT_TRUE(same(again.measures(zeros), measure(zeros)));
    EXPECT_EQ(again.spectrum(record, std::span(periods).first(3)), std::vector(direct.begin(), direct.begin() + 3));
    EXPECT_EQ(again.computed(), 0u);
    EXPECT_EQ(again.spectrum(record, periods), direct);
    EXPECT_EQ(again.computed(), 1u);
}

TEST_F(Index, MeasuresAnewWhatChanged)
{
    {
        SuiteIndex index(folder);
        index.measures(record);
        index.keep();
    }
    SuiteIndex index(folder);
    Record other = record;
    other.acceleration[500] *= 1.0 + 1e-15;
    other.acceleration[500] += 1e-12;
    index.measures(other);
    EXPECT_EQ(index.computed(), 1u);
    other = record;
    other.dt = 0.02;
    EXPECT_EQ(index.measures(other).duration, 20.0);
    EXPECT_EQ(index.computed(), 2u);
}

TEST_F(Index, PassesOverWhatIsNoIndexAndWhatIsCutOff)
{
    const std::filesystem::path file = folder / ".damslip-index.csv";
    for (const char* text : {"", "record\n", "a,b,c\n1,2,3\n", "record,checksum,PGA_m_s2\nx,y\n"}) {
        write_file(file, text);
        SuiteIndex index(folder);
        EXPECT_TRUE(same(index.measures(record), measure(record))) << text;
        EXPECT_EQ(index.computed(), 1u);
    }
    SuiteIndex index(folder);
    index.measures(record);
    index.keep();
    const std::string whole = read_file(file);
    write_file(file, whole.substr(0, whole.size() - 40)); // a line cut off
    SuiteIndex cut(folder);
    EXPECT_TRUE(same(cut.measures(record), measure(record)));
    EXPECT_EQ(cut.computed(), 1u);
    SuiteIndex nowhere(folder / "there is no such folder" / "\n");
    nowhere.measures(record);
    EXPECT_NO_THROW(nowhere.keep());
}

} // namespace
} // namespace damslip::records
