#pragma once

#include "analysis/sweep/result_store.hpp"

#include <array>

namespace damslip {

/// What many runs gave: eight bytes for each figure that any of them has, one byte for status and RowResults' good. Histories, slips after events and
/// anchors are not kept. A rigid block has four figures: 33 bytes a run.
class PackedRows {
public:
    explicit PackedRows(std::size_t size = 0) : state_(size, 0) {}

    std::size_t size() const { return state_.size(); }
    std::size_t finished() const; ///< how many there are
    bool has(std::size_t id) const { return state_[id] != 0; }
    const std::optional<FinishedRow> operator[](std::size_t id) const; ///< none: not run
    void put(const FinishedRow& row);                                  ///< in its place, its id. From one thread at a time

private:
    std::uint8_t state_of(const FinishedRow& row);

    std::vector<std::uint8_t> state_; ///< 0: not run; else 1 + place of the status, and bad_run where it is not good
    std::vector<std::string> statuses_;
    std::array<std::vector<double>, row_numbers.size()> figures_; ///< in the order of row_numbers; empty: no run has it
};

} // namespace damslip
