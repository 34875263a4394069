// When sliding with the ground at rest is self-excited: made-up histories on both sides of every criterion, and small dams.
#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/run/run_watches.hpp"
#include "fe2d/run/earthquake_pass.hpp"
#include "program_answer.hpp"
#include "scene/write.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using fe2d::test::options_of;
using fe2d::test::sines;
using fe2d::test::sliding_dam;

constexpr double normal_force = 100.0, thrust = 50.0; // of the made-up dam [N/m]
constexpr double record_end = 2.0, step = 0.01;       // [s]

/// A dam that slides at one rate in each window of a second after the record.
struct MadeUp {
    std::vector<double> rates{1.0, 1.0, 1.0}; ///< [m/s]
    double chi = 1.5;                         ///< W_T/D_f
    double losses = 0.0;                      ///< of damping, radiation and scheme, share of W_T; NaN: no ledger
    double sliding_factor = 1.1;
    double thrust_of_plane = thrust;
    SlideLimits limits{record_end, normal_force, 0.1};
};

SlideWatch watched(const MadeUp& dam)
{
    SlideWatch watch(dam.limits, [] { return 1.0; });
    SlideInstant now;
    now.other_losses = 0.0 * dam.losses;
    now.normal_force = normal_force;
    now.sliding_factor = dam.sliding_factor;
    watch.add(now);
    const auto steps = static_cast<long>(std::lround((record_end + static_cast<double>(dam.rates.size())) / step));
    for (long n = 1; n <= steps; ++n) {
        now.time = static_cast<double>(n) * step;
        const auto window = static_cast<long>(std::ceil((now.time - record_end) / 1.0 - 1e-9)) - 1;
        const double rate = window < 0 ? dam.rates.front() : dam.rates[static_cast<std::size_t>(window)];
        const double work = dam.thrust_of_plane * rate * step;
        now.slip += rate * step;
        now.thrust_work += work;
        now.friction += work / dam.chi;
        now.other_losses += dam.losses * work;
        watch.add(now);
    }
    return watch;
}

bool goes_on(const MadeUp& dam)
{
    return watched(dam).self_excited();
}

const double nan_value = std::numeric_limits<double>::quiet_NaN();

TEST(SlideWatch, a_rate_that_falls_by_less_than_the_given_share_in_both_steps_goes_on)
{
    EXPECT_TRUE(goes_on({.rates = {1.0, 0.901, 0.812}}));
    EXPECT_FALSE(goes_on({.rates = {1.0, 0.899, 0.850}})); // the first step falls too far
    EXPECT_FALSE(goes_on({.rates = {1.0, 0.950, 0.850}})); // the second
    EXPECT_TRUE(goes_on({.rates = {1.0, 1.5, 2.5}}));      // it grows
    EXPECT_FALSE(goes_on({.rates = {1.0, 0.0, 0.0}}));     // it rests
    MadeUp wider{.rates = {1.0, 0.82, 0.66}};
    EXPECT_FALSE(goes_on(wider));
    wider.limits.rate_change = 0.2; // sliding.steady_rate_change
    EXPECT_TRUE(goes_on(wider));
}

TEST(SlideWatch, three_windows_with_the_ground_at_rest_have_to_pass)
{
    EXPECT_FALSE(goes_on({.rates = {1.0, 1.0}}));
    EXPECT_TRUE(goes_on({.rates = {1.0, 1.0, 1.0}}));
    EXPECT_TRUE(goes_on({.rates = {5.0, 1.0, 1.0, 1.0}})); // a first fall is no matter
    EXPECT_FALSE(goes_on({.rates = {5.0, 1.0, 1.0}}));
    MadeUp shaken;
    shaken.limits.record_end = 100.0; // as steady as before, but the ground moves
    EXPECT_FALSE(goes_on(shaken));
}

