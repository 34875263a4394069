#pragma once

#include <cstddef>
#include <vector>

namespace damslip {

/// Counts of one cell: weights of counted, failing and missing runs. P is z / n.
struct RunCount {
    double n = 0.0, z = 0.0, missing = 0.0;
    void add(const RunCount& c, double times = 1.0)
    {
        n += times * c.n;
        z += times * c.z;
        missing += times * c.missing;
    }
    double low() const { return n > 0.0 ? z / n : 0.0; }              ///< missing runs survive
    double high() const { return n > 0.0 ? (z + missing) / n : 0.0; } ///< missing runs fail
    double middle() const { return 0.5 * (low() + high()); }
};

/// Counts of one limit: by level and then by replicate, event, epistemic draw, and inner draw (which all epistemic draws of a replicate share).
struct LimitCounts {
    std::vector<RunCount> all;
    std::vector<std::vector<RunCount>> replicate, cluster, outer, inner;
    LimitCounts(std::size_t levels, std::size_t replicates, std::size_t clusters, std::size_t outers,
                std::size_t inners = 0)
        : all(levels), replicate(levels, std::vector<RunCount>(replicates)),
          cluster(levels, std::vector<RunCount>(clusters)), outer(levels, std::vector<RunCount>(outers)),
          inner(levels, std::vector<RunCount>(inners))
    {
    }
};

} // namespace damslip
