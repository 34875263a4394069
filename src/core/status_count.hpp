#pragma once

#include "core/status.hpp"

#include <array>
#include <cstddef>
#include <string>

namespace damslip {

/// How often each status came up among runs that are counted rather than averaged.
class StatusCount {
public:
    void add(Status status) { ++count_[static_cast<std::size_t>(status)]; }

    std::size_t all() const;
    bool empty() const { return all() == 0; }
    /// In the order of the list: "2 static failure, 1 not resolved"; empty for none.
    std::string words() const;
    /// Of the gravest status that came up; exit_ok for none.
    int exit_code() const;

private:
    std::array<std::size_t, static_cast<std::size_t>(Status::refused) + 1> count_{};
};

} // namespace damslip
