#include "cli/contact_run.hpp"

#include "cli/run/contact_law.hpp"
#include "cli/run/contact_options.hpp"
#include "cli/run/fe_inputs.hpp"
#include "cli/run/rigid_model.hpp"
#include "cli/run/rock_warnings.hpp"
#include "cli/run/seepage_source.hpp"
#include "cli/show/acoustic_modes.hpp"
#include "cli/show/contact_tables.hpp"
#include "cli/show/effect_table.hpp"
#include "cli/show/fe_output.hpp"
#include "cli/show/fe_report.hpp"
#include "cli/terminal/interrupt.hpp"
#include "cli/terminal/progress.hpp"
#include "cli/terminal/usage_error.hpp"
#include "core/file.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "report/page_html.hpp"
#include "report/table_text.hpp"
#include "scene/exact_contact.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

namespace {

std::vector<std::string> run_messages(const Scene& scene, const std::vector<ContactRun>& runs,
                                      const std::vector<std::string>& of_rock)
{
    std::vector<std::string> messages = note_texts(scene.notes);
    for (std::string& note : contact_law_notes(scene)) messages.push_back(std::move(note));
    messages.insert(messages.end(), of_rock.begin(), of_rock.end());
    if (scene.reservoir && scene.reservoir->model == ReservoirModel::acoustic)
        for (std::string& warning : reservoir_warnings(scene, 20.0)) messages.push_back(std::move(warning));
    for (const ContactRun& r : runs)
        if (r.fe.status != Status::at_rest) messages.push_back(r.record + ": " + r.fe.message);
    return messages;
}

/// CSV files of one run, and its fields.
void write_run(const std::filesystem::path& folder, const Scene& scene, const ContactRun& r)
{
    const auto write = [&](const std::string& kind, const Table& table, const std::string& legend = {}) {
        std::vector<std::string> comments{"damslip " + program_version() + " fe", "scene " + scene_hash(scene),
                                          "record " + r.record};
        if (!legend.empty()) comments.push_back(legend);
        write_file(folder / (kind + "_" + file_word(r.record) + ".csv"), report::csv(table, comments));
    };
    const std::string letters = "states: s sticks, d slips downstream, u slips upstream, o open, p pulled";
    write("history", contact_history_table(r.fe.history));
    write("base", base_table(r.fe));
    write("contact", pair_table(r.fe), letters);
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

int run_contact(const FeArguments& arguments, const Scene& scene, const EffectPlan& plan,
                const std::vector<RecordPair>& records, const Streams& streams)
{
    SeepageSource seepage;
    const InterruptGuard interrupt;
    fe2d::RunOptions options = contact_options(scene, records, seepage);
    if (!arguments.out.empty()) options.pair_series = fe2d::PairSeries::every_step;
    Progress progress(streams, "fe", 1000 * records.size());
    double before = 0.0; // records done
    options.progress = [&](const fe2d::RunProgress& p) {
        const double share = static_cast<double>(p.step) / static_cast<double>(std::max<std::int64_t>(1, p.steps));
        progress.at(1000 * (before + share));
        return interrupt.interrupted() ? fe2d::RunAnswer::stop : fe2d::RunAnswer::go_on;
    };
    options.stop = streams.stop;
    progress.phase("set-up");
    const fe2d::EarthquakeRun model(scene, options);
    const std::optional<Scene> exact_scene = with_exact_contact(scene);
    std::optional<fe2d::EarthquakeRun> exact;
    if (exact_scene) {
        options.pair_series = fe2d::PairSeries::none;
        options.progress = [&](const fe2d::RunProgress&) {
            return interrupt.interrupted() ? fe2d::RunAnswer::stop : fe2d::RunAnswer::go_on;
        };
        exact.emplace(*exact_scene, options);
    }
    const RigidModel rigid = make_rigid_model(scene, seepage.profile_of(scene));

    FieldSeries fields(arguments.out, model.model());
    std::optional<FeReport> page;
    if (!arguments.out.empty()) page.emplace(FeReport::Input{scene, plan, records, model, rigid, options.uplift});
    std::vector<ContactRun> runs;
    std::vector<std::string> of_rock;
    for (const RecordPair& pair : records) {
        if (interrupt.interrupted()) break;
        const GroundMotion motion = ground_motion(scene, pair, 1.0, arguments.polarity.value_or(1));
        runs.push_back({pair.files.name, model.run(motion), std::nullopt, std::nullopt});
        ContactRun& r = runs.back();
        interrupt.results_at_hand();
        for (const std::string& warning : rock_warnings(scene, model.model().mesh, motion))
            of_rock.push_back(r.record + ": " + warning);
        if (exact && !interrupt.interrupted()) r.exact = exact->run(motion);
        if (rigid.state == sliding::StaticState::at_rest) r.rigid = slide_model(scene, rigid, motion, 1);
        if (!arguments.out.empty()) write_run(arguments.out, scene, r);
        if (r.fe.displacement.size()) {
            Eigen::VectorXd elastic =
                r.fe.displacement; // gravity's part carries stress where it does not count as motion
            if (r.fe.zero_displacement.size() > 0) elastic += r.fe.zero_displacement;
            fields.add(r.record + "_end", r.fe.end_time, r.fe.displacement, elastic,
                       contact_arrays(model.model().mesh, r.fe));
        }
        if (page) page->add(r, motion);
        r.fe.history.by_pair = {};
        r.fe.history.states = {};
        progress.at(1000 * ++before);
    }
    const Table counts = count_table(model.model().counts, model.water() ? &model.water()->water : nullptr);
    auto j = json_header("fe");
    j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(scene)}};
    j["base"] = "contact";
    j["effects"] = json_of(effect_table(plan));
    j["model"] = json_of(counts);
    j["contact_pairs"] = model.structure().pairs();
    j["damping"] = {{"mass_coefficient_1_s", model.damping().mass},
                    {"stiffness_coefficient_s", model.damping().stiffness}};
    j["stages"] = json_of(contact_stage_table(runs));
    j["runs"] = json_of(contact_run_table(runs));
    j["slip"] = json_of(contact_slip_table(runs));
    if (!scene.lift_joints.empty()) j["lift_joints"] = json_of(contact_lift_table(runs));
    j["counts"] = json_of(contact_count_table(runs));
    j["energy"] = json_of(contact_energy_table(runs));
    if (exact) j["contact_law"] = json_of(contact_law_table(runs));
    j["messages"] = run_messages(scene, runs, of_rock);
    if (streams.form == Form::json)
        streams.out << j.dump(2) << "\n";
    else {
        streams.out << scene.title << "\n\n"
                    << report::text(counts)
                    << fmt::format("  {} contact pairs; damping a_M = {:.5g} 1/s, b_K = {:.5g} s\n\n",
                                   model.structure().pairs(), model.damping().mass, model.damping().stiffness)
                    << report::text(contact_stage_table(runs)) << "\n"
                    << report::text(contact_run_table(runs)) << "\n"
                    << report::text(contact_slip_table(runs));
        if (!scene.lift_joints.empty()) streams.out << "\n" << report::text(contact_lift_table(runs));
        if (exact) streams.out << "\n" << report::text(contact_law_table(runs));
        for (const std::string& message : run_messages(scene, runs, of_rock))
            streams.out << "note: " << message << "\n";
    }
    finish_output(arguments.out, scene, j.dump(2) + "\n", fields, streams);
    if (page) {
        std::vector<Table> tables{contact_energy_table(runs), contact_count_table(runs)};
        if (exact) tables.insert(tables.begin(), contact_law_table(runs));
        const std::filesystem::path file = arguments.out / "report.html";
        write_file(file, report::page_html(page->page(runs, tables, run_messages(scene, runs, of_rock))));
        if (!streams.quiet) streams.talk << "report: " << file.string() << "\n";
    }
    const auto converged = [](const ContactRun& r) { return is_answer(r.fe.status); };
    return runs.size() == records.size() && std::all_of(runs.begin(), runs.end(), converged) ? exit_ok
                                                                                             : exit_no_answer;
}

} // namespace damslip::cli
