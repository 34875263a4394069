// Water in the rock (stages.pore_pressure) under a dam that may slide.
#include "analysis/prepare/ready.hpp"
#include "fe2d/model/model.hpp"
#include "pages/fe/fe_pages.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <gtest/gtest.h>

namespace damslip::fe2d {
namespace {

/// Low water and high friction: every pair sticks and none opens.
Scene sticking_dam(PorePressure form)
{
    Scene scene = test::sliding_dam(3.0);
    scene.reservoir->level = 20.0;
    scene.uplift.emplace().model = UpliftModel::seepage;
    scene.stages.pore_pressure = form;
    return scene;
}

RunResult at_rest(Scene scene, Eigen::Vector2d& crest)
{
    scene.time.substeps = 0;
    const Watch nobody;
    const RunOptions options = prepare(scene, Method::finite_elements, nullptr).run_options(nobody);
    const EarthquakeRun run(scene, options);
    GroundMotion silence;
    silence.dt = 0.01;
    silence.accel_h.assign(11, 0.0);
    RunResult result = run.run(silence);
    crest = pages::crest_displacement(run.model(), result.displacement);
    return result;
}

Eigen::Vector2d tied_crest(const Scene& scene)
{
    const Model model = build_model(scene);
    StaticLoads loads = static_loads(scene, model);
    loads.impounding.push_back({"water in the rock", rock_water_load(scene, model), Eigen::Vector2d::Zero()});
    return pages::crest_displacement(model, solve_static(scene, model, loads).stages.back().displacement);
}

// A dam that sticks everywhere stands where the tied dam stands, with the water in the rock in either form: 1e-6 of what
// the water in the rock moves it by, which is the difference of the uplift's line of points to the nodal pressures.
TEST(FePoreRun, ADamThatSticksStandsWhereTheTiedDamDoes)
{
    Eigen::Vector2d dry, crest;
    at_rest(sticking_dam(PorePressure::none), dry);
    for (const PorePressure form : {PorePressure::total, PorePressure::effective}) {
        const Scene scene = sticking_dam(form);
        const RunResult result = at_rest(scene, crest);
        ASSERT_EQ(result.status, Status::at_rest) << text_of(result.notes);
        EXPECT_LT(result.pair_slip.cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_EQ(result.stages.back().open_length, 0.0);
        const double moved = (crest - dry).norm();
        EXPECT_GT(moved, 1e-5);
        EXPECT_LT((crest - tied_crest(scene)).norm(), 1e-6 * moved);
    }
}

// Sides of the joint that do not match: the pressures are read where the rock's nodes are.
TEST(FePoreRun, SidesThatDoNotMatch)
{
    Eigen::Vector2d matching, other;
    Scene scene = sticking_dam(PorePressure::total);
    at_rest(scene, matching);
    scene.mesh.rock_contact_size = 1.7;
    ASSERT_EQ(at_rest(scene, other).status, Status::at_rest);
    EXPECT_LT((other - matching).norm(), 0.05 * matching.norm()); // finer rock below a coarse base
}

// The water in the rock does not change what the base carries.
TEST(FePoreRun, ResultantsStay)
{
    Scene scene = sticking_dam(PorePressure::none);
    scene.reservoir->level = 62.5;
    Eigen::Vector2d crest;
    const RunResult none = at_rest(scene, crest);
    scene.stages.pore_pressure = PorePressure::total;
    const RunResult total = at_rest(scene, crest);
    EXPECT_NEAR(total.stages.back().critical_friction, none.stages.back().critical_friction, 1e-12);
    EXPECT_NE(total.pair_pressure[3], none.pair_pressure[3]);
}

} // namespace
} // namespace damslip::fe2d
