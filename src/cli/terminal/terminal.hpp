#pragma once

#include "core/parallel.hpp"

#include <chrono>
#include <functional>
#include <iosfwd>
#include <mutex>
#include <optional>
#include <ostream>
#include <streambuf>
#include <string>
#include <vector>

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

enum class Form {
    text, ///< the answer in brief
    full, ///< all tables
    json
};

/// Where a command puts what it has to say: data on `out`, talk and progress on `talk`. Control characters other than
/// newline and tab reach neither of them.
struct Streams {
    std::ostream& out;
    std::ostream& talk;
    Form form = Form::text;
    bool quiet = false;          ///< no talk but errors; in brief the answer's line alone
    bool terminal = false;       ///< `talk` is a terminal: progress is drawn
    std::ostream* bar = nullptr; ///< the terminal itself, for a bar that is drawn over; null: no terminal
    StopAsked stop = {};         ///< does the user want the command to end? empty: never
    /// Hands the whole command line to damslip-verify, the second program; does not come back unless that cannot be started.
    /// @throws InputError where it is not installed
    std::function<int()> hand_on = {};
    bool out_is_terminal = false;
    std::vector<std::string>* held = nullptr; ///< remarks that wait for the answer in brief; null: they are printed at once

    /// A line of talk on what the answer rests on: "note: ...". In brief it is one of the answer's notes.
    void remark(const std::string& line) const;
};

/// How far a command is. On a terminal a bar with percentage and time left, at most ten times a second; elsewhere a
/// line of its own every ten seconds and one at the end, which log files can keep. Silent with --quiet.
class Progress {
public:
    /// @param line_every  of the lines, where there is no terminal
    Progress(const Streams& streams, std::string label, double total,
             std::chrono::milliseconds line_every = std::chrono::seconds(10));
    ~Progress(); ///< end(), where it was not called
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// The last line, now; before what is printed of the results.
    void end();
    /// Names what goes on before the first step, "set-up": the bar and the lines say it at once.
    void phase(const std::string& what);
    void advance(double by); ///< from any thread
    void at(double done);    ///< sets what is done, in the unit of the total; may step back

private:
    void draw_now_and_then();
    void draw();
    void say_line();
    double share() const;
    double seconds_left() const;

    const Streams& streams_;
    std::string label_;
    double total_, done_ = 0;
    std::chrono::milliseconds line_every_;
    Stopwatch start_;
    std::chrono::steady_clock::time_point drawn_;
    std::mutex mutex_;
    bool shown_ = false, ended_ = false;
};

/// A computation that the command line started: a bar on the terminal or lines in a log file, ended by Ctrl-C.
class TerminalWatch final : public Watch {
public:
    /// @param streams  outlive this
    explicit TerminalWatch(const Streams& streams) : streams_(streams) {}

    bool stop_asked() const override { return interrupt_.interrupted(); }
    void results_at_hand() override { interrupt_.results_at_hand(); }
    void begin(const std::string& label, double total) override { progress_.emplace(streams_, label, total); }
    void phase(const std::string& what) override
    {
        if (progress_) progress_->phase(what);
    }
    void at(double done) override { progress_->at(done); }
    void end() override { progress_.reset(); }

private:
    const Streams& streams_;
    InterruptGuard interrupt_;
    std::optional<Progress> progress_; ///< of the part under way
};

/// A stream in front of another one that lets no control character through but newline and tab (visible()):
/// names and titles come from files, and what they hold must not move a terminal's cursor or hide text.
class VisibleStream : public std::ostream {
public:
    explicit VisibleStream(std::ostream& sink);
    bool used() const { return buffer_.used(); } ///< has anything been written?

private:
    class Buffer : public std::streambuf {
    public:
        explicit Buffer(std::ostream& sink) : sink_(sink) {}
        bool used() const { return used_; }

    protected:
        int_type overflow(int_type c) override;
        std::streamsize xsputn(const char* text, std::streamsize count) override;
        int sync() override;

    private:
        bool put(std::string_view text);

        std::ostream& sink_;
        bool used_ = false;
        std::string unfinished_; ///< first bytes of a character, at most two
    };
    Buffer buffer_;
};

} // namespace damslip::cli
