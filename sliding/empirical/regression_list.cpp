#include "sliding/empirical/regression.hpp"

namespace damslip::sliding {

// The files of rows. A new regression is a new row, or a file with a function like these and its line here; nothing else
// knows their number.
std::vector<Regression> rigid_block_rows();    // Ambraseys & Menu, Jibson, Saygili & Rathje
std::vector<Regression> flexible_block_rows(); // Rathje & Antonakos, Bray and co-authors
std::vector<Regression> other_rows();          // Hynes-Griffin & Franklin, Yegian, Fotopoulou & Pitilakis, Hsieh & Lee

std::span<const Regression> regressions()
{
    static const std::vector<Regression> table = [] {
        std::vector<Regression> all;
        for (auto* file : {
                 rigid_block_rows,
                 flexible_block_rows,
                 other_rows,
             }) {
            const std::vector<Regression> rows = file();
            all.insert(all.end(), rows.begin(), rows.end());
        }
        return all;
    }();
    return table;
}

} // namespace damslip::sliding
