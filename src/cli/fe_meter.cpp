#include "cli/fe_meter.hpp"

#include <algorithm>

namespace damslip::cli {

void FeMeter::begin(std::size_t runs)
{
    const std::lock_guard lock(mutex_);
    under_way_[std::this_thread::get_id()] = {static_cast<double>(runs), 0.0, 0.0, 0};
}

void FeMeter::step(const fe2d::RunProgress& p)
{
    const std::lock_guard lock(mutex_);
    Group& group = under_way_[std::this_thread::get_id()];
    if (p.step < group.last_step) group.ended = std::min(group.runs - 1.0, group.ended + 1.0); // the next run
    group.last_step = p.step;
    group.share = static_cast<double>(p.step) / static_cast<double>(std::max<std::int64_t>(1, p.steps));
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
    for (const auto& [thread, group] : under_way_) done += group.ended + std::min(1.0, group.share);
    progress_.at(done);
}

} // namespace damslip::cli
