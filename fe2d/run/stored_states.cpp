#include "fe2d/run/stored_states.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

void StateKeeper::look(const DynamicState& state, double time, double slip, double crest_x)
{
    const auto keep = [&](Instant instant) {
        StoredState& kept = kept_[static_cast<std::size_t>(instant)]; // its vectors keep their memory
        kept.instant = instant;
        kept.time = time;
        kept.slip = slip;
        kept.dam = state.u;
        kept.rock = state.rock;
    };
    if (kept_.empty()) {
        kept_.resize(static_cast<std::size_t>(Instant::end) + 1);
        keep(Instant::start);
        keep(Instant::end);
        return;
    }
    const StoredState& before = kept_.back();
    const double lean = crest_x - slip, rate = std::abs(slip - before.slip) / (time - before.time);
    if (lean > lean_down_) {
        lean_down_ = lean;
        keep(Instant::leans_downstream);
    }
    if (lean < lean_up_) {
        lean_up_ = lean;
        keep(Instant::leans_upstream);
    }
    if (rate > rate_) {
        rate_ = rate;
        keep(Instant::slides_fastest);
    }
    keep(Instant::end);
}

std::vector<StoredState> StateKeeper::states() const
{
    std::vector<StoredState> list;
    std::copy_if(kept_.begin(), kept_.end(), std::back_inserter(list),
                 [](const StoredState& s) { return s.dam.size() > 0; });
    std::stable_sort(list.begin(), list.end(),
                     [](const StoredState& a, const StoredState& b) { return a.time < b.time; });
    return list;
}

} // namespace damslip::fe2d
