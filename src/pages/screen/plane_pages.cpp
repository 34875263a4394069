#include "pages/screen/screen_pages.hpp"

#include "core/units.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/section.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

/// Base, lifts and seams side by side: tables, charts, a drawing of each seam.
namespace damslip::pages {

namespace {

using units::degree;
using units::kPa;
using units::mm;
using units::standard_gravity;
constexpr double kN = 1e3; // [N]

Cell factor_cell(const PlaneRow& row, std::size_t state)
{
    return state < row.factors.size() ? optional_cell(row.factors[state]) : Cell();
}

std::optional<double> slip_of(const PlaneRow& row)
{
    const PlaneSlip* worst = row.worst();
    return worst ? reported(worst->slide.status, worst->slide.max_slip) : std::nullopt;
}

std::string governs_words(const Planes& planes, std::size_t row)
{
    std::string words;
    for (const auto& [by, word] : {std::pair(planes.by_factor, "F"), std::pair(planes.by_yield, "a_y"),
                                   std::pair(planes.by_slip, "slip")})
        if (by == row && (by != planes.by_slip || std::string(word) != "slip" || !planes.rows[row].slips.empty()))
            words += std::string(words.empty() ? "" : ", ") + word;
    return words;
}

} // namespace

Table plane_table(const Planes& planes, const Scene& scene, PlaneRows which)
{
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < planes.rows.size(); ++i)
        if (which == PlaneRows::all || !governs_words(planes, i).empty() ||
            (which == PlaneRows::governing_lifts && planes.rows[i].kind != PlaneKind::lift))
            shown.push_back(i);
    using R = std::size_t;
    const auto row = [&](R i) -> const PlaneRow& { return planes.rows[i]; };
    const auto with_slip = [row](auto value) {
        return [row, value](R i) {
            const PlaneSlip* worst = row(i).worst();
            return worst ? value(*worst) : Cell();
        };
    };
    std::vector<ColumnOf<R>> columns{{in_brief({"plane", "plane"}), [row](R i) { return row(i).name; }},
                                     {{"alpha_deg", "α", "°", 4}, [row](R i) { return row(i).angle; }, degree}};
    const std::size_t last = planes.states.size() - 1;
    if (last > 0)
        columns.push_back({{"factor_" + std::string("static"), "F " + planes.states.front().ground.name, "–", 4},
                           [row](R i) { return factor_cell(row(i), 0); }});
    for (std::size_t k = 1; k < last; ++k)
        columns.push_back({{fmt::format("factor_{}", k), "F " + planes.states[k].ground.name, "–", 4},
                           [row, k](R i) { return factor_cell(row(i), k); }});
    columns.push_back({in_brief({"factor", "F " + planes.states[last].ground.name, "–", 4}),
                       [row, last](R i) { return factor_cell(row(i), last); }});
    if (std::ranges::any_of(planes.states, [](const PlaneState& s) { return s.required.has_value(); }))
        columns.push_back({{"factor_over_required", "F/required", "–", 4},
                           [row, &planes](R i) { return finite_cell(margin(row(i), planes.states)); }});
    const std::vector<ColumnOf<R>> rest{
        {in_brief({"a_y_m_s2", "a_y", "m/s²", 4}), [row](R i) { return finite_cell(row(i).yield); }},
        {{"slip_factor", "s″/(a - a_y)", "–", 4}, [row](R i) { return row(i).slip_factor; }},
        {ranking({"slip_m", "largest slip", "m", 5}), [row](R i) { return slip_of(row(i)); }},
        {{"record", "record"}, with_slip([](const PlaneSlip& s) { return Cell(s.record); })},
        {{"polarity", "polarity"}, with_slip([](const PlaneSlip& s) { return Cell(s.polarity); })},
        {{"status", "status"}, with_slip([](const PlaneSlip& s) { return Cell(word(s.slide.status)); })},
        {in_brief({"verdict", "verdict"}),
         [row, &planes, &scene](R i) {
             const Verdict verdict = judge(row(i), planes, scene);
             if (verdict == Verdict::pass) return Cell("below"); // rigid blocks
             return verdict == Verdict::none ? Cell() : Cell(word(verdict));
         }},
        {in_brief({"governs", "governs by"}), [&planes](R i) { return governs_words(planes, i); }}};
    columns.insert(columns.end(), rest.begin(), rest.end());
    Table t = table_of<R>("Planes", columns, shown);
    std::string states;
    for (const PlaneState& s : planes.states)
        states += fmt::format("{}{} (k_h {:.4g}, k_v {:.4g}{})", states.empty() ? "" : ", ", s.ground.name,
                              s.ground.a_h / standard_gravity, s.ground.a_v / standard_gravity,
                              s.required ? fmt::format(", required {:.4g}", *s.required) : "");
    t.notes = {"F: factor of safety in " + states + "; a_y: ground acceleration at which it starts to slide.",
               "α: angle of the wedge's plane at the least a_y; slip: largest of all records and both polarities, with the "
               "vertical component where a record has one; below: no PASS, rigid blocks are no upper bound of an elastic dam."};
    if (shown.size() < planes.rows.size())
        t.notes.push_back(which == PlaneRows::governing
                              ? fmt::format("{} planes that govern nothing: see  damslip screen .", planes.rows.size() - shown.size())
                              : fmt::format("{} lifts that govern nothing: see the table of lifts.",
                                            planes.rows.size() - shown.size()));
    return t;
}

