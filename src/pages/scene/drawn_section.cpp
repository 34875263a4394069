#include "pages/scene/drawn_section.hpp"

#include "analysis/prepare/seepage_source.hpp"
#include "pages/report/standalone_svg.hpp"
#include "pages/scene/section_drawing.hpp"
#include "scene/effect_plan.hpp"

namespace damslip::pages {

std::string drawn_section(const Scene& given)
{
    const Scene scene = called_for(make_effect_plan(given, Method::rigid_block), given);
    return standalone_svg(section_drawing(scene, SeepageSource().uplift_of(scene)).svg);
}

} // namespace damslip::pages
