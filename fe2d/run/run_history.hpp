#pragma once

#include "fe2d/run/dynamic_contact.hpp"

#include <vector>

namespace damslip::fe2d {

/// Values at the record's steps (and in the run-out at the same interval), the start included. Slips are counted from
/// the static state.
struct RunHistory {
    std::vector<double> time;            ///< [s]
    std::vector<double> ground_h;        ///< positive upstream [m/s²]
    std::vector<double> ground_v;        ///< positive up [m/s²]
    std::vector<double> slip;            ///< area mean, positive downstream [m]
    std::vector<double> slip_heel;       ///< of the first pair [m]
    std::vector<double> slip_toe;        ///< of the last pair [m]
    std::vector<double> crest_x;         ///< crest relative to the ground, since the static state, downstream [m]
    std::vector<double> normal_force;    ///< Σλ_n [N/m]
    std::vector<double> shear_force;     ///< on the dam, resisting downstream slip: -Σλ_t [N/m]
    std::vector<double> open_length;     ///< [m]
    std::vector<double> slipping_length; ///< [m]
    std::vector<double> largest_opening; ///< [m]
    std::vector<Energy> energy;          ///< [J/m]
    std::vector<double> imbalance;       ///< [J/m]
};

/// Writes the rows of a history while a run goes on.
class HistoryRecorder {
public:
    HistoryRecorder(const DynamicContact& dynamics, RunHistory& history);

    double slip() const { return weights_.dot(dynamics_.state().contact.slip - start_); }
    void add(); ///< a row for the present state

private:
    const DynamicContact& dynamics_;
    RunHistory& history_;
    Eigen::VectorXd weights_, start_;
    Eigen::Index crest_ = 0;
    double crest_start_ = 0.0;
};

} // namespace damslip::fe2d
