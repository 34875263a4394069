#include "analysis/fe/state_file.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/version.hpp"
#include "scene/anchor_bar.hpp"
#include "scene/joint_bond.hpp"
#include "scene/write.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace damslip {

namespace {

constexpr const char* format = "damslip joints 1";
const std::string letters = "sduop"; ///< of the states, in the order of ContactState

[[noreturn]] void not_a_state(const std::filesystem::path& file, const std::string& what)
{
    refuse(file, what, "a file that  damslip fe --state-out FILE  wrote", "make it again");
}

nlohmann::json list_of(const Eigen::VectorXd& values)
{
    return std::vector<double>(values.begin(), values.end());
}

Eigen::VectorXd vector_of(const std::filesystem::path& file, const nlohmann::json& j, const char* key, std::size_t size)
{
    const auto values = j.at(key).get<std::vector<double>>();
    if (values.size() != size)
        not_a_state(file, fmt::format("\"{}\" has {} values where {} belong.", key, values.size(), size));
    if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
        not_a_state(file, fmt::format("\"{}\" has a value that is not finite.", key));
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(size));
}

/// What a scene has that the file does not hold; empty: nothing.
std::string more_than_the_file(const Scene& scene)
{
    const Contact& c = scene.contact;
    if (c.enforcement != ContactEnforcement::exact || c.normal != NormalContact::hard) return "contact that gives way";
    if (c.sliding == JointPath::finite) return "contact.sliding = \"finite\"";
    return {};
}

/// Names and sizes of the numbers that the laws of a scene's joints keep. @param pairs  of all joints
std::vector<std::pair<const char*, std::size_t>> numbers_of_laws(const Scene& scene, std::size_t pairs)
{
    std::vector<std::pair<const char*, std::size_t>> all;
    const bool lifts_break = std::any_of(scene.lift_joints.begin(), scene.lift_joints.end(),
                                         [](const LiftJoint& joint) { return breaks_by_energy(joint.strength); });
    if (breaks_by_energy(scene.contact) || lifts_break)
        all.insert(all.end(), {{"bond_damage", pairs},
                               {"bond_reference_m", pairs},
                               {"bond_path_m", pairs},
                               {"bond_fracture_J_m", 1},
                               {"bond_stored_J_m", 1}});
    if (!scene.anchors.empty()) {
        for (const char* key :
             {"anchor_state", "anchor_force_N_m", "anchor_stretch_m", "anchor_plastic_strain",
              "anchor_largest_force_N_m", "anchor_largest_stretch_m", "anchor_snapped_s", "anchor_plastic_work_J_m",
              "anchor_loss_J_m", "anchor_dowel_work_J_m", "anchor_lock_off_opening_m", "anchor_lock_off_slip_m",
              "anchor_direction_opening_m", "anchor_direction_slip_m"})
            all.emplace_back(key, scene.anchors.size());
        all.emplace_back("anchor_time_s", 1);
    }
    if (base_water_changes(scene))
        all.insert(all.end(), {{"water_largest_crack_m", 2},
                               {"water_pressures_Pa", 2},
                               {"water_reynolds_number", 1},
                               {"water_cracked_through_s", 1},
                               {"water_work_J_m", 1},
                               {"water_flow_J_m", 8}});
    if (drains_shear_off(scene)) all.emplace_back("drain_path_m", 1);
    return all;
}

fe2d::JointLawState laws_of(const std::filesystem::path& file, const Scene& scene, const nlohmann::json& j,
                            std::size_t pairs)
{
    fe2d::JointLawState laws;
    for (const auto& [key, size] : numbers_of_laws(scene, pairs)) {
        if (!j.contains("laws") || !j.at("laws").contains(key))
            not_a_state(file, fmt::format("\"{}\" is missing in \"laws\".", key));
        const Eigen::VectorXd values = vector_of(file, j.at("laws"), key, size);
        laws[key].assign(values.begin(), values.end());
    }
    const auto each = [&laws](const char* key) {
        const auto found = laws.find(key);
        return found == laws.end() ? std::vector<double>() : found->second;
    };
    for (const double state : each("anchor_state"))
        if (state != std::floor(state) || state < 0.0 || state > static_cast<double>(AnchorState::snapped))
            not_a_state(file, fmt::format("{} in \"anchor_state\" is no state of an anchor.", state));
    for (const double damage : each("bond_damage"))
        if (!(damage >= 0.0 && damage <= 1.0))
            not_a_state(file, fmt::format("{} in \"bond_damage\" is not between 0 and 1.", damage));
    return laws;
}

fe2d::RunState parsed(const std::filesystem::path& file, const Scene& scene, const nlohmann::json& j)
{
    if (j.at("format").get<std::string>() != format) not_a_state(file, "the file is no state of joints.");
    if (const auto hash = j.at("dam").get<std::string>(); hash != dam_hash(scene))
        refuse(file,
               fmt::format("the file is of another dam: its scene without motion has the hash {}..., this one {}....",
                           hash.substr(0, 12), dam_hash(scene).substr(0, 12)),
               "the state of the same scene; records and their scales alone may differ",
               "give the scene that wrote the file, or write the state anew with this one");
    const auto words = j.at("states").get<std::string>();
    const std::size_t m = words.size();
    fe2d::RunState state;
    for (const char letter : words) {
        const std::size_t place = letters.find(letter);
        if (place == std::string::npos) not_a_state(file, fmt::format("\"{}\" is no state of a pair.", letter));
        state.states.push_back(static_cast<fe2d::ContactState>(place));
    }
    state.force = vector_of(file, j, "force_N_m", 2 * m);
    state.opening = vector_of(file, j, "opening_m", m);
    state.slip = vector_of(file, j, "slip_m", m);
    state.path = vector_of(file, j, "path_m", m);
    state.cohesion = vector_of(file, j, "cohesion_N_m", m);
    state.laws = laws_of(file, scene, j, m);
    return state;
}

} // namespace

std::string dam_hash(const Scene& scene)
{
    Scene dam = scene;
    dam.motion = {};
    return scene_hash(dam);
}

void check_state_file(const Scene& scene, const std::string& flag)
{
    const std::string more = more_than_the_file(scene);
    if (more.empty()) return;
    throw UsageError(Diagnostic{scene.file.string(), 0, 0, flag + " with " + more + ".",
                                "exact contact on a plane that the dam does not leave",
                                "run all records as one  motion.sequence , which carries everything"});
}

void write_state(const std::filesystem::path& file, const Scene& scene, const fe2d::RunState& state,
                 const std::string& after)
{
    std::string words;
    for (const fe2d::ContactState s : state.states) words += letters[static_cast<std::size_t>(s)];
    nlohmann::ordered_json j{{"format", format},
                             {"program", program_version()},
                             {"dam", dam_hash(scene)},
                             {"after", after},
                             {"states", words},
                             {"force_N_m", list_of(state.force)},
                             {"opening_m", list_of(state.opening)},
                             {"slip_m", list_of(state.slip)},
                             {"path_m", list_of(state.path)},
                             {"cohesion_N_m", list_of(state.cohesion)}};
    if (!state.laws.empty()) j["laws"] = state.laws;
    write_file(file, j.dump(1) + "\n");
}

fe2d::RunState read_state(const std::filesystem::path& file, const Scene& scene)
{
    const std::string text = read_file(file);
    try {
        return parsed(file, scene, nlohmann::json::parse(text));
    } catch (const nlohmann::json::exception&) {
        not_a_state(file, "the file is no state of joints.");
    }
}

} // namespace damslip
