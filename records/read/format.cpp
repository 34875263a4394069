#include "records/read/format.hpp"

#include "records/read/columns.hpp"
#include "records/read/peer_at2.hpp"

#include <algorithm>
#include <array>

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
bool cosmos(const RecordText& text)
{
    return early_line_contains(text, 1, "(format v");
}
bool smc(const RecordText& text)
{
    const std::string_view first = text.lines.front();
    return first.size() > 2 && first[0] >= '0' && first[0] <= '9' && first[1] == ' ' &&
           early_line_contains(text, 1, "accelerogram");
}
bool csmip(const RecordText& text)
{
    return early_line_contains(text, 3, "corrected accelerogram");
}
bool k_net(const RecordText& text)
{
    return text.lines.front().starts_with("Origin Time");
}
bool esm(const RecordText& text)
{
    return text.lines.front().starts_with("EVENT_NAME:");
}

constexpr std::array<RecordFormat, 8> formats{{
    {"web page (HTML or XML)", web_page, nullptr},
    {"COSMOS", cosmos, nullptr},
    {"SMC (USGS)", smc, nullptr},
    {"CSMIP/CDMG volume 1 or 2", csmip, nullptr},
    {"K-NET/KiK-net", k_net, nullptr},
    {"ESM/ITACA ASCII", esm, nullptr},
    {"PEER AT2", looks_like_peer_at2, read_peer_at2},
    {"columns", looks_like_columns, read_columns},
}};

} // namespace

std::span<const RecordFormat> record_formats()
{
    return formats;
}

} // namespace damslip::records
