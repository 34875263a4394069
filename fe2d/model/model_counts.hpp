#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace damslip::fe2d {

/// What one effect adds to the system.
struct EffectCount {
    std::string effect; ///< "dam", "foundation", "curtain", "added mass"
    std::int64_t elements = 0;
    std::int64_t unknowns = 0; ///< that would not be there without it
    std::int64_t nonzeros = 0; ///< stored matrix entries (K and M) that would not be there without it
    std::int64_t bytes = 0;    ///< of those entries and of four vectors of those unknowns
};

/// Counts of a model, taken from the assembled matrices themselves (assembling costs milliseconds), so what is
/// announced before a run and what the run holds are the same numbers. The effects sum to the totals.
struct ModelCounts {
    std::vector<EffectCount> effects; ///< only those the scene has
    std::int64_t elements = 0;
    std::int64_t unknowns = 0;
    std::int64_t nonzeros = 0;
    std::int64_t bytes = 0;

    void add(EffectCount effect); ///< fills the effect's bytes and sums up
};

} // namespace damslip::fe2d
