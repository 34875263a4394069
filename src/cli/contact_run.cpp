#include "cli/contact_run.hpp"

#include "cli/explain_command.hpp"
#include "cli/fe_inputs.hpp"
#include "cli/fe_output.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/rigid_model.hpp"
#include "cli/seepage_source.hpp"
#include "cli/usage_error.hpp"
#include "core/file.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "fe2d/time/structure_system.hpp"
#include "report/table_text.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ostream>

namespace damslip::cli {

namespace {

struct ContactRun {
    std::string record;
    fe2d::RunResult fe;
    std::optional<sliding::SlideResult> rigid; ///< none where the block slides statically
};

std::string word(fe2d::RunStatus status)
{
    switch (status) {
    case fe2d::RunStatus::at_rest:
        return "at rest";
    case fe2d::RunStatus::sliding_at_end:
        return "sliding at end";
    case fe2d::RunStatus::static_failure:
        return "static failure";
    case fe2d::RunStatus::unresolved:
        return "UNRESOLVED";
    case fe2d::RunStatus::diverged:
        return "DIVERGED";
    case fe2d::RunStatus::model_failed:
        return "MODEL FAILED";
    }
    return "";
}

/// Pressure along the base for the FE joint, x = distance [m], y = pressure [Pa].
Polyline uplift_polyline(const Scene& scene, const sliding::UpliftState& state, const sliding::SeepageProfile& seepage)
{
    Polyline profile;
    if (!scene.uplift) return profile;
    for (const sliding::ProfilePoint& p : sliding::uplift_profile(scene, state, {}, seepage).points)
        profile.push_back({p.distance, p.pressure});
    return profile;
}

Table stage_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Static stages";
    t.columns = {{"record", "record", "", 4},
                 {"stage", "stage", "", 4},
                 {"status", "status", "", 4},
                 {"normal_force_kN_m", "N'", "kN/m", 6},
                 {"shear_force_kN_m", "T", "kN/m", 6},
                 {"friction_needed", "critical μ", "–", 6},
                 {"sliding_factor", "FS sliding", "–", 4},
                 {"slip_mm", "slip", "mm", 4},
                 {"open_length_m", "open", "m", 4},
                 {"slipping_length_m", "slipping", "m", 4}};
    const auto status = [](fe2d::StageStatus s) -> std::string {
        switch (s) {
        case fe2d::StageStatus::ok:
            return "stands";
        case fe2d::StageStatus::slides:
            return "SLIDES";
        case fe2d::StageStatus::floats:
            return "FLOATS";
        case fe2d::StageStatus::overturns:
            return "OVERTURNS";
        case fe2d::StageStatus::not_resolved:
            return "NOT RESOLVED";
        }
        return "";
    };
    const auto add = [&](const std::string& record, const fe2d::StageResult& s) {
        t.rows.push_back({record, s.name, status(s.status), s.resultant.normal_force / 1e3,
                          s.resultant.shear_force / 1e3, s.friction_needed, s.sliding_factor, 1e3 * s.slip,
                          s.open_length, s.slipping_length});
    };
    if (!runs.empty())
        for (const fe2d::StageResult& s : runs.front().fe.stages) add("all", s);
    for (const ContactRun& r : runs)
        if (!r.fe.after.name.empty()) add(r.record, r.fe.after);
    t.notes.push_back("after the earthquake: residual friction, ruptured curtain, ineffective drains; slip since the "
                      "start of the stages.");
    return t;
}

Table run_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Earthquake runs, exact contact";
    t.columns = {{"record", "record", "", 4},
                 {"status", "status", "", 4},
                 {"slip_mm", "slip FE", "mm", 5},
                 {"slip_error_mm", "± step", "mm", 2},
                 {"max_slip_m", "largest slip", "m", 5},
                 {"slip_rigid_mm", "slip rigid", "mm", 5},
                 {"steps", "steps", "", 4},
                 {"dt_s", "step", "s", 4},
                 {"unresolved", "unresolved", "", 4},
                 {"residual", "residual", "–", 2},
                 {"energy_error", "energy", "–", 2},
                 {"seconds", "time", "s", 3}};
    for (const ContactRun& r : runs) {
        const auto& s = r.fe.seconds;
        t.rows.push_back({r.record, word(r.fe.status), 1e3 * r.fe.slip, 1e3 * r.fe.slip_error, r.fe.max_slip,
                          r.rigid ? Cell(1e3 * r.rigid->slip) : Cell(), static_cast<std::int64_t>(r.fe.counts.steps),
                          r.fe.dt, static_cast<std::int64_t>(r.fe.counts.unresolved), r.fe.counts.largest_residual,
                          r.fe.energy_error, s.statics + s.dynamics});
    }
    t.notes.push_back("slip: area mean over the base at the end, since the static state, positive downstream; ± step: "
                      "what the time step leaves open (estimate).");
    t.notes.push_back("residual: largest complementarity residual over N'; energy: imbalance at the end over the "
                      "largest term; time without the shared set-up.");
    return t;
}

