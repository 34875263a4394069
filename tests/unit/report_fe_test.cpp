// The report of FE contact runs: its charts say what the runs say.
#include "analysis/prepare/ready.hpp"
#include "core/units.hpp"
#include "pages/fe/fe_pages.hpp"
#include "pages/report/page.hpp"
#include "scene/read.hpp"
#include "source_dir.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace {

using namespace damslip;
using namespace damslip;
using namespace damslip::pages;

/// The runs of the browser test's scene with their page, made once for all tests.
struct FeReportRun {
    Scene scene;
    std::vector<RecordPair> records;
    std::vector<ContactRun> runs;
    pages::Page page;
};

FeReportRun make_run()
{
    const Scene given = read_scene(std::filesystem::path(source_dir()) / "tests/report/fe_dam.toml");
    const Watch nobody;
    const Ready ready = prepare(given, Method::finite_elements);
    const EffectPlan& plan = ready.plan;
    FeReportRun out{ready.scene, ready.records(), {}, {}};
    fe2d::RunOptions options = ready.run_options(nobody);
    options.pair_series = fe2d::PairSeries::every_step;
    const fe2d::EarthquakeRun model(out.scene, options);
    const RigidModel rigid = ready.rigid_model();
    FeReport report({out.scene, plan, out.records, model, rigid, options.uplift});
    for (const RecordPair& pair : out.records) {
        const GroundMotion motion = ground_motion(out.scene, pair);
        out.runs.push_back(
            {{pair.files.name}, model.run(motion), slide_model(out.scene, rigid, motion, 1), {}, {}});
        report.add(out.runs.back(), motion);
    }
    out.page = report.page(out.runs, {"a message"});
    return out;
}

const FeReportRun& fe_run()
{
    static const FeReportRun run = make_run();
    return run;
}

template <class Part>
std::vector<const Part*> parts_of(const pages::Page& page)
{
    std::vector<const Part*> list;
    for (const pages::Section& section : page.sections)
        for (const pages::Part& part : section.parts)
            if (const auto* p = std::get_if<Part>(&part)) list.push_back(p);
    return list;
}

const pages::Chart* chart_named(const std::string& title)
{
    for (const pages::Chart* chart : parts_of<pages::Chart>(fe_run().page))
        if (chart->title == title) return chart;
    return nullptr;
}

TEST(FeReportPage, EveryChartHasFiniteValuesInEachCurve)
{
    const auto charts = parts_of<pages::Chart>(fe_run().page);
    EXPECT_EQ(charts.size(), 2u * 9u + 1u); // seven histories and two charts of the base for each record, spectra
    for (const pages::Chart* chart : charts)
        for (const pages::Curve& curve : chart->curves)
            EXPECT_TRUE(std::any_of(curve.y.begin(), curve.y.end(), [](double v) { return std::isfinite(v); }))
                << chart->title << ", " << curve.name;
}

TEST(FeReportPage, SlipHistoriesEndAtTheSlipsOfTheTable)
{
    const ContactRun& run = fe_run().runs[0];
    ASSERT_GT(run.fe.slip, 1e-3);
    const pages::Chart* slip = chart_named("pulses <1>: slip");
    ASSERT_NE(slip, nullptr);
    ASSERT_EQ(slip->curves.size(), 5u); // heel, middle, toe, mean, rigid
    EXPECT_EQ(slip->curves[3].y.back(), run.fe.slip / units::mm);
    EXPECT_EQ(slip->curves[4].name, "rigid block");
    EXPECT_NEAR(slip->curves[4].y.back(), run.rigid->slip / units::mm, 1e-9 * run.rigid->slip / units::mm);
}

