#include "key_scenes.hpp"

#include "scene/keys.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <sstream>

namespace damslip::audit3 {

namespace {

/// A key, two values of it, and what the scene needs for them to matter: "key : a | b : other = value; ...". A key without
/// the value "none", one of a list in "table[].key".
constexpr const char* cases = R"(
site.gravity_m_s2 : 9.81 | 9.79
section.height_m : 30 | 31
section.base_inclination_deg : 0 | 3
section.neck_m : 0 | 4
section.upstream_slope : 0 | 0.05
section.thickness : none | [[0,1],[20,1],[20,0.5],[30,0.5]]
dam.density_kg_m3 : 2400 | 2500
dam.young_modulus_GPa : 20 | 30
dam.poisson_ratio : 0.2 | 0.1
contact.friction : 0.8 | 0.7
contact.cohesion_kPa : 0 | 20
contact.cohesion_lost_at_slip : true | false : contact.cohesion_kPa=20
contact.residual_friction : 0.8 | 0.6
contact.residual_slip_m : 0 | 0.005 : contact.residual_friction=0.6
contact.residual_path : "steps" | "linear" : contact.residual_friction=0.6; contact.residual_slip_m=0.005
contact.friction_table_m : none | [[0,0.8],[0.005,0.6]]
contact.separation : "allowed" | "none"
contact.enforcement : "exact" | "slip-tolerance"
contact.tangential_stiffness_N_m3 : 1e9 | 1e10 : contact.enforcement="penalty"
contact.slip_tolerance : 0.005 | 0.05 : contact.enforcement="slip-tolerance"
contact.normal : "hard" | "exponential"
contact.pressure_at_zero_clearance_kPa : 1000 | 500 : contact.normal="exponential"
contact.clearance_at_zero_pressure_m : 0.001 | 0.005 : contact.normal="exponential"
contact.bond : "together" | "pairs" : contact.cohesion_kPa=50
contact.tensile_strength_kPa : 100 | 300 : contact.bond="fracture"; contact.cohesion_kPa=300; contact.fracture_energy_tension_N_m=150; contact.fracture_energy_shear_N_m=1500
contact.fracture_energy_tension_N_m : 50 | 150 : contact.bond="fracture"; contact.cohesion_kPa=100; contact.tensile_strength_kPa=100; contact.fracture_energy_shear_N_m=1500
contact.fracture_energy_shear_N_m : 200 | 1500 : contact.bond="fracture"; contact.cohesion_kPa=50
contact.unloading : "origin" | "plastic" : contact.bond="fracture"; contact.cohesion_kPa=300; contact.tensile_strength_kPa=100; contact.fracture_energy_tension_N_m=150; contact.fracture_energy_shear_N_m=1500
contact.softening : "linear" | "exponential" : contact.bond="fracture"; contact.cohesion_kPa=300; contact.tensile_strength_kPa=100; contact.fracture_energy_tension_N_m=150; contact.fracture_energy_shear_N_m=1500
contact.dynamic_increase : 1 | 1.3 : contact.bond="fracture"; contact.cohesion_kPa=300; contact.tensile_strength_kPa=100; contact.fracture_energy_tension_N_m=150; contact.fracture_energy_shear_N_m=1500
contact.kinetic_friction_ratio : 0.9 | 0.7 : contact.characteristic_rate_m_s=0.01; contact.relaxation_time_s=0.05
contact.characteristic_rate_m_s : 0.01 | 0.05 : contact.kinetic_friction_ratio=0.8; contact.relaxation_time_s=0.05
contact.relaxation_time_s : 0.05 | 0.2 : contact.kinetic_friction_ratio=0.8; contact.characteristic_rate_m_s=0.01
contact.relaxation_slip_m : 0.001 | 0.01 : contact.kinetic_friction_ratio=0.8; contact.characteristic_rate_m_s=0.01
lift_joint[].elevation_m : 10 | 20 : lift_joint[].friction=0.8
lift_joint[].friction : 0.8 | 0.4 : lift_joint[].elevation_m=15
lift_joint[].cohesion_kPa : 0 | 100 : lift_joint[].elevation_m=15; lift_joint[].friction=0.4
lift_joint[].water : "none" | "linear" : lift_joint[].elevation_m=15; lift_joint[].friction=0.4
anchor[].prestress_kN_m : 0 | 500 : anchor[].distance_m=4; anchor[].free_length_m=10; anchor[].area_m2_m=0.002; anchor[].yield_strength_MPa=1000
anchor[].distance_m : 4 | 14 : anchor[].free_length_m=10; anchor[].area_m2_m=0.002; anchor[].yield_strength_MPa=1000; anchor[].prestress_kN_m=500
anchor[].inclination_deg : 0 | 30 : anchor[].distance_m=4; anchor[].free_length_m=10; anchor[].area_m2_m=0.002; anchor[].yield_strength_MPa=1000; anchor[].prestress_kN_m=500
anchor[].free_length_m : 10 | 20 : anchor[].inclination_deg=30; anchor[].distance_m=4; anchor[].area_m2_m=0.002; anchor[].yield_strength_MPa=1000; anchor[].prestress_kN_m=500
anchor[].area_m2_m : 0.002 | 0.004 : anchor[].inclination_deg=30; anchor[].distance_m=4; anchor[].free_length_m=10; anchor[].yield_strength_MPa=1000; anchor[].prestress_kN_m=500
anchor[].young_modulus_GPa : 200 | 150 : anchor[].inclination_deg=30; anchor[].area_m2_m=0.002; anchor[].distance_m=4; anchor[].free_length_m=10; anchor[].yield_strength_MPa=1000; anchor[].prestress_kN_m=500
anchor[].yield_strength_MPa : 300 | 1000 : anchor[].inclination_deg=30; anchor[].area_m2_m=0.002; anchor[].distance_m=4; anchor[].free_length_m=10; anchor[].prestress_kN_m=500
anchor[].rupture_strain : 0.002 | 0.1 : anchor[].inclination_deg=30; anchor[].area_m2_m=0.002; anchor[].distance_m=4; anchor[].free_length_m=3; anchor[].yield_strength_MPa=300; anchor[].prestress_kN_m=500
anchor[].dowel : false | true : anchor[].inclination_deg=30; anchor[].area_m2_m=0.002; anchor[].distance_m=4; anchor[].free_length_m=10; anchor[].yield_strength_MPa=300; anchor[].prestress_kN_m=500
anchor[].limit_force : "prestress" | "yield" : anchor[].inclination_deg=30; anchor[].area_m2_m=0.002; anchor[].distance_m=4; anchor[].free_length_m=10; anchor[].yield_strength_MPa=1000; anchor[].prestress_kN_m=500
uplift.model : "linear" | "none"
uplift.curtain_ratio : 0.66 | 0.3 : uplift.model="curtain"; curtain.distance_m=4
uplift.points_m : [[0,1],[24,0]] | [[0,1],[10,0.2],[24,0]] : uplift.model="points"
uplift.crack : "none" | "seismic-zero" : section.base_m=20; reservoir.level_m=29; contact.friction=1.2
uplift.opening : "unchanged" | "full"
uplift.opening : "unchanged" | "zero"
uplift.after : "unchanged" | "full" : motion.sequence=["a","a"]
uplift.mouth_speed_m_s : 1 | 20 : uplift.opening="mouth"
uplift.joint_clearance_m : 0.0002 | 0.002 : uplift.opening="reynolds"
uplift.water_viscosity_Pa_s : 0.0013 | 0.01 : uplift.opening="reynolds"
uplift.cavitation_pressure_kPa : -99 | 0 : uplift.opening="reynolds"
uplift.wet_end : "still" | "with-waves" : uplift.opening="reynolds"
curtain.distance_m : 3 | 6 : uplift.model="seepage"; foundation.young_modulus_GPa=20
curtain.depth_m : 10 | 20 : curtain.distance_m=3; uplift.model="seepage"; foundation.young_modulus_GPa=20
curtain.thickness_m : 1 | 2 : curtain.distance_m=3; uplift.model="seepage"; foundation.young_modulus_GPa=20
curtain.young_modulus_GPa : 20 | 5 : curtain.distance_m=3; uplift.model="seepage"; foundation.young_modulus_GPa=20
curtain.poisson_ratio : 0.2 | 0.4 : curtain.young_modulus_GPa=5; curtain.distance_m=3; uplift.model="seepage"; foundation.young_modulus_GPa=20
curtain.permeability_m_s : 1e-8 | 1e-6 : curtain.distance_m=3; uplift.model="seepage"; foundation.young_modulus_GPa=20
curtain.intact : true | false : curtain.distance_m=3; uplift.model="seepage"; foundation.young_modulus_GPa=20
drains.distance_m : 3 | 6 : uplift.model="drains"
drains.efficiency : 0.66 | 0.3 : uplift.model="drains"; drains.distance_m=3
drains.depth_m : 10 | 5 : uplift.model="seepage"; drains.distance_m=3; foundation.young_modulus_GPa=20
drains.gallery_level_m : none | 5 : uplift.model="drains"; drains.distance_m=3
drains.lost_at_slip_m : none | 0.002 : uplift.model="drains"; drains.distance_m=3
foundation.young_modulus_GPa : 20 | 10
foundation.poisson_ratio : 0.2 | 0.3 : foundation.young_modulus_GPa=10
foundation.density_kg_m3 : 2400 | 2700 : foundation.young_modulus_GPa=10; seam[].depth_m=4; seam[].friction=0.6; seam[].exit="free-face"
lifts.spacing_m : 6 | 10 : lifts.friction=0.7
lifts.friction : 0.8 | 0.7 : lifts.spacing_m=6
lifts.uplift_share : 1 | 0.5 : lifts.friction=0.7; lifts.spacing_m=6
seam[].depth_m : 4 | 6 : foundation.young_modulus_GPa=10; foundation.density_kg_m3=2600; seam[].friction=0.6; seam[].exit="free-face"
seam[].friction : 0.6 | 0.5 : foundation.young_modulus_GPa=10; foundation.density_kg_m3=2600; seam[].depth_m=4; seam[].exit="free-face"
seam.wedge.friction : 0.8 | 0.6 : foundation.young_modulus_GPa=10; foundation.density_kg_m3=2600; seam[].depth_m=4; seam[].friction=0.6; seam.wedge.angle_deg=20; seam[].uplift="none"
seam.wedge.angle_deg : 20 | 30 : foundation.young_modulus_GPa=10; foundation.density_kg_m3=2600; seam[].depth_m=4; seam[].friction=0.6; seam.wedge.friction=0.7
foundation.k0 : 0.3 | 1.5 : foundation.young_modulus_GPa=10; foundation.density_kg_m3=2600; seam[].depth_m=4; seam[].friction=0.6; seam.wedge.friction=0.7; seam.wedge.angle_deg=20; seam[].uplift="none"
foundation.ground_m : [[-10,0],[24,0],[60,0]] | [[-10,0],[24,0],[40,3]] : foundation.young_modulus_GPa=10; foundation.density_kg_m3=2600; seam[].depth_m=4; seam[].friction=0.6; seam.wedge.friction=0.7; seam.wedge.angle_deg=20; seam[].uplift="none"
foundation.mass : "with-mass" | "massless" : foundation.young_modulus_GPa=10
foundation.boundary : "absorbing" | "fixed" : foundation.young_modulus_GPa=10; foundation.density_kg_m3=2600
foundation.wave_box : 1 | 1.5 : foundation.young_modulus_GPa=10
foundation.wave_frequency_Hz : 25 | 40 : foundation.young_modulus_GPa=10
foundation.width_m : 100 | 150 : foundation.young_modulus_GPa=10
foundation.depth_m : 40 | 60 : foundation.young_modulus_GPa=10
foundation.permeability_m_s : 1e-4 | 1e-6 : foundation.young_modulus_GPa=10; curtain.distance_m=3; uplift.model="seepage"
reservoir.level_m : 26 | 28
reservoir.density_kg_m3 : 1000 | 1050
reservoir.bulk_modulus_MPa : 2200 | 2000 : reservoir.model="acoustic"
reservoir.length_m : 30 | 60 : reservoir.model="acoustic"; reservoir.far_end="closed"
reservoir.model : "added-mass" | "hydrostatic"
reservoir.floor_pressure : false | true : foundation.young_modulus_GPa=10
reservoir.surface : "free" | "sloshing" : reservoir.model="acoustic"
reservoir.far_end : "absorbing" | "closed" : reservoir.model="acoustic"
reservoir.bottom_motion : "ground" | "still" : reservoir.model="acoustic"
reservoir.floor : "absorbing" | "rock" : reservoir.model="acoustic"; foundation.young_modulus_GPa=10
reservoir.bottom_reflection : 0.75 | 0.2 : reservoir.model="acoustic"
reservoir.bottom_density_kg_m3 : 2000 | 2600 : reservoir.model="acoustic"; reservoir.bottom_modulus_GPa=10
reservoir.bottom_modulus_GPa : 1 | 10 : reservoir.model="acoustic"; reservoir.bottom_density_kg_m3=2000
reservoir.mesh_size_m : 4 | 6 : reservoir.model="acoustic"
added_mass.formula : "westergaard" | "zangar"
added_mass.period_s : none | 0.4
added_mass.inclined_face : "normal-component" | "printed" : section.upstream_slope=0.2; added_mass.formula="zangar"
added_mass.zangar_table_deg : [[0,0.73],[30,0.54]] | [[0,0.5],[30,0.4]] : added_mass.formula="zangar"
tailwater.level_m : 0 | 6
silt.level_m : 5 | 10 : silt.submerged_unit_weight_kN_m3=9; silt.pressure_coefficient=0.5
silt.submerged_unit_weight_kN_m3 : 9 | 7 : silt.level_m=8; silt.pressure_coefficient=0.5
silt.pressure_coefficient : 0.5 | 0.3 : silt.level_m=8; silt.submerged_unit_weight_kN_m3=9
ice.force_kN_m : 0 | 100
ice.level_m : 26 | 20 : ice.force_kN_m=100
force[].force_x_kN_m : 0 | 100 : force[].x_m=2; force[].y_m=29
force[].force_y_kN_m : 0 | -300 : force[].x_m=2; force[].y_m=29
force[].y_m : 29 | 10 : force[].x_m=2; force[].force_x_kN_m=100
force[].x_m : 1 | 3 : force[].y_m=29; force[].force_y_kN_m=-300
motion.scale : 1 | 1.2
motion.scale_to_pga_m_s2 : 5 | 6
motion.polarity : 1 | -1
motion.vertical : true | false
motion.sequence : none | ["a","a"]
motion.sequence_pause_s : 0 | 5 : motion.sequence=["a","a"]; contact.restitution=0
motion.record[].scale : 1 | 1.2
motion.record[].magnitude : 6 | 7
sliding.scheme : "exact" | "slammer" : motion.record[].vertical=-
sliding.lift_off : "no-friction" | "ballistic" : motion.scale=5
sliding.two_way : true | false : motion.scale=2
sliding.run_out_max_s : 0 | 5 : motion.scale=2
regressions.period_s : 0 | 0.3
flexible_block.period_s : 0.2 | 0.4
flexible_block.damping : 0.05 | 0.1 : flexible_block.period_s=0.3
flexible_block.mass_ratio : 0.7 | 0.8 : flexible_block.period_s=0.3
flexible_block.shape_exponent : 1 | 2 : flexible_block.period_s=0.3
flexible_block.mode : "coupled" | "decoupled" : flexible_block.period_s=0.3
criteria.pga_fraction : 1 | 0.5
criteria.pga_v_fraction : 0 | 0.5
mesh.size_m : 8 | 6
mesh.contact_size_m : 4 | 3
mesh.rock_contact_size_m : 4 | 3 : foundation.young_modulus_GPa=10
mesh.rock_size_m : 8 | 5 : foundation.young_modulus_GPa=10
mesh.growth : 1.15 | 1.5 : foundation.young_modulus_GPa=10
mesh.element : "q4-incompatible" | "q4"
stages.gravity : "dam" | "dam-and-rock" : foundation.young_modulus_GPa=10; foundation.density_kg_m3=2600
stages.pore_pressure : "none" | "total" : foundation.young_modulus_GPa=10
damping.method : "rayleigh" | "none"
damping.ratio : 0.05 | 0.1
damping.first_mode : 1 | 2
damping.second_mode : 5 | 3
damping.mass_coefficient_1_s : 1 | 2 : damping.stiffness_coefficient_s=0.001
damping.stiffness_coefficient_s : 0.001 | 0.002 : damping.mass_coefficient_1_s=1
damping.mass : "deformation-only" | "total"
time.scheme : "hht" | "newmark"
time.alpha : -0.05 | -0.2 : time.scheme="hht"
time.gamma : 0.5 | 0.6 : time.scheme="newmark"; time.beta=0.3025
time.beta : 0.25 | 0.3 : time.scheme="newmark"
time.dt_s : 0.02 | 0.01
time.substeps : 1 | 2
time.stepping : "auto" | "uniform" : time.substeps=-; time.slip_tolerance=0.05
time.stepping : "uniform" | "adaptive" : time.substeps=-
time.slip_tolerance : 0.01 | 0.2 : time.substeps=-
contact.restitution : 0 | 0.5 : motion.scale=6; sliding.lift_off="ballistic"
combination[].k_h : 0.05 | 0.1 : combination[].name="x"
combination[].k_profile_m : [[0,1]] | [[0,0],[30,1.5]] : combination[].name="x"; combination[].k_h=0.1
combination[].friction_divisor : 1 | 1.5 : combination[].name="x"
combination[].cohesion_divisor : 1 | 3.6 : combination[].name="x"; contact.cohesion_kPa=50
)";

struct Case {
    std::string key, first, second;
    std::vector<std::pair<std::string, std::string>> needs;
};

std::string trimmed(const std::string& text)
{
    const std::size_t from = text.find_first_not_of(' ');
    return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(' ') - from + 1);
}

