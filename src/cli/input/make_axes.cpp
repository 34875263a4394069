#include "cli/input/make_axes.hpp"

#include "analysis/prepare/flexible_mass.hpp"
#include "analysis/prepare/plane_model.hpp"
#include "cli/input/run_inputs.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "scene/added_mass_formulas.hpp"
#include "scene/joint_bond.hpp"
#include "scene/plausible.hpp"
#include "scene/section.hpp"
#include "scene/uplift_models.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace damslip::cli {

namespace {

std::vector<double> checked_numbers(const std::string& text, const std::string& flag, double own, double low,
                                    double high, const std::string& meaning)
{
    if (text.empty()) return {own};
    std::vector<double> values = number_list(text, flag);
    for (const double v : values)
        if (!(v >= low && v <= high))
            refuse_usage(
                fmt::format("{}: {} is not allowed.", flag, v), meaning,
                fmt::format("give values from {} to {}, with a decimal point: a comma parts two values", low, high));
    return values;
}

/// Notes the first value that is not one of real dams, and says how many more there are.
/// @param key  whose range it is: "contact.friction"; @param unit  of the values, one of the key's; {}: without
/// @throws UsageError for "0,7", where both are unusual and 0.7 is not: a decimal comma
void look_at(const std::string& text, const std::string& flag, const std::string& key,
             const std::vector<double>& values, std::vector<Diagnostic>& notes, const UnitSuffix& unit = {})
{
    if (text.empty()) return;
    const Key of = key_named(key);
    const auto note_of = [&](double v) {
        return unusual(of, {fmt::format("{} {}", flag, shortest(v)), v, unit, false});
    };
    const auto is_unusual = [&](double v) { return note_of(v).has_value(); };
    const auto count = std::count_if(values.begin(), values.end(), is_unusual);
    if (count == 0) return;
    const std::optional<double> comma = decimal_comma(text);
    const bool comma_meant = comma && !is_unusual(*comma);
    Diagnostic note = *note_of(*std::find_if(values.begin(), values.end(), is_unusual));
    if (comma_meant && count == 2)
        refuse_usage(fmt::format("{} {} is read as two values, {} and {}, and neither is usual.", flag, text,
                                 shortest(values[0]), shortest(values[1])),
                     note.expected,
                     fmt::format("a decimal comma? write  {0} {1} ; for the two values  {0} {2}.0,{3}", flag,
                                 shortest(*comma), shortest(values[0]), shortest(values[1])));
    if (comma_meant) note.fix = fmt::format("a decimal comma? write  {} {}", flag, shortest(*comma));
    if (count > 1) note.problem += fmt::format(" So are {} more of the {} values.", count - 1, values.size());
    notes.push_back(std::move(note));
}

void look_at_levels(const std::string& text, const Scene& scene, const std::vector<double>& levels,
                    std::vector<Diagnostic>& notes)
{
    if (text.empty() || scene.wedge || scene.section.rock_slope) return;
    const double highest = *std::max_element(levels.begin(), levels.end());
    const double held = scene.gate ? scene.gate->top : upstream_face(scene.section).back().y;
    if (highest > held * (1 + 1e-12) && !scene.reservoir->overtopped)
        refuse_usage(fmt::format("--level {} is above the {} at {} m.", shortest(highest),
                                 scene.gate ? "top of the gates" : "crest", shortest(held)),
                     "levels that the dam or its gates hold, or  overtopped = true  in [reservoir]",
                     "add  [gate]  with top_m to the scene, or write  overtopped = true  in [reservoir]");
    if (auto note = unusual_level("--level " + shortest(highest), highest, crest_level(scene.section)))
        notes.push_back(std::move(*note));
}

/// Heights of the dam at the sizes of the axis.
void look_at_sizes(const std::string& text, const Scene& scene, const std::vector<double>& sizes,
                   std::vector<Diagnostic>& notes)
{
    if (text.empty() || scene.wedge) return;
    for (const double size : sizes) {
        const double height = size * crest_level(scene.section);
        auto note = unusual_argument(fmt::format("--size {}: a height of {:.6g} m", shortest(size), height),
                                     "section.height", height);
        if (!note) continue;
        note->fix = "--size is a factor on the lengths of the scene, not a length";
        notes.push_back(std::move(*note));
        return;
    }
}

void look_at_axes(const SweepArguments& a, const Scene& scene, Axes& axes)
{
    look_at(a.friction, "--friction", "contact.friction", axes.friction, axes.notes);
    if (!a.friction_deg.empty())
        look_at(a.friction_deg, "--friction-deg", "contact.friction", number_list(a.friction_deg, "--friction-deg"),
                axes.notes, {"deg", 1.0, true});
    look_at(a.period, "--period", "flexible_block.period", axes.period, axes.notes);
    look_at(a.scale, "--scale", "motion.scale", axes.scale, axes.notes);
    look_at_levels(a.level, scene, axes.level, axes.notes);
    look_at_sizes(a.size, scene, axes.size, axes.notes);
    if (a.penalty_stiffness)
        if (auto note = unusual_argument("--penalty-stiffness " + shortest(*a.penalty_stiffness),
                                         "contact.tangential_stiffness", *a.penalty_stiffness))
            axes.notes.push_back(std::move(*note));
}

std::vector<double> friction_axis(const SweepArguments& a, const Scene& scene)
{
    if (!a.friction.empty() && !a.friction_deg.empty())
        refuse_usage("--friction and --friction-deg are both given.", "one of them", "delete one");
    if (a.friction_deg.empty())
        return checked_numbers(a.friction, "--friction", scene.contact.friction, 0, 10, "Coulomb mu, 0 ... 10");
    std::vector<double> values =
        checked_numbers(a.friction_deg, "--friction-deg", 0, 0, 84, "friction angle [deg], 0 ... 84");
    for (double& v : values) v = std::tan(v * units::degree);
    return values;
}

std::vector<std::string> uplift_axis(const SweepArguments& a, const Scene& scene)
{
    std::vector<std::string> known;
    for (const UpliftRow& row : uplift_rows()) known.push_back(row.word);
    std::vector<std::string> words = word_list(a.uplift, "--uplift", known);
    for (const std::string& u : words)
        if (const UpliftRow& row = uplift_row(named_by<UpliftModel>(u, uplift_rows())); !has_what_it_needs(scene, row))
            refuse_usage(fmt::format("--uplift {}: the scene lacks what this profile needs.", u), row.needs,
                         "add it to the scene or leave the profile out");
    return words;
}

std::vector<std::string> opening_axis(const SweepArguments& a, const Scene& scene)
{
    std::vector<std::string> known;
    for (const auto& [word, rule] : opening_waters()) known.push_back(word);
    std::vector<std::string> words = word_list(a.opening_water, "--opening-water", known);
    if (!scene.uplift)
        refuse_usage("--opening-water is given, but the scene has no [uplift].", "a scene with water under the base",
                     "add [uplift] to the scene");
    if (!scene.uplift->water.mouth_speed && std::find(words.begin(), words.end(), "mouth") != words.end())
        refuse_usage("--opening-water mouth: the scene has no uplift.mouth_speed_m_s.",
                     "the speed at which water enters the crack",
                     "add  mouth_speed_m_s = 5  to [uplift], or leave mouth out");
    return words;
}

std::vector<std::string> reservoir_axis(const SweepArguments& a, const Scene& scene)
{
    std::vector<std::string> words = word_list(a.reservoir, "--reservoir", reservoir_axis_words());
    for (const AddedMassRow& row : added_mass_rows())
        if (std::find(words.begin(), words.end(), row.word) != words.end() && !has_what_it_needs(scene, row))
            refuse_usage(fmt::format("--reservoir {}: the scene lacks what this formula needs.", row.word), row.needs,
                         "add it to the scene or leave the formula out");
    return words;
}

std::vector<SweepMethod> method_axis(const SweepArguments& a, const Scene& scene)
{
    std::vector<std::string> ids{"rigid"};
    const bool vertical = std::any_of(scene.motion.records.begin(), scene.motion.records.end(),
                                      [](const RecordFiles& r) { return r.vertical.has_value(); });
    if (!a.method.empty())
        ids = word_list(a.method, "--method", sweep_methods());
    else if (vertical && scene.motion.vertical)
        ids.emplace_back("rigid-v");
    std::vector<SweepMethod> methods;
    for (const std::string& id : ids) methods.push_back(sweep_method(id));
    const auto given = [&](auto&& matches) { return std::any_of(methods.begin(), methods.end(), matches); };
    const bool penalty = given([](const SweepMethod& m) { return m.law == FeLaw::penalty; });
    if (penalty && !a.penalty_stiffness && !scene.contact.tangential_stiffness)
        refuse_usage("--method fe-penalty: neither scene nor command line give the stiffness of sticking.",
                     "contact.tangential_stiffness_N_m3 with enforcement = \"penalty\", or --penalty-stiffness",
                     "add  --penalty-stiffness 1e11");
    if (!penalty && a.penalty_stiffness)
        refuse_usage("--penalty-stiffness is given, but fe-penalty is not among the methods.", "both or neither",
                     "add fe-penalty to --method, or delete --penalty-stiffness");
    if (a.modes && !given([](const SweepMethod& m) { return m.reduced; }))
        refuse_usage("--modes is given, but fe-reduced is not among the methods.", "both or neither",
                     "add fe-reduced to --method, or delete --modes");
    if (a.truncation_error && !given([](const SweepMethod& m) { return m.reduced; }))
        refuse_usage("--truncation-error is given, but fe-reduced is not among the methods.", "both or neither",
                     "add fe-reduced to --method, or delete --truncation-error");
    return methods;
}

std::vector<int> polarity_axis(const std::string& text)
{
    if (text == "both") return {1, -1};
    const std::string meaning = "1, -1, or both: the sign on the horizontal component as filed";
    std::vector<int> values;
    for (const double p : checked_numbers(text, "--polarity", 1, -1, 1, meaning)) {
        if (p != 1 && p != -1)
            refuse_usage(fmt::format("--polarity {} is not allowed.", p), meaning, "write  --polarity both");
        values.push_back(static_cast<int>(p));
    }
    return values;
}

template <class Value>
void refuse_repeats(const char* flag, const std::vector<Value>& values)
{
    std::set<Value> seen;
    for (const Value& value : values)
        if (!seen.insert(value).second)
            refuse_usage(fmt::format("{}: {} is given twice.", flag, value), "each value once",
                         "delete the second one");
}

/// Periods and damping ratios of the flexible block.
void add_mode_axes(const SweepArguments& a, const Scene& scene, Axes& axes)
{
    const bool has_mode = scene.flexible_block || scene.regressions.period > 0.0 || !a.period.empty();
    for (const SweepMethod& m : axes.method)
        if (is_flexible(m.kind) && (!has_mode || scene.wedge))
            refuse_usage(
                fmt::format("--method {}: {}.", m.id,
                            scene.wedge ? "a [wedge] has no mode" : "the scene does not say how the block vibrates"),
                "[flexible_block] with period_s, regressions.period_s, or --period",
                scene.wedge ? "delete it" : "add  --period 0.2");
    if (axes.flexible() && has_laws_of_rigid_blocks(scene))
        refuse_usage("decoupled and coupled with anchors, friction over the rate, rebounds or a sequence.",
                     "a block that vibrates without them: it does not follow these laws",
                     "take rigid or fe, or leave the law out");
    if (!a.period.empty() && scene.flexible_block && scene.flexible_block->height)
        refuse_usage("--period is given, but [flexible_block] is a column.", "one of them",
                     "delete height_m and the others, or --period");
    for (const auto& [flag, text] : {std::pair{"--period", a.period}, {"--damping", a.damping}})
        if (!text.empty() && !axes.flexible())
            refuse_usage(fmt::format("{} is given, but neither decoupled nor coupled is among the methods.", flag),
                         "both or neither", fmt::format("add coupled to --method, or delete {}", flag));
    if (!a.period.empty())
        axes.period =
            checked_numbers(a.period, "--period", 0, 1e-3, 100, "period of the flexible block [s], 0.001 ... 100");
    if (!a.damping.empty())
        axes.damping = checked_numbers(a.damping, "--damping", 0, 0, 0.5, "damping ratio, 0 ... 0.5");
}

/// What a method slides on beside the base: rigid blocks on every plane, finite elements of the whole dam on seams.
/// @param own  each plane keeps its own friction
void check_planes_of(const SweepMethod& m, const std::vector<std::string>& planes, const Scene& scene, bool own)
{
    if (m.kind == SweepKind::rigid || m.kind == SweepKind::rigid_vertical) return;
    if (m.kind != SweepKind::finite_elements || m.reduced)
        refuse_usage(fmt::format("--plane with --method {}.", m.id),
                     "on planes beside the base: rigid, rigid-v; on seams fe and its laws, too",
                     "write  --method rigid,rigid-v");
    const auto is_seam = [&](const std::string& plane) {
        return std::any_of(scene.seams.begin(), scene.seams.end(), [&](const Seam& s) { return s.name == plane; });
    };
    for (const std::string& plane : planes)
        if (plane != base_plane && !is_seam(plane))
            refuse_usage(fmt::format("--plane \"{}\" with --method {}.", plane, m.id),
                         "base and seams; lifts wake beside the base in  damslip fe  and  damslip assess",
                         fmt::format("take \"{}\" out, or write  --method rigid,rigid-v", plane));
    for (const Seam& seam : scene.seams) // the plane of the least yield, in which the mesh has its wedge, is another with each friction
        if (!own && seam.exit == SeamExit::wedge && seam.wedge->angles.size() != 1 &&
            std::find(planes.begin(), planes.end(), seam.name) != planes.end())
            refuse_usage(fmt::format("--friction with --method {} on \"{}\", whose wedge is searched for.", m.id, seam.name),
                         "a wedge of one angle, as the mesh has it; damslip screen finds that of the least yield",
                         "write  angle_deg = 25  (or that angle) in [seam.wedge], or leave --friction out");
}

/// What the dam slides on. Each plane keeps its own friction unless --friction gives one for all.
void add_plane_axis(const SweepArguments& a, const Scene& scene, Axes& axes)
{
    if (a.plane.empty()) return;
    for (const auto& [flag, text] :
         {std::pair{"--uplift", a.uplift}, {"--opening-water", a.opening_water}, {"--size", a.size}})
        if (!text.empty())
            refuse_usage(fmt::format("--plane with {}.", flag),
                         "--friction, --level, --reservoir, --scale, --polarity: water and size of a plane are its keys",
                         fmt::format("delete {}", flag));
    axes.plane = word_list(a.plane, "--plane", plane_names(scene));
    const bool own = a.friction.empty() && a.friction_deg.empty();
    for (const SweepMethod& m : axes.method) check_planes_of(m, axes.plane, scene, own);
    for (std::string& plane : axes.plane) {
        if (own) axes.plane_friction.push_back(plane_friction(scene, plane));
        if (plane == base_plane) plane.clear();
    }
}

void check_repeats(const Axes& axes)
{
    refuse_repeats("--plane", axes.plane);
    refuse_repeats("--friction", axes.friction);
    refuse_repeats("--level", axes.level);
    refuse_repeats("--uplift", axes.uplift);
    refuse_repeats("--opening-water", axes.opening);
    refuse_repeats("--reservoir", axes.reservoir);
    refuse_repeats("--size", axes.size);
    refuse_repeats("--period", axes.period);
    refuse_repeats("--damping", axes.damping);
    refuse_repeats("--scale", axes.scale);
    refuse_repeats("--polarity", axes.polarity);
    std::vector<std::string> methods;
    for (const SweepMethod& m : axes.method) methods.push_back(m.id);
    refuse_repeats("--method", methods);
}

/// A wedge has friction, records, their scale and polarity to vary, and no finite elements.
void check_wedge_axes(const SweepArguments& a, const std::vector<SweepMethod>& methods)
{
    for (const auto& [flag, text] : {std::pair{"--level", a.level},
                                     {"--uplift", a.uplift},
                                     {"--opening-water", a.opening_water},
                                     {"--reservoir", a.reservoir},
                                     {"--plane", a.plane},
                                     {"--size", a.size}})
        if (!text.empty())
            refuse_usage(fmt::format("{} is given, but the scene is a [wedge].", flag),
                         "--friction (of the first plane; the other keeps its share), --scale, --polarity, --record",
                         fmt::format("delete {}", flag));
    for (const SweepMethod& m : methods)
        if (m.kind == SweepKind::finite_elements || m.kind == SweepKind::rocking)
            refuse_usage(fmt::format("--method {} cannot take a [wedge]: it has no {}.", m.id,
                                     m.kind == SweepKind::rocking ? "toe to rock on" : "section for finite elements"),
                         "rigid, rigid-v and the regressions", "delete it");
}

} // namespace

