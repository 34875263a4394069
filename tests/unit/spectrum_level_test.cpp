#include "analysis/spectrum/spectrum_level.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "records/measure/measures.hpp"
#include "scene/read.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace damslip {
namespace {

Scene dam_scene(const std::string& rest)
{
    return parse_scene(R"(
title = "triangle"
[section]
height_m = 40
base_m = 32
crest_m = 4
[dam]
density_kg_m3 = 2400
young_modulus_GPa = 25
poisson_ratio = 0.2
[contact]
friction = 1.0
)" + rest,
                       "test.toml");
}

const std::string rock = R"(
[foundation]
young_modulus_GPa = 30
poisson_ratio = 0.25
width_m = 160
depth_m = 60
)";

Ready ready_of(const std::string& rest)
{
    return prepare(dam_scene(rest), Method::finite_elements, std::make_shared<const std::vector<RecordPair>>());
}

LevelSpectrum flat_spectrum(double acceleration)
{
    return {"flat", 0.05, [acceleration](double) { return acceleration; }};
}

TEST(ModalCombination, CorrelationIsDerKiureghians)
{
    EXPECT_EQ(fe2d::modal_correlation(3.0, 3.0, 0.05), 1.0);
    // Der Kiureghian (1981), eq. (24) by hand at zeta = 0.05, r = 0.9:
    // 8 (0.0025)(1.9)(0.9^1.5) / [(0.19)^2 + 0.01 (0.9)(1.9)^2] = 0.0324454 / 0.06859 = 0.473034
    EXPECT_NEAR(fe2d::modal_correlation(1.0, 0.9, 0.05), 0.473034, 1e-5);
    EXPECT_NEAR(fe2d::modal_correlation(1.0, 0.9, 0.05), fe2d::modal_correlation(0.9, 1.0, 0.05), 1e-14); // symmetric
    EXPECT_LT(fe2d::modal_correlation(1.0, 10.0, 0.05), 1e-2);
}

TEST(ModalCombination, FarModesAreSrssAndEqualModesAddUp)
{
    const Eigen::Vector2d peaks(3.0, 4.0);
    const Eigen::Vector2d far(1.0, 1000.0), equal(2.0, 2.0);
    // rho of r = 1000 is 8 zeta^2 r^-1.5 = 6e-7: a share of 2 rho 12/25 / 2 of the peak
    EXPECT_NEAR(fe2d::combined_peak(peaks, fe2d::modal_correlations(far, 0.05, fe2d::ModalRule::cqc)), 5.0, 1e-5);
    EXPECT_EQ(fe2d::combined_peak(peaks, fe2d::modal_correlations(far, 0.05, fe2d::ModalRule::srss)), 5.0);
    EXPECT_NEAR(fe2d::combined_peak(peaks, fe2d::modal_correlations(equal, 0.05, fe2d::ModalRule::cqc)), 7.0, 1e-12);
}

TEST(SpectrumLevel, ShearOfAModeIsSpectralAccelerationTimesItsMass)
{
    const SpectrumLevel level = spectrum_level(ready_of(rock), {flat_spectrum(2.0)});
    const SpectrumDemand& row = level.rows.front();
    for (const ModeShare& mode : row.modes)
        EXPECT_NEAR(mode.base_shear, 2.0 * mode.effective_mass, 1e-6 * 2.0 * level.total_mass);
    double mass = row.residual_mass;
    for (const ModeShare& mode : row.modes) mass += mode.effective_mass;
    EXPECT_NEAR(mass, 2400.0 * 40.0 * 18.0, 1e-6 * mass); // triangle and crest: (32 + 4)/2 x 40 m2
    EXPECT_GE(row.residual_mass, 0.0);
}

TEST(SpectrumLevel, WithoutRockTheFixedBaseCountsToo)
{
    const SpectrumLevel level = spectrum_level(ready_of(""), {flat_spectrum(1.0)});
    const SpectrumDemand& row = level.rows.front();
    double mass = row.residual_mass;
    for (const ModeShare& mode : row.modes) mass += mode.effective_mass;
    EXPECT_NEAR(mass, level.total_mass, 1e-9 * mass);
    EXPECT_LT(row.shear, level.total_mass); // modes do not all peak at once
    EXPECT_GT(row.shear, row.shear_srss);   // all peaks of a force have the same sign
}

