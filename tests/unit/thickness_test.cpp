// Section::thickness against numbers by hand, and against a dam of two materials.
#include "core/input_error.hpp"
#include "fe2d/assembly/assemble.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/element/elastic.hpp"
#include "fe2d/model/model.hpp"
#include "scene/read.hpp"
#include "scene/section.hpp"
#include "scene/write.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"
#include "sliding/planes/lifts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace damslip {
namespace {

constexpr double g = 9.81, concrete = 2400.0, water = 1000.0;

/// A wall of 10 m with 20 m, whose upper half has piers of 0.4 of its width.
const std::string wall = R"([section]
polygon_m = [[0, 0], [10, 0], [10, 20], [0, 20]]
thickness = [[0, 1], [10, 1], [10, 0.4], [20, 0.4]]
[dam]
density_kg_m3 = 2400
young_modulus_GPa = 20
[contact]
friction = 0.8
cohesion_kPa = 100
)";

Scene parsed(const std::string& text)
{
    return parse_scene(text, "dam.toml", FileCheck::skip);
}

std::string message_of(const std::string& text)
{
    try {
        parsed(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

std::string with_table(const std::string& table)
{
    std::string text = wall;
    const std::size_t from = text.find("thickness"), to = text.find('\n', from);
    return text.replace(from, to - from, "thickness = " + table);
}

// 100 m^2 at y = 5 m and 40 m^2 at 15 m: 140 m^2 at 1100/140 m. Polar: two squares of 10 m, 1/6 b^4 each, and Steiner.
TEST(Thickness, AreaCentroidAndPolarMomentAreThoseOfTwoParts)
{
    const Section section = parsed(wall).section;
    EXPECT_NEAR(area(section), 140.0, 1e-11);
    const Point c = centroid(section);
    EXPECT_NEAR(c.x, 5.0, 1e-13);
    EXPECT_NEAR(c.y, 1100.0 / 140.0, 1e-13);
    const double own = 1e4 / 6.0;
    const double steiner = 100.0 * std::pow(c.y - 5.0, 2) + 40.0 * std::pow(15.0 - c.y, 2);
    EXPECT_NEAR(polar_moment(section), own * 1.4 + steiner, 1e-9);
}

// A share that falls from 1 at the base to 0.5 at 20 m: the integral of 10 (1 - y/40) y^k.
TEST(Thickness, ALinearShareIsIntegratedExactly)
{
    const Section section = parsed(with_table("[[0, 1], [20, 0.5]]")).section;
    EXPECT_NEAR(area(section), 150.0, 1e-11);
    EXPECT_NEAR(centroid(section).y, (10.0 * (200.0 - 8000.0 / 120.0)) / 150.0, 1e-12);
    EXPECT_NEAR(mean_share(section, 4.0, 8.0), 1.0 - 6.0 / 40.0, 1e-14);
}

TEST(Thickness, AStepIsAboveItsLevel)
{
    const Section section = parsed(wall).section;
    EXPECT_EQ(share_above(section, 10.0), 0.4);
    EXPECT_EQ(share_above(section, 10.0 - 1e-6), 1.0);
    EXPECT_EQ(base_share(section), 1.0);
    EXPECT_NEAR(mean_share(section, 5.0, 15.0), 0.7, 1e-14);
}

// Weight, thrust on the full width, moment: stresses of the solid base by N/b +- 6 M/b^2.
TEST(Thickness, WaterActsOnTheFullWidth)
{
    const Scene scene = parsed(wall + "[reservoir]\nlevel_m = 18\nmodel = \"hydrostatic\"\n[uplift]\nmodel = \"none\"\n"
                                      "[[combination]]\nname = \"a\"\nk_h = 0.1\ncrack = \"none\"\n");
    const sliding::Equilibrium e = sliding::evaluate_combinations(scene).front();
    const double weight = 140.0 * concrete * g, thrust = 0.5 * water * g * 18.0 * 18.0;
    const double inertia = 140.0 * concrete * 0.1 * 9.80665;
    EXPECT_NEAR(e.base.effective_normal / weight, 1.0, 1e-12);
    EXPECT_NEAR(e.shear / (thrust + inertia), 1.0, 1e-12);
    const double moment = thrust * 6.0 + inertia * 1100.0 / 140.0;
    EXPECT_NEAR(e.toe_stress / (weight / 10.0 + 6.0 * moment / 100.0), 1.0, 1e-12);
    EXPECT_NEAR(e.sliding_factor, (100e3 * 10.0 + 0.8 * weight) / (thrust + inertia), 1e-11);
}

// The joint at the step is between the piers: 0.4 of the area for stress, cohesion and uplift, the full width for the thrust.
TEST(Thickness, ALiftHasTheAreaOfThePiers)
{
    const Scene scene =
        parsed(wall + "[reservoir]\nlevel_m = 18\nmodel = \"hydrostatic\"\n[uplift]\nmodel = \"none\"\n"
                      "[lifts]\nelevations_m = [10]\nfriction = 0.8\nbond = \"bonded\"\ncohesion_kPa = 300\n"
                      "tensile_strength_kPa = 1000\n");
    const auto planes = sliding::lift_planes(scene, {{"rest", 0.0, 0.0}});
    const sliding::LiftState& s = planes.front().states.front();
    const double weight = 40.0 * concrete * g, thrust = 0.5 * water * g * 64.0;
    const double uplift = 0.4 * 0.5 * water * g * 8.0 * 10.0;
    const double normal = weight - uplift;
    EXPECT_NEAR(s.normal / normal, 1.0, 1e-12);
    EXPECT_NEAR(s.factor, (300e3 * 4.0 + 0.8 * normal) / thrust, 1e-11);
    const double moment = thrust * 8.0 / 3.0 + uplift * (10.0 / 2.0 - 10.0 / 3.0); // about the middle
    EXPECT_NEAR(s.toe_stress, normal / 4.0 + 6.0 * moment / (0.4 * 100.0), 1e-6);
}

// Piers from 10 to 20 m, gates shut to 18 m; open: ½ γ on 0.4 of what is above the sill and all below.
TEST(Thickness, OpenGatesLeaveThePiersShare)
{
    const Scene scene = parsed(wall + "[reservoir]\nlevel_m = 18\nmodel = \"hydrostatic\"\n[gate]\ntop_m = 19\n"
                                      "[uplift]\nmodel = \"none\"\n[[combination]]\nname = \"shut\"\ncrack = \"none\"\n"
                                      "[[combination]]\nname = \"open\"\ngates_open = true\ncrack = \"none\"\n");
    const auto states = sliding::evaluate_combinations(scene);
    EXPECT_NEAR(states[0].shear, 0.5 * water * g * 324.0, 1e-6);
    EXPECT_NEAR(states[1].shear, 0.5 * water * g * (324.0 - 0.6 * 64.0), 1e-6);
    const double moment = water * g * (324.0 / 2.0 * 6.0 - 0.6 * 32.0 * (10.0 + 8.0 / 3.0));
    double found = 0.0;
    for (const sliding::Load& load : states[1].loads)
        if (load.kind == sliding::LoadKind::reservoir) found -= load.force.total().moment;
    EXPECT_NEAR(found / moment, 1.0, 1e-12);
}

TEST(Thickness, WaterAboveTheGatesIsRefused)
{
    EXPECT_NE(
        message_of(wall + "[reservoir]\nlevel_m = 19.5\n[gate]\ntop_m = 19\n[uplift]\nmodel = \"none\"\n").find("gate"),
        std::string::npos);
}

// K and M of an element with a share are those of a material of share times E and share times density.
TEST(Thickness, FiniteElementsAreThoseOfTwoMaterials)
{
    const Scene scene = parsed(wall + "[mesh]\nsize_m = 2\ncontact_size_m = 1\n");
    const fe2d::Model model = fe2d::build_model(scene);
    fe2d::Mesh solid = model.mesh;
    std::vector<double> share;
    for (fe2d::Element& e : solid.elements) {
        const auto c = fe2d::corners(solid, e);
        const double middle = 0.25 * (c[0].y + c[1].y + c[2].y + c[3].y);
        EXPECT_EQ(e.share, middle > 10.0 ? 0.4 : 1.0);
        e.share = 1.0;
    }
    const auto material = [&](const fe2d::Corners& c) {
        fe2d::ElasticMaterial m = model.materials.dam;
        const double y = 0.25 * (c[0].y + c[1].y + c[2].y + c[3].y), factor = y > 10.0 ? 0.4 : 1.0;
        m.young_modulus *= factor;
        m.density *= factor;
        return m;
    };
    const auto stiffness = fe2d::assemble(solid, model.dofs, [&](const fe2d::Element& e, const fe2d::Corners& c) {
        return fe2d::elastic_stiffness(c, e.size(), fe2d::plane_strain_matrix(material(c)), model.materials.kind,
                                       fe2d::extra_nodes(e));
    });
    const auto mass = fe2d::assemble(solid, model.dofs, [&](const fe2d::Element& e, const fe2d::Corners& c) {
        return fe2d::elastic_mass(c, e.size(), material(c).density, model.mass_kind, fe2d::extra_nodes(e));
    });
    EXPECT_LT((stiffness - model.stiffness).norm(), 1e-12 * stiffness.norm());
    EXPECT_LT((mass - model.mass).norm(), 1e-12 * mass.norm());
    EXPECT_NEAR(model.total_mass.x(), 140.0 * concrete, 1e-6);

    fe2d::Model other = model;
    other.stiffness = stiffness;
    other.mass = mass;
    const auto a = fe2d::natural_modes(model, 3), b = fe2d::natural_modes(other, 3);
    for (Eigen::Index i = 0; i < 3; ++i) EXPECT_NEAR(a.frequency[i] / b.frequency[i], 1.0, 1e-9);
}

TEST(Thickness, ResolvedSceneReadsBack)
{
    const Scene scene = parsed(wall), again = parsed(resolved_toml(scene));
    EXPECT_EQ(again.section.thickness, scene.section.thickness);
    EXPECT_EQ(resolved_toml(again), resolved_toml(scene));
}

TEST(Thickness, WrongTablesAreRefused)
{
    EXPECT_NE(message_of(with_table("[[0, 1], [10, 0]]")).find("section.thickness"), std::string::npos);
    EXPECT_NE(message_of(with_table("[[0, 1], [10, 1.2]]")).find("section.thickness"), std::string::npos);
    EXPECT_NE(message_of(with_table("[[10, 1], [0, 1]]")).find("in order"), std::string::npos);
    EXPECT_NE(message_of(with_table("[[0, 1], [10, 1], [10, 0.5], [10, 0.4]]")).find("twice at most"),
              std::string::npos);
    EXPECT_NE(message_of(with_table("[[60, 1], [72, 0.3]]")).find("beside a dam"), std::string::npos);
    std::string inclined = with_table("[[-2, 1], [0, 0.5]]");
    inclined.replace(inclined.find("[10, 0]"), 7, "[10, -1]");
    EXPECT_NE(message_of(inclined).find("inclined base"), std::string::npos);
}

} // namespace
} // namespace damslip
