#include "cli/terminal/interrupt.hpp"

#include <csignal>

namespace damslip::cli {

namespace {

volatile std::sig_atomic_t signal_seen = 0; // a signal handler can reach nothing else

extern "C" void mark_interrupt(int signal)
{
    signal_seen = 1;
    std::signal(signal, SIG_DFL);
}

} // namespace

InterruptGuard::InterruptGuard()
{
    signal_seen = 0;
    std::signal(SIGINT, mark_interrupt);
    std::signal(SIGTERM, mark_interrupt);
}

InterruptGuard::~InterruptGuard()
{
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::interrupted() const
{
    return signal_seen != 0;
}

} // namespace damslip::cli
