#include "key_scenes.hpp"

namespace damslip::audit3 {
namespace {

class Audit3Thickness : public KeyScene {
protected:
    /// Half of the width everywhere.
    static Tables half_wide()
    {
        Tables t = small_dam();
        set(t, "section.thickness", "[[0, 0.5], [30, 0.5]]");
        set(t, "contact.cohesion_kPa", "40");
        set(t, "contact.friction", "0.6");
        set(t, "reservoir.level_m", "14"); // a light dam that stands without a crack, in which the water is not halved
        set(t, "uplift.model", "\"points\"");
        set(t, "uplift.points_m", "[[0, 1], [24, 0]]");
        return t;
    }
    /// The same as a material: half of density, modulus, cohesion and uplift.
    static Tables half_heavy()
    {
        Tables t = half_wide();
        set(t, "section.thickness", "-");
        set(t, "dam.density_kg_m3", "1200");
        set(t, "dam.young_modulus_GPa", "10");
        set(t, "contact.cohesion_kPa", "20");
        set(t, "uplift.points_m", "[[0, 0.5], [24, 0]]");
        return t;
    }
    static void expect_close(const Json& a, const Json& b, const std::string& key, double factor = 1.0,
                             double tolerance = 1e-7)
    {
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
            if (a[i].contains(key) && a[i][key].is_number() && a[i].dump().find("cracked") == std::string::npos) {
                EXPECT_NEAR(a[i][key].get<double>(), factor * b[i][key].get<double>(),
                            tolerance * (1e-6 + std::abs(a[i][key].get<double>())))
                    << key << " of row " << i;
            }
    }
};

// Forces per metre of dam, slips and frequencies are those of half a material; stresses are those of the concrete that is there.
TEST_F(Audit3Thickness, HalfTheWidthIsHalfTheMaterial)
{
    const std::string wide = toml_of(half_wide()), heavy = toml_of(half_heavy());
    const Json a = json({"screen", "--rigid-only"}, wide), b = json({"screen", "--rigid-only"}, heavy);
    expect_close(a["limit_equilibrium"], b["limit_equilibrium"], "shear_force_kN_per_m");
    expect_close(a["limit_equilibrium"], b["limit_equilibrium"], "sliding_factor");
    expect_close(a["limit_equilibrium"], b["limit_equilibrium"], "yield_acceleration_m_s2");
    expect_close(a["limit_equilibrium"], b["limit_equilibrium"], "heel_stress_kPa", 2.0);
    EXPECT_FALSE(a["displacements"].empty());
    for (const char* key : {"slip_h_mm", "slip_hv_mm", "max_slip_m"})
        expect_close(a["displacements"], b["displacements"], key, 1.0, 1e-6);
    expect_close(json({"modes", "--count", "4"}, wide)["modes"], json({"modes", "--count", "4"}, heavy)["modes"],
                 "frequency_Hz");
    const Json fe_a = json({"fe", "--no-mesh-error"}, wide), fe_b = json({"fe", "--no-mesh-error"}, heavy);
    ASSERT_FALSE(fe_a["slip"].empty());
    for (const auto& [key, value] : fe_a["slip"][0].items())
        if (value.is_number() && key.find("seconds") == std::string::npos &&
            (key.find("slip") != std::string::npos || key.find("open") != std::string::npos))
            expect_close(fe_a["slip"], fe_b["slip"], key, 1.0, 1e-5);
}

// A lift joint at a step has the area of the piers above it.
TEST_F(Audit3Thickness, ALiftJointBetweenPiersIsHalfTheMaterialAbove)
{
    Tables wide = small_dam();
    set(wide, "section.thickness", "[[0, 0.5], [30, 0.5]]");
    set(wide, "uplift.model", "\"none\"");
    set(wide, "reservoir.level_m", "18");
    set(wide, "lift_joint[].elevation_m", "15");
    set(wide, "lift_joint[].friction", "0.3");
    set(wide, "lift_joint[].cohesion_kPa", "20");
    Tables heavy = wide;
    set(heavy, "section.thickness", "-");
    set(heavy, "dam.density_kg_m3", "1200");
    set(heavy, "dam.young_modulus_GPa", "10");
    set(heavy, "lift_joint[].cohesion_kPa", "10");
    const Json a = json({"fe", "--no-mesh-error"}, toml_of(wide)), b = json({"fe", "--no-mesh-error"}, toml_of(heavy));
    ASSERT_FALSE(a["slip"].empty());
    for (const auto& [key, value] : a["slip"][0].items())
        if (value.is_number() && key.find("seconds") == std::string::npos &&
            (key.find("slip") != std::string::npos || key.find("open") != std::string::npos))
            expect_close(a["slip"], b["slip"], key, 1.0, 1e-5);
}

} // namespace
} // namespace damslip::audit3
