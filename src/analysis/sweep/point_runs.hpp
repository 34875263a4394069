#pragma once

#include "analysis/sweep/sweep_run.hpp"

namespace damslip {

/// One point of whoever asks from outside: a scene, a method, one of its records.
struct PointAnswer {
    FinishedRow row; ///< that of a sweep over this scene alone, bit for bit: of its polarities the worse
    std::string record;
    int polarity = 1;
    std::string method;
    double seconds = 0.0; ///< processor time
};

/// Answers point after point. The records are read again only when the scene names others, or another scale of them.
class PointRuns {
public:
    /// @param record  name; empty: the only one @throws UsageError, InputError, NotConverged
    PointAnswer run(const Scene& scene, const SweepMethod& method, const std::string& record, Watch& watch);

private:
    std::string names_; ///< what the records were read for
    Records records_;
};

/// rigid-v where a record has a vertical component and the scene counts it, else rigid: the last method a sweep takes by itself.
SweepMethod usual_method(const Scene& scene);

} // namespace damslip
