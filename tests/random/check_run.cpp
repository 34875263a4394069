#include "random/check_run.hpp"

#include "cli/program.hpp"
#include "core/status.hpp"
#include "scene/mesh_sizes.hpp"
#include "scene/read.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace damslip::random {

// Every term of the ledger comes from the states, what is missing is round-off: in proportion to the terms, and where
// hardly anything moves, to the work of the weight over the last digits of the dam's displacements (largest_rounding).
const double energy_tolerance = 1e-6;

namespace {

using nlohmann::json;

struct Answer {
    int code = 0;
    std::string out, talk;
};

Answer answer_of(const std::vector<std::string>& arguments)
{
    std::ostringstream out, talk;
    const int code = cli::run_program(arguments, out, talk, false);
    return {code, out.str(), talk.str()};
}

class Checker {
public:
    explicit Checker(CheckedRuns& runs) : runs_(runs) {}

    template <class... Values>
    void demand(bool holds, fmt::format_string<Values...> text, Values&&... values)
    {
        if (!holds) runs_.findings.push_back(fmt::format(text, std::forward<Values>(values)...));
    }

private:
    CheckedRuns& runs_;
};

bool is_number(const json& row, const char* key)
{
    return row.contains(key) && row[key].is_number() && std::isfinite(row[key].get<double>());
}

void demand_numbers(Checker& check, const char* what, const json& row, std::initializer_list<const char*> keys)
{
    for (const char* key : keys) check.demand(is_number(row, key), "{}: {} is not a number", what, key);
}

/// What every answer has in common.
void check_answer(Checker& check, const char* command, const Answer& a)
{
    check.demand(a.code == 0 || a.code == 3 || a.code == 4, "{}: exit code {}: {}", command, a.code, a.talk);
    const json j = json::parse(a.out, nullptr, false);
    check.demand(!j.is_discarded(), "{}: the answer is not JSON", command);
    if (a.code != 3 || j.is_discarded()) return;
    const bool sentences = j.contains("error") && !j["error"]["diagnostics"].empty();
    check.demand(sentences, "{}: refused without a sentence", command);
    if (!sentences) return;
    for (const json& d : j["error"]["diagnostics"]) {
        check.demand(!d["file"].get<std::string>().empty(), "{}: no file named: {}", command, d["message"].dump());
        check.demand(!d["message"].get<std::string>().empty(), "{}: an empty sentence", command);
        check.demand(!d["fix"].get<std::string>().empty() || !d["expected"].get<std::string>().empty(),
                     "{}: neither what is allowed nor a fix: {}", command, d["message"].dump());
    }
}

/// The row's status; none, and a finding, for a word that is not in the list.
std::optional<Status> status_of(Checker& check, const char* command, const json& row)
{
    const std::optional<Status> status = status_of_word(row["status"].get<std::string>());
    check.demand(status.has_value(), "{}: unknown status {}", command, row["status"].get<std::string>());
    return status;
}

/// Slips are numbers where the status has a slip, and null where it has none.
void check_slips(Checker& check, const char* command, Status status, const json& row,
                 std::initializer_list<const char*> slips)
{
    if (status_row(status).slip != SlipMeaning::none) return demand_numbers(check, command, row, slips);
    for (const char* key : slips)
        check.demand(row.contains(key) && row[key].is_null(), "{}: {} = {} with status {}", command, key,
                     row.contains(key) ? row[key].dump() : "missing", word(status));
}

void check_screen(Checker& check, const json& j, int code)
{
    bool answered = true, all_slips = true;
    for (const json& row : j["displacements"]) {
        const std::optional<Status> status = status_of(check, "screen", row);
        if (!status) continue;
        const bool rocks = *status == Status::rocks_first && j.contains("rocking_block"); // which answers in its place
        answered = answered && (is_answer(*status) || rocks);
        all_slips = all_slips && is_number(row, "slip_h_mm"); // of the horizontal component alone, with its own status
        check_slips(check, "screen", *status, row, {"max_slip_m", "upstream_slip_mm"});
        check.demand(is_answer(*status) || row["verdict"].is_null() || (rocks && row["verdict"] == "judged by rocking"),
                     "screen: a verdict with status {}", word(*status));
        if (status_row(*status).slip == SlipMeaning::none) continue;
        demand_numbers(check, "screen", row, {"pga_m_s2"});
        if (!is_number(row, "max_slip_m")) continue;
        const char* key = is_number(row, "slip_hv_mm") ? "slip_hv_mm" : "slip_h_mm";
        if (!is_number(row, key)) continue;
        const double judged = row[key].get<double>();
        check.demand(std::abs(judged) <= 1e3 * row["max_slip_m"].get<double>() * (1 + 1e-12),
                     "screen: slip {} mm above the largest", judged);
        check.demand(row["upstream_slip_mm"].get<double>() >= 0, "screen: negative upstream slip");
    }
    for (const char* table : {"rocking_block", "elastic"})
        if (j.contains(table))
            for (const json& row : j[table])
                if (const auto status = status_of(check, "screen", row)) answered = answered && is_answer(*status);
    check.demand(answered || code == exit_no_answer, "screen: exit code {} with a run that is no answer", code);
    check.demand(!answered || !all_slips || code == exit_ok, "screen: exit code {} although all runs are answers",
                 code);
}

/// An answer comes from steps that were all resolved, and is as sure as the scene asks for.
void check_contact_row(Checker& check, const json& row, Status status, const Scene& scene)
{
    check_slips(check, "fe", status, row, {"slip_mm", "max_slip_m"});
    if (!is_answer(status) || status_row(status).slip == SlipMeaning::none) return;
    demand_numbers(check, "fe", row, {"steps", "dt_s", "residual", "energy_error"});
    check.demand(row["unresolved"] == 0, "fe: {} unresolved steps with status {}", row["unresolved"].dump(),
                 word(status));
    if (status == Status::at_rest && !scene.time.substeps && is_number(row, "slip_error_mm")) {
        const double wanted = scene.time.slip_tolerance * std::max(1e3 * row["max_slip_m"].get<double>(), 1e-3);
        check.demand(row["slip_error_mm"].get<double>() <= wanted * (1 + 1e-9),
                     "fe: at rest with ± {} mm of at most {} m", row["slip_error_mm"].get<double>(),
                     row["max_slip_m"].get<double>());
    }
    check.demand(row["residual"].get<double>() <= 1e-6, "fe: contact residual {} of N'", row["residual"].get<double>());
    check.demand(std::abs(row["slip_mm"].get<double>()) <= 1e3 * row["max_slip_m"].get<double>() * (1 + 1e-9) + 1e-12,
                 "fe: slip {} mm above the largest", row["slip_mm"].get<double>());
}

/// M/E: modulus of a body held at its sides over the one of a free bar [-].
double volume_share(const Material& m)
{
    const double nu = m.poisson_ratio;
    return (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
}

/// M dt² of the dam over the mass rho h² of an element: contact knows the dam's forces to the last digits times this and no
/// better [-].
double stiffness_of_step(const Scene& scene, double dt)
{
    const double size = scene.mesh.file ? std::sqrt(area(scene.section)) : mesh_sizes(scene).contact;
    const double element = scene.dam.density * std::min(area(scene.section), size * size);
    return scene.dam.young_modulus.value_or(0.0) * volume_share(scene.dam) * dt * dt / element;
}

/// What round-off may do in a run [J/m], the sum of
/// - the work of the weight W over 1e-12 of the dam's height,
/// - that of the stiffer body over the last digits of how far the weight presses the softer one down, W/E; its modulus is M,
///   for near nu = 0.5 what shear does is the small difference of the large forces of volume,
/// - drift: by the share of its forces that a step does not know the dam moves of g dt² a step.
double largest_rounding(const Scene& scene, double dt, double steps)
{
    const double last_digit = std::numeric_limits<double>::epsilon();
    double top = 0.0;
    for (const Point& p : scene.section.polygon) top = std::max(top, p.y);
    const double mass = scene.dam.density * area(scene.section), weight = mass * scene.gravity;
    const double soft_dam = scene.dam.young_modulus.value_or(0.0);
    const double soft_rock = scene.foundation ? scene.foundation->material.young_modulus.value_or(soft_dam) : soft_dam;
    const double dam = soft_dam * volume_share(scene.dam);
    const double rock = scene.foundation ? soft_rock * volume_share(scene.foundation->material) : dam;
    const double pressed = weight / std::min(soft_dam, soft_rock);
    return 1e-12 * weight * top + last_digit * std::max(dam, rock) * pressed * pressed +
           steps * weight * last_digit * stiffness_of_step(scene, dt) * scene.gravity * dt * dt;
}

/// Does the answer say that friction gave energy back?
bool says_friction_gave(const json& fe)
{
    return std::any_of(fe["messages"].begin(), fe["messages"].end(), [](const json& message) {
        return message.get<std::string>().find("Friction gave") != std::string::npos;
    });
}

/// Friction's work goes by the trapezoid: a step in which shear turns, or that a dam spends hopping, may give some back; more of
/// it has to be said, and only a fixed step may.
/// @param elastic  contact gives way before it slips, and its friction column holds what that stores and gives back
void check_energy(Checker& check, const json& fe, const Scene& scene, bool elastic)
{
    for (std::size_t k = 0; k < fe["energy"].size(); ++k) {
        const json &row = fe["energy"][k], &run = fe["runs"][k];
        const double rounding = largest_rounding(scene, run["dt_s"], run["steps"]);
        demand_numbers(
            check, "fe", row,
            {"kinetic_J_m", "strain_J_m", "friction_J_m", "external_J_m", "imbalance_J_m", "imbalance_share"});
        if (!is_number(row, "imbalance_J_m") || !is_number(row, "imbalance_share")) continue;
        const double missing = std::abs(row["imbalance_J_m"].get<double>()), share = row["imbalance_share"];
        // Of a dam that is all but rigid to its step the last digits are those of what moves it.
        const double last_digits =
            std::numeric_limits<double>::epsilon() * stiffness_of_step(scene, run["dt_s"].get<double>());
        const double stiff =
            std::max(volume_share(scene.dam), scene.foundation ? volume_share(scene.foundation->material) : 1.0);
        const double round_off = rounding + 1e-11 * stiff * row["strain_J_m"].get<double>();
        check.demand(share <= (elastic ? 1e-2 : std::max(energy_tolerance, last_digits)) || missing <= round_off,
                     "fe: {} J/m are missing, {} of the largest energy", missing, share);
        check.demand(elastic || (scene.time.substeps && says_friction_gave(fe)) ||
                         row["friction_J_m"].get<double>() >= -0.2 * missing / std::max(share, 1e-300) - rounding,
                     "fe: friction gave {} J/m back", -row["friction_J_m"].get<double>());
    }
}

/// Friction that holds the dam before the earthquake by the FE loads and by the rigid block's, where they mean the same:
/// no cohesion or bond, no crack, no ice (of the sliding computations only), no water in the rock, no anchors (whose force
/// follows the give of dam and rock).
void check_critical_friction(Checker& check, const Scene& scene, const json& screen, const json& fe)
{
    if (scene.contact.cohesion > 0 || scene.contact.bond.tensile_strength > 0 || !scene.anchors.empty() || scene.ice ||
        scene.stages.pore_pressure != PorePressure::none || (scene.uplift && scene.uplift->crack != CrackRule::none))
        return;
    json last;
    for (const json& stage : fe["stages"]) {
        if (stage["record"] != "all") continue;
        if (stage["status"] != "stands") return; // of base or lift joint: the loads that follow were never there
        if (stage["stage"].get<std::string>().find(',') == std::string::npos) last = stage;
    }
    const json& yield = screen["yield"][0];
    if (last.is_null() || !is_number(last, "friction_needed") || !is_number(yield, "critical_friction")) return;
    const double by_fe = last["friction_needed"], by_block = yield["critical_friction"];
    check.demand(std::abs(by_fe - by_block) <= 1e-6 * (1 + by_block),
                 "friction that holds: {} by FE, {} by the rigid block", by_fe, by_block);
}

/// A run again gives the same bytes, but for the seconds.
std::string without_seconds(const std::string& answer)
{
    std::istringstream in(answer);
    std::string kept;
    for (std::string line; std::getline(in, line);)
        if (line.find("seconds\":") == std::string::npos) kept += line + "\n";
    return kept;
}

} // namespace

CheckedRuns check_run(const std::filesystem::path& scene)
{
    CheckedRuns runs;
    Checker check(runs);
    const Answer screen = answer_of({"screen", scene.string(), "--json"});
    const Answer fe = answer_of({"fe", scene.string(), "--json"});
    runs.screen_code = screen.code;
    runs.fe_code = fe.code;
    check_answer(check, "screen", screen);
    check_answer(check, "fe", fe);
    if (!runs.findings.empty()) return runs;

    if (fe.code == 3) runs.refusal = json::parse(fe.out)["error"]["diagnostics"][0]["message"];
    const json screened = json::parse(screen.out), ran = json::parse(fe.out);
    if (screened.contains("displacements")) check_screen(check, screened, screen.code);
    if (fe.code == 0) check.demand(ran.contains("runs") && !ran["runs"].empty(), "fe: exit code 0 without a run");
    if (ran.contains("runs")) {
        const Scene read = read_scene(scene);
        StatusCount count;
        for (const json& row : ran["runs"]) {
            runs.status = row["status"];
            const std::optional<Status> status = status_of(check, "fe", row);
            if (!status) continue;
            count.add(*status);
            check_contact_row(check, row, *status, read);
        }
        const bool proper = count.exit_code() == exit_ok;
        const bool open_after = std::any_of(ran["stages"].begin(), ran["stages"].end(), [](const json& stage) {
            return stage["record"] != "all" && stage["status"] == "NOT RESOLVED";
        });
        const int code = open_after ? worse_exit_code(count.exit_code(), exit_no_answer) : count.exit_code();
        check.demand(fe.code == code, "fe: exit code {} with {}{}", fe.code, count.words(),
                     open_after ? ", the state after it not resolved" : "");
        const std::filesystem::path results = scene.parent_path() / "results"; // with all its files
        const Answer again = answer_of({"fe", scene.string(), "--json", "--out", results.string()});
        check.demand(without_seconds(again.out) == without_seconds(fe.out), "fe: other bytes when run again");
        check.demand(std::filesystem::exists(results / "summary.json"), "fe: no summary.json");
        if (proper)
            check_energy(check, ran, read,
                         read.contact.enforcement != ContactEnforcement::exact ||
                             read.contact.normal != NormalContact::hard);
        if (screened.contains("yield")) check_critical_friction(check, read, screened, ran);
    }
    return runs;
}

} // namespace damslip::random
