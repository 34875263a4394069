#pragma once

#include "analysis/fe/contact_run.hpp"
#include "core/table.hpp"

#include <optional>
#include <string>
#include <vector>

/// Results of FE contact runs as tables.
namespace damslip::pages {

/// A slip of the run [mm]; nothing where its status has none.
Cell slip_cell(const ContactRun& run, double metres);

/// The terms of the energy, as tables and files have them.
const std::vector<ColumnOf<fe2d::Energy>>& energy_columns();
/// The same, and those of the joints' laws that are not zero in some row.
std::vector<ColumnOf<fe2d::Energy>> energy_columns_of(const std::vector<fe2d::Energy>& rows);

/// Columns of contact_run_table(); runs on few modes share them.
using ContactColumn = ColumnOf<ContactRun>;
std::vector<ContactColumn> contact_run_columns(const std::optional<double>& allowable);

// One row per run (or stage).
Table contact_stage_table(const std::vector<ContactRun>& runs);
Table contact_run_table(const std::vector<ContactRun>& runs, const std::optional<double>& allowable);
Table contact_slip_table(const std::vector<ContactRun>& runs); ///< slip along the base, rocking, opening
/// Without rows where the scene has no lift joint.
Table contact_lift_table(const std::vector<ContactRun>& runs, const std::optional<double>& allowable);
/// What the anchors came to; without rows where the scene has none.
Table contact_anchor_table(const std::vector<ContactRun>& runs);
/// Of a sequence, one row for each event that was reached; without rows where there is none.
Table contact_event_table(const std::vector<ContactRun>& runs);
Table contact_count_table(const std::vector<ContactRun>& runs);  ///< steps by the path of the contact solver
Table contact_energy_table(const std::vector<ContactRun>& runs); ///< terms at the end
/// Slip with the ground moving and at rest, and what pays for it (fe2d::SlideWatch).
Table run_out_table(const std::vector<ContactRun>& runs);

/// For people: "walked >= 512" in place of a slip that a dam which goes on by itself has not.
void write_walked_slips(Table& run_table);

/// Columns of contact_run_table() for people: the answer, and how it was computed.
Table answer_part(const Table& run_table);
Table solution_part(const Table& run_table);

/// Slip of each run beside that of the same run with exact contact: what penalty, slip tolerance or soft
/// normal contact err by.
Table contact_law_table(const std::vector<ContactRun>& runs);

/// Columns over the rows of a history, none where it is empty. @param history  outlives them
std::vector<ColumnOf<std::size_t>> slide_columns(const fe2d::SlideHistory& history);

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