Table criteria_table(const Screening& s, const Scene& scene)
{
    struct Row {
        std::string plane, combination, check;
        double required, computed, ratio; ///< [-]
        std::string source;
    };
    std::vector<Row> rows;
    for (const sliding::Equilibrium& e : s.combinations)
        for (const sliding::Check& check : e.checks) {
            if (!check.required || !std::isfinite(check.value) || !(*check.required > 0.0)) continue;
            const bool distance = check.quantity.starts_with("resultant");
            rows.push_back({"base", e.name, check.quantity, *check.required, check.value,
                            distance ? *check.required / check.value : check.value / *check.required, check.source});
        }
    for (const PlaneRow& plane : s.planes.rows)
        for (std::size_t k = 0; k < s.planes.states.size() && k < plane.factors.size(); ++k) {
            const PlaneState& state = s.planes.states[k];
            if (plane.kind == PlaneKind::base || !state.required || !plane.factors[k]) continue;
            std::string source;
            for (const Combination& c : scene.combinations)
                if (c.name == state.ground.name) source = sliding::requirements(scene, c).source;
            rows.push_back({plane.name, state.ground.name, "sliding", *state.required, *plane.factors[k],
                            *plane.factors[k] / *state.required, source});
        }
    return table_of<Row>("Required and computed",
                         {{{"plane", "plane"}, &Row::plane},
                          {{"combination", "combination"}, &Row::combination},
                          {{"check", "check"}, &Row::check},
                          {{"required", "required", "–", 4}, &Row::required},
                          {{"computed", "computed", "–", 4}, &Row::computed},
                          {{"ratio", "ratio", "–", 4}, &Row::ratio},
                          {{"source", "source"}, &Row::source}},
                         rows, {"ratio: computed over required, of the resultant's distance required over computed; 1 and more holds."});
}

