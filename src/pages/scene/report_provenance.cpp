#include "pages/scene/scene_pages.hpp"

#include "core/parallel.hpp"
#include "core/statistics.hpp"
#include "core/status.hpp"
#include "core/units.hpp"
#include "core/version.hpp"
#include "core/word_in.hpp"
#include "records/measure/measures.hpp"
#include "records/measure/response_spectrum.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

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

} // namespace damslip::pages