std::vector<std::string> parts_of(const std::string& text, const std::string& between)
{
    std::vector<std::string> parts;
    std::size_t from = 0;
    for (std::size_t at; (at = text.find(between, from)) != std::string::npos; from = at + between.size())
        parts.push_back(trimmed(text.substr(from, at - from)));
    parts.push_back(trimmed(text.substr(from)));
    return parts;
}

std::vector<Case> all_cases()
{
    std::vector<Case> list;
    std::istringstream lines(cases);
    for (std::string line; std::getline(lines, line);) {
        if (line.empty()) continue;
        const std::vector<std::string> parts = parts_of(line, " : "), values = parts_of(parts[1], " | ");
        Case& c = list.emplace_back(Case{parts[0], values[0], values[1], {}});
        if (parts.size() < 3) continue;
        for (const std::string& need : parts_of(parts[2], ";")) {
            const std::size_t equals = need.find('=');
            c.needs.emplace_back(trimmed(need.substr(0, equals)), trimmed(need.substr(equals + 1)));
        }
    }
    return list;
}

Tables scene_of(const Case& c, const std::string& value)
{
    Tables tables = small_dam();
    for (const auto& [key, needed] : c.needs) set(tables, key, needed);
    if (value != "none") set(tables, c.key, value);
    return tables;
}

