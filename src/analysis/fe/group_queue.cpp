#include "analysis/fe/group_queue.hpp"

#include <algorithm>
#include <utility>

namespace damslip {

GroupQueue::GroupQueue(std::vector<std::size_t> models, int threads)
    : models_(std::move(models)), taken_(models_.size(), false),
      threads_(static_cast<std::size_t>(std::max(1, threads)))
{
}

std::optional<std::size_t> GroupQueue::next()
{
    const std::lock_guard lock(mutex_);
    while (first_ < taken_.size() && taken_[first_]) ++first_;
    if (first_ == taken_.size()) return std::nullopt;
    taken_[first_] = true;
    return first_++;
}

std::vector<std::size_t> GroupQueue::more_of(std::size_t group, std::size_t most)
{
    std::vector<std::size_t> more;
    if (most < 2) return more;
    const std::lock_guard lock(mutex_);
    for (std::size_t i = first_; i < models_.size(); ++i)
        if (!taken_[i] && models_[i] == models_[group]) more.push_back(i);
    const std::size_t share = (more.size() + 1 + threads_ - 1) / threads_; // of those left and `group`
    more.resize(std::min({more.size(), most - 1, share - 1}));
    for (const std::size_t i : more) taken_[i] = true;
    return more;
}

} // namespace damslip
