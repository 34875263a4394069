#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace damslip::random {

/// How the runs of one scene ended, and what of it must not be.
struct CheckedRuns {
    int screen_code = 0, fe_code = 0;
    std::string status;                       ///< of the FE run; empty: refused
    std::string refusal;                      ///< first sentence of the FE run's; empty: not refused
    std::vector<std::string> findings;        ///< sentences; empty: nothing wrong
    std::map<std::string, int> commands = {}; ///< how often each was run, of check_promise()
};

/// Runs `screen` and `fe` of a scene as a user does and holds them against what every scene has to keep to:
///
/// - exit code 0, 3 or 4, never an internal error; 3 with at least one sentence, the scene's or record's name and what to
///   do about it; a scene refused by one command for what it says is not run by the other;
/// - every status one of the list (core/status.hpp); the exit code follows from them; slips exactly where the status has one, no
///   verdict where it allows none; the same bytes when run again;
/// - an answer comes from resolved steps, and at rest the step leaves no more open than time.slip_tolerance;
/// - all numbers there and finite;
/// - contact complementary to 1e-6 of N' where it was resolved; the work ledger closed to `energy_tolerance`, or to
///   round-off where hardly anything moves; friction takes energy;
/// - the slip no larger than the largest on the way; downstream less upstream slip is the slip of the rigid block;
/// - FE and rigid block from the same loads: the friction that holds the dam statically agrees (two separate ways to it).
CheckedRuns check_run(const std::filesystem::path& scene);

/// The largest share of the work ledger's largest term that may be missing at the end of a run, see check_run.cpp.
extern const double energy_tolerance;

} // namespace damslip::random