Table lift_plane_table(const Planes& planes)
{
    const std::size_t last = planes.states.size() - 1;
    struct L {
        const sliding::LiftPlane& lift;
        const PlaneRow& row;
        const sliding::LiftState& state;
    };
    std::vector<L> lifts;
    for (const PlaneRow& row : planes.rows)
        if (row.kind == PlaneKind::lift)
            lifts.push_back({planes.lifts[row.place], row, planes.lifts[row.place].states[last]});
    const bool named = std::ranges::any_of(lifts, [](const L& l) { // else the elevation is the name
        return !l.row.name.starts_with("lift at ");
    });
    const bool weakens = std::ranges::any_of(
        lifts, [](const L& l) { return std::isfinite(l.state.factor) && l.state.factor_residual != l.state.factor; });
    std::vector<ColumnOf<L>> columns{{{"elevation_m", "elevation", "m", 5}, [](const L& l) { return l.lift.elevation; }}};
    if (named) columns.push_back({{"lift", "lift"}, [](const L& l) { return l.row.name; }});
    const std::vector<ColumnOf<L>> forces{
        {{"normal_force_kN_m", "N'", "kN/m", 5}, [](const L& l) { return l.state.normal / kN; }},
        {{"shear_force_kN_m", "T", "kN/m", 5}, [](const L& l) { return l.state.shear / kN; }}};
    columns.insert(columns.end(), forces.begin(), forces.end());
    if (last > 0)
        columns.push_back({{"factor_static", "F " + planes.states.front().ground.name, "–", 4},
                           [](const L& l) { return factor_cell(l.row, 0); }});
    columns.push_back({{"factor", "F", "–", 4}, [last](const L& l) { return factor_cell(l.row, last); }});
    if (weakens)
        columns.push_back({{"factor_residual", "F residual", "–", 4},
                           [](const L& l) { return finite_cell(l.state.factor_residual); }});
    const std::vector<ColumnOf<L>> rest{
        {{"heel_stress_kPa", "σ up", "kPa", 4}, [](const L& l) { return finite_cell(l.state.heel_stress, kPa); }},
        {{"toe_stress_kPa", "σ down", "kPa", 4}, [](const L& l) { return finite_cell(l.state.toe_stress, kPa); }},
        {{"crack_m", "crack", "m", 4}, [](const L& l) { return l.state.base.crack.length; }},
        {{"a_y_m_s2", "a_y", "m/s²", 4}, [](const L& l) { return finite_cell(l.row.yield); }},
        {{"amplification", "Ā", "–", 4}, [](const L& l) { return l.row.amplification; }},
        {{"joint_peak_m_s2", "max a_J", "m/s²", 4}, [](const L& l) { return l.row.joint_peak; }},
        {{"slip_mm", "slip", "mm", 5}, [](const L& l) { return slip_of(l.row); }, mm}};
    columns.insert(columns.end(), rest.begin(), rest.end());
    return table_of<L>("Lifts", columns, lifts,
                       {fmt::format("N', T, F, stresses (compression positive, effective) and crack in {}; a_y: of the ground, "
                                    "Ā: mean acceleration of the part above over it; max a_J: of the joint in all records.",
                                    planes.states[last].ground.name)});
}

Table block_table(const Planes& planes)
{
    struct B {
        const sliding::SeamPlane& plane;
        std::size_t i;
        double rate;
    };
    std::vector<B> blocks;
    for (const sliding::SeamPlane& plane : planes.seams) {
        const sliding::ChainLaw law = sliding::chain_law(plane.model.chain);
        for (std::size_t i = 0; i < plane.model.chain.blocks.size(); ++i) blocks.push_back({plane, i, law.rates[i]});
    }
    const auto of_forces = [](const std::vector<double> sliding::ChainForces::*member) {
        return [member](const B& b) {
            const std::vector<double>& list = b.plane.forces.*member;
            return b.i < list.size() ? Cell(list[b.i] / kN) : Cell();
        };
    };
    const auto of_segment = [](double sliding::ChainBlock::*member, double unit) {
        return [member, unit](const B& b) { return b.plane.model.chain.blocks[b.i].*member / unit; };
    };
    return table_of<B>(
        "Blocks",
        {{{"plane", "plane"}, [](const B& b) { return b.plane.name; }},
         {{"block", "block"}, [](const B& b) { return b.i + 1; }},
         {{"theta_deg", "θ", "°", 4}, of_segment(&sliding::ChainBlock::dip, degree)},
         {{"length_m", "L", "m", 4}, of_segment(&sliding::ChainBlock::length, 1.0)},
         {{"weight_kN_m", "W", "kN/m", 5},
          [](const B& b) { return b.plane.model.chain.blocks[b.i].mass * b.plane.model.chain.gravity / kN; }},
         {{"uplift_kN_m", "U", "kN/m", 5}, of_segment(&sliding::ChainBlock::uplift, kN)},
         {{"normal_force_kN_m", "N'", "kN/m", 5}, of_forces(&sliding::ChainForces::normal)},
         {{"resistance_kN_m", "R", "kN/m", 5}, of_forces(&sliding::ChainForces::resistance)},
         {{"interface_force_kN_m", "E", "kN/m", 5}, of_forces(&sliding::ChainForces::thrust)},
         {{"interface_shear_kN_m", "X", "kN/m", 5}, of_forces(&sliding::ChainForces::shear)},
         {{"speed", "q", "–", 4}, &B::rate},
         {{"share", "share", "%", 3},
          [](const B& b) { return b.i < b.plane.shares.size() ? Cell(100.0 * b.plane.shares[b.i]) : Cell(); }}},
        blocks,
        {"At the yield, from upstream to downstream; θ: dip downstream; R: resistance c L + μ N'; E and X: on the face "
         "to the next block; q: speed over that of the dam; share: of the work of all resistances."});
}

