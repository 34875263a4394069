#include "analysis/screen/screening.hpp"
#include "core/input_error.hpp"
#include "core/units.hpp"
#include "pages/scene/scene_pages.hpp"
#include "program_answer.hpp"
#include "scene/read.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"
#include "scene/write.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"
#include "without_breaks.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <unistd.h>

/// Limit equilibrium and screening: what they may not say.
namespace damslip::sliding::audited {
namespace {

constexpr double g = 9.81, rho = 1000.0, concrete = 2500.0; // of the scenes below [m/s^2], [kg/m^3]

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

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

const Equilibrium& state_named(const std::vector<Equilibrium>& all, const std::string& name)
{
    const auto at = std::find_if(all.begin(), all.end(), [&](const Equilibrium& e) { return e.name == name; });
    EXPECT_NE(at, all.end()) << name;
    return at == all.end() ? all.front() : *at;
}

/// A rectangle 6 m wide and 10 m high without water.
const std::string dry_block = "[section]\npolygon_m = [[0, 0], [6, 0], [6, 10], [0, 10]]\n[dam]\ndensity_kg_m3 = 2500\n"
                              "[contact]\nfriction = 0.7\n";

/// A triangle 45 m wide and 62.5 m high, full, with the simplified added mass 7/12 rho h^2 at 0.4 h.
const std::string triangle = "[section]\npolygon_m = [[0, 0], [45, 0], [0, 62.5]]\n[dam]\ndensity_kg_m3 = 2500\n"
                             "[contact]\nfriction = 0.77\n[reservoir]\nlevel_m = 62.5\nmodel = \"added-mass\"\n"
                             "[added_mass]\nformula = \"westergaard-simplified\"\n";

constexpr double base = 45.0, height = 62.5;
/// Moment about the triangle's toe of weight less water [N m/m], and of inertia and water per a_h [kg m/m].
double holding_moment()
{
    return concrete * g * base * height / 2 * (2.0 / 3.0 * base) - rho * g * std::pow(height, 3) / 6;
}
double moment_per_acceleration()
{
    return concrete * base * height / 2 * height / 3 + 7.0 / 12.0 * rho * height * height * 0.4 * height;
}

/// A folder with a scene and a record: one triangular pulse of the given peak [m/s^2], up to 1/10 of it vertically.
class Folder {
public:
    explicit Folder(double peak)
    {
        static int count = 0;
        path = std::filesystem::temp_directory_path() /
               ("damslip_audit_equilibrium_" + std::to_string(::getpid()) + "_" + std::to_string(++count));
        std::filesystem::create_directories(path);
        const auto pulse = [&](const char* name, double a) {
            std::ofstream(path / name) << "time_s,accel_m_s2\n0,0\n0.2," << a << "\n0.4,0\n0.6,0\n";
        };
        pulse("pulse.csv", peak);
        pulse("up.csv", 0.1 * peak);
    }
    ~Folder() { std::filesystem::remove_all(path); }
    ProgramAnswer run(const std::string& command, const std::string& scene, std::vector<std::string> more = {}) const
    {
        std::ofstream(path / "dam.toml") << scene
                                         << "[[motion.record]]\nhorizontal = \"pulse.csv\"\nvertical = \"up.csv\"\n";
        std::vector<std::string> arguments{command, (path / "dam.toml").string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return answer_of(arguments);
    }
    nlohmann::json screened(const std::string& scene) const
    {
        const ProgramAnswer a = run("screen", scene, {"--json"});
        EXPECT_EQ(a.code, 0) << a.talk;
        return a.code == 0 ? nlohmann::json::parse(a.out) : nlohmann::json{};
    }
    std::filesystem::path path;
};

bool says(const nlohmann::json& list, const std::string& part)
{
    return std::any_of(list.begin(), list.end(),
                       [&](const auto& s) { return has(s.template get<std::string>(), part); });
}

// A rectangle tips about its toe where the resultant of weight and inertia goes through it: a h/2 = g b/2.
TEST(Audit, A6_a_dry_rectangle_tips_at_g_b_over_h)
{
    const BaseLimits limits = base_limits(parsed(dry_block));
    EXPECT_NEAR(limits.tips, g * 6.0 / 10.0, 1e-12);
    EXPECT_NEAR(limits.tips_upstream, g * 6.0 / 10.0, 1e-12);
    EXPECT_NEAR(limits.opens, g * 6.0 / 10.0, 1e-9); // a joint without tension is open where the resultant leaves it
}

// About the toe: weight at 2b/3, water rho g h^3/6, inertia at h/3, added mass at 0.4 h; linear uplift rho g h b/2 at 2b/3.
TEST(Audit, A6_a_dam_with_water_tips_by_hand)
{
    const double uplift = rho * g * height * base / 2 * (2.0 / 3.0 * base);
    const double dry = holding_moment() / moment_per_acceleration();
    const double wet = (holding_moment() - uplift) / moment_per_acceleration();
    EXPECT_NEAR(base_limits(parsed(triangle + "[uplift]\nmodel = \"none\"\n")).tips, dry, 1e-11);
    EXPECT_NEAR(base_limits(parsed(triangle + "[uplift]\nmodel = \"linear\"\n")).tips, wet, 1e-11);
    ASSERT_LT(wet, dry);
}

// Full head p0 in what opens, linear uplift beyond: with l = L - T left, U = p0 (L - l/2), its moment about the toe
// p0 (L^2/2 - l^2/6), and l = 3 M'/N' becomes linear in a: l = 3 (M - a m - p0 L^2/2)/(N - p0 L). It is 0 at
// a = (M - p0 L^2/2)/m. Without a rule for what the earthquake opens, the uplift stays and the joint opens where it tips.
TEST(Audit, A6_the_base_opens_by_the_crack_rule)
{
    const double p0 = rho * g * height;
    const std::string linear = triangle + "[uplift]\nmodel = \"linear\"\ncrack = ";
    const BaseLimits full = base_limits(parsed(linear + "\"seismic-full\"\n"));
    EXPECT_NEAR(full.opens, std::max(0.0, holding_moment() - p0 * base * base / 2) / moment_per_acceleration(), 1e-9);
    const std::string low =
        "[section]\npolygon_m = [[0, 0], [45, 0], [0, 62.5]]\n[dam]\ndensity_kg_m3 = 2500\n[contact]\n"
        "friction = 0.77\n[reservoir]\nlevel_m = 40\nmodel = \"hydrostatic\"\n[uplift]\ncrack = ";
    const Scene scene = parsed(low + "\"seismic-full\"\n");
    const double mass = concrete * base * height / 2, p = rho * g * 40.0;
    const double by_hand = (mass * g * 2 / 3 * base - p * 40 * 40 / 6 - p * base * base / 2) / (mass * height / 3);
    ASSERT_GT(by_hand, 0.0);
    EXPECT_NEAR(base_limits(scene).opens, by_hand, 1e-9);
    EXPECT_LT(base_limits(scene).opens, base_limits(scene).tips);
    const BaseLimits unchanged = base_limits(parsed(low + "\"static\"\n"));
    EXPECT_NEAR(unchanged.opens, unchanged.tips, 1e-9);
}

// The dry rectangle, bonded: at a the resultant lies b/2 - a h/(2 g) from the toe, so that b' = 3 of that is closed (b at
// most), and it slides at m a = c b' + mu m g. Solved for a: (3 c b/2 + mu m g)/(m + 3 c h/(2 g)).
TEST(Audit, A6_the_bond_of_a_crack_is_lost)
{
    const std::string weak = "[section]\npolygon_m = [[0, 0], [6, 0], [6, 10], [0, 10]]\n[dam]\ndensity_kg_m3 = 2500\n"
                             "[contact]\nfriction = 0.3\ncohesion_kPa = 50\n";
    const Scene scene = parsed(weak);
    const double m = 2500 * 60, c = 50e3;
    const double by_hand = (1.5 * c * 6 + 0.3 * m * g) / (m + 1.5 * c * 10 / g);
    ASSERT_LT(by_hand, base_limits(scene).tips);
    ASSERT_LT(by_hand, yield_downstream(make_rigid_block(scene)).law.constant);
    EXPECT_NEAR(base_limits(scene).yield_with_crack, by_hand, 1e-9);
    // A motion between the two: the block with its whole bond does not slide, the one with the crack does.
    const double peak = 1.1 * by_hand; // its tenth upwards presses the joint together
    ASSERT_LT(peak, base_limits(scene).tips);
    const Folder folder(peak);
    const nlohmann::json j = folder.screened(weak + "[criteria]\nallowable_slip_mm = 5\n");
    for (const auto& row : j["displacements"]) {
        EXPECT_EQ(row["slip_h_mm"], 0.0);
        EXPECT_EQ(row["verdict"], "judged by rocking"); // it loses its bond with the crack
    }
    EXPECT_GT(j["rocking_block"][0]["max_slip_mm"].get<double>(), 0.0);
    for (const auto& row : j["rocking_block"]) {
        EXPECT_NE(row["verdict"], "undecided");
    }
    EXPECT_TRUE(says(j["warnings"], "with the crack that the same acceleration opens"));
    const Scene loose = parsed(dry_block); // no bond to lose, no water: the crack changes nothing
    const double yield = yield_downstream(make_rigid_block(loose)).law.constant;
    EXPECT_NEAR(base_limits(loose).yield_with_crack, yield, 1e-9 * yield);
}

const std::string bonded = "[section]\nheight_m = 62.5\nbase_m = 45\ncrest_m = 12\nneck_m = 11\n[dam]\n"
                           "density_kg_m3 = 2500\n[contact]\nfriction = 0.9\ncohesion_kPa = 1000\n[reservoir]\n"
                           "level_m = 60\nmodel = \"added-mass\"\n[uplift]\nmodel = \"linear\"\ncrack = \"static\"\n"
                           "[criteria]\nallowable_slip_mm = 50\n";

// The guidelines' ends of the dispute hold the water that needs time between them.
TEST(Audit, A6_rocking_with_a_mouth_lies_between_zero_and_full)
{
    const Folder strong(4.0);
    const auto slip_of = [&](const std::string& rule) {
        std::string text = bonded;
        text.insert(text.find("[criteria]"), rule);
        const nlohmann::json j = strong.screened(text);
        EXPECT_EQ(j["rocking_block"].size(), 2u) << rule;
        return j["rocking_block"][0]["max_slip_mm"].get<double>();
    };
    const double zero = slip_of("opening = \"zero\"\n"), full = slip_of("opening = \"full\"\n"),
                 mouth = slip_of("opening = \"mouth\"\nmouth_speed_m_s = 5\n"),
                 slow = slip_of("opening = \"mouth\"\nmouth_speed_m_s = 1e-6\n");
    EXPECT_GT(mouth, zero);
    EXPECT_LT(mouth, full);
    EXPECT_NEAR(slow, zero, 1e-3 * zero);
}

TEST(Audit, A6_no_pass_above_tipping)
{
    const Folder strong(4.0); // the dam tips at 2.99 m/s2 and slides, bonded, at 8.52 m/s2
    const nlohmann::json j = strong.screened(bonded);
    const double tips = j["yield"][0]["tips_m_s2"], slides = j["yield"][0]["yield_acceleration_m_s2"];
    ASSERT_LT(tips, 4.0);
    ASSERT_GT(slides, 4.0);
    EXPECT_NEAR(j["yield"][0]["tips_g"].get<double>(), tips / 9.80665, 1e-12);
    EXPECT_NEAR(j["yield"][0]["opens_m_s2"].get<double>(), tips, 1e-9);
    EXPECT_LT(j["yield"][0]["yield_with_crack_m_s2"].get<double>(), tips); // its bond goes before
    // The pulse drives it downstream with polarity +1 only; the other one loses its bond, which the block that rocks follows.
    EXPECT_EQ(j["displacements"][0]["status"], "rocks first");
    EXPECT_TRUE(j["displacements"][0]["slip_h_mm"].is_null());
    EXPECT_TRUE(j["displacements"][0]["slip_hv_mm"].is_null());
    EXPECT_EQ(j["displacements"][1]["status"], "at rest");
    for (const auto& row : j["displacements"]) EXPECT_EQ(row["verdict"], "judged by rocking");
    ASSERT_EQ(j["rocking_block"].size(), 2u);
    for (const auto& row : j["rocking_block"]) {
        EXPECT_TRUE(row["slip_mm"].is_number());
        EXPECT_NE(row["verdict"], "undecided");
        EXPECT_LT(std::abs(row["energy_imbalance"].get<double>()), 1e-9);
    }
    EXPECT_GT(j["rocking_block"][0]["max_slip_mm"].get<double>(), 1.0);
    EXPECT_TRUE(says(j["warnings"],
                     "tips at 0.305 g before it slides at 0.869 g: the rigid sliding block does not hold "
                     "here"));
    const ProgramAnswer text = strong.run("screen", bonded);
    EXPECT_TRUE(has(text.out, "judged by the block that rocks and slides: the dam tips at 0.305 g"));
    EXPECT_TRUE(has(text.out, "Displacement of the block that rocks and slides"));

    const Folder weak(2.0); // below tipping the bonded block holds
    for (const auto& row : weak.screened(bonded)["displacements"]) EXPECT_EQ(row["verdict"], "below");

    std::string sliding_first = bonded; // unbonded it slides before it tips: the block is the dam
    sliding_first.replace(sliding_first.find("1000"), 4, "0");
    const nlohmann::json unbonded = strong.screened(sliding_first);
    EXPECT_LT(unbonded["yield"][0]["yield_acceleration_m_s2"].get<double>(), tips);
    for (const auto& row : unbonded["displacements"]) EXPECT_NE(row["verdict"], "undecided");
}

TEST(Audit, A6_every_command_says_that_it_rocks_first)
{
    const Folder strong(4.0);
    const ProgramAnswer sliding = strong.run("sweep", bonded, {"--method", "rigid", "--polarity", "1"});
    EXPECT_EQ(sliding.code, 4) << sliding.talk;
    EXPECT_TRUE(has(sliding.out, "rocks first")) << sliding.out;
    const ProgramAnswer rocking = strong.run("sweep", bonded, {"--method", "rocking", "--polarity", "1"});
    EXPECT_EQ(rocking.code, 0) << rocking.talk;
    EXPECT_FALSE(has(rocking.out, "rocks first"));
    const ProgramAnswer model_levels = strong.run("accuracy", bonded);
    EXPECT_TRUE(has(model_levels.out, "rigid:h+v,rocking")) << model_levels.out << model_levels.talk;
    EXPECT_TRUE(has(model_levels.out, "rocks first"));
    const ProgramAnswer below = Folder(2.0).run("accuracy", bonded); // nothing rocks: no such model level
    EXPECT_FALSE(has(below.out, "rocking")) << below.out;
}

TEST(Audit, A6_rocking_on_request)
{
    const Folder weak(2.0);
    EXPECT_FALSE(weak.screened(bonded).contains("rocking_block"));
    const ProgramAnswer asked = weak.run("screen", bonded, {"--json", "--rocking"});
    ASSERT_EQ(asked.code, 0) << asked.talk;
    const nlohmann::json j = nlohmann::json::parse(asked.out);
    ASSERT_EQ(j["rocking_block"].size(), 2u);
    for (const auto& row : j["displacements"]) EXPECT_EQ(row["verdict"], "below"); // the sliding block holds
}

// N' = W - U, c A' of the uncracked part: more than a third of the resistance is bond, so the slip is judged without it, too.
TEST(Audit, A6_much_bond_is_judged_without_it)
{
    const Folder weak(2.0);
    const nlohmann::json j = weak.screened(bonded);
    ASSERT_EQ(j["without_bond"].size(), 2u);
    EXPECT_GT(j["without_bond"][0]["slip_mm"].get<double>(), 1.0);
    EXPECT_TRUE(says(j["warnings"], "judged for c = 0, too (a judgement, from a third on)"));
    std::string loose = bonded;
    loose.replace(loose.find("1000"), 4, "0");
    const nlohmann::json unbonded = weak.screened(loose);
    EXPECT_FALSE(unbonded.contains("without_bond"));
    EXPECT_EQ(j["without_bond"][0]["slip_mm"], unbonded["displacements"][0]["slip_hv_mm"]);
    loose.replace(loose.find("cohesion_kPa = 0"), 16, "cohesion_kPa = 100"); // a seventh
    EXPECT_FALSE(weak.screened(loose).contains("without_bond"));
}

// The block of 6 m by 10 m with cohesion, pushed by 700 kN/m at its top: 1471.5 kN/m at 3 m hold it, 7000 kNm/m tip it.
TEST(Audit, A6_a_dam_that_tips_statically_fails)
{
    std::string block = dry_block + "cohesion_kPa = 1000\n[[force]]\nx_m = 0\ny_m = 10\nforce_x_kN_m = 700\n"
                                    "[criteria]\nallowable_slip_mm = 50\n";
    const nlohmann::json j = Folder(1.0).screened(block);
    EXPECT_LT(j["yield"][0]["tips_m_s2"].get<double>(), 0.0);
    for (const auto& row : j["displacements"]) {
        EXPECT_EQ(row["status"], "overturns");
        EXPECT_EQ(row["verdict"], "FAIL");
        EXPECT_TRUE(row["slip_h_mm"].is_null());
    }
}

const std::string with_water = "[section]\nheight_m = 62.5\nbase_m = 45\ncrest_m = 12\nneck_m = 11\n[dam]\n"
                               "density_kg_m3 = 2500\n[contact]\nfriction = 0.9\n[reservoir]\nlevel_m = 60\n";

// Head at the drains H3 = (1 - E) H1 (L - X)/L, straight lines to both ends.
TEST(Audit, A7_drains_imply_uplift)
{
    const std::string drains = with_water + "[drains]\ndistance_m = 9\nefficiency = 0.6\n";
    const Scene scene = parsed(drains);
    ASSERT_TRUE(scene.uplift);
    EXPECT_EQ(scene.uplift->model, UpliftModel::drains);
    EXPECT_EQ(resolved_toml(scene), resolved_toml(parsed(drains + "[uplift]\nmodel = \"drains\"\n")));
    const double h3 = 0.4 * 60.0 * (45.0 - 9.0) / 45.0;
    const double by_hand = rho * g * (0.5 * (60.0 + h3) * 9.0 + 0.5 * h3 * (45.0 - 9.0));
    EXPECT_NEAR(make_rigid_block(scene).uplift, by_hand, 1e-6);
    // With a curtain beside them the uplift is by seepage, which knows both.
    EXPECT_EQ(parsed(drains + "[curtain]\ndistance_m = 5\n").uplift->model, UpliftModel::seepage);
}

// Behind a curtain the head of poor drains lies above that of the rock; such drains are left out, and are named.
TEST(Audit, drains_that_would_give_water_are_named)
{
    const Folder folder(1.0);
    for (const bool poor : {true, false}) {
        const nlohmann::json screen = folder.screened(with_water + "[curtain]\ndistance_m = 5\n[drains]\ndistance_m = 9\nefficiency = " +
                                                      (poor ? "0.2\n" : "0.9\n"));
        EXPECT_EQ(says(screen["warnings"], "[drains] change nothing: their head"), poor);
    }
}

TEST(Audit, A7_water_needs_a_word_on_uplift)
{
    const std::string message = message_of(with_water);
    EXPECT_TRUE(
        has(message, "there is water on the dam, [reservoir], but nothing says how it presses up under the base"));
    EXPECT_TRUE(has(message, "model = \"none\"")) << message;
    EXPECT_TRUE(has(message_of(dry_block + "[tailwater]\nlevel_m = 2\n"), "[tailwater]"));
    const std::string flood = "[[combination]]\nname = \"flood\"\nreservoir_level_m = 3\n";
    EXPECT_TRUE(has(message_of(dry_block + "[reservoir]\nlevel_m = 0\n" + flood), "there is water on the dam"));
    for (const char* statement :
         {"[uplift]\n", "[uplift]\nmodel = \"none\"\n", "[drains]\ndistance_m = 9\n", "[curtain]\ndistance_m = 7\n"})
        EXPECT_EQ(message_of(with_water + statement), "(accepted)") << statement;
    EXPECT_EQ(message_of(dry_block + "[reservoir]\nlevel_m = 0\n"), "(accepted)"); // no water
    EXPECT_EQ(message_of(dry_block), "(accepted)");
}

TEST(Audit, A7_fe_refuses_water_without_a_word_on_uplift)
{
    const ProgramAnswer a = Folder(1.0).run("fe", with_water);
    EXPECT_EQ(a.code, exit_input);
    EXPECT_TRUE(has(a.talk, "nothing says how it presses up under the base")) << a.talk;
}

TEST(Audit, A7_a_dry_base_is_said_beside_the_verdict)
{
    const std::string none = with_water + "[uplift]\nmodel = \"none\"\n[criteria]\nallowable_slip_mm = 50\n";
    const Folder folder(1.0);
    EXPECT_EQ(folder.screened(none)["yield"][0]["uplift_kN_m"], 0.0);
    EXPECT_TRUE(says(folder.screened(none)["warnings"], "taken as dry although there is water"));
    const ProgramAnswer text = folder.run("screen", none);
    EXPECT_TRUE(has(text.out, "verdict: of a base taken as dry although there is water on the dam"));
    EXPECT_FALSE(base_taken_as_dry(parsed(with_water + "[uplift]\n")));
}

/// Four extreme combinations that open the joint differently far, and what is left after one of them.
Scene four_earthquakes()
{
    return parsed(
        "[section]\nheight_m = 62.5\nbase_m = 45\ncrest_m = 12\nneck_m = 11\n[dam]\ndensity_kg_m3 = 2500\n"
        "[contact]\nfriction = 1.0\ncohesion_kPa = 300\nresidual_friction = 0.8\n[reservoir]\n"
        "model = \"added-mass\"\nlevel_m = 60\n[tailwater]\nlevel_m = 6\n[drains]\ndistance_m = 5\n"
        "efficiency = 0.6\n[uplift]\ncrack = \"static\"\n"
        "[[combination]]\nname = \"zero\"\nkind = \"extreme\"\nk_h = 0.2\ncrack = \"seismic-zero\"\n"
        "[[combination]]\nname = \"unchanged\"\nkind = \"extreme\"\nk_h = 0.2\ncrack = \"seismic-unchanged\"\n"
        "[[combination]]\nname = \"full\"\nkind = \"extreme\"\nk_h = 0.2\ncrack = \"seismic-full\"\n"
        "[[combination]]\nname = \"lifted\"\nkind = \"extreme\"\nk_h = 0.2\nk_v = -0.1333\n"
        "crack = \"seismic-unchanged\"\n"
        "[[combination]]\nname = \"post\"\nkind = \"post-seismic\"\nresidual_strength = true\n"
        "drains_effective = false\ncrack = \"static\"\n");
}

TEST(Audit, A8_post_seismic_does_not_depend_on_the_order)
{
    Scene scene = four_earthquakes();
    const auto by_name = [](const Combination& a, const Combination& b) { return a.name < b.name; };
    std::sort(scene.combinations.begin(), scene.combinations.end(), by_name);
    double least = 1e9; // of the post-seismic state after each of them by itself
    for (const char* name : {"zero", "unchanged", "full", "lifted"}) {
        Scene one = scene;
        std::erase_if(one.combinations, [&](const Combination& c) { return c.name != name && c.name != "post"; });
        least = std::min(least, state_named(evaluate_combinations(one), "post").sliding_factor);
    }
    do {
        const auto all = evaluate_combinations(scene);
        const Equilibrium& after = state_named(all, "post");
        EXPECT_EQ(after.sliding_factor, least);
        EXPECT_EQ(after.follows, "full"); // it opens the whole base
        EXPECT_EQ(after.base.crack.length, 45.0);
        for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].name, scene.combinations[i].name);
    } while (std::next_permutation(scene.combinations.begin(), scene.combinations.end(), by_name));
}

TEST(Audit, A8_follows_names_the_earthquake)
{
    Scene scene = four_earthquakes();
    scene.combinations.back().follows = "zero";
    const auto all = evaluate_combinations(scene);
    EXPECT_EQ(all.back().follows, "zero");
    EXPECT_EQ(all.back().base.crack.length, state_named(all, "zero").base.crack.length);
    const Table table = pages::equilibrium_table(all);
    const auto column =
        std::find_if(table.columns.begin(), table.columns.end(), [](const Column& c) { return c.key == "follows"; });
    ASSERT_NE(column, table.columns.end());
    EXPECT_EQ(table.rows.back()[static_cast<std::size_t>(column - table.columns.begin())], Cell(std::string("zero")));

    const std::string two = dry_block + "[[combination]]\nname = \"quake\"\nkind = \"extreme\"\nk_h = 0.1\n"
                                        "[[combination]]\nname = \"after\"\nkind = \"post-seismic\"\nfollows = ";
    EXPECT_EQ(message_of(two + "\"quake\"\n"), "(accepted)");
    EXPECT_TRUE(has(message_of(two + "\"flood\"\n"), "combination[2].follows = \"flood\" is no combination of kind "
                                                     "\"extreme\""));
    EXPECT_TRUE(has(message_of(two + "\"flood\"\n"), "one of \"quake\""));
    EXPECT_TRUE(
        has(message_of(dry_block + "[[combination]]\nname = \"quake\"\nkind = \"extreme\"\nfollows = \"quake\"\n"),
            "but its kind is not \"post-seismic\""));
}

// Tailwater of 62 m over a reservoir of 60 m: a base open from end to end is full of the tailwater's head.
TEST(Audit, A9_an_open_base_holds_the_higher_head)
{
    std::string text = with_water + "[tailwater]\nlevel_m = 62\n[uplift]\nmodel = \"linear\"\n";
    const auto uplift_of = [](const Scene& scene, double crack, Side side) {
        return resultant(uplift_profile(scene, scene_uplift_state(scene), {side, crack})).force;
    };
    for (const Side side : {Side::heel, Side::toe})
        EXPECT_NEAR(uplift_of(parsed(text), 45.0, side), rho * g * 62.0 * 45.0, 1e-6);
    text += "[[combination]]\nname = \"quake\"\nkind = \"extreme\"\nk_h = 2\ncrack = \"seismic-full\"\n"
            "[[combination]]\nname = \"after\"\nkind = \"post-seismic\"\ncrack = \"static\"\n"
            "[[combination]]\nname = \"usual\"\ncrack = \"static\"\n";
    const auto all = evaluate_combinations(parsed(text));
    ASSERT_EQ(state_named(all, "quake").base.status, CrackStatus::open);
    EXPECT_LT(state_named(all, "after").sliding_factor, state_named(all, "usual").sliding_factor);
}

TEST(Audit, A14_the_seismic_combination_says_what_it_takes_of_the_record)
{
    const std::string scene = with_water + "[uplift]\nmodel = \"linear\"\n";
    const Folder folder(1.96133); // 0.2 g, vertically 0.02 g
    const auto seismic = [&](const std::string& keys) {
        const nlohmann::json j = folder.screened(scene + keys);
        for (const auto& row : j["limit_equilibrium"])
            if (row["combination"] == "seismic") return row;
        return nlohmann::json{};
    };
    const nlohmann::json full = seismic("");
    EXPECT_NEAR(full["k_h"].get<double>(), 0.2, 1e-12);
    EXPECT_NEAR(full["k_h_of_pga"].get<double>(), 1.0, 1e-12);
    EXPECT_EQ(full["k_v"], 0.0);
    const std::string text = without_breaks(folder.run("screen", scene).out);
    EXPECT_TRUE(has(text, "k_h is the largest PGA of the records in full (criteria.pga_fraction)."));
    EXPECT_TRUE(has(text, "k_v is 0 although the records have a vertical component of up to 0.02 g (criteria.pga_v_fraction)."));

    const nlohmann::json part = seismic("[criteria]\npga_fraction = 0.5\npga_v_fraction = 0.3\n");
    EXPECT_NEAR(part["k_h"].get<double>(), 0.1, 1e-12);
    EXPECT_NEAR(part["k_h_of_pga"].get<double>(), 0.5, 1e-12);
    EXPECT_NEAR(part["k_v"].get<double>(), -0.3 * 0.02, 1e-12); // lightens
    EXPECT_LT(part["normal_force_effective_kN_per_m"].get<double>(),
              full["normal_force_effective_kN_per_m"].get<double>());
    const nlohmann::json own = seismic("[[combination]]\nname = \"seismic\"\nkind = \"extreme\"\npga_fraction = 0.67\n"
                                       "pga_v_fraction = 1\n");
    EXPECT_NEAR(own["k_h"].get<double>(), 0.134, 1e-12);
    EXPECT_NEAR(own["k_v"].get<double>(), -0.02, 1e-12);
}

TEST(Audit, A14_a_coefficient_is_a_value_or_a_share)
{
    const std::string quake = dry_block + "[[combination]]\nname = \"quake\"\nkind = \"extreme\"\n";
    EXPECT_TRUE(has(message_of(quake + "k_h = 0.1\npga_fraction = 1\n"),
                    "combination[1].pga_fraction is given together with combination[1].k_h"));
    EXPECT_TRUE(has(message_of(quake + "k_v = 0.1\npga_v_fraction = 1\n"), "combination[1].pga_v_fraction"));
    EXPECT_EQ(message_of(quake + "k_v = 0.1\npga_fraction = 1\n"), "(accepted)");
}

// The dry rectangle, resultant at a distance d from the toe: a = g (b - 2 d)/h leaves 3 d pressed, 2 W/(3 d) at the toe.
TEST(Audit, B5_a_joint_cracked_through_has_no_stresses)
{
    const Scene scene = parsed(dry_block + "[uplift]\ncrack = \"seismic-unchanged\"\n");
    const auto with_distance = [&](double d) {
        Combination c;
        c.kind = CombinationKind::extreme;
        c.k_h = g * (6.0 - 2.0 * d) / 10.0 / units::standard_gravity;
        c.crack = CrackRule::seismic_unchanged;
        return evaluate(scene, c, {});
    };
    const Equilibrium some = with_distance(0.05); // 0.15 m of 6 m: 2.5 %
    EXPECT_EQ(some.base.status, CrackStatus::partial);
    EXPECT_NEAR(some.toe_stress, 2 * 2500 * 60 * g / 0.15, 1e-5 * some.toe_stress);
    const Equilibrium none = with_distance(0.03); // 0.09 m: 1.5 %
    EXPECT_EQ(none.base.status, CrackStatus::through);
    EXPECT_TRUE(std::isnan(none.toe_stress));
    EXPECT_EQ(none.cohesive_length, 0.0);
    EXPECT_EQ(none.zone, ResultantZone::outside);
    ASSERT_FALSE(none.notes.empty());
    EXPECT_TRUE(has(text_of(none.notes.front()), "cracked through: what is left, 0.09 m of 6 m")) << text_of(none.notes.front());
    EXPECT_STREQ(word(none.base.status), "cracked through");
    // 3 % of a base of 200 m below 600 m of concrete: 2 W/(3 d) is beyond the strength of any.
    CrackedBase high;
    high.status = CrackStatus::partial;
    high.compressed_length = 6.0;
    high.effective_normal = 200 * 600 * 2500 * g / 2;
    EXPECT_TRUE(cracked_through(high, 200.0));
    high.effective_normal /= 20;
    EXPECT_FALSE(cracked_through(high, 200.0));
}

// A force that carries the whole weight leaves no N', whatever the last digits of the sums.
TEST(Audit, B5_round_off_of_the_normal_force_prints_nothing)
{
    for (double h = 3.1; h < 9.0; h += 0.37) {
        Scene scene = parsed(dry_block);
        scene.section.polygon = {{0, 0}, {6, 0}, {6, h}, {0, h}};
        const double weight = 2500.0 * 6.0 * h * g;
        for (const double share : {0.3, 0.1, 0.6}) {
            PointForce up;
            up.at = {3.0, h};
            up.force_y = share * weight;
            scene.forces.push_back(up);
        }
        EXPECT_EQ(evaluate(scene, {}, {}).base.effective_normal, 0.0) << h;
    }
}

TEST(Audit, C_states_of_the_limit_equilibrium_have_names_of_their_own)
{
    const Scene scene = parsed(with_water + "[uplift]\nmodel = \"linear\"\n");
    const auto all = evaluate_combinations(scene, {1.5, 0.0});
    std::set<std::string> names;
    for (const Equilibrium& e : all) EXPECT_TRUE(names.insert(e.name).second) << e.name;
    EXPECT_TRUE(names.contains("seismic"));
    EXPECT_TRUE(names.contains("seismic, cracked"));
}

} // namespace
} // namespace damslip::sliding::audited
