#include "analysis/fe/state_file.hpp"

#include "core/file.hpp"
#include "core/usage_error.hpp"
#include "core/version.hpp"
#include "scene/joint_bond.hpp"
#include "scene/write.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

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
    const bool lifts_break = std::any_of(scene.lift_joints.begin(), scene.lift_joints.end(),
                                         [](const LiftJoint& joint) { return breaks_by_energy(joint.strength); });
    if (breaks_by_energy(c) || lifts_break) return "bond = \"fracture\"";
    if (!scene.anchors.empty()) return "[[anchor]]";
    if (scene.uplift && scene.uplift->water.opening != OpeningWater::unchanged) return "uplift.opening";
    if (c.enforcement != ContactEnforcement::exact || c.normal != NormalContact::hard) return "contact that gives way";
    if (c.sliding == JointPath::finite) return "contact.sliding = \"finite\"";
    return {};
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
                                "joints whose state is slip, path, opening, forces and cohesion",
                                "run all records as one  motion.sequence , which carries everything"});
}

void write_state(const std::filesystem::path& file, const Scene& scene, const fe2d::RunState& state,
                 const std::string& after)
{
    std::string words;
    for (const fe2d::ContactState s : state.states) words += letters[static_cast<std::size_t>(s)];
    const nlohmann::ordered_json j{{"format", format},
                                   {"program", program_version()},
                                   {"dam", dam_hash(scene)},
                                   {"after", after},
                                   {"states", words},
                                   {"force_N_m", list_of(state.force)},
                                   {"opening_m", list_of(state.opening)},
                                   {"slip_m", list_of(state.slip)},
                                   {"path_m", list_of(state.path)},
                                   {"cohesion_N_m", list_of(state.cohesion)}};
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
