#include "scene/words.hpp"

namespace damslip {

const char* word(UpliftModel model)
{
    switch (model) {
    case UpliftModel::none:
        return "none";
    case UpliftModel::linear:
        return "linear";
    case UpliftModel::curtain:
        return "curtain";
    case UpliftModel::drains:
        return "drains";
    case UpliftModel::points:
        return "points";
    case UpliftModel::seepage:
        return "seepage";
    }
    return "";
}

} // namespace damslip
