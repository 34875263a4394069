#include "core/status_count.hpp"

#include <fmt/format.h>
#include <numeric>

namespace damslip {

std::size_t StatusCount::all() const
{
    return std::accumulate(count_.begin(), count_.end(), std::size_t{0});
}

std::string StatusCount::words() const
{
    std::string words;
    for (const StatusRow& row : status_rows())
        if (const std::size_t n = count_[static_cast<std::size_t>(row.status)]; n > 0)
            words += fmt::format("{}{} {}", words.empty() ? "" : ", ", n, row.word);
    return words;
}

int StatusCount::exit_code() const
{
    int code = exit_ok;
    for (const StatusRow& row : status_rows())
        if (count_[static_cast<std::size_t>(row.status)] > 0) code = worse_exit_code(code, row.exit_code);
    return code;
}

} // namespace damslip
