#pragma once

#include "core/usage_error.hpp"

#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

namespace damslip::cli {

/// The cases whose id contains `filter`.
/// @param cases  a list of things with an `id`; must outlive the result
/// @param command  as the user gave it, for the message
/// @throws UsageError if there is none
template <class Cases>
std::vector<const typename Cases::value_type*> select_cases(const Cases& cases, const std::string& filter,
                                                            std::string_view command)
{
    std::vector<const typename Cases::value_type*> selected;
    for (const auto& c : cases)
        if (c.id.find(filter) != std::string::npos) selected.push_back(&c);
    if (selected.empty())
        throw UsageError(Diagnostic{"", 0, 0, fmt::format("{}: no case has \"{}\" in its name.", command, filter),
                                    fmt::format("part of a case id, such as {}", cases.front().id),
                                    fmt::format("run  damslip {}  without a filter to see them all", command)});
    return selected;
}

} // namespace damslip::cli
