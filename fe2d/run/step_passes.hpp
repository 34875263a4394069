#pragma once

#include "core/version.hpp"
#include "fe2d/run/contact_motion.hpp"
#include "fe2d/time/scheme.hpp"

#include <Eigen/Core>

/// Passes over the vectors of a step that read each of them once, four numbers at a time where the processor can. Each number, and
/// each sum, is that of the same formula written with one Eigen expression after the other, to the last bit.
namespace damslip::fe2d {

/// One step of Newmark's formulas: x, v, a of the start become those of the end. @param step  Δx
void move_on(const StepConstants& constants, const Eigen::VectorXd& step, Eigen::VectorXd& x, Eigen::VectorXd& v,
             Eigen::VectorXd& a);

/// A term of a sum of vectors.
struct Term {
    double factor;
    const Eigen::VectorXd& vector;
};

/// b = b - k + l + Σ factor vector, in this order, of four terms.
void add_to_load(const Eigen::VectorXd& k, const Eigen::VectorXd& l, const Term (&terms)[4], Eigen::VectorXd& b);

/// b = load + w (h₁ x - v₁ y) - α (h₀ x - v₀ y), w = 1 + α: loads at rest and by the ground's acceleration at the end (1) and the
/// start (0) of a step.
void ground_load(double alpha, const GroundAcceleration& start, const GroundAcceleration& end,
                 const Eigen::VectorXd& load, const Eigen::VectorXd& x, const Eigen::VectorXd& y, Eigen::VectorXd& b);

/// g = h x - v y, f = d m + k - load - g: the ground's load at one instant, and the forces of the equation of motion.
void instant_forces(const GroundAcceleration& ground, double d, const Eigen::VectorXd& x, const Eigen::VectorXd& y,
                    const Eigen::VectorXd& m, const Eigen::VectorXd& k, const Eigen::VectorXd& load, Eigen::VectorXd& g,
                    Eigen::VectorXd& f);

/// What the work ledger multiplies of the dam in one step; water left out of all but the products.
struct WorkVectors {
    const Eigen::VectorXd& step;                                          ///< Δu
    const Eigen::VectorXd &velocity, &velocity_before, &velocity_before2; ///< v₁, v₀, v₋₁
    const Eigen::VectorXd &accel, &accel_before;                          ///< a₁, a₀
    const Eigen::VectorXd &force, &force_before2;                         ///< of the equation of motion, F₁, F₋₁
    const Eigen::VectorXd &ground, &ground_before;                        ///< loads by the moving ground
    const Eigen::VectorXd& load;                                          ///< at rest
    const Eigen::VectorXd &stiffness, &stiffness_before;                  ///< K u₁, K u₀
    const Eigen::VectorXd& mass_rate;                                     ///< M v₁
    const Eigen::VectorXd &mass_accel, &mass_accel_before;                ///< M a₁, M a₀
    const Eigen::VectorXd &dam_mass_rate, &dam_mass_rate_before;          ///< M_dam v₁, M_dam v₀
};

/// Their inner products, ΔKu = K u₁ - K u₀ and so on.
struct WorkSums {
    double kinetic = 0.0;                       ///< v₁ · M v₁
    double mass_damping = 0.0;                  ///< Δu · (M_dam v₁ + M_dam v₀)
    double stiffness_damping = 0.0;             ///< ΔKu · (v₁ + v₀)
    double load = 0.0, ground = 0.0;            ///< Δu · R, Δu · (R_g1 + R_g0)
    double step_inertia = 0.0;                  ///< Δu · ΔMa
    double change_inertia = 0.0;                ///< Δa · ΔMa
    double inertia = 0.0, inertia_before = 0.0; ///< a₁ · M a₁, a₀ · M a₀
    double force = 0.0, force_before2 = 0.0;    ///< Δu · F₁, Δu · F₋₁
    double rate = 0.0, rate_before2 = 0.0;      ///< v₁ · ΔKu, v₋₁ · ΔKu
    friend bool operator==(const WorkSums&, const WorkSums&) = default;
};

/// @param level  the same bits on every level
WorkSums work_sums(const WorkVectors& vectors, VectorLevel level = vector_level());

} // namespace damslip::fe2d
