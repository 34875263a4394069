#pragma once

#include "analysis/fe/contact_run.hpp"

#include <filesystem>
#include <string>

/// A run over time for ParaView.
namespace damslip::pages {

/// What all runs of a scene share.
struct FrameModel {
    const Scene& scene; ///< as the plan calls for it
    const fe2d::EarthquakeRun& model;
    const PressureProfile& uplift; ///< under the base before the earthquake
};

/// Writes the frames of a run (RunHistory::frames), one after the other so that one is held at a time: for each a .vtm with
/// the blocks dam, rock, water (acoustic) and joints, and over all of them <folder>/frames_<record>.pvd with times in s.
///
/// Dam and rock: displacement_m (from where the run counts it), stresses. Water: pressure_Pa beyond the static one. Joints,
/// lines from heel to toe and along lift joints: opening_m, slip_m since the static state, normal_pressure_Pa (effective,
/// compression positive), shear_Pa (on the part above, positive where it resists downstream slip), water_pressure_Pa,
/// state (0 sticks, 1 slips downstream, 2 upstream, 3 open, 4 pulled).
/// @returns the name of the .pvd; empty: the run has no frames @throws InputError when a file cannot be written
std::string write_frames(const std::filesystem::path& folder, const FrameModel& of, const ContactRun& run);

} // namespace damslip::pages
