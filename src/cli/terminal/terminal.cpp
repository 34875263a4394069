#include "cli/terminal/terminal.hpp"

#include "core/file.hpp"
#include "core/status.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fmt/format.h>
#include <ostream>
#include <sys/time.h>
#include <unistd.h>

namespace damslip::cli {

namespace {

// A signal handler can reach nothing but what is global. Lock-free atomics are allowed in one, from any thread.
std::atomic<int> guards{0};
std::atomic<bool> signal_seen{false}, asked{false}, at_hand{false};
static_assert(std::atomic<bool>::is_always_lock_free);
std::string farewell_talk, farewell_out; // set before the handlers can run

void print(int descriptor, const std::string& text)
{
    for (std::size_t at = 0; at < text.size();) {
        const ssize_t n = ::write(descriptor, text.data() + at, text.size() - at);
        if (n <= 0) return;
        at += static_cast<std::size_t>(n);
    }
}

void ring(suseconds_t microseconds)
{
    const itimerval once{{0, 0}, {0, microseconds}};
    ::setitimer(ITIMER_REAL, &once, nullptr);
}

extern "C" void end_the_deaf(int)
{
    if (asked || at_hand) return;
    constexpr suseconds_t soon = 20'000;
    if (Temporary::any()) return ring(soon); // what it owns on the disk goes first
    print(STDERR_FILENO, farewell_talk);
    print(STDOUT_FILENO, farewell_out);
    ::_exit(exit_no_answer);
}

extern "C" void mark_interrupt(int signal)
{
    signal_seen = true;
    std::signal(signal, SIG_DFL);
    ring(static_cast<suseconds_t>(1e6 * InterruptGuard::longest_silence));
}

void handle(int signal, void (*handler)(int))
{
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    ::sigemptyset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
}

} // namespace

InterruptGuard::InterruptGuard()
{
    if (guards.fetch_add(1) > 0) return;
    signal_seen = asked = at_hand = false;
    handle(SIGALRM, end_the_deaf);
    handle(SIGINT, mark_interrupt);
    handle(SIGTERM, mark_interrupt);
}

InterruptGuard::~InterruptGuard()
{
    if (guards.fetch_sub(1) > 1) return;
    handle(SIGINT, SIG_DFL);
    handle(SIGTERM, SIG_DFL);
    const itimerval never{};
    ::setitimer(ITIMER_REAL, &never, nullptr);
    handle(SIGALRM, SIG_DFL);
}

bool InterruptGuard::interrupted() const
{
    if (signal_seen) asked = true;
    return signal_seen;
}

void InterruptGuard::results_at_hand() const
{
    at_hand = true;
}

void InterruptGuard::set_farewell(std::string talk, std::string out)
{
    farewell_talk = std::move(talk);
    farewell_out = std::move(out);
}

void Streams::remark(const std::string& line) const
{
    if (quiet) return;
    if (held)
        held->push_back(line);
    else
        talk << line << "\n";
}

Progress::Progress(const Streams& streams, std::string label, double total, std::chrono::milliseconds line_every)
    : streams_(streams), label_(std::move(label)), total_(total), line_every_(line_every),
      drawn_(std::chrono::steady_clock::now())
{
}

Progress::~Progress()
{
    end();
}

void Progress::end()
{
    const std::lock_guard lock(mutex_);
    if (streams_.quiet || ended_) return;
    ended_ = true;
    if (streams_.terminal) {
        if (shown_ && streams_.bar) *streams_.bar << "\r\033[K" << std::flush;
        return;
    }
    const double spent = start_.seconds();
    streams_.talk << (share() >= 1.0
                          ? fmt::format("{}: 100 %, {:.3g} s\n", label_, spent)
                          : fmt::format("{}: stopped at {:.0f} % after {:.3g} s\n", label_, 100.0 * share(), spent))
                  << std::flush;
}

void Progress::phase(const std::string& what)
{
    const std::lock_guard lock(mutex_);
    if (streams_.quiet) return;
    if (!streams_.terminal)
        streams_.talk << label_ << ": " << what << "\n" << std::flush;
    else if (streams_.bar) {
        shown_ = true;
        *streams_.bar << "\r\033[K" << label_ << " " << what << " ..." << std::flush;
    }
}

void Progress::advance(double by)
{
    const std::lock_guard lock(mutex_);
    done_ += by;
    draw_now_and_then();
}

void Progress::at(double done)
{
    const std::lock_guard lock(mutex_);
    done_ = done;
    draw_now_and_then();
}

void Progress::draw_now_and_then()
{
    if (streams_.quiet) return;
    const auto now = std::chrono::steady_clock::now();
    const auto every = streams_.terminal ? std::chrono::milliseconds(100) : line_every_;
    if (now - drawn_ < every) return;
    drawn_ = now;
    if (streams_.terminal)
        draw();
    else
        say_line();
}

double Progress::share() const
{
    return total_ > 0 ? std::min(1.0, done_ / total_) : 1.0;
}

double Progress::seconds_left() const
{
    return share() > 0 ? start_.seconds() * (1 - share()) / share() : 0;
}

void Progress::draw()
{
    if (!streams_.bar) return;
    shown_ = true;
    const auto filled = static_cast<std::size_t>(24 * share());
    *streams_.bar << fmt::format("\r\033[K{} [{}{}] {:3.0f} %  {:.0f} s left", label_, std::string(filled, '#'),
                                 std::string(24 - filled, '.'), 100 * share(), seconds_left())
                  << std::flush;
}

void Progress::say_line()
{
    if (done_ <= 0) return; // the set-up has its own line
    streams_.talk << fmt::format("{}: {:.0f} %, {:.0f} s left\n", label_, 100 * share(), seconds_left()) << std::flush;
}

VisibleStream::VisibleStream(std::ostream& sink) : std::ostream(nullptr), buffer_(sink)
{
    rdbuf(&buffer_);
}

bool VisibleStream::Buffer::put(std::string_view text)
{
    sink_ << visible(text, LineEnds::kept);
    return sink_.good();
}

VisibleStream::Buffer::int_type VisibleStream::Buffer::overflow(int_type c)
{
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char one = traits_type::to_char_type(c);
    return xsputn(&one, 1) == 1 ? c : traits_type::eof();
}

std::streamsize VisibleStream::Buffer::xsputn(const char* text, std::streamsize count)
{
    used_ = used_ || count > 0;
    const std::string whole = unfinished_ + std::string(text, static_cast<std::size_t>(count));
    const std::size_t kept = unfinished_bytes(whole);
    unfinished_ = whole.substr(whole.size() - kept);
    return put(std::string_view(whole).substr(0, whole.size() - kept)) ? count : 0;
}

int VisibleStream::Buffer::sync()
{
    const bool whole = put(unfinished_);
    unfinished_.clear();
    sink_.flush();
    return whole && sink_.good() ? 0 : -1;
}

} // namespace damslip::cli
