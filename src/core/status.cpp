#include "core/status.hpp"

#include "core/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

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

} // namespace damslip
