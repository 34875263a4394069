// SLAMMER's published results (Jibson, Rathje, Jibson & Lee 2013): 90 rigid and 1,026 linear-elastic decoupled and coupled
// analyses of 18 records, each in both directions. The folder is not part of the project: DAMSLIP_SLAMMER names it, or it lies
// beside the source as ../shared/slammer; without it these tests are skipped. The exact integration is of every third
// decoupled analysis; DAMSLIP_SLAMMER_EVERY=1 takes all (20 s in place of 7 s of processor time).
#include "core/parallel.hpp"
#include "sliding/flexible/flexible_mode.hpp"
#include "source_dir.hpp"
#include "verification/exact/flexible_slip.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>
#include <sstream>

namespace {

using namespace damslip;
using SlammerJson = nlohmann::json;

constexpr double slammer_gravity = 9.80665; ///< [m/s^2]

/// One analysis: the motion as scaled [m/s^2], and what was published [cm].
struct SlammerAnalysis {
    std::string id;
    const GroundMotion* record = nullptr;
    double scale = 0.0, yield = 0.0; ///< [m/s^2]
    sliding::FlexibleBlock block;    ///< of a flexible one
    double published_normal = 0.0, published_inverse = 0.0;

    GroundMotion motion() const
    {
        GroundMotion m = *record;
        for (double& a : m.accel_h) a *= scale;
        return m;
    }
};

std::filesystem::path slammer_folder()
{
    if (const char* named = std::getenv("DAMSLIP_SLAMMER")) return named;
    return std::filesystem::path(source_dir()) / "../shared/slammer";
}

class SlammerSet : public testing::Test {
protected:
    void SetUp() override
    {
        const auto file = slammer_folder() / "slammer_results.json.gz";
        if (!std::filesystem::exists(file)) GTEST_SKIP() << "SLAMMER's results are not here: " << file;
        const std::string command = "gzip -dc '" + file.string() + "'";
        const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
        std::string text;
        std::array<char, 65536> part;
        while (const std::size_t n = fread(part.data(), 1, part.size(), pipe.get())) text.append(part.data(), n);
        results = SlammerJson::parse(text)["analyses"];
        if (const char* given = std::getenv("DAMSLIP_SLAMMER_EVERY")) every = std::max(1, std::atoi(given));
    }

    /// Samples in g; the peak is known to three decimals, as SLAMMER scaled by it.
    const GroundMotion& record(const std::string& name)
    {
        GroundMotion& motion = records[name];
        if (!motion.accel_h.empty()) return motion;
        motion.name = name;
        std::ifstream in(slammer_folder() / "records" / name);
        double time = 0.0, accel = 0.0, first = 0.0;
        char comma;
        for (std::string line; std::getline(in, line);) {
            std::istringstream fields(line);
            if (!(fields >> time >> comma >> accel)) continue;
            if (motion.accel_h.empty()) first = time;
            if (motion.accel_h.size() == 1) motion.dt = time - first;
            motion.accel_h.push_back(accel);
        }
        return motion;
    }

    /// Linear-elastic or rigid, `step`-th ones.
    std::vector<SlammerAnalysis> analyses(const std::string& method, std::size_t step)
    {
        std::vector<SlammerAnalysis> list;
        std::size_t number = 0;
        for (const SlammerJson& a : results) {
            if (a["analysis"]["method"] != method || a["analysis"].value("mode", "") == "equivalent_linear") continue;
            if (number++ % step != 0) continue;
            const SlammerJson &ground = a["ground_motion_parameters"], &site = a["site_parameters"], &r = a["results"];
            SlammerAnalysis one;
            one.id = a["analysis_id"];
            one.record = &record(ground["ground_motion_file"]);
            double pga = 0.0;
            for (const double x : one.record->accel_h) pga = std::max(pga, std::abs(x));
            pga = std::round(1e3 * pga) / 1e3;
            one.scale = ground["target_pga_g"].get<double>() / pga * slammer_gravity;
            one.yield = site["ky_g"].get<double>() * slammer_gravity;
            if (method != "rigid") {
                one.block.period = 4.0 * site["height_m"].get<double>() / r["vs_final_mps"].get<double>();
                one.block.damping_ratio = r["damping_final"];
            }
            one.published_normal = r["normal_displacement_cm"];
            one.published_inverse = r["inverse_displacement_cm"];
            list.push_back(one);
        }
        return list;
    }

    static sliding::SlipStages block_of(const SlammerAnalysis& a)
    {
        sliding::RigidBlock block;
        block.mass = 1.0;
        block.gravity = slammer_gravity;
        block.friction = a.yield / slammer_gravity;
        return {{0.0, block, 0.0}};
    }
    static sliding::SlideOptions one_way(int polarity)
    {
        sliding::SlideOptions options;
        options.polarity = polarity;
        options.sliding.two_way = false;
        return options;
    }