TEST(SlideWatch, the_thrust_has_to_pay_for_what_friction_takes)
{
    EXPECT_TRUE(goes_on({.chi = 1.001}));
    EXPECT_FALSE(goes_on({.chi = 0.999}));
    // χ < 1, but the scheme gives: ΔE = W (1 − 1/χ − losses).
    EXPECT_TRUE(goes_on({.chi = 0.99, .losses = -0.0102}));
    EXPECT_FALSE(goes_on({.chi = 0.99, .losses = -0.0100}));
    // Without a ledger χ alone decides.
    EXPECT_TRUE(goes_on({.chi = 1.001, .losses = nan_value}));
    EXPECT_FALSE(goes_on({.chi = 0.999, .losses = nan_value}));
    // Nothing pays without a thrust, and a thrust that loses work does not pay.
    EXPECT_FALSE(goes_on({.thrust_of_plane = 0.0}));
    EXPECT_FALSE(goes_on({.rates = {-1.0, -1.0, -1.0}}));
}

TEST(SlideWatch, a_dam_that_would_not_stand_slides_by_its_loads)
{
    EXPECT_TRUE(goes_on({.sliding_factor = 1.001}));
    EXPECT_FALSE(goes_on({.sliding_factor = 0.999}));
}

// A block with constant N' loses v' = g(mu − T/N') of its rate: χ = 1/FS to the last digit, whatever the rate, and it is never
// self-excited, though with FS = 1.01 the rate falls by 1 % in a window only.
TEST(SlideWatch, a_block_under_constant_pressure_dies_with_the_inverse_of_its_factor_of_safety)
{
    const double factor = 1.01, deceleration = 0.01;
    SlideWatch watch({record_end, normal_force, 0.1}, [] { return 1.0; });
    SlideInstant now;
    now.other_losses = 0.0;
    now.normal_force = normal_force;
    now.sliding_factor = factor;
    for (int n = 0; n <= 1000; ++n) {
        now.time = n * step;
        now.slip = 1.0 * now.time - 0.5 * deceleration * now.time * now.time;
        now.thrust_work = thrust * now.slip;
        now.friction = factor * thrust * now.slip;
        watch.add(now);
        ASSERT_FALSE(watch.self_excited()) << now.time;
    }
    const RunOutFigures figures = watch.figures();
    EXPECT_NEAR(figures.thrust_over_friction, 1.0 / factor, 1e-12);
    EXPECT_NEAR(figures.energy_kept, thrust * (1.0 - factor) * figures.slip_at_rest, 1e-9);
    EXPECT_NEAR(figures.rate, 1.0 - deceleration * 9.5, 1e-9); // mean of the last second
}

TEST(SlideWatch, windows_are_five_periods)
{
    EXPECT_DOUBLE_EQ(slide_window(10.0), 0.5);
    EXPECT_DOUBLE_EQ(slide_window(5.0), 1.0);
    EXPECT_DOUBLE_EQ(slide_window(2.0), 2.5);
    EXPECT_DOUBLE_EQ(slide_window(0.0), 1.0); // no mode is known
    // The dam is asked for its window once, after the record, and is judged after three of them.
    int asked = 0;
    SlideWatch watch({record_end, normal_force, 0.1}, [&] {
        ++asked;
        return slide_window(2.0);
    });
    SlideInstant now;
    now.normal_force = normal_force;
    now.sliding_factor = 1.1;
    double found = 0.0;
    for (int n = 0; n <= 1200; ++n) {
        now.time = n * step;
        now.slip = now.time;
        now.thrust_work = thrust * now.slip;
        now.friction = 0.5 * now.thrust_work;
        watch.add(now);
        EXPECT_EQ(asked, now.time < record_end + 0.5 * step ? 0 : 1) << now.time;
        if (found == 0.0 && watch.self_excited()) found = now.time;
    }
    EXPECT_NEAR(found, record_end + 3 * 2.5, 1e-9);
}

