#pragma once

#include "analysis/fe/mesh_error.hpp"
#include "core/table.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "sliding/block/slide.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Results of FE contact runs as tables.
namespace damslip::pages {

struct ContactRun {
    std::string record;
    fe2d::RunResult fe;
    std::optional<sliding::SlideResult> rigid; ///< none where the block slides statically
    std::optional<fe2d::RunResult> exact;      ///< with rigid sticking, where that of `fe` gives way
    int polarity = 1;                          ///< -1: the record's horizontal component is flipped
    bool both = false;                         ///< the other polarity was run, too
    MeshError mesh;

    std::string label() const;  ///< the record, with its polarity where both were run: "El Centro NS, polarity -1"
    std::string suffix() const; ///< of file names: "_+1", "_-1"; empty where one polarity was run
};

/// What is known of the numerical error of a slip [m]; NaN: nothing.
struct SlipError {
    double step = std::numeric_limits<double>::quiet_NaN(); ///< with what reduced runs leave out, of their modes
    double mesh = std::numeric_limits<double>::quiet_NaN();
    double total =
        std::numeric_limits<double>::quiet_NaN(); ///< step and mesh; step alone where no mesh part is asked for
                                                  ///< or can be had; NaN where a part that was asked for failed
    std::string parts() const; ///< "step and mesh", "step only", "step, mesh not known", "no error estimate"
};
SlipError slip_error(const ContactRun& run);
SlipError lift_error(const ContactRun& run, std::size_t lift);

/// Why parts of the errors are not known, each reason once.
std::vector<std::string> error_notes(const std::vector<ContactRun>& runs);

/// Does what follows the earthquake fall, by its resultants?
bool falls_after(const ContactRun& run);
/// Did the solver find no answer for the state after the earthquake?
bool open_after(const ContactRun& run);

/// What may be said of a run: of the base, of every lift joint and of the state after the earthquake the worst. PASS and FAIL by
/// judge(), with the total error of each slip. @param allowable  slip [m]; none: no criterion
Verdict verdict_of(const ContactRun& run, const std::optional<double>& allowable);
/// Of all runs: FAIL if one fails, none if one has no verdict, undecided if one is, else PASS.
Verdict verdict_of(const std::vector<ContactRun>& runs, const std::optional<double>& allowable);

/// The run with the largest slip; dams that fall or run away before all others, runs without slip after them. Of equals the first.
/// @param runs  not empty
const ContactRun& worst_of(const std::vector<ContactRun>& runs);

/// By the statuses of the runs, and of the states after the earthquake.
int exit_code_of(const std::vector<ContactRun>& runs);

/// One of the terms of the energy.
struct EnergyTerm {
    Column column;
    double fe2d::Energy::*value;
};
/// All of them, as tables and files have them.
const std::vector<EnergyTerm>& energy_terms();

// One row per run (or stage).
Table contact_stage_table(const std::vector<ContactRun>& runs);
Table contact_run_table(const std::vector<ContactRun>& runs, const std::optional<double>& allowable);
Table contact_slip_table(const std::vector<ContactRun>& runs); ///< slip along the base, rocking, opening
/// Without rows where the scene has no lift joint.
Table contact_lift_table(const std::vector<ContactRun>& runs, const std::optional<double>& allowable);
Table contact_count_table(const std::vector<ContactRun>& runs);  ///< steps by the path of the contact solver
Table contact_energy_table(const std::vector<ContactRun>& runs); ///< terms at the end

/// Columns of contact_run_table() for people: the answer, and how it was computed.
Table answer_part(const Table& run_table);
Table solution_part(const Table& run_table);

/// Slip of each run beside that of the same run with exact contact: what penalty, slip tolerance or soft
/// normal contact err by.
Table contact_law_table(const std::vector<ContactRun>& runs);

// Of one run.
Table contact_history_table(const fe2d::RunHistory& history);
Table base_table(const fe2d::RunResult& result); ///< the pairs at the end

/// Pressure, shear, slip, opening and state of the pairs over time, one row per pair and instant: every k-th row of the
/// history with the least k that keeps `largest` instants at most, and the last one.
Table pair_table(const fe2d::RunResult& result, std::size_t largest = 200);

/// One row per step of the history, one letter per pair from heel to toe: s sticks, d slips downstream, u upstream, o
/// open, p pulled (without separation only).
Table state_map(const fe2d::RunHistory& history);

} // namespace damslip::pages