TEST(FeReportPage, PressureChartsIntegrateToTheForcesOfTheHistory)
{
    const fe2d::RunResult& fe = fe_run().runs[0].fe;
    for (const auto& [what, force] : {std::pair{"effective pressure", &fe.history.normal_force},
                                      {"shear, resisting downstream slip", &fe.history.shear_force}}) {
        const pages::Chart* chart = chart_named(std::string("pulses <1>: ") + what + " along the base");
        ASSERT_NE(chart, nullptr);
        ASSERT_TRUE(chart->moving);
        const pages::Moving& moving = *chart->moving;
        EXPECT_LE(moving.at.size(), 152u);
        EXPECT_EQ(moving.at.front(), fe.history.time.front());
        EXPECT_EQ(moving.at.back(), fe.history.time.back());
        EXPECT_EQ(moving.y[moving.start], chart->curves[moving.curve].y);
        for (std::size_t k = 0; k < moving.at.size(); ++k) {
            const auto row = std::find(fe.history.time.begin(), fe.history.time.end(), moving.at[k]);
            ASSERT_NE(row, fe.history.time.end());
            double sum = 0.0;
            for (std::size_t i = 0; i < moving.y[k].size(); ++i)
                sum += 1e6 * moving.y[k][i] * fe.pair_area[static_cast<Eigen::Index>(i)];
            const double expected = (*force)[static_cast<std::size_t>(row - fe.history.time.begin())];
            // The pairs' values are kept as float: 17 of them, each to 6e-8 of the largest, which the force bounds.
            EXPECT_NEAR(sum, expected, 1e-5 * fe.history.normal_force[0]) << what << " at " << moving.at[k];
        }
    }
}

TEST(FeReportPage, StatesOfTheMapAddUpToTheLengthsOfTheHistory)
{
    const fe2d::RunResult& fe = fe_run().runs[0].fe;
    const pages::StateMap& map = *parts_of<pages::StateMap>(fe_run().page)[0];
    ASSERT_EQ(map.states.size(), fe.history.time.size());
    for (std::size_t row = 0; row < map.states.size(); ++row) {
        double open = 0.0, slips = 0.0;
        for (std::size_t i = 0; i < map.states[row].size(); ++i) {
            const double area = fe.pair_area[static_cast<Eigen::Index>(i)];
            if (map.states[row][i] == 'o') open += area;
            if (map.states[row][i] == 'd' || map.states[row][i] == 'u') slips += area;
        }
        EXPECT_NEAR(open, fe.history.open_length[row], 1e-12);
        EXPECT_NEAR(slips, fe.history.slipping_length[row], 1e-12);
    }
}

// Before the earthquake the vertical stresses just above the base carry weight less uplift: the mean of the dam's base
// nodes' vertical stress, weighted by their lengths, is -(N' + U) / L. Stresses recovered at nodes of a mesh of 1 m on a
// base of 16 m with singular ends: 10 %.
TEST(FeReportPage, StressesAreThoseOfTheStaticState)
{
    const FeReportRun& r = fe_run();
    const pages::MeshView& view = *parts_of<pages::MeshView>(r.page)[0];
    ASSERT_GE(view.states.size(), 4u);
    EXPECT_EQ(view.states[0].name, "before the earthquake");
    EXPECT_EQ(view.states[0].shift_x, 0.0);
    EXPECT_TRUE(std::is_sorted(view.states.begin(), view.states.begin() + 4,
                               [](const auto& a, const auto& b) { return a.time < b.time; }));
    for (const pages::MeshView::State& s : view.states) {
        EXPECT_EQ(s.ux.size(), view.nodes.size());
        ASSERT_EQ(s.values.size(), view.fields.size());
        for (const auto& values : s.values)
            EXPECT_TRUE(std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }));
    }
    const fe2d::RunResult& fe = r.runs[0].fe;
    const double uplift = resultant(sliding::uplift_profile(r.scene, scene_uplift_state(r.scene), {}, {})).force;
    double mean = 0.0;
    for (Eigen::Index i = 0; i < fe.pair_area.size(); ++i)
        for (std::size_t node = 0; node < view.front_nodes; ++node)
            if (view.nodes[node].y == 0.0 && std::abs(view.nodes[node].x - fe.pair_distance[i]) < 1e-9)
                mean += 1e6 * view.states[0].values[2][node] * fe.pair_area[i] / fe.pair_area.sum();
    const double expected = -(fe.history.normal_force[0] + uplift) / fe.pair_area.sum();
    EXPECT_NEAR(mean, expected, 0.1 * std::abs(expected));

    // The last state of the first record has the slip of its end, drawn to scale.
    const auto end =
        std::find_if(view.states.begin(), view.states.end(), [](const auto& s) { return s.name == "pulses <1>: end"; });
    ASSERT_NE(end, view.states.end());
    EXPECT_EQ(end->shift_x, fe.history.slip.back());
}