    SlammerJson results;
    std::map<std::string, GroundMotion> records;
    std::size_t every = 3;
};

// Its scheme gives its digits: five decimals of a centimetre, three of large slips.
TEST_F(SlammerSet, rigid_slips_are_met_by_its_scheme)
{
    const auto list = analyses("rigid", 1);
    EXPECT_EQ(list.size(), 90u);
    for (const SlammerAnalysis& a : list)
        for (const int polarity : {1, -1}) {
            sliding::SlideOptions options = one_way(polarity);
            options.sliding.scheme = SlidingScheme::slammer;
            const double slip = 100.0 * sliding::slide(a.motion(), block_of(a), options).slip;
            const double published = polarity > 0 ? a.published_normal : a.published_inverse;
            EXPECT_NEAR(slip, published, std::max(5.1e-6, 5e-6 * published)) << a.id << " " << polarity;
        }
}

// Decoupled against steps of fourth order, a 32nd of a radian of the mode long at most: 0.05 % of every slip. Their own error
// is up to 1e-5, where a start between two steps is not seen.
TEST_F(SlammerSet, decoupled_slips_are_exact)
{
    const auto list = analyses("decoupled", every);
    std::vector<double> slips(2 * list.size()), expected(2 * list.size());
    parallel_for(slips.size(), 0, [&](std::size_t k) {
        const SlammerAnalysis& a = list[k / 2];
        const int polarity = k % 2 == 0 ? 1 : -1;
        GroundMotion motion = a.motion();
        slips[k] = sliding::slide_decoupled(motion, block_of(a), a.block, one_way(polarity)).slide.slip;
        for (double& x : motion.accel_h) x *= polarity;
        const exact::FlexibleSlipCase c{2.0 * std::numbers::pi / a.block.period, a.block.damping_ratio,
                                        a.block.mass_ratio, a.yield};
        expected[k] = exact::slip_decoupled_by_steps(c, motion.accel_h, motion.dt, 60.0);
    });
    double worst = 0.0;
    for (std::size_t k = 0; k < slips.size(); ++k) {
        EXPECT_NEAR(slips[k], expected[k], 5e-4 * expected[k]) << list[k / 2].id << (k % 2 ? ", inverse" : "");
        if (expected[k] > 0.0) worst = std::max(worst, std::abs(slips[k] / expected[k] - 1.0));
    }
    EXPECT_LT(worst, 1e-4);
    RecordProperty("worst", std::to_string(worst));
}

// Frozen on 22 November 2026: the sum of every third coupled pair's slips, as it was before decoupled became exact. It says
// "unchanged", no more; what coupled is worth: damslip verify sliding.neighbours.flexible.
TEST_F(SlammerSet, coupled_slips_are_what_they_were)
{
    const auto list = analyses("coupled", 3);
    std::vector<double> slips(2 * list.size());
    parallel_for(slips.size(), 0, [&](std::size_t k) {
        const SlammerAnalysis& a = list[k / 2];
        const auto options = one_way(k % 2 == 0 ? 1 : -1);
        slips[k] = 100.0 * sliding::slide_coupled(a.motion(), block_of(a), a.block, options).slide.slip;
    });
    double sum = 0.0;
    for (const double slip : slips) sum += slip;
    EXPECT_EQ(slips.size(), 684u);
    EXPECT_NEAR(sum, 54092.04896639034, 1e-9 * sum);
}

// Shares stated in docs/neighbours.md: decoupled is no bound of coupled. 1,216 pairs above 10 mm, 22 % of them below coupled;
// 66 % of the 217 with T_s >= 2 s. All analyses, whatever DAMSLIP_SLAMMER_EVERY says: a third of them is another set.
TEST_F(SlammerSet, decoupled_is_no_bound)
{
    const auto decoupled = analyses("decoupled", 1), coupled = analyses("coupled", 1);
    ASSERT_EQ(decoupled.size(), coupled.size());
    std::vector<std::array<double, 2>> pairs(2 * coupled.size());
    parallel_for(pairs.size(), 0, [&](std::size_t k) {
        const SlammerAnalysis& a = decoupled[k / 2];
        ASSERT_EQ(a.block.period, coupled[k / 2].block.period);
        const auto options = one_way(k % 2 == 0 ? 1 : -1);
        const GroundMotion motion = a.motion();
        pairs[k] = {sliding::slide_decoupled(motion, block_of(a), a.block, options).slide.slip,
                    sliding::slide_coupled(motion, block_of(a), a.block, options).slide.slip};
    });
    double all = 0.0, below = 0.0, soft = 0.0, soft_below = 0.0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (std::max(pairs[k][0], pairs[k][1]) <= 0.010) continue;
        const bool is_soft = decoupled[k / 2].block.period > 1.999, is_below = pairs[k][0] < pairs[k][1];
        all += 1.0, below += is_below, soft += is_soft, soft_below += is_soft && is_below;
    }
    EXPECT_EQ(all, 1216.0);
    EXPECT_EQ(soft, 217.0);
    EXPECT_NEAR(below / all, 0.225, 0.001);
    EXPECT_NEAR(soft_below / soft, 0.659, 0.001);
}

} // namespace