/// Numbers of an answer: without those of other methods, and without times.
Json numbers(const Json& j)
{
    if (j.is_array()) {
        Json out = Json::array();
        for (const Json& item : j) out.push_back(numbers(item));
        return out;
    }
    if (!j.is_object()) return j;
    Json out = Json::object();
    for (const auto& [key, value] : j.items())
        if (key.find("seconds") == std::string::npos && key.find("rigid") == std::string::npos && key != "verdict")
            out[key] = numbers(value);
    return out;
}

/// The key's place in the table of keys: "anchor[].area_m2_m" -> anchor, area.
std::pair<std::string, std::string> table_and_key(std::string path)
{
    if (const std::size_t list = path.find("[]"); list != std::string::npos) path.erase(list, 2);
    const std::size_t dot = path.rfind('.');
    const std::string table = path.substr(0, dot), written = path.substr(dot + 1);
    SectionInput section;
    for (const KeyGroup& group : key_groups(section))
        for (const Key& key : group.keys)
            if (group.name == table)
                for (const std::string& spelling : key.spellings())
                    if (spelling == written) return {table, key.name};
    ADD_FAILURE() << "no such key: " << path;
    return {};
}

class Audit3Keys : public KeyScene {
protected:
    /// What each method answers; a method that refuses the scene is not in it.
    std::map<Methods, std::string> answers(const Tables& tables) const
    {
        std::map<Methods, std::string> found;
        const auto ask = [&](std::vector<std::string> command, const Tables& scene,
                             const std::vector<std::pair<Methods, std::vector<const char*>>>& sections) {
            command.emplace_back("--json");
            const ProgramAnswer answer = run(std::move(command), toml_of(scene));
            if (answer.code != 0 && answer.code != 4) return;
            const Json j = numbers(Json::parse(answer.out));
            for (const auto& [method, keys] : sections)
                for (const char* key : keys) found[method] += j.contains(key) ? j[key].dump() : "";
        };
        ask({"screen", "--rigid-only", "--response-spectrum"}, tables,
            {{methods::rigid, {"displacements", "planes"}},
             {methods::equilibrium, {"limit_equilibrium", "verdicts"}},
             {methods::regressions, {"regressions"}},
             {methods::spectrum, {"response_spectrum"}}});
        Tables flexible = tables;
        if (std::none_of(tables.begin(), tables.end(), [](const auto& t) { return t.first == "flexible_block"; }))
            set(flexible, "flexible_block.period_s", "0.3");
        ask({"screen", "--rigid-only"}, flexible, {{methods::flexible, {"flexible_block"}}});
        ask({"fe", "--no-mesh-error"}, tables, {{methods::fe, {"slip", "stages", "runs"}}});
        ask({"fe", "--reduced", "--no-mesh-error"}, tables, {{methods::reduced, {"stages", "runs"}}});
        ask({"modes"}, tables, {{methods::modes, {"modes", "damping"}}});
        return found;
    }
    Tables asking(const std::string& key, const std::string& value,
                  const std::vector<std::pair<std::string, std::string>>& needs = {}) const
    {
        return scene_of({key, value, value, needs}, value);
    }
};

