#include "pages/scene/drawn_section.hpp"

#include "analysis/prepare/seepage_source.hpp"
#include "pages/report/standalone_svg.hpp"
#include "pages/scene/section_drawing.hpp"
#include "scene/effect_plan.hpp"
#include "sliding/uplift/uplift_profile.hpp"

namespace damslip::pages {

std::string drawn_section(const Scene& given)
{
    const Scene scene = called_for(make_effect_plan(given, Method::rigid_block), given);
    SeepageSource seepage;
    PressureProfile uplift;
    if (scene.uplift) uplift = sliding::uplift_profile(scene, scene_uplift_state(scene), {}, seepage.profile_of(scene));
    return standalone_svg(section_drawing(scene, uplift).svg);
}

} // namespace damslip::pages
