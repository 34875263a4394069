#pragma once

#include <string>
#include <vector>

namespace damslip::probability {

/// One limit state of a fragility model.
struct NrmlLimit {
    std::string name;                ///< "slip-50mm": letters, digits, "-" and "_"
    double median = 1.0, beta = 0.4; ///< of a lognormal curve
    std::vector<double> poes;        ///< P at the model's levels, for the discrete form
};

struct NrmlModel {
    std::string id, description;
    std::string imt;               ///< "PGA", "SA(0.3)"
    double no_damage = 0.0;        ///< P = 0 below, unit of the measure (g for PGA and SA)
    std::vector<double> levels;    ///< tested intensities, rising
    std::vector<NrmlLimit> limits; ///< mildest first
};

/// OpenQuake's fragility model, NRML 0.5. format="continuous" shape="logncdf" with mean and standard deviation of x (not of ln x),
/// mean = theta e^(beta^2/2), stddev = mean sqrt(e^(beta^2) - 1); format="discrete" with P at the levels where limits cross.
/// @throws ParameterError for levels that do not rise, a name that is no word, a discrete limit without its poes
std::string nrml_fragility(const NrmlModel& model);

/// One triangular distribution of the water level at failure.
struct StageTriangle {
    double probability = 0.0;                       ///< of failure [-]
    double min = 0.0, most_likely = 0.0, max = 0.0; ///< stage [m]
};
struct UsaceLocation {
    std::string location;
    std::vector<StageTriangle> stages; ///< rising probability
};

/// The file of the USACE library fragility-curves: probability over stage. A stage is a water level: for fragility over reservoir.level_m only.
/// @throws ParameterError for probabilities that do not rise, min > most_likely or most_likely > max
std::string usace_fragility(const std::string& name, const std::vector<UsaceLocation>& locations);

} // namespace damslip::probability