Axes make_axes(const SweepArguments& a, const Scene& scene)
{
    Axes axes = axes_of(scene);
    axes.friction = friction_axis(a, scene);
    if (!scene.reservoir)
        for (const auto& [flag, text] : {std::pair{"--level", a.level}, {"--reservoir", a.reservoir}})
            if (!text.empty())
                refuse_usage(fmt::format("{} is given, but the scene has no [reservoir].", flag),
                             "a scene with [reservoir]", "add [reservoir] to the scene");
    axes.level =
        checked_numbers(a.level, "--level", axes.level.front(), 0, scene.wedge ? 0.0 : 3 * crest_level(scene.section),
                        "water level above the heel at size 1 [m]");
    axes.size = checked_numbers(a.size, "--size", 1.0, 0.01, 100, "factor on all lengths of the scene, 0.01 ... 100");
    axes.scale = checked_numbers(a.scale, "--scale", 1.0, 0, 1e3, "factor on the records, 0 ... 1000");
    if (!a.polarity.empty()) axes.polarity = polarity_axis(a.polarity);
    if (!a.uplift.empty()) axes.uplift = uplift_axis(a, scene);
    if (!a.opening_water.empty() && !scene.wedge) axes.opening = opening_axis(a, scene);
    if (!a.reservoir.empty()) axes.reservoir = reservoir_axis(a, scene);
    axes.method = method_axis(a, scene);
    add_mode_axes(a, scene, axes);
    add_plane_axis(a, scene, axes);
    if (scene.wedge) check_wedge_axes(a, axes.method);
    check_repeats(axes);
    look_at_axes(a, scene, axes);
    return axes;
}

