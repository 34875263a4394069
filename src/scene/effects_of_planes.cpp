#include "scene/effect_plan.hpp"

#include <algorithm>
#include <fmt/format.h>

/// Effects of the planes beside the base. Finite elements follow a seam that they are asked to slide on (Scene::seam_body).
namespace damslip {

namespace {

bool has_lifts(const Scene& s)
{
    return s.lifts.has_value();
}

bool has_seams(const Scene& s)
{
    return !s.seams.empty();
}

bool has_planes(const Scene& s)
{
    return has_lifts(s) || has_seams(s);
}

template <class Is>
bool any_seam(const Scene& s, Is&& is)
{
    return std::any_of(s.seams.begin(), s.seams.end(), [&](const Seam& seam) {
        return (!s.seam_body || s.seam_body->name == seam.name) && is(seam);
    });
}

bool pushes_wedge(const Seam& seam)
{
    return seam.wedge.has_value();
}

bool rubs(const Seam& seam)
{
    return seam.interface.model == InterfaceModel::friction;
}

bool rises(const Seam& seam)
{
    return seam.dilation != 0.0 || (seam.wedge && seam.wedge->dilation != 0.0);
}

bool drained(const Seam& seam)
{
    return seam.uplift == UpliftModel::drains;
}

Decision of_planes(Method method, bool on, std::string yes, std::string no, std::string cost)
{
    if (method == Method::finite_elements) return {false, "finite elements: base and [[lift_joint]]", ""};
    return decided(on, std::move(yes), std::move(no), std::move(cost));
}

/// A row of seams: on where any seam is so.
template <bool (*is)(const Seam&)>
Decision of_seams(Method method, const Scene& s, const char* yes, const char* no, const char* cost)
{
    return of_planes(s.seam_body ? Method::rigid_block : method, any_seam(s, is), yes, no, cost);
}

bool is_traced(const Scene& s)
{
    return s.dam.crack == BodyCrack::traced;
}

} // namespace

std::vector<EffectRow> plane_effects()
{
    return {
        {.name = "lifts",
         .decide =
             [](const Scene& s, Method m) {
                 return of_planes(m, has_lifts(s), "[lifts]", "no [lifts]", "one rigid block for each lift");
             },
         .take_out = [](Scene& s) { s.lifts.reset(); },
         .instead = "no [lifts]: a dam of one piece",
         .taken_out_when_off = true,
         .concerns = has_planes},
        {.name = "water in lifts",
         .decide =
             [](const Scene& s, Method m) {
                 return of_planes(m, s.lifts->uplift != LiftUplift::none, "lifts.uplift", "lifts.uplift = \"none\"",
                                  "one force on each lift");
             },
         .take_out = [](Scene& s) { s.lifts->uplift = LiftUplift::none; },
         .instead = "lifts.uplift = \"none\"",
         .concerns = has_lifts},
        {.name = "amplification over the height",
         .decide =
             [](const Scene& s, Method m) {
                 return of_planes(m, s.lifts->amplification != Amplification::constant, "lifts.amplification",
                                  "lifts.amplification = \"constant\"",
                                  s.lifts->amplification == Amplification::modes
                                      ? "modes of the bonded dam once, four slides for each lift, record and polarity"
                                      : "one integral for each lift");
             },
         .take_out = [](Scene& s) { s.lifts->amplification = Amplification::constant; },
         .instead = "lifts.amplification = \"constant\": the dam moves as the ground",
         .concerns = has_lifts},
        {.name = "seams",
         .decide =
             [](const Scene& s, Method m) {
                 if (s.seam_body)
                     return Decision{true, fmt::format("slides on \"{}\" and on the base", s.seam_body->name),
                                     "the rock above it, two unknowns a pair along its path"};
                 return of_planes(m, has_seams(s), fmt::format("{} [[seam]]", s.seams.size()), "no [[seam]]",
                                  "one chain of rigid blocks for each");
             },
         .take_out = [](Scene& s) { s.seams.clear(); },
         .instead = "no [[seam]]: whole rock below the base",
         .taken_out_when_off = true,
         .concerns = has_planes},
        {.name = "passive wedge",
         .decide =
             [](const Scene& s, Method m) {
                 return of_seams<pushes_wedge>(m, s, "[seam.wedge]", "no [seam.wedge]",
                                               "one block more; a search by its angle");
             },
         .take_out =
             [](Scene& s) {
                 for (Seam& seam : s.seams) {
                     if (!seam.wedge) continue;
                     seam.wedge.reset();
                     seam.exit = SeamExit::free_face;
                 }
             },
         .instead = "seam.exit = \"free-face\": nothing holds the toe",
         .concerns = has_seams},
        {.name = "friction between blocks",
         .decide =
             [](const Scene& s, Method m) {
                 return of_seams<rubs>(m, s, "seam.interface.model = \"friction\"", "seam.interface.model = \"smooth\"",
                                       "none");
             },
         .take_out =
             [](Scene& s) {
                 for (Seam& seam : s.seams) {
                     seam.interface.model = InterfaceModel::smooth;
                     seam.interface.friction = seam.interface.cohesion = 0.0;
                 }
             },
         .instead = "seam.interface.model = \"smooth\"",
         .concerns = has_seams},
        {.name = "dilation of seams",
         .decide =
             [](const Scene& s, Method m) {
                 return of_seams<rises>(m, s, "seam.dilation_deg", "no dilation_deg", "none; its end is an event");
             },
         .take_out =
             [](Scene& s) {
                 for (Seam& seam : s.seams) {
                     seam.dilation = 0.0;
                     seam.dilation_slip.reset();
                     if (seam.wedge) seam.wedge->dilation = 0.0;
                 }
             },
         .instead = "seam.dilation_deg = 0",
         .concerns = has_seams},
        {.name = "drains at seams",
         .decide =
             [](const Scene& s, Method m) {
                 return of_seams<drained>(m, s, "seam.uplift = \"drains\"", "no seam.uplift = \"drains\"",
                                          "one corner of the pressure");
             },
         .take_out =
             [](Scene& s) {
                 for (Seam& seam : s.seams)
                     if (drained(seam)) seam.uplift = UpliftModel::linear;
             },
         .instead = "seam.uplift = \"linear\", as with E = 0",
         .concerns = has_seams},
        {.name = "change of shape with slip",
         .decide =
             [](const Scene& s, Method m) {
                 return of_planes(m, s.planes.geometry == PlaneGeometry::linear, "planes.geometry = \"linear\"",
                                  "planes.geometry = \"small\"", "a yield that grows with the slip");
             },
         .take_out = [](Scene& s) { s.planes.geometry = PlaneGeometry::small; },
         .instead = "planes.geometry = \"small\"",
         .concerns = has_seams},
        {.name = "traced cracks",
         .decide =
             [](const Scene&, Method m) {
                 return decided(m == Method::finite_elements, "dam.crack = \"traced\"", "rigid block",
                                "a run anew for each crack, and each time a path moves");
             },
         .take_out = [](Scene& s) { s.dam.crack = BodyCrack::none; },
         .instead = "dam.crack = \"none\": the concrete stays whole",
         .concerns = is_traced},
    };
}

} // namespace damslip