/// Every pair open for `open` of each tenth of a second after the record [s]; N' a given share of its static value else.
SlideWatch hopping(int lift_offs, double slip_at_rest, double share = 1.0)
{
    SlideWatch watch({record_end, normal_force, 0.1}, [] { return 1.0; });
    SlideInstant now;
    now.sliding_factor = 1.1;
    for (int n = 0; n <= 300; ++n) {
        const int after = n - 200; // steps
        now.time = n * step;
        now.slip = after < 0 ? 1.0 : 1.0 + slip_at_rest * after / 100.0;
        now.open = after > 0 && after <= 10 * lift_offs && after % 10 < 3 && after % 10 > 0;
        now.normal_force = now.open ? 0.0 : share * normal_force;
        watch.add(now);
    }
    return watch;
}

TEST(SlideWatch, hops_their_frequency_and_the_time_without_load_are_counted)
{
    const RunOutFigures figures = hopping(5, 0.5).figures();
    EXPECT_EQ(figures.lift_offs, 5);
    EXPECT_NEAR(figures.lift_off_frequency, 10.0, 1e-9); // every tenth of a second
    EXPECT_NEAR(figures.unloaded_share, 5 * 0.02 / 1.0, 1e-9);
    EXPECT_NEAR(figures.slip_shaking, 1.0, 1e-12);
    EXPECT_NEAR(figures.slip_at_rest, 0.5, 1e-12);
    EXPECT_TRUE(std::isnan(figures.thrust_over_friction)); // nothing was dissipated
    EXPECT_NEAR(hopping(0, 0.5, 0.049).figures().unloaded_share, 1.0, 1e-9);
    EXPECT_EQ(hopping(0, 0.5, 0.051).figures().unloaded_share, 0.0);
    EXPECT_EQ(hopping(1, 0.5).figures().lift_off_frequency, 0.0);
}

TEST(SlideWatch, more_than_three_hops_and_more_than_a_tenth_of_the_slip_are_a_walk)
{
    EXPECT_TRUE(hopping(4, 0.12).figures().ratchets()); // 0.12 of 1.12
    EXPECT_FALSE(hopping(3, 0.12).figures().ratchets());
    EXPECT_FALSE(hopping(4, 0.11).figures().ratchets()); // 0.11 of 1.11: 9.9 %
}

TEST(SlideWatch, rows_of_the_history_are_of_the_second_before_them)
{
    SlideWatch watch({record_end, normal_force, 0.1}, [] { return 1.0; });
    SlideHistory history;
    SlideInstant now;
    now.normal_force = normal_force;
    for (int n = 0; n <= 200; ++n) {
        now.time = n * step;
        now.slip = n <= 100 ? 0.0 : 0.3 * (now.time - 1.0);
        now.thrust_work = thrust * now.slip;
        now.friction = 0.8 * now.thrust_work;
        now.open = n == 150;
        watch.add(now);
        watch.add_row(history);
    }
    ASSERT_EQ(history.rate.size(), 201u);
    EXPECT_TRUE(std::isnan(history.thrust_over_friction[100]));
    EXPECT_NEAR(history.thrust_over_friction[200], 1.25, 1e-12);
    EXPECT_NEAR(history.rate[150], 0.15, 1e-9); // half of the second
    EXPECT_NEAR(history.rate[200], 0.30, 1e-9);
    EXPECT_EQ(history.lift_offs[149], 0.0);
    EXPECT_EQ(history.lift_offs[150], 1.0);
    EXPECT_EQ(history.lift_offs[200], 1.0);
}

// ---- dams

/// The reference dam on a base that gives no way, elements of 8 m: it walks once it is shaken hard.
Scene walking_dam(double friction = 0.70)
{
    Scene scene = sliding_dam(friction, 1.0, 5.0);
    scene.foundation.reset();
    scene.curtain.reset();
    scene.mesh.size = 8.0;
    scene.time.substeps = 1;
    return scene;
}

