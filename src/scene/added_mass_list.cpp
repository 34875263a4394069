#include "scene/added_mass_formulas.hpp"

#include <cassert>

namespace damslip {

// The files of rows. New ones come last, so that the places of the named formulas stay.
std::vector<AddedMassRow> named_added_mass_formulas();

std::span<const AddedMassRow> added_mass_rows()
{
    static const std::vector<AddedMassRow> rows = [] {
        std::vector<AddedMassRow> all;
        for (auto* file : {
                 named_added_mass_formulas,
             })
            for (AddedMassRow& row : file()) {
                assert(!row.named || *row.named == AddedMassFormula(all.size()));
                all.push_back(std::move(row));
            }
        return all;
    }();
    return rows;
}

} // namespace damslip
