#include "random/random_scene.hpp"

#include "core/file.hpp"
#include "core/geometry.hpp"
#include "random/random_motion.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::random {

namespace {

/// The scene while it grows.
struct Writer {
    Draw& draw;
    std::string text;
    double base = 0.0, height = 0.0; ///< of the section [m]
    double level = 0.0;              ///< of the reservoir, 0: none [m]
    double rock_modulus = 0.0;       ///< 0: no rock [GPa]
    bool rock = false, curtain = false, drains = false, joints = false;
    std::string rock_by_name; ///< keys of [foundation] for what nothing was drawn of; written last, see random_scene()

    void table(const char* name) { text += fmt::format("[{}]\n", name); }
    template <class T>
    void key(const char* name, const T& value)
    {
        text += fmt::format("{} = {}\n", name, value);
    }
    void word(const char* name, const std::string& value) { key(name, '"' + value + '"'); }
    void words(const char* name, std::initializer_list<const char*> choices) { word(name, draw.word(choices)); }
    /// A key more for a table that is there already.
    template <class T>
    void late_key(const char* table, const char* name, const T& value)
    {
        const std::string head = fmt::format("[{}]\n", table);
        text.insert(text.find(head) + head.size(), fmt::format("{} = {}\n", name, value));
    }
    bool has(const char* words) const { return text.find(words) != std::string::npos; }
};

std::string without_line(std::string text, const char* start)
{
    const std::size_t from = text.find(start);
    if (from != std::string::npos) text.erase(from, text.find('\n', from) + 1 - from);
    return text;
}

std::string points(const Polyline& line)
{
    std::string text;
    for (const Point& p : line) text += fmt::format("{}[{:.6g}, {:.6g}]", text.empty() ? "" : ", ", p.x, p.y);
    return "[" + text + "]";
}

/// Heel, toe, down the face to the crest and back: faces that fall back towards the middle, as those of dams do.
Polyline dam_polygon(Writer& w)
{
    Draw& draw = w.draw;
    const double b = w.base, h = w.height;
    const double dip = draw.chance(0.15) ? draw.between(-0.2, 0.2) : 0.0; // of the base, downstream
    const double crest_left = draw.chance(0.7) ? 0.0 : draw.between(0.0, 0.3) * b;
    const double crest_right = crest_left + draw.between(0.05, 1.0) * (b - crest_left);
    Polyline line{{0, 0}, {b, -dip * b}};
    if (draw.chance(0.5)) {
        const double share = draw.between(0.2, 0.9), bulge = draw.between(-0.2, 0.2);
        line.push_back({b + (crest_right - b) * (share + bulge * share * (1 - share)), h * share});
    }
    line.push_back({crest_right, h});
    line.push_back({crest_left, h});
    if (crest_left > 0 && draw.chance(0.5)) line.push_back({crest_left, h * draw.between(0.2, 0.9)});
    return line;
}

Polyline any_polygon(Writer& w)
{
    Polyline line{{0, 0}, {w.base, 0}};
    for (int k = w.draw.whole(1, 5); k > 0; --k)
        line.push_back({w.draw.between(-0.3, 1.3) * w.base, w.draw.between(-0.2, 1.0) * w.height});
    return line;
}

void add_section(Writer& w)
{
    Draw& draw = w.draw;
    w.base = draw.log_between(1.0, 60.0);
    w.height = std::min(80.0, w.base * draw.log_between(0.2, 3.0));
    w.table("section");
    const double kind = draw.unit();
    if (kind < 0.25) {
        w.key("polygon_m", points({{0, 0}, {w.base, 0}, {w.base, w.height}, {0, w.height}}));
    } else if (kind < 0.55) {
        w.key("polygon_m", points(dam_polygon(w)));
    } else if (kind < 0.58) {
        w.key("polygon_m", points(any_polygon(w)));
    } else {
        w.key("height_m", w.height);
        w.key("base_m", w.base);
        const double crest = draw.chance(0.8) ? draw.between(0.05, 0.9) : 0.0;
        w.key("crest_m", crest * w.base);
        if (crest > 0 && draw.chance(0.5)) w.key("neck_m", draw.between(0.0, 0.6) * w.height);
        if (draw.chance(0.3)) w.key("upstream_slope", draw.between(0.0, 1.02) * (1 - crest) * w.base / w.height);
        if (draw.chance(0.1)) w.key("upstream_slope_height_m", draw.between(0.1, 1.0) * w.height);
        if (draw.chance(0.12)) w.key("base_inclination_deg", draw.between(-20, 20));
    }
}

void add_material(Writer& w)
{
    w.table("dam");
    w.key("density_kg_m3", w.draw.between(1800, 2800));
    w.key("young_modulus_GPa", w.draw.chance(0.7) ? w.draw.between(15, 40) : w.draw.log_between(0.01, 1e5));
    if (w.draw.chance(0.5)) w.key("poisson_ratio", w.draw.word({"0", "0.17", "0.3", "0.49", "0.499"}));
}

/// Keys of the strength, those that base and lift joints have in common.
void add_strength(Writer& w)
{
    Draw& draw = w.draw;
    const double mu = draw.chance(0.75) ? draw.between(0.4, 1.2) : draw.between(0.0, 3.0);
    if (draw.chance(0.08)) {
        w.key("friction_table_m",
              fmt::format("[[0, {}], [{}, {}]]", mu, draw.log_between(1e-4, 0.1), draw.between(0.2, 1) * mu));
        w.key("friction", mu);
        if (draw.chance(0.5)) w.words("residual_path", {"steps", "linear"});
        return;
    }
    if (draw.chance(0.1))
        w.key("friction_deg", draw.between(20, 50));
    else
        w.key("friction", mu);
    if (draw.chance(0.15)) w.key("cohesion_kPa", draw.log_between(1, 500));
    if (draw.chance(0.1)) w.key("cohesion_lost_at_slip", draw.word({"true", "false"}));
    if (draw.chance(0.15)) {
        w.key("residual_friction", draw.between(0.3, 1.0) * std::min(mu, 0.4));
        if (draw.chance(0.6)) w.key("residual_slip_m", draw.log_between(1e-4, 0.1));
        if (draw.chance(0.5)) w.words("residual_path", {"steps", "linear"});
    }
}

void add_contact(Writer& w)
{
    Draw& draw = w.draw;
    w.table("contact");
    add_strength(w);
    const int joints = draw.chance(0.12) ? draw.whole(1, 2) : 0;
    if (draw.chance(joints > 0 ? 0.02 : 0.15)) {
        w.word("sliding", "finite");
        if (draw.chance(0.5)) w.key("max_slip_m", draw.log_between(0.01, 2));
    }
    const bool pulled = draw.chance(0.1);
    if (pulled) w.word("separation", "none");
    const double law = draw.unit();
    if (law < 0.12) {
        w.word("enforcement", "penalty");
        w.key("tangential_stiffness_N_m3", draw.log_between(1e6, 1e14));
    } else if (law < 0.2) {
        w.word("enforcement", "slip-tolerance");
        if (draw.chance(0.5)) w.key("slip_tolerance", draw.log_between(1e-4, 0.1));
    }
    if (draw.chance(pulled || (law >= 0.12 && law < 0.2) ? 0.01 : 0.08)) {
        w.word("normal", "exponential");
        if (draw.chance(0.5)) w.key("pressure_at_zero_clearance_kPa", draw.log_between(10, 1e5));
        if (draw.chance(0.5)) w.key("clearance_at_zero_pressure_m", draw.log_between(1e-5, 1e-2));
    }
    for (int k = 0; k < joints; ++k) {
        w.text += "[[lift_joint]]\n";
        w.key("elevation_m", (k == 0 ? draw.between(0.1, 0.45) : draw.between(0.5, 0.9)) * w.height);
        add_strength(w);
        if (draw.chance(0.4)) w.word("water", "linear");
    }
}

void add_rock(Writer& w)
{
    Draw& draw = w.draw;
    w.rock = draw.chance(0.5);
    if (w.rock) {
        w.table("foundation");
        w.rock_modulus = draw.chance(0.7) ? draw.between(5, 50) : draw.log_between(1e-3, 1e5);
        w.key("young_modulus_GPa", w.rock_modulus);
        if (draw.chance(0.4)) w.key("poisson_ratio", draw.word({"0", "0.2", "0.3", "0.49", "0.499"}));
        if (draw.chance(0.5)) w.key("width_m", draw.between(2.0, 8.0) * w.base);
        if (draw.chance(0.5)) w.key("depth_m", draw.between(0.5, 3.0) * w.base);
        if (draw.chance(0.05)) w.key("density_kg_m3", 2500);
        if (draw.chance(0.2)) w.key("permeability_m_s", draw.log_between(1e-9, 1e-2));
    }
    w.curtain = draw.chance(0.2);
    if (w.curtain) {
        w.table("curtain");
        const double thickness = draw.between(0.02, 0.15);
        w.key("distance_m", draw.chance(0.3) ? 0.0 : draw.between(0.02, 1.02) * (1 - thickness) * w.base);
        w.key("depth_m", draw.between(0.1, 0.5) * w.base);
        w.key("thickness_m", thickness * w.base);
        if (draw.chance(0.3)) w.key("young_modulus_GPa", draw.between(5, 50));
        if (draw.chance(0.2)) w.key("intact", "false");
    }
    w.drains = draw.chance(0.15);
    if (w.drains) {
        w.table("drains");
        w.key("distance_m", draw.between(0.05, 0.95) * w.base);
        if (draw.chance(0.5)) w.key("efficiency", draw.between(0, 1));
        if (draw.chance(0.2)) w.key("gallery_level_m", draw.between(-0.1, 0.3) * w.height);
        if (draw.chance(0.3)) w.key("lost_at_slip_m", draw.log_between(1e-4, 0.1));
    }
}

void add_acoustic(Writer& w)
{
    Draw& draw = w.draw;
    if (draw.chance(0.5)) w.key("length_m", draw.between(0.5, 4.0) * w.level);
    if (draw.chance(0.3)) w.words("surface", {"free", "sloshing"});
    if (draw.chance(0.4)) w.words("far_end", {"absorbing", "damper", "closed", "open"});
    if (draw.chance(0.3)) w.words("bottom_motion", {"ground", "still"});
    if (draw.chance(0.4)) w.key("bottom_reflection", draw.word({"-1", "-0.5", "0", "0.5", "0.9", "1"}));
    w.key("mesh_size_m", std::max(1e-3, w.level / draw.between(3.9, 7)));
}

void add_water(Writer& w)
{
    Draw& draw = w.draw;
    if (draw.chance(0.7)) {
        w.table("reservoir");
        const double place = draw.unit();
        w.level = place < 0.1    ? w.height
                  : place < 0.15 ? 1.1 * w.height
                  : place < 0.18 ? 0.0
                                 : draw.between(0.1, 1.0) * w.height;
        w.key("level_m", w.level);
        w.key("overtopped", "true");
        w.words("model", {"auto", "hydrostatic", "added-mass", "added-mass", "acoustic"});
        if (draw.chance(0.15)) w.key("floor_pressure", "true");
        if (draw.chance(0.1)) w.key("bulk_modulus_MPa", draw.log_between(1, 1e6));
        add_acoustic(w);
        w.table("added_mass");
        if (draw.chance(0.6)) w.words("formula", {"westergaard", "westergaard-simplified", "zangar", "goldgruber"});
        if (draw.chance(0.1)) w.key("period_s", draw.word({"0.3", "1", "\"dam\"", "0.01"}));
        if (draw.chance(0.2)) w.words("inclined_face", {"normal-component", "printed"});
    }
    if (draw.chance(0.25)) {
        w.table("tailwater");
        w.key("level_m", draw.between(0, draw.chance(0.8) ? 0.5 : 1.1) * w.height);
    }
    if (draw.chance(0.08)) {
        w.table("silt");
        w.key("level_m", draw.between(0.1, 0.9) * w.height);
        w.key("submerged_unit_weight_kN_m3", draw.between(5, 12));
        w.key("pressure_coefficient", draw.between(0.2, 1));
    }
    if (draw.chance(0.08)) {
        w.table("ice");
        w.key("force_kN_m", draw.between(-50, 150));
        if (draw.chance(0.5)) w.key("level_m", draw.between(0, 1) * w.height);
    }
}

void add_uplift(Writer& w)
{
    Draw& draw = w.draw;
    const bool water = w.has("[reservoir]") || w.has("[tailwater]");
    if (!draw.chance(0.6)) {
        if (!water || w.curtain || w.drains) return;
        w.table("uplift");
        w.word("model", "none");
        return;
    }
    w.table("uplift");
    std::string model = draw.word({"none", "linear", "linear", "curtain", "drains", "points", "seepage"});
    const bool lacks =
        (model == "curtain" && !w.curtain) || (model == "drains" && !w.drains) || (model == "seepage" && !w.rock);
    if (lacks && !draw.chance(0.03)) model = "linear";
    w.word("model", model);
    if (draw.chance(0.2)) w.key("curtain_ratio", draw.word({"0", "0.5", "1"}));
    if (model == "points") {
        const double place = draw.between(0.1, 0.9) * w.base;
        w.key("points_m", fmt::format("[[0, 1], [{0}, {1}], [{0}, {2}], [{3}, 0]]", place, draw.between(0.5, 1),
                                      draw.between(0, 0.5), w.base));
    }
    if (draw.chance(0.2)) w.words("crack", {"none", "static", "seismic-zero", "seismic-unchanged", "seismic-full"});
}

void add_forces(Writer& w)
{
    Draw& draw = w.draw;
    for (int k = draw.chance(0.12) ? draw.whole(1, 2) : 0; k > 0; --k) {
        w.text += "[[force]]\n";
        w.key("x_m", draw.between(-0.2, 1.0) * w.base);
        w.key("y_m", draw.between(0, 1) * w.height);
        w.key("force_x_kN_m", draw.between(-1, 1) * 5 * w.height);
        w.key("force_y_kN_m", draw.between(-1, 1) * 5 * w.height);
    }
    if (draw.chance(0.1)) {
        w.text += "[[combination]]\n";
        w.word("name", "drawn");
        w.words("kind", {"usual", "unusual", "extreme", "post-seismic"});
        if (draw.chance(0.5)) w.key("reservoir_level_m", draw.between(0, 1.1) * w.height);
        if (draw.chance(0.5)) w.key("k_h", draw.between(-0.5, 0.5));
        if (draw.chance(0.3)) w.words("crack", {"none", "static", "seismic-full"});
        if (draw.chance(0.3)) w.key("residual_strength", "true");
    }
}

void add_model(Writer& w)
{
    Draw& draw = w.draw;
    w.table("mesh");
    const double contact_size = w.base / draw.whole(1, 8);
    w.key("size_m", std::max({contact_size, w.height / draw.whole(2, 7), w.base / draw.whole(1, 7)}));
    w.key("contact_size_m", contact_size);
    if (w.rock && draw.chance(0.1)) w.key("rock_contact_size_m", w.base / draw.whole(1, 8));
    w.key("growth", draw.word({"1.15", "1.5", "2", "3"}));
    if (draw.chance(0.3)) w.words("element", {"q4-incompatible", "q4", "t3"});
    if (draw.chance(0.25)) {
        w.table("stages");
        w.words("gravity", {"dam", "dam-and-rock"});
        w.key("geostatic", draw.word({"true", "false"}));
        w.words("pore_pressure", {"none", "none", "total", "effective"});
    }
    w.table("damping");
    const double method = draw.unit();
    if (method < 0.2)
        w.word("method", "none");
    else if (method < 0.23)
        w.word("method", "modified-rayleigh");
    w.key("ratio", draw.word({"0", "0.02", "0.05", "0.05", "0.2", "1"}));
    if (draw.chance(0.6)) w.key("second_mode", draw.whole(2, 4));
    const bool given = draw.chance(0.12);
    if (given) w.key("mass_coefficient_1_s", draw.log_between(0.01, 10));
    if (given && draw.chance(0.97)) w.key("stiffness_coefficient_s", draw.log_between(1e-5, 1e-2));
    if (draw.chance(0.2)) w.words("mass", {"deformation-only", "relative", "total"});
}

void add_time(Writer& w)
{
    Draw& draw = w.draw;
    w.table("time");
    if (draw.chance(0.12)) {
        w.word("scheme", "newmark");
        const bool damped = draw.chance(0.4); // beta < gamma/2 is stable for small steps only
        if (damped) w.key("gamma", draw.word({"0.6", "0.8"}));
        if (damped || draw.chance(0.3)) w.key("beta", draw.word({"0.3025", "0.4225", "0.4225", "0.1666667"}));
    } else if (draw.chance(0.5)) {
        w.key("alpha", draw.word({"0", "-0.05", "-0.1", "-0.3", "-0.333"}));
    }
    if (draw.chance(0.15)) w.key("dt_s", draw.log_between(1e-3, 0.1));
    if (draw.chance(0.85))
        w.key("substeps", draw.whole(0, 2));
    else
        w.key("slip_tolerance", draw.word({"0.01", "0.1", "1"}));
    if (draw.chance(0.04)) {
        w.table("analysis");
        w.word("preset", "goldgruber-2015");
    }
}

void add_sliding(Writer& w)
{
    Draw& draw = w.draw;
    w.table("sliding");
    w.key("run_out_max_s", draw.word({"0", "0.5", "1", "2"}));
    if (draw.chance(0.1)) w.words("scheme", {"exact", "slammer"});
    if (draw.chance(0.3)) w.words("lift_off", {"no-friction", "ballistic"});
    if (draw.chance(0.2)) w.key("two_way", draw.word({"true", "false"}));
    w.table("motion");
    w.key("polarity", draw.word({"1", "-1"}));
    if (draw.chance(0.2)) w.key("scale", draw.word({"0", "1e-12", "1e-3", "0.5", "3"}));
    if (draw.chance(0.1)) w.key("scale_to_pga_m_s2", draw.between(0.5, 15));
}

/// Models of more effort. Drawn last, so that a seed keeps its scene but for these.
void add_breadth(Writer& w)
{
    Draw& draw = w.draw;
    if (w.rock && draw.chance(0.25)) {
        w.late_key("foundation", "mass", "\"with-mass\"");
        if (!w.has("density_kg_m3 = 2500")) w.late_key("foundation", "density_kg_m3", draw.between(2000, 3000));
        if (draw.chance(0.6))
            w.late_key("foundation", "boundary", "\"viscous\"");
        else
            w.rock_by_name = "boundary = \"fixed\"\n";
        if (draw.chance(0.5)) w.late_key("mesh", "rock_size_m", w.base / draw.between(0.5, 4));
    } else
        w.rock_by_name = "mass = \"massless\"\n";
    if (!w.has("element = ") && draw.chance(0.15))
        w.late_key("mesh", "element", draw.word({"\"q8\"", "\"q9\"", "\"t6\""}));
    if (!w.rock && !w.has("scheme = \"newmark\"") && !w.has("alpha") && draw.chance(0.2)) {
        w.late_key("time", "scheme", "\"central-difference\"");
        w.text = without_line(w.text, "dt_s = ");
    }
}

/// Keys of rock that radiates, for rock that nothing was drawn of. Boxed rock is add_breadth()'s.
std::string radiating_rock(const Writer& w)
{
    Draw& draw = w.draw;
    std::string keys;
    const auto key = [&](double probability, const char* name, const std::string& value) {
        if (draw.chance(probability)) keys += fmt::format("{} = {}\n", name, value);
    };
    const auto number = [&](double low, double high) { return fmt::format("{}", draw.between(low, high)); };
    key(0.6, "mass", "\"with-mass\"");
    key(0.5, "boundary", "\"absorbing\"");
    if (!w.has("density_kg_m3 = 2500\n")) key(0.5, "density_kg_m3", number(2000, 3000));
    key(0.3, "wave_box", number(0.5, 1.6));
    // Shortest waves of 0.8 to 6 lengths of the base: boxes that are reduced in seconds at most.
    const double shear_wave_speed = std::sqrt(1e9 * w.rock_modulus / (2.4 * 2650.0));
    const double hertz = draw.log_between(1.0 / 6, 1.2) * shear_wave_speed / w.base;
    key(0.3, "wave_frequency_Hz", fmt::format("{:.4g}", std::clamp(hertz, 1.0, 200.0)));
    if (draw.chance(0.04)) { // one of them becomes what no one should write
        const std::string wrong = draw.word({"-1", "0", "nan", "inf", "1e300", "\"word\"", "true"});
        const std::size_t at = keys.rfind(" = ");
        if (at != std::string::npos) keys.replace(at + 3, keys.size() - at - 4, wrong);
    }
    return keys;
}

/// Rows of anchors through the base, forces of the order of the weight, from bars that hardly pull to ones that snap at once;
/// not beside what knows no force that grows with slip.
std::string drawn_anchors(Draw& draw, const Writer& w, const std::string& scene)
{
    std::string text;
    if (!draw.chance(0.15)) return text;
    for (const char* other : {"enforcement", "normal = ", "separation", "central-difference", "slammer", "ballistic"})
        if (scene.find(other) != std::string::npos) return text;
    const double weight = 0.5 * w.base * w.height * 24.0; // [kN/m], about
    for (int k = draw.whole(1, 3); k > 0; --k) {
        const double yield = weight * draw.log_between(1e-3, 1.0), strength = draw.between(250, 1800); // [kN/m], [MPa]
        const double strain = strength / 200e3;
        text += fmt::format("[[anchor]]\ndistance_m = {:.6g}\ninclination_deg = {:.4g}\nfree_length_m = {:.4g}\n"
                            "area_m2_m = {:.6g}\nyield_strength_MPa = {:.4g}\n",
                            draw.between(0.0, 0.99) * w.base, draw.chance(0.3) ? 0.0 : draw.between(-70, 70),
                            w.base * draw.log_between(1e-3, 3.0), yield / (1e3 * strength), strength);
        if (draw.chance(0.6)) text += fmt::format("prestress_kN_m = {:.6g}\n", yield * draw.between(0.0, 0.95));
        if (draw.chance(0.4))
            text += fmt::format("rupture_strain = {:.4g}\n", std::max(strain * draw.log_between(1.01, 10.0), 1e-4));
        if (draw.chance(0.3)) text += "dowel = true\n";
        if (draw.chance(0.2)) text += "limit_force = \"yield\"\n";
    }
    return text;
}

/// What a joint may have beyond friction, and records one after the other: keys for tables of a scene that is written already.
class LateLaws {
public:
    LateLaws(Draw& draw, SceneFiles& files) : draw_(draw), files_(files) {}