Table history_table(const fe2d::RunHistory& h)
{
    Table t;
    t.columns = {{"time_s", "time", "s", 6},
                 {"ground_accel_h_m_s2", "a_h", "m/s²", 5},
                 {"ground_accel_v_m_s2", "a_v", "m/s²", 5},
                 {"slip_m", "slip", "m", 6},
                 {"slip_heel_m", "slip, heel", "m", 6},
                 {"slip_toe_m", "slip, toe", "m", 6},
                 {"crest_x_m", "crest x", "m", 6},
                 {"normal_force_N_m", "N'", "N/m", 6},
                 {"shear_force_N_m", "T", "N/m", 6},
                 {"open_length_m", "open", "m", 4},
                 {"slipping_length_m", "slipping", "m", 4},
                 {"largest_opening_m", "opening", "m", 4},
                 {"kinetic_J_m", "kinetic", "J/m", 6},
                 {"strain_J_m", "strain", "J/m", 6},
                 {"damping_J_m", "damping", "J/m", 6},
                 {"numerical_J_m", "numerical", "J/m", 6},
                 {"friction_J_m", "friction", "J/m", 6},
                 {"external_J_m", "external", "J/m", 6},
                 {"contact_normal_J_m", "contact normal", "J/m", 6},
                 {"imbalance_J_m", "imbalance", "J/m", 4}};
    for (std::size_t i = 0; i < h.time.size(); ++i) {
        const fe2d::Energy& e = h.energy[i];
        t.rows.push_back({h.time[i],
                          h.ground_h[i],
                          h.ground_v[i],
                          h.slip[i],
                          h.slip_heel[i],
                          h.slip_toe[i],
                          h.crest_x[i],
                          h.normal_force[i],
                          h.shear_force[i],
                          h.open_length[i],
                          h.slipping_length[i],
                          h.largest_opening[i],
                          e.kinetic,
                          e.strain,
                          e.damping,
                          e.numerical,
                          e.friction,
                          e.external,
                          e.contact_normal,
                          h.imbalance[i]});
    }
    return t;
}

/// Pressure, shear, slip and opening of the pairs at the end.
Table base_table(const fe2d::RunResult& r)
{
    Table t;
    t.columns = {{"distance_m", "distance", "m", 5},
                 {"area_m", "length", "m", 5},
                 {"pressure_Pa", "effective pressure", "Pa", 6},
                 {"shear_Pa", "shear", "Pa", 6},
                 {"slip_m", "slip", "m", 6},
                 {"opening_m", "opening", "m", 6}};
    for (Eigen::Index i = 0; i < r.pair_slip.size(); ++i)
        t.rows.push_back({r.pair_distance[i], r.pair_area[i], r.pair_pressure[i], r.pair_shear[i], r.pair_slip[i],
                          r.pair_opening[i]});
    return t;
}

std::vector<std::string> run_messages(const std::vector<ContactRun>& runs)
{
    std::vector<std::string> messages;
    for (const ContactRun& r : runs)
        if (r.fe.status != fe2d::RunStatus::at_rest) messages.push_back(r.record + ": " + r.fe.message);
    return messages;
}

} // namespace

