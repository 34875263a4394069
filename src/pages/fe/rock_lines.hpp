#pragma once

#include "fe2d/run/earthquake_run.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

/// The rock below a dam that slides, as answers and pages name it beside the slip.
namespace damslip::pages {

/// "radiating rock, 2650 kg/m3 (none given): waves right to 29 Hz; 122 modes, error 0.8 %, found in the cache"
std::string rock_line(const Scene& scene, const fe2d::EarthquakeRun& model);

/// {"model", "words"} and of radiating rock density, frequency, modes, error, gate, unknowns, seconds, origin.
nlohmann::ordered_json rock_json(const Scene& scene, const fe2d::EarthquakeRun& model);

/// What is to be known of radiating rock: a gate that was failed, what an inclined base and a curtain leave out.
std::vector<std::string> radiating_messages(const Scene& scene, const fe2d::EarthquakeRun& model);

/// The same, what the bond asks of the mesh, and what the waves of each record ask of box and mesh (rock_warnings()): the lines of all runs of one
/// model.
class ModelNotes {
public:
    /// @param scene, model  outlive this
    ModelNotes(const Scene& scene, const fe2d::EarthquakeRun& model);
    /// A line that both polarities of a record ask for is there once.
    void add(const std::string& record, const GroundMotion& motion);
    const std::vector<std::string>& lines() const { return lines_; }

private:
    const Scene& scene_;
    const fe2d::EarthquakeRun& model_;
    std::vector<std::string> lines_;
};

} // namespace damslip::pages
