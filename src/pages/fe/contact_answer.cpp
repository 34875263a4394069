// The answer of contact runs: one JSON object, text, and the files of each run.
#include "pages/fe/fe_report.hpp"

#include "analysis/prepare/contact_law.hpp"
#include "core/file.hpp"
#include "core/version.hpp"
#include "fe2d/run/self_excited.hpp"
#include "pages/fe/base_water.hpp"
#include "pages/fe/rock_lines.hpp"
#include "pages/fe/water_notes.hpp"
#include "pages/report/table_text.hpp"
#include "scene/exact_contact.hpp"
#include "scene/joint_bond.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace damslip::pages {

namespace {

/// CSV files of one run, and its fields.
void write_run(const std::filesystem::path& folder, const FeReport::Input& in, const ContactRun& r)
{
    const auto write = [&](const std::string& kind, const Table& table, const std::string& legend = {}) {
        std::vector<std::string> comments{"damslip " + program_version() + " fe", "scene " + in.plan.scene_hash,
                                          "record " + r.label(), "status " + word(r.fe.status)};
        if (!legend.empty()) comments.push_back(legend);
        write_file(folder / (run_file(kind, in.scene, r.record, r.suffix()) + ".csv"), csv(table, comments));
    };
    const std::string letters = "states: s sticks, d slips downstream, u slips upstream, o open, p pulled",
                      signs = "pressure: effective, compression positive; shear: on the dam, positive where it resists "
                              "downstream slip; slip positive downstream";
    write("history", contact_history_table(r.fe.history));
    write("base", base_table(r.fe), signs);
    write("contact", pair_table(r.fe), signs + "; " + letters);
    write("states", state_map(r.fe.history), letters);
}

/// Values of the pairs on the dam's contact nodes, zero elsewhere.
std::vector<fe2d::VtuArray> contact_arrays(const fe2d::Mesh& mesh, const fe2d::RunResult& r)
{
    const auto on_nodes = [&](const std::string& name, const Eigen::VectorXd& values) {
        Eigen::MatrixXd at = Eigen::MatrixXd::Zero(1, static_cast<Eigen::Index>(mesh.nodes.size()));
        for (Eigen::Index i = 0; i < values.size(); ++i)
            at(0, mesh.contact.dam_nodes[static_cast<std::size_t>(i)]) = values[i];
        return fe2d::VtuArray{name, at};
    };
    return {on_nodes("contact_pressure_Pa", r.pair_pressure), on_nodes("contact_shear_Pa", r.pair_shear),
            on_nodes("contact_slip_m", r.pair_slip), on_nodes("contact_opening_m", r.pair_opening)};
}

} // namespace

void keep_contact_run(const std::filesystem::path& folder, const FeReport::Input& in, const ContactRun& r,
                      FieldSeries& fields)
{
    if (!folder.empty()) write_run(folder, in, r);
    if (r.fe.displacement.size() == 0) return;
    Eigen::VectorXd elastic = r.fe.displacement; // gravity's part carries stress where it does not count as motion
    if (r.fe.zero_displacement.size() > 0) elastic += r.fe.zero_displacement;
    fields.add(r.record + r.suffix() + "_end", r.fe.end_time, r.fe.displacement, elastic,
               contact_arrays(in.model.model().mesh, r.fe));
}

std::vector<std::string> base_notes(const Scene& scene)
{
    std::vector<std::string> notes;
    if (const std::optional<std::string> note = base_note(scene)) notes.push_back(*note);
    for (std::string& note : note_texts(scene.notes)) notes.push_back(std::move(note));
    return notes;
}

std::vector<std::string> run_sentences(const std::vector<ContactRun>& runs)
{
    const auto by_itself = [](const ContactRun& r) { return r.fe.status == Status::self_excited; };
    const auto first = std::find_if(runs.begin(), runs.end(), by_itself);
    const ContactRun* told = first == runs.end() ? nullptr : by_itself(worst_of(runs)) ? &worst_of(runs) : &*first;
    std::vector<std::string> sentences;
    for (const ContactRun& r : runs)
        sentences.push_back(by_itself(r) && &r != told
                                ? fmt::format("Self-excited, too: slid at least {:.4g} mm.", 1e3 * std::abs(r.fe.slip))
                                : r.fe.message);
    return sentences;
}

void add_run_messages(const std::vector<ContactRun>& runs, std::vector<std::string>& messages)
{
    const std::vector<std::string> sentences = run_sentences(runs);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const ContactRun& r = runs[i];
        if (r.fe.status != Status::at_rest) messages.push_back(r.label() + ": " + sentences[i]);
        if (has_slip(r) && r.fe.run_out.walked())
            messages.push_back(r.label() + ": " + fe2d::walked_sentence(r.fe.slip, r.fe.run_out));
        for (const AnchorOutcome& anchor : r.fe.anchors)
            if (anchor.history.snapped_at)
                messages.push_back(
                    fmt::format("{}: {} snapped at {:.4g} s.", r.label(), anchor.name, *anchor.history.snapped_at));
    }
}