/// Pairs that this walk cannot see, each with its reason.
Methods out_of_sight(const std::string& key)
{
    if (key == "motion.polarity") return methods::rigid | methods::flexible; // `screen` runs both; A12 has `sweep`
    if (key == "ice.level_m" || key == "force[].x_m" || key == "force[].y_m")
        return methods::rigid; // matter to a block that tips
    if (key == "sliding.run_out_max_s") return methods::rigid; // it rests before the record ends; sabotage.run_out_off has it
    if (key.starts_with("seam") || key == "foundation.ground_m" || key == "foundation.k0")
        return methods::fe; // a plain `fe` slides on the base; fe_seam_test has `fe --plane`
    if (key == "time.stepping") return methods::reduced; // its steps are all alike: it refuses "adaptive", of the others it takes both
    if (key == "regressions.period_s") return methods::flexible;            // the scene states flexible_block.period_s
    return 0;
}

/// Every key of a scene that matters, by every method: what the table calls honoured changes the answer, and nothing else
/// does. A method that is not named may refuse the key.
class Audit3KeyWalk : public Audit3Keys, public testing::WithParamInterface<std::size_t> {};

constexpr std::size_t parts_of_the_walk = 6;

TEST_P(Audit3KeyWalk, A1_EveryKeyByEveryMethod)
{
    const std::vector<Case> every = all_cases();
    for (std::size_t i = GetParam(); i < every.size(); i += parts_of_the_walk) {
        const Case& c = every[i];
        const auto [table, key] = table_and_key(c.key);
        const Methods honoured = honoured_by(table, key);
        const auto first = answers(scene_of(c, c.first)), second = answers(scene_of(c, c.second));
        for (Methods method = 1; method <= methods::modes; method <<= 1) {
            const bool answered = first.contains(method) && second.contains(method);
            const std::string what = c.key + " = " + c.first + " | " + c.second + " by " + method_words(method);
            if (out_of_sight(c.key) & method)
                continue;
            else if (honoured & method)
                EXPECT_TRUE(!answered || first.at(method) != second.at(method)) << what << ": the same answer";
            else
                EXPECT_TRUE(!answered || first.at(method) == second.at(method)) << what << ": not in the table";
        }
        EXPECT_TRUE(honoured) << c.key;
    }
}

