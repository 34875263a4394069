// Soft exponential normal contact in statics and in the earthquake run.
#include "verification/cases/fe_run_scenes.hpp"

#include "fe2d/contact/joint_law.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using Eigen::Index;
using Eigen::VectorXd;
using fe2d::test::options_of;
using fe2d::test::sines;
using fe2d::test::sliding_dam;

Contact soft(double range = 1e-3)
{
    Contact law;
    law.normal = NormalContact::exponential;
    law.clearance_at_zero_pressure = range;
    return law;
}

// 8 m x 4 m on a rigid plane: p = rho g H everywhere (nu = 0), so one clearance everywhere, p(g) = rho g H. The forces
// are exact to 1e-11 of the largest, the law's slope makes of it 1e-11 c0.
TEST(FeExponentialRun, a_block_rests_at_one_clearance)
{
    Scene scene = exact::bare_scene({{0, 0}, {8, 0}, {8, 4}, {0, 4}}, 2400.0);
    scene.dam.young_modulus = 30e9;
    scene.dam.poisson_ratio = 0.0;
    scene.contact.friction = 0.5;
    scene.mesh.size = 1.5;
    scene.mesh.contact_size = 1.0;
    scene.damping.method = DampingMethod::none;
    const EarthquakeRun run(scene, {});
    StaticContact statics(run.structure(), soft());
    const Plane& plane = run.structure().plane();
    Strength strength(scene.contact, plane);
    ContactMemory memory(plane.pairs());
    const auto stages = run.statics(statics, strength, memory);
    ASSERT_EQ(stages.back().status, StageStatus::ok) << text_of(stages.back().notes());
    const double clearance = ExponentialPressure(1e6, 1e-3).clearance(2400.0 * 9.81 * 4.0);
    EXPECT_NEAR(memory.opening.minCoeff(), clearance, 1e-10 * 1e-3);
    EXPECT_NEAR(memory.opening.maxCoeff(), clearance, 1e-10 * 1e-3);
    EXPECT_LT(memory.force.tail(plane.pairs()).cwiseAbs().maxCoeff(), 1e-9 * memory.force.maxCoeff());
}

/// A coarse dam on rock under all its static loads.
struct Dam {
    Scene scene = sliding_dam(0.70, 1.0, 6.0);
    std::unique_ptr<Model> model;
    std::unique_ptr<ContactStructure> structure;
    SplitLoad load;
    BaseResultant resultant;

    Dam()
    {
        scene.mesh.size = 9.0;
        scene.foundation->width = 150.0;
        scene.foundation->depth = 60.0;
        const RunOptions options = options_of(scene);
        ModelOptions model_options;
        model_options.base = Base::separate;
        model_options.added_mass = options.added_mass;
        model = std::make_unique<Model>(build_model(scene, model_options));
        structure = std::make_unique<ContactStructure>(*model);
        load = structure->split(load_stages(scene, *model, options.uplift).last());
        resultant = base_resultant(*structure, load.dam);
    }
    Index pairs() const { return structure->plane().pairs(); }
};

// The law moves pressure about, not resultants: friction holds down to mu = T/N', and below it nothing is found.
TEST(FeExponentialRun, friction_that_holds_is_that_of_the_resultants)
{
    const Dam dam;
    const double needed = dam.resultant.shear_force / dam.resultant.normal_force;
    for (const double range : {1e-2, 1e-3, 1e-5}) {
        StaticContact statics(*dam.structure, soft(range));
        ContactMemory holds(dam.pairs()), slides(dam.pairs());
        const ContactReport above = statics.solve(dam.load, uniform_law(dam.pairs(), needed * (1.0 + 1e-5)), holds);
        EXPECT_TRUE(above.resolved()) << range;
        EXPECT_LT(above.residual, 1e-11) << range;
        const double normal = holds.force.head(dam.pairs()).sum(), shear = -holds.force.tail(dam.pairs()).sum();
        EXPECT_NEAR(normal, dam.resultant.normal_force, 1e-9 * normal);
        EXPECT_NEAR(shear, dam.resultant.shear_force, 1e-9 * normal);
        EXPECT_GE(holds.force.head(dam.pairs()).minCoeff(), 0.0);
        const ContactReport below = statics.solve(dam.load, uniform_law(dam.pairs(), needed * (1.0 - 1e-5)), slides);
        EXPECT_FALSE(below.resolved()) << range;
    }
}

