#pragma once

#include "core/table.hpp"
#include "fe2d/time/energy.hpp"

#include <string>
#include <vector>

namespace damslip::fe2d {

enum class TiedRunStatus {
    complete,
    cancelled,     ///< stopped by the caller; everything up to there is valid
    solver_failed, ///< a matrix could not be factorised; no step was made
    diverged       ///< a value is no longer finite; the last row is the last finite state
};

/// One row of a run, at the end of a step. Displacements are relative to the ground, accelerations absolute.
struct HistoryRow {
    double time = 0.0;                                 ///< [s]
    double ground_accel_h = 0.0, ground_accel_v = 0.0; ///< a_h positive upstream, a_v positive up [m/s^2]
    double crest_x = 0.0, crest_y = 0.0; ///< displacement of the crest's upstream end, downstream and up [m]
    double crest_accel_x = 0.0, crest_accel_y = 0.0; ///< absolute, downstream and up [m/s^2]
    double base_shear = 0.0;                         ///< of the dam on the rock, positive downstream [N/m]
    double base_normal = 0.0; ///< of the dam on the rock, compression positive [N/m]; total, without uplift
    double water_force_x =
        0.0;       ///< of acoustic water beyond the static one on the dam, positive downstream [N/m]; 0 without
    Energy energy; ///< [J/m]
    double imbalance = 0.0; ///< of the energies since the start [J/m]
};

/// What a superposition of modes leaves out. The modes left out follow the ground statically; the errors are estimates of
/// the dynamic part of them, see integrate_modal().
struct ModalTruncation {
    int modes = 0;
    double highest_frequency = 0.0;                       ///< of the modes kept [Hz]
    Eigen::Vector2d mass_share = Eigen::Vector2d::Zero(); ///< effective mass kept, in x and in y [-]
    double damping_coupling = 0.0; ///< largest |φ_iᵀCφ_j| over the root of φ_iᵀCφ_i φ_jᵀCφ_j, i ≠ j; 0: classical [-]
    double crest_x_error = 0.0;       ///< [m]
    double crest_accel_x_error = 0.0; ///< [m/s^2]
    double base_shear_error = 0.0;    ///< [N/m]
};

/// What a run gives, and how it ended.
struct History {
    TiedRunStatus status = TiedRunStatus::complete;
    std::string status_text;      ///< one sentence with the numbers
    std::vector<HistoryRow> rows; ///< the start and every step; thinned where asked for
    Eigen::VectorXd displacement; ///< of all model unknowns at the end [m]
    double time_step = 0.0;       ///< [s]
    std::int64_t steps = 0;       ///< made
    std::size_t factorisations = 0;
    std::int64_t unknowns = 0;       ///< of the system stepped
    std::string method;              ///< "HHT", "central difference", "24 modes" ...
    double step_limit = 0.0;         ///< of an explicit scheme [s]; 0: none
    ModalTruncation modal;           ///< of a superposition of modes; modes = 0: none
    double energy_scale = 0.0;       ///< largest energy of the run [J/m]
    double largest_imbalance = 0.0;  ///< over the steps, over energy_scale [-]
    double peak_crest_x = 0.0;       ///< largest |crest displacement - the one at the start| in x [m]
    double peak_crest_accel_x = 0.0; ///< largest |absolute crest acceleration| in x [m/s^2]
    double peak_base_shear = 0.0;    ///< largest, downstream [N/m]
    double peak_water_force = 0.0;   ///< largest |water_force_x| [N/m]
    std::vector<std::string> notes;
};

/// The rows as a table, for CSV and charts. Energies in J/m, forces in N/m.
Table tabulate(const History& history);

} // namespace damslip::fe2d
