#include "sliding/equilibrium/equilibrium_tables.hpp"

#include "core/units.hpp"

#include <algorithm>

namespace damslip::sliding {

namespace {

constexpr double kilo = 1e3; // 1 kN = 1000 N

std::vector<Cell> load_row(const std::string& name, const Force& f)
{
    return {name, f.x / kilo, f.y / kilo, f.moment / kilo};
}

Cell level(const std::optional<double>& y)
{
    return y ? Cell(*y) : Cell(std::monostate{});
}

/// Of a base that takes no tension: what has become of its joint.
Cell joint(const Equilibrium& e)
{
    if (e.crack_rule == CrackRule::none) return {};
    if (e.base.status == CrackStatus::closed && e.base.crack.length > 0.0) return std::string("cracked, closed again");
    return std::string(word(e.base.status));
}

std::vector<Cell> equilibrium_row(const Equilibrium& e)
{
    return {e.name,
            std::string(word(e.kind)),
            std::string(word(e.crack_rule)),
            e.follows.empty() ? Cell() : Cell(e.follows),
            level(e.reservoir_level),
            level(e.tailwater_level),
            e.k_h,
            level(e.of_pga),
            e.k_v,
            e.base.effective_normal / kilo,
            e.shear / kilo,
            e.base.uplift.force / kilo,
            e.sliding_factor,
            e.friction_factor,
            e.sliding_factor_residual,
            e.overturning_factor,
            e.flotation_factor,
            e.resultant_from_toe,
            e.eccentricity,
            std::string(word(e.zone)),
            e.heel_stress / units::kPa,
            e.toe_stress / units::kPa,
            joint(e),
            e.base.crack.length,
            e.cohesive_length,
            e.critical_friction,
            e.yield_acceleration,
            e.yield_acceleration / units::standard_gravity,
            e.yield_acceleration_upstream,
            e.tipping_acceleration};
}

} // namespace

Table load_table(const Equilibrium& e)
{
    Table table{"Loads: " + e.name,
                {{"load", "load", "", 4},
                 {"force_x_kN_per_m", "horizontal, downstream", "kN/m", 6},
                 {"force_y_kN_per_m", "vertical, up", "kN/m", 6},
                 {"moment_about_heel_kNm_per_m", "moment about the heel", "kNm/m", 6}},
                {},
                {"Moments are counter-clockwise: a downstream thrust above the heel is negative."}};
    for (const Load& load : e.loads) table.rows.push_back(load_row(load.name, load.force.total()));
    table.rows.push_back(load_row("sum without uplift", e.load));
    const double u = e.base.uplift.force;
    const Force uplift{u * e.frame.n.x, u * e.frame.n.y, e.base.uplift.moment_about_heel};
    table.rows.push_back(load_row("uplift", uplift));
    table.rows.push_back(load_row("sum", e.load + uplift));
    return table;
}

Table equilibrium_table(const std::vector<Equilibrium>& all)
{
    Table table{"Limit equilibrium",
                {{"combination", "combination", "", 4},
                 {"kind", "kind", "", 4},
                 {"crack_rule", "crack rule", "", 4},
                 {"follows", "follows", "", 4},
                 {"reservoir_level_m", "reservoir", "m", 4},
                 {"tailwater_level_m", "tailwater", "m", 4},
                 {"k_h", "k_h", "–", 3},
                 {"k_h_of_pga", "k_h of the PGA", "–", 3},
                 {"k_v", "k_v", "–", 3},
                 {"normal_force_effective_kN_per_m", "N'", "kN/m", 5},
                 {"shear_force_kN_per_m", "T", "kN/m", 5},
                 {"uplift_kN_per_m", "U", "kN/m", 5},
                 {"sliding_factor", "FS sliding", "–", 4},
                 {"sliding_factor_friction_only", "FS sliding, friction only", "–", 4},
                 {"sliding_factor_residual", "FS sliding, residual", "–", 4},
                 {"overturning_factor", "FS overturning", "–", 4},
                 {"flotation_factor", "FS flotation", "–", 4},
                 {"resultant_from_toe_m", "resultant from toe", "m", 4},
                 {"eccentricity_m", "eccentricity", "m", 4},
                 {"resultant_zone", "zone", "", 4},
                 {"heel_stress_kPa", "heel stress", "kPa", 4},
                 {"toe_stress_kPa", "toe stress", "kPa", 4},
                 {"joint", "joint", "", 4},
                 {"crack_m", "crack", "m", 4},
                 {"cohesive_length_m", "bonded length", "m", 4},
                 {"critical_friction", "critical μ", "–", 4},
                 {"yield_acceleration_m_s2", "a_y", "m/s²", 5},
                 {"yield_coefficient_g", "a_y", "g", 4},
                 {"yield_acceleration_upstream_m_s2", "a_y upstream", "m/s²", 5},
                 {"tipping_acceleration_m_s2", "tipping", "m/s²", 4}},
                {},
                {}};
    for (const Equilibrium& e : all) {
        table.rows.push_back(equilibrium_row(e));
        for (const std::string& note : e.notes)
            table.notes.push_back(e.name + " (crack rule " + word(e.crack_rule) + "): " + note + ".");
    }
    return table;
}

Table verdict_table(const std::vector<Equilibrium>& all)
{
    Table table{"Verdicts",
                {{"combination", "combination", "", 4},
                 {"crack_rule", "crack rule", "", 4},
                 {"check", "check", "", 4},
                 {"value", "value", "–", 4},
                 {"required", "required", "–", 4},
                 {"verdict", "verdict", "", 4},
                 {"source", "source", "", 4}},
                {},
                {}};
    for (const Equilibrium& e : all)
        for (const Check& check : e.checks)
            table.rows.push_back({e.name, std::string(word(e.crack_rule)), check.quantity, check.value,
                                  level(check.required), std::string(word(check.verdict)), check.source});
    return table;
}

Table profile_table(const PressureProfile& profile)
{
    Table table{"Uplift pressure along the base",
                {{"distance_from_heel_m", "from the heel", "m", 5}, {"pressure_kPa", "pressure", "kPa", 5}},
                {},
                {"A repeated distance is a jump."}};
    for (const ProfilePoint& p : profile.points) table.rows.push_back({p.distance, p.pressure / units::kPa});
    return table;
}

Table uplift_comparison_table(const std::vector<UpliftComparison>& all)
{
    Table table{"Uplift models, no crack",
                {{"uplift_model", "model", "", 4},
                 {"uplift_kN_per_m", "U", "kN/m", 6},
                 {"uplift_from_heel_m", "acts from the heel", "m", 4},
                 {"critical_friction", "critical μ", "–", 4}},
                {},
                {}};
    for (const UpliftComparison& c : all) {
        const double u = c.uplift.force;
        table.rows.push_back({std::string(word(c.model)), u / kilo,
                              u > 0.0 ? Cell(c.uplift.moment_about_heel / u) : Cell(std::monostate{}),
                              c.critical_friction});
    }
    return table;
}

} // namespace damslip::sliding
