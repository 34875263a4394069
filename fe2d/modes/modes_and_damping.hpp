#pragma once

#include "core/status.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "scene/scene.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace damslip::fe2d {

enum class ModesStatus {
    ok,
    solver_failed, ///< the stiffness could not be factorised; `solver` says why
    not_converged, ///< fewer modes than asked for have converged; those that have are given
    no_mass        ///< nothing has mass
};

/// Undamped natural modes K phi = omega^2 M phi, lowest first, mass-normalised (phi^T M phi = 1), largest entry
/// positive. Unknowns without mass (massless rock) take part statically; they add no modes.
struct NaturalModes {
    ModesStatus status = ModesStatus::ok;
    SolverReport solver;
    Eigen::VectorXd frequency;        ///< f [Hz]
    Eigen::MatrixXd shape;            ///< one column per mode, length dofs.count [kg^-1/2 m^1/2]
    Eigen::Matrix2Xd participation;   ///< Gamma = phi^T M r for a translation r in x (row 0) and y (row 1)
    Eigen::Matrix2Xd effective_mass;  ///< Gamma^2 [kg/m]
    Eigen::Matrix2Xd effective_share; ///< effective mass over the total mass in that direction, added mass included [-]
    int operator_applications = 0;    ///< solves of the iteration
};

/// @param count  modes wanted, >= 1; fewer come back where there are fewer unknowns with mass
/// Lanczos with implicit restarts (Spectra) on L^T K^-1 L with M = L L^T, from a fixed start vector: same model, same
/// bits.
NaturalModes natural_modes(const Model& model, int count, const SolverOptions& options = {});

/// How the peaks of modes, which do not come at the same instant, make one peak.
enum class ModalRule {
    srss, ///< root of the sum of squares: modes far from each other
    cqc   ///< complete quadratic combination
};

/// Correlation of two modes with the same damping under a broad-banded ground motion [-]; Der Kiureghian (1981), eq. (24)
/// with one damping ratio, r the ratio of the frequencies:
///
///     rho = 8 zeta^2 (1 + r) r^(3/2) / [(1 - r^2)^2 + 4 zeta^2 r (1 + r)^2]
///
/// Equal frequencies: 1. Frequencies far from each other, or no damping: 0.
/// @param f_i, f_j  > 0, in the same unit @param ratio  zeta [-], >= 0
double modal_correlation(double f_i, double f_j, double ratio);

/// Correlations of all modes; for ModalRule::srss the identity.
Eigen::MatrixXd modal_correlations(const Eigen::VectorXd& frequency, double ratio, ModalRule rule);

/// sum_i sum_j rho_ij a_i b_j: the square of a combined peak for a = b; divided by the peak of b, the value of a most
/// likely at the instant of that peak.
double combined_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::MatrixXd& correlation);

/// Peak of a quantity from those of the modes, >= 0, in its unit.
double combined_peak(const Eigen::VectorXd& modal, const Eigen::MatrixXd& correlation);

/// C = a_M M + b_K K, (2-52).
struct RayleighConstants {
    double mass = 0.0;      ///< a_M [1/s]
    double stiffness = 0.0; ///< b_K [s]
};

/// The constants that give the ratio at two frequencies, (2-56), (2-57):
///
///     a_M = 2 ζ ω_i ω_j / (ω_i + ω_j),   b_K = 2 ζ / (ω_i + ω_j)
///
/// Table 5-5 of the thesis prints a_M = 0.422 for 5 % at 1.54 and 2.29 Hz; it is 0.579.
/// @param ratio  ζ >= 0 [-]
/// @param first_frequency, second_frequency  ω_i, ω_j > 0 [rad/s]; may be equal
RayleighConstants rayleigh_constants(double ratio, double first_frequency, double second_frequency);

/// ζ(ω) = a_M/(2ω) + b_K ω/2 [-], (2-55); below the given ratio between the two frequencies, above it outside.
double damping_ratio(const RayleighConstants& constants, double frequency);

/// What modified Rayleigh damping needs to know of a mode.
struct ModalMass {
    double frequency = 0.0;        ///< circular, ω_n [rad/s]
    double effective_mass_x = 0.0; ///< of horizontal ground motion [kg/m]
};

/// S_a(ω [rad/s], ζ [-]) [m/s^2]: peak absolute acceleration of the exact one-degree-of-freedom response to the
/// horizontal record.
using SpectralAcceleration = std::function<double(double frequency, double ratio)>;

struct ModifiedRayleighOptions {
    double ratio = 0.05;        ///< ζ wanted in every mode, 0 < ζ < 1 [-]
    std::size_t first_mode = 0; ///< i, index into the modes; keeps the ratio exactly
    std::size_t ordinary_mode =
        4;                   ///< j of ordinary Rayleigh, taken when there is no other solution; the last mode if fewer
    double total_mass = 0.0; ///< all mass that horizontal motion can move [kg/m], > 0
    double required_mass = 0.7; ///< share of it the modes must reach together [-]
    int scan_points = 400;      ///< frequencies of the scan, in geometric steps, >= 2
};

