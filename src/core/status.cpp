#include "core/status.hpp"

#include "core/text.hpp"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <string_view>

namespace damslip {

namespace {

using enum Status;

constexpr std::array rows{
    StatusRow{at_rest, "at rest", exit_ok, SlipMeaning::final, Judging::by_slip,
              "The dam came to rest (or never moved): the slip is final.", ""},
    StatusRow{sliding_at_end, "sliding at end", exit_ok, SlipMeaning::lower_bound, Judging::fails,
              "Still sliding when the run-out ended: the slip is a lower bound.",
              "lengthen sliding.run_out_max_s to see whether it comes to rest"},
    StatusRow{static_failure, "static failure", exit_ok, SlipMeaning::none, Judging::fails,
              "Slides without any earthquake: the friction that would hold it is above the given one.",
              "raise the resistance: friction, cohesion, drains, weight"},
    StatusRow{overturns, "overturns", exit_ok, SlipMeaning::none, Judging::fails,
              "Tips over without any earthquake: the resultant of the static loads acts outside the base.",
              "check section, water levels and uplift"},
    StatusRow{floats, "floats", exit_ok, SlipMeaning::none, Judging::fails,
              "The uplift carries more than the weight: no friction would hold it.", "check uplift, levels and weight"},
    StatusRow{runs_away, "runs away", exit_ok, SlipMeaning::none, Judging::fails,
              "Slid further than its own base is long, where the model no longer holds.",
              "compare the friction with the one that just holds without an earthquake"},
    StatusRow{overturned, "overturned", exit_ok, SlipMeaning::none, Judging::fails,
              "Rocked over its toe or heel in the earthquake.", "check section, water levels and uplift"},
    StatusRow{left_plane, "left the plane", exit_no_answer, SlipMeaning::lower_bound, Judging::none,
              "Slid further than contact.max_slip_m; the rest of the record was not run.", "raise contact.max_slip_m"},
    StatusRow{self_excited, "self-excited", exit_no_answer, SlipMeaning::none, Judging::none,
              "Goes on sliding by itself with the ground at rest, although it would stand.",
              "let the rock radiate ([foundation] with mass); the message names the change"},
    StatusRow{rocks_first, "rocks first", exit_no_answer, SlipMeaning::none, Judging::none,
              "Would tip before it slides, and the motion reaches that: the sliding block is no model of it.",
              "take the block that rocks and slides: screen, sweep --method rocking; or finite elements"},
    StatusRow{tolerance_missed, "tolerance missed", exit_no_answer, SlipMeaning::final, Judging::none,
              "The time step leaves more of the slip open than time.slip_tolerance allows.",
              "give a smaller time.dt_s, or a larger time.slip_tolerance"},
    StatusRow{not_resolved, "not resolved", exit_no_answer, SlipMeaning::none, Judging::none,
              "The solver found no answer; this says nothing of the dam.",
              "refine mesh or step, or see the message for the stage and its numbers"},
    StatusRow{diverged, "diverged", exit_no_answer, SlipMeaning::none, Judging::none,
              "Energy grew beyond all that the ground put in: an answer of the scheme, not of the dam.",
              "a smaller step, damping, or a more negative time.alpha"},
    StatusRow{interrupted, "interrupted", exit_no_answer, SlipMeaning::none, Judging::none,
              "Stopped on the way; what was finished is kept.", "run it again; sweeps go on with --resume"},
    StatusRow{refused, "refused", exit_input, SlipMeaning::none, Judging::none, "The method cannot take this scene.",
              "the message names what is in the way"},
};

constexpr bool in_order()
{
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].status != static_cast<Status>(i)) return false;
    return rows.size() == static_cast<std::size_t>(refused) + 1;
}
static_assert(in_order());

} // namespace

std::span<const StatusRow> status_rows()
{
    return rows;
}

const StatusRow& status_row(Status status)
{
    return rows[static_cast<std::size_t>(status)];
}

std::string word(Status status)
{
    return std::string(status_row(status).word);
}

std::optional<Status> status_of_word(std::string_view word)
{
    const auto at = std::find_if(rows.begin(), rows.end(), [&](const StatusRow& row) { return row.word == word; });
    return at == rows.end() ? std::nullopt : std::optional(at->status);
}

