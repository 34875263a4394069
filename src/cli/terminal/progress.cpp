#include "cli/terminal/progress.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <ostream>

namespace damslip::cli {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

Progress::Progress(const Streams& streams, std::string label, double total, std::chrono::milliseconds line_every)
    : streams_(streams), label_(std::move(label)), total_(total), line_every_(line_every),
      start_(std::chrono::steady_clock::now()), drawn_(start_)
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
    const double spent = seconds_since(start_);
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
    return share() > 0 ? seconds_since(start_) * (1 - share()) / share() : 0;
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

} // namespace damslip::cli