namespace {

/// One curve over the elevation of the lifts.
template <class Value>
Curve over_elevation(const Planes& planes, const std::string& name, Value&& value, int colour)
{
    Curve curve{.name = name, .mark = Mark::line_and_points, .colour = colour};
    for (const PlaneRow& row : planes.rows)
        if (row.kind == PlaneKind::lift)
            curve.add(planes.lifts[row.place].elevation, value(row, planes.lifts[row.place]));
    return curve;
}

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

std::vector<Part> lift_charts(const Planes& planes)
{
    const Axis elevation{"elevation of the lift", "m"};
    const std::size_t last = planes.states.size() - 1;
    Chart factor{"Factor of safety over elevation", elevation, {"factor of safety", "–", Scale::log}};
    for (std::size_t i = 0; i < planes.states.size(); ++i) {
        factor.curves.push_back(over_elevation(
            planes, planes.states[i].ground.name,
            [i](const PlaneRow& row, const auto&) { return row.factors[i].value_or(no_value); }, int(i)));
        if (planes.states[i].required)
            factor.horizontal.push_back({*planes.states[i].required, "required, " + planes.states[i].ground.name});
    }
    Chart stress{"Stress over elevation", elevation, {"effective stress, compression positive", "kPa"}};
    stress.curves = {over_elevation(planes, "upstream face",
                                    [=](const auto&, const sliding::LiftPlane& l) { return l.states[last].heel_stress / kPa; }, 0),
                     over_elevation(planes, "downstream face",
                                    [=](const auto&, const sliding::LiftPlane& l) { return l.states[last].toe_stress / kPa; }, 1)};
    stress.note = "Normal to the lift, in " + planes.states[last].ground.name + ".";
    std::vector<Part> parts{std::move(factor), std::move(stress)};
    if (planes.rows.front().slips.empty()) return parts;
    Chart slip{"Slip over elevation", elevation, {"largest slip", "mm", Scale::asinh}};
    slip.curves.push_back(over_elevation(
        planes, "largest of all records",
        [](const PlaneRow& row, const auto&) { return slip_of(row).value_or(no_value) / mm; }, 0));
    parts.push_back(std::move(slip));
    return parts;
}

std::optional<Chart> wedge_chart(const Planes& planes, const sliding::SeamPlane& plane)
{
    if (plane.trials.size() < 2) return std::nullopt;
    Chart chart{fmt::format("Factor of safety over the wedge's angle, {}", plane.name),
                {"angle α of the wedge's plane", "°"},
                {"factor of safety", "–"}};
    for (std::size_t i = 0; i < planes.states.size(); ++i) {
        Curve curve{.name = planes.states[i].ground.name, .mark = Mark::line_and_points, .colour = int(i)};
        for (const sliding::WedgeTrial& trial : plane.trials) {
            const bool counts = trial.statuses[i] == sliding::ChainStatus::stands && std::isfinite(trial.factors[i]);
            curve.add(trial.angle / degree, counts ? trial.factors[i] : no_value);
        }
        chart.curves.push_back(std::move(curve));
        if (plane.factors[i].angle)
            chart.vertical.push_back({*plane.factors[i].angle / degree, "least, " + planes.states[i].ground.name});
    }
    return chart;
}

void draw_pressure(Sketch& sketch, const sliding::SeamModel& model, double size)
{
    double largest = 0.0, from = 0.0;
    for (const ProfilePoint& p : model.pressure.points) largest = std::max(largest, p.pressure);
    if (!(largest > 0.0)) return;
    for (std::size_t i = 0; i + 1 < model.path.size(); ++i) {
        const Point a = model.path[i], b = model.path[i + 1];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        const auto hang = [&](double s, double p) { // below the segment
            const double depth = 0.2 * size * p / largest, q = s / length;
            return Point{a.x + q * (b.x - a.x) + depth * (b.y - a.y) / length,
                         a.y + q * (b.y - a.y) - depth * (b.x - a.x) / length};
        };
        Polyline shape{a};
        for (const ProfilePoint& p : part(model.pressure, from, from + length))
            shape.push_back(hang(p.distance - from, p.pressure));
        shape.push_back(b);
        sketch.polygon(shape, "uplift");
        from += length;
    }
}

/// Blocks, water pressure along the path, weights and interface forces of a seam.
Drawing seam_drawing(const Scene& scene, const sliding::SeamPlane& plane)
{
    const sliding::SeamModel& model = plane.model;
    Point low{0.0, 0.0}, high{toe(scene.section).x, crest_level(scene.section)};
    const auto reach = [&](const Polyline& points) {
        for (const Point& p : points) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
    };
    reach(scene.section.polygon);
    reach(model.path);
    for (const Polyline& outline : model.outlines) reach(outline);
    const double size = std::max(high.x - low.x, high.y - low.y);
    Sketch sketch({low.x - 0.15 * size, low.y - 0.3 * size}, {high.x + 0.15 * size, high.y + 0.1 * size}, 760.0);
    if (scene.reservoir) {
        const double x = low.x - 0.15 * size, level = scene.reservoir->level;
        Polyline pool{{x, 0.0}};
        for (const Point& p : upstream_face(scene.section))
            if (p.y <= level) pool.push_back(p);
        pool.push_back({pool.back().x, level});
        pool.push_back({x, level});
        sketch.polygon(pool, "water");
    }
    for (const Polyline& outline : model.outlines)
        if (outline.size() > 2) sketch.polygon(outline, "silt");
    sketch.polygon(scene.section.polygon, "concrete");
    draw_pressure(sketch, model, size);
    sketch.line(model.path, "joint");
    double largest = 0.0;
    for (const sliding::ChainBlock& block : model.chain.blocks) largest = std::max(largest, block.mass * model.chain.gravity);
    for (std::size_t i = 0; i < model.chain.blocks.size(); ++i) {
        const double weight = model.chain.blocks[i].mass * model.chain.gravity;
        const Point c = model.centroids[i];
        sketch.arrow(c, {c.x, c.y - 0.2 * size * weight / largest}, "force");
        sketch.text(c, fmt::format("W {:.0f} kN/m", weight / kN), Align::start, 6, 0, "small halo");
    }
    for (std::size_t j = 0; j < model.feet.size() && j < model.tops.size(); ++j) {
        const Point foot = model.feet[j], top = model.tops[j];
        sketch.line({foot, top}, "joint");
        if (j >= plane.forces.thrust.size()) continue; // a locked chain has no yield
        const Point at{0.67 * foot.x + 0.33 * top.x, 0.67 * foot.y + 0.33 * top.y};
        sketch.arrow({at.x + 0.12 * size, at.y}, at, "force");
        sketch.text({at.x + 0.12 * size, at.y}, fmt::format("E {:.0f} kN/m", plane.forces.thrust[j] / kN), Align::start, 6, 4,
                    "small halo");
    }
    return {fmt::format("Seam {}", plane.name), sketch.svg("Blocks of the seam with water pressure and forces"),
            fmt::format("Forces at its yield, a_y = {:.4g} m/s²{}. Below the path: water pressure.", plane.yield,
                        plane.angle ? fmt::format(", wedge at α = {:.4g}°", *plane.angle / degree) : "")};
}

Table seam_factor_table(const Planes& planes)
{
    struct F {
        const sliding::SeamPlane& plane;
        std::string state;
        const sliding::SeamFactor& factor;
    };
    std::vector<F> rows;
    for (const sliding::SeamPlane& plane : planes.seams)
        for (std::size_t i = 0; i < plane.factors.size(); ++i)
            rows.push_back({plane, planes.states[i].ground.name, plane.factors[i]});
    return table_of<F>(
        "Seams",
        {{{"plane", "plane"}, [](const F& f) { return f.plane.name; }},
         {{"state", "state"}, &F::state},
         {{"factor", "F", "–", 5}, [](const F& f) { return finite_cell(f.factor.factor); }},
         {{"alpha_deg", "α", "°", 4}, [](const F& f) { return f.factor.angle; }, degree},
         {{"factor_smooth", "F smooth", "–", 5}, [](const F& f) { return finite_cell(f.factor.smooth); }},
         {{"factor_friction", "F Sarma", "–", 5}, [](const F& f) { return finite_cell(f.factor.friction); }},
         {{"factor_without_wedge", "F, no wedge", "–", 5},
          [](const F& f) { return finite_cell(f.factor.without_wedge); }},
         {{"holding_friction", "μ that holds", "–", 5},
          [](const F& f) { return finite_cell(f.plane.holding_friction); }},
         {{"valid_slip_m", "a_y + 5 % at", "m", 3}, [](const F& f) { return finite_cell(f.plane.valid_slip); }}},
        rows,
        {"F smooth: faces between blocks without friction (USACE); F Sarma: with that of seam.interface; no wedge: "
         "nothing before the body, as long as the slip that mobilises it is not granted.",
         "μ that holds: of the seam, without an earthquake; a_y + 5 % at: slip at which rock on the wedge has raised "
         "a_y by 5 %."});
}

Table work_table(const Planes& planes)
{
    using W = SeamWork;
    const auto of = [](double sliding::SeamLedger::*part) {
        return [part](const W& w) { return w.slide.ledger.*part / kN; };
    };
    const auto sum_of = [](const std::vector<double>& works, std::size_t from, std::size_t to) {
        double sum = 0.0;
        for (std::size_t i = from; i < to; ++i) sum += works[i];
        return from < to ? Cell(sum / kN) : Cell();
    };
    const auto of_seam = [&](const W& w) { return sum_of(w.slide.ledger.planes, 0, w.slide.body_blocks); };
    const auto of_wedge = [&](const W& w) {
        return sum_of(w.slide.ledger.planes, w.slide.body_blocks, w.slide.ledger.planes.size());
    };
    const auto of_faces = [&](const W& w) { return sum_of(w.slide.ledger.interfaces, 0, w.slide.ledger.interfaces.size()); };
    return table_of<W>(
        "Works",
        {{{"plane", "plane"}, &W::plane},
         {{"record", "record"}, &W::record},
         {{"polarity", "polarity"}, &W::polarity},
         {{"ground_kJ_m", "ground", "kJ/m", 5}, of(&sliding::SeamLedger::ground)},
         {{"loads_kJ_m", "loads", "kJ/m", 5}, of(&sliding::SeamLedger::loads)},
         {{"water_kJ_m", "water below", "kJ/m", 5}, of(&sliding::SeamLedger::water)},
         {{"weight_kJ_m", "weight", "kJ/m", 5}, of(&sliding::SeamLedger::weight)},
         {{"seam_kJ_m", "seam", "kJ/m", 5}, of_seam},
         {{"wedge_kJ_m", "wedge", "kJ/m", 5}, of_wedge},
         {{"interface_kJ_m", "interface", "kJ/m", 5}, of_faces},
         {{"impact_kJ_m", "impacts", "kJ/m", 5}, [](const W& w) { return -w.slide.ledger.impact / kN; }},
         {{"impacts", "number"}, [](const W& w) { return w.slide.impacts; }},
         {{"gap_mm", "widest gap", "mm", 4}, [](const W& w) { return w.slide.slide.max_gap / mm; }},
         {{"error_share", "what is left", "–", 2},
          [](const W& w) { return w.slide.ledger.error() / std::max(1.0, std::abs(w.slide.ledger.ground)); }}},
        planes.works,
        {"In the run of the largest slip, relative to the ground: what the ground's motion, static loads, water and "
         "weight do, less what the planes and impacts take; what is left over that of the ground."});
}

} // namespace

