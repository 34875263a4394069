#include "cli/terminal/interrupt.hpp"

#include "core/file.hpp"
#include "core/status.hpp"

#include <atomic>
#include <csignal>
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

} // namespace damslip::cli
