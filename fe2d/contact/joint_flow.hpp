#pragma once

#include <Eigen/Core>

#include <limits>
#include <optional>
#include <vector>

/// Thin flow of water along a joint: Reynolds' equation, by itself. It knows widths of the joint, no contact.
namespace damslip::fe2d {

/// The water in a joint.
struct JointFluid {
    double viscosity = 1.3e-3;                                     ///< η [Pa s]
    double bulk_modulus = std::numeric_limits<double>::infinity(); ///< K_w [Pa]; infinite: incompressible
    double density = 1000.0;                                       ///< ρ [kg/m³]
    double unit_weight = 0.0;                                      ///< γ_w of a joint that is not level [N/m³]
    double cavitation = -99e3;                                     ///< p_cav, against the atmosphere [Pa]
};

/// A joint of m cells, numbered from its first end.
struct JointChannel {
    Eigen::VectorXd length;                     ///< A of each cell [m]
    double fall = 0.0;                          ///< sin θ, positive where the second end lies lower [-]
    bool first_open = true, second_open = true; ///< an open end has the pressure of the water before it; else no flow
    std::optional<Eigen::Index> drain;          ///< cell whose pressure is held

    Eigen::Index cells() const { return length.size(); }
};

/// Pressures that are held from outside [Pa].
struct HeldPressure {
    double first = 0.0, second = 0.0; ///< of the open ends
    double drain = 0.0;
};

/// The water at one instant.
struct JointFlowState {
    Eigen::VectorXd pressure; ///< p by cell [Pa]
    Eigen::VectorXd empty;    ///< volume without water by cell [m²]; positive only where p = p_cav
};

/// What the water has done and taken since the start [J/m]. Of every step, and of their sum, exactly
///
///     walls = ends + drain + rock + gravity - viscous - stored - cavities
///
/// the discrete ∫p ẇ = p₀q₀ - p_L q_L - ∫(12η/w³)q² - storage.
struct JointFlowWork {
    double walls = 0.0;    ///< done by the water on the two faces: Σ p A Δw
    double ends = 0.0;     ///< received from the water before the open ends
    double drain = 0.0;    ///< received at the drain; negative: given to it
    double rock = 0.0;     ///< received with the seepage that keeps the joint as it is at rest
    double gravity = 0.0;  ///< gained by water that flows down along the joint
    double viscous = 0.0;  ///< lost to viscosity and turbulence, ∫(12η/w³)q², >= 0
    double stored = 0.0;   ///< compressing the water, with what implicit Euler takes of it
    double cavities = 0.0; ///< against the pressure in cavities, and lost where they close

    double imbalance() const { return walls - (ends + drain + rock + gravity - viscous - stored - cavities); }
    JointFlowWork& operator+=(const JointFlowWork& other);
};

/// One step of implicit Euler, its widths w at the end still unknown. In a cell of length A
///
///     A (w - w₀)/Δt - (v - v₀)/Δt + (w₀ A/K_w)(p - p₀)/Δt + q_out - q_in = source
///     q = -T (Δp/Δx - γ_w sin θ),  T = w₀³/(12η)
///     p >= p_cav  ⟂  v >= 0
///
/// v: empty volume (Jakobsson & Floberg 1957, Olsson 1965: mass is conserved through cavitation). A cell that is not
/// full lets no water out. The matrix T + S of p is an M-matrix, so pressures are unique and the active set of
/// cavitated cells is found by a monotone iteration. Where Re = 2|q|/ν would exceed the laminar range at the last
/// gradient, T is the secant of Darcy-Weisbach's law with f = max(96/Re, 0.316 Re^-1/4) (Blasius 1913, smooth faces,
/// hydraulic diameter 2w).
class JointFlowStep {
public:
    /// @param width  w₀ of the cells at the start, positive [m]
    /// @param source  inflow from the rock by cell [m²/s]; empty: none
    /// @param dt  > 0 [s]
    JointFlowStep(const JointChannel& channel, const JointFluid& fluid, const JointFlowState& start,
                  const Eigen::VectorXd& width, const HeldPressure& held, const Eigen::VectorXd& source, double dt);

    /// The water with these widths at the end [m].
    JointFlowState state(const Eigen::VectorXd& width) const;

    /// -∂p/∂w with the given cells at p_cav and the others full: (T+S)⁻¹ A/Δt, m x m, rows and columns of cells whose
    /// pressure is held are zero [Pa/m].
    Eigen::MatrixXd stiffness(const std::vector<char>& cavitated) const;
    /// Which cells of a state are at p_cav.
    std::vector<char> cavitated(const JointFlowState& state) const;

    Eigen::VectorXd
    flux(const JointFlowState& end) const; ///< q through the m + 1 faces, positive from the first end [m²/s]
    double reynolds_number(const JointFlowState& end) const; ///< largest 2|q|/ν [-]
    JointFlowWork work(const JointFlowState& end, const Eigen::VectorXd& width) const;

private:
    void set_conductance(const Eigen::VectorXd& width);
    Eigen::VectorXd times(const Eigen::VectorXd& pressure) const;
    Eigen::VectorXd solve(Eigen::VectorXd right, const std::vector<char>& held, const Eigen::VectorXd& values) const;

    const JointChannel& channel_;
    const JointFluid& fluid_;
    const JointFlowState& start_;
    HeldPressure held_;
    double dt_;
    Eigen::VectorXd width_;       ///< w₀
    Eigen::VectorXd source_;      ///< [m²/s]
    Eigen::VectorXd conductance_; ///< of the m + 1 faces: q over the difference of pressure [m²/(Pa s)]
    Eigen::VectorXd driven_;      ///< by gravity through the faces [m²/s]
    Eigen::VectorXd storage_;     ///< w₀ A/(K_w Δt)
    Eigen::VectorXd known_;       ///< right side without the walls
};

/// Sources that keep a pressure as it is in a joint at rest [m²/s]: what comes out of the rock or goes into it.
Eigen::VectorXd steady_source(const JointChannel& channel, const JointFluid& fluid, const Eigen::VectorXd& pressure,
                              const Eigen::VectorXd& width, const HeldPressure& held);

} // namespace damslip::fe2d
