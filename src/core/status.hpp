#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

/// What can become of an answer, and what may be said of each: the one list that every command and every table uses
/// (docs/statuses.md).
namespace damslip {

/// Exit codes of the program. Of several answers the worst one counts: see worst_exit_code().
enum ExitCode {
    exit_ok = 0,
    exit_internal = 1,
    exit_usage = 2,
    exit_input = 3,
    exit_no_answer = 4 ///< not resolved, tolerance missed, diverged, self-excited, interrupted; a check failed
};

enum class Status {
    at_rest,          ///< came to rest: the slip is final
    sliding_at_end,   ///< still sliding when the run-out ended: the slip is a lower bound
    static_failure,   ///< slides without an earthquake, proven: the friction that would hold is above the given one
    overturns,        ///< the resultant of the static loads acts outside the base
    floats,           ///< the uplift carries more than the weight
    runs_away,        ///< slid further than its own base is long: the model no longer holds
    overturned,       ///< rocked over its toe or heel in the earthquake
    left_plane,       ///< slid further than contact.max_slip_m, as far as the plane is meshed
    self_excited,     ///< goes on sliding by itself with the ground at rest, although it would stand
    rocks_first,      ///< would tip before it slides: the slip of a sliding block is none of this dam
    tolerance_missed, ///< the time step leaves more open than time.slip_tolerance allows
    not_resolved,     ///< the solver found no answer; nothing is said of the dam
    diverged,         ///< energy grew beyond all that the ground put in: an answer of the scheme, not of the dam
    interrupted,      ///< stopped by the user
    refused           ///< the method cannot take this scene
};

/// What a number printed as slip means under a status.
enum class SlipMeaning {
    final,       ///< the slip
    lower_bound, ///< at least this much
    none         ///< there is none: null in JSON, empty in CSV, "–" in tables
};

/// What may be said against the allowable slip.
enum class Judging {
    by_slip, ///< PASS, FAIL or undecided, by slip and error
    fails,   ///< FAIL whatever the slip
    none     ///< no verdict: the question has no answer
};

struct StatusRow {
    Status status;
    std::string_view word;    ///< as printed and in files: "at rest"
    int exit_code;            ///< exit_ok, exit_input or exit_no_answer
    SlipMeaning slip;         ///< what the slip is, where there is one
    Judging judging;          ///< what may be said of it
    std::string_view meaning; ///< one sentence
    std::string_view remedy;  ///< what the user can do; empty: nothing is wrong
};

/// All of them, in the order of the enumeration.
std::span<const StatusRow> status_rows();
const StatusRow& status_row(Status status);
std::string word(Status status);
/// The status of a word of the list; none for other words.
std::optional<Status> status_of_word(std::string_view word);
/// The graver of two: exit_no_answer before exit_input before exit_ok.
int worse_exit_code(int a, int b);

/// Does it answer the question, the recognised failure of a dam that does not stand included?
bool is_answer(Status status);
/// Does the dam fail under its static loads alone?
bool fails_statically(Status status);

/// The slip as it may be printed, in its own unit: none where the status has none, or where the number is not finite.
std::optional<double> reported(Status status, double slip);

enum class Verdict {
    pass,      ///< slip and error lie below the allowable
    fail,      ///< slip and error lie above it, or the status says so
    undecided, ///< the allowable lies within the error, or the error is not known
    none       ///< no criterion, or the status allows no verdict
};
/// "PASS", "FAIL", "undecided", "–".
std::string word(Verdict verdict);

/// The slip |slip| ± error against the allowable. PASS needs slip + error <= allowable, FAIL slip - error > allowable;
/// between them, and where the error is not known, nothing is decided. A lower bound of a slip can only fail.
/// @param slip, error  [m]; error >= 0 is all that is numerical (step and mesh); NaN: not estimated
/// @param allowable  [m]; none: no criterion
Verdict judge(Status status, double slip, double error, const std::optional<double>& allowable);

/// How often each status came up among runs that are counted rather than averaged.
class StatusCount {
public:
    void add(Status status) { ++count_[static_cast<std::size_t>(status)]; }

    std::size_t all() const;
    bool empty() const { return all() == 0; }
    /// In the order of the list: "2 static failure, 1 not resolved"; empty for none.
    std::string words() const;
    /// Of the gravest status that came up; exit_ok for none.
    int exit_code() const;

private:
    std::array<std::size_t, static_cast<std::size_t>(Status::refused) + 1> count_{};
};

} // namespace damslip