TEST(SpectrumLevel, ForcesOfAllModesAndTheRestAreThoseOfTheRigidDam)
{
    for (const std::string water : {"added-mass", "acoustic"}) {
        const Ready ready = ready_of(rock + "[reservoir]\nlevel_m = 36\nlength_m = 100\nmodel = \"" + water +
                                     "\"\n[uplift]\nmodel = \"linear\"\n");
        const ModesResult modes = compute_modes(ready, {20, false});
        const ModalForces forces = modal_forces(modes);
        double x = 0.0;
        for (int node = 0; node < modes.model.mesh.node_count(); ++node)
            if (const int dof = modes.model.dofs(node, 0);
                dof != fe2d::no_dof && node < modes.model.mesh.dam_node_count)
                x += forces.force.row(dof).sum() + forces.residual[dof];
        EXPECT_NEAR(x, forces.total_mass, 1e-6 * forces.total_mass) << water;
        EXPECT_GT(forces.residual_mass, 0.0) << water;
        EXPECT_GT(forces.total_mass, 1.05 * 2400.0 * 40.0 * 18.0) << water; // the water takes part
    }
}

TEST(SpectrumLevel, WithoutEarthquakeTheFactorsAreThoseOfTheStaticLoads)
{
    const SpectrumLevel none = spectrum_level(
        ready_of(rock + "[reservoir]\nlevel_m = 36\nlength_m = 100\nmodel = \"added-mass\"\n[uplift]\nmodel = "
                        "\"linear\"\n"),
        {flat_spectrum(0.0)});
    const SpectrumDemand& row = none.rows.front();
    EXPECT_EQ(row.shear, 0.0);
    EXPECT_NEAR(row.heel_least, none.static_heel, 1e-12 * std::abs(none.static_heel));
    EXPECT_NEAR(row.overturning_factor, none.static_overturning, 1e-12 * none.static_overturning);
    EXPECT_NEAR(row.sliding_factor, none.static_sliding, 1e-12 * none.static_sliding);
}

TEST(SpectrumLevel, PeakOfTheHistoryOfTheSameModesIsWithinTheScatterOfTheRule)
{
    // Ten modes driven by one record and summed sample by sample; CQC of that record's own spectrum. For one record the
    // rule is known to miss by some ten per cent either way (Wilson, Der Kiureghian & Bayo 1981 show up to 20 %).
    GroundMotion motion;
    motion.dt = 0.01;
    for (int i = 0; i < 1500; ++i) {
        const double t = i * motion.dt;
        motion.accel_h.push_back(std::exp(-0.2 * (t - 5) * (t - 5)) * (std::sin(20 * t) + std::sin(47 * t + 1)));
    }
    const Ready ready = ready_of(rock);
    const ModalForces forces = modal_forces(compute_modes(ready, {10, false}));
    const SpectrumLevel level = spectrum_level(ready, {spectrum_of("pulse", motion, 0.05)});
    std::vector<double> shear(motion.accel_h.size(), 0.0);
    for (Eigen::Index m = 0; m < forces.frequency.size(); ++m) { // average acceleration in hundredths of a sample
        const double w = 2 * 3.14159265358979 * forces.frequency[m], h = motion.dt / 100;
        double u = 0, v = 0, a = 0;
        for (std::size_t i = 0; i + 1 < shear.size(); ++i)
            for (int k = 1; k <= 100; ++k) {
                const double ground = motion.accel_h[i] + (motion.accel_h[i + 1] - motion.accel_h[i]) * k / 100;
                const double predicted_u = u + h * v + 0.25 * h * h * a, predicted_v = v + 0.5 * h * a;
                a = (ground - 0.1 * w * predicted_v - w * w * predicted_u) / (1 + 0.05 * w * h + 0.25 * w * w * h * h);
                u = predicted_u + 0.25 * h * h * a;
                v = predicted_v + 0.5 * h * a;
                if (k == 100) shear[i + 1] += forces.effective_mass[m] * w * w * u;
            }
    }
    double peak = 0.0;
    for (const double s : shear) peak = std::max(peak, std::abs(s));
    EXPECT_NEAR(level.rows.front().shear, peak, 0.2 * peak);
}

const std::string full_water = "[reservoir]\nlevel_m = 36\nlength_m = 100\nmodel = \"added-mass\"\n[uplift]\nmodel = "
                               "\"linear\"\n";

LevelSpectrum two_components(double horizontal, double vertical)
{
    LevelSpectrum both = flat_spectrum(horizontal);
    both.vertical = [vertical](double) { return vertical; };
    return both;
}