GroundMotion shaking()
{
    return sines(2.0, 5.0);
}

TEST(SelfExcited, a_dam_on_a_rigid_base_that_walks_by_itself_is_named_and_its_run_out_cut)
{
    const Scene scene = walking_dam();
    const EarthquakeRun model(scene, options_of(scene));
    const RunResult run = model.run(shaking());
    ASSERT_EQ(run.status, Status::self_excited) << text_of(run.notes);
    EXPECT_LT(run.end_time, 5.0 + 6.0 * model.window()); // of 60 s
    const RunOutFigures& f = run.run_out;
    EXPECT_GT(f.sliding_factor, 1.0);
    EXPECT_NEAR(f.sliding_factor, run.stages.back().sliding_factor, 1e-9 * f.sliding_factor);
    EXPECT_GE(f.thrust_over_friction, 1.0);
    EXPECT_GT(f.slip_at_rest, 0.0);
    EXPECT_NEAR(f.slip_shaking + f.slip_at_rest, run.slip, 1e-12);
    EXPECT_LT(run.energy_error, 1e-9);
    EXPECT_NE(text_of(run.notes).find("slid at least"), std::string::npos) << text_of(run.notes);
    EXPECT_NE(text_of(run.notes).find("give [foundation] so that the rock radiates"), std::string::npos) << text_of(run.notes);
    EXPECT_FALSE(reported(run.status, run.slip).has_value());
    EXPECT_EQ(judge(run.status, run.slip, 0.0, 1e-3), damslip::Verdict::none);
    ASSERT_EQ(run.history.slide.rate.size(), run.history.time.size());

    // What the thrust does on the slip is what the static loads do: over the run-out the ledger's work of all loads differs by
    // what deforms and lifts the dam alone, 1 % of it.
    const auto row = static_cast<std::size_t>(std::lround(5.0 / 0.01));
    const double external = run.history.energy.back().external - run.history.energy[row].external;
    const double work = run.stages.back().resultant.shear_force * (run.history.slip.back() - run.history.slip[row]);
    EXPECT_NEAR(work, external, 0.01 * work);
}

TEST(SelfExcited, the_same_dam_is_named_by_the_reduced_run)
{
    const Scene scene = walking_dam();
    const RunOptions options = options_of(scene);
    const EarthquakeRun full(scene, options);
    const RunResult run = ReducedRun(full, scene, options).run(shaking());
    ASSERT_EQ(run.status, Status::self_excited) << text_of(run.notes);
    EXPECT_GE(run.run_out.thrust_over_friction, 1.0);
    EXPECT_TRUE(std::isnan(run.run_out.energy_kept)); // no ledger
    EXPECT_TRUE(std::isnan(run.truncation_error));
    // Its own account of the friction's work agrees with the ledger of the full run, over the run-out of a dam that dies (a walk
    // is another one with every change of the modes): the thrust's work is exact in both, 5 % are the modes left out.
    Scene dying = walking_dam(0.90);
    dying.sliding.run_out_max = 0.0;
    const EarthquakeRun full_dying(dying, options);
    const RunResult few = ReducedRun(full_dying, dying, options, 100).run(shaking());
    const RunResult whole = full_dying.run(shaking());
    const std::size_t row = whole.history.time.size() - 101; // the last second
    const double work =
        whole.stages.back().resultant.shear_force * (whole.history.slip.back() - whole.history.slip[row]);
    const double friction = whole.history.energy.back().friction - whole.history.energy[row].friction;
    EXPECT_NEAR(whole.history.slide.thrust_over_friction.back(), work / friction, 1e-9 * work / friction);
    EXPECT_NEAR(few.history.slide.thrust_over_friction.back(), work / friction, 0.05 * work / friction);
}

