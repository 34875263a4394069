#include "cli/modes_command.hpp"

#include "cli/fe_inputs.hpp"
#include "cli/fe_output.hpp"
#include "cli/usage_error.hpp"
#include "fe2d/damping/modified_rayleigh.hpp"
#include "fe2d/damping/rayleigh.hpp"
#include "fe2d/modes/natural_modes.hpp"
#include "records/measure/response_spectrum.hpp"
#include "report/table_text.hpp"
#include "scene/write.hpp"
#include "sliding/loads/added_mass.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ostream>

namespace damslip::cli {

namespace {

Table frequency_table(const fe2d::NaturalModes& modes)
{
    Table t;
    t.title = "Natural modes (tied base)";
    t.columns = {{"mode", "mode", "", 4},
                 {"frequency_Hz", "frequency", "Hz", 5},
                 {"period_s", "period", "s", 5},
                 {"effective_mass_x_kg_m", "mass x", "kg/m", 5},
                 {"share_x_percent", "share x", "%", 4},
                 {"cumulative_x_percent", "sum x", "%", 4},
                 {"effective_mass_y_kg_m", "mass y", "kg/m", 5},
                 {"share_y_percent", "share y", "%", 4},
                 {"cumulative_y_percent", "sum y", "%", 4}};
    double sum_x = 0, sum_y = 0;
    for (Eigen::Index i = 0; i < modes.frequency.size(); ++i) {
        sum_x += modes.effective_share(0, i);
        sum_y += modes.effective_share(1, i);
        t.rows.push_back({static_cast<std::int64_t>(i + 1), modes.frequency[i], 1 / modes.frequency[i],
                          modes.effective_mass(0, i), 100 * modes.effective_share(0, i), 100 * sum_x,
                          modes.effective_mass(1, i), 100 * modes.effective_share(1, i), 100 * sum_y});
    }
    t.notes.push_back(
        "shares of everything that moves in that direction, added mass included; massless rock adds no modes.");
    return t;
}

struct DampingTable {
    Table table;
    std::vector<std::string> warnings;
};

/// Rayleigh on the scene's two modes and, where there is a record, modified Rayleigh.
DampingTable damping_table(const Scene& scene, const fe2d::Model& model, const fe2d::NaturalModes& modes,
                           const std::vector<RecordPair>& records)
{
    DampingTable out;
    Table& t = out.table;
    t.title = fmt::format("Damping, {:.3g} %", 100 * scene.damping.ratio);
    t.columns = {{"method", "method", "", 4},
                 {"mass_coefficient_1_s", "a_M", "1/s", 5},
                 {"stiffness_coefficient_s", "b_K", "s", 5},
                 {"first_frequency_Hz", "f_i", "Hz", 5},
                 {"second_frequency_Hz", "f_j", "Hz", 5},
                 {"remark", "remark", "", 4}};
    const Eigen::Index n = modes.frequency.size();
    if (n == 0 || scene.damping.ratio <= 0) return out;
    const auto index = [n](int mode) { return std::min<Eigen::Index>(mode - 1, n - 1); };
    const double two_pi = 2 * std::numbers::pi;
    const double w_i = two_pi * modes.frequency[index(scene.damping.first_mode)],
                 w_j = two_pi * modes.frequency[index(scene.damping.second_mode)];
    const fe2d::RayleighConstants r = fe2d::rayleigh_constants(scene.damping.ratio, w_i, w_j);
    t.rows.push_back(
        {std::string("Rayleigh"), r.mass, r.stiffness, w_i / two_pi, w_j / two_pi,
         fmt::format("modes {} and {}", index(scene.damping.first_mode) + 1, index(scene.damping.second_mode) + 1)});
    for (const RecordPair& pair : records) {
        const GroundMotion motion = ground_motion(scene, pair);
        std::vector<fe2d::ModalMass> masses;
        for (Eigen::Index i = 0; i < n; ++i)
            masses.push_back({two_pi * modes.frequency[i], modes.effective_mass(0, i)});
        fe2d::ModifiedRayleighOptions options;
        options.ratio = scene.damping.ratio;
        options.first_mode = static_cast<std::size_t>(index(scene.damping.first_mode));
        options.ordinary_mode = static_cast<std::size_t>(index(scene.damping.second_mode));
        options.total_mass = model.total_mass.x();
        const fe2d::ModifiedRayleigh m = fe2d::modified_rayleigh(
            masses,
            [&](double w, double ratio) {
                return records::peak_absolute_acceleration(motion.accel_h, motion.dt, w / two_pi, ratio);
            },
            options);
        const bool found = m.status == fe2d::ModifiedRayleighStatus::found;
        t.rows.push_back(
            {"modified Rayleigh, " + pair.files.name, m.constants.mass, m.constants.stiffness, w_i / two_pi,
             found ? Cell(m.second_frequency / two_pi) : Cell(),
             fmt::format(
                 "{} of {:.0f} % of the mass{}",
                 found ? fmt::format("{} sign change{}", m.sign_changes.size(), m.sign_changes.size() == 1 ? "" : "s")
                       : "no solution: ordinary Rayleigh",
                 100 * m.mass_share, found ? "" : fmt::format(", |ΔS| {:.2g}", m.relative_imbalance))});
        for (const std::string& w : m.warnings) out.warnings.push_back(pair.files.name + ": " + w);
    }
    return out;
}

void write_shapes(const std::filesystem::path& folder, const fe2d::Model& model, const fe2d::NaturalModes& modes)
{
    for (Eigen::Index i = 0; i < modes.frequency.size(); ++i)
        fe2d::write_vtu(folder / fmt::format("mode_{:02d}.vtu", i + 1), model.mesh,
                        {{"shape", node_vectors(model.dofs, modes.shape.col(i))}}, {});
}

std::string criterion_sentence(const Scene& scene, double frequency)
{
    const sliding::CompressibilityCriterion c = sliding::compressibility_criterion(
        {scene.reservoir->level, scene.reservoir->density, scene.reservoir->bulk_modulus}, frequency);
    return fmt::format(
        "compressibility (3-36): Omega_r = {:.3g} {} 2, so compressible water {} (acoustic reservoir{}).",
        c.frequency_ratio, c.compressible_matters ? "<" : ">=", c.compressible_matters ? "matters" : "does not matter",
        c.compressible_matters ? "" : " not needed");
}

} // namespace

int modes(const ModesArguments& arguments, const Streams& streams)
{
    const Scene given = read_run_scene(arguments.inputs);
    const EffectPlan plan = make_effect_plan(given, Method::finite_elements);
    Scene scene = called_for(plan, given);
    std::vector<std::string> notes;
    if (scene.added_mass.period_of_dam && plan.on(Effect::hydrodynamic_mass)) {
        const DamPeriod period = resolve_dam_period(scene);
        notes.push_back(fmt::format("added_mass.period_s = \"dam\": T = {:.6g} s, f_1 = {:.5g} Hz (incompressible "
                                    "water: {:.5g} Hz), {} solutions",
                                    1 / period.frequency, period.frequency, period.incompressible_frequency,
                                    period.iterations));
    }
    fe2d::ModelOptions options;
    options.added_mass = added_mass_law(scene);
    const fe2d::Model model = fe2d::build_model(scene, options);
    const fe2d::NaturalModes modes = fe2d::natural_modes(model, arguments.count);
    if (modes.status != fe2d::ModesStatus::ok)
        notes.push_back(
            fmt::format("only {} of {} modes: {}", modes.frequency.size(), arguments.count, modes.solver.text()));
    if (scene.reservoir && modes.frequency.size()) notes.push_back(criterion_sentence(scene, modes.frequency[0]));
    DampingTable damping = damping_table(scene, model, modes, read_records(scene, plan));
    notes.insert(notes.end(), damping.warnings.begin(), damping.warnings.end());

    if (streams.form == Form::json) {
        auto j = json_header("modes");
        j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(given)}};
        j["modes"] = json_of(frequency_table(modes));
        j["damping"] = json_of(damping.table);
        j["model"] = json_of(count_table(model.counts));
        j["notes"] = notes;
        streams.out << j.dump(2) << "\n";
    } else {
        streams.out << scene.title << "\n\n"
                    << report::text(frequency_table(modes)) << "\n"
                    << report::text(damping.table) << "\n"
                    << report::text(count_table(model.counts));
        for (const std::string& note : notes) streams.out << "note: " << note << "\n";
    }
    if (!arguments.out.empty()) write_shapes(arguments.out, model, modes);
    return modes.status == fe2d::ModesStatus::ok || modes.status == fe2d::ModesStatus::no_mass ? exit_ok
                                                                                               : exit_no_convergence;
}

} // namespace damslip::cli