std::vector<Table> plane_tables(const Planes& planes, const Scene& scene, PlaneRows which)
{
    if (planes.rows.empty()) return {};
    std::vector<Table> tables{plane_table(planes, scene, which)};
    if (!planes.lifts.empty()) tables.push_back(lift_plane_table(planes));
    if (planes.seams.empty()) return tables;
    tables.push_back(seam_factor_table(planes));
    tables.push_back(block_table(planes));
    if (!planes.works.empty()) tables.push_back(work_table(planes));
    return tables;
}

Section plane_section(const Planes& planes, const Scene& scene)
{
    Section section{"Planes"};
    for (Table& table : plane_tables(planes, scene, PlaneRows::all)) section.parts.push_back(rows_part(std::move(table)));
    for (const sliding::SeamPlane& plane : planes.seams) {
        section.parts.push_back(seam_drawing(scene, plane));
        if (auto chart = wedge_chart(planes, plane)) section.parts.push_back(std::move(*chart));
    }
    if (!planes.lifts.empty())
        for (Part& chart : lift_charts(planes)) section.parts.push_back(std::move(chart));
    return section;
}

std::string factor_words(const PlaneRow& row, const std::vector<PlaneState>& states)
{
    const double least = margin(row, states);
    for (std::size_t i = 0; i < row.factors.size(); ++i)
        if (row.factors[i] && *row.factors[i] / states[i].required.value_or(1.0) == least)
            return fmt::format("F {:.4g}{} in {}", *row.factors[i],
                               states[i].required ? fmt::format(", required {:.4g}", *states[i].required) : "",
                               states[i].ground.name);
    return "F not known";
}

