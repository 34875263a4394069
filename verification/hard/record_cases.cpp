#include "verification/hard/hard_scenes.hpp"

#include "core/input_error.hpp"
#include "records/read/read_record.hpp"
#include "records/transform/transform.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/exact/block_slip.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace damslip::hard {

namespace {

using fe2d::test::sines;

/// Ten minutes: the motion, then weak shaking that moves no rigid block, for the rest of the time.
HardResult ten_minutes()
{
    const GroundMotion start = sines(1.0, 6.0);
    GroundMotion motion = silence(600.0);
    motion.accel_v = motion.accel_h;
    for (std::size_t k = 0; k < motion.accel_h.size(); ++k)
        motion.accel_h[k] =
            k < start.accel_h.size() ? start.accel_h[k] : 0.05 * std::sin(0.37 * static_cast<double>(k));
    std::copy(start.accel_v.begin(), start.accel_v.end(), motion.accel_v.begin());
    return against_rigid(stiff_dam(0.7), motion);
}

HardResult spike()
{
    GroundMotion motion = silence(2.0);
    motion.accel_h[100] = 100.0;
    return against_rigid(stiff_dam(0.7), motion, 0.02);
}

Record record_of(std::vector<double> acceleration, double dt = 0.01)
{
    Record record;
    record.name = "samples";
    record.dt = dt;
    record.acceleration = std::move(acceleration);
    return record;
}

/// A record with a sample that is no number, by every way in: file, rigid block, finite elements.
HardResult no_number()
{
    HardResult result;
    result.status = "accepted";
    int refused = 0;
    const auto refuses = [&](const auto& use) {
        try {
            use();
        } catch (const InputError&) {
            ++refused;
        }
    };
    GroundMotion motion = sines(1.0, 1.0);
    motion.accel_h[50] = std::numeric_limits<double>::quiet_NaN();
    records::ReadOptions options;
    options.unit = "m/s2";
    options.dt = 0.01;
    refuses([&] { records::parse_record("0.1\n0.2\nnan\n0.1\n", "record.txt", options); });
    refuses([&] { rigid_run(stiff_dam(0.7), motion); });
    refuses([&] { fe_run(stiff_dam(0.7), motion); });
    if (refused == 3) result.status = "refused";
    result.value_a = refused;
    result.value_b = 3;
    return result;
}

HardResult constant_offset()
{
    Record record = record_of(sines(0.6, 6.0).accel_h);
    for (double& a : record.acceleration) a += 0.4;
    return against_rigid(stiff_dam(0.7), records::make_ground_motion(record, std::nullopt));
}

HardResult tiny_amplitude()
{
    const GroundMotion motion = sines(1.0, 6.0);
    const Scene scene = soft_dam(0.7);
    const double micro = fe_run(scene, scaled(motion, 1e-4), 0).max_slip; // proportional to the record from there on
    HardResult result = compared(fe_run(scene, scaled(motion, 1e-12), 0), 0.0, 10.0 * 1e-8 * micro);
    return result;
}

/// Zero samples in the middle of a slide: the block coasts over them.
HardResult exact_zeros()
{
    GroundMotion motion = silence(3.0);
    for (std::size_t k = 20; k < 60; ++k) motion.accel_h[k] = k % 4 < 2 ? 4.0 : 0.0;
    return against_rigid(stiff_dam(0.7), motion);
}

/// a = A (1 - t/t_d) on a yield of 0.6 A: stops at 0.8 t_d, a sample.
HardResult stop_on_sample()
{
    const double a_y = 3.0, acceleration = 5.0, end = 1.0, dt = 0.1;
    Scene scene = stiff_block(8.0, 1.0, a_y / 9.81);
    GroundMotion motion = silence(end, dt);
    for (std::size_t k = 0; k < motion.accel_h.size(); ++k)
        motion.accel_h[k] = acceleration * (1.0 - static_cast<double>(k) * dt / end);
    const double expected = exact::slip_under_decaying_ramp(acceleration, end, a_y);
    HardResult result;
    result.value_a = rigid_run(scene, motion).slip;
    result.value_b = expected;
    result.tolerance = 1e-13 * expected;
    result.status = "at rest";
    return result;
}

/// The same by finite elements, which start one sample earlier from zero.
HardResult stop_on_sample_fe()
{
    const double a_y = 3.0;
    const Scene scene = stiff_block(8.0, 1.0, a_y / 9.81);
    Record record = record_of({}, 0.1);
    for (int k = 0; k <= 10; ++k) record.acceleration.push_back(5.0 * (1.0 - 0.1 * k));
    const GroundMotion motion = records::make_ground_motion(record, std::nullopt);
    const double rigid = rigid_run(scene, motion).slip;
    return compared(fe_run(scene, motion, 6), rigid, 0.01 * rigid);
}

} // namespace

void add_record_cases(HardCases& cases)
{
    const std::string rigid = "event-located rigid block", fe = "FE, moduli x 1e4";
    const std::string step = "1 %: slides end at step ends, 0.0025 s of 0.25 s";
    cases.push_back({.id = "hard.record.ten-minutes",
                     .why = "240 000 steps, all but 2400 of them in which nothing may creep",
                     .method_a = fe,
                     .method_b = rigid,
                     .tolerance = step,
                     .run = ten_minutes});
    cases.push_back(
        {.id = "hard.record.one-spike",
         .why = "a single sample of 100 m/s2 in a silent record",
         .method_a = fe,
         .method_b = rigid,
         .tolerance = "2 %: the slide starts within the spike's 0.02 s, known to 0.0025 s of the 0.7 s it lasts",
         .run = spike});
    cases.push_back({.id = "hard.record.nan",
                     .why = "a sample that is no number",
                     .quantity = "refusals",
                     .unit = "-",
                     .method_a = "record file, rigid block, FE",
                     .method_b = "all three",
                     .tolerance = "none",
                     .expected_status = "refused",
                     .run = no_number});
    cases.push_back(
        {.id = "hard.record.constant-offset",
         .why = "no baseline: the mean of the record pushes the dam all the time, and the first sample is not zero",
         .method_a = fe,
         .method_b = rigid,
         .tolerance = step,
         .run = constant_offset});
    cases.push_back(
        {.id = "hard.record.amplitude-1e-12",
         .why = "motions of 1e-12 m/s2 beside static forces: all of it is round-off of the forces",
         .method_a = "FE",
         .method_b = "limit: none",
         .tolerance = "ten times the slip of pairs at heel and toe, which goes with the record (measured at 1e-4)",
         .run = tiny_amplitude});
    cases.push_back({.id = "hard.record.exact-zeros",
                     .why = "samples that are exactly zero while the dam slides: a scheme that skips them freezes it",
                     .method_a = fe,
                     .method_b = rigid,
                     .tolerance = step,
                     .run = exact_zeros});
    cases.push_back({.id = "hard.record.stop-on-a-sample",
                     .why = "the block stops exactly on a sample: a search inside intervals misses it",
                     .method_a = rigid,
                     .method_b = "closed form of the decaying ramp",
                     .tolerance = "1e-13: events are located to round-off",
                     .run = stop_on_sample});
    cases.push_back({.id = "hard.record.stop-on-a-sample-fe",
                     .why = "the same, and the record starts with its peak",
                     .method_a = "FE, stiff block",
                     .method_b = rigid,
                     .tolerance = "1 %: steps of 0.0016 s of a slide of 0.8 s, start and stop",
                     .run = stop_on_sample_fe});
}

} // namespace damslip::hard
