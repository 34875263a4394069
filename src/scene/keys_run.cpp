#include "scene/keys.hpp"

namespace damslip::keys {

namespace {

bool is_hht(const TimeOptions& time) // which "auto" takes where it does not take modes
{
    return time.scheme == TimeScheme::hht || time.scheme == TimeScheme::automatic;
}

bool chooses_substeps(const TimeOptions& time)
{
    return !time.substeps;
}

bool is_of_scene(const MeshOptions& mesh)
{
    return !mesh.file;
}

} // namespace

std::vector<KeyGroup> fe_groups()
{
    std::vector<KeyGroup> groups;
    groups.push_back(group(
        "mesh", "Finite-element mesh.", &Scene::mesh,
        {number("size", length, Range::above(0), "height / 40", "element size in the dam", "1.5",
                at(&MeshOptions::size)),
         number("contact_size", length, Range::above(0), "base / 60, at most size",
                "element size on the contact plane; of a base below 6 m by default 0.1 m or base / 20, what is less",
                "0.75", at(&MeshOptions::contact_size)),
         number("rock_contact_size", length, Range::above(0), "the dam's nodes",
                "element size on the rock's side of the contact plane, whose nodes then need not face the dam's; runs "
                "with a tied base have facing nodes always",
                "1.125", at(&MeshOptions::rock_contact_size)),
         only_where<MeshOptions>(
             is_of_scene,
             number("rock_size", length, Range::above(0), "foundation depth / 8",
                    "largest element in the rock; with mass, an eighth of a wave of the record's highest frequencies",
                    "10", at(&MeshOptions::rock_size))),
         only_where<MeshOptions>(is_of_scene, number("growth", none, Range::between(1, 3), "1.15",
                                                     "ratio of neighbouring element sizes away from the contact plane",
                                                     "1.2", at(&MeshOptions::growth))),
         word("element", "q4-incompatible",
              "element type of dam and rock; q8, q9 and t6 are quadratic, linear on contact planes", "\"q8\"",
              choice(&MeshOptions::element, {{"q4-incompatible", ElementKind::q4_incompatible},
                                             {"q4", ElementKind::q4},
                                             {"t3", ElementKind::t3},
                                             {"q8", ElementKind::q8},
                                             {"q9", ElementKind::q9},
                                             {"t6", ElementKind::t6}})),
         word("file", "none",
              "Gmsh mesh (ASCII, version 2.2 or 4.1) of dam and rock, relative to the scene file, in place of the "
              "program's own; without size, contact_size, rock_contact_size and growth",
              "\"dam.msh\"", at(&MeshOptions::file)),
         only_where<MeshOptions>(std::not_fn(is_of_scene),
                                 number("file_unit", length, Range::above(0), "1", "unit of the coordinates in file",
                                        "0.001", at(&MeshOptions::file_unit)))}));
    groups.push_back(group(
        "stages", "How the static state before the earthquake comes about.", &Scene::stages,
        {word("gravity", "dam", "what has weight", "\"dam-and-rock\"",
              choice(&Stages::gravity, {{"dam", GravityStage::dam}, {"dam-and-rock", GravityStage::dam_and_rock}})),
         word("geostatic", "false", "displacements are set to zero after the gravity stage, stresses stay", "true",
              at(&Stages::geostatic)),
         word("pore_pressure", "none",
              "water in the rock: `total` (pressures on both joint faces, internal term) or `effective` (body force)",
              "\"total\"",
              choice(&Stages::pore_pressure, {{"none", PorePressure::none},
                                              {"total", PorePressure::total},
                                              {"effective", PorePressure::effective}}))}));
    groups.push_back(
        group("damping", "Structural damping of the FE model.", &Scene::damping,
              {word("method", "rayleigh", "how the coefficients are found", "\"modified-rayleigh\"",
                    choice(&Damping::method, {{"rayleigh", DampingMethod::rayleigh},
                                              {"modified-rayleigh", DampingMethod::modified_rayleigh},
                                              {"none", DampingMethod::none}})),
               number("ratio", none, Range::between(0, 1), "0.05", "damping ratio of the two modes", "0.05",
                      at(&Damping::ratio)),
               word("first_mode", "1", "first mode that gets the ratio, from 1", "1", at(&Damping::first_mode)),
               word("second_mode", "5", "second mode that gets the ratio", "5", at(&Damping::second_mode)),
               number("mass_coefficient", per_second, Range::at_least(0), "from ratio and modes", "a_M given directly",
                      "1.8", at(&Damping::mass_coefficient)),
               number("stiffness_coefficient", seconds, Range::at_least(0), "from ratio and modes",
                      "b_K given directly", "0.0008", at(&Damping::stiffness_coefficient)),
               word("mass", "deformation-only", "velocity the mass-proportional part resists", "\"relative\"",
                    choice(&Damping::mass, {{"deformation-only", MassDamping::deformation_only},
                                            {"relative", MassDamping::relative},
                                            {"total", MassDamping::total}}))}));
    groups.push_back(group(
        "time", "Time integration of the FE model.", &Scene::time,
        {word("scheme", "auto; hht where alpha is given",
              "integrator. auto: superposition of modes on a bonded base (fe --base tied) where it costs less, else "
              "hht; "
              "central-difference: explicit, steps below its limit; modal: bonded base only",
              "\"central-difference\"",
              choice(&TimeOptions::scheme, {{"auto", TimeScheme::automatic},
                                            {"hht", TimeScheme::hht},
                                            {"newmark", TimeScheme::newmark},
                                            {"central-difference", TimeScheme::central_difference},
                                            {"modal", TimeScheme::modal}})),
         only_where<TimeOptions>(is_hht, number("alpha", none, Range::between(-1.0 / 3.0, 0), "-0.05", "HHT alpha",
                                                "-0.05", at(&TimeOptions::alpha))),
         only_with(
             &TimeOptions::scheme, TimeScheme::newmark,
             number("gamma", none, Range::between(0.5, 1.5), "0.5", "Newmark gamma", "0.5", at(&TimeOptions::gamma))),
         only_with(
             &TimeOptions::scheme, TimeScheme::newmark,
             number("beta", none, Range::half_open(0, 1), "0.25", "Newmark beta", "0.25", at(&TimeOptions::beta))),
         number("dt", seconds, Range::between(1e-7, 10), "the record's; central-difference: 0.9 of its limit or less",
                "time step", "0.005", at(&TimeOptions::dt)),
         word("substeps", "chosen by slip_tolerance",
              "k of the steps dt / 2^k of FE runs with contact, 0 ... 10; fixed, without an estimate of the error", "2",
              at(&TimeOptions::substeps)),
         only_where<TimeOptions>(
             chooses_substeps,
             word(
                 "stepping", "auto",
                 "how sub-steps are chosen: auto: uniform ones, and runs on few modes of the dam with smaller ones "
                 "correct the slip where the dam can be reduced; uniform: halved until the slip stays; adaptive: small "
                 "ones only where the local error of the slip asks for them, around its beginnings, ends and turns",
                 "\"uniform\"",
                 choice(&TimeOptions::stepping, {{"auto", Stepping::automatic},
                                                 {"uniform", Stepping::uniform},
                                                 {"adaptive", Stepping::adaptive}}))),
         only_where<TimeOptions>(
             chooses_substeps,
             number("slip_tolerance", none, Range::half_open(0, 1), "0.01",
                    "error of the FE slip over its largest size on the way, to which the sub-steps are chosen", "0.01",
                    at(&TimeOptions::slip_tolerance)))}));
    groups.push_back(
        group("analysis", "Settings of a published study as defaults; keys of the file win.", &Scene::analysis,
              {word("preset", "none",
                    "goldgruber-2015: slip-tolerance 0.005, no separation, massless rock, HHT alpha -1/3, time step "
                    "0.01 s without sub-steps, mass damping of the relative velocity",
                    "\"goldgruber-2015\"",
                    choice(&Analysis::preset,
                           {{"none", AnalysisPreset::none}, {"goldgruber-2015", AnalysisPreset::goldgruber_2015}}))}));
    return groups;
}

KeyGroup flexible_block_group()
{
    using M = FlexibleMass;
    const Units line_mass{{"kg_m", 1.0}, {"t_m", 1000.0}};
    return optional_group(
        "flexible_block",
        "The sliding mass as one mode that vibrates on its base, beside the rigid block. Of `mass_ratio`, "
        "`shape_exponent` and `modal_load_kg_m` with `modal_mass_kg_m` one at most. Without this table "
        "regressions.period_s "
        "above 0 alone follows the block with all defaults.",
        &Scene::flexible_block,
        {number("period", seconds, Range::half_open(0, 100), "regressions.period_s",
                "period of the mode on a base that does not slide; \"modes\": period and mass ratio of the tied "
                "finite-element model, water included",
                "0.3", number_or_word(&M::period, &M::of_modes, "modes")),
         number("damping", none, Range::between(0, 0.5), "0.05", "damping ratio of the mode", "0.1",
                at(&M::damping_ratio)),
         number("mass_ratio", none, Range::half_open(0, 0.95), "8/π² = 0.81 (uniform shear column)",
                "effective mass of the mode over the sliding mass, L²/(M M_1)", "0.7", at(&M::mass_ratio)),
         number("shape_exponent", none, Range::half_open(0, 10), "none",
                "n of the shape ψ = (y/H)^n: L and M_1 by integration over section and added mass", "1.5",
                at(&M::shape_exponent)),
         number("modal_load", line_mass, Range::above(0), "none", "L = Σ m ψ, water included", "2e6",
                at(&M::modal_load)),
         number("modal_mass", line_mass, Range::above(0), "none", "M_1 = Σ m ψ², water included", "1e6",
                at(&M::modal_mass)),
         number("height", length, Range::half_open(0, 1000), "none",
                "H of a uniform shear column: with shear_velocity_m_s in place of the period, T_s = 4 H/V_s", "30",
                at(&M::height)),
         number("shear_velocity", {{"m_s", 1.0}}, Range::half_open(0, 10000), "none",
                "V_s of the column at small strain", "450", at(&M::shear_velocity)),
         number("base_velocity", {{"m_s", 1.0}}, Range::half_open(0, 10000), "none",
                "V_s of the rock below the column: what it radiates is added to the damping, at most 20 %; without it "
                "nothing",
                "1500", at(&M::base_velocity)),
         number("reference_strain", {{"percent", 0.01}}, Range::half_open(0, 100), "none",
                "shear strain at which the column's shear modulus is halved: period and damping follow the strain of "
                "each record "
                "(equivalent linear); without it they stay",
                "0.05", at(&M::reference_strain)),
         word("mode", "both", "vibration first and slip after it (decoupled), both at once (coupled), or both analyses",
              "\"coupled\"",
              choice(&M::method, {{"both", FlexibleMethod::both},
                                  {"decoupled", FlexibleMethod::decoupled},
                                  {"coupled", FlexibleMethod::coupled}}))});
}

std::vector<KeyGroup> motion_groups()
{
    std::vector<KeyGroup> groups;
    groups.push_back(group(
        "motion", "Ground motion. a_h positive upstream drives the dam downstream, a_v positive up.", &Scene::motion,
        {number("scale", none, Range::at_least(0), "1", "factor on all components", "1.5", at(&Motion::scale)),
         number("scale_to_pga", acceleration, Range::above(0), "as recorded",
                "horizontal peak is made equal to this, the vertical by the same factor; motion.scale and "
                "motion.record.scale are factors on top",
                "1.0", at(&Motion::scale_to_pga)),
         word("polarity", "both",
              "the one sign on the horizontal components as filed that `fe`, `sweep`, `accuracy` and `explain "
              "--ablate` run; `screen`, `assess`, `fragility` run both",
              "-1", at(&Motion::polarity)),
         word("vertical", "true", "false: vertical components are left out", "false", at(&Motion::vertical)),
         word("sequence", "each record alone",
              "names of records that shake the same dam one after the other, each from where the one before left it",
              "[\"main shock\", \"aftershock\"]", at(&Motion::sequence)),
         only_where<Motion>([](const Motion& motion) { return !motion.sequence.empty(); },
                            number("sequence_pause", seconds, Range::between(0, 600), "0",
                                   "rest between the records of a sequence, beyond the run to rest", "10",
                                   at(&Motion::sequence_pause)))}));
    using R = RecordFiles;
    groups.push_back(list_group(
        "motion.record", "One record: a horizontal component and, if there is one, its vertical.",
        [](Scene & s) -> auto& { return s.motion.records; },
        {word("name", "file name", "name in the tables", "\"El Centro NS\"", at(&R::name)),
         word("horizontal", "required", "accelerogram file, relative to the scene file", "\"elcentro_ns.at2\"",
              at(&R::horizontal)),
         word("vertical", "none", "accelerogram file, positive up", "\"elcentro_up.at2\"", at(&R::vertical)),
         word("unit", "the file says", "unit of the samples where the file does not say: g, m/s2, cm/s2, gal, mg",
              "\"g\"", at(&R::unit)),
         number("dt", seconds, Range::above(0), "the file says", "time step of one-column files", "0.02", at(&R::dt)),
         word("column", "the only one",
              "column or channel of the horizontal file where it holds several: its heading, or its number from 1",
              "\"ns_g\"", at(&R::column)),
         word("vertical_column", "the only one", "the same of the vertical file; both may be one file", "\"4\"",
              at(&R::vertical_column)),
         number("magnitude", none, Range::between(2, 10), "none",
                "moment magnitude of the earthquake, for the regressions that ask for it", "6.9", at(&R::magnitude)),
         number("scale", none, Range::at_least(0), "1", "factor on this record, on top of motion.scale", "1.2",
                at(&R::scale))}));
    groups.push_back(group(
        "sliding", "Rigid-block integration; the run-out, after which a run by finite elements ends, too.",
        &Scene::sliding,
        {word("scheme", "exact",
              "of the rigid block: exact (events located) or slammer (the trapezoid scheme of SLAMMER)", "\"slammer\"",
              choice(&SlidingOptions::scheme, {{"exact", SlidingScheme::exact}, {"slammer", SlidingScheme::slammer}})),
         word("lift_off", "no-friction",
              "while the normal force is zero: no resistance (no-friction) or vertical flight and plastic impact "
              "(ballistic)",
              "\"ballistic\"",
              choice(&SlidingOptions::lift_off,
                     {{"no-friction", LiftOff::no_friction}, {"ballistic", LiftOff::ballistic}})),
         word("two_way", "true", "false: no upstream sliding", "false", at(&SlidingOptions::two_way)),
         number("run_out_max", seconds, Range::between(0, 600), "60", "integration after the record's end at most",
                "60", at(&SlidingOptions::run_out_max)),
         number("restitution", none, Range::between(0, 1), "by angular momentum",
                "block that rocks: angular rate after an impact over that before", "0.8",
                at(&SlidingOptions::restitution)),
         number(
             "steady_rate_change", none, Range::half_open(0, 1), "0.1",
             "finite elements: share by which the rate of sliding falls at most from one window of the run-out to the "
             "next where the dam goes on by itself (status self-excited); a judgement",
             "0.1", at(&SlidingOptions::steady_rate_change))}));
    return groups;
}

namespace {

const Units volume{{"m3", 1.0}};
const Units area{{"m2", 1.0}};
const Units point_force{{"kN", 1e3}, {"MN", 1e6}, {"N", 1.0}};
const Range azimuth_range = Range::between(0, 360);
const Range dip_range = Range::between(0, 90);

/// [[wedge.<name>]], a list of the wedge.
template <class T>
KeyGroup wedge_list(std::string name, std::string meaning, std::vector<T> RockWedge::*list, std::vector<Key> keys)
{
    KeyGroup group = list_group(
        std::move(name), std::move(meaning),
        [list](Scene & s) -> auto& {
            if (!s.wedge) s.wedge.emplace();
            return (*s.wedge).*list;
        },
        std::move(keys));
    group.items = [items = group.items](const Scene& s) { return s.wedge ? items(s) : std::vector<const void*>(); };
    return group;
}

KeyGroup wedge_group()
{
    using W = RockWedge;
    return optional_group(
        "wedge",
        "A rock wedge on two planes instead of a section; the scene then has no [section], [dam], [contact] nor what "
        "belongs to "
        "them. Its shape: `height_m` with face and upper ground, or `volume_m3` with the planes' areas.",
        &Scene::wedge,
        {number("density", density, Range::half_open(0, 1e5), "required", "of the rock", "2600", at(&W::density)),
         number("height", length, Range::half_open(0, 1e4), "required without volume_m3",
                "vertical distance between the ends of the line of intersection, in the face and in the upper ground",
                "40", at(&W::height)),
         number("face_dip", angle, Range::half_open(0, 90), "required with height_m", "dip of the slope's face", "65",
                at(&W::face_dip)),
         number("face_dip_direction", angle, azimuth_range, "required with height_m",
                "azimuth the face dips to, clockwise from north", "185", at(&W::face_dip_direction)),
         number("upper_dip", angle, Range{0, 90, false, true}, "0 (level)", "dip of the ground above the face", "12",
                at(&W::upper_dip)),
         number("upper_dip_direction", angle, azimuth_range, "the face's", "azimuth it dips to", "195",
                at(&W::upper_dip_direction)),
         number("volume", volume, Range::half_open(0, 1e12), "from the shape",
                "of the wedge, in place of height and surfaces", "6700", at(&W::volume)),
         word("water", "dry",
              "dry, or full: both planes are full of water that seeps out of the face, mean pressure γ_w H/6 on each",
              "\"full\"", choice(&W::water, {{"dry", WedgeWater::dry}, {"full", WedgeWater::full}})),
         word("cohesion_lost_at_slip", "true", "cohesion is gone from the first slip on", "false",
              at(&W::cohesion_lost_at_slip)),
         number("motion_azimuth", angle, azimuth_range, "where the wedge slides to by itself",
                "positive samples of the horizontal component drive the wedge towards this azimuth (the ground "
                "accelerates the other way)",
                "158", at(&W::motion_azimuth))});
}

} // namespace

std::vector<KeyGroup> wedge_groups()
{
    using P = RockPlane;
    using F = WedgeForce;
    return {
        wedge_group(),
        wedge_list<P>(
            "wedge.plane", "One of the two planes the wedge rests on.", &RockWedge::planes,
            {word("name", "plane 1, plane 2", "name in the tables", "\"A\"", at(&P::name)),
             number("dip", angle, dip_range, "required", "from the horizontal", "45", at(&P::dip)),
             number("dip_direction", angle, azimuth_range, "required", "azimuth it dips to, clockwise from north",
                    "105", at(&P::dip_direction)),
             number("friction", friction, Range::between(0, 10), "required", "Coulomb mu", "0.58", at(&P::friction)),
             number("cohesion", stress, Range::between(0, 1e6), "0", "on the whole plane", "24", at(&P::cohesion)),
             number("area", area, Range::between(0, 1e9), "from the shape; required with volume_m3",
                    "of the wedge on the plane", "885", at(&P::area)),
             number("water_pressure", stress, Range::between(0, 1e6), "by wedge.water",
                    "mean over the plane, lifts the wedge", "65", at(&P::water_pressure))}),
        wedge_list<F>(
            "wedge.force", "A steady force on the wedge: an anchor, a surcharge, water in a tension crack.",
            &RockWedge::forces,
            {word("name", "force", "name in the tables", "\"anchors\"", at(&F::name)),
             number("force", point_force, Range::half_open(0, 1e9), "required", "its size", "5000", at(&F::force)),
             number("trend", angle, azimuth_range, "required", "azimuth it pushes to", "355", at(&F::trend)),
             number("plunge", angle, Range::between(-90, 90), "required", "below the horizontal, positive down", "5",
                    at(&F::plunge))})};
}

} // namespace damslip::keys
