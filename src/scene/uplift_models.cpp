#include "scene/uplift_row.hpp"
#include "scene/words.hpp"

#include <algorithm>
#include <cassert>

namespace damslip {

/// The models with a rule of their own for cracks: their profiles are those of sliding/uplift.
std::vector<UpliftRow> named_uplift_models()
{
    return {
        {.word = "none", .meaning = "", .needs = "", .named = UpliftModel::none},
        {.word = "linear", .meaning = "heel to toe, ruptured curtain", .needs = "", .named = UpliftModel::linear},
        {.word = "curtain",
         .meaning = "printed 2/3 rule",
         .needs = "a [curtain] with its distance_m",
         .there = [](const Scene& s) { return s.curtain.has_value(); },
         .named = UpliftModel::curtain},
        {.word = "drains",
         .meaning = "USACE",
         .needs = "a [drains] with its distance_m",
         .there = [](const Scene& s) { return s.drains.has_value(); },
         .named = UpliftModel::drains},
        {.word = "points",
         .meaning = "",
         .needs = "uplift.points_m",
         .there = [](const Scene& s) { return s.uplift && !s.uplift->points.empty(); },
         .named = UpliftModel::points},
        {.word = "seepage", .meaning = "Darcy solution", .needs = "", .named = UpliftModel::seepage},
    };
}

const UpliftRow& uplift_row(UpliftModel model)
{
    return uplift_rows()[std::size_t(model)];
}

UpliftModel uplift_model(std::string_view word)
{
    const auto rows = uplift_rows();
    const auto found =
        std::find_if(rows.begin(), rows.end(), [word](const UpliftRow& row) { return row.word == word; });
    assert(found != rows.end());
    return UpliftModel(found - rows.begin());
}

bool has_what_it_needs(const Scene& scene, const UpliftRow& row)
{
    return !row.there || row.there(scene);
}

std::string uplift_words()
{
    std::string words;
    for (const UpliftRow& row : uplift_rows()) words += (words.empty() ? "" : ", ") + row.word;
    return words;
}

const char* word(UpliftModel model)
{
    return uplift_row(model).word.c_str();
}

} // namespace damslip