INSTANTIATE_TEST_SUITE_P(part, Audit3KeyWalk, testing::Range<std::size_t>(0, 1));
INSTANTIATE_TEST_SUITE_P(Thorough, Audit3KeyWalk, testing::Range<std::size_t>(1, parts_of_the_walk));

/// No number of a scene is one that nothing computes with.
TEST_F(Audit3Keys, A1_EveryNumberIsHonouredBySomeMethod)
{
    SectionInput section;
    for (const KeyGroup& group : key_groups(section))
        for (const Key& key : group.keys)
            if (!key.units.empty()) {
                EXPECT_NE(honoured_by(group.name, key.name), 0u) << group.name << "." << key.name;
            }
}

/// What a method leaves out is named beside its slip, and no PASS rests on it: in the terminal, the JSON and the page.
TEST_F(Audit3Keys, A1_WhatIsLeftOutIsNamedAndGivesNoPass)
{
    struct Ask {
        const char *command, *key, *value;
        std::vector<std::pair<std::string, std::string>> needs;
        const char* named;
    };
    const Ask list[]{
        {"screen", "lift_joint[].friction", "0.8", {{"lift_joint[].elevation_m", "15"}}, "[[lift_joint]] is not in"},
        {"screen", "contact.bond", "\"pairs\"", {{"contact.cohesion_kPa", "50"}}, "contact.bond is not in the slip"},
        {"screen", "uplift.opening", "\"reynolds\"", {}, "uplift.opening = \"reynolds\" is not in"},
        {"screen", "contact.restitution", "0.5", {}, "contact.restitution is not in the slip"},
        {"screen", "added_mass.period_s", "\"dam\"", {}, "added_mass.period_s = \"dam\" is not in"},
        {"fe", "uplift.crack", "\"static\"", {}, "uplift.crack is not in the slip of the finite elements"},
        {"fe", "sliding.two_way", "false", {}, "sliding.two_way = false is not in the slip"},
    };
    const auto verdicts = [](const Json& j) {
        std::string all;
        for (const char* rows : {"runs", "displacements"})
            if (j.contains(rows))
                for (const Json& row : j[rows]) all += row["verdict"].get<std::string>() + " ";
        return all;
    };
    for (const Ask& ask : list) {
        Tables without = asking("contact.friction", "1.2", ask.needs), with = without;
        for (Tables* tables : {&without, &with}) {
            set(*tables, "time.substeps", "-");
            set(*tables, "motion.scale", "0.6");
        }
        set(with, ask.key, ask.value);
        const std::string out = (folder / "out").string();
        std::vector<std::string> command{ask.command, "--out", out};
        if (std::string(ask.command) == "fe") command.emplace_back("--no-mesh-error");
        const Json j = json(command, toml_of(with));
        EXPECT_NE(j.dump().find(Json(ask.named).dump().substr(1, std::string(ask.named).size())), std::string::npos)
            << ask.key;
        EXPECT_EQ(verdicts(j).find("PASS"), std::string::npos) << ask.key << " " << verdicts(j);
        if (ask.needs.empty()) {
            const char* holds = std::string(ask.command) == "fe" ? "PASS" : "below"; // of a block alone
            EXPECT_NE(verdicts(json(command, toml_of(without))).find(holds), std::string::npos) << ask.key;
        }
        const ProgramAnswer text = run(command, toml_of(with));
        EXPECT_NE((text.out + text.talk).find(ask.named), std::string::npos) << text.out;
        EXPECT_NE((text.out + text.talk).find("No PASS rests on that slip."), std::string::npos) << ask.key;
    }
}