TEST(FeReportPage, HeadlineJudgesBySlipStatusAndStaticState)
{
    const FeReportRun& r = fe_run();
    Scene scene = r.scene;
    std::vector<ContactRun> runs = r.runs;
    const double slip = runs[0].fe.max_slip;
    runs[0].fe.slip_error = 0.01 * slip;
    runs[1].fe.slip_error = 0.0; // the scene's sub-steps are fixed, which leaves no estimate
    runs[0].fe.after.status = runs[1].fe.after.status = fe2d::StageStatus::ok;
    scene.criteria.allowable_slip = 0.98 * slip;
    EXPECT_EQ(fe_headline(scene, runs).outcome, pages::Outcome::fail);
    scene.criteria.allowable_slip = 1.005 * slip; // within the error
    EXPECT_EQ(fe_headline(scene, runs).outcome, pages::Outcome::unresolved);
    scene.criteria.allowable_slip = 1.02 * slip;
    EXPECT_EQ(fe_headline(scene, runs).outcome, pages::Outcome::pass);
    fe2d::LiftResult neck;
    neck.plane = "lift joint at 51.5 m";
    neck.name = "neck";
    neck.largest_slip = 1.03 * slip;
    neck.slip_error = 0.005 * slip;
    runs[1].fe.lifts = {neck};
    EXPECT_EQ(fe_headline(scene, runs).outcome, pages::Outcome::fail);
    EXPECT_NE(fe_headline(scene, runs).sentence.find("; lift joint neck "), std::string::npos);
    runs[1].fe.lifts[0].name = "lift at 51.5 m"; // of [lifts]
    EXPECT_NE(fe_headline(scene, runs).sentence.find("; lift joint at 51.5 m "), std::string::npos);
    runs[1].fe.lifts[0].plane = runs[1].fe.lifts[0].name = "base"; // of a body on a seam
    EXPECT_NE(fe_headline(scene, runs).sentence.find("; base "), std::string::npos);
    runs[1].fe.lifts.clear();
    scene.criteria.allowable_slip.reset();
    EXPECT_EQ(fe_headline(scene, runs).outcome, pages::Outcome::none);
    runs[1].fe.after.status = fe2d::StageStatus::slides;
    EXPECT_EQ(fe_headline(scene, runs).outcome, pages::Outcome::fail);
    runs[1].fe.status = Status::not_resolved;
    EXPECT_EQ(fe_headline(scene, runs).outcome, pages::Outcome::unresolved);
    runs[1].fe.status = Status::static_failure;
    EXPECT_EQ(fe_headline(scene, runs).outcome, pages::Outcome::fail);
    EXPECT_EQ(fe_headline(scene, {}).outcome, pages::Outcome::none);
}

// A crest that goes 0, 3, 1, -2, 0 mm while the base slips 0, 1, 1, 1, 4 mm (downstream) at 0, 1, ... s: the lean is 0, 2,
// 0, -3, -4 mm, so the farthest downstream is at 1 s, upstream at the end; the base is fastest from 3 to 4 s.
TEST(StoredStates, AreThoseOfTheLargestLeansAndSlipRate)
{
    fe2d::StateKeeper keeper;
    EXPECT_TRUE(keeper.states().empty());
    const std::vector<double> crest{0, 3, 1, -2, 0}, slip{0, 1, 1, 1, 4};
    for (std::size_t i = 0; i < crest.size(); ++i) {
        fe2d::DynamicState state;
        state.time = static_cast<double>(i);
        state.u = Eigen::VectorXd::Constant(2, static_cast<double>(i));
        keeper.look(state, state.time, 1e-3 * slip[i], 1e-3 * crest[i]);
    }
    const auto states = keeper.states();
    ASSERT_EQ(states.size(), 5u);
    const auto time_of = [&](fe2d::Instant instant) {
        return std::find_if(states.begin(), states.end(), [&](const auto& s) { return s.instant == instant; })->time;
    };
    EXPECT_EQ(time_of(fe2d::Instant::start), 0.0);
    EXPECT_EQ(time_of(fe2d::Instant::leans_downstream), 1.0);
    EXPECT_EQ(time_of(fe2d::Instant::leans_upstream), 4.0);
    EXPECT_EQ(time_of(fe2d::Instant::slides_fastest), 4.0);
    EXPECT_EQ(time_of(fe2d::Instant::end), 4.0);
    for (const auto& s : states) EXPECT_EQ(s.dam[0], s.time);
}

