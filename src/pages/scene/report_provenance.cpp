#include "core/parallel.hpp"
#include "core/statistics.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "core/version.hpp"
#include "pages/scene/scene_pages.hpp"
#include "records/measure/measures.hpp"
#include "scene/rock_mass.hpp"
#include "scene/write.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace damslip::pages {

namespace {

std::string component_text(const Record& r)
{
    return fmt::format("{} ({}{}, {} samples, {:.4g} s), sha256 {}", r.source.file, r.source.format,
                       r.source.unit.empty() ? "" : ", " + r.source.unit, r.acceleration.size(), r.dt, r.source.sha256);
}

TitleBlock title_block(const Project& project)
{
    TitleBlock block;
    const auto entry = [&block](const char* name, const std::string& value) {
        if (!value.empty()) block.entries.emplace_back(name, value);
    };
    entry("project", project.name);
    entry("client", project.client);
    entry("date", project.date);
    entry("revision", project.revision);
    if (!project.author.empty()) block.signers.emplace_back("prepared by", project.author);
    if (!project.checker.empty()) block.signers.emplace_back("checked by", project.checker);
    block.notes = project.notes;
    return block;
}

} // namespace

nlohmann::ordered_json json_header(const std::string& what, const Scene& scene, const std::string& hash)
{
    nlohmann::ordered_json j = json_header(what);
    const std::string resolved = scene_hash(scene);
    j["scene"] = {{"title", scene.title},
                  {"file", scene.file.string()},
                  {"hash", hash.empty() ? resolved : hash},
                  {"resolved_hash", resolved}};
    return j;
}

Page begin_page(const Scene& scene, const std::string& about, const std::string& hash)
{
    const std::string words =
        ", scene " + (hash.empty() ? scene_hash(scene) : hash).substr(0, 12) + ", damslip " + program_version();
    const std::string file = scene.file.filename().string();
    Page page;
    page.title = scene.title.empty() ? file : scene.title;
    page.title_block = title_block(scene.project);
    page.footer = page.title + (scene.project.revision.empty() ? "" : ", revision " + scene.project.revision) + words;
    page.subtitle = about + file + words;
    return page;
}

Listing scene_listing(const Scene& scene)
{
    return {"The resolved scene, all defaults written out (TOML)", resolved_toml(scene)};
}

std::vector<std::pair<std::string, std::string>> scene_provenance(const Scene& scene, const std::string& hash)
{
    const std::string resolved = scene_hash(scene);
    std::vector<std::pair<std::string, std::string>> list{{"program", "damslip " + program_version()},
                                                          {"verification record", program_verification()},
                                                          {"scene", scene.file.string()},
                                                          {"scene hash", hash.empty() ? resolved : hash}};
    if (list.back().second != resolved) list.emplace_back("hash of the resolved scene", resolved);
    return list;
}

void add_record_provenance(const std::vector<RecordPair>& records,
                           std::vector<std::pair<std::string, std::string>>& list)
{
    for (const RecordPair& pair : records) {
        if (!pair.parts.empty()) {
            add_record_provenance(pair.parts, list);
            continue;
        }
        const std::string scaled = pair.files.scale == 1.0 ? "" : fmt::format(", times {:.6g}", pair.files.scale);
        list.emplace_back("record " + pair.files.name, component_text(pair.horizontal) + scaled);
        if (pair.vertical)
            list.emplace_back("record " + pair.files.name + ", vertical", component_text(*pair.vertical) + scaled);
    }
}

void end_page(const Scene& scene, const std::vector<RecordPair>& records, Page& page,
              const std::vector<std::pair<std::string, std::string>>& entries, const std::string& hash)
{
    page.sections.push_back({"Scene", {scene_listing(scene)}});
    page.provenance = scene_provenance(scene, hash);
    page.provenance.insert(page.provenance.end(), entries.begin(), entries.end());
    add_record_provenance(records, page.provenance);
}

std::vector<std::string> record_warnings(const std::vector<RecordPair>& records)
{
    std::vector<std::string> list;
    for (const RecordPair& pair : records) {
        if (!pair.parts.empty()) {
            for (std::string& warning : record_warnings(pair.parts)) list.push_back(std::move(warning));
            continue;
        }
        for (const Record* r : {&pair.horizontal, pair.vertical ? &*pair.vertical : nullptr})
            if (r)
                for (const std::string& w : r->warnings) list.push_back(pair.files.name + ": " + w);
    }
    return list;
}

