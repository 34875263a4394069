#pragma once

#include "fe2d/contact/contact_problem.hpp"

namespace damslip::fe2d {

/// Sweeps over the pairs, each solved exactly for its own opening and slip with the others held: always moves towards
/// a solution, slowly. Gives the Newton iteration a new start where it cycles. Ends early when a sweep changes no state
/// and no force by more than `tolerance` [N/m].
/// @returns sweeps made
int gauss_seidel(const ContactProblem& problem, ContactSolution& solution, int sweeps, double tolerance);

} // namespace damslip::fe2d
