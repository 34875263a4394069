#pragma once

#include "fe2d/contact/contact_solver.hpp"
#include "fe2d/contact/exponential_pressure.hpp"

namespace damslip::fe2d {

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

} // namespace damslip::fe2d
