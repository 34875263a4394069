// Added mass: pointwise values, totals and the tensor on inclined faces, against closed forms.
#include "sliding/loads/added_mass.hpp"

#include "core/input_error.hpp"
#include "core/units.hpp"
#include "verification/exact/added_mass.hpp"
#include "verification/exact/reference_scene.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace damslip::sliding {
namespace {

const WaterColumn water{62.5, 1000.0, 2200e6};

AddedMass method(AddedMassFormula formula)
{
    AddedMass m;
    m.formula = formula;
    return m;
}

TEST(AddedMass, SeriesAgreesWithClausensIntegral)
{
    // Round-off of about 30 terms (2e-14 relative) and the truncation of the exact sum (1.3e-15, see there).
    for (double zeta : {1e-9, 1e-4, 0.01, 0.1, 0.37, 0.5, 0.8, 0.99, 1.0})
        for (double tau : {0.0, 0.05, 0.1656, 0.7, 0.999}) {
            const double exact = exact::westergaard_sine_sum(zeta, tau);
            EXPECT_NEAR(westergaard_series(zeta, tau), exact, 2e-14 * exact + 1.3e-15) << zeta << " " << tau;
        }
    EXPECT_EQ(westergaard_series(0.0, 0.5), 0.0);
}

TEST(AddedMass, ValuesAtTheBase)
{
    const double unit = 1000.0 * 62.5;
    EXPECT_DOUBLE_EQ(added_mass_per_area(method(AddedMassFormula::westergaard_simplified), water, 62.5, 0.0),
                     0.875 * unit);
    EXPECT_NEAR(added_mass_per_area(method(AddedMassFormula::westergaard), water, 62.5, 0.0) / unit,
                exact::westergaard_base(), 1e-14);
    EXPECT_NEAR(added_mass_per_area(method(AddedMassFormula::zangar), water, 62.5, 0.0), 0.73 * unit, 1e-10);
    EXPECT_NEAR(added_mass_per_area(method(AddedMassFormula::goldgruber), water, 62.5, 0.0), 0.707 * unit, 1e-10);
    for (auto f : {AddedMassFormula::westergaard_simplified, AddedMassFormula::westergaard, AddedMassFormula::zangar,
                   AddedMassFormula::goldgruber})
        EXPECT_EQ(added_mass_per_area(method(f), water, 0.0, 0.1), 0.0);
}

TEST(AddedMass, InclinedCoefficientsAndTheRuleForThem)
{
    const double unit = 1000.0 * 62.5, phi = 30.0 * units::degree;
    AddedMass zangar = method(AddedMassFormula::zangar), goldgruber = method(AddedMassFormula::goldgruber);
    const double z = added_mass_per_area(zangar, water, 62.5, phi),
                 g = added_mass_per_area(goldgruber, water, 40.0, phi);
    EXPECT_NEAR(z, 0.73 * (2.0 / 3.0) / std::cos(phi) * unit, 1e-9);
    zangar.inclined_face = goldgruber.inclined_face = InclinedFaceRule::printed;
    EXPECT_NEAR(added_mass_per_area(zangar, water, 62.5, phi) / z, std::cos(phi), 1e-14); // 13 % less
    EXPECT_NEAR(added_mass_per_area(goldgruber, water, 40.0, phi) / g, std::cos(phi), 1e-14);
    // (3-10...3-14) literally, y up from the bottom.
    const double h = 62.5, y = 22.5, h_m = h * std::sqrt(0.03);
    EXPECT_NEAR(added_mass_per_area(goldgruber, water, 40.0, phi),
                0.707 * unit * (1.0 - 0.33) * std::pow(std::cos(0.5 * M_PI * (y - h_m) / (h - h_m)), 0.75), 1e-9);
    zangar.zangar_table = {{0.0, 0.7}, {phi, 0.5}};
    EXPECT_NEAR(added_mass_per_area(zangar, water, 62.5, 0.5 * phi), 0.6 * unit, 1e-10);
    EXPECT_NEAR(added_mass_per_area(zangar, water, 62.5, 1.2 * phi), 0.5 * unit, 1e-10);
    EXPECT_NEAR(added_mass_per_area(method(AddedMassFormula::zangar), water, 62.5, 0.5 * M_PI),
                0.73 * unit / (0.5 * M_PI), 1e-6);
    EXPECT_THROW(added_mass_per_area(goldgruber, water, 62.5, 31.0 * units::degree), InputError);
}

TEST(AddedMass, PeriodsAtAndBelowTheReservoirsOwnAreRefused)
{
    AddedMass m = method(AddedMassFormula::westergaard);
    m.period = reservoir_period(water);
    try {
        added_mass_per_area(m, water, 10.0, 0.0);
        FAIL() << "not refused";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("T_r = 4h/c = 0.16855"), std::string::npos) << error.what();
    }
    m.period = 1.0001 * *m.period;
    EXPECT_GT(added_mass_per_area(m, water, 10.0, 0.0), 0.0);
    m.formula = AddedMassFormula::zangar; // does not use the period
    m.period = 0.01;
    EXPECT_GT(added_mass_per_area(m, water, 10.0, 0.0), 0.0);
}

