// `damslip explain --ablate`: the scenes it makes, what it says of their runs, and that it says so again.
#include "analysis/ablation/ablation.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"
#include "source_dir.hpp"
#include "sweep_scene.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace {

using namespace damslip;
using sweep_tests::Answer;
using sweep_tests::content_of;
using sweep_tests::SweepScene;

/// Everything a scene can hold at once: rock, curtain, drains, seepage, acoustic water on a moving, absorbing bottom ...
const std::string rich_text = R"(
[section]
height_m = 62.5
base_m = 45
crest_m = 12
neck_m = 11
base_inclination_deg = 2
[dam]
density_kg_m3 = 2500
young_modulus_GPa = 25
[foundation]
young_modulus_GPa = 30
width_m = 300
depth_m = 100
mass = "massless"
[curtain]
distance_m = 7
depth_m = 30
young_modulus_GPa = 27
[drains]
distance_m = 10
[reservoir]
model = "acoustic"
surface = "sloshing"
bottom_reflection = 0.75
floor_pressure = true
[tailwater]
level_m = 5
[silt]
level_m = 10
submerged_unit_weight_kN_m3 = 9
pressure_coefficient = 0.5
[ice]
force_kN_m = 100
[uplift]
model = "seepage"
[contact]
friction = 0.9
cohesion_kPa = 50
residual_friction = 0.8
enforcement = "slip-tolerance"
[[lift_joint]]
elevation_m = 51.5
friction = 0.8
water = "linear"
[[force]]
name = "anchor"
x_m = 6
y_m = 62.5
force_y_kN_m = -10
[[combination]]
name = "flood"
tailwater_level_m = 8
ice = true
[[motion.record]]
horizontal = "h.csv"
vertical = "v.csv"
)";

/// Effects that the rich scene excludes: finite sliding (no lift joints), uplift by the printed rule, a crack ...
const std::string other_text = R"(
[section]
height_m = 62.5
base_m = 45
crest_m = 12
[dam]
density_kg_m3 = 2500
young_modulus_GPa = 25
[foundation]
young_modulus_GPa = 30
width_m = 300
depth_m = 100
mass = "massless"
[mesh]
rock_contact_size_m = 1.5
[stages]
pore_pressure = "total"
[curtain]
distance_m = 7
depth_m = 30
[reservoir]
model = "added-mass"
[added_mass]
period_s = 0.5
[uplift]
model = "curtain"
crack = "static"
[sliding]
lift_off = "ballistic"
[contact]
friction = 0.9
friction_table_m = [[0, 0.9], [0.01, 0.8]]
sliding = "finite"
max_slip_m = 3
[[motion.record]]
horizontal = "h.csv"
vertical = "v.csv"
)";

/// Waves in the rock, which neither finite sliding nor an inclined base goes with.
const std::string wave_text = R"(
[section]
height_m = 62.5
base_m = 45
crest_m = 12
[dam]
density_kg_m3 = 2500
young_modulus_GPa = 25
[foundation]
young_modulus_GPa = 30
density_kg_m3 = 2650
mass = "with-mass"
boundary = "viscous"
[contact]
friction = 0.9
[[motion.record]]
horizontal = "h.csv"
)";

Scene parsed(const std::string& text)
{
    return parse_scene(text, "rich.toml", FileCheck::skip);
}

std::vector<Point> any_profile()
{
    return {{0.0, 1.0}, {10.0, 0.5}, {45.0 / std::cos(2.0 * std::acos(-1.0) / 180.0), 0.1}};
}

AblationPlan ablations_of(const std::string& text, Method method)
{
    return make_ablations(parsed(text), method, any_profile());
}

