#include "scene/added_mass_formulas.hpp"

namespace damslip {

/// Those of the source. Their values are those of sliding/loads, which also sums the series.
std::vector<AddedMassRow> named_added_mass_formulas()
{
    return {
        {.word = "westergaard",
         .meaning = "rigorous, 3-1",
         .name = "Westergaard's series, incompressible",
         .named = AddedMassFormula::westergaard},
        {.word = "westergaard-simplified",
         .meaning = "3-4",
         .name = "Westergaard's parabola",
         .named = AddedMassFormula::westergaard_simplified},
        {.word = "zangar", .meaning = "3-8", .name = "Zangar's", .named = AddedMassFormula::zangar},
        {.word = "goldgruber", .meaning = "3-10", .name = "Goldgruber's", .named = AddedMassFormula::goldgruber},
    };
}

const AddedMassRow& added_mass_row(AddedMassFormula formula)
{
    return added_mass_rows()[std::size_t(formula)];
}

} // namespace damslip