    void add()
    {
        const bool plain = without({"enforcement", "normal = ", "separation", "central-difference"});
        if (draw_.chance(0.15) && plain) add_bond();
        if (draw_.chance(0.25) && plain && without({"slammer"})) add_water();
        if (draw_.chance(0.15) && plain && without({"slammer", "[[anchor]]"})) add_rate();
        if (draw_.chance(0.1) && plain && without({"slammer", "model = \"acoustic\""}))
            key("contact", "restitution", draw_.word({"0.1", "0.5", "0.9", "1"}));
        if (draw_.chance(0.12) && without({"slammer", "central-difference"})) add_sequence();
        if (has("[[lift_joint]]\n") && draw_.chance(0.3) && plain) add_bond_of_joint();
    }

private:
    bool has(const char* words) const { return files_.scene.find(words) != std::string::npos; }
    bool without(std::initializer_list<const char*> others) const
    {
        return std::none_of(others.begin(), others.end(), [this](const char* other) { return has(other); });
    }
    template <class T>
    void key(const char* table, const char* name, const T& value)
    {
        const std::string head = fmt::format("[{}]\n", table);
        const std::size_t at = files_.scene.find(head);
        if (at != std::string::npos) files_.scene.insert(at + head.size(), fmt::format("{} = {}\n", name, value));
    }

