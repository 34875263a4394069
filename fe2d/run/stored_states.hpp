#pragma once

#include "fe2d/run/dynamic_contact.hpp"

#include <vector>

namespace damslip::fe2d {

/// Instants of a run whose displacements are kept.
enum class Instant {
    start,
    leans_downstream, ///< crest farthest downstream of the base
    leans_upstream,   ///< crest farthest upstream of it
    slides_fastest,   ///< largest |slip rate| between two rows of the history; not there when nothing slides
    end
};

/// Displacements of one instant as the run has them; EarthquakeRun::displacement_of() makes them those of the model.
struct StoredState {
    Instant instant = Instant::start;
    double time = 0.0;    ///< [s]
    double slip = 0.0;    ///< area mean since the static state [m]
    Eigen::VectorXd dam;  ///< of what moves, in its node order [m]
    Eigen::VectorXd rock; ///< of the rock's contact nodes, plane [m]
};

/// Keeps the states of a run's instants, each when it has come: two vectors are copied where a value exceeds all before.
class StateKeeper {
public:
    /// @param time  in the run's history [s] @param slip  area mean since the static state [m] @param crest_x  since the static state [m]
    void look(const DynamicState& state, double time, double slip, double crest_x);

    /// In order of time. The end is the last state looked at.
    std::vector<StoredState> states() const;

private:
    std::vector<StoredState> kept_; ///< one by Instant; an empty `dam`: none
    double lean_down_ = 0.0, lean_up_ = 0.0, rate_ = 0.0;
};

} // namespace damslip::fe2d
