#include "scene/added_mass_formulas.hpp"

namespace damslip {

// The files of rows. New ones come last, so that the places of the named formulas stay.
std::vector<AddedMassRow> named_added_mass_formulas();

std::span<const AddedMassRow> added_mass_rows()
{
    static const std::vector<AddedMassRow> rows = rows_of_files<AddedMassFormula, AddedMassRow>({
        named_added_mass_formulas,
    });
    return rows;
}

} // namespace damslip