    /// Of the base: a strength that may be lost at once, by energies from brittle to tough, or not at all.
    void add_bond()
    {
        const std::size_t contact = files_.scene.find("[contact]\n"), end = files_.scene.find("\n[", contact);
        const std::string table = files_.scene.substr(contact, end - contact);
        if (table.find("cohesion_lost_at_slip = false") != std::string::npos) return;
        const bool cohesion = table.find("cohesion_kPa") != std::string::npos;
        const std::string loss = draw_.word({"fracture", "fracture", "fracture", "together", "pairs"});
        key("contact", "bond", '"' + loss + '"');
        const bool shear = cohesion || loss != "fracture" || draw_.chance(0.8);
        if (shear && !cohesion) key("contact", "cohesion_kPa", draw_.log_between(1, 3000));
        if (loss != "fracture") return;
        if (shear) key("contact", "fracture_energy_shear_N_m", draw_.log_between(1, 1e5));
        if (!shear || draw_.chance(0.6)) {
            key("contact", "tensile_strength_kPa", draw_.log_between(1, 3000));
            key("contact", "fracture_energy_tension_N_m", draw_.log_between(0.1, 1e4));
        }
        if (draw_.chance(0.3)) key("contact", "unloading", "\"plastic\"");
        else add_bond_in_motion("contact");
    }

