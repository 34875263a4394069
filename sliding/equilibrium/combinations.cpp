#include "core/input_error.hpp"
#include "core/units.hpp"
#include "scene/section.hpp"
#include "scene/uplift_models.hpp"
#include "scene/water.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <span>
#include <string_view>
#include <tuple>

namespace damslip::sliding {

namespace {

/// Required values of one document for one kind of combination; 0: the document does not say.
struct CriteriaRow {
    CombinationKind kind;
    double sliding, sliding_residual, flotation, overturning; ///< [-]
    ResultantZone resultant;
};

/// A shipped set of required values. Only values read in the cited text are shipped; for any other document the user
/// gives the required values in the combinations.
struct CriteriaDocument {
    std::string_view name;     ///< for criteria.document
    std::string_view citation; ///< printed beside every verdict
    std::span<const CriteriaRow> rows;
};

// CADAM3D help, page "Performance criteria" (cadam3d.com/help/Performancecriteria.html), table "Safety factors,
// stability criteria and allowable stresses": columns normal, unusual (ineffective drains or ice), post-seismic,
// seismic. Of its two rows for the peak factor (with and without tests) the stricter one is kept. It gives no
// overturning factor.
constexpr std::array cadam3d{
    CriteriaRow{CombinationKind::usual, 3.0, 1.5, 1.2, 0.0, ResultantZone::kern},
    CriteriaRow{CombinationKind::unusual, 2.0, 1.3, 1.1, 0.0, ResultantZone::middle_half},
    CriteriaRow{CombinationKind::post_seismic, 2.0, 1.1, 1.1, 0.0, ResultantZone::base},
    CriteriaRow{CombinationKind::extreme, 1.3, 1.0, 1.1, 0.0, ResultantZone::base},
};

constexpr std::array documents{
    CriteriaDocument{"cadam3d", "CADAM3D help, Performance criteria, default values", cadam3d},
};

std::optional<double> given(double value)
{
    return value > 0.0 ? std::optional(value) : std::nullopt;
}

const CriteriaDocument& find_document(const Scene& scene)
{
    for (const CriteriaDocument& d : documents)
        if (d.name == scene.criteria.document) return d;
    std::string names;
    for (const CriteriaDocument& d : documents) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", d.name);
    throw InputError(Diagnostic{scene.file.string(), 0, 0,
                                fmt::format("criteria.document = \"{}\" is not shipped.", scene.criteria.document),
                                names, "choose one of these, or give the required values in the combinations"});
}

ResultantZone zone_of(const Scene& scene, const std::string& text)
{
    for (const ResultantZone zone : {ResultantZone::kern, ResultantZone::middle_half, ResultantZone::base})
        if (text == word(zone)) return zone;
    throw InputError(Diagnostic{scene.file.string(), 0, 0,
                                fmt::format("required_resultant = \"{}\" is not allowed.", text),
                                "\"kern\", \"middle-half\" or \"base\"", "write one of these"});
}

Requirements from_document(const Scene& scene, const Combination& combination)
{
    Requirements out;
    if (scene.criteria.document.empty() || scene.criteria.document.ends_with(".toml")) return out;
    const CriteriaDocument& document = find_document(scene);
    const auto row = std::find_if(document.rows.begin(), document.rows.end(),
                                  [&](const CriteriaRow& r) { return r.kind == combination.kind; });
    if (row == document.rows.end()) return out;
    // Where only the residual strength is left, its own required factor applies.
    out.sliding = given(combination.residual_strength ? row->sliding_residual : row->sliding);
    out.sliding_residual = given(row->sliding_residual);
    out.flotation = given(row->flotation);
    out.overturning = given(row->overturning);
    out.resultant = row->resultant;
    out.source = document.citation;
    return out;
}

} // namespace

Requirements requirements(const Scene& scene, const Combination& combination)
{
    Requirements out = from_document(scene, combination);
    if (combination.required_sliding_factor) out.sliding = combination.required_sliding_factor;
    if (combination.required_residual_factor) {
        out.sliding_residual = combination.required_residual_factor;
        if (combination.residual_strength) out.sliding = out.sliding_residual;
    }
    if (combination.required_flotation_factor) out.flotation = combination.required_flotation_factor;
    if (combination.required_overturning_factor) out.overturning = combination.required_overturning_factor;
    if (combination.required_resultant) out.resultant = zone_of(scene, *combination.required_resultant);
    if (!combination.source.empty()) out.source = combination.source;
    return out;
}

namespace {

Combination named(const char* name, CombinationKind kind)
{
    Combination c;
    c.name = name;
    c.kind = kind;
    return c;
}

bool tension(const Equilibrium& e)
{
    return std::min(e.heel_stress, e.toe_stress) < 0.0 || e.zone == ResultantZone::outside;
}

/// The rule of the report "with crack".
CrackRule crack_rule(const Scene& scene, const Combination& c)
{
    const CrackRule rule = scene.uplift ? scene.uplift->crack : CrackRule::none;
    const bool shaken = c.k_h != 0.0 || c.k_v != 0.0;
    if (!shaken) return CrackRule::fixed_static;
    return rule == CrackRule::none || rule == CrackRule::fixed_static ? CrackRule::seismic_unchanged : rule;
}

/// The combination with the seismic coefficients that it gives as shares of the records' peaks.
Combination with_coefficients(Combination c, const PeakGround& peak)
{
    if (c.pga_fraction) c.k_h = *c.pga_fraction * std::abs(peak.a_h) / units::standard_gravity;
    if (c.pga_v_fraction) c.k_v = 0.0 - *c.pga_v_fraction * std::abs(peak.a_v) / units::standard_gravity;
    return c;
}

/// What the program's own seismic combination takes of the records.
void note_coefficients(const Criteria& criteria, const PeakGround& peak, std::vector<Note>& notes)
{
    notes.push_back(criteria.pga_fraction == 1.0 ? Note{NoteKind::k_h_full}
                                                 : Note{NoteKind::k_h_share, {criteria.pga_fraction}});
    if (peak.a_v == 0.0) return;
    notes.push_back(criteria.pga_v_fraction == 0.0
                        ? Note{NoteKind::k_v_zero, {std::abs(peak.a_v) / units::standard_gravity}}
                        : Note{NoteKind::k_v_share, {criteria.pga_v_fraction}});
}

/// The joint that an extreme combination leaves behind.
struct OpenedJoint {
    std::string combination;
    Crack crack;
};

OpenedJoint opened_by(const std::string& name, const Equilibrium& e)
{
    Crack crack = e.base.crack;
    if (e.base.status == CrackStatus::through || e.base.status == CrackStatus::open) crack.length = e.frame.length;
    return {name, crack};
}

/// One combination: without crack rule of its own also with a crack, where that matters.
std::vector<Equilibrium> reports(const Scene& scene, Combination c, const SeepageProfile& seepage, const Crack& opened)
{
    const Requirements required = requirements(scene, c);
    const bool after = c.kind == CombinationKind::post_seismic;
    if (c.crack) return {evaluate(scene, c, required, {seepage, after ? opened : Crack{}})};
    c.crack = CrackRule::none;
    std::vector<Equilibrium> out{evaluate(scene, c, required, {seepage, {}})};
    if (tension(out.back()) || (after && opened.length > 0.0)) {
        c.crack = crack_rule(scene, c);
        c.name += ", cracked";
        out.push_back(evaluate(scene, c, required, {seepage, opened}));
    }
    return out;
}

/// Is the post-seismic state `a` the worse one? The same answer in whatever order the states come.
bool governs(const Equilibrium& a, const Equilibrium& b)
{
    return std::tuple(a.sliding_factor, -a.base.crack.length, a.follows) <
           std::tuple(b.sliding_factor, -b.base.crack.length, b.follows);
}

/// A post-seismic combination after the extreme one it names, or after the one that leaves it worst.
std::vector<Equilibrium> post_seismic_reports(const Scene& scene, const Combination& c, const SeepageProfile& seepage,
                                              const std::vector<OpenedJoint>& joints)
{
    std::vector<Equilibrium> worst;
    for (const OpenedJoint& joint : joints) {
        if (!c.follows.empty() && c.follows != joint.combination) continue;
        std::vector<Equilibrium> state = reports(scene, c, seepage, joint.crack);
        for (Equilibrium& e : state) e.follows = joint.combination;
        if (worst.empty() || governs(state.back(), worst.back())) worst = std::move(state);
    }
    return worst.empty() ? reports(scene, c, seepage, {}) : worst;
}

} // namespace

std::vector<Combination> combinations(const Scene& scene, const PeakGround& peak)
{
    if (!scene.combinations.empty()) {
        std::vector<Combination> given;
        for (const Combination& c : scene.combinations) given.push_back(with_coefficients(c, peak));
        return given;
    }
    std::vector<Combination> out{named("usual", CombinationKind::usual)};
    if (drains_lower_uplift(scene)) {
        out.push_back(named("drains ineffective", CombinationKind::unusual));
        out.back().drains_effective = false;
    }
    if (scene.ice) {
        out.push_back(named("ice", CombinationKind::unusual));
        out.back().ice = true;
    }
    if (peak.a_h != 0.0 || peak.a_v != 0.0) {
        Combination c = named("seismic", CombinationKind::extreme);
        c.ice = scene.ice.has_value();
        c.pga_fraction = scene.criteria.pga_fraction;
        c.pga_v_fraction = scene.criteria.pga_v_fraction;
        out.push_back(with_coefficients(c, peak));
    }
    out.push_back(after_earthquake(scene));
    return out;
}

Combination after_earthquake(const Scene& scene)
{
    for (const Combination& given : scene.combinations)
        if (given.kind == CombinationKind::post_seismic) return given;
    Combination after = named("post-seismic", CombinationKind::post_seismic);
    after.ice = scene.ice.has_value();
    after.drains_effective = after.curtain_intact = false;
    after.residual_strength = true;
    return after;
}

std::vector<Equilibrium> evaluate_combinations(const Scene& scene, const PeakGround& peak,
                                               const SeepageProfile& seepage)
{
    const std::vector<Combination> all = combinations(scene, peak);
    std::vector<std::vector<Equilibrium>> states(all.size());
    std::vector<OpenedJoint> joints;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].kind == CombinationKind::post_seismic) continue;
        states[i] = reports(scene, all[i], seepage, {});
        if (all[i].kind == CombinationKind::extreme) joints.push_back(opened_by(all[i].name, states[i].back()));
        if (scene.combinations.empty() && all[i].kind == CombinationKind::extreme)
            note_coefficients(scene.criteria, peak, states[i].front().notes);
    }
    std::vector<Equilibrium> out;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].kind == CombinationKind::post_seismic)
            states[i] = post_seismic_reports(scene, all[i], seepage, joints);
        for (Equilibrium& e : states[i]) {
            if (e.k_h != 0.0 && peak.a_h != 0.0) e.of_pga = e.k_h * units::standard_gravity / std::abs(peak.a_h);
            out.push_back(std::move(e));
        }
    }
    return out;
}

