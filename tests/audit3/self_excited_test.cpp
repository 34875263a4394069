// A16: a dam that goes on sliding by itself does so at every scale. With lengths and moduli times 4 and times times 2 the equations
// are the same ones, so status and end have to be, too.
#include "analysis/prepare/ready.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "scene/read.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace {

using namespace damslip;

/// A dam on a rigid base, which keeps every wave.
Scene dam(double length, double friction)
{
    return parse_scene(fmt::format("[section]\nheight_m = {}\nbase_m = {}\ncrest_m = {}\n"
                                   "[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa = {}\npoisson_ratio = 0.2\n"
                                   "[reservoir]\nlevel_m = {}\nmodel = \"added-mass\"\n[uplift]\nmodel = \"linear\"\n"
                                   "[contact]\nfriction = {}\n[mesh]\nsize_m = {}\ncontact_size_m = {}\n"
                                   "[time]\nsubsteps = 4\n",
                                   52 * length, 36 * length, 5 * length, 20 * length, 42 * length, friction, 13 * length,
                                   6 * length),
                       "dam.toml");
}

/// Pulses in both components for 3 s times the scale of time.
GroundMotion pulses(double time)
{
    GroundMotion motion;
    motion.dt = 0.02 * time;
    for (int k = 0; k <= 150; ++k) {
        const double t = 0.02 * k, rise = std::sin(3.14159265358979 * t / 3.0);
        motion.accel_h.push_back(5.5 * rise * std::sin(2 * 3.14159265358979 * 1.9 * t));
        motion.accel_v.push_back(3.0 * rise * std::sin(2 * 3.14159265358979 * 4.3 * t));
    }
    return motion;
}

fe2d::RunResult run(double length, double friction)
{
    const Ready ready = prepare(dam(length, friction), Method::finite_elements,
                                std::make_shared<const std::vector<RecordPair>>());
    const Watch nobody;
    return fe2d::EarthquakeRun(ready.scene, ready.run_options(nobody)).run(pulses(std::sqrt(length)));
}

TEST(Audit3, A16_SelfExcitedAtEveryScale)
{
    int self_excited = 0;
    for (const double friction : {0.64, 0.68, 0.74}) {
        SCOPED_TRACE(friction);
        const fe2d::RunResult own = run(1.0, friction), large = run(4.0, friction);
        self_excited += own.status == Status::self_excited;
        EXPECT_EQ(large.status, own.status) << text_of(own.notes) << "\n" << text_of(large.notes);
        EXPECT_NEAR(large.end_time, 2.0 * own.end_time, 0.1);
        EXPECT_NEAR(large.max_slip, 4.0 * own.max_slip, 1e-4 * own.max_slip);
    }
    EXPECT_GE(self_excited, 1);
}

} // namespace