std::string planes_sentence(const Planes& planes)
{
    if (planes.rows.empty()) return "";
    const auto name = [&](std::size_t i) { return planes.rows[i].name; };
    std::string out = fmt::format(" Of {} planes {} governs by factor of safety ({}), {} by a_y ({:.3g} g)",
                                  planes.rows.size(), name(planes.by_factor),
                                  factor_words(planes.rows[planes.by_factor], planes.states), name(planes.by_yield),
                                  planes.rows[planes.by_yield].yield / standard_gravity);
    const std::optional<double> slip = slip_of(planes.rows[planes.by_slip]);
    if (!planes.rows.front().slips.empty())
        out += slip ? fmt::format(", {} by slip ({:.4g} mm)", name(planes.by_slip), *slip / mm)
                    : fmt::format(", {} by slip (none to give)", name(planes.by_slip));
    return out + ".";
}

Headline with_planes(Headline headline, const Planes& planes, const Scene& scene)
{
    if (planes.rows.empty()) return headline;
    // The largest slip comes first, whatever plane it is on.
    const PlaneRow& worst = planes.rows[planes.by_slip];
    const std::optional<double> slip = slip_of(worst);
    const std::string begin = "The dam slides ";
    std::string statically;
    for (const PlaneRow& row : planes.rows)
        if (row.kind != PlaneKind::base && row.yield <= 0.0) statically += (statically.empty() ? "" : ", ") + row.name;
    if (!statically.empty()) {
        if (headline.sentence.starts_with(begin)) headline.sentence = "On its base it slides " + headline.sentence.substr(begin.size());
        headline.sentence = fmt::format("The dam slides on {} without any earthquake. {}", statically, headline.sentence);
    } else if (worst.kind != PlaneKind::base && slip && headline.sentence.starts_with(begin))
        headline.sentence = fmt::format("The dam slides {:.4g} mm at most on {} (record {}, polarity {:+d}), by rigid "
                                        "blocks. On its base: {}",
                                        *slip / mm, worst.name, worst.worst()->record, worst.worst()->polarity,
                                        headline.sentence.substr(begin.size()));
    headline.sentence += planes_sentence(planes);
    std::string failed, open;
    for (const PlaneRow& row : planes.rows) {
        if (row.kind == PlaneKind::base) continue;
        const Verdict verdict = judge(row, planes, scene);
        std::string* list = verdict == Verdict::fail ? &failed : verdict == Verdict::undecided ? &open : nullptr;
        if (list) *list += (list->empty() ? "" : ", ") + row.name;
    }
    if (!failed.empty())
        return {headline.sentence, Outcome::fail,
                "FAIL on " + failed + (scene.planes.governs == PlaneJudgement::factor ? " by factor of safety" : "")};
    if (!open.empty() && headline.outcome == Outcome::pass)
        return {headline.sentence, Outcome::unresolved, "Undecided on " + open + ": its blocks are locked, or do not press on each other."};
    return headline;
}

} // namespace damslip::pages
