#include "analysis/fe/fe_meter.hpp"

#include <algorithm>

namespace damslip {

void FeMeter::begin(std::size_t runs)
{
    const std::lock_guard lock(mutex_);
    under_way_[std::this_thread::get_id()] = {static_cast<double>(runs), 0.0};
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

} // namespace damslip
