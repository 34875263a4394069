#pragma once

#include "fe2d/contact/contact_solver.hpp"

namespace damslip::fe2d {

/// Coulomb's law behind elastic slip whose stiffness follows the pressure (Goldgruber 2015, 4-10 to 4-12): a pair in
/// compression carries
///
///     λ_t = -(c + mu λ_n) e / γ_e,   |e| <= γ_e
///
/// e is the elastic slip, which the pair remembers; what goes beyond γ_e is slip. Falling pressure takes shear away
/// from a pair that does not move, so the law is neither symmetric nor conservative. An open pair forgets its e.
///
/// Same V and λ⁰ as the contact problem, of which it is the limit γ_e -> 0. Newton on states and mobilised share e/γ_e
/// together; where that does not end, stiffnesses (c + mu λ_n)/γ_e are held, that problem is solved exactly with all
/// safeguards of ContactSolver, and the stiffnesses are renewed until they repeat themselves.
class SlipTolerance {
public:
    /// @param stiffness     V, kept by reference
    /// @param elastic_slip  γ_e of each pair, > 0 [m]
    SlipTolerance(const Eigen::MatrixXd& stiffness, Eigen::VectorXd elastic_slip, const ContactOptions& options);

    /// @param elastic   e of the pairs at the start, and at the end [m]
    /// @param solution  on entry states and, if there, forces of the start; its slips are net of the elastic ones
    ContactReport solve(const Eigen::VectorXd& stuck_force, const ContactLaw& law, Eigen::VectorXd& elastic,
                        ContactSolution& solution);

private:
    /// Whole steps of the gaps, slip and elastic slip together, in `displacement`.
    using Iterate = ContactSolution;
    struct Step {
        const Eigen::VectorXd& stuck_force;
        const ContactLaw& law;
        const Eigen::VectorXd& elastic; ///< at the start
        double tolerance;               ///< [N/m]
    };
    bool newton(const Step& step, Iterate& iterate, ContactReport& report) const;
    bool linear_solution(const Step& step, Iterate& iterate) const;
    ContactState next(const Step& step, const Iterate& iterate, Eigen::Index pair) const;
    bool renewed_stiffness(const Step& step, Iterate& iterate, ContactReport& report) const;
    double residual(const Step& step, const Iterate& iterate) const;

    const Eigen::MatrixXd& stiffness_;
    Eigen::VectorXd limit_; ///< γ_e
    ContactOptions options_;
};

} // namespace damslip::fe2d
