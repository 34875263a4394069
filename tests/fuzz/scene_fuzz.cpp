// Scene reader: any bytes either give a scene that keeps its promises (finite values, a section with area or a wedge with volume, a resolved scene that reads
// back to the same text), or an InputError with at least one sentence.
#include "core/input_error.hpp"
#include "scene/effect_plan.hpp"
#include "scene/read.hpp"
#include "scene/section.hpp"
#include "scene/rock_wedge.hpp"
#include "scene/write.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

using namespace damslip;

void demand(bool condition)
{
    if (!condition) std::abort();
}

void check_block(const Scene& scene)
{
    if (scene.wedge) {
        const RockWedge& w = *scene.wedge;
        demand(w.planes.size() == 2 && std::isfinite(wedge_volume(w)) && wedge_volume(w) > 0);
        for (std::size_t i = 0; i < 2; ++i)
            demand(std::isfinite(wedge_area(w, i)) && wedge_area(w, i) >= 0 &&
                   std::isfinite(wedge_water_pressure(w, i, scene.gravity)));
        return;
    }
    demand(std::isfinite(area(scene.section)) && area(scene.section) > 0);
    demand(std::isfinite(base_length(scene.section)) && base_length(scene.section) > 0);
    demand(std::isfinite(scene.contact.friction) && scene.contact.friction >= 0);
    demand(scene.dam.density > 0 && std::isfinite(scene.dam.density));
    if (scene.reservoir) demand(std::isfinite(scene.reservoir->level) && scene.reservoir->level >= 0);
}

void check(const Scene& scene)
{
    check_block(scene);
    const std::string resolved = resolved_toml(scene);
    const Scene back = parse_scene(resolved, "resolved.toml", FileCheck::skip);
    demand(resolved_toml(back) == resolved);

    const EffectPlan plan = make_effect_plan(scene, Method::rigid_block);
    const Scene reduced = called_for(plan, scene);
    demand(reduced.reservoir.has_value() == plan.on(Effect::hydrostatic_thrust));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        check(parse_scene(text, "fuzz.toml", FileCheck::skip));
    } catch (const InputError& error) {
        demand(!error.diagnostics().empty() && !error.diagnostics().front().problem.empty());
    }
    return 0;
}