enum class ModifiedRayleighStatus {
    found,      ///< ΔS = 0 at second_frequency
    no_solution ///< ΔS keeps its sign: constants are those of ordinary Rayleigh, ΔS says what they miss
};

struct ModifiedRayleigh {
    RayleighConstants constants;
    ModifiedRayleighStatus status = ModifiedRayleighStatus::no_solution;
    double second_frequency = 0.0;    ///< ω_j [rad/s]
    std::vector<double> sign_changes; ///< all ω_j with ΔS = 0 in the scanned range, ascending [rad/s]
    double imbalance = 0.0;           ///< ΔS at ω_j [N/m]
    double relative_imbalance = 0.0;  ///< |ΔS| / Σ S_a(ω_n, ζ) m_eff,n [-]
    double mass_share = 0.0;          ///< effective mass of all modes given over the total [-]
    std::vector<Note> warnings;
};

/// Rayleigh constants whose base shear over all modes is the one of the ratio ζ in every mode, Spears & Jensen (2012);
/// (2-58), (2-59): ω_i is the first mode's, ω_j solves
///
///     ΔS(ω_j) = Σ_n [S_a(ω_n, ζ_n) - S_a(ω_n, ζ)] m_eff,n = 0,    ζ_n = a_M/(2ω_n) + b_K ω_n/2
///
/// ΔS is scanned over (ω_i, 3 ω_max], every change of sign is bisected to a relative 1e-12 and listed, the smallest is
/// taken. ω_j need not be a natural frequency. None: ordinary Rayleigh on modes i and `ordinary_mode`, with a warning.
/// @param modes  at least `first_mode` + 1, ascending in frequency
ModifiedRayleigh modified_rayleigh(const std::vector<ModalMass>& modes,
                                   const SpectralAcceleration& spectral_acceleration,
                                   const ModifiedRayleighOptions& options);

/// ΔS(ω_j) of the formula above [N/m].
double shear_imbalance(const std::vector<ModalMass>& modes, const SpectralAcceleration& spectral_acceleration,
                       double ratio, const RayleighConstants& constants);

/// The damping of one run: C = a_M M_structure + b_K K. The added mass of the water is not damped.
struct DampingChoice {
    RayleighConstants constants;              ///< zero: no damping
    MassDamping mass = MassDamping::relative; ///< which velocity a_M resists
    std::optional<ModifiedRayleigh> modified; ///< how the constants were found, where they are modified Rayleigh's
    std::vector<Note> notes;                  ///< what was chosen and what the user should know
};

/// Modes to compute for a choice: the second Rayleigh mode at least; modified Rayleigh needs most of the mass, 20 as a rule.
int modes_needed(const Damping& damping);

/// What the scene's [damping] asks for.
/// @param modes  ascending; a mode that was not found is replaced by the last one, and a note says so
/// @param total_mass  that horizontal motion can move [kg/m]
/// @param spectral_acceleration  used by modified Rayleigh only
/// a_M or b_K given directly take the place of the ones from ratio and modes.
/// @throws NotConverged where modes are needed and none was found
DampingChoice choose_damping(const Damping& damping, const std::vector<ModalMass>& modes, double total_mass,
                             const SpectralAcceleration& spectral_acceleration);

/// The symmetric n x n matrix U S Uᵀ of rank k, kept as its factors: it touches many unknowns but never fills a sparse
/// matrix.
struct LowRank {
    Eigen::MatrixXd columns; ///< U, n x k; empty: the zero matrix
    Eigen::MatrixXd core;    ///< S, k x k, symmetric, may be indefinite

    bool empty() const { return columns.cols() == 0; }

    /// result += factor U S Uᵀ x
    void add_product(const Eigen::VectorXd& x, double factor, Eigen::VectorXd& result) const;
};

/// Mass-proportional damping that resists the deformation of the dam but not its sliding:
///
///     C_M = a_M (I - r wᵀ)ᵀ M (I - r wᵀ) = a_M M + U S Uᵀ,   U = [w, M r],   S = a_M [rᵀM r, -1; -1, 0]
///
/// r is the horizontal rigid translation of the dam, wᵀu̇ its mean slip rate over the rock (weights: dam base minus
/// rock, each side by contact area). C_M is positive semi-definite. Under uniform slip, u̇ = s r with wᵀr = 1, the force
/// is exactly zero; on a tied base wᵀu̇ = 0 and C_M acts as a_M M, so the damping of the tied modes does not change.
/// Against Hall (2006), who shows what mass-proportional damping does to a sliding dam. Rigid motion of the dam
/// together with the rock stays damped.
///
/// @returns U S Uᵀ; a_M M belongs to the sparse part of C.
/// @param mass  the mass that is damped (the dam's own), n x n
/// @param rigid_translation  r, n: 1 on horizontal unknowns of the dam, 0 elsewhere
/// @param slip_weights  w, n, with wᵀr = 1
LowRank deformation_only_correction(double mass_coefficient, const Eigen::SparseMatrix<double>& mass,
                                    const Eigen::VectorXd& rigid_translation, const Eigen::VectorXd& slip_weights);

} // namespace damslip::fe2d