TEST_F(Audit3Keys, A1_SweepAndFragilityNameWhatIsLeftOut)
{
    const Tables dam = asking("sliding.two_way", "false", {{"lift_joint[].elevation_m", "15"}, {"lift_joint[].friction", "0.8"}});
    const ProgramAnswer sweep = run({"sweep", "--friction", "0.8", "--method", "rigid,fe"}, toml_of(dam));
    EXPECT_NE((sweep.out + sweep.talk).find("[[lift_joint]] is not in the slip"), std::string::npos) << sweep.talk;
    EXPECT_NE((sweep.out + sweep.talk).find("sliding.two_way = false is not in the slip"), std::string::npos);
}

TEST_F(Audit3Keys, A1_RegressionsNameWhatTheyDoNotKnow)
{
    const Json j = json({"screen"}, toml_of(asking("contact.residual_friction", "0.6")));
    EXPECT_NE(j.dump().find("contact.residual_friction is not in the slip of the regressions"), std::string::npos);
    EXPECT_EQ(json({"screen"}, toml_of(small_dam())).dump().find("slip of the regressions"), std::string::npos);
}

/// 45 degrees are a friction of 1, and what rock weighs is said.
TEST_F(Audit3Keys, A7_ResolvedSceneIsWhatWasComputedWith)
{
    Tables dam = asking("contact.friction", "-", {{"contact.friction_deg", "45"}, {"foundation.young_modulus_GPa", "20"}});
    for (const auto& [name, value] : std::map<std::string, std::string>{{"motion.record[].vertical", "-"}})
        set(dam, name, value);
    write_file(folder / "dam.toml", toml_of(dam));
    const Scene scene = read_scene(folder / "dam.toml");
    EXPECT_EQ(scene.contact.friction, 1.0);
    const std::string resolved = resolved_toml(scene);
    EXPECT_NE(resolved.find("\nfriction = 1.0\n"), std::string::npos);
    EXPECT_NE(resolved.find("\ndensity_kg_m3 = 2650.0\n"), std::string::npos) << resolved;
    write_file(folder / "again.toml", resolved);
    EXPECT_EQ(resolved_toml(read_scene(folder / "again.toml")), resolved);
}

