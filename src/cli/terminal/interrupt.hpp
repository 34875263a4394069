#pragma once

#include <string>

namespace damslip::cli {

/// While an object of this kind lives, Ctrl-C (SIGINT) and SIGTERM only set a mark, so that a long run can end in order
/// and write what it has. Objects may be nested: the outermost one counts. A second Ctrl-C ends the process as usual.
///
/// A computation that does not ask within `longest_silence` of the signal, such as a factorisation of a large model, is
/// not waited for: the process prints the farewell and ends with exit_no_answer. Nothing is lost by that before the first
/// result is there; from then on results_at_hand() has the program wait for the next question. Files appear whole or not
/// at all in either case, and the database of a sweep has every finished row.
class InterruptGuard {
public:
    static constexpr double longest_silence = 0.7; ///< [s]

    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// Did a signal come? Asking is what keeps a run that ends in order from being ended. From any thread.
    bool interrupted() const;

    /// Results exist that only this process holds: from now on it ends in order only. From any thread.
    void results_at_hand() const;

    /// What is printed when the process ends because nothing asked. Both texts are for file descriptors: standard
    /// error, and standard output (the error object of --json; may be empty). To be set before the computation.
    static void set_farewell(std::string talk, std::string out);
};

} // namespace damslip::cli
