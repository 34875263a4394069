#include "analysis/fe/fe_meter.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

void FeMeter::begin(std::size_t runs)
{
    const std::lock_guard lock(mutex_);
    under_way_[std::this_thread::get_id()] = {static_cast<double>(runs), 0.0};
}

void FeMeter::more(std::size_t runs)
{
    const std::lock_guard lock(mutex_);
    under_way_[std::this_thread::get_id()].runs += static_cast<double>(runs);
}

void FeMeter::step(const fe2d::RunProgress& p)
{
    reached(static_cast<double>(p.step) / static_cast<double>(std::max<std::int64_t>(1, p.steps)));
}

void FeMeter::reached(double share)
{
    const std::lock_guard lock(mutex_);
    Group& group = under_way_[std::this_thread::get_id()];
    group.share = std::clamp(share, group.share, 1.0); // a further halving adds steps: never back
    show();
}

void FeMeter::end()
{
    const std::lock_guard lock(mutex_);
    done_ += under_way_[std::this_thread::get_id()].runs;
    under_way_.erase(std::this_thread::get_id());
    show();
}

void FeMeter::show()
{
    double done = done_;
    for (const auto& [thread, group] : under_way_) done += group.runs * group.share;
    watch_.at(done);
}

std::function<void(int unknowns)> tell_of_large_box(Watch& watch)
{
    constexpr int large = 20000; // boxes of 25 Hz have 9 000 to 14 000 and take 1 to 4 s
    return [&watch](int unknowns) {
        if (unknowns >= large)
            watch.phase(fmt::format(
                "the box of waves, {} unknowns, is reduced to the base (foundation.wave_frequency_Hz)", unknowns));
    };
}

} // namespace damslip