int worse_exit_code(int a, int b)
{
    return std::max(a, b);
}

bool is_answer(Status status)
{
    return status_row(status).exit_code == exit_ok;
}

bool fails_statically(Status status)
{
    return status == static_failure || status == overturns || status == floats;
}

std::optional<double> reported(Status status, double slip)
{
    if (status_row(status).slip == SlipMeaning::none || !std::isfinite(slip)) return std::nullopt;
    return slip;
}

std::string word(Verdict verdict)
{
    constexpr std::array words{"PASS", "FAIL", "undecided", "–"}; // in the order of the enumeration
    return words[static_cast<std::size_t>(verdict)];
}

std::string judge_events(Status whole, double length, std::vector<EventSlip>& events)
{
    bool over = false;
    std::string ends_in;
    for (EventSlip& event : events) {
        over = over || whole == Status::rocks_first || &event == &events.back() ||
               (whole == Status::runs_away && std::abs(event.slip) > length);
        event.status = over ? whole : Status::at_rest;
        if (over && ends_in.empty() && !reported(whole, 0.0)) ends_in = event.name;
    }
    return ends_in;
}

Verdict judge(Status status, double slip, double error, const std::optional<double>& allowable)
{
    const StatusRow& row = status_row(status);
    if (row.judging == Judging::none) return Verdict::none;
    if (row.judging == Judging::fails) return Verdict::fail;
    if (!allowable) return Verdict::none;
    const double size = std::abs(slip);
    if (size + error <= *allowable) return Verdict::pass; // false where the error is NaN
    if (size - error > *allowable) return Verdict::fail;
    return Verdict::undecided;
}

std::size_t StatusCount::all() const
{
    return std::accumulate(count_.begin(), count_.end(), std::size_t{0});
}

std::string StatusCount::words() const
{
    std::string words;
    for (const StatusRow& row : status_rows())
        if (const std::size_t n = count_[static_cast<std::size_t>(row.status)]; n > 0)
            words += fmt::format("{}{} {}", words.empty() ? "" : ", ", n, row.word);
    return words;
}

int StatusCount::exit_code() const
{
    int code = exit_ok;
    for (const StatusRow& row : status_rows())
        if (count_[static_cast<std::size_t>(row.status)] > 0) code = worse_exit_code(code, row.exit_code);
    return code;
}

namespace {

/// A number or a count of a note. Without digits in the sentence it is written with as many as it has.
struct Number {
    double value;
    bool whole = false;
};

} // namespace

} // namespace damslip

template <>
struct fmt::formatter<damslip::Number> : fmt::formatter<double> {
    constexpr auto parse(format_parse_context& context)
    {
        plain = context.begin() == context.end() || *context.begin() == '}';
        return fmt::formatter<double>::parse(context);
    }
    auto format(const damslip::Number& number, format_context& context) const
    {
        if (std::isinf(number.value)) return fmt::format_to(context.out(), "{}∞", number.value < 0.0 ? "-" : "");
        if (plain && number.whole) return fmt::format_to(context.out(), "{:.0f}", number.value);
        if (plain) return fmt::format_to(context.out(), "{}", damslip::shortest(number.value));
        return fmt::formatter<double>::format(number.value, context);
    }
    bool plain = false;
};