    /// Of the first lift joint, by energies.
    void add_bond_of_joint()
    {
        const std::size_t joint = files_.scene.find("[[lift_joint]]\n"), end = files_.scene.find("\n[", joint + 1);
        const std::string table = files_.scene.substr(joint, end - joint);
        if (table.find("cohesion_lost_at_slip = false") != std::string::npos) return;
        if (table.find("cohesion_kPa") == std::string::npos)
            key("[lift_joint]", "cohesion_kPa", draw_.log_between(1, 3000));
        key("[lift_joint]", "bond", "\"fracture\"");
        key("[lift_joint]", "fracture_energy_shear_N_m", draw_.log_between(1, 1e5));
        if (!draw_.chance(0.6)) return;
        key("[lift_joint]", "tensile_strength_kPa", draw_.log_between(1, 3000));
        key("[lift_joint]", "fracture_energy_tension_N_m", draw_.log_between(0.1, 1e4));
        add_bond_in_motion("[lift_joint]");
    }

    void add_bond_in_motion(const char* table)
    {
        if (draw_.chance(0.4)) key(table, "softening", "\"exponential\"");
        if (draw_.chance(0.3)) key(table, "dynamic_increase", draw_.log_between(1, 3));
    }

    void add_water()
    {
        if (!has("[uplift]\n") || has("model = \"none\"") || !(has("[reservoir]\n") || has("[tailwater]\n"))) return;
        const std::string rule = draw_.word({"unchanged", "zero", "full", "mouth", "reynolds"});
        key("uplift", "opening", '"' + rule + '"');
        if (rule == "unchanged" || draw_.chance(0.4)) key("uplift", "after", "\"full\"");
        if (rule == "mouth") key("uplift", "mouth_speed_m_s", draw_.log_between(1e-3, 1e3));
        if (rule != "reynolds") return;
        if (draw_.chance(0.7)) key("uplift", "joint_clearance_m", draw_.log_between(5e-5, 0.02));
        if (draw_.chance(0.2)) key("uplift", "cavitation_pressure_kPa", draw_.between(-99, -1));
        if (has("[reservoir]\n") && draw_.chance(0.3)) key("uplift", "wet_end", "\"with-waves\"");
    }