/// Numbers in other units are the doubles that their values in SI are: 3 mm and 0.003 m, 0.3 g and 2.941995 m/s2.
TEST_F(Audit3Keys, D8_OtherUnitsGiveTheBitsOfTheirTwins)
{
    std::mt19937 random(7);
    const std::map<double, std::pair<std::uint64_t, int>> factors{
        {1e-6, {1, -6}},      {1e-3, {1, -3}},       {1e-2, {1, -2}},        {0.3048, {3048, -4}}, {0.0254, {254, -4}},
        {9.80665, {980665, -5}}, {1e3, {1, 3}},      {1e6, {1, 6}},          {1e9, {1, 9}},        {1.0, {1, 0}}};
    SectionInput section;
    std::size_t seen = 0;
    for (const KeyGroup& group : key_groups(section))
        for (const Key& key : group.keys)
            for (const UnitSuffix& unit : key.units) {
                const auto factor = factors.find(unit.factor);
                if (unit.tangent || factor == factors.end()) continue;
                ++seen;
                const auto [digits, exponent] = factor->second;
                for (int i = 0; i < 40; ++i) {
                    const std::uint64_t written = random() % 1000000;
                    const int shift = -static_cast<int>(random() % 7);
                    const double x = std::stod(fmt::format("{}e{}", written, shift)),
                                 twin = std::stod(fmt::format("{}e{}", written * digits, shift + exponent));
                    ASSERT_EQ(to_si(x, unit), twin) << group.name << "." << key.name << "_" << unit.suffix << " " << x;
                    ASSERT_EQ(to_si(-x, unit), -twin);
                }
            }
    EXPECT_GT(seen, 200u);
    const UnitSuffix degrees{"deg", 1.0, true};
    EXPECT_EQ(to_si(45, degrees), 1.0);
    EXPECT_EQ(to_si(0, degrees), 0.0);
    EXPECT_EQ(to_si(30, degrees), 0.57735026918962576451);
    EXPECT_EQ(to_si(60, degrees), 1.7320508075688772935);
    EXPECT_EQ(to_si(35, degrees), 0.70020753820970977946);
}

