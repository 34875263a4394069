#pragma once

#include "analysis/fe/contact_runs.hpp"
#include "analysis/prepare/ready.hpp"
#include "fe2d/run/run_history.hpp"
#include "pages/sheet/workbook.hpp"

#include <filesystem>
#include <vector>

/// Numbers of the program made again cell by cell, so that a reviewer can follow them.
namespace damslip::pages {

/// A worksheet for each load combination of limit equilibrium: weights, water, uplift, crack, factors, stresses, yield
/// acceleration; numbers that are given in blue, the others formulas of them, at the end beside the program's.
/// Given are: the length of the crack (its condition is a cell that has to be 0), uplift pressures other than heads of
/// water, added mass (an integral over the face), forces of anchors.
/// @param combinations  Ready::combinations() @throws InputError where the file cannot be written
void write_equilibrium_sheets(const std::filesystem::path& file, const Ready& ready,
                              const std::vector<sliding::Equilibrium>& combinations);

/// Forces on the base at one instant of a run by finite elements, kept while the run is at hand.
struct BaseInstant {
    std::string label; ///< "rock_1.0_h, polarity +1"
    double time = 0.0, slip = 0.0;                          ///< [s], [m]
    double normal_force = 0.0, shear_force = 0.0, position = 0.0; ///< RunHistory, [N/m], [N/m], from the heel [m]
    std::vector<double> distance, area, pressure, shear;    ///< of the pairs [m], [m], [Pa], [Pa]
};

/// The instant with the least (c A' + mu N')/|T|, A' the length under pressure, with the peak strength; while the base slides, where it is 1, the one with the largest shear.
/// @pre the history holds the values of the pairs
BaseInstant worst_instant(const ContactRun& run, const Contact& strength);

/// One worksheet for each run.
void write_base_sheets(const std::filesystem::path& file, const Contact& strength, const std::vector<BaseInstant>& instants);

} // namespace damslip::pages