    /// Friction that falls lags nearly always: without that finite elements refuse it.
    void add_rate()
    {
        const double ratio = draw_.between(0.3, 1.3);
        key("contact", "kinetic_friction_ratio", ratio);
        key("contact", "characteristic_rate_m_s", draw_.log_between(1e-4, 1));
        const bool time = draw_.chance(0.6);
        if (time) key("contact", "relaxation_time_s", draw_.log_between(1e-3, 1));
        if (draw_.chance(time ? 0.3 : 0.95)) key("contact", "relaxation_slip_m", draw_.log_between(1e-4, 0.1));
    }

    /// The record, and itself again.
    void add_sequence()
    {
        key("motion", "sequence", "[\"drawn\", \"again\"]");
        if (draw_.chance(0.5)) key("motion", "sequence_pause_s", draw_.word({"0", "0.013", "0.5"}));
        std::string record = "[[motion.record]]\nname = \"again\"\nhorizontal = \"horizontal.csv\"\n";
        if (!files_.vertical.empty()) record += "vertical = \"vertical.csv\"\n";
        files_.scene.insert(files_.scene.find("[[motion.record]]\n"), record);
    }

    Draw& draw_;
    SceneFiles& files_;
};

/// One value of the text, taken at random, becomes what no one should write.
void spoil(SceneFiles& files, Draw& draw)
{
    const std::string wrong =
        draw.word({"-1", "0", "nan", "inf", "1e300", "-1e-300", "\"word\"", "[]", "true", "1e-12", "1e9"});
    std::vector<std::size_t> places;
    for (std::size_t at = 0; (at = files.scene.find(" = ", at)) != std::string::npos; at += 3) places.push_back(at + 3);
    const std::size_t from = places[static_cast<std::size_t>(draw.whole(0, static_cast<int>(places.size()) - 1))];
    files.scene.replace(from, files.scene.find('\n', from) - from, wrong);
    files.spoilt = true;
}

} // namespace