namespace damslip {

namespace note_text {

struct Sentence {
    NoteKind kind;
    std::string_view text;
    std::string_view one = {}; ///< in its place where the first count is 1
};

using enum NoteKind;

/// In the order of NoteKind.
constexpr auto sentences = std::to_array<Sentence>({
    {events_not_run, "The block did not come to rest after \"{}\": {} events of the sequence not run.",
     "The block did not come to rest after \"{}\": {} event of the sequence not run."},
    {floats_statically, "The uplift carries more than the weight (N' = {} N/m): the block floats without an earthquake; no "
                        "friction would hold it."},
    {slides_statically_downstream, "The block slides downstream without an earthquake; a friction of {} or more would hold it "
                                   "(here {}). The slip is the one up to the record's end."},
    {slides_statically_upstream, "The block slides upstream without an earthquake; a friction of {} or more would hold it "
                                 "(here {}). The slip is the one up to the record's end."},
    {still_sliding, "Still sliding {} s after the record's end: the slip is a lower bound."},
    {many_events, "More events in one sample interval than a motion can have; the slip up to {} s is given."},
    {many_events_of_rate, "More events in one sample interval than a motion can have; the slip up to {} s is given. Friction "
                          "follows the rate within v_c = {} m/s: give a larger contact.characteristic_rate."},
    {rate_by_series, "Friction over the rate of slip: Taylor series to round-off, events located within 1e-10."},
    {slip_by_series, "Friction linear in slip under a varying normal force has no closed form: Taylor series to round-off, "
                     "events located within 1e-10."},
    {crack_water_carries, "The water in the crack that its sliding opens carries the whole block (N' = {} N/m at rest, uplift "
                          "up to {} N/m more): nothing resists while it slides."},
    {crack_water_late, "Water that needs time to come into the crack: with {} m/s it came {} m far at most."},
    {base_opened, "The base opened {} times (N' = 0); lift-off is treated as loss of resistance without flight."},
    {base_flew, "The base opened {} times (N' = 0); lift-off is treated as ballistic flight."},
    {rest_after, "After \"{}\": full head on the {:.3g} m that have cracked from the {}, uplift {:.4g} MN/m in the place of "
                 "{:.4g}."},
    {rest_falls, "It does not stand there: the sequence ends."},
    {known_to, "Its slip is known to {} mm, by a table of this water of half the resolution."},
    {trapezoid_scheme,
     "SLAMMER's trapezoid scheme: second order in the time step, no run-out; the default scheme is exact."},
    {trapezoid_still_sliding,
     "Still sliding at the record's end, where this scheme stops: the slip is a lower bound."},
    {turned_over, "It turns by 90 degrees at {:.4g} s."},
    {still_moving, "Still moving {} s after the record's end: the slip is a lower bound."},
    {jammed_corner,
     "Friction holds the corner that slides however hard it is driven (Painlevé's paradox) at {} s."},
    {many_events_at, "More events in one sample interval than a motion can have at {} s."},
    {lost_weight, "The block lost its weight {} times (N' = 0): no resistance then, and no flight."},
    {still_vibrating,
     "Still vibrating {} s after the record's end, enough to slide again: the slip is a lower bound."},
    {vibration_not_followed, "The block slides or floats without an earthquake: its vibration is not followed."},
    {wedge_slides, "The wedge slides without an earthquake. The slip is the one up to the record's end."},
    {beyond_its_plane, "It slides further than the {:.4g} m it slides on: no slip is given."},
    {beyond_its_plane_in, "In \"{}\" it slides further than the {:.4g} m it slides on: no slip is given."},
    {tips_before_sliding, "It tips at {:.3g} g, before it would slide at {:.3g} g: the sliding block does not hold; take the "
                          "block that rocks and slides."},
    {tips_only, "It tips at {:.3g} g, and would not slide: the sliding block does not hold; take the block that rocks and "
                "slides."},
    {strain_not_settled,
     "the strain of the column does not settle: V_s {:.4g} m/s, strain {:.3g} % after {} iterations"},

    {yield_force_counts, "{} counts with its yield force, which it has after {:.3g} mm of slip"},
    {uplift_carries_block, "no effective normal force is left: the uplift carries the block"},
    {opens_wholly,
     "no equilibrium without tension: the joint opens over the whole base and the block tips or rocks"},
    {cracked_through, "cracked through: what is left, {:.3g} m of {:.4g} m, would be pressed by {:.3g} MPa"},
    {tension_without_crack, "tension across the base, no crack considered"},
    {shear_beyond_strength, "slides: the shear exceeds the strength"},
    {k_h_full, "k_h is the largest PGA of the records in full (criteria.pga_fraction)"},
    {k_h_share, "k_h is {:.3g} of the largest PGA of the records (criteria.pga_fraction)"},
    {k_v_zero, "k_v is 0 although the records have a vertical component of up to {:.3g} g (criteria.pga_v_fraction)"},
    {k_v_share,
     "k_v is {:.3g} of their largest vertical acceleration and lightens the dam (criteria.pga_v_fraction)"},

    {factorised, "Factorised: {} unknowns, {} non-zeros in the factor, residual {:.1e}."},
    {not_factorised, "Nothing has been factorised yet."},
    {not_positive_definite, "The matrix ({} unknowns) is not positive definite: the structure is a mechanism."},
    {singular, "The matrix ({} unknowns, {} non-zeros in the factor) is singular: smallest pivot {:.1e} of a unit diagonal."},
    {inaccurate, "The factorisation ({} unknowns, {} non-zeros in the factor) is inaccurate: residual {:.1e}, error {:.1e}."},
    {out_of_memory, "Out of memory while factorising {} unknowns."},
    {mode_missing, "damping: mode {} was not found, mode {} takes its place"},
    {damping_of_modes, "damping: {:g} % at {:.4g} and {:.4g} Hz, a_M = {:.4g} 1/s, b_K = {:.4g} s"},
    {damping_given, "damping: as given, a_M = {:.4g} 1/s, b_K = {:.4g} s"},
    {no_mode_to_damp, "damping: no natural mode was found, the model is not damped; {}"},
    {no_mode_found, "no natural mode was found; {}"},
    {modes_lack_mass, "modified Rayleigh damping: {} modes carry {:.1f} % of the horizontal mass; at least {:.0f} % are "
                      "needed, use more modes"},
    {no_second_frequency, "modified Rayleigh damping: no second frequency between {0:.3g} and {1:.3g} Hz balances the base "
                          "shear; ordinary Rayleigh damping on {0:.3g} and {2:.3g} Hz is used, which changes the base shear "
                          "by |dS| = {3:.3g} kN/m ({4:.1f} %)"},
    {suction, "seepage: suction down to {:.3g} kPa under the base is taken as zero pressure"},
    {seepage_box, "seepage: no [foundation]; a box of {:.4g} m x {:.4g} m (300/45 x 100/45 base lengths) with permeability "
                  "{:g} m/s is used"},
    {seepage_failed, "seepage: {}"},
    {drain_line, "seepage: drains at {:.3g} m are a line {:.3g} m deep held at a head of {:.4g} m"},
    {explicit_limit, "central difference, lumped mass: stable up to {:.5g} s, highest frequency {:.5g} Hz"},
    {explicit_limit_damped, "central difference, lumped mass: stable up to {0:.5g} s ({2:.4g} s without stiffness damping, "
                            "which acts half a step late), highest frequency {1:.5g} Hz"},
    {explicit_steps, "steps of {:.4g} s, rows of the history every {:g} s"},
    {modes_exact, "superposition of {} modes up to {:.4g} Hz with {:.4g} % (x) and {:.4g} % (y) of the mass, exact in time"},
    {modes_coupled, "superposition of {} modes up to {:.4g} Hz with {:.4g} % (x) and {:.4g} % (y) of the mass, exact in time; "
                    "the undamped added mass couples them (largest {:.2g}), solved together"},
    {modes_left_out, "modes left out follow the ground statically; their motion is estimated at {:.2g} % of the peak crest x, "
                     "{:.2g} % of its acceleration, {:.2g} % of the base shear"},
    {not_finite, "not finite after step {} at {:.4g} s"},
    {stopped_by_user, "stopped by the user at {:.4g} s of {:.4g} s; results up to there are kept"},
    {steps_done, "{} steps of {:g} s, {} unknowns"},

    {stage_holds, "{}: in equilibrium, N' = {:.5g} MN/m, T = {:.5g} MN/m, mean slip {:.3g} mm, open length {:.3g} m, mu needed "
                  "{:.5f}."},
    {stage_jumped, "It jumped there {} times: part of the bond broke at once, {:.3g} J/m lost.",
     "It jumped there {} time: part of the bond broke at once, {:.3g} J/m lost."},
    {stage_slides, "{}: {} slides without any earthquake, N' = {:.5g} MN/m, T = {:.5g} MN/m: it holds with mu >= {:.5f}."},
    {stage_floats, "{}: {} floats, N' = {:.5g} MN/m, T = {:.5g} MN/m: uplift exceeds all weight."},
    {stage_crack_floats,
     "{}: {} floats, N' = {:.5g} MN/m, T = {:.5g} MN/m: the water in the crack carries all weight."},
    {stage_overturns, "{}: {} overturns, N' = {:.5g} MN/m, T = {:.5g} MN/m: the resultant acts {:.5g} m from the {}, outside "
                      "the {}."},
    {stage_progressive, "{}: the bond breaks progressively and does not carry the load, N' = {:.5g} MN/m, T = {:.5g} MN/m: no "
                        "state was found in equilibrium under more than {:.4g} of the stage's load, {:.3g} with all strength "
                        "at once, and released the dam does not come to rest; give more strength or fracture energy."},
    {stage_progressive_jumped, "{}: the bond breaks progressively and does not carry the load, N' = {:.5g} MN/m, T = {:.5g} "
                               "MN/m: no state was found in equilibrium under more than {:.4g} of the stage's load, {:.3g} "
                               "with all strength at once, and released at {:.4g}, after {} jumps, the dam does not come to "
                               "rest; give more strength or fracture energy.",
     "{}: the bond breaks progressively and does not carry the load, N' = {:.5g} MN/m, T = {:.5g} MN/m: no state was found in "
     "equilibrium under more than {:.4g} of the stage's load, {:.3g} with all strength at once, and released at {:.4g}, after "
     "{} jump, the dam does not come to rest; give more strength or fracture energy."},
    {stage_not_resolved, "{}: not resolved: the solver found no contact state in {} iterations, which says nothing of the dam; "
                         "N' = {:.5g} MN/m, T = {:.5g} MN/m, mu needed by these resultants {:.5f}."},

    {in_record, "In \"{}\":"},
    {part_not_held, "The stiffness of dam or rock could not be factorised: a part is not held."},
    {rock_cannot_radiate, "Radiating rock: {}. Check [foundation], or write  mass = \"massless\"."},
    {rock_gate_missed, "The radiating rock's reduction errs by {:.2g} %, {:.2g} % are allowed: give a smaller "
                       "foundation.wave_frequency_Hz."},
    {water_gate_missed,
     "The acoustic water's reduction errs by {:.2g} %, {:.2g} % are allowed: run without --reduced."},
    {water_not_reduced, "The acoustic water cannot be reduced ({}): run  damslip fe  without --reduced."},
    {damping_mode_missing, "Rayleigh damping needs mode {}, and {} were found."},
    {step_not_factorised, "The equations of a step of {:.4g} s could not be factorised."},
    {interrupted_refining, "Interrupted with sub-steps of {:.4g} s; slip {:.4g} mm with {:.4g} s."},
    {slip_at_rest, "Slip {:.4g} mm, at rest at {:.2f} s."},
    {slip_of_modes, "Slip {:.4g} mm with {} elastic modes."},
    {slip_of_modes_error, "Slip {:.4g} mm ± {:.2g} mm with {} elastic modes."},
    {largest_slip_open, "Largest slip on the {} {:.4g} mm ± {:.3g} mm with steps of {:.4g} s: more than time.slip_tolerance = "
                        "{:.3g} allows. Give a smaller time.dt_s, or a larger slip_tolerance."},
    {run_still_sliding, "Slip {:.4g} mm so far: still sliding {:.0f} s after the record's end."},
    {would_stand, "At rest it would stand, FS {:.3g}, and three windows of steady sliding, which would make it self-excited, "
                  "were not seen: lengthen sliding.run_out_max_s."},
    {self_excited, "Self-excited, slid at least {:.4g} mm: with the ground at rest it goes on at {:.3g} mm/s although it would "
                   "stand, FS {:.3g}; it slips while little presses on the base, so the static thrust does {:.3g} times the "
                   "work that friction takes and pays for the vibration."},
    {self_excited_no_friction, "Self-excited, slid at least {:.4g} mm: with the ground at rest it goes on at {:.3g} mm/s "
                               "although it would stand, FS {:.3g}; it slips while little presses on the base, so the static "
                               "thrust meets no friction and pays for the vibration."},
    {lift_offs, "{} lift-offs with the whole base open, {:.3g} a second.", "{} lift-off with the whole base open."},
    {no_slip_give_rock, "No slip can be given: give [foundation] so that the rock radiates, then  damslip fe {}  with the "
                        "options of this run."},
    {no_slip_let_radiate, "No slip can be given: let the rock radiate: delete  mass = \"massless\"  in [foundation], or run  "
                          "damslip fe {} --rock radiating  with the options of this run."},
    {no_slip_free_edge, "No slip can be given: let waves leave the rock: delete  boundary = \"fixed\"  in [foundation], then  "
                        "damslip fe {}  with the options of this run."},
    {no_slip_radiates, "No slip can be given: the rock radiates already: see whether smaller elements and steps still give it "
                       "(docs/fe-contact.md, A dam that goes on sliding)."},
    {contact_unresolved, "Contact was not resolved in {} of {} steps, largest residual {:.1e} of N'."},
    {interrupted, "Interrupted at {:.2f} s, slip so far {:.4g} mm."},
    {beyond_mesh, "Stopped at {:.2f} s: slipped {:.4g} m, beyond contact.max_slip_m = {:g} m."},
    {scheme_gained, "Stopped at {:.2f} s: the time scheme has put {:.3g} J/m into the motion. Use a smaller step, damping, or "
                    "a more negative time.alpha."},
    {contact_gained, "Stopped at {:.2f} s: contact has put {:.3g} J/m into the motion. Use a smaller step, damping, or a more "
                     "negative time.alpha."},
    {not_a_number, "Stopped at {:.2f} s: the kinetic energy is no longer a number."},
    {runs_away, "Runs away: slides further on the {} than its {:.4g} m, where the model no longer holds."},
    {friction_gave_back, "Friction gave {:.3g} J/m back, which it cannot: its force turns or ends within steps too long for "
                         "that, as where the whole base opens and closes. Use a smaller step (time.dt_s or time.substeps)."},
    {records_not_run, "{} records of the sequence were not run.", "{} record of the sequence was not run."},
    {records_after_not_run, "It had not come to rest after \"{}\": {} more of the sequence were not run.",
     "It had not come to rest after \"{}\": {} more of the sequence was not run."},
    {rate_needs_steps, "Friction over the rate needs steps below about v_c M/(N' (mu - mu_k)) = {:.3g} s, or a longer "
                       "relaxation: give a smaller time.dt_s."},
    {modes_not_found, "The dam's modes did not converge."},
    {modes_need_small_slip, "A reduced run needs small sliding: each dam node stays opposite its rock node."},
    {modes_need_free_rock, "A reduced run has no unknowns of a rock box: rock that radiates or is massless, not "
                           "foundation.boundary = \"fixed\" or \"viscous\"."},
});

constexpr bool in_order()
{
    for (std::size_t k = 0; k < sentences.size(); ++k)
        if (static_cast<std::size_t>(sentences[k].kind) != k) return false;
    return sentences.back().kind == modes_need_free_rock;
}
static_assert(in_order(), "each kind has its sentence, in the order of NoteKind");

} // namespace note_text

std::string_view sentence_of(NoteKind kind)
{
    return note_text::sentences[static_cast<std::size_t>(kind)].text;
}

std::string text_of(const Note& note)
{
    const note_text::Sentence& sentence = note_text::sentences[static_cast<std::size_t>(note.kind)];
    fmt::dynamic_format_arg_store<fmt::format_context> values;
    const std::int64_t* count = nullptr;
    for (const NoteValue& value : note.values) {
        if (const auto* whole = std::get_if<std::int64_t>(&value)) {
            if (!count) count = whole;
            values.push_back(Number{static_cast<double>(*whole), true});
        } else if (const auto* number = std::get_if<double>(&value)) {
            values.push_back(Number{*number});
        } else {
            values.push_back(std::get<std::string>(value));
        }
    }
    const bool one = count && *count == 1 && !sentence.one.empty();
    return fmt::vformat(one ? sentence.one : sentence.text, values);
}

std::string text_of(std::span<const Note> notes)
{
    std::string all;
    for (const Note& note : notes) all += (all.empty() ? "" : " ") + text_of(note);
    return all;
}

} // namespace damslip
