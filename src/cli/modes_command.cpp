#include "cli/modes_command.hpp"

#include "analysis/prepare/ready.hpp"
#include "core/file.hpp"
#include "core/usage_error.hpp"
#include "core/version.hpp"
#include "fe2d/damping/modified_rayleigh.hpp"
#include "fe2d/damping/rayleigh.hpp"
#include "fe2d/modes/natural_modes.hpp"
#include "fe2d/time/coupled_structure.hpp"
#include "pages/fe/acoustic_modes.hpp"
#include "pages/fe/fe_output.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/table_text.hpp"
#include "records/measure/response_spectrum.hpp"
#include "scene/plausible.hpp"
#include "scene/rock_mass.hpp"
#include "scene/write.hpp"
#include "sliding/loads/added_mass.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <ostream>

namespace damslip::cli {

using namespace pages;

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
/// @param total_mass  in x [kg/m]
DampingTable damping_table(const Scene& scene, double total_mass, const fe2d::NaturalModes& modes,
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
        options.total_mass = total_mass;
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

/// Everything a scene's modes are: of the dam with added mass, or of dam and water.
struct ModesAnswer {
    Table frequencies;
    fe2d::NaturalModes modes; ///< shapes only where there is no acoustic water
    double total_mass = 0.0;  ///< in x [kg/m]
    bool complete = true;
};

ModesAnswer added_mass_modes(const fe2d::Model& model, int count, std::vector<std::string>& notes)
{
    ModesAnswer answer;
    answer.modes = fe2d::natural_modes(model, count);
    if (answer.modes.status != fe2d::ModesStatus::ok)
        notes.push_back(
            fmt::format("only {} of {} modes: {}", answer.modes.frequency.size(), count, answer.modes.solver.text()));
    answer.frequencies = frequency_table(answer.modes);
    answer.total_mass = model.total_mass.x();
    answer.complete = answer.modes.status == fe2d::ModesStatus::ok || answer.modes.status == fe2d::ModesStatus::no_mass;
    return answer;
}

constexpr double coupled_modes_to = 20.0; ///< [Hz]

ModesAnswer acoustic_modes(const Scene& scene, const fe2d::Model& model, const fe2d::FluidModel& water,
                           std::vector<std::string>& notes)
{
    const int leading_count = std::max({5, scene.damping.first_mode, scene.damping.second_mode});
    const fe2d::CoupledModes coupled =
        fe2d::coupled_modes_up_to(fe2d::coupled_pencil(model, water), coupled_modes_to, leading_count);
    ModesAnswer answer;
    answer.complete = coupled.status == fe2d::CoupledModesStatus::ok;
    if (!answer.complete) notes.push_back("not all coupled modes were found: " + coupled.solver.text());
    const std::vector<Eigen::Index> leading = fe2d::leading_modes(coupled, leading_count);
    answer.frequencies = coupled_mode_table(coupled, leading);
    answer.modes = as_natural_modes(coupled, leading);
    answer.total_mass = coupled.total_mass.x();
    notes.push_back(water_counts(water));
    for (std::string& warning : reservoir_warnings(scene, coupled_modes_to)) notes.push_back(std::move(warning));
    return answer;
}

/// Damped by the Rayleigh constants of the table's first row.
Table transfer_of(const Scene& scene, const fe2d::Model& model, const fe2d::FluidModel* water,
                  const fe2d::NaturalModes& modes)
{
    fe2d::RayleighConstants damping{};
    if (scene.damping.method != DampingMethod::none && modes.frequency.size() > 0 && scene.damping.ratio > 0) {
        const auto omega = [&](int mode) {
            return 2 * std::numbers::pi * modes.frequency[std::min<Eigen::Index>(mode, modes.frequency.size()) - 1];
        };
        damping = fe2d::rayleigh_constants(scene.damping.ratio, omega(scene.damping.first_mode),
                                           omega(scene.damping.second_mode));
    }
    std::vector<double> frequencies;
    for (int k = 1; k <= 200; ++k) frequencies.push_back(0.1 * k);
    return transfer_table(fe2d::transfer_functions(model, fe2d::structure_system(model, damping), water, frequencies),
                          water != nullptr);
}

} // namespace

int modes(const ModesArguments& arguments, const Streams& streams)
{
    const Scene given = read_run_scene(arguments.inputs, streams);
    need_section(given, "damslip modes", "a wedge is rigid; damslip screen SCENE gives its slip");
    const Ready ready = prepare(given, Method::finite_elements, {.stop = streams.stop});
    const Scene& scene = ready.scene;
    std::vector<std::string> notes = note_texts(given.notes);
    if (ready.reservoir) notes.push_back(ready.reservoir->reason);
    const bool acoustic =
        scene.reservoir && scene.reservoir->model == ReservoirModel::acoustic && scene.reservoir->level > 0;
    if (const auto& period = ready.dam_period)
        notes.push_back(fmt::format("added_mass.period_s = \"dam\": T = {:.6g} s, f_1 = {:.5g} Hz (incompressible "
                                    "water: {:.5g} Hz), {} solutions",
                                    1 / period->frequency, period->frequency, period->incompressible_frequency,
                                    period->iterations));
    const fe2d::Model model = fe2d::build_model(with_massless_rock(scene), ready.model_options());
    if (rock_has_mass(scene))
        notes.push_back(
            "foundation.mass = \"with-mass\": modes are those of the dam on massless rock, from which Rayleigh's "
            "constants come too; rock with mass has the modes of its box, or, where waves leave, none");
    std::optional<fe2d::FluidModel> water;
    if (acoustic) water = fe2d::build_fluid(scene);
    const ModesAnswer answer =
        water ? acoustic_modes(scene, model, *water, notes) : added_mass_modes(model, arguments.count, notes);
    if (scene.reservoir && answer.modes.frequency.size() && !ready.reservoir && !acoustic)
        notes.push_back(criterion_sentence(scene, answer.modes.frequency[0]));
    DampingTable damping = damping_table(scene, answer.total_mass, answer.modes, ready.records());
    notes.insert(notes.end(), damping.warnings.begin(), damping.warnings.end());
    std::optional<Table> transfer;
    if (arguments.frequency_response) transfer = transfer_of(scene, model, water ? &*water : nullptr, answer.modes);

    if (streams.form == Form::json) {
        auto j = json_header("modes");
        j["scene"] = {{"title", scene.title}, {"file", scene.file.string()}, {"hash", scene_hash(given)}};
        j["modes"] = json_of(answer.frequencies);
        j["damping"] = json_of(damping.table);
        if (transfer) j["transfer_functions"] = json_of(*transfer);
        j["model"] = json_of(count_table(model.counts, water ? &*water : nullptr));
        j["notes"] = notes;
        streams.out << j.dump(2) << "\n";
    } else {
        streams.out << scene.title << "\n\n"
                    << pages::text(answer.frequencies) << "\n"
                    << pages::text(damping.table) << "\n"
                    << pages::text(count_table(model.counts, water ? &*water : nullptr));
        if (transfer) streams.out << "\n" << pages::text(*transfer);
        for (const std::string& note : notes) streams.out << "note: " << note << "\n";
    }
    if (!arguments.out.empty()) {
        if (!water) write_shapes(arguments.out, model, answer.modes);
        if (transfer)
            write_file(
                arguments.out / "transfer_functions.csv",
                pages::csv(*transfer, {"damslip " + program_version() + " modes --frf", "scene " + scene_hash(given)}));
    }
    return answer.complete ? exit_ok : exit_no_answer;
}

} // namespace damslip::cli