/// A dam, and joints of it with a law each.
const std::string joint_text = R"(
section = { height_m = 30, base_m = 24, crest_m = 5 }
dam = { density_kg_m3 = 2400, young_modulus_GPa = 28 }
reservoir = { level_m = 29, model = "added-mass" }
)";
const std::vector<std::string> joint_texts{
    "uplift = { model = \"linear\" }\n"
    "contact = { friction = 0.8, cohesion_kPa = 300, fracture_energy_shear_N_m = 1500 }\n",
    "uplift = { model = \"linear\" }\ncontact = { friction = 0.8 }\n"
    "[[anchor]]\ndistance_m = 3\nfree_length_m = 20\narea_m2_m = 0.001\nyield_strength_MPa = 1500\n",
    "uplift = { model = \"linear\", opening = \"full\", after = \"full\" }\ncontact = { friction = 0.8 }\n",
    "uplift = { model = \"linear\" }\ncontact = { friction = 0.8, kinetic_friction_ratio = 0.8, "
    "characteristic_rate_m_s = 0.01, "
    "relaxation_time_s = 0.05, restitution = 0.3 }\nsliding = { lift_off = \"ballistic\" }\n"
    "[motion]\nsequence = [\"a\", \"b\"]\n[[motion.record]]\nname = \"a\"\nhorizontal = \"a.csv\"\n"
    "[[motion.record]]\nname = \"b\"\nhorizontal = \"b.csv\"\n"};

TEST(Ablation, EveryActiveEffectOnceAndNoAbsentOne)
{
    for (const std::string& text : {rich_text, other_text,
                                    std::string("[section]\npolygon_m = [[0, 0], [8, 0], [8, 2], [0, "
                                                "2]]\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.1\n")})
        for (const Method method : {Method::rigid_block, Method::finite_elements}) {
            std::vector<std::string> on, seen;
            for (const PlannedEffect& e : make_effect_plan(parsed(text), method).effects)
                if (e.on) on.push_back(e.name);
            const AblationPlan plan = ablations_of(text, method);
            for (const Ablation& a : plan.removals) {
                seen.push_back(a.name);
                EXPECT_FALSE(a.instead.empty()) << a.name;
            }
            for (const KeptEffect& k : plan.kept) {
                seen.push_back(k.name);
                EXPECT_FALSE(k.why.empty()) << k.name;
            }
            std::sort(on.begin(), on.end());
            std::sort(seen.begin(), seen.end());
            EXPECT_EQ(on, seen);
        }
    // 42 effects, of which each is on in one of the scenes by one of the two methods.
    std::vector<std::string> texts{rich_text, other_text, wave_text};
    for (const std::string& law : joint_texts) texts.push_back(joint_text + law);
    std::set<Effect> ever;
    for (const std::string& text : texts)
        for (const Method method : {Method::rigid_block, Method::finite_elements})
            for (const PlannedEffect& e : make_effect_plan(parsed(text), method).effects)
                if (e.on) ever.insert(e.effect);
    EXPECT_EQ(ever.size(), make_effect_plan(parsed(rich_text), Method::rigid_block).effects.size());
}

// A removed effect is off in the plan of its scene; incompressible acoustic water still has a bulk modulus, and
// lift-off without flight is still lift-off.
// The others stay on, but for those that are part of the removed one.
TEST(Ablation, RemovalTurnsOffItsEffectAndNoOther)
{
    for (const std::string& text : {rich_text, other_text, wave_text})
        for (const Method method : {Method::rigid_block, Method::finite_elements}) {
            const AblationPlan plan = ablations_of(text, method);
            for (const Ablation& a : plan.removals) {
                SCOPED_TRACE(a.name);
                const EffectPlan after = make_effect_plan(a.scene, method);
                const bool stiff_water =
                    a.effect == Effect::water_compressibility && a.scene.reservoir->model == ReservoirModel::acoustic;
                EXPECT_EQ(after.on(a.effect), stiff_water || a.effect == Effect::lift_off);
                for (const Ablation& other : plan.removals) {
                    const bool goes_with_it =
                        other.part_of == a.effect || a.effect == Effect::vertical_motion ||
                        (a.effect == Effect::seepage && (other.effect == Effect::curtain_sealing ||
                                                         other.effect == Effect::drains)) || // the printed profile reads none
                        (a.effect == Effect::rock_flexibility &&
                         (other.part_of == Effect::uplift || other.part_of == Effect::rock_inertia));
                    EXPECT_TRUE(other.effect == a.effect || goes_with_it || after.on(other.effect)) << other.name;
                }
            }
        }
}