namespace {

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts{""};
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

[[noreturn]] void fail(const std::string& flag, const std::string& text, const std::string& why)
{
    refuse_usage(fmt::format("{} {}: {}", flag, text, why),
                 "numbers with a decimal point, 1.00,0.84,0.77, or a range first:last:step 0.65:1.0:0.05",
                 fmt::format("for example  {} 0.65:1.0:0.05", flag));
}

void append_range(const std::vector<std::string>& parts, const std::string& flag, const std::string& text,
                  std::vector<double>& out)
{
    const auto first = parse_whole_number_text(parts[0]), last = parse_whole_number_text(parts[1]),
               step = parse_whole_number_text(parts[2]);
    if (!first || !last || !step) fail(flag, text, "a range needs three numbers.");
    if (*step == 0.0 || (*last - *first) / *step < 0.0) fail(flag, text, "the step does not lead from first to last.");
    const double count = std::floor((*last - *first) / *step + 1e-9) + 1.0;
    if (count > 1e5) fail(flag, text, "more than 100 000 values.");
    const double decimals = std::pow(10.0, 12.0); // 0.65 + 3 * 0.05 reads 0.8, not 0.8000000000000002
    for (double i = 0; i < count; ++i) {
        const double value = *first + i * *step;
        out.push_back(std::abs(value) < 1e3 ? std::round(value * decimals) / decimals : value);
    }
}

} // namespace

