#include "core/parallel.hpp"
#include "core/units.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/block/slide_batch.hpp"
#include "sliding/flexible/flexible_mode.hpp"
#include "verification/external/slammer_set.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::external {

namespace {

constexpr double to_cm = 100.0;

/// Half a unit of the last of five decimals, and of the sixth digit where it prints fewer.
double printed(double value)
{
    return std::max(5.1e-6, 5.1e-6 * std::abs(value));
}

/// The record with `parts` steps in each of its own.
std::vector<double> divided(const std::vector<double>& accel, int parts)
{
    std::vector<double> fine;
    for (std::size_t k = 0; k + 1 < accel.size(); ++k)
        for (int i = 0; i < parts; ++i) fine.push_back(accel[k] + (accel[k + 1] - accel[k]) * i / parts);
    fine.push_back(accel.back());
    return fine;
}

/// Slip by its own scheme at a part of its step [cm].
double by_its_scheme(const SlammerAnalysis& a, const std::vector<double>& accel, int parts)
{
    const std::vector<double> fine = divided(accel, parts);
    const double dt = a.dt / parts;
    if (a.method == "rigid") return to_cm * sliding::slammer_slip(fine, dt, a.yield);
    if (a.method == "coupled") return to_cm * slammer_coupled(a.column(), fine, dt, a.yield);
    return to_cm * slammer_decoupled(slammer_response(a.column(), fine, dt).drive, dt, a.yield);
}

/// By this program [cm].
double by_us(const SlammerAnalysis& a, std::vector<double> accel)
{
    if (a.method == "rigid") return to_cm * sliding::slide_constant_yield(accel, a.dt, a.yield).slip;
    sliding::RigidBlock block;
    block.mass = 1.0;
    block.friction = a.yield / block.gravity;
    const sliding::SlipStages stages{{0.0, block, 0.0}};
    sliding::SlideOptions options;
    options.sliding.two_way = false;
    GroundMotion motion{a.id, a.dt, std::move(accel), {}, {}};
    sliding::FlexibleBlock column;
    column.period = 4.0 * a.height / a.final_velocity;
    column.damping_ratio = a.final_damping;
    return to_cm * (a.method == "coupled" ? sliding::slide_coupled(motion, stages, column, options)
                                          : sliding::slide_decoupled(motion, stages, column, options))
                       .slide.slip;
}

Result slip_of(const SlammerAnalysis& a, int direction)
{
    const std::vector<double> accel = a.accel(direction == 0 ? 1.0 : -1.0);
    const double at_step = by_its_scheme(a, accel, 1), at_4 = by_its_scheme(a, accel, 4),
                 at_16 = by_its_scheme(a, accel, 16);
    Result r;
    r.group = a.method == "rigid" ? "rigid block, slip"
                                  : a.method + (a.strain ? ", equivalent-linear, slip" : ", linear, slip");
    r.what = a.words + (direction == 0 ? ", normal" : ", inverse");
    r.unit = "cm";
    r.theirs = a.published[direction];
    r.ours = by_us(a, accel);
    // Of first order, and what the refined steps still differ by.
    r.accuracy = printed(r.theirs) + std::abs(at_step - at_16) * 16.0 / 15.0 + std::abs(at_4 - at_16);
    // Velocity and damping of an equivalent-linear column are printed to five decimals, too: its slip follows them.
    r.reproduced = std::abs(at_step - r.theirs) <= std::max(1.1e-5, (a.strain ? 1e-3 : 1e-5) * r.theirs);
    if (!r.within())
        r.reason = fmt::format("its scheme at its step {:.5g}, at a 4th {:.5g}, a 16th {:.5g}, a 64th {:.5g} cm",
                               at_step, at_4, at_16, by_its_scheme(a, accel, 64));
    return r;
}

/// Largest |k| of the column on a base that holds [g].
double largest_drive(const SlammerAnalysis& a)
{
    sliding::RigidBlock block;
    block.mass = 1.0;
    block.friction = 1e3; // more than any drive
    sliding::FlexibleBlock column;
    column.period = 4.0 * a.height / a.final_velocity;
    column.damping_ratio = a.final_damping;
    const GroundMotion motion{a.id, a.dt, a.accel(1.0), {}, {}};
    return sliding::slide_decoupled(motion, {{0.0, block, 0.0}}, column).peak_acceleration / units::standard_gravity;
}

Result drive_of(const SlammerAnalysis& a)
{
    const double g = units::standard_gravity;
    const auto by_its_steps = [&](int parts) {
        return slammer_response(a.column(), divided(a.accel(1.0), parts), a.dt / parts).largest_drive / g;
    };
    const double at_step = by_its_steps(1), at_4 = by_its_steps(4), at_16 = by_its_steps(16);
    Result r;
    r.group = "largest drive k_max";
    r.what = a.words;
    r.unit = "g";
    r.theirs = *a.k_max;
    r.ours = largest_drive(a);
    // Of second order, and what the refined steps still differ by; the peak lies between two samples.
    r.accuracy = printed(r.theirs) + std::abs(at_step - at_16) * 256.0 / 255.0 + std::abs(at_4 - at_16);
    // Five decimals; of an equivalent-linear column those of velocity and damping, too.
    r.reproduced = std::abs(at_step - r.theirs) <= 1.1e-5 + (a.strain ? 2e-4 * r.theirs : 0.0);
    if (!r.within())
        r.reason = fmt::format("Newmark's steps: {:.6g}, a 4th {:.6g}, a 16th {:.6g} g", at_step, at_4, at_16);
    return r;
}

void add_strain_results(const SlammerAnalysis& a, std::vector<Result>& results)
{
    constexpr double its_tolerance = 0.05; // it stops there, so ours has to
    const StrainColumn& c = *a.strain;
    GroundMotion motion;
    motion.dt = a.dt;
    motion.accel_h = a.accel(1.0);
    const sliding::StrainCompatible found =
        sliding::strain_compatible({c.height, c.velocity, c.damping, c.base_velocity, 0.01 * c.reference_strain},
                                   motion, sliding::FlexibleBlock{}.mass_ratio, its_tolerance);
    const auto its_own = slammer_equivalent_linear(c, motion.accel_h, a.dt);
    const auto add = [&](const char* group, const char* unit, double theirs, double ours, double by_its_steps,
                         double share) {
        Result r;
        r.group = group;
        r.what = a.words;
        r.unit = unit;
        r.theirs = theirs;
        r.ours = ours;
        r.accuracy = share * theirs;
        r.reproduced = std::abs(by_its_steps - theirs) <= 2.0 * printed(theirs);
        if (!r.within()) r.reason = fmt::format("its own steps: {:.6g}", by_its_steps);
        results.push_back(std::move(r));
    };
    add("strain-compatible velocity", "m/s", a.final_velocity, found.velocity, its_own ? its_own->velocity : NAN,
        0.005);
    add("strain-compatible damping", "–", a.final_damping, found.block.damping_ratio, its_own ? its_own->damping : NAN,
        0.01);
}

std::vector<Result> compare(const std::filesystem::path& folder)
{
    const std::vector<SlammerAnalysis> set = read_slammer_set(folder);
    std::vector<std::vector<Result>> of_each(set.size());
    parallel_for(set.size(), 0, [&](std::size_t i) {
        const SlammerAnalysis& a = set[i];
        for (const int direction : {0, 1}) of_each[i].push_back(slip_of(a, direction));
        if (a.method == "decoupled") of_each[i].push_back(drive_of(a)); // the coupled one prints the same
        if (a.method == "decoupled" && a.strain) add_strain_results(a, of_each[i]);
    });
    std::vector<Result> all;
    for (std::vector<Result>& some : of_each) std::move(some.begin(), some.end(), std::back_inserter(all));
    std::stable_sort(all.begin(), all.end(), [](const Result& a, const Result& b) { return a.group < b.group; });
    return all;
}

} // namespace

Source slammer_source()
{
    return {
        "slammer",
        "Jibson, Rathje, Jibson & Lee (2013), SLAMMER 1.1, USGS Techniques and Methods 12-B1; its results as "
        "pySLAMMER publishes them (2,610 analyses)",
        "18 records scaled to 0.2 ... 0.5 g, one way, in both directions; rigid blocks, and columns of 5 ... 1000 m "
        "with one shear mode, decoupled and coupled, linear and equivalent-linear",
        "Slips: half a unit of the last digit, and the error of its steps, which its own scheme tells: "
        "16/15 of its change from the record's step to a 16th, and what a 4th and a 16th still differ by. Largest "
        "drive: "
        "the same of Newmark's steps, of second order. Velocity 0.5 %, damping 1 %: its iteration stops at "
        "changes of 5 %",
        slammer_file,
        compare};
}

} // namespace damslip::external
