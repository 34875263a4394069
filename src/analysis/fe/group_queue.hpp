#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

namespace damslip {

/// Groups of runs, each of one model and one motion, that threads take one after the other. With a model whose runs gain by going in
/// step (fe2d::EarthquakeRun::runs_together), a thread takes several groups of it at once, but leaves the other threads their
/// share. What is taken together changes no result.
class GroupQueue {
public:
    /// @param models  of the groups, by number: those with the same number share a model
    GroupQueue(std::vector<std::size_t> models, int threads);

    std::size_t groups() const { return models_.size(); }
    /// The first group that nobody has taken; none: all are taken. Taken by this call.
    std::optional<std::size_t> next();
    /// More groups of the model of `group`, which this call takes. @param most  with `group`
    std::vector<std::size_t> more_of(std::size_t group, std::size_t most);

private:
    std::mutex mutex_;
    std::vector<std::size_t> models_;
    std::vector<bool> taken_;
    std::size_t first_ = 0; ///< all before are taken
    std::size_t threads_;
};

} // namespace damslip
