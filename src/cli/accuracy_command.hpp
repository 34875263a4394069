#pragma once

#include "cli/input/run_inputs.hpp"
#include "cli/terminal/streams.hpp"

namespace damslip::cli {

struct AccuracyArguments {
    RunInputs inputs;
    double tolerance = 0.02;      ///< of the deviation from the finest rung [-]
    int repeats = 3;              ///< of short rungs
    double budget = 300.0;        ///< processor time of all rungs together [s]
    bool quick = false;           ///< fewer rungs
    bool all_records = false;     ///< else the first
    std::string rung;             ///< run this one alone; empty: the ladder
    std::filesystem::path out;    ///< folder for report, tables, figure and the rungs' scenes; empty: none
    std::filesystem::path report; ///< the report alone; empty: none
    std::filesystem::path pdf;    ///< the report on paper; empty: none
    std::filesystem::path svg;    ///< the figure alone; empty: none
    bool probability = false;     ///< what the interval of a probability costs, in place of the ladder
    std::string method;           ///< of --probability: as of fragility; empty: rigid-v or rigid
    std::optional<double> level;  ///< of --probability, in the unit of the levels; none: P nearest to 0.1
    std::optional<int> samples; ///< of --probability: runs of the largest estimate; none: 16384, of finite elements 128
    int jobs = 0;               ///< of --probability: threads; 0: all cores
};

/// Climbs the ladder of methods on a scene: slip, its error, its cost; names the cheapest rung within the tolerance.
/// @returns exit_no_answer where no rung is within it, or after an interrupt; what was computed is written all the
/// same.
int accuracy(const AccuracyArguments& arguments, const Streams& streams);

/// The half-width of the 95 % interval of P at one level over processor time, by several estimators (interval_cost()).
/// @returns exit_no_answer where the budget allows no estimate, or after an interrupt
int accuracy_of_probability(const AccuracyArguments& arguments, const Streams& streams);

} // namespace damslip::cli
