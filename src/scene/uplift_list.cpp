#include "scene/uplift_models.hpp"

namespace damslip {

// The files of rows. New ones come last, so that the places of the named models stay.
std::vector<UpliftRow> named_uplift_models();

std::span<const UpliftRow> uplift_rows()
{
    static const std::vector<UpliftRow> rows = rows_of_files<UpliftModel, UpliftRow>({
        named_uplift_models,
    });
    return rows;
}

} // namespace damslip