namespace {

constexpr double kilonewton = 1e3; // [N]

const char* word(AnchorState state)
{
    return word_in(state, {{AnchorState::elastic, "elastic"},
                           {AnchorState::yields, "yields"},
                           {AnchorState::slack, "slack"},
                           {AnchorState::snapped, "SNAPPED"}});
}

} // namespace

Table anchor_list_table(const Scene& scene)
{
    struct Row {
        const Anchor& anchor;
        AnchorBar bar;
    };
    std::vector<Row> rows;
    for (const Anchor& anchor : scene.anchors) rows.push_back({anchor, anchor_bar(anchor, scene.contact.friction)});
    Table t = table_of<Row>(
        "Anchors, per metre of dam",
        {{{"anchor", "anchor"}, [](const Row& r) { return r.anchor.name; }},
         {{"joint", "through"}, [](const Row& r) { return r.anchor.joint.empty() ? "base" : r.anchor.joint; }},
         {{"distance_m", "from upstream end", "m", 4}, [](const Row& r) { return r.anchor.distance; }},
         {{"inclination_deg", "ψ", "°", 4}, [](const Row& r) { return r.anchor.inclination / units::degree; }},
         {{"free_length_m", "free length", "m", 4}, [](const Row& r) { return r.anchor.free_length; }},
         {{"prestress_kN_m", "P₀", "kN/m", 5}, [](const Row& r) { return r.anchor.prestress / kilonewton; }},
         {{"yield_force_kN_m", "N_y", "kN/m", 5}, [](const Row& r) { return r.bar.yield_force / kilonewton; }},
         {{"prestress_share", "P₀/N_y", "–", 3}, [](const Row& r) { return r.anchor.prestress / r.bar.yield_force; }},
         {{"slip_to_yield_mm", "slip to yield", "mm", 4},
          [](const Row& r) { return r.bar.slip_to_yield() / units::mm; }},
         {{"dowel_kN_m", "dowel", "kN/m", 4}, [](const Row& r) { return r.bar.dowel / kilonewton; }}},
        rows);
    if (!t.rows.empty())
        t.notes.push_back(
            "slip to yield: of a shut joint, from the prestress on, whichever way comes first; dowel: what it "
            "adds along the joint at most, without pull.");
    return t;
}

Table anchor_run_table(const std::vector<AnchorRow>& rows)
{
    using R = AnchorRow;
    Table t = table_of<R>(
        "Anchors in the earthquakes",
        {{{"record", "record"}, &R::record},
         {{"polarity", "polarity"}, &R::polarity},
         {{"anchor", "anchor"}, [](const R& r) { return r.anchor.name; }},
         {{"largest_force_kN_m", "largest N", "kN/m", 5},
          [](const R& r) { return r.anchor.history.largest_force / kilonewton; }},
         {{"largest_force_over_yield", "largest N/N_y", "–", 4},
          [](const R& r) { return r.anchor.history.largest_force / r.anchor.yield_force; }},
         {{"force_at_end_kN_m", "N at end", "kN/m", 5}, [](const R& r) { return r.anchor.history.force / kilonewton; }},
         {{"largest_stretch_mm", "largest stretch", "mm", 4},
          [](const R& r) { return r.anchor.history.largest_stretch / units::mm; }},
         {{"plastic_strain", "plastic strain", "–", 3}, [](const R& r) { return r.anchor.history.plastic_strain; }},
         {{"snapped_at_s", "snapped at", "s", 5}, [](const R& r) { return r.anchor.history.snapped_at; }},
         {{"state", "state"}, [](const R& r) { return word(r.anchor.history.state); }},
         {{"stored_J_m", "stored", "J/m", 4}, [](const R& r) { return r.anchor.stored; }},
         {{"plastic_J_m", "plastic work", "J/m", 4}, [](const R& r) { return r.anchor.history.plastic_work; }},
         {{"loss_J_m", "lost in rupture", "J/m", 4}, [](const R& r) { return r.anchor.history.loss; }}},
        rows);
    if (!t.rows.empty()) t.notes.push_back("stretch: since it was locked off; plastic work: yielding and dowel.");
    return t;
}

