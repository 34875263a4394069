#include "scene/uplift_models.hpp"

#include <cassert>

namespace damslip {

// The files of rows. New ones come last, so that the places of the named models stay.
std::vector<UpliftRow> named_uplift_models();

std::span<const UpliftRow> uplift_rows()
{
    static const std::vector<UpliftRow> rows = [] {
        std::vector<UpliftRow> all;
        for (auto* file : {
                 named_uplift_models,
             })
            for (UpliftRow& row : file()) {
                assert(!row.named || *row.named == UpliftModel(all.size()));
                all.push_back(std::move(row));
            }
        return all;
    }();
    return rows;
}

} // namespace damslip
