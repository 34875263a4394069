#include "cli/terminal/progress.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <ostream>

namespace damslip::cli {

Progress::Progress(const Streams& streams, std::string label, std::size_t total)
    : streams_(streams), label_(std::move(label)), total_(static_cast<double>(total)),
      start_(std::chrono::steady_clock::now()), drawn_(start_)
{
}

Progress::~Progress()
{
    if (shown_) streams_.talk << "\r\033[K" << std::flush;
}

void Progress::advance(std::size_t by)
{
    const std::lock_guard lock(mutex_);
    done_ += static_cast<double>(by);
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
    if (!streams_.terminal || streams_.quiet) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    draw();
}

void Progress::draw()
{
    shown_ = true;
    const double part = total_ > 0 ? std::min(1.0, done_ / total_) : 1.0;
    const double spent = std::chrono::duration<double>(drawn_ - start_).count();
    const double left = part > 0 ? spent * (1 - part) / part : 0;
    const auto filled = static_cast<std::size_t>(24 * part);
    streams_.talk << fmt::format("\r\033[K{} [{}{}] {:3.0f} %  {:.0f} s left", label_, std::string(filled, '#'),
                                 std::string(24 - filled, '.'), 100 * part, left)
                  << std::flush;
}

} // namespace damslip::cli
