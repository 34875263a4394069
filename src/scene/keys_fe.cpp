#include "scene/key_parts.hpp"
#include "scene/keys.hpp"

namespace damslip::keys {

namespace {

Key only_with(TimeScheme scheme, Key key)
{
    key.applies = [scheme](const void* options) { return static_cast<const TimeOptions*>(options)->scheme == scheme; };
    return key;
}

/// A key of HHT, which "auto" takes where it does not take modes.
Key with_hht(Key key)
{
    key.applies = [](const void* options) {
        const TimeScheme scheme = static_cast<const TimeOptions*>(options)->scheme;
        return scheme == TimeScheme::hht || scheme == TimeScheme::automatic;
    };
    return key;
}

Key without_substeps(Key key)
{
    key.applies = [](const void* options) { return !static_cast<const TimeOptions*>(options)->substeps; };
    return key;
}

enum class MeshFrom { scene, file };

Key only_with(MeshFrom from, Key key)
{
    key.applies = [from](const void* options) {
        return static_cast<const MeshOptions*>(options)->file.has_value() == (from == MeshFrom::file);
    };
    return key;
}

} // namespace

std::vector<KeyGroup> fe_groups()
{
    std::vector<KeyGroup> groups;
    groups.push_back(group(
        "mesh", "Finite-element mesh.", &Scene::mesh,
        {number("size", length, Range::above(0), "height / 40", "element size in the dam", "1.5",
                at(&MeshOptions::size)),
         number("contact_size", length, Range::above(0), "base / 60, at most size", "element size on the contact plane; of a base below 6 m by default 0.1 m or base / 20, what is less",
                "0.75", at(&MeshOptions::contact_size)),
         number("rock_contact_size", length, Range::above(0), "the dam's nodes",
                "element size on the rock's side of the contact plane, whose nodes then need not face the dam's; runs "
                "with a tied base have facing nodes always",
                "1.125", at(&MeshOptions::rock_contact_size)),
         only_with(
             MeshFrom::scene,
             number("rock_size", length, Range::above(0), "foundation depth / 8",
                    "largest element in the rock; with mass, an eighth of a wave of the record's highest frequencies",
                    "10", at(&MeshOptions::rock_size))),
         only_with(MeshFrom::scene, number("growth", none, Range::between(1, 3), "1.15",
                                           "ratio of neighbouring element sizes away from the contact plane", "1.2",
                                           at(&MeshOptions::growth))),
         word("element", "q4-incompatible",
              "element type of dam and rock; q8, q9 and t6 are quadratic, linear on contact planes", "\"q8\"",
              choice(&MeshOptions::element,
                     std::vector<std::pair<std::string, ElementKind>>{{"q4-incompatible", ElementKind::q4_incompatible},
                                                                      {"q4", ElementKind::q4},
                                                                      {"t3", ElementKind::t3},
                                                                      {"q8", ElementKind::q8},
                                                                      {"q9", ElementKind::q9},
                                                                      {"t6", ElementKind::t6}})),
         word("file", "none",
              "Gmsh mesh (ASCII, version 2.2 or 4.1) of dam and rock, relative to the scene file, in place of the "
              "program's own; without size, contact_size, rock_contact_size and growth",
              "\"dam.msh\"", at(&MeshOptions::file)),
         only_with(MeshFrom::file, number("file_unit", length, Range::above(0), "1", "unit of the coordinates in file",
                                          "0.001", at(&MeshOptions::file_unit)))}));
    groups.push_back(group(
        "stages", "How the static state before the earthquake comes about.", &Scene::stages,
        {word("gravity", "dam", "what has weight", "\"dam-and-rock\"",
              choice(&Stages::gravity,
                     std::vector<std::pair<std::string, GravityStage>>{
                         {"dam", GravityStage::dam}, {"dam-and-rock", GravityStage::dam_and_rock}})),
         word("geostatic", "false", "displacements are set to zero after the gravity stage, stresses stay", "true",
              at(&Stages::geostatic)),
         word("pore_pressure", "none",
              "water in the rock: `total` (pressures on both joint faces, internal term) or `effective` (body force)",
              "\"total\"",
              choice(&Stages::pore_pressure,
                     std::vector<std::pair<std::string, PorePressure>>{{"none", PorePressure::none},
                                                                       {"total", PorePressure::total},
                                                                       {"effective", PorePressure::effective}}))}));
    groups.push_back(
        group("damping", "Structural damping of the FE model.", &Scene::damping,
              {word("method", "rayleigh", "how the coefficients are found", "\"modified-rayleigh\"",
                    choice(&Damping::method,
                           std::vector<std::pair<std::string, DampingMethod>>{
                               {"rayleigh", DampingMethod::rayleigh},
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
                    choice(&Damping::mass, std::vector<std::pair<std::string, MassDamping>>{
                                               {"deformation-only", MassDamping::deformation_only},
                                               {"relative", MassDamping::relative},
                                               {"total", MassDamping::total}}))}));
    groups.push_back(group(
        "time", "Time integration of the FE model.", &Scene::time,
        {word("scheme", "auto; hht where alpha is given",
              "integrator. auto: superposition of modes on a bonded base (fe --base tied) where it costs less, else "
              "hht; "
              "central-difference: explicit, steps below its limit; modal: bonded base only",
              "\"central-difference\"",
              choice(&TimeOptions::scheme,
                     std::vector<std::pair<std::string, TimeScheme>>{
                         {"auto", TimeScheme::automatic},
                         {"hht", TimeScheme::hht},
                         {"newmark", TimeScheme::newmark},
                         {"central-difference", TimeScheme::central_difference},
                         {"modal", TimeScheme::modal}})),
         with_hht(number("alpha", none, Range::between(-1.0 / 3.0, 0), "-0.05", "HHT alpha", "-0.05",
                         at(&TimeOptions::alpha))),
         only_with(TimeScheme::newmark, number("gamma", none, Range::between(0.5, 1.5), "0.5", "Newmark gamma", "0.5",
                                               at(&TimeOptions::gamma))),
         only_with(TimeScheme::newmark, number("beta", none, Range::half_open(0, 1), "0.25", "Newmark beta", "0.25",
                                               at(&TimeOptions::beta))),
         number("dt", seconds, Range::between(1e-7, 10), "the record's; central-difference: 0.9 of its limit or less",
                "time step", "0.005", at(&TimeOptions::dt)),
         word("substeps", "chosen by slip_tolerance",
              "k of the steps dt / 2^k of FE runs with contact, 0 ... 10; fixed, without an estimate of the error", "2",
              at(&TimeOptions::substeps)),
         without_substeps(
             word("stepping", "uniform",
                  "how chosen sub-steps are spread: all alike, or small ones only where the local error of "
                  "the slip asks for them, around its beginnings, ends and turns",
                  "\"adaptive\"",
                  choice(&TimeOptions::stepping,
                         std::vector<std::pair<std::string, Stepping>>{{"uniform", Stepping::uniform},
                                                                       {"adaptive", Stepping::adaptive}}))),
         without_substeps(
             number("slip_tolerance", none, Range::half_open(0, 1), "0.01",
                    "error of the FE slip over its largest size on the way, to which the sub-steps are chosen", "0.01",
                    at(&TimeOptions::slip_tolerance)))}));
    groups.push_back(
        group("analysis", "Settings of a published study as defaults; keys of the file win.", &Scene::analysis,
              {word("preset", "none",
                    "goldgruber-2015: slip-tolerance 0.005, no separation, massless rock, HHT alpha -1/3, time step "
                    "0.01 s without sub-steps, mass damping of the relative velocity",
                    "\"goldgruber-2015\"",
                    choice(&Analysis::preset, std::vector<std::pair<std::string, AnalysisPreset>>{
                                                  {"none", AnalysisPreset::none},
                                                  {"goldgruber-2015", AnalysisPreset::goldgruber_2015}}))}));
    return groups;
}

} // namespace damslip::keys