TEST(SelfExcited, the_same_dam_is_named_by_explicit_steps)
{
    Scene scene = walking_dam();
    scene.time.scheme = TimeScheme::central_difference;
    const RunResult run = EarthquakeRun(scene, options_of(scene)).run(shaking());
    EXPECT_EQ(run.status, Status::self_excited) << text_of(run.notes);
    EXPECT_GE(run.run_out.thrust_over_friction, 1.0);
    EXPECT_EQ(run.history.slide.rate.size(), run.history.time.size());
}

TEST(SelfExcited, chosen_steps_stop_as_soon_as_two_agree)
{
    Scene scene = walking_dam();
    scene.time.substeps.reset();
    const EarthquakeRun model(scene, options_of(scene));
    const RunResult run = model.run(shaking());
    EXPECT_EQ(run.status, Status::self_excited) << text_of(run.notes);
    EXPECT_LE(run.halvings, 2); // a slip that nothing has is not refined further
}

TEST(SelfExcited, more_friction_lets_the_dam_die_slowly_and_it_rests)
{
    const Scene scene = walking_dam(0.90);
    const RunResult run = EarthquakeRun(scene, options_of(scene)).run(shaking());
    EXPECT_EQ(run.status, Status::at_rest) << text_of(run.notes);
    EXPECT_GT(run.slip, 1e-3);
}

// The strength that counts is the one left: with a residual friction below |T|/N' the dam has lost its stand and slides by its
// loads, at a rate that grows.
TEST(SelfExcited, a_dam_whose_residual_strength_does_not_hold_slides_to_the_end)
{
    Scene scene = walking_dam(0.80);
    scene.contact.residual_friction = 0.60;
    scene.contact.residual_slip = 1e-3;
    scene.sliding.run_out_max = 4.0;
    const RunResult run = EarthquakeRun(scene, options_of(scene)).run(shaking());
    EXPECT_EQ(run.status, Status::sliding_at_end) << text_of(run.notes);
    EXPECT_GT(run.stages.back().sliding_factor, 1.0);
    EXPECT_LT(run.run_out.sliding_factor, 1.0);
    EXPECT_EQ(run.after.status, StageStatus::slides);
}

TEST(SelfExcited, a_run_out_too_short_to_tell_stays_sliding_at_end)
{
    Scene scene = walking_dam();
    scene.sliding.run_out_max = 2.0;
    const RunResult run = EarthquakeRun(scene, options_of(scene)).run(shaking());
    EXPECT_EQ(run.status, Status::sliding_at_end) << text_of(run.notes);
    EXPECT_NE(text_of(run.notes).find("lengthen sliding.run_out_max_s"), std::string::npos) << text_of(run.notes);
}

// ---- what the program says

/// The walking dam with its shaking, as files.
std::string walking_scene(const std::string& name)
{
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("walk_" + name);
    std::filesystem::create_directories(folder);
    const GroundMotion motion = shaking();
    for (const auto& [file, accel] : {std::pair{"h.csv", &motion.accel_h}, std::pair{"v.csv", &motion.accel_v}}) {
        std::ofstream out(folder / file);
        out.precision(17);
        out << "time_s,accel_m_s2\n";
        for (std::size_t i = 0; i < accel->size(); ++i)
            out << static_cast<double>(i) * motion.dt << "," << (*accel)[i] << "\n";
    }
    Scene scene = walking_dam();
    scene.motion.polarity = 1;
    scene.criteria.allowable_slip = 1.0;
    scene.motion.records = {RecordFiles{}};
    RecordFiles& files = scene.motion.records.front();
    files.name = "sines";
    files.horizontal = folder / "h.csv";
    files.vertical = folder / "v.csv";
    const std::filesystem::path file = folder / "dam.toml";
    std::ofstream(file) << resolved_toml(scene);
    return file.string();
}