std::vector<UpliftComparison> compare_uplift(const Scene& scene, const SeepageProfile& seepage)
{
    Scene variant = scene;
    if (!variant.uplift) variant.uplift.emplace();
    std::vector<UpliftModel> models{UpliftModel::none, UpliftModel::linear};
    if (scene.curtain) models.push_back(UpliftModel::curtain);
    if (scene.drains) models.push_back(UpliftModel::drains);
    if (!variant.uplift->points.empty()) models.push_back(UpliftModel::points);
    if (seepage) models.push_back(UpliftModel::seepage);
    for (std::size_t i = 0; i < uplift_rows().size(); ++i)
        if (const UpliftRow& row = uplift_rows()[i]; row.profile && has_what_it_needs(scene, row))
            models.push_back(UpliftModel(i));

    std::vector<UpliftComparison> out;
    for (const UpliftModel model : models) {
        variant.uplift->model = model;
        StaticCase static_case = scene_static_case(variant);
        static_case.crack = CrackRule::none;
        const BaseState state = base_state(variant, static_case, seepage);
        const RigidBlock block = make_rigid_block(variant, state, static_case.loads.reservoir_level);
        out.push_back({model, state.base.profile, state.base.uplift, critical_friction(block)});
    }
    return out;
}

} // namespace damslip::sliding