TEST(SpectrumLevel, VerticalForceOfAModeIsSpectralAccelerationTimesItsMass)
{
    for (const std::string& below : {rock, std::string()}) {
        const SpectrumLevel level = spectrum_level(ready_of(below), {two_components(1.0, 2.0)});
        const SpectrumDemand& row = level.rows.front();
        EXPECT_EQ(row.vertical_pga, 2.0);
        double mass = row.vertical_residual_mass;
        for (const ModeShare& mode : row.vertical_modes) {
            mass += mode.effective_mass;
            if (!below.empty()) { // without rock the share of the fixed nodes is in no mode's force
                EXPECT_NEAR(mode.base_shear, 2.0 * mode.effective_mass, 1e-6 * 2.0 * level.vertical_mass);
            }
        }
        EXPECT_NEAR(mass, 2400.0 * 40.0 * 18.0, 1e-6 * mass); // triangle and crest: (32 + 4)/2 x 40 m2
    }
}

TEST(SpectrumLevel, WithoutAVerticalSpectrumThereAreNoComponents)
{
    const SpectrumLevel level = spectrum_level(ready_of(rock), {flat_spectrum(1.0)});
    EXPECT_EQ(level.vertical_mass, 0.0);
    EXPECT_TRUE(level.rows.front().components.empty());
}

TEST(SpectrumLevel, ComponentsAreCombinedByBothRules)
{
    const SpectrumLevel level = spectrum_level(ready_of(rock + full_water), {two_components(1.5, 1.0)});
    const SpectrumDemand& row = level.rows.front();
    ASSERT_EQ(row.components.size(), 4u);
    const ComponentDemand &h = row.components[0], &v = row.components[1], &srss = row.components[2],
                          &percent = row.components[3];
    EXPECT_EQ(h.shear, row.shear);
    EXPECT_EQ(h.heel_least, row.heel_least);
    EXPECT_EQ(h.toe_most, row.toe_most);
    EXPECT_NEAR(h.sliding_factor, row.sliding_factor, 1e-12 * row.sliding_factor);
    EXPECT_NEAR(h.overturning_factor, row.overturning_factor, 1e-12 * row.overturning_factor);
    EXPECT_NEAR(srss.shear, std::hypot(h.shear, v.shear), 1e-9 * srss.shear);
    EXPECT_NEAR(percent.normal, std::max(h.normal + 0.3 * v.normal, 0.3 * h.normal + v.normal), 1e-9 * percent.normal);
    const double heel_h = level.static_heel - h.heel_least, heel_v = level.static_heel - v.heel_least;
    EXPECT_NEAR(level.static_heel - srss.heel_least, std::hypot(heel_h, heel_v), 1e-6 * heel_h);
    EXPECT_LT(srss.sliding_factor, h.sliding_factor);
    EXPECT_LT(percent.sliding_factor, h.sliding_factor);
    EXPECT_LT(v.sliding_factor, level.static_sliding);
}

TEST(SpectrumLevel, LeastSlidingFactorIsThatOfTheWorstPointOfTheEllipse)
{
    // The ellipse of shear t = T_p cos a and normal force n = N_p (rho cos a + sqrt(1 - rho^2) sin a), T_p, N_p and rho as the
    // rows print them; the least of mu (N' + n)/(T + t) by search over 100,000 angles: an angle off by 3e-5 at a minimum
    // changes it by some 1e-9.
    const Ready ready = ready_of(rock + full_water);
    const SpectrumLevel level = spectrum_level(ready, {two_components(1.2, 0.0)});
    const SpectrumDemand& row = level.rows.front();
    const ComponentDemand& srss = row.components[2];
    const double rho = row.normal_with_shear / row.components[0].normal; // of N' and T
    double least = 1e9;
    for (int i = 0; i < 100000; ++i) {
        const double a = 2.0 * 3.14159265358979323846 * i / 100000;
        const double t = srss.shear * std::cos(a);
        const double n = srss.normal * (rho * std::cos(a) + std::sqrt(1.0 - rho * rho) * std::sin(a));
        if (level.static_shear + t > 0.0)
            least = std::min(least, (level.static_normal + n) / (level.static_shear + t)); // mu = 1
    }
    EXPECT_NEAR(srss.sliding_factor, least, 1e-8 * least);
}

TEST(SpectrumLevel, RecordsWithAVerticalComponentHaveItsSpectrum)
{
    GroundMotion motion;
    motion.dt = 0.01;
    motion.accel_h = {0.0, 1.0, -2.0, 0.5, 0.0};
    EXPECT_FALSE(spectrum_of("one", motion, 0.05).vertical);
    motion.accel_v = {0.0, -3.0, 1.0, 0.0, 0.0};
    const LevelSpectrum both = spectrum_of("two", motion, 0.05);
    EXPECT_EQ(both.acceleration(0.0), 2.0);
    EXPECT_EQ(both.vertical(0.0), 3.0);
}

} // namespace
} // namespace damslip