int run_contact(const FeArguments& arguments, const Scene& scene, const EffectPlan& plan,
                const std::vector<RecordPair>& records, const Streams& streams)
{
    SeepageSource seepage;
    const InterruptGuard interrupt;
    fe2d::RunOptions options;
    options.added_mass = added_mass_law(scene);
    sliding::UpliftState water = sliding::scene_uplift_state(scene);
    options.uplift = uplift_polyline(scene, water, seepage.profile_of(scene));
    water.drains = sliding::DrainState::ineffective; // after the earthquake
    water.curtain = sliding::CurtainState::damaged;
    options.uplift_after = uplift_polyline(scene, water, seepage.profile_of(scene));
    if (scene.damping.method == DampingMethod::modified_rayleigh &&
        !records.empty()) { // by the first record's horizontal component
        fe2d::ModelOptions tied;
        tied.added_mass = options.added_mass;
        options.damping =
            fe2d::damping_of(scene, fe2d::build_model(scene, tied), ground_motion(scene, records.front())).constants;
    }
    const fe2d::EarthquakeRun model(scene, options);
    const RigidModel rigid = make_rigid_model(scene, seepage.profile_of(scene));

    FieldSeries fields(arguments.out, model.model());
    std::vector<ContactRun> runs;
    Progress progress(streams, "fe", records.size());
    for (const RecordPair& pair : records) {
        if (interrupt.interrupted()) break;
        const GroundMotion motion = ground_motion(scene, pair, 1.0, arguments.polarity.value_or(1));
        runs.push_back({pair.files.name, model.run(motion), std::nullopt});
        ContactRun& r = runs.back();
        if (rigid.state == sliding::StaticState::at_rest) r.rigid = slide_model(scene, rigid, motion, 1);
        if (!arguments.out.empty()) {
            const std::vector<std::string> comments{"damslip " + program_version() + " fe",
                                                    "scene " + scene_hash(scene), "record " + r.record};
            write_file(arguments.out / ("history_" + file_word(r.record) + ".csv"),
                       report::csv(history_table(r.fe.history), comments));
            write_file(arguments.out / ("base_" + file_word(r.record) + ".csv"),
                       report::csv(base_table(r.fe), comments));
        }
        if (r.fe.displacement.size())
            fields.add(r.record + "_end", r.fe.end_time, r.fe.displacement, r.fe.displacement);
        progress.advance();
    }
    auto j = json_header("fe");
    j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(scene)}};
    j["base"] = "contact";
    j["effects"] = json_of(effect_table(plan));
    j["model"] = json_of(count_table(model.model().counts));
    j["contact_pairs"] = model.structure().plane().pairs();
    j["damping"] = {{"mass_coefficient_1_s", model.damping().mass},
                    {"stiffness_coefficient_s", model.damping().stiffness}};
    j["stages"] = json_of(stage_table(runs));
    j["runs"] = json_of(run_table(runs));
    j["messages"] = run_messages(runs);
    if (streams.form == Form::json)
        streams.out << j.dump(2) << "\n";
    else {
        streams.out << scene.title << "\n\n"
                    << report::text(count_table(model.model().counts))
                    << fmt::format("  {} contact pairs; damping a_M = {:.5g} 1/s, b_K = {:.5g} s\n\n",
                                   model.structure().plane().pairs(), model.damping().mass, model.damping().stiffness)
                    << report::text(stage_table(runs)) << "\n"
                    << report::text(run_table(runs));
        for (const std::string& message : run_messages(runs)) streams.out << "note: " << message << "\n";
    }
    finish_output(arguments.out, scene, j.dump(2) + "\n", fields, streams);
    const auto converged = [](const ContactRun& r) {
        return r.fe.status == fe2d::RunStatus::at_rest || r.fe.status == fe2d::RunStatus::sliding_at_end ||
               r.fe.status == fe2d::RunStatus::static_failure;
    };
    return runs.size() == records.size() && std::all_of(runs.begin(), runs.end(), converged) ? exit_ok
                                                                                             : exit_no_convergence;
}

} // namespace damslip::cli
