#include "records/read/format.hpp"

#include "records/read/columns.hpp"
#include "records/read/cosmos.hpp"
#include "records/read/csmip.hpp"
#include "records/read/esm.hpp"
#include "records/read/k_net.hpp"
#include "records/read/peer_at2.hpp"
#include "records/read/smc.hpp"

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

// A new format is a file with its reader and a function like `RecordFormat acme_format();`, declared here.

std::span<const RecordFormat> record_formats()
{
    static const std::vector<RecordFormat> formats{
        {"web page (HTML or XML)", web_page, nullptr},
        {"COSMOS", looks_like_cosmos, read_cosmos},
        {"SMC (USGS)", looks_like_smc, read_smc},
        {"CSMIP/CDMG", looks_like_csmip, read_csmip},
        {"K-NET/KiK-net", looks_like_k_net, read_k_net},
        {"ESM/ITACA ASCII", looks_like_esm, read_esm},
        {"PEER AT2", looks_like_peer_at2, read_peer_at2},
        {"columns", looks_like_columns, read_columns}, // any table of numbers: last
    };
    return formats;
}

} // namespace damslip::records