TEST(SelfExcited, fe_prints_no_slip_but_how_far_it_walked_why_and_what_to_run)
{
    const std::string scene = walking_scene("fe");
    const ProgramAnswer answer = answer_of({"fe", scene, "--no-mesh-error", "--json"});
    EXPECT_EQ(answer.code, exit_no_answer) << answer.talk;
    const auto j = nlohmann::json::parse(answer.out, nullptr, false);
    ASSERT_FALSE(j.is_discarded()) << answer.out << answer.talk;
    const auto& run = j["runs"][0];
    EXPECT_EQ(run["status"], "self-excited");
    EXPECT_TRUE(run["slip_mm"].is_null());
    EXPECT_TRUE(run["max_slip_m"].is_null());
    EXPECT_GT(run["walked_at_least_m"].get<double>(), 0.0);
    EXPECT_EQ(run["verdict"], "–");
    EXPECT_EQ(j["verdict"], "–");
    EXPECT_EQ(j["worst"]["walked_at_least_m"], run["walked_at_least_m"]);
    EXPECT_GE(j["run_out"][0]["thrust_over_friction"].get<double>(), 1.0);
    EXPECT_NE(j["headline"].get<std::string>().find("slid at least"), std::string::npos) << j["headline"];
    EXPECT_NE(j["headline"].get<std::string>().find("damslip fe " + scene), std::string::npos) << j["headline"];
    const std::string rigid_base = "rigid base: no radiation damping; an elastic dam may slide on it without end";
    EXPECT_EQ(j["messages"][0], rigid_base);
    EXPECT_NE(answer.talk.find(rigid_base), std::string::npos) << answer.talk;

    const ProgramAnswer text = answer_of({"fe", scene, "--no-mesh-error"});
    EXPECT_TRUE(text.out.starts_with(rigid_base)) << text.out;
    EXPECT_NE(text.out.find("at least "), std::string::npos) << text.out;
    EXPECT_EQ(answer_of({"fe", scene, "--base", "tied", "--json"}).talk.find(rigid_base), std::string::npos);
}

TEST(SelfExcited, a_sweep_counts_it_by_name_and_resumes_with_it)
{
    const std::string scene = walking_scene("sweep");
    const std::filesystem::path folder = std::filesystem::path(scene).parent_path();
    const auto rows_of = [](const std::string& json) { return nlohmann::json::parse(json, nullptr, false)["rows"]; };
    for (const char* file : {"rows.csv", "rows.sqlite"}) std::filesystem::remove(folder / file);
    std::vector<std::string> command{"sweep",
                                     scene,
                                     "--method",
                                     "fe",
                                     "--friction",
                                     "0.70,1.2",
                                     "--polarity",
                                     "1",
                                     "--json",
                                     "--out",
                                     (folder / "rows.csv").string()};
    const ProgramAnswer answer = answer_of(command);
    EXPECT_EQ(answer.code, exit_no_answer) << answer.talk;
    EXPECT_NE(answer.talk.find("1 self-excited"), std::string::npos) << answer.talk;
    const auto rows = rows_of(answer.out);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0]["status"], "self-excited");
    EXPECT_TRUE(rows[0]["slip_m"].is_null());
    EXPECT_GT(rows[0]["walked_at_least_m"].get<double>(), 0.0);
    EXPECT_GE(rows[0]["thrust_over_friction"].get<double>(), 1.0);
    EXPECT_EQ(rows[1]["status"], "at rest");
    EXPECT_TRUE(rows[1]["walked_at_least_m"].is_null());
    EXPECT_NEAR(rows[1]["shaking_slip_m"].get<double>() + rows[1]["run_out_slip_m"].get<double>(),
                rows[1]["slip_m"].get<double>(), 1e-12);
    std::filesystem::remove(folder / "rows.csv");
    command.push_back("--resume");
    const ProgramAnswer again = answer_of(command);
    EXPECT_EQ(again.code, exit_no_answer);
    EXPECT_EQ(rows_of(again.out), rows); // the database keeps every column
}

} // namespace
