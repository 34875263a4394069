#pragma once

#include "analysis/fe/contact_runs.hpp"

#include <string>
#include <vector>

namespace damslip {

/// The worst run of a scene with one other choice of the model.
struct ModelChoice {
    std::string what; ///< "massless rock", "added mass", "other polarity"
    bool run = false; ///< false: nobody asked for it
    Status status = Status::not_resolved;
    double max_slip = 0.0; ///< [m], where the status has one
};

/// How far choices of the model lie from the printed slip: massless rock for rock that radiates or the other way round, added
/// mass for acoustic water, the other polarity as far as `runs` has it.
/// @param ready  of `runs` @param given  the scene as read @param run_them  run what is not there on the record and
/// polarity of the worst run; else it is named as not run
/// @throws InputError, NotConverged, Interrupted
std::vector<ModelChoice> model_spread(const Ready& ready, const std::vector<ContactRun>& runs, bool run_them,
                                      Watch& watch);

/// One line for the answer; empty where there is nothing to choose.
std::string spread_line(const std::vector<ModelChoice>& spread, const std::vector<ContactRun>& runs);

} // namespace damslip