// A long period is the incompressible limit: tau = (T_r/T)^2 enters in first order, 0.5 tau.
TEST(AddedMass, LongPeriodApproachesIncompressible)
{
    AddedMass m = method(AddedMassFormula::westergaard);
    const double still = integrate_added_mass(m, water, {{0, 0}, {0, 62.5}}).xx;
    m.period = 1000.0 * reservoir_period(water);
    EXPECT_NEAR(integrate_added_mass(m, water, {{0, 0}, {0, 62.5}}).xx / still, 1.0, 1e-6);
}

// Face leaning 10 m over 40 m of water under Westergaard's simplified formula. With n = (cos, -sin), dS = dz/cos and
// I = 7/12 rho h^2: xx = I cos, xy = -I sin, yy = I sin^2/cos; z-moment of sqrt(h z): acts 0.6 h below the surface.
TEST(AddedMass, TensorOfAnInclinedFace)
{
    const WaterColumn column{40.0, 1000.0, 2200e6};
    const auto m = integrate_added_mass(method(AddedMassFormula::westergaard_simplified), column, {{0, 0}, {15, 60}});
    const double phi = std::atan2(10.0, 40.0), total = 7.0 / 12.0 * 1000.0 * 1600.0;
    EXPECT_NEAR(m.xx, total * std::cos(phi), 1e-12 * total);
    EXPECT_NEAR(m.xy, -total * std::sin(phi), 1e-12 * total);
    EXPECT_NEAR(m.yy, total * std::sin(phi) * std::tan(phi), 1e-12 * total);
    EXPECT_NEAR(m.acting_height(), 16.0, 1e-11);
    // The force acts at 0.4 h, x = 4 m: its moment is r x F for both parts.
    const FaceLoad force = hydrodynamic_force(m, -2.0, 0.0);
    EXPECT_GT(force.horizontal.x, 0.0); // a dam driven upstream is pushed back downstream
    EXPECT_LT(force.vertical.y, 0.0);   // and down, the face leans under the water
    EXPECT_NEAR(force.horizontal.moment, -16.0 * force.horizontal.x, 1e-12 * std::abs(force.horizontal.moment));
    EXPECT_NEAR(force.vertical.moment, 4.0 * force.vertical.y, 1e-12 * std::abs(force.vertical.moment));
    // Only the normal component moves water: sliding along the face meets none.
    const FaceLoad along = hydrodynamic_force(m, std::sin(phi), std::cos(phi));
    EXPECT_NEAR(along.total().x, 0.0, 1e-9);
    EXPECT_NEAR(along.total().y, 0.0, 1e-9);
}

TEST(AddedMass, KinkedFaceIsTheSumOfItsPieces)
{
    const AddedMass zangar = method(AddedMassFormula::zangar);
    const WaterColumn column{50.0, 1000.0, 2200e6};
    const auto whole = integrate_added_mass(zangar, column, {{0, 0}, {4, 20}, {4, 55}});
    const auto lower = integrate_added_mass(zangar, column, {{0, 0}, {4, 20}});
    const auto upper = integrate_added_mass(zangar, column, {{4, 20}, {4, 55}});
    EXPECT_NEAR(whole.xx, lower.xx + upper.xx, 1e-12 * whole.xx);
    EXPECT_EQ(upper.xy, 0.0);
    // Pieces of one straight face: splitting it changes nothing.
    const auto straight = integrate_added_mass(zangar, column, {{0, 0}, {11, 55}});
    const auto split = integrate_added_mass(zangar, column, {{0, 0}, {2, 10}, {11, 55}});
    EXPECT_NEAR(straight.xx, split.xx, 1e-13 * straight.xx);
    EXPECT_NEAR(straight.horizontal_moment.x, split.horizontal_moment.x, 1e-13 * std::abs(split.horizontal_moment.x));
}

TEST(AddedMass, OvertoppedFaceCarriesItsPartOnly)
{
    Scene scene = exact::reference_scene(exact::ReferenceUplift::none, 0.77);
    scene.reservoir->level = 70.0;
    // 7/8 rho sqrt(h) (2/3)(h^1.5 - z0^1.5), z0 = 7.5 m above the crest.
    EXPECT_NEAR(scene_added_mass(scene, 70.0).xx,
                7.0 / 12.0 * 1000.0 * std::sqrt(70.0) * (std::pow(70.0, 1.5) - std::pow(7.5, 1.5)), 1e-6);
    EXPECT_EQ(scene_added_mass(scene, std::nullopt).xx, 0.0);
    EXPECT_EQ(scene_added_mass(scene, 0.0).xx, 0.0);
}

TEST(AddedMass, CompressibilityCriterion)
{
    // c/4h = 5.933 Hz for 62.5 m; the reference dam at 3.6 Hz: 1.648 < 2.
    const auto c = compressibility_criterion(water, 3.6);
    EXPECT_NEAR(c.frequency_ratio, std::sqrt(2.2e6) / 250.0 / 3.6, 1e-14);
    EXPECT_TRUE(c.compressible_matters);
    EXPECT_FALSE(compressibility_criterion(water, 2.9).compressible_matters);
}

} // namespace
} // namespace damslip::sliding