// Whoever doubts a row can run its scene: every one is what a file can hold, and passes the checks of a file.
TEST(Ablation, EveryRemovalIsASceneThatAFileCanHold)
{
    for (const std::string& text : {rich_text, other_text, wave_text})
        for (const Method method : {Method::rigid_block, Method::finite_elements}) {
            const AblationPlan plan = ablations_of(text, method);
            std::vector<std::pair<std::string, Scene>> scenes{{"all removed", *plan.simplest}};
            for (const Ablation& a : plan.removals) scenes.emplace_back(a.name, a.scene);
            for (const auto& [name, scene] : scenes) {
                SCOPED_TRACE(name);
                std::string back;
                ASSERT_NO_THROW(back = scene_hash(parsed(resolved_toml(scene))));
                EXPECT_EQ(back, scene_hash(scene));
                EXPECT_NE(back, scene_hash(plan.full));
            }
        }
}

// Slips with an error of first order, s(dt) = s0 + c dt: the estimate is that error, whichever the other step is.
TEST(Ablation, StepErrorIsExactForFirstOrder)
{
    const auto slip = [](int halvings) { return 0.2 + 0.03 * std::exp2(-halvings); };
    EXPECT_NEAR(difference_error({3, 2, true, 0.0}, slip(3), slip(2)), slip(3) - 0.2, 1e-15);
    EXPECT_NEAR(difference_error({0, 1, false, 0.0}, slip(0), slip(1)), slip(0) - 0.2, 1e-15);
}

TEST(Ablation, ChangeWithoutASlipOnEitherSideIsNone)
{
    EXPECT_FALSE(change_from(1.0, std::nullopt).change);
    EXPECT_FALSE(change_from(std::nullopt, 1.0).change);
    EXPECT_DOUBLE_EQ(*change_from(-2.0, 1.0).percent, 150.0); // of the size of the full scene's
    EXPECT_FALSE(change_from(0.0, 1.0).percent);
    EXPECT_DOUBLE_EQ(*change_from(0.0, 1.0).change, 1.0);
}

/// The scene of the sweep tests with its own ablations.
class AblateScene : public SweepScene {
protected:
    Answer ablate(const std::string& file, const std::vector<std::string>& more) const
    {
        return answer_of(with({"explain", file, "--ablate", "--json"}, more));
    }
    /// Without what differs from call to call.
    static nlohmann::json without_seconds(const Answer& a)
    {
        nlohmann::json j = nlohmann::json::parse(a.out);
        j["ablation"].erase("seconds");
        return j;
    }
    static nlohmann::json row(const nlohmann::json& j, const std::string& effect, std::size_t record = 0)
    {
        std::size_t found = 0;
        for (const auto& r : j["ablation"]["changes"])
            if (r["effect"] == effect && found++ == record) return r;
        ADD_FAILURE() << "no row " << effect;
        return {};
    }
    /// The text of block.toml with one piece replaced by another, as a file of its own.
    std::string edited(const std::string& name, const std::string& text, const std::string& old,
                       const std::string& now) const
    {
        std::string copy = text;
        const std::size_t at = copy.find(old);
        EXPECT_NE(at, std::string::npos) << old;
        copy.replace(at, old.size(), now);
        write(name, copy);
        return path(name);
    }
};

/// Everything but the seconds, to the last bit, at every call and with any number of threads.
TEST_F(AblateScene, EveryExampleGivesTheSameTableAgain)
{
    std::size_t examples = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(source_dir()) + "/examples")) {
        if (entry.path().extension() != ".toml" || entry.path().filename() == "rock_wedge.toml") continue; // no section
        SCOPED_TRACE(entry.path().filename().string());
        const std::vector<std::string> short_record{"--record", path("pulse.csv"), "--vertical", path("late.csv")};
        const Answer once = ablate(entry.path().string(), short_record),
                     again = ablate(entry.path().string(), short_record),
                     two = ablate(entry.path().string(), with(short_record, {"--jobs", "2"}));
        ASSERT_EQ(once.code, 0) << once.talk;
        EXPECT_EQ(without_seconds(once).dump(), without_seconds(again).dump());
        EXPECT_EQ(without_seconds(once).dump(), without_seconds(two).dump());
        EXPECT_GE(without_seconds(once)["ablation"]["changes"].size(), 3u);
        ++examples;
    }
    EXPECT_GE(examples, 10u);
}

