// Original files as the agencies distribute them, where the environment names a folder of them: DAMSLIP_RECORD_FORMATS.
// They are not part of the project (rights, size). What is expected are the numbers their own headers print.
#include "records/read/read_record.hpp"

#include "core/file.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::records;

struct Printed {
    const char* component;
    std::size_t samples;
    double dt;         ///< [s]
    double peak, half; ///< signed, [m/s^2]; half of its last printed digit
    double time;       ///< of the peak [s]; negative: not unique or not printed
};

void expect_printed(const std::filesystem::path& file, const std::vector<Printed>& printed)
{
    const auto records = parse_record(read_file(file), file.string());
    ASSERT_EQ(records.size(), printed.size()) << file;
    for (std::size_t c = 0; c < records.size(); ++c) {
        const Record& r = records[c];
        EXPECT_EQ(r.source.component, printed[c].component);
        EXPECT_EQ(r.acceleration.size(), printed[c].samples);
        EXPECT_DOUBLE_EQ(r.dt, printed[c].dt);
        std::size_t peak = 0;
        for (std::size_t k = 0; k < r.acceleration.size(); ++k)
            if (std::abs(r.acceleration[k]) > std::abs(r.acceleration[peak])) peak = k;
        EXPECT_NEAR(r.acceleration[peak], printed[c].peak, 1.001 * printed[c].half) << file << " " << c;
        if (printed[c].time >= 0.0) {
            EXPECT_NEAR(static_cast<double>(peak) * r.dt, printed[c].time, 1e-9);
        }
    }
}

TEST(RecordFormatsFolder, files_of_the_agencies)
{
    const char* folder = std::getenv("DAMSLIP_RECORD_FORMATS");
    if (!folder || !std::filesystem::is_directory(folder))
        GTEST_SKIP() << "DAMSLIP_RECORD_FORMATS names no folder of original record files";
    const std::filesystem::path root(folder);
    const double g = 9.80665;
    const auto have = [&](const char* name) { return std::filesystem::exists(root / name); };
    if (have("cosmos_v1_ci14155260.v1"))
        expect_printed(root / "cosmos_v1_ci14155260.v1", {{"340 deg", 7000, 0.01, -1.61962, 5e-6, 27.85}});
    if (have("csmip_v2_coalinga_1983_ce36456p.V2"))
        expect_printed(root / "csmip_v2_coalinga_1983_ce36456p.V2", {{"90 DEG", 3251, 0.02, -2.67957, 5e-6, 10.94},
                                                                     {"UP", 3250, 0.02, -0.94805, 5e-6, 11.68},
                                                                     {"0 DEG", 3250, 0.02, -2.56231, 5e-6, 7.74}});
    if (have("csmip_raw_hesperia_ce23583r.RAW")) // three digits of g; the vertical peak occurs more than once
        expect_printed(root / "csmip_raw_hesperia_ce23583r.RAW",
                       {{"90 DEG", 12001, 0.005, 0.058 * g, 5e-4 * g, 9.425},
                        {"UP", 12001, 0.005, 0.042 * g, 5e-4 * g, -1.0},
                        {"180 DEG", 12001, 0.005, -0.091 * g, 5e-4 * g, 9.615}});
    if (have("smc_lomaprieta_1989_0111a.smc")) // peak 0.1044078E+03 cm/s2 at 0.1017E+02 s, samples to five digits
        expect_printed(root / "smc_lomaprieta_1989_0111a.smc", {{"360", 6001, 0.005, 1.044078, 5e-5, 10.17}});
    // Whatever else lies there must be read too.
    for (const auto& entry : std::filesystem::directory_iterator(root)) {
        if (!entry.is_regular_file()) continue;
        EXPECT_NO_THROW({
            const auto records = parse_record(read_file(entry.path()), entry.path().string());
            EXPECT_FALSE(records.empty());
        }) << entry.path();
    }
}

} // namespace
