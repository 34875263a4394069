#pragma once

#include "scene/scene.hpp"

#include <string>

/// Implicit one-step schemes of the Newmark family and their constants.
namespace damslip::fe2d {

/// M a₁ + (1+α)(C v + K u - R)₁ - α (C v + K u - R)₀ = 0 with Newmark's assumptions
///
///     u₁ = u₀ + Δt v₀ + Δt² [(½ - β) a₀ + β a₁]        Newmark (1959); (2-9)
///     v₁ = v₀ + Δt [(1 - γ) a₀ + γ a₁]                 (2-10)
///
/// α = 0: Newmark. α < 0: Hilber, Hughes & Taylor (1977), (2-25)...(2-27), damps what the step does not resolve.
struct Scheme {
    double alpha = 0.0; ///< weight of the previous state, -1/3 ... 0 [-]
    double gamma = 0.5; ///< [-]; 1/2: second order, no first-order algorithmic damping
    double beta = 0.25; ///< [-]
    bool unconditionally_stable() const { return 2.0 * beta >= gamma; } ///< for γ >= 1/2; Hughes (1987), table 9.1.1
};

/// γ = ½ - α, β = (1 - α)²/4: second order and unconditionally stable for -1/3 <= α <= 0.
/// @throws InputError for another α.
Scheme hht(double alpha);

/// @throws InputError unless ½ <= γ <= 1 and 0 < β <= 1 (γ < ½ gains energy at any step; β = 0 is explicit, another
/// method).
Scheme newmark(double gamma, double beta);

Scheme average_acceleration(); ///< γ = ½, β = ¼: no numerical damping at all
Scheme linear_acceleration();  ///< γ = ½, β = 1/6: stable for Δt/T <= √12/2π = 0.551 only

/// The implicit scheme of a scene: Newmark's where it says so, else HHT (what "auto" takes where it takes no modes;
/// "central-difference" and "modal" are no members of this family). @throws InputError naming the key that is out of range.
Scheme scheme_of(const TimeOptions& options);

/// Largest stable ω Δt [-] for every damping ratio, 1/√(γ/2 - β) (undamped, γ = ½; Hughes 1987, eq. 9.1.20; damping
/// widens it for γ > ½). Infinite when unconditionally stable.
double stability_limit(const Scheme& scheme);

/// @param highest_frequency  largest ω of the model [rad/s]; infinite with massless nodes
/// @throws InputError when Δt <= 0 or ω Δt exceeds the limit, with the largest allowed step.
void check_step(const Scheme& scheme, double dt, double highest_frequency);

/// What the equations of one step are made of. With Δu = u₁ - u₀:
///
///     a₁ = a0 Δu - a2 v₀ - a3 a₀,   v₁ = a1 Δu - a4 v₀ - a5 a₀
///
/// a0 = 1/(βΔt²), a1 = γ/(βΔt), a2 = 1/(βΔt), a3 = 1/(2β) - 1, a4 = γ/β - 1, a5 = Δt(γ/(2β) - 1).
/// The printed (2-20), (2-22) have u instead of Δu and C/(βΔt) instead of a1 C; both follow wrongly from (2-18),
/// (2-19).
struct StepConstants {
    Scheme scheme;
    double dt = 0.0; ///< [s]
    double a0 = 0.0; ///< [1/s^2]
    double a1 = 0.0; ///< [1/s]
    double a2 = 0.0; ///< [1/s]
    double a3 = 0.0; ///< [-]
    double a4 = 0.0; ///< [-]
    double a5 = 0.0; ///< [s]
};

StepConstants step_constants(const Scheme& scheme, double dt);

} // namespace damslip::fe2d