TEST_F(AblateScene, FiniteElementTableIsTheSameAgain)
{
    const std::string file = path("block.toml");
    const Answer once = ablate(file, {"--method", "fe"}), again = ablate(file, {"--method", "fe"}),
                 two = ablate(file, {"--method", "fe", "--jobs", "2"});
    ASSERT_EQ(once.code, 0) << once.talk;
    EXPECT_EQ(without_seconds(once).dump(), without_seconds(again).dump());
    EXPECT_EQ(without_seconds(once).dump(), without_seconds(two).dump());
    EXPECT_EQ(nlohmann::json::parse(two.out)["ablation"]["seconds"]["jobs"], 2);
}

// Rows of the FE table against `damslip fe` on scenes edited by hand, to the last digits of a slip in mm: the table's scenes,
// records, step and water are those of a run by itself.
TEST_F(AblateScene, FiniteElementRowsAreThoseOfScenesEditedByHand)
{
    write("up.csv", "time_s,accel_m_s2\n0,0\n1,-1.5\n2,1\n3,0\n");
    const std::string text =
        "[section]\npolygon_m = [[0, 0], [8, 0], [6, 4], [0, 4]]\n[dam]\ndensity_kg_m3 = 2500\nyoung_modulus_GPa = 25\n"
        "[foundation]\nyoung_modulus_GPa = 30\nwidth_m = 32\ndepth_m = 16\nmass = \"massless\"\n"
        "[contact]\nfriction = 0.25\n[reservoir]\nlevel_m = 3\nmodel = \"acoustic\"\nbottom_reflection = 0.7\n"
        "[uplift]\nmodel = \"linear\"\n[damping]\nratio = 0.05\n[mesh]\nsize_m = 1\ncontact_size_m = 1\n[time]\n"
        "dt_s = 0.02\nsubsteps = 1\n"
        "[[motion.record]]\nhorizontal = \"pulse.csv\"\nvertical = \"up.csv\"\n"
        "[[motion.record]]\nhorizontal = \"late.csv\"\n";
    write("dam.toml", text);
    const Answer table = ablate(path("dam.toml"), {"--method", "fe"});
    ASSERT_EQ(table.code, 0) << table.talk;
    const nlohmann::json j = nlohmann::json::parse(table.out);
    const auto compare = [&](const std::string& effect, const std::string& file) {
        SCOPED_TRACE(effect);
        const auto runs = nlohmann::json::parse(answer_of({"fe", file, "--json"}).out)["runs"];
        ASSERT_EQ(runs.size(), 4u); // two records, both polarities
        for (std::size_t r = 0; r < runs.size(); ++r) {
            ASSERT_TRUE(row(j, effect, r)["slip_mm"].is_number()) << row(j, effect, r);
            EXPECT_DOUBLE_EQ(row(j, effect, r)["slip_mm"].get<double>(), runs[r]["slip_mm"].get<double>());
        }
        if (effect == "(all effects)") return;
        const double full = row(j, "(all effects)")["slip_mm"].get<double>();
        EXPECT_NEAR(row(j, effect)["change_mm"].get<double>(), runs[0]["slip_mm"].get<double>() - full, 1e-12 * full);
    };
    EXPECT_GT(row(j, "(all effects)")["slip_mm"].get<double>(), 1.0);
    const auto without = [&](const std::string& old, const std::string& now) {
        return edited("edited.toml", text, old, now);
    };
    compare("(all effects)", path("dam.toml"));
    compare("uplift", without("model = \"linear\"", "model = \"none\""));
    compare("acoustic water", without("model = \"acoustic\"", "model = \"added-mass\""));
    compare("bottom absorption", without("bottom_reflection = 0.7", "bottom_reflection = 1"));
    compare("vertical motion", without("\nvertical = \"up.csv\"", ""));
    compare("rock flexibility",
            without("[foundation]\nyoung_modulus_GPa = 30\nwidth_m = 32\ndepth_m = 16\nmass = \"massless\"\n", ""));
    compare("structural damping", without("ratio = 0.05", "method = \"none\""));
    compare("separation", without("friction = 0.25", "friction = 0.25\nseparation = \"none\""));
    for (const std::string effect :
         {"uplift", "acoustic water", "bottom absorption", "vertical motion", "rock flexibility"})
        EXPECT_NE(row(j, effect)["change_mm"].get<double>(), 0.0) << effect;
    for (const std::size_t late : {2u, 3u}) // both polarities of the record without a vertical component
        EXPECT_EQ(row(j, "vertical motion", late)["change_mm"].get<double>(), 0.0); // the second record has none
}

