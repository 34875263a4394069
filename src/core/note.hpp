#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// What solvers have to say of their results, as data: which sentence, and its numbers. The sentences themselves are one table
/// (note.cpp), as the words of a status are.
namespace damslip {

enum class NoteKind {
    // rigid blocks
    events_not_run,
    floats_statically,
    slides_statically_downstream,
    slides_statically_upstream,
    still_sliding,
    many_events,
    many_events_of_rate,
    rate_by_series,
    slip_by_series,
    crack_water_carries,
    crack_water_late,
    base_opened,
    base_flew,
    rest_after,
    rest_falls,
    known_to,
    trapezoid_scheme,
    trapezoid_still_sliding,
    turned_over,
    still_moving,
    jammed_corner,
    many_events_at,
    lost_weight,
    still_vibrating,
    vibration_not_followed,
    wedge_slides,
    beyond_its_plane,
    beyond_its_plane_in,
    tips_before_sliding,
    tips_only,
    strain_not_settled,
    // equilibrium
    yield_force_counts,
    uplift_carries_block,
    opens_wholly,
    cracked_through,
    tension_without_crack,
    shear_beyond_strength,
    k_h_full,
    k_h_share,
    k_v_zero,
    k_v_share,
    // linear equations, damping, seepage, runs without sliding
    factorised,
    not_factorised,
    not_positive_definite,
    singular,
    inaccurate,
    out_of_memory,
    mode_missing,
    damping_of_modes,
    damping_given,
    no_mode_to_damp,
    no_mode_found,
    modes_lack_mass,
    no_second_frequency,
    suction,
    seepage_box,
    seepage_failed,
    drain_line,
    explicit_limit,
    explicit_limit_damped,
    explicit_steps,
    modes_exact,
    modes_coupled,
    modes_left_out,
    not_finite,
    stopped_by_user,
    steps_done,
    // stages
    stage_holds,
    stage_jumped,
    stage_slides,
    stage_floats,
    stage_crack_floats,
    stage_overturns,
    stage_progressive,
    stage_progressive_jumped,
    stage_not_resolved,
    // earthquake by finite elements
    in_record,
    part_not_held,
    rock_cannot_radiate,
    rock_gate_missed,
    water_gate_missed,
    water_not_reduced,
    damping_mode_missing,
    step_not_factorised,
    interrupted_refining,
    slip_at_rest,
    slip_of_modes,
    slip_of_modes_error,
    largest_slip_open,
    run_still_sliding,
    would_stand,
    self_excited,
    self_excited_no_friction,
    lift_offs,
    no_slip_give_rock,
    no_slip_let_radiate,
    no_slip_free_edge,
    no_slip_radiates,
    contact_unresolved,
    interrupted,
    beyond_mesh,
    scheme_gained,
    contact_gained,
    not_a_number,
    runs_away,
    friction_gave_back,
    records_not_run,
    records_after_not_run,
    rate_needs_steps,
    modes_not_found,
    modes_need_small_slip,
    modes_need_free_rock
};

using NoteValue = std::variant<std::int64_t, double, std::string>;

/// One sentence as data.
struct Note {
    NoteKind kind;
    std::vector<NoteValue> values = {}; ///< in the order and units of its sentence: a name, a count, a number

    bool operator==(const Note&) const = default;
};

std::string_view sentence_of(NoteKind kind);       ///< with a place in braces for each value
std::string text_of(const Note& note);             ///< the sentence with its values
std::string text_of(std::span<const Note> notes);  ///< one after the other

} // namespace damslip
