#include "pages/scene/limits.hpp"

#include "pages/scene/effect_table.hpp"
#include "scene/rock_mass.hpp"

namespace damslip::pages {

namespace {

/// One assumption and where it ends.
struct Limit {
    std::string of, taken, ends;
};

Limit rock_limit(const Scene& scene)
{
    switch (rock_kind(scene)) {
    case RockKind::rigid:
        return {"rock", "rigid: it moves as the record says.",
                "Rock that gives way or lets waves leave changes the slip: give [foundation]."};
    case RockKind::massless:
        return {"rock", "elastic without mass.",
                "It keeps every wave, which makes the dam hop and slide further than on rock that lets waves leave."};
    case RockKind::boxed:
        return {"rock", "elastic with mass, in a box.",
                "Waves come back from the edges of the box as far as those do."};
    case RockKind::radiating:
        return {"rock", "an elastic half space of one kind of rock, through which waves leave.",
                "Layers, faults and a valley's shape are not in it. The record is the motion of the rock's free "
                "surface without the dam; waves come straight from below, the same along the base."};
    }
    return {};
}

std::vector<Limit> block_limits(const Scene& scene)
{
    std::vector<Limit> list{
        {"rigid block", "the mass moves as one piece and stays flat on its plane.",
         "It knows no vibration of its own, which may make the slip smaller or larger than this: it is no upper bound. "
         "Where the block tips first the report says so."},
        {"regressions", "the horizontal component of the record and the yield acceleration.",
         "Each holds within the data it was fitted to; those outside are named and not weighted. They check the "
         "order of magnitude."}};
    if (scene.wedge)
        list.push_back(
            {"wedge", "a rigid wedge on its plane or planes.", "It does not turn; no other plane is tried."});
    return list;
}

std::vector<Limit> element_limits(const Scene& scene)
{
    std::vector<Limit> list{
        {"materials", "concrete and rock are linear elastic.",
         "They do not crack: stresses beyond the strength are shown, and nothing follows from them."},
        rock_limit(scene),
        {"joints", "they slide and open at their pairs of nodes.",
         scene.contact.sliding == JointPath::small
             ? "Nodes stay opposite each other: a slip is to be small against the length of the base."
             : "The base slides as far as contact.max_slip_m; other joints little."},
        {"±", "what the time step leaves open, and the change against elements of twice the size.",
         "It does not hold what is not known of the dam: friction, uplift, level, record. A sweep does."}};
    if (scene.reservoir)
        list.push_back({"water", "added mass or linear acoustic water, as the table of effects says.",
                        "No cavitation, no wave over the crest, no water that follows the dam downstream."});
    return list;
}

} // namespace

Section limits_section(const Scene& scene, Method method)
{
    std::vector<Limit> rows{{"plane section", "one metre of the dam, the same along the axis.",
                             "Abutments, arching and shear keys between monoliths are not in it."},
                            {"slip plane",
                             scene.wedge ? "the planes that are given."
                             : method == Method::finite_elements && !scene.lift_joints.empty()
                                 ? "the base and the lift joints."
                                 : "the base alone.",
                             "No other plane through rock or dam is looked for."},
                            {"friction", "Coulomb's, the same all along a plane, as the list of inputs has it.",
                             "It is measured or assumed, not computed; the slip depends on it as on little else."}};
    if (scene.uplift && scene.uplift->water.opening == OpeningWater::unchanged)
        rows.push_back({"uplift", "as before the earthquake, while the dam moves.",
                        "Water that enters or leaves a joint as it opens changes it: uplift.opening."});
    if (method == Method::finite_elements)
        for (Limit& limit : element_limits(scene)) rows.push_back(std::move(limit));
    for (Limit& limit : block_limits(scene)) rows.push_back(std::move(limit));
    return {"Limits of validity",
            {rows_part(table_of<Limit>("Limits of validity",
                                       {{{"of", "of"}, &Limit::of},
                                        {{"taken", "is taken as"}, &Limit::taken},
                                        {{"ends", "and ends where"}, &Limit::ends}},
                                       rows))},
            Fold::open};
}

TablePart record_part(Table table)
{
    return rows_part(
        std::move(table),
        {"As they act: after all factors. PGA, PGV: largest acceleration and velocity of the ground; Arias "
         "intensity: π/2g times the integral of the squared horizontal acceleration; D5-95: time in which "
         "it grows from 5 to 95 %; mean period: of the Fourier amplitudes squared, 0.25 to 20 Hz. "
         "Horizontal acceleration is positive upstream, which drives the dam downstream; vertical up."});
}

TablePart effect_part(const EffectPlan& plan)
{
    return rows_part(effect_table(plan),
                     {"on: taken into account; because: the key that decides it; cost: what the run "
                      "carries for it. Effects that are off are neither read nor built."});
}

} // namespace damslip::pages