std::vector<double> number_list(const std::string& text, const std::string& flag)
{
    std::vector<double> values;
    for (const std::string& item : split(text, ',')) {
        const std::vector<std::string> parts = split(item, ':');
        if (parts.size() == 3) {
            append_range(parts, flag, text, values);
        } else if (const auto value = parts.size() == 1 ? parse_whole_number_text(item) : std::nullopt) {
            values.push_back(*value);
        } else {
            fail(flag, text, fmt::format("\"{}\" is not a number.", item));
        }
    }
    return values;
}

std::optional<double> decimal_comma(const std::string& text)
{
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos || comma == 0 || comma + 1 == text.size()) return std::nullopt;
    if (text.find_first_not_of("0123456789", comma + 1) != std::string::npos) return std::nullopt;
    if (text.find_first_not_of("0123456789") != comma) return std::nullopt;
    return parse_whole_number_text(text.substr(0, comma) + "." + text.substr(comma + 1));
}

std::vector<std::string> word_list(const std::string& text, const std::string& flag,
                                   const std::vector<std::string>& allowed)
{
    std::vector<std::string> words = split(text, ',');
    for (const std::string& word : words) {
        if (!word.empty() && (allowed.empty() || std::find(allowed.begin(), allowed.end(), word) != allowed.end()))
            continue;
        const std::string_view near = nearest(word, allowed);
        refuse_usage(fmt::format("{} {}: \"{}\" is not known.{}", flag, text, word,
                                 near.empty() ? "" : fmt::format(" Did you mean {}?", near)),
                     fmt::format("{}", fmt::join(allowed, ", ")),
                     near.empty() ? fmt::format("for example  {} {}", flag, allowed.empty() ? "a,b" : allowed.front())
                                  : fmt::format("write  {} \"{}\"", flag, near));
    }
    return words;
}

} // namespace damslip::cli