Table event_run_table(const std::vector<EventRow>& rows, const std::vector<ColumnOf<EventRow>>& more,
                      const std::string& note)
{
    using R = EventRow;
    std::vector<ColumnOf<R>> columns{{{"record", "sequence"}, &R::record},
                                     {{"polarity", "polarity"}, &R::polarity},
                                     {{"event", "event"}, [](const R& r) { return r.event.name; }},
                                     {{"start_s", "from", "s", 6}, [](const R& r) { return r.event.start; }},
                                     {{"end_s", "to", "s", 6}, [](const R& r) { return r.event.end; }},
                                     {{"slip_of_event_mm", "slip of it", "mm", 5},
                                      [](const R& r) { return reported(r.event.status, r.event.change); },
                                      units::mm},
                                     {{"slip_so_far_mm", "slip so far", "mm", 5},
                                      [](const R& r) { return reported(r.event.status, r.event.slip); },
                                      units::mm},
                                     {{"status", "status"}, [](const R& r) { return word(r.event.status); }}};
    columns.insert(columns.end(), more.begin(), more.end());
    return table_of("Slip by event", columns, rows, {note});
}

namespace {

constexpr std::size_t named_records = 6;

Record horizontal_record(const GroundMotion& motion)
{
    return {motion.name, motion.dt, motion.accel_h, {}, {}};
}

double peak(const std::vector<double>& a)
{
    double p = 0.0;
    for (const double x : a) p = std::max(p, std::abs(x));
    return p;
}

} // namespace

void thin_for(Chart& chart, std::size_t records, std::size_t all, std::size_t most)
{
    chart.thin_above = std::clamp<std::size_t>(all / std::max<std::size_t>(records, 1), 800, most);
    chart.thin_buckets = chart.thin_above / (2 * std::max<std::size_t>(chart.curves.size(), 1));
}

Chart spectra(const std::vector<GroundMotion>& motions, int jobs)
{
    const std::vector<double> periods = records::logarithmic_periods(0.03, 4.0, 48);
    std::vector<std::vector<double>> psa(motions.size(), std::vector<double>(periods.size()));
    // One task per record and period: long and short records share the threads evenly.
    parallel_for(motions.size() * periods.size(), jobs, [&](std::size_t task) {
        const std::size_t i = task / periods.size(), k = task % periods.size();
        const auto spectrum =
            records::response_spectrum(motions[i].accel_h, motions[i].dt, std::span(&periods[k], 1), 0.05);
        psa[i][k] = spectrum.points.front().pseudo_acceleration;
    });
    Chart chart{"Response spectra, 5 % damping, horizontal",
                {"period", "s", Scale::log},
                {.label = "pseudo-acceleration", .unit = "m/s²", .low = 0.0}};
    const bool named = motions.size() <= named_records;
    for (std::size_t i = 0; i < motions.size(); ++i)
        chart.curves.push_back({.name = motions[i].name,
                                .x = periods,
                                .y = psa[i],
                                .weight = named ? Weight::normal : Weight::faint,
                                .colour = named ? static_cast<int>(i) : 7});
    if (named) return chart;
    Curve median{.name = "median, band 16 to 84 %", .weight = Weight::strong, .colour = 0};
    for (std::size_t k = 0; k < periods.size(); ++k) {
        std::vector<double> values;
        for (const auto& row : psa) values.push_back(row[k]);
        median.add(periods[k], percentile(values, 0.5), percentile(values, 0.16), percentile(values, 0.84));
    }
    chart.curves.push_back(std::move(median));
    return chart;
}

Table record_table(const std::vector<GroundMotion>& motions)
{
    struct Row {
        const GroundMotion& motion;
        records::Measures m;
    };
    std::vector<Row> rows;
    for (const GroundMotion& motion : motions) rows.push_back({motion, records::measure(horizontal_record(motion))});
    const auto vertical_peak = [](const Row& r) {
        return r.motion.accel_v.empty() ? Cell() : Cell(peak(r.motion.accel_v));
    };
    return table_of<Row>(
        "Records as scaled",
        {{{"record", "record"}, [](const Row& r) { return r.motion.name; }},
         {{"duration_s", "duration", "s", 4}, [](const Row& r) { return r.m.duration; }},
         {{"pga_m_s2", "PGA", "m/s²", 4}, [](const Row& r) { return r.m.pga; }},
         {{"pga_vertical_m_s2", "PGA vertical", "m/s²", 4}, vertical_peak},
         {{"pgv_m_s", "PGV", "m/s", 4}, [](const Row& r) { return r.m.pgv; }},
         {{"arias_intensity_m_s", "Arias intensity", "m/s", 4}, [](const Row& r) { return r.m.arias_intensity; }},
         {{"duration_5_95_s", "D5-95", "s", 4}, [](const Row& r) { return r.m.duration_5_95; }},
         {{"mean_period_s", "mean period", "s", 4}, [](const Row& r) { return r.m.mean_period; }}},
        rows);
}

