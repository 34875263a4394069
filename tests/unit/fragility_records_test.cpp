// Recorded motions (PROBABILITY.md 9, case 3): P of a one-way block under the shipped accelerograms is the mean over records and polarities of F(mu*),
// mu* the friction with the limit's slip, found by integration in extended precision and bisection.
#include "core/file.hpp"
#include "probability/distribution.hpp"
#include "program_answer.hpp"
#include "records/read/read_record.hpp"
#include "verification/exact/block_slip.hpp"
#include "source_dir.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace damslip {
namespace {

constexpr double gravity = 9.81, median = 0.1, beta = 0.3, limit = 0.05;
constexpr double levels[] = {2.0, 4.0}; // PGA [m/s^2]

constexpr const char* scene = R"([section]
height_m = 50
base_m = 40
crest_m = 5
[dam]
density_kg_m3 = 2400
young_modulus_GPa = 25
poisson_ratio = 0.2
[contact]
friction = 0.3
[sliding]
two_way = false
[probability]
[[probability.variable]]
name = "mu"
key = "contact.friction"
lognormal = { median = 0.1, beta = 0.3 }
[suite]
files = "list.csv"
polarity = "both"
[intensity]
measure = "PGA"
levels_m_s2 = [2.0, 4.0]
[[limit]]
quantity = "slip"
above_mm = 50
)";

/// Of one record scaled to a PGA, one way round.
double friction_of_limit(const Record& record, double pga, double sign)
{
    std::vector<double> accel = record.acceleration;
    double peak = 0.0;
    for (const double a : accel) peak = std::max(peak, std::abs(a));
    for (double& a : accel) a *= sign * pga / peak;
    double low = 0.0, high = pga / gravity;
    while (high - low > 1e-13 * high) {
        const double mid = 0.5 * (low + high);
        (exact::slip_of_interpolant(accel, record.dt, mid * gravity, INFINITY) > limit ? low : high) = mid;
    }
    return 0.5 * (low + high);
}

TEST(Fragility, RecordedMotions)
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("damslip recorded " + std::to_string(::getpid()));
    const std::filesystem::path data = std::filesystem::path(source_dir()) / "records" / "data";
    std::string list = "horizontal\n";
    std::vector<Record> records;
    for (const char* name : {"rock_1.0_h.csv", "ec8_3.0_h.csv"}) {
        list += (data / name).string() + "\n";
        records.push_back(records::read_record(data / name, {}));
    }
    write_file(folder / "list.csv", list);
    write_file(folder / "block.toml", scene);
    const ProgramAnswer answer = answer_of({"fragility", (folder / "block.toml").string(), "--conditioning", "on",
                                            "--samples", "8", "--share-rows", "0", "--json", "--quiet"});
    std::filesystem::remove_all(folder);
    ASSERT_EQ(answer.code, 0) << answer.talk;
    const auto found = nlohmann::json::parse(answer.out)["probabilities"];
    ASSERT_EQ(found.size(), std::size(levels));
    for (std::size_t i = 0; i < std::size(levels); ++i) {
        double p = 0.0;
        for (const Record& record : records)
            for (const double sign : {1.0, -1.0})
                p += probability::normal_cdf(std::log(friction_of_limit(record, levels[i], sign) / median) / beta);
        p /= 2.0 * static_cast<double>(records.size());
        EXPECT_NEAR(found[i]["probability"].get<double>(), p, 1e-9 * p) << levels[i];
    }
}

} // namespace
} // namespace damslip
