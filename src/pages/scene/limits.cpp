#include "pages/scene/scene_pages.hpp"

#include "scene/rock_mass.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

namespace damslip::pages {

namespace {

/// One assumption of a model.
struct Limit {
    std::string aspect, assumption, invalid_when, instead;
};

Limit rock_limit(const Scene& scene)
{
    switch (rock_kind(scene)) {
    case RockKind::rigid:
        return {"rock", "rigid: it moves as the record does",
                "the rock is about as soft as the dam, or takes up its waves: the slip changes either way",
                "give [foundation]"};
    case RockKind::massless:
        return {"rock", "elastic, without mass",
                "always: massless rock has no radiation damping, and slip is overestimated",
                "foundation.mass = \"with-mass\""};
    case RockKind::boxed:
        return {"rock", "elastic with mass, in a box", "waves reflected by the box reach the dam again",
                "a larger box, or rock that radiates"};
    case RockKind::radiating:
        return {"rock",
                "an elastic half space of one kind of rock; the record is the motion of its free surface without the "
                "dam, waves come vertically from below, the same along the base",
                "layers, faults or the valley's shape matter; long bases; waves from the side",
                "vary the rock's modulus"};
    }
    return {};
}

std::vector<Limit> block_limits(const Scene& scene)
{
    std::vector<Limit> list{{"rigid block", "the mass moves as one piece and stays flat on its plane",
                             "the dam amplifies the shaking: slip may be larger or smaller, so this is no upper bound",
                             "finite elements"},
                            {"regressions", "the horizontal component of the record, and the yield acceleration",
                             "outside the data each was fitted to; those are named and not weighted",
                             "take them for the order of magnitude only"}};
    if (scene.wedge)
        list.push_back({"wedge", "a rigid wedge that translates on its plane or planes",
                        "it turns, or another plane is weaker", "run the other planes as scenes of their own"});
    return list;
}

std::vector<Limit> element_limits(const Scene& scene)
{
    std::vector<Limit> list{
        {"materials", "concrete and rock are linear elastic",
         "tension exceeds the strength, above all at neck and heel: stresses are shown, but nothing cracks",
         "a lift joint where the crack would run"},
        rock_limit(scene),
        scene.contact.sliding == JointPath::small
            ? Limit{"joints", "pairs of nodes that slide and open, opposite each other",
                    "the slip is not small against the length of the base", "contact.sliding = \"finite\""}
            : Limit{"joints", "the base slides as far as contact.max_slip_m; lift joints slide little",
                    "a lift joint slides far", "a scene with that joint as its base"},
        {"±", "error of time step and mesh: the change against elements of twice the size",
         "the inputs are uncertain: ± excludes friction, uplift, water level and record", "sweep, fragility"}};
    if (scene.reservoir)
        list.push_back({"water", "added mass or linear acoustic water, as the table of effects lists",
                        "cavitation, waves over the crest, a dam that moves by metres", "a model with a free surface"});
    return list;
}

Limit slip_plane_limit(const Scene& scene, Method method)
{
    if (scene.wedge) return {"slip plane", "the planes that are given", "another plane is weaker", "give it as a scene of its own"};
    if (!scene.planes.slides_on.empty())
        return {"slip plane", "the seam \"" + scene.planes.slides_on + "\" alone", "the base, a lift or another seam is weaker",
                "run them without --plane, and each seam with its own"};
    std::string planes = "the base";
    if (scene.lifts || (method == Method::finite_elements && !scene.lift_joints.empty())) planes += ", the lift joints";
    if (!scene.seams.empty())
        planes += method == Method::finite_elements ? "; seams by rigid blocks, or alone with --plane" : ", the seams";
    return {"slip plane", planes == "the base" ? "the base alone" : planes, "a lift or a seam that is not named is weaker",
            "[lifts] for every lift joint, [[seam]] for a seam in the rock"};
}

} // namespace

Section limits_section(const Scene& scene, Method method)
{
    std::vector<Limit> rows{
        {"plane section", "one metre of the dam, the same along the axis",
         "abutments, arching or shear keys between monoliths carry load", "a model in three dimensions"},
        slip_plane_limit(scene, method),
        {"friction", "Coulomb's law, the same along a plane, with the scene's value",
         "strength varies along the plane, or is not known: the slip depends on it as on little else",
         "run the lowest and the highest value (sweep)"}};
    if (scene.uplift && scene.uplift->water.opening == OpeningWater::unchanged)
        rows.push_back({"uplift", "as before the earthquake, while the dam moves",
                        "water enters or leaves a joint as it opens", "uplift.opening"});
    if (method == Method::finite_elements)
        for (Limit& limit : element_limits(scene)) rows.push_back(std::move(limit));
    for (Limit& limit : block_limits(scene)) rows.push_back(std::move(limit));
    return {"Limits of validity",
            {rows_part(table_of<Limit>("Limits of validity",
                                       {{{"aspect", "aspect"}, &Limit::aspect},
                                        {{"assumption", "assumption"}, &Limit::assumption},
                                        {{"invalid_when", "invalid when"}, &Limit::invalid_when},
                                        {{"instead", "do instead"}, &Limit::instead}},
                                       rows))}};
}

Section equilibrium_section(const std::vector<sliding::Equilibrium>& combinations)
{
    Section section{"Limit equilibrium"};
    if (Table matrix = check_matrix(combinations); !matrix.rows.empty())
        section.parts.push_back(rows_part(std::move(matrix)));
    else
        section.parts.push_back(Paragraph{
            "No required values are given, so there are no verdicts: name criteria.document, or required_... in "
            "[[combination]]."});
    Table quantities = equilibrium_table(combinations);
    quantities.title = "Quantities of each combination";
    section.parts.push_back(TablePart{
        std::move(quantities),
        Layout::columns,
        3,
        Fold::open,
        {"N': normal force less uplift, compression positive; T: shear, positive downstream; U: uplift, positive up; "
         "k_h: horizontal seismic coefficient, positive where it drives downstream; k_v: vertical, positive where it "
         "makes the dam heavier. FS sliding: strength over shear; FS overturning: moments about the toe; eccentricity: "
         "of the resultant from the middle of the base, positive downstream; stresses: effective, compression "
         "positive. a_y: ground acceleration at which it starts to slide; tipping: at which it turns about its toe."}});
    for (const sliding::Equilibrium& e : combinations) {
        Table loads = load_table(e);
        loads.title += std::string(", crack rule ") + sliding::word(e.crack_rule);
        section.parts.push_back(TablePart{std::move(loads), Layout::rows, 1, Fold::folded});
    }
    return section;
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

Table effect_table(const EffectPlan& plan, std::optional<bool> on)
{
    using E = PlannedEffect;
    std::vector<E> effects;
    for (const E& effect : plan.effects)
        if (!on || effect.on == *on) effects.push_back(effect);
    return table_of<E>(plan.method == Method::rigid_block ? "Effect plan, rigid block" : "Effect plan, finite elements",
                       {{in_brief({"effect", "effect"}), &E::name},
                        {{"on", "on"}, &E::on},
                        {in_brief({"reason", "because"}), &E::reason},
                        {in_brief({"cost", "cost"}), &E::cost}},
                       effects);
}

} // namespace damslip::pages
