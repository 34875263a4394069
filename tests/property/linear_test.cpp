// Below the limit everything is linear: the tied dam in its record and in its loads, and the dam that neither slips nor
// opens is the tied one.
#include "drawn_scene.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/rock/radiating_rock.hpp"
#include "fe2d/rock/reduced_rock.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "fe2d/time/integrate.hpp"
#include "scene/rock_mass.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::property;

/// Crest history of the tied dam without static loads.
std::vector<double> tied_crest(const Scene& scene, const GroundMotion& motion)
{
    fe2d::ModelOptions options;
    options.added_mass = fe2d::test::options_of(scene).added_mass;
    const fe2d::Model model = fe2d::build_model(scene, options);
    fe2d::TiedRunOptions run;
    run.scheme = fe2d::scheme_of(scene.time);
    run.damping = fe2d::damping_of(scene, model, motion);
    std::optional<fe2d::RadiatingRock> rock;
    if (rock_radiates(scene)) {
        rock = fe2d::radiating_rock_of(scene, model.mesh, model.mesh.contact.rock_nodes, 25.0, {});
        run.moving_base = [&rock](const fe2d::StepConstants& constants, double stiffness_damping) {
            return fe2d::rock_base(rock->rock, constants, stiffness_damping);
        };
    }
    std::vector<double> crest;
    for (const fe2d::HistoryRow& row : fe2d::integrate(model, motion, run).rows) crest.push_back(row.crest_x);
    return crest;
}

double largest(const std::vector<double>& values)
{
    double size = 0.0;
    for (const double v : values) size = std::max(size, std::abs(v));
    return size;
}

// Times two is exact in every operation; the sum of two motions is rounded.
TEST(Linear, TheTiedResponseIsLinearInTheRecord)
{
    for (std::uint32_t seed = 401; seed <= 405; ++seed) {
        SCOPED_TRACE(seed);
        const Drawn d = draw(seed, rock_of(seed, 405));
        const Drawn other = draw(seed + 50, Rock::rigid);
        GroundMotion sum = d.motion;
        for (std::size_t k = 0; k < sum.accel_h.size(); ++k) {
            sum.accel_h[k] += other.motion.accel_h[k];
            sum.accel_v[k] += other.motion.accel_v[k];
        }
        const std::vector<double> a = tied_crest(d.scene, d.motion), twice = tied_crest(d.scene, times(d.motion, 2.0)),
                                  b = tied_crest(d.scene, other.motion), both = tied_crest(d.scene, sum);
        ASSERT_EQ(a.size(), d.motion.accel_h.size());
        const double peak = largest(both);
        ASSERT_GT(peak, 0.0);
        for (std::size_t k = 0; k < a.size(); ++k) {
            ASSERT_EQ(twice[k], 2.0 * a[k]) << k;
            ASSERT_NEAR(both[k], a[k] + b[k], 1e-12 * peak) << k;
        }
    }
}

// Shaken so little that no pair leaves its state (friction 10, and glued), the dam on its contact plane is the tied dam. The
// contact run carries the static displacement along: 1e-16 of it is the round-off, a share of 1e-10 of this motion.
TEST(Linear, ContactBelowTheLimitIsTheTiedDam)
{
    for (std::uint32_t seed = 411; seed <= 416; ++seed) {
        SCOPED_TRACE(seed);
        Drawn d = draw(seed, rock_of(seed, 415));
        d.scene.contact.friction = 10.0;
        d.scene.contact.cohesion = 1e9;
        const GroundMotion weak = times(d.motion, 1e-3);
        const fe2d::RunResult run = fe2d::EarthquakeRun(d.scene, fe2d::test::options_of(d.scene)).run(weak);
        ASSERT_EQ(*std::max_element(run.history.open_length.begin(), run.history.open_length.end()), 0.0);
        EXPECT_EQ(run.max_slip, 0.0);
        const std::vector<double> tied = tied_crest(d.scene, weak);
        const double peak = largest(tied);
        for (std::size_t k = 0; k < tied.size(); ++k) ASSERT_NEAR(run.history.crest_x[k], tied[k], 1e-8 * peak) << k;
    }
}

TEST(Linear, StaticLoadsSuperpose)
{
    for (std::uint32_t seed = 421; seed <= 424; ++seed) {
        SCOPED_TRACE(seed);
        Drawn d = draw(seed, seed % 2 ? Rock::rigid : Rock::flexible);
        const double base = d.scene.section.polygon[1].x;
        const std::vector<PointForce> forces{{"one", {0.5 * base, 0.2 * base}, 3e5, -1e5},
                                             {"two", {0.4 * base, 0.3 * base}, -2e5, 4e5}};
        const auto displacement = [&](std::vector<PointForce> acting) {
            d.scene.forces = std::move(acting);
            const fe2d::Model model = fe2d::build_model(d.scene, {});
            return fe2d::solve_static(d.scene, model, fe2d::static_loads(d.scene, model)).stages.back().displacement;
        };
        const Eigen::VectorXd none = displacement({}), one = displacement({forces[0]}), two = displacement({forces[1]}),
                              both = displacement(forces);
        EXPECT_GT((one - none).norm(), 1e-6 * none.norm());
        EXPECT_LT((one + two - none - both).norm(), 1e-11 * none.norm());
    }
}

} // namespace
