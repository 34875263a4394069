#include "analysis/sweep/sweep_axes.hpp"

#include "analysis/prepare/plane_model.hpp"
#include "analysis/prepare/records.hpp"
#include "analysis/sweep/sweep_grid.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "scene/added_mass_formulas.hpp"
#include "scene/joint_bond.hpp"
#include "scene/keys.hpp"
#include "scene/rock_mass.hpp"
#include "scene/uplift_models.hpp"
#include "sliding/empirical/regression.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numeric>
#include <ranges>
#include <span>

namespace damslip {

namespace {

/// Words of the water models but added mass, which has one for each formula.
constexpr std::pair<std::string_view, ReservoirModel> water_words[] = {{"auto", ReservoirModel::automatic},
                                                                       {"hydrostatic", ReservoirModel::hydrostatic},
                                                                       {"acoustic", ReservoirModel::acoustic}};

std::string reservoir_word(const Scene& scene)
{
    if (!scene.reservoir) return "none";
    for (const auto& [word, model] : water_words)
        if (scene.reservoir->model == model) return std::string(word);
    return added_mass_row(scene.added_mass.formula).word;
}

/// "0.65,0.7" with all digits.
std::string joined(const std::vector<double>& values)
{
    std::string text;
    for (const double v : values) text += (text.empty() ? "" : ",") + shortest(v);
    return text;
}

} // namespace

bool Axes::finite_elements() const
{
    return std::any_of(method.begin(), method.end(),
                       [](const SweepMethod& m) { return m.kind == SweepKind::finite_elements; });
}

bool Axes::flexible() const
{
    return std::any_of(method.begin(), method.end(), [](const SweepMethod& m) { return is_flexible(m.kind); });
}

Axes axes_of(const Scene& scene)
{
    Axes axes;
    axes.friction = {scene.contact.friction};
    axes.level = {scene.reservoir ? scene.reservoir->level : 0.0};
    axes.size = axes.scale = {1.0};
    axes.polarity = polarities_of(scene);
    axes.uplift = {scene.uplift ? word(scene.uplift->model) : "none"};
    axes.reservoir = {reservoir_word(scene)};
    axes.method = {sweep_method("rigid")};
    return axes;
}

std::vector<std::string> reservoir_axis_words()
{
    std::vector<std::string> words;
    for (const auto& [word, model] : water_words) words.emplace_back(word);
    for (const AddedMassRow& row : added_mass_rows()) words.push_back(row.word);
    return words;
}

Scene variant(Scene scene, double level, const std::string& uplift, const std::string& reservoir, double size)
{
    if (scene.reservoir) {
        scene.reservoir->level = level;
        const auto plain =
            std::ranges::find(water_words, reservoir, &std::pair<std::string_view, ReservoirModel>::first);
        scene.reservoir->model = plain != std::end(water_words) ? plain->second : ReservoirModel::added_mass;
        if (plain == std::end(water_words)) scene.added_mass.formula = named_by<AddedMassFormula>(reservoir, added_mass_rows());
    }
    if (uplift == "none")
        scene.uplift.reset();
    else {
        if (!scene.uplift) scene.uplift.emplace();
        scene.uplift->model = named_by<UpliftModel>(uplift, uplift_rows());
    }
    return sized(std::move(scene), size);
}

double plane_friction(const Scene& scene, const std::string& plane)
{
    if (plane.empty() || plane == base_plane) return scene.contact.friction;
    for (const Seam& seam : scene.seams)
        if (seam.name == plane) return seam.strength.friction;
    for (const LiftJoint& joint : scene.lift_joints)
        if (joint.name == plane) return joint.strength.friction;
    return scene.lifts ? scene.lifts->strength.friction : scene.contact.friction;
}

std::string text_of(const Axes& axes)
{
    std::vector<std::string> methods;
    for (const SweepMethod& m : axes.method) methods.push_back(m.id);
    const std::string opening =
        has_opening_axis(axes) ? fmt::format("opening water {}; ", fmt::join(axes.opening, ",")) : "";
    std::string mode;
    if (!axes.period.empty()) mode += fmt::format("period {}; ", joined(axes.period));
    if (!axes.damping.empty()) mode += fmt::format("damping {}; ", joined(axes.damping));
    if (has_plane_axis(axes))
        mode += fmt::format("plane {}; own friction {}; ", fmt::join(axes.plane, ","), joined(axes.plane_friction));
    return opening + mode +
           fmt::format("friction {}; level {}; uplift {}; reservoir {}; size {}; scale {}; polarity {}; method {}",
                       joined(axes.friction), joined(axes.level), fmt::join(axes.uplift, ","),
                       fmt::join(axes.reservoir, ","), joined(axes.size), joined(axes.scale),
                       fmt::join(axes.polarity, ","), fmt::join(methods, ","));
}

namespace {

std::vector<SweepMethod> make_list()
{
    const auto fe = [](const char* id, FeLaw law) { return SweepMethod{id, SweepKind::finite_elements, law, false}; };
    std::vector<SweepMethod> list{{"rigid", SweepKind::rigid, FeLaw::scene, false},
                                  {"rigid-v", SweepKind::rigid_vertical, FeLaw::scene, false},
                                  {"rocking", SweepKind::rocking, FeLaw::scene, false},
                                  {"decoupled", SweepKind::decoupled, FeLaw::scene, false},
                                  {"coupled", SweepKind::coupled, FeLaw::scene, false},
                                  fe("fe", FeLaw::scene),
                                  fe("fe-exact", FeLaw::exact),
                                  fe("fe-penalty", FeLaw::penalty),
                                  fe("fe-slip-tolerance", FeLaw::slip_tolerance),
                                  fe("fe-whole-steps", FeLaw::whole_steps),
                                  fe("fe-goldgruber-2015", FeLaw::goldgruber_2015),
                                  fe("fe-radiating", FeLaw::radiating),
                                  fe("fe-massless", FeLaw::massless),
                                  {"fe-reduced", SweepKind::finite_elements, FeLaw::scene, true}};
    for (const sliding::Regression& r : sliding::regressions())
        list.push_back({std::string(r.id), SweepKind::regression, FeLaw::scene, false});
    return list;
}

const std::vector<SweepMethod>& sweep_method_list()
{
    static const std::vector<SweepMethod> list = make_list();
    return list;
}

} // namespace

std::vector<std::string> sweep_methods()
{
    std::vector<std::string> ids;
    for (const SweepMethod& m : sweep_method_list()) ids.push_back(m.id);
    return ids;
}

const SweepMethod& sweep_method(const std::string& id)
{
    const auto& list = sweep_method_list();
    return *std::find_if(list.begin(), list.end(), [&](const SweepMethod& m) { return m.id == id; });
}

Methods methods_of(const std::vector<SweepMethod>& list)
{
    Methods set = 0;
    for (const SweepMethod& method : list)
        set |= method.kind == SweepKind::regression        ? methods::regressions
               : method.kind != SweepKind::finite_elements ? methods::rigid
               : method.reduced                            ? methods::reduced
                                                           : methods::fe;
    return set;
}

Scene with_law(Scene scene, FeLaw law, std::optional<double> penalty_stiffness)
{
    if (law == FeLaw::scene) return scene;
    if (law == FeLaw::whole_steps) {
        scene.time.substeps = 0;
        return scene;
    }
    if (law == FeLaw::radiating) return with_radiating_rock(std::move(scene));
    if (law == FeLaw::massless) return with_massless_rock(std::move(scene));
    scene.contact.normal = NormalContact::hard;
    if (law == FeLaw::penalty) {
        scene.contact.enforcement = ContactEnforcement::penalty;
        if (penalty_stiffness) scene.contact.tangential_stiffness = penalty_stiffness;
        return scene;
    }
    scene.contact.tangential_stiffness.reset();
    scene.contact.enforcement = law == FeLaw::exact ? ContactEnforcement::exact : ContactEnforcement::slip_tolerance;
    if (law == FeLaw::goldgruber_2015) {
        scene.analysis.preset = AnalysisPreset::goldgruber_2015;
        apply_preset(scene, [](const char*) { return true; }); // whatever the scene says
    }
    return scene;
}

namespace {

std::optional<std::size_t> whole_number(std::string_view text)
{
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

using Axis = std::size_t AxisNumbers::*;
using Numbers = AxisNumbers;

// The axes of ids, of variants, of motions, and of the order in which rows of one method that share a set-up stay together.
constexpr Axis of_ids[] = {&Numbers::friction, &Numbers::plane,     &Numbers::level,    &Numbers::uplift,
                           &Numbers::opening,  &Numbers::reservoir, &Numbers::size,     &Numbers::period,
                           &Numbers::damping,  &Numbers::scale,     &Numbers::polarity, &Numbers::record,
                           &Numbers::method};
constexpr std::span of_variants = std::span(of_ids).subspan<1, 8>();
constexpr Axis of_motions[] = {&Numbers::record, &Numbers::scale, &Numbers::polarity};
constexpr Axis as_they_run[] = {&Numbers::plane,     &Numbers::level, &Numbers::uplift,   &Numbers::opening,
                                &Numbers::reservoir, &Numbers::size,  &Numbers::period,   &Numbers::damping,
                                &Numbers::record,    &Numbers::scale, &Numbers::polarity, &Numbers::friction};

/// The number of a place on some axes, the last fastest.
std::size_t number_of(const TaskList& tasks, std::span<const Axis> axes, const GridIndex& at)
{
    std::size_t number = 0;
    for (const Axis axis : axes) number = number * tasks.*axis + at.*axis;
    return number;
}

/// Its inverse.
GridIndex place_of(const TaskList& tasks, std::span<const Axis> axes, std::size_t number)
{
    GridIndex at;
    for (const Axis axis : axes | std::views::reverse) {
        at.*axis = number % tasks.*axis;
        number /= tasks.*axis;
    }
    return at;
}

} // namespace

GridIndex TaskList::index(std::size_t id) const
{
    return place_of(*this, of_ids, id);
}

std::size_t TaskList::id(const GridIndex& at) const
{
    return number_of(*this, of_ids, at);
}

std::size_t TaskList::variant(const GridIndex& at) const
{
    return number_of(*this, of_variants, at);
}

std::size_t TaskList::motion(const GridIndex& at) const
{
    return number_of(*this, of_motions, at);
}

double friction_of(const Axes& axes, const GridIndex& at)
{
    return axes.plane_friction.empty() ? axes.friction[at.friction] : axes.plane_friction[at.plane];
}

TaskList make_tasks(const Axes& axes, std::size_t records)
{
    TaskList tasks;
    tasks.friction = axes.friction.size();
    tasks.level = axes.level.size();
    tasks.plane = axes.plane.size();
    tasks.uplift = axes.uplift.size();
    tasks.opening = axes.opening.size();
    tasks.reservoir = axes.reservoir.size();
    tasks.size = axes.size.size();
    tasks.period = std::max<std::size_t>(1, axes.period.size());
    tasks.damping = std::max<std::size_t>(1, axes.damping.size());
    tasks.scale = axes.scale.size();
    tasks.polarity = axes.polarity.size();
    tasks.record = records;
    tasks.method = axes.method.size();
    return tasks;
}

Shard parse_shard(const std::string& text, const std::string& flag)
{
    const std::size_t slash = text.find('/');
    const auto index = whole_number(text.substr(0, slash)),
               count = slash == std::string::npos ? std::nullopt : whole_number(text.substr(slash + 1));
    if (!index || !count || *count == 0 || *count > 1'000'000 || *index >= *count)
        refuse_usage(fmt::format("{} {} is not allowed.", flag, text),
                     "i/n with whole numbers, i from 0 to n - 1: the i-th of n parts",
                     fmt::format("for four parts  {0} 0/4 ... {0} 3/4", flag));
    return {*index, *count};
}

std::vector<std::size_t> shard_rows(const TaskList& tasks, const Shard& shard)
{
    if (shard.count == 1) {
        std::vector<std::size_t> all(tasks.rows());
        std::iota(all.begin(), all.end(), std::size_t{0});
        return all;
    }
    const std::size_t of_method = tasks.rows() / tasks.method;
    // n may be above the number of rows; 1e6 parts of 2e7 rows stay below 2^64
    const std::size_t first = shard.index * of_method / shard.count, last = (shard.index + 1) * of_method / shard.count;
    std::vector<std::size_t> rows;
    rows.reserve((last - first) * tasks.method);
    for (std::size_t place = first; place < last; ++place) {
        GridIndex at = place_of(tasks, as_they_run, place);
        for (at.method = 0; at.method < tasks.method; ++at.method) rows.push_back(tasks.id(at));
    }
    std::sort(rows.begin(), rows.end());
    return rows;
}

} // namespace damslip