// Rows of the rigid table against `damslip screen` on scenes edited by hand.
TEST_F(AblateScene, RigidRowsAreThoseOfScenesEditedByHand)
{
    const std::string text = content("block.toml");
    const nlohmann::json j = nlohmann::json::parse(ablate(path("block.toml"), {}).out);
    const auto compare = [&](const std::string& effect, const std::string& file) {
        const auto screened = nlohmann::json::parse(answer_of({"screen", file, "--json"}).out);
        double slip = -1.0;
        for (const auto& r : screened["displacements"])
            if (r["record"] == "pulse" && r["polarity"] == 1) slip = r["slip_h_mm"].get<double>();
        EXPECT_EQ(row(j, effect)["slip_mm"].get<double>(), slip) << effect;
    };
    compare("(all effects)", path("block.toml"));
    compare("uplift", edited("edited.toml", text, "model = \"linear\"", "model = \"none\""));
    compare("hydrodynamic added mass",
            edited("edited.toml", text, "model = \"added-mass\"", "model = \"hydrostatic\""));
    EXPECT_LT(row(j, "uplift")["change_mm"].get<double>(), 0.0);
    EXPECT_LT(row(j, "hydrodynamic added mass")["change_mm"].get<double>(), 0.0);
}

// Cohesion alone holds this block: without it there is no equilibrium before the earthquake, and the row says so.
TEST_F(AblateScene, RowWithoutEquilibriumSaysSo)
{
    const std::string text = content("block.toml");
    const std::string file =
        edited("held.toml", text, "friction = 0.1", "friction = 0.005\ncohesion_kPa = 2000"); // it never breaks
    for (const std::string method : {"rigid", "fe"}) {
        const Answer a = ablate(file, {"--method", method});
        ASSERT_EQ(a.code, 0) << a.talk; // a recognised static failure is an answer
        const nlohmann::json r = row(nlohmann::json::parse(a.out), "cohesion");
        EXPECT_EQ(r["status"], "static failure");
        EXPECT_TRUE(r["slip_mm"].is_null());
        EXPECT_TRUE(r["change_mm"].is_null());
        EXPECT_NE(r["remark"].get<std::string>().find(method == "fe" ? "0.01250" : "0.01389"), std::string::npos)
            << r["remark"]; // critical mu; the FE stage without uplift fails first
        const auto answer = nlohmann::json::parse(a.out);
        EXPECT_TRUE(row(answer, "(sum of changes)")["change_mm"].is_null());
        for (const auto& scene : answer["ablation"]["seconds"]["scenes"])
            EXPECT_EQ(scene["saved_seconds"].is_null(), scene["effect"] == "cohesion" ||
                                                            scene["effect"] == "(all effects)" ||
                                                            scene["effect"] == "(all removed)")
                << scene; // without cohesion the earthquake is not run
    }
}

TEST_F(AblateScene, ReportHoldsEveryRow)
{
    const Answer a = ablate(path("block.toml"), {"--report", path("page.html")});
    ASSERT_EQ(a.code, 0) << a.talk;
    EXPECT_NE(a.talk.find("report: "), std::string::npos);
    const std::string page = content("page.html");
    for (const std::string effect : {"uplift", "hydrodynamic added mass", "upstream sliding", "run-out"})
        EXPECT_NE(page.find(">" + effect + "</text>"), std::string::npos) << effect;
}

} // namespace
