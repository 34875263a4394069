#include "scene/keys.hpp"

#include "scene/key_parts.hpp"
#include "scene/usual.hpp"

namespace damslip {

std::vector<KeyGroup> key_groups(SectionInput& section)
{
    using namespace keys;
    std::vector<KeyGroup> groups;
    groups.push_back({"",
                      Presence::always,
                      "Top level.",
                      {word("title", "file name", "what the scene is", "\"Reference dam\"", at(&Scene::title))},
                      [](Scene& s) -> void* { return &s; },
                      [](const Scene& s) { return std::vector<const void*>{&s}; }});
    groups.push_back(project_group());
    groups.push_back(
        {"site",
         Presence::always,
         "Where the dam stands.",
         {number("gravity", {{"m_s2", 1.0}}, Range::inside(9, 10.5), "9.81",
                 "gravity in loads; the unit g of records is always 9.80665", "9.81", at(&Scene::gravity))},
         [](Scene& s) -> void* { return &s; },
         [](const Scene& s) { return std::vector<const void*>{&s}; }});
    groups.push_back(section_group(section));
    const auto append = [&groups](std::vector<KeyGroup> more) {
        for (KeyGroup& g : more) groups.push_back(std::move(g));
    };
    append(wedge_groups());
    groups.push_back(group(
        "dam", "Concrete of the dam, or rock of the block.", &Scene::dam,
        {number("density", density, Range::half_open(0, 1e5), "required", "density", "2500", at(&Material::density)),
         number("young_modulus", modulus, Range::above(0), "none; FE commands ask for it", "Young's modulus", "25",
                at(&Material::young_modulus)),
         number("poisson_ratio", none, Range{0, 0.5, false, true}, "0.2", "Poisson's ratio", "0.17",
                at(&Material::poisson_ratio))}));
    append(base_groups());
    append(water_groups());
    using F = PointForce;
    groups.push_back(list_group<F>(
        "force", "A force on the dam given by the user.", [](Scene& s) -> std::vector<F>& { return s.forces; },
        {word("name", "force", "name in the tables", "\"gate\"", at(&F::name)),
         number("x", length, Range::any(), "0", "where it acts, downstream of the heel", "6",
                [](void* o) -> Slot { return &static_cast<F*>(o)->at.x; }),
         number("y", length, Range::any(), "0", "where it acts, above the heel", "60",
                [](void* o) -> Slot { return &static_cast<F*>(o)->at.y; }),
         number("force_x", line_force, Range::any(), "0", "positive downstream", "50", at(&F::force_x)),
         number("force_y", line_force, Range::any(), "0", "positive up", "-200", at(&F::force_y))}));
    append(motion_groups());
    groups.push_back(group(
        "regressions", "Empirical regressions of the slip: what they need beyond the record.", &Scene::regressions,
        {number("period", seconds, Range::between(0, 10), "0 (rigid)",
                "fundamental period of the sliding mass: for the regressions of flexible masses; above 0 `screen` also "
                "follows its vibration, decoupled from the slip and coupled to it",
                "0.3", at(&RegressionOptions::period))}));
    using W = RegressionWeightKey;
    groups.push_back(list_group<W>(
        "regressions.weight",
        "Weight of one regression in the weighted median and band; without any, all that are valid count equally.",
        [](Scene& s) -> std::vector<W>& { return s.regressions.weights; },
        {word("model", "required", "id of a regression, as listed in docs/regressions.md", "\"jibson-2007-ratio\"",
              at(&W::model)),
         number("weight", none, Range::at_least(0), "1", "relative to the other weights", "2", at(&W::weight))}));
    groups.push_back(flexible_block_group());
    groups.push_back(group(
        "criteria", "What is allowed.", &Scene::criteria,
        {number("allowable_slip", {{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}}, Range::at_least(0), "none",
                "slip verdicts compare with this", "0.1", at(&Criteria::allowable_slip)),
         word("document", "none", "shipped set of required safety factors", "\"cadam3d\"", at(&Criteria::document)),
         number("pga_fraction", none, Range::half_open(0, 2), "1",
                "of the seismic combination that the program makes: k_h as share of the largest PGA of the records",
                "0.67", at(&Criteria::pga_fraction)),
         number("pga_v_fraction", none, Range::between(0, 2), "0",
                "and k_v as share of their largest vertical acceleration; it lightens the dam", "0.3",
                at(&Criteria::pga_v_fraction))}));
    groups.push_back(combination_group());
    append(fe_groups());
    add_usual_ranges(groups);
    return groups;
}

} // namespace damslip
