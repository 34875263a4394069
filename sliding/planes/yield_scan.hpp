#pragma once

#include "sliding/planes/chain.hpp"

#include <vector>

namespace damslip::sliding {

/// Chains as long as each other, a seam with its wedge at many angles: their yields side by side, with the bits of ChainLaw::yield().
class YieldScan {
public:
    /// @param law  of the chain
    void add(const Chain& chain, const ChainLaw& law);

    /// Of each chain with the strengths of another one, as long and with the same dilation; infinite where locked [m/s^2].
    std::vector<double> yields(const Chain& strengths) const;

private:
    struct Points {
        std::vector<double> x, y;
        void add(Point p) { x.push_back(p.x), y.push_back(p.y); }
    };
    struct Block {
        Points along, normal, inertia, load; ///< t, n, A (1, 0), F + W + U n
        std::vector<double> length;
    };
    struct Face {
        Points up, downstream, water; ///< e, ν, U ν
        std::vector<double> sense, length;
    };
    std::vector<Block> blocks_;
    std::vector<Face> faces_;
    std::vector<double> open_; ///< of each chain: 1, or 0 where dilation locks it
    std::size_t dam_ = 0;
};

} // namespace damslip::sliding
