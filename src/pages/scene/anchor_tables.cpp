#include "pages/scene/anchor_tables.hpp"

#include "core/units.hpp"

namespace damslip::pages {

namespace {

constexpr double kilonewton = 1e3; // [N]

std::string anchor_state_word(AnchorState state)
{
    switch (state) {
    case AnchorState::elastic:
        return "elastic";
    case AnchorState::yields:
        return "yields";
    case AnchorState::slack:
        return "slack";
    case AnchorState::snapped:
        return "SNAPPED";
    }
    return "";
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
         {{"snapped_at_s", "snapped at", "s", 5},
          [](const R& r) { return optional_cell(r.anchor.history.snapped_at); }},
         {{"state", "state"}, [](const R& r) { return anchor_state_word(r.anchor.history.state); }},
         {{"stored_J_m", "stored", "J/m", 4}, [](const R& r) { return r.anchor.stored; }},
         {{"plastic_J_m", "plastic work", "J/m", 4}, [](const R& r) { return r.anchor.history.plastic_work; }},
         {{"loss_J_m", "lost in rupture", "J/m", 4}, [](const R& r) { return r.anchor.history.loss; }}},
        rows);
    if (!t.rows.empty()) t.notes.push_back("stretch: since it was locked off; plastic work: yielding and dowel.");
    return t;
}

} // namespace damslip::pages