// The damage that the run left, the base's pairs alone, and the length that is broken by their areas.
TEST(FeReportPage, BondOfTheBaseIsDrawnAsTheRunLeftIt)
{
    ContactRun run = fe_run().runs.front();
    const RunView view{run, nullptr, {}, "record1"};
    Scene bonded = fe_run().scene;
    EXPECT_FALSE(bond_chart(view, bonded)) << "no bond";
    bonded.contact.cohesion = 1e6;
    bonded.contact.bond.shear_energy = 1500.0;
    EXPECT_FALSE(bond_chart(view, bonded)) << "no bond in the run";
    const auto pairs = static_cast<std::size_t>(run.fe.pair_distance.size());
    ASSERT_GE(pairs, 3u);
    std::vector<double> damage(pairs + 2, 0.25); // two pairs more, of a lift joint
    damage[0] = damage[1] = 1.0;
    run.fe.state.laws["bond_damage"] = damage;
    const std::optional<Chart> chart = bond_chart(view, bonded);
    ASSERT_TRUE(chart);
    ASSERT_EQ(chart->curves.size(), 1u);
    damage.resize(pairs);
    EXPECT_EQ(chart->curves.front().y, damage);
    EXPECT_EQ(chart->curves.front().x.back(), run.fe.pair_distance[run.fe.pair_distance.size() - 1]);
    const std::string length =
        fmt::format("{:.3g} m of {:.3g} m", run.fe.pair_area.head(2).sum(), run.fe.pair_area.sum());
    EXPECT_NE(chart->note.find(length), std::string::npos) << chart->note;
}

// A lift joint's elements are those of the dam: a bond too strong for them is lowered, and that is said with the length to use.
TEST(FeReportPage, BondsThatElementsCannotCarryAreSaid)
{
    const auto messages_with = [](double energy_N_m) {
        const Scene scene =
            parse_scene("[section]\npolygon_m = [[0, 0], [8, 0], [8, 4], [0, 4]]\n[dam]\ndensity_kg_m3 = "
                        "2500\nyoung_modulus_GPa = 25\n"
                        "poisson_ratio = 0\n[contact]\nfriction = 0.7\n[mesh]\nsize_m = 1\ncontact_size_m = "
                        "1\n[[lift_joint]]\nname = "
                        "\"lift\"\nelevation_m = 2\nfriction = 0.8\ncohesion_kPa = 2000\nfracture_energy_shear_N_m = " +
                            fmt::format("{}\n", energy_N_m),
                        "block.toml");
        const fe2d::EarthquakeRun model(scene, {});
        return bond_messages(scene, model.model().mesh);
    };
    // E G/(4 c²): 25e9 * 100/(4 * 4e12) = 0.156 m is meshed. 10 J/m² make it 0.0156 m, shorter than 8 m/240: of the columns, doubled
    // from 8 on, 256 are there, 0.03125 m each, which carry sqrt(25e9 * 10/(4 * 0.03125)) = 1414 kPa.
    EXPECT_TRUE(messages_with(100.0).empty());
    const std::vector<std::string> said = messages_with(10.0);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("lift: elements of 0.0312"), std::string::npos) << said[0];
    EXPECT_NE(said[0].find("cohesion 1414"), std::string::npos) << said[0];
    EXPECT_NE(said[0].find("at most 0.0156 m"), std::string::npos) << said[0];
}

TEST(FeReportPage, SameBytesEachTime)
{
    EXPECT_EQ(pages::page_html(fe_run().page), pages::page_html(make_run().page));
}

} // namespace