struct Shaken {
    double normal_work, stored_change, imbalance;
    DynamicCounts counts;
};

Shaken shake(const Dam& dam, double dt, double pga)
{
    StaticContact statics(*dam.structure, soft());
    const ContactLaw law = uniform_law(dam.pairs(), dam.scene.contact.friction);
    ContactMemory memory(dam.pairs());
    EXPECT_TRUE(statics.solve(dam.load, law, memory).resolved());
    DynamicContact run(*dam.structure, {{1.9, 0.0006}, dam.scene.damping.mass}, scheme_of(dam.scene.time), dam.load,
                       statics.displacements(dam.load, memory), memory, soft());
    const GroundMotion motion = sines(pga, 6.0, 5, 0.01);
    const auto at = [&](const std::vector<double>& a, double t) {
        const auto i = std::min(static_cast<std::size_t>(t / motion.dt + 1e-9), a.size() - 2);
        return a[i] + (t / motion.dt - static_cast<double>(i)) * (a[i + 1] - a[i]);
    };
    const int steps = static_cast<int>(std::lround(6.0 / dt));
    double largest = 0.0;
    const VectorXd& area = dam.structure->plane().area;
    const double start = stored_energy(soft(), area, memory.opening);
    for (int k = 1; k <= steps; ++k) {
        run.advance(dt, {at(motion.accel_h, k * dt), at(motion.accel_v, k * dt)}, law);
        largest = std::max(largest, std::abs(stored_energy(soft(), area, run.state().contact.opening) - start));
    }
    return {run.energy().contact_normal, largest, run.energy_imbalance() / run.energy_scale(), run.counts()};
}

// The law is conservative: what its forces have done over the openings, taken by the trapezoid, is what it has stored,
// up to the trapezoid's error -p''Δg³/12 a step: second order in the step. Energy closes to round-off either way.
TEST(FeExponentialRun, work_of_the_pressure_is_stored_energy_to_second_order)
{
    const Dam dam;
    const Shaken coarse = shake(dam, 0.0025, 0.5), fine = shake(dam, 0.00125, 0.5);
    std::printf("contact work beyond the stored energy %.4e, %.4e J/m; largest change of stored energy %.4e J/m\n",
                coarse.normal_work, fine.normal_work, fine.stored_change);
    for (const Shaken& s : {coarse, fine}) {
        EXPECT_LT(std::abs(s.imbalance), 1e-10);
        EXPECT_EQ(s.counts.unresolved, 0);
        EXPECT_LT(s.counts.largest_residual, 1e-8);
        EXPECT_LT(std::abs(s.normal_work), 1e-2 * s.stored_change);
    }
    EXPECT_GT(coarse.normal_work / fine.normal_work, 3.0);
    EXPECT_LT(coarse.normal_work / fine.normal_work, 5.0);
}

// c0 -> 0 is hard contact, of first order once the bed is stiffer than the dam: a tenth of c0, a tenth of the error, 0.2
// for the second order. At 1 mm the dam rocks on the bed at twice its first frequency only, and the slip may go either
// way. The step is held, so the runs solve problems that differ by the law alone.
TEST(FeExponentialRun, slip_tends_to_that_of_hard_contact)
{
    Scene scene = sliding_dam(0.70, 1.0, 5.0);
    scene.time.substeps = 2;
    const GroundMotion motion = sines(1.5, 6.0);
    const auto slip = [&](const Scene& s) {
        const RunResult r = EarthquakeRun(s, options_of(s)).run(motion);
        EXPECT_EQ(r.status, Status::at_rest) << text_of(r.notes);
        EXPECT_EQ(r.counts.unresolved, 0);
        EXPECT_LT(r.energy_error, 1e-10);
        return r.slip;
    };
    const double hard = slip(scene);
    double last = HUGE_VAL;
    for (const double range : {1e-3, 1e-4, 1e-5, 1e-6}) {
        scene.contact.normal = NormalContact::exponential;
        scene.contact.clearance_at_zero_pressure = range;
        const double error = slip(scene) - hard;
        std::printf("c0 = %g m: slip %.6f mm, error %.2e mm, hard %.6f mm\n", range, 1e3 * (hard + error), 1e3 * error,
                    1e3 * hard);
        if (range < 0.5e-5) {
            EXPECT_LT(std::abs(error), 0.2 * last);
        }
        last = std::abs(error);
    }
    EXPECT_LT(last, 1e-3 * hard);
}

} // namespace
