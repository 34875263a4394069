#pragma once

#include "fe2d/contact/contact_solver.hpp"

#include <Eigen/Core>

namespace damslip::fe2d {

/// Soft contact pressure that falls with the clearance g of the two sides (Goldgruber 2015, section 6.3; "exponential
/// pressure-overclosure" of Abaqus):
///
///     p = p0/(e - 1) z (exp z - 1),   z = 1 - g/c0;   p = 0 for g >= c0
///
/// p0 at zero clearance, zero from the clearance c0 on, with a zero slope there: p has a continuous derivative, falls
/// everywhere in g < c0 and has the energy w = ∫ p dg, so it is conservative. c0 -> 0 is hard contact.
///
/// At the penetration z = `deepest` (p = 5e18 p0) and beyond the law goes on along its tangent, so nothing overflows.
class ExponentialPressure {
public:
    static constexpr double deepest = 40.0;

    /// @param at_zero_clearance  p0, > 0 [Pa]
    /// @param at_zero_pressure   c0, > 0 [m]
    ExponentialPressure(double at_zero_clearance, double at_zero_pressure);

    double pressure(double clearance) const;  ///< p, >= 0 [Pa]
    double stiffness(double clearance) const; ///< -dp/dg, >= 0 [N/m³]
    double energy(double clearance) const;    ///< w, from the clearance on, >= 0 [J/m²]
    double clearance(double pressure) const;  ///< g of a pressure > 0 [m]; the inverse of pressure()
    double range() const { return range_; }   ///< c0 [m]

private:
    double unit_;  ///< p0/(e - 1) [Pa]
    double range_; ///< c0 [m]
};

/// Contact whose normal forces follow an ExponentialPressure of the clearance, with Coulomb's friction on top:
///
///     λ_n = A p(g) >= 0,   |λ_t| <= c + mu λ_n where g < c0,   λ = 0 where g >= c0
///
/// Same V and λ⁰ as the contact problem (λ⁰ of shut sides, g = 0; x = (clearance g, slip)), of which it is the limit
/// c0 -> 0. The pairs are never `pulled`, and `open` means g >= c0.
///
/// Newton on states and clearances together: all normal rows are released, λ_n + D g = A p(ĝ) + D ĝ with the tangent
/// D = -A p'(ĝ). A pair that closes takes its next ĝ from the force of the tangent, one that opens from its clearance
/// (Ho, Ruehli & Brennan 1975 for diodes, whose law is the same): steps along the exponential neither overshoot nor
/// overflow. Where the states cycle, the tangents are held, friction is then solved exactly with all safeguards of
/// ContactSolver, and the tangents are renewed.
class ExponentialNormal {
public:
    /// @param stiffness  V
    /// @param area       of each pair [m]
    ExponentialNormal(Eigen::MatrixXd stiffness, Eigen::VectorXd area, const ExponentialPressure& pressure,
                      const ContactOptions& options);

    /// @param solution  on entry states and forces of the start; without forces all pairs start at zero clearance
    ContactReport solve(const Eigen::VectorXd& stuck_force, const ContactLaw& law, ContactSolution& solution) const;

private:
    struct Step {
        const Eigen::VectorXd& stuck_force;
        const ContactLaw& law;
        double tolerance; ///< [N/m]
    };
    struct Iterate {
        ContactSolution at;
        Eigen::VectorXd point; ///< ĝ, where the law is linearised [m]
    };
    /// λ_n = constant - tangent g.
    struct Tangent {
        Eigen::VectorXd stiffness; ///< D [N/m²]
        Eigen::VectorXd constant;  ///< [N/m]
    };
    Iterate start(const ContactSolution& given) const;
    Tangent tangent(const Eigen::VectorXd& point) const;
    bool newton(const Step& step, Iterate& it, ContactReport& report) const;
    bool linear_solution(const Step& step, Iterate& it) const;
    double next_point(const Iterate& it, Eigen::Index pair) const;
    ContactState next_state(const Step& step, const Iterate& it, Eigen::Index pair, double point) const;
    bool renewed_tangents(const Step& step, Iterate& it, ContactReport& report) const;
    bool friction_solution(const Step& step, Iterate& it, ContactReport& report) const;
    double residual(const Step& step, const ContactSolution& at) const;

    Eigen::MatrixXd stiffness_;
    Eigen::VectorXd area_;
    ExponentialPressure pressure_;
    ContactOptions options_;
};

/// Tangential penalty of constant stiffness in front of Coulomb's law: a sticking pair gives way by -λ_t / (k A), the
/// slip is what goes beyond it. The same contact problem with V' = V (I + C V)⁻¹ = (W + C)⁻¹, so the penalty's error is
/// what a run with and a run without it differ by. At k = 2e8 N/m³ (about a slip tolerance of 0.005 with 0.5 m
/// elements) it puts a spring near the first frequency under the dam; from 1e11 on it changes the slip by less than 1 %.
class ElasticStick {
public:
    ElasticStick() = default;
    /// @param stiffness   V; replaced by V'
    /// @param compliance  1/(k A) of each pair [m²/N]
    ElasticStick(Eigen::MatrixXd& stiffness, const Eigen::VectorXd& compliance);

    bool active() const { return compliance_.size() > 0; }
    /// λ⁰ of the rigid stick problem into that of V'; `elastic` is the elastic part of the tangential gaps at which λ⁰
    /// holds them, m values [m].
    void soften(Eigen::VectorXd& stuck_force, const Eigen::VectorXd& elastic) const;
    /// Elastic part of the tangential gaps, -C λ_t, m values [m].
    Eigen::VectorXd give(const Eigen::VectorXd& force) const;

private:
    Eigen::VectorXd compliance_; ///< m values
    Eigen::MatrixXd soften_;     ///< (I + V C)⁻¹
    Eigen::MatrixXd tangential_; ///< V' of the tangential gaps, 2m x m
};

} // namespace damslip::fe2d
