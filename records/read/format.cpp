#include "records/read/read_record.hpp"

#include <algorithm>
#include <vector>

namespace damslip::records {

namespace {

/// One of the first `count` lines contains `part` (lower case).
bool early_line_contains(const RecordText& text, std::size_t count, std::string_view part)
{
    const auto end = text.lines.begin() + static_cast<std::ptrdiff_t>(std::min(count, text.lines.size()));
    return std::any_of(text.lines.begin(), end,
                       [&](std::string_view line) { return contains(lower(line.substr(0, 200)), part); });
}

bool web_page(const RecordText& text)
{
    return early_line_contains(text, 5, "<html") || early_line_contains(text, 5, "<!doctype") ||
           early_line_contains(text, 2, "<?xml");
}

} // namespace

// Each format is a file with its reader and one of these.
RecordFormat cosmos_format();
RecordFormat smc_format();
RecordFormat csmip_format();
RecordFormat k_net_format();
RecordFormat esm_format();
RecordFormat peer_at2_format();
RecordFormat columns_format();

std::span<const RecordFormat> record_formats()
{
    static const std::vector<RecordFormat> formats{
        {"web page (HTML or XML)", web_page, nullptr},
        cosmos_format(),
        smc_format(),
        csmip_format(),
        k_net_format(),
        esm_format(),
        peer_at2_format(),
        columns_format(), // any table of numbers: last
    };
    return formats;
}

} // namespace damslip::records
