// What a fragility holds while it grows. A rigid run takes 33 bytes of answers (slip, largest and upstream slip, critical friction, status), 4 of its record, and
// 4 for each variable of a Latin hypercube; eight more where its yield is kept.
#include "pulse_scene.hpp"

#include "analysis/fragility/fragility_runs.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <malloc.h>

namespace damslip {
namespace {

double held_bytes()
{
    const struct mallinfo2 now = mallinfo2();
    return static_cast<double>(now.uordblks + now.hblkhd);
}

/// The most that is held at any word of a run.
class MeterWatch final : public Watch {
public:
    void at(double) override { most = std::max(most, held_bytes()); }
    double most = 0.0;
};

struct Grown {
    double plan = 0.0, run = 0.0; ///< [bytes]
};

Grown grown_by(const SceneText& text, const FragilityInput& input, std::size_t samples)
{
    const ShakingSuite suite = pulse::suite(text);
    const double before = held_bytes();
    const FragilityPlan plan =
        plan_fragility(input, suite, {samples}, text.file(), [](const std::string&) { return 1.0; });
    Grown grown;
    grown.plan = held_bytes() - before;
    MeterWatch watch;
    const FragilityRuns runs = run_fragility(plan, text, sweep_method("rigid"), wanted_samples(plan), nullptr, 1, watch,
                                             Yields::dropped);
    EXPECT_TRUE(runs.complete());
    grown.run = std::max(watch.most, held_bytes()) - before;
    return grown;
}

// Bytes a run between 6,000 and 24,000 runs, both beyond what is at work together. The bounds are those of the head with 10 % for the allocator; a plan
// that held its samples took 80 bytes more a run, one that held its draws 200, rows as they are in a sweep 440. A second variable that changes the
// statics of each draw keeps no more of them than there is room for: 256.
TEST(FragilityMemory, FlatOverSamples)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the allocator of a sanitizer tells nothing";
#endif
    const SceneText text = pulse::scene();
    constexpr std::size_t few = 6'000, many = 24'000;
    for (const auto& [sampling, each] : {std::pair{SamplingInput::random, 0.0}, {SamplingInput::latin_hypercube, 4.0}}) {
        FragilityInput input;
        input.probability.sampling = sampling;
        input.probability.replicates = 1;
        input.probability.variables = {
            pulse::mu(), pulse::lognormal("density", "dam.density_kg_m3", 2500.0, 0.02, VariableKind::aleatory)};
        for (RandomVariable& v : input.probability.variables) v.kind = VariableKind::aleatory;
        input.intensity.levels = {pulse::accel};
        input.limits = {{LimitQuantity::slip, 0.2, "slip"}};
        grown_by(text, input, few); // what is made once
        const Grown small = grown_by(text, input, few), large = grown_by(text, input, many);
        const double plan = (large.plan - small.plan) / (many - few), run = (large.run - small.run) / (many - few);
        EXPECT_LT(plan, 1.1 * (4.0 + 2.0 * each));
        EXPECT_LT(run, 1.1 * (37.0 + 2.0 * each));
        EXPECT_GT(run, 30.0); // the meter meters
    }
}

// A packed row comes back as it was, also where another row brings a figure first, or a figure is no number.
TEST(FragilityMemory, PackedRows)
{
    PackedRows rows(4);
    FinishedRow first;
    first.id = 2;
    first.results.slip = 0.25;
    first.results.critical_friction = INFINITY;
    first.results.status = "at rest";
    FinishedRow second;
    second.id = 0;
    second.good = false;
    second.results.opening = 0.0;
    second.results.status = "not resolved";
    FinishedRow third;
    third.id = 3;
    third.results.slip = NAN;
    third.results.status = "at rest";
    for (const FinishedRow& row : {first, second, third}) rows.put(row);
    EXPECT_EQ(rows.finished(), 3u);
    EXPECT_FALSE(rows[1]);
    EXPECT_EQ(rows[2]->results, first.results);
    EXPECT_TRUE(rows[2]->good);
    EXPECT_EQ(rows[0]->results, second.results);
    EXPECT_FALSE(rows[0]->good);
    ASSERT_TRUE(rows[3]->results.slip);
    EXPECT_TRUE(std::isnan(*rows[3]->results.slip));
    first.results.slip.reset();
    rows.put(first); // again, without
    EXPECT_EQ(rows[2]->results, first.results);
}

} // namespace
} // namespace damslip