Section records_section(const std::vector<GroundMotion>& motions, int jobs)
{
    return {"Records", {record_part(record_table(motions)), spectra(motions, jobs)}};
}

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

namespace {

/// "key = value   # what it is", with "ASSUMED" where nobody gave it.
std::string line(const std::string& key, double value, bool given, const std::string& meaning)
{
    return fmt::format("{:<26} # {}{}\n", key + " = " + shortest(value), given ? "" : "ASSUMED, check: ", meaning);
}

std::string line(const std::string& key, const std::optional<double>& given, double otherwise,
                 const std::string& meaning)
{
    return line(key, given.value_or(otherwise), given.has_value(), meaning);
}

/// To the half metre.
double rounded(double metres)
{
    return std::max(0.5, std::round(2.0 * metres) / 2.0);
}

/// As a string of TOML.
std::string quoted(const std::string& text)
{
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

std::string records_of(const SceneTemplate& dam)
{
    if (dam.records.empty())
        return "# Accelerograms: AT2, CSV, ESM, COSMOS, SMC, K-NET and more (docs/records.md); one [[motion.record]] "
               "for each.\n"
               "# [[motion.record]]\n"
               "# horizontal = \"record_h.AT2\"\n"
               "# vertical = \"record_v.AT2\"     # leave out where there is none\n";
    std::string out;
    for (std::size_t i = 0; i < dam.records.size(); ++i) {
        out += (i ? "\n[[motion.record]]\nhorizontal = " : "[[motion.record]]\nhorizontal = ") +
               quoted(dam.records[i].string()) + "\n";
        if (i < dam.verticals.size()) out += "vertical = " + quoted(dam.verticals[i].string()) + "\n";
    }
    return out;
}

} // namespace

std::string scene_text(const SceneTemplate& dam)
{
    const double base = dam.base.value_or(rounded(0.8 * dam.height)),
                 crest = dam.crest.value_or(rounded(0.1 * dam.height));
    std::string out =
        "# A gravity dam on rock. The heel is the origin, x points downstream, y up; lengths in metres.\n"
        "# Lines with ASSUMED are guesses that stand for your own numbers. All keys: docs/scene-keys.md.\n"
        "#\n"
        "# run:  damslip screen THIS      limit equilibrium, regressions and the rigid block, in a second\n"
        "#       damslip fe THIS          finite elements with contact, both polarities\n"
        "#       damslip draw THIS        the section as SVG\n";
    out += "title = " + quoted(dam.title) +
           "\n\n# Title block of the reports; take the # away and fill in.\n"
           "# [project]\n"
           "# name = \"Safety review\"\n"
           "# client = \"Owner of the dam\"\n"
           "# author = \"Name of the engineer\"\n"
           "# checker = \"Name of the checker\"\n"
           "# date = \"2026-01-31\"\n"
           "# revision = \"A\"\n"
           "\n[section]\n";
    out += line("height_m", dam.height, true, "from the base to the crest");
    out += line("base_m", dam.base, base, "length of the base, heel to toe");
    out += line("crest_m", dam.crest, crest, "width of the crest; polygon_m takes any other section");
    out += "\n[dam]\n";
    out += line("density_kg_m3", 2400, false, "concrete");
    out += line("young_modulus_GPa", 25, false, "finite elements only; static to dynamic: see docs/user-guide.md");
    out += line("poisson_ratio", 0.2, false, "of the concrete");
    out += "\n[foundation]\n";
    out += line("young_modulus_GPa", 25, false, "rock; delete the table for a rigid base");
    out += line("poisson_ratio", 0.25, false, "of the rock");
    out += line("width_m", std::round(5.0 * dam.height), false, "of the box for statics and seepage");
    out += line("depth_m", std::round(1.5 * dam.height), false, "the same");
    out += "\n[reservoir]\n";
    out += line("level_m", dam.level, rounded(0.95 * dam.height), "of the water above the heel");
    out += "\n[uplift]\n";
    out += "model = \"linear\"           # ASSUMED, check: from the full head at the heel to the tailwater at the toe, "
           "no drains\n";
    out += "\n[contact]\n";
    out += line("friction", dam.friction, 0.8, "of the base, Coulomb's mu; cohesion_kPa only where tests show it");
    out += "\n[criteria]\n";
    out += line("allowable_slip_mm", dam.allowable, 50, "the verdict is against this");
    return out + "\n" + records_of(dam);
}

} // namespace damslip::pages
