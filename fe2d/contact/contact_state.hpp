#pragma once

#include <vector>

namespace damslip::fe2d {

/// State of one pair of nodes of a contact plane. g_N: opening, s: slip in the step, positive downstream; λ_n: contact
/// force pressing the two sides apart (effective compression), λ_t: shear force on the upper side, positive downstream.
enum class ContactState : unsigned char {
    stick,           ///< g_N = 0, s = 0, |λ_t| <= c + mu λ_n
    slip_downstream, ///< g_N = 0, s > 0, λ_t = -(c + mu λ_n)
    slip_upstream,   ///< g_N = 0, s < 0, λ_t = +(c + mu λ_n)
    open,            ///< g_N > 0, λ_n = 0, λ_t = 0; water pressure, a load, stays
    pulled           ///< without separation only: g_N = 0, λ_n < 0, λ_t = 0
};

using ContactStates = std::vector<ContactState>; ///< one per pair

inline bool is_slip(ContactState state)
{
    return state == ContactState::slip_downstream || state == ContactState::slip_upstream;
}

} // namespace damslip::fe2d
