#include "scene/keys.hpp"

/// Keys of the planes beside the base: lifts through the dam, seams below it.
namespace damslip::keys {

namespace {

const std::set<std::string> coulomb{"friction",      "cohesion",          "cohesion_lost_at_slip",
                                    "residual_slip", "residual_friction", "residual_path"};

KeyGroup lifts_group(const std::vector<Key>& contact)
{
    using L = Lifts;
    const std::vector<Key> list{
        number("spacing", length, Range::above(0), "this or elevations", "from one lift to the next", "3",
               at(&L::spacing)),
        number("elevations", length, Range::any(), "this or spacing", "of the lifts above the heel", "[3, 6, 9]",
               at(&L::elevations)),
        number("from", length, Range::any(), "one spacing above the heel", "spacing: the lowest lift", "3",
               at(&L::from)),
        number("to", length, Range::any(), "below the crest", "spacing: the highest lift", "60", at(&L::to)),
        word("bond", "jointed",
             "jointed: no cohesion and no tensile strength; bonded: cohesion and tensile_strength are required",
             "\"bonded\"", choice(&L::bonded, {{"jointed", false}, {"bonded", true}}))};
    std::set<std::string> strength = coulomb;
    strength.insert({"fracture_energy_tension", "fracture_energy_shear", "softening", "dynamic_increase"});
    const std::vector<Key> more{
        only_with(&L::bonded, true,
                  number("tensile_strength", stress, Range::between(0, 1e4), "required with bond bonded",
                         "f_t across the lift: a crack starts where the tension at a face is larger", "500",
                         in(&L::strength, in(&Contact::bond, at(&Bond::tensile_strength))))),
        word("uplift", "linear",
             "water in the lift: none, linear from the head at the upstream face to that of the tailwater, or linear "
             "to a drain line and on from it (drains)",
             "\"drains\"",
             choice(&L::uplift,
                    {{"none", LiftUplift::none}, {"linear", LiftUplift::linear}, {"drains", LiftUplift::drains}})),
        number("drains_distance", length, Range::above(0), "required with uplift drains",
               "of the drain line from the upstream face", "3", at(&L::drains_distance)),
        only_with(&L::uplift, LiftUplift::drains,
                  number("drains_efficiency", none, Range::between(0, 1), "0.6666666666666666",
                         "E, as drains.efficiency", "0.67", at(&L::drains_efficiency))),
        number("gallery_level", length, Range::any(), "none",
               "gallery into which the lifts' drains flow, above the heel; takes the place of a lower tailwater", "3",
               at(&L::gallery_level)),
        number("uplift_share", none, Range::between(0, 1), "1", "share of the lift's area on which the pressure acts",
               "1", at(&L::uplift_share)),
        word("amplification", "constant",
             "acceleration over the height as a share of the ground's: constant (1), power (1 + (crest_amplification - "
             "1)(y/H)^exponent), points, or modes: those of the dam on its bonded base, by each record's spectrum for "
             "factor "
             "and yield, by each record itself for the slip",
             "\"power\"",
             choice(&L::amplification, {{"constant", Amplification::constant},
                                        {"power", Amplification::power},
                                        {"points", Amplification::points},
                                        {"modes", Amplification::modes}})),
        only_with(&L::amplification, Amplification::power,
                  number("crest_amplification", none, Range::between(0, 20), "required with amplification power",
                         "A_c, at the crest", "3", at(&L::crest_amplification))),
        only_with(&L::amplification, Amplification::power,
                  number("exponent", none, Range::between(0, 10), "1.5", "n of amplification power", "1.5",
                         at(&L::exponent))),
        pairs("amplification_points", length, none, Range::between(0, 20), "required with amplification points",
              "height above the heel, acceleration over the ground's; constant beyond the ends", "[[0, 1], [60, 3]]",
              at(&L::points)),
        word("active", "adaptive",
             "FE: lifts that may slide and open: those that come near their strength (adaptive: each is tied until its "
             "tractions reach 0.8 of it anywhere, then the run begins anew with it), all, none; `screen` judges every "
             "lift",
             "\"all\"",
             choice(&L::active,
                    {{"adaptive", ActiveLifts::adaptive}, {"all", ActiveLifts::all}, {"none", ActiveLifts::none}}))};
    return optional_group(
        "lifts",
        "Horizontal joints through the dam, each judged as a sliding plane; a [[lift_joint]] at the same elevation "
        "takes the place of the lift made here. See docs/planes.md.",
        &Scene::lifts, joined({list, strength_keys(contact, &L::strength, strength), more}));
}

KeyGroup seam_group(const std::vector<Key>& contact)
{
    using S = Seam;
    const auto of_depth = [](const S& seam) { return seam.depth.has_value(); };
    const std::vector<Key> list{
        word("name", "seam and its number", "name in the tables", "\"clay seam\"", at(&S::name)),
        pairs("points", length, length, Range::any(), "this or depth",
              "path from upstream to downstream: x downstream of the heel, y above it", "[[0, -8], [45, -8]]",
              at(&S::points)),
        number("depth", length, Range::above(0), "this or points", "of a straight seam below the heel", "8",
               at(&S::depth)),
        only_where<S>(of_depth, number("dip", angle, Range::inside(-60, 60), "0",
                                       "of the straight seam; positive: downstream", "4", at(&S::dip)))};
    std::set<std::string> strength = coulomb;
    strength.insert("friction_table");
    const std::vector<Key> more{
        word("heel", "crack",
             "upstream end of the body: a vertical crack from the heel down to the seam with full water and no "
             "strength (crack), or the seam starts on the reservoir floor (floor)",
             "\"floor\"", choice(&S::heel, {{"crack", SeamHeel::crack}, {"floor", SeamHeel::floor}})),
        word(
            "exit", "wedge with [seam.wedge], else daylight",
            "downstream end: the seam comes to the ground (daylight), pushes up a wedge of rock (wedge), or ends in a "
            "face that holds nothing (free-face)",
            "\"free-face\"",
            choice(&S::exit,
                   {{"daylight", SeamExit::daylight}, {"wedge", SeamExit::wedge}, {"free-face", SeamExit::free_face}})),
        word("uplift", "drains with [drains], else linear",
             "water pressure along the path: none, linear in head from entry to exit, drains (those of [drains]) or "
             "points",
             "\"linear\"",
             choice(&S::uplift, {{"linear", UpliftModel::linear},
                                 {"drains", UpliftModel::drains},
                                 {"none", UpliftModel::none},
                                 {"points", UpliftModel::points}})),
        pairs("uplift_points", length, none, Range::between(0, 2), "none",
              "uplift points: distance along the path, pressure over that at its entry", "[[0, 1], [45, 0.2]]",
              at(&S::uplift_points)),
        only_where<S>([](const S& seam) { return seam.dilation != 0.0; },
                      number("dilation", angle, Range::between(0, 60), "0", "psi, by which the body rises as it slides",
                             "5", at(&S::dilation))),
        number("dilation_slip", small_length, Range::above(0), "it does not end", "slip at which the dilation ends",
               "0.05", at(&S::dilation_slip))};
    return list_group("seam",
                      "A weak seam in the rock below the dam, on which dam and rock slide; for the rigid block, and "
                      "for `fe --plane NAME`. See docs/planes.md.",
                      &Scene::seams, joined({list, strength_keys(contact, &S::strength, strength), more}));
}

KeyGroup seam_wedge_group()
{
    using W = SeamWedge;
    const Range steep = Range::inside(0, 90);
    const Value one_angle{ValueKind::number, [](void* o) -> Slot {
                              return Numbers{&static_cast<W*>(o)->angles, true};
                          }};
    const Value range{ValueKind::ends, [](void* o) -> Slot {
                          return Ends{&static_cast<W*>(o)->search_from, &static_cast<W*>(o)->search_to};
                      }};
    return inner_group(
        "seam.wedge", "The wedge of rock before the toe that a dam on this seam pushes up.", &Scene::seams,
        [](void* seam, bool make) -> void* {
            std::optional<W>& wedge = static_cast<Seam*>(seam)->wedge;
            if (make) wedge.emplace();
            return wedge ? &*wedge : nullptr;
        },
        {only_where<W>(
             [](const W& w) { return w.angles.size() == 1; },
             number("angle", angle, steep, "searched", "of the wedge's plane above the horizontal", "25", one_angle)),
         only_where<W>([](const W& w) { return w.angles.size() > 1; },
                       number("angles", angle, steep, "searched",
                              "those of joint sets: the least factor and yield count", "[20, 35]", at(&W::angles))),
         only_where<W>([](const W& w) { return w.angles.empty(); },
                       number("search", angle, steep, "[10, 60]",
                              "range in which the angle of the least factor is sought", "[10, 60]", range)),
         number("distance", length, Range::at_least(0), "0", "of the kink beyond the toe", "5", at(&W::distance)),
         number("friction", friction, Range::between(0, 10), "required", "Coulomb mu of the wedge's plane", "0.84",
                at(&W::friction)),
         number("cohesion", stress, Range::at_least(0), "0", "of the wedge's plane", "100", at(&W::cohesion)),
         only_where<W>([](const W& w) { return w.dilation != 0.0; },
                       number("dilation", angle, Range::between(0, 60), "0", "psi of the wedge's plane", "5",
                              at(&W::dilation)))});
}

KeyGroup interface_group()
{
    using I = SeamInterface;
    const auto rubs = [](const I& i) { return i.model == InterfaceModel::friction; };
    return inner_group(
        "seam.interface", "The face between two blocks of this seam, up from a kink of its path.", &Scene::seams,
        [](void* seam, bool make) -> void* {
            I& face = static_cast<Seam*>(seam)->interface;
            if (make) face = {};
            return make || face != I{} ? &face : nullptr;
        },
        {word("model", "smooth",
              "smooth: it carries pressure and water only, the wedge method of USACE; friction: Sarma's",
              "\"friction\"",
              choice(&I::model, {{"smooth", InterfaceModel::smooth}, {"friction", InterfaceModel::friction}})),
         number("angle", angle, Range::inside(0, 180), "90 (vertical)",
                "of the face, upward from the downstream horizontal", "90", at(&I::angle)),
         only_where<I>(rubs, number("friction", friction, Range::between(0, 10), "required with model friction",
                                    "Coulomb mu of the face", "0.36", at(&I::friction))),
         only_where<I>(rubs,
                       number("cohesion", stress, Range::at_least(0), "0", "of the face", "50", at(&I::cohesion)))});
}

} // namespace

std::vector<KeyGroup> plane_groups(const std::vector<Key>& contact)
{
    using P = PlaneOptions;
    return {lifts_group(contact), seam_group(contact), seam_wedge_group(), interface_group(),
            group("planes", "Of all planes: base, lifts and seams.", &Scene::planes,
                  {only_where<P>([](const P& p) { return p.geometry != PlaneGeometry::small; },
                                 word("geometry", "small",
                                      "small: the yield stays as the dam slides; linear: it grows with the slip as "
                                      "rock crosses the kink onto the wedge",
                                      "\"linear\"",
                                      choice(&P::geometry,
                                             {{"small", PlaneGeometry::small}, {"linear", PlaneGeometry::linear}}))),
                   only_where<P>([](const P& p) { return p.wedge != PlaneWedge::held; },
                                 word("wedge", "held",
                                      "held: downstream dam and wedge move as one; free: a wedge that slows down later "
                                      "than the dam, or starts sooner, runs ahead of it and is met again",
                                      "\"free\"",
                                      choice(&P::wedge, {{"held", PlaneWedge::held}, {"free", PlaneWedge::free}}))),
                   only_where<P>([](const P& p) { return p.governs != PlaneJudgement::slip; },
                                 word("governs", "slip",
                                      "which plane gives the verdict: the largest slip, or the least factor of safety "
                                      "over the required one (factor)",
                                      "\"factor\"",
                                      choice(&P::governs,
                                             {{"slip", PlaneJudgement::slip}, {"factor", PlaneJudgement::factor}})))})};
}

} // namespace damslip::keys