SceneFiles random_scene(Draw& draw, double radiating)
{
    Writer w{.draw = draw, .text = {}, .rock_by_name = {}};
    add_section(w);
    add_material(w);
    add_contact(w);
    add_rock(w);
    add_water(w);
    add_uplift(w);
    add_forces(w);
    add_model(w);
    add_time(w);
    add_sliding(w);
    add_breadth(w);
    SceneFiles files;
    random_motion(draw, files);
    w.text += "[[motion.record]]\nname = \"drawn\"\nhorizontal = \"horizontal.csv\"\n";
    if (!files.vertical.empty()) w.text += "vertical = \"vertical.csv\"\n";
    files.scene = w.text;
    if (draw.chance(1.0 / 12)) spoil(files, draw);
    // After all draws: a seed keeps its scene, and the value that it spoils.
    if (w.rock && w.rock_by_name.starts_with("mass") && draw.chance(radiating)) w.rock_by_name = radiating_rock(w);
    const std::string head = "[foundation]\n";
    if (w.rock) files.scene.insert(files.scene.find(head) + head.size(), w.rock_by_name);
    files.scene += drawn_anchors(draw, w, files.scene);
    LateLaws(draw, files).add();
    return files;
}

std::filesystem::path write(const SceneFiles& files, const std::filesystem::path& folder)
{
    write_file(folder / "scene.toml", files.scene);
    write_file(folder / "horizontal.csv", files.horizontal);
    if (!files.vertical.empty()) write_file(folder / "vertical.csv", files.vertical);
    return folder / "scene.toml";
}

} // namespace damslip::random