std::vector<std::string> contact_messages(const Scene& scene, const std::vector<ContactRun>& runs,
                                          const std::vector<std::string>& of_rock)
{
    std::vector<std::string> messages = base_notes(scene);
    for (std::string& note : contact_law_notes(scene)) messages.push_back(std::move(note));
    messages.insert(messages.end(), of_rock.begin(), of_rock.end());
    if (scene.reservoir && scene.reservoir->model == ReservoirModel::acoustic)
        for (std::string& warning : reservoir_warnings(scene, 20.0)) messages.push_back(std::move(warning));
    for (std::string& note : base_water_notes(scene, runs)) messages.push_back(std::move(note));
    add_run_messages(runs, messages);
    return messages;
}

std::vector<std::string> bond_messages(const Scene& scene, const fe2d::Mesh& mesh)
{
    std::vector<std::string> messages;
    for (std::size_t k = scene.mesh.file ? 0 : 1; k <= mesh.lifts.size(); ++k) {
        const bool base = k == 0;
        const LiftJoint* lift = base ? nullptr : &scene.lift_joints[k - 1];
        const Contact& strength = base ? scene.contact : lift->strength;
        const fe2d::NodeChain& nodes = base ? mesh.contact.dam_nodes : mesh.lifts[k - 1].upper_nodes;
        const auto modulus = joint_modulus(scene, base);
        if (!modulus || !breaks_by_energy(strength) || nodes.size() < 2) continue;
        const Point &from = mesh.nodes[static_cast<std::size_t>(nodes.front())],
                    &to = mesh.nodes[static_cast<std::size_t>(nodes.back())];
        const double length = std::hypot(to.x - from.x, to.y - from.y) / static_cast<double>(nodes.size() - 1);
        const CarriedBond carried = carried_bond(strength, *modulus, length);
        if (!carried.lowered) continue;
        messages.push_back(fmt::format(
            "{}: elements of {:.3g} m are longer than a quarter of the bond's process zone; FE runs with tensile "
            "strength {:.4g} kPa and cohesion {:.4g} kPa, fracture energies kept. Elements of at most {:.3g} m carry the "
            "whole bond (E' G/(4 f^2), Bazant & Oh 1983): {}.",
            base                 ? std::string("base")
            : lift->name.empty() ? fmt::format("lift joint {}", k)
                                 : lift->name,
            length, 1e-3 * carried.tensile_strength, 1e-3 * carried.cohesion, bond_element_length(strength, *modulus),
            scene.mesh.file ? "give a finer mesh" : "give a mesh.size_m of about that"));
    }
    return messages;
}

FeAnswer contact_answer(const FeReport::Input& in, const std::vector<ContactRun>& runs,
                        const std::vector<std::string>& messages, const std::string& spread)
{
    const std::optional<double>& allowable = in.scene.criteria.allowable_slip;
    const fe2d::RayleighConstants& damping = in.model.damping();
    const Eigen::Index pairs = in.model.structure().pairs();
    const Table stages = contact_stage_table(runs), table = contact_run_table(runs, allowable),
                slips = contact_slip_table(runs), run_out = run_out_table(runs),
                lifts = contact_lift_table(runs, allowable), law = contact_law_table(runs);
    const bool has_lifts = !in.scene.lift_joints.empty(), gives_way = with_exact_contact(in.scene).has_value();
    const Headline headline = fe_headline(in.scene, runs, in.combinations);

    FeAnswer answer = begin_fe_answer(FeKind::contact, contact_frame(in));
    auto& j = answer.json;
    j["contact_pairs"] = pairs;
    j["damping"] = {{"mass_coefficient_1_s", damping.mass}, {"stiffness_coefficient_s", damping.stiffness}};
    j["rock"] = rock_json(in.scene, in.model);
    add_verdict(headline, runs, allowable, answer);
    j["stages"] = json_of(stages);
    j["runs"] = json_of(table);
    j["slip"] = json_of(slips);
    const Table events = contact_event_table(runs);
    if (!events.rows.empty()) j["events"] = json_of(events);
    j["run_out"] = json_of(run_out);
    if (has_lifts) j["lift_joints"] = json_of(lifts);
    const Table anchors = contact_anchor_table(runs);
    if (!in.scene.anchors.empty()) j["anchors"] = json_of(anchors);
    j["counts"] = json_of(contact_count_table(runs));
    j["energy"] = json_of(contact_energy_table(runs));
    const Table water = base_water_table(in.scene, runs), flow = joint_flow_table(runs);
    if (!water.rows.empty()) j["base_water"] = json_of(water);
    if (!flow.rows.empty()) j["joint_flow"] = json_of(flow);
    if (gives_way) j["contact_law"] = json_of(law);

    std::vector<Table> shown{stages, answer_part(table), solution_part(table), slips, run_out};
    if (!events.rows.empty()) shown.insert(shown.begin() + 2, events);
    if (has_lifts) shown.push_back(lifts);
    if (!in.scene.anchors.empty()) shown.push_back(anchors);
    if (!water.rows.empty()) shown.push_back(water);
    if (!flow.rows.empty()) shown.push_back(flow);
    if (gives_way) shown.push_back(law);
    answer.text += fmt::format("  {} contact pairs; damping a_M = {:.5g} 1/s, b_K = {:.5g} s\n  {}\n\n", pairs,
                               damping.mass, damping.stiffness, rock_line(in.scene, in.model)) +
                   texts(shown) + "\n" + headline_text(headline) + (spread.empty() ? "" : spread + "\n");
    j["model_spread"] = spread;
    end_fe_answer(messages, answer);
    return answer;
}

} // namespace damslip::pages
