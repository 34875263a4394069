#pragma once

/// Errors one could make, to prove that the verification would see them (docs/sabotage.md). A program has at most one,
/// and only where its source is compiled with -DDAMSLIP_DEFECT=<name> (tests/sabotage); elsewhere `defect()` is false
/// at compile time and nothing of it remains.
namespace damslip {

enum class Defect {
    none,
    sign_of_a_v,         ///< vertical acceleration positive down in the rigid block
    polarity,            ///< a_h positive downstream in the FE run
    gamma_missing_in_c,  ///< C/(βΔt) for γ C/(βΔt), as printed in (2-20), (2-22)
    total_for_increment, ///< u for Δu in the new acceleration, as printed there
    lambda_unweighted,   ///< contact forces of the step's start left out: (1+α)λ₁ for (1+α)λ₁ - αλ₀
    stiffness_damping_in_contact, ///< b_K acts through the contact springs too
    drag_on_rigid_slip,           ///< mass damping resists the sliding
    friction_on_pulled_pairs,     ///< pairs in tension carry shear
    fluid_rows_unscaled,   ///< the water's rows of the coupling without the factor that makes the system symmetric
    uplift_on_one_face,    ///< water in the joint presses on the dam, not on the rock
    log_missing_in_jibson, ///< a_y for log10 a_y in Jibson et al. (1998), as printed in (4-9)
    run_out_off            ///< the rigid block stops with the record
};

#ifdef DAMSLIP_DEFECT
constexpr bool defect(Defect which)
{
    return which == Defect::DAMSLIP_DEFECT;
}
#else
constexpr bool defect(Defect)
{
    return false;
}
#endif

} // namespace damslip
