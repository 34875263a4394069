#pragma once

#include "fe2d/run/contact_structure.hpp"

#include <optional>

namespace damslip::fe2d {

/// Lowest natural frequencies of the dam bonded to its massless rock, or to a rigid base, ascending [rad/s]: those of
/// natural_modes() of the same structure built tied, from the factor of the dam and the condensed rock that are there already.
///
/// Lanczos on K⁻¹M in the product of M with every vector made orthogonal again; with [r, r²/gap] of Kato and Temple the
/// relative error of 1/ω² is 1e-13 at most.
///
/// @param structure  of one plane, without acoustic water, each dam node opposite one of the rock's, the mass consistent
/// @returns nothing where the structure is another or `count` have not converged: natural_modes() then tells more
std::optional<Eigen::VectorXd> tied_frequencies(const ContactStructure& structure, int count);

} // namespace damslip::fe2d