TEST_F(Audit3Keys, D10_HashDoesNotDependOnTheFileName)
{
    write_file(folder / "one.toml", toml_of(small_dam()));
    write_file(folder / "two.toml", toml_of(small_dam()));
    EXPECT_EQ(scene_hash(read_scene(folder / "one.toml")), scene_hash(read_scene(folder / "two.toml")));
    EXPECT_NE(scene_hash(read_scene(folder / "one.toml")),
              (write_file(folder / "two.toml", toml_of(asking("contact.friction", "0.81"))),
               scene_hash(read_scene(folder / "two.toml"))));
}

/// One hash of the input in every command, whatever was chosen for it; what was chosen has a hash of its own.
TEST_F(Audit3Keys, A6_OneHashInEveryCommand)
{
    Tables dam = small_dam();
    set(dam, "reservoir.model", "\"auto\"");
    set(dam, "motion.vertical", "false");
    set(dam, "contact.cohesion_kPa", "0");
    const std::string toml = toml_of(dam);
    const auto hash = [&](std::vector<std::string> command, const char* key = "hash") {
        return json(std::move(command), toml)["scene"][key].get<std::string>();
    };
    const std::string of_screen = hash({"screen"});
    EXPECT_EQ(of_screen, scene_hash(read_scene(folder / "dam.toml")));
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"fe", "--no-mesh-error"},
          {"fe", "--reduced", "--no-mesh-error"},
          {"fe", "--base", "tied"},
          {"modes"},
          {"mesh"},
          {"explain"},
          {"explain", "--method", "fe"},
          {"sweep", "--friction", "0.8"}})
        EXPECT_EQ(hash(command), of_screen) << command.front();
    EXPECT_NE(hash({"fe", "--no-mesh-error"}, "resolved_hash"), of_screen);
}

/// Ice is in the response-spectrum level as in the slips.
TEST_F(Audit3Keys, A1_IceInTheResponseSpectrum)
{
    const auto factor = [&](const char* force) {
        return json({"screen", "--response-spectrum"}, toml_of(asking("ice.force_kN_m", force)))["response_spectrum"]
                   ["static_sliding_factor"]
                       .get<double>();
    };
    EXPECT_LT(factor("100"), factor("0"));
}

} // namespace

} // namespace damslip::audit3
