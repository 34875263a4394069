#include "cli/contact_run.hpp"

#include "analysis/fe/contact_runs.hpp"
#include "analysis/prepare/contact_law.hpp"
#include "analysis/prepare/rock_warnings.hpp"
#include "cli/terminal/terminal_watch.hpp"
#include "core/file.hpp"
#include "core/version.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "pages/fe/acoustic_modes.hpp"
#include "pages/fe/contact_tables.hpp"
#include "pages/fe/fe_output.hpp"
#include "pages/fe/fe_report.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/page_html.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/effect_table.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

using namespace pages;

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
        if (r.fe.status != Status::at_rest) messages.push_back(r.label() + ": " + r.fe.message);
    return messages;
}

/// CSV files of one run, and its fields.
void write_run(const std::filesystem::path& folder, const Scene& scene, const ContactRun& r)
{
    const auto write = [&](const std::string& kind, const Table& table, const std::string& legend = {}) {
        std::vector<std::string> comments{"damslip " + program_version() + " fe", "scene " + scene_hash(scene),
                                          "record " + r.label(), "status " + word(r.fe.status)};
        if (!legend.empty()) comments.push_back(legend);
        write_file(folder / (kind + "_" + file_word(r.record) + r.suffix() + ".csv"), pages::csv(table, comments));
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

/// What is kept of one run beside its figures: tables, and fields at the end.
void keep(const std::filesystem::path& folder, const Scene& scene, const fe2d::EarthquakeRun& model,
          const ContactRun& r, FieldSeries& fields)
{
    if (!folder.empty()) write_run(folder, scene, r);
    if (r.fe.displacement.size() == 0) return;
    Eigen::VectorXd elastic = r.fe.displacement; // gravity's part carries stress where it does not count as motion
    if (r.fe.zero_displacement.size() > 0) elastic += r.fe.zero_displacement;
    fields.add(r.record + r.suffix() + "_end", r.fe.end_time, r.fe.displacement, elastic,
               contact_arrays(model.model().mesh, r.fe));
}

} // namespace

int run_contact(const FeArguments& arguments, const Ready& ready, const Streams& streams)
{
    const Scene& scene = ready.scene;
    const EffectPlan& plan = ready.plan;
    const std::vector<RecordPair>& records = ready.records();
    const std::optional<double>& allowable = scene.criteria.allowable_slip;
    TerminalWatch watch(streams);
    ContactRuns all(ready, fe_options(arguments), watch);
    const fe2d::EarthquakeRun& model = all.model();

    FieldSeries fields(arguments.out, model.model());
    std::optional<FeReport> page;
    if (!arguments.out.empty()) page.emplace(FeReport::Input{scene, plan, records, model, all.rigid(), all.uplift()});
    std::vector<std::string> of_rock;
    const std::vector<ContactRun> runs = all.run([&](ContactRun& r, const GroundMotion& motion) {
        for (const std::string& warning : rock_warnings(scene, model.model().mesh, motion))
            if (std::string note = r.record + ": " + warning; of_rock.empty() || of_rock.back() != note)
                of_rock.push_back(std::move(note));
        keep(arguments.out, scene, model, r, fields);
        if (page) page->add(r, motion);
        r.fe.history.by_pair = {};
        r.fe.history.states = {};
    });
    const Table run_table = contact_run_table(runs, allowable);
    const pages::Headline headline = fe_headline(scene, runs);
    const Table counts = count_table(model.model().counts, model.water() ? &model.water()->water : nullptr);
    auto j = json_header("fe");
    j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(scene)}};
    j["base"] = "contact";
    j["effects"] = json_of(effect_table(plan));
    j["model"] = json_of(counts);
    j["contact_pairs"] = model.structure().pairs();
    j["damping"] = {{"mass_coefficient_1_s", model.damping().mass},
                    {"stiffness_coefficient_s", model.damping().stiffness}};
    j["headline"] = headline.sentence;
    j["verdict"] = word(verdict_of(runs, allowable));
    j["worst"] = worst_json(runs, allowable);
    j["stages"] = json_of(contact_stage_table(runs));
    j["runs"] = json_of(run_table);
    j["slip"] = json_of(contact_slip_table(runs));
    if (!scene.lift_joints.empty()) j["lift_joints"] = json_of(contact_lift_table(runs, allowable));
    j["counts"] = json_of(contact_count_table(runs));
    j["energy"] = json_of(contact_energy_table(runs));
    if (all.gives_way()) j["contact_law"] = json_of(contact_law_table(runs));
    j["messages"] = run_messages(scene, runs, of_rock);
    if (streams.form == Form::json)
        streams.out << j.dump(2) << "\n";
    else {
        streams.out << scene.title << "\n\n"
                    << pages::text(counts)
                    << fmt::format("  {} contact pairs; damping a_M = {:.5g} 1/s, b_K = {:.5g} s\n\n",
                                   model.structure().pairs(), model.damping().mass, model.damping().stiffness)
                    << pages::text(contact_stage_table(runs)) << "\n"
                    << pages::text(answer_part(run_table)) << "\n"
                    << pages::text(solution_part(run_table)) << "\n"
                    << pages::text(contact_slip_table(runs));
        if (!scene.lift_joints.empty()) streams.out << "\n" << pages::text(contact_lift_table(runs, allowable));
        if (all.gives_way()) streams.out << "\n" << pages::text(contact_law_table(runs));
        streams.out << "\n" << headline_text(headline);
        for (const std::string& message : run_messages(scene, runs, of_rock))
            streams.out << "note: " << message << "\n";
    }
    finish_output(arguments.out, scene, j.dump(2) + "\n", fields);
    say_written(arguments.out, streams);
    if (page) {
        std::vector<Table> tables{contact_energy_table(runs), contact_count_table(runs)};
        if (all.gives_way()) tables.insert(tables.begin(), contact_law_table(runs));
        const std::filesystem::path file = arguments.out / "report.html";
        write_file(file, pages::page_html(page->page(runs, tables, run_messages(scene, runs, of_rock))));
        if (!streams.quiet) streams.talk << "report: " << file.string() << "\n";
    }
    const bool whole = runs.size() == all.whole();
    return whole ? exit_code_of(runs) : exit_no_answer;
}

} // namespace damslip::cli
