#include "sliding/equilibrium/criteria.hpp"

#include "core/input_error.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <span>
#include <string_view>

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
    if (scene.criteria.document.empty()) return out;
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
    if (combination.required_flotation_factor) out.flotation = combination.required_flotation_factor;
    if (combination.required_overturning_factor) out.overturning = combination.required_overturning_factor;
    if (combination.required_resultant) out.resultant = zone_of(scene, *combination.required_resultant);
    if (!combination.source.empty()) out.source = combination.source;
    return out;
}

} // namespace damslip::sliding
