#include "pages/ablation/ablation_pages.hpp"

#include "pages/fe/fe_pages.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace damslip::pages {

namespace {

/// Pairs of nodes of every lift joint.
Table joint_table(const Explained& in)
{
    struct Row {
        const LiftJoint& joint;
        const fe2d::LiftPlane& contact;
    };
    std::vector<Row> rows;
    for (std::size_t i = 0; i < in.model->mesh.lifts.size(); ++i)
        rows.push_back({in.lift_joints[i], in.model->mesh.lifts[i]});
    return table_of<Row>("Lift joints",
                         {{{"joint", "joint"}, [](const Row& r) { return r.joint.name; }},
                          {{"elevation_m", "elevation", "m", 5}, [](const Row& r) { return r.joint.elevation; }},
                          {{"length_m", "length", "m", 5}, [](const Row& r) { return r.contact.distance.back(); }},
                          {{"pairs", "contact pairs"}, [](const Row& r) { return r.contact.upper_nodes.size(); }}},
                         rows);
}

Table part_table(const ContactCost& cost)
{
    using P = ContactCost::Part;
    return table_of<P>("Contact run",
                       {{{"part", "part"}, &P::name},
                        {{"unknowns", "unknowns"}, &P::unknowns},
                        {{"become", "become"}, [&](const P&) { return cost.contact_unknowns; }},
                        {{"made", "made"}, &P::made},
                        {{"bytes", "bytes"}, &P::bytes}},
                       cost.parts,
                       {"the contact problem's bytes are its matrix V, which the motion of the dam holds already."});
}

Table record_table(const ContactCost& cost)
{
    using R = ContactCost::OfRecord;
    return table_of<R>(
        "Estimate by record",
        {{{"record", "record"}, &R::record},
         {{"steps", "steps"}, &R::steps},
         {{"pass_seconds", "one pass", "s", 2}, &R::pass_seconds},
         {{"least_seconds", "run", "s", 2}, [](const R& r) { return 3 * r.pass_seconds; }}},
        cost.records,
        {"run: two passes, whole and half steps; each halving more that the slip asks for costs twice the "
         "one before."});
}

nlohmann::ordered_json cost_json(const ContactCost& cost)
{
    nlohmann::ordered_json j;
    j["parts"] = json_of(part_table(cost));
    j["factorisations"] = {{"set_up", cost.set_up_factorisations()}, {"by_step_size", 1}};
    j["set_up_seconds"] = cost.set_up_seconds;
    j["seconds_per_step"] = nullptr;
    if (cost.seconds_per_step) j["seconds_per_step"] = *cost.seconds_per_step;
    j["records"] = json_of(record_table(cost));
    return j;
}

std::string cost_text(const ContactCost& cost)
{
    const std::size_t made = cost.set_up_factorisations();
    std::string all = text(part_table(cost)) +
                      fmt::format("  {} factorisation{} in the set-up, one for each step size after it; no step "
                                  "factorises anew.\n  measured here: set-up {:.2g} s",
                                  made, made == 1 ? "" : "s", cost.set_up_seconds);
    all += cost.seconds_per_step ? fmt::format(", {:.2g} ms a step of strong shaking.\n", 1e3 * *cost.seconds_per_step)
                                 : ".\n";
    return cost.records.empty() ? all : all + "\n" + text(record_table(cost));
}

} // namespace

Answer explain_answer(const Explained& in)
{
    const auto& effects = in.plan.effects;
    const auto on = std::ranges::count(effects, true, &PlannedEffect::on);
    Answer all(json_header("explain", in.given, in.plan.scene_hash));
    all += in.given.title + "\n\n";
    all.set("method", in.method);
    all.add("effects", effect_table(in.plan));
    all.add("effects_on", effect_table(in.plan, true), {.text = false, .brief = true, .data = false});
    const std::string sentence =
        fmt::format("{} of {} effects on; the others are neither read, built nor stored.", on, effects.size());
    all += sentence + "\n\n";
    all.headline_in_brief({sentence});
    if (in.model) all.add("model", count_table(in.model->counts, in.water ? &*in.water : nullptr));
    if (in.model) all += "  tied base; `damslip fe` without --base tied keeps both sides of the contact plane.\n\n";
    if (in.model && !in.model->mesh.lifts.empty()) all.add("lift_joints", joint_table(in));
    if (in.cost) {
        all.set("contact", cost_json(*in.cost));
        all += cost_text(*in.cost);
    }
    if (in.cost && !in.cost->records.empty()) {
        double seconds = in.cost->set_up_seconds;
        for (const ContactCost::OfRecord& r : in.cost->records) seconds += 3 * r.pass_seconds;
        all.point("a run of damslip fe", fmt::format("{:.2g} s for each polarity, estimated", seconds));
    }
    if (!in.notes.empty()) all.set("notes", in.notes);
    for (const std::string& note : in.notes) all.note(note);
    return all;
}

} // namespace damslip::pages
