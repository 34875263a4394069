#pragma once

#include "fe2d/time/condensation.hpp"

#include <map>
#include <memory>

/// One time step is: free_step (predict, right-hand side, solve) -> interface forces found by the caller -> finish_step
/// (correct).
namespace damslip::fe2d {

/// Motion and forces at one instant, all of length n. Filled by LinearIntegrator only, so the products belong to the
/// motion.
struct State {
    double time = 0.0;               ///< [s]
    Eigen::VectorXd displacement;    ///< u [m]
    Eigen::VectorXd velocity;        ///< v [m/s]
    Eigen::VectorXd acceleration;    ///< a [m/s^2]; of massless unknowns: bookkeeping of the scheme, no physical value
    Eigen::VectorXd load;            ///< R, static loads and ground motion [N/m]
    Eigen::VectorXd interface_force; ///< Bᵀλ [N/m]; zero without contact
    Eigen::VectorXd stiffness_force; ///< K u [N/m]
    Eigen::VectorXd damping_force;   ///< C v [N/m]
    Eigen::VectorXd momentum;        ///< M v [N s/m^2]
    Eigen::VectorXd inertia_force;   ///< M a [N/m]
    Eigen::VectorXd unbalanced;      ///< F = C v + K u - R - Bᵀλ [N/m]
    Eigen::VectorXd unbalanced_before; ///< F of the state one step earlier [N/m]; of the first state: its own F
};

/// The step as it would be without interface forces at its end; -α Bᵀλ₀ of its start is already in it.
struct FreeStep {
    Eigen::VectorXd increment; ///< u* - u₀ [m]
};

/// What contact adds to a free step.
struct InterfaceForces {
    Eigen::VectorXd force;        ///< Bᵀ λ₁ [N/m]
    Eigen::VectorXd displacement; ///< A⁻¹ Bᵀ λ₁ [m], from StepOperator::solve or flexibility().response
};

class LinearIntegrator {
public:
    LinearIntegrator(LinearSystem system, Scheme scheme, const SolverOptions& solver = {});

    const LinearSystem& system() const { return system_; }
    const Scheme& scheme() const { return scheme_; }

    /// State at the start: M a₀ = R₀ + Bᵀλ₀ - C v₀ - K u₀ on the unknowns with mass. A massless unknown gets a₀ = 0;
    /// its equation C v₀ + K u₀ = R₀ + Bᵀλ₀ holds only if u₀, v₀ satisfy it: see massless_imbalance().
    /// @param interface_force  Bᵀλ₀, e.g. of the static state; empty: zero
    State start(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity, const Eigen::VectorXd& load,
                const Eigen::VectorXd& interface_force = {}) const;

    /// State with an acceleration given from elsewhere, in equilibrium or not (unbalanced_before as if it were).
    State state(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity,
                const Eigen::VectorXd& acceleration, const Eigen::VectorXd& load,
                const Eigen::VectorXd& interface_force = {}) const;

    /// Largest unbalanced force on a massless unknown over the largest force of the state [-]; 0 without massless
    /// unknowns.
    double massless_imbalance(const State& state) const;

    /// The operator of a step size, factorised on first use and kept. Returned references stay valid.
    const StepOperator& step_operator(double dt);
    std::size_t factorisations() const { return operators_.size(); }

    /// A Δu* = (1+α)R₁ - αR₀ - αBᵀλ₀ - K u₀ + αC v₀ + M(a2 v₀ + a3 a₀) + (1+α)C(a4 v₀ + a5 a₀), with
    /// A = a0 M + (1+α)(a1 C + K): (2-25) with Newmark's assumptions put in. `before` is not changed: a step can be
    /// redone.
    FreeStep free_step(const StepOperator& step, const State& before, const Eigen::VectorXd& load_after) const;

    /// u₁ = u* + (1+α) A⁻¹Bᵀλ₁ and everything that follows from it. `after` is overwritten (its memory is used again)
    /// and must not be `before`.
    void finish_step(const StepOperator& step, const State& before, const Eigen::VectorXd& load_after,
                     const FreeStep& free, const InterfaceForces& interface, State& after) const;
    /// The same without interface forces.
    void finish_step(const StepOperator& step, const State& before, const Eigen::VectorXd& load_after,
                     const FreeStep& free, State& after) const;

private:
    void update(const StepOperator& step, const State& before, State& after) const;
    void fill_products(State& state) const;

    LinearSystem system_;
    Scheme scheme_;
    SolverOptions solver_;
    std::vector<char> massless_;
    std::map<double, std::unique_ptr<StepOperator>> operators_; ///< by step size [s]
};

} // namespace damslip::fe2d
