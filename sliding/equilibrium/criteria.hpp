#pragma once

#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <span>
#include <string_view>

namespace damslip::sliding {

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

std::span<const CriteriaDocument> criteria_documents();

/// The combination's own required values; what it leaves open from the scene's criteria document.
/// Errors: InputError for an unknown document or resultant word.
Requirements requirements(const Scene& scene, const Combination& combination);

} // namespace damslip::sliding
