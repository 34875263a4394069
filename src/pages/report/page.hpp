#pragma once

#include "core/table.hpp"
#include "pages/report/chart.hpp"
#include "pages/report/picture.hpp"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// A report as data: what stands on the page, not how it looks. All texts are plain text; page_html escapes them.
namespace damslip::pages {

enum class Fold { open, folded };

struct Paragraph {
    std::string text;
};

enum class Layout {
    rows,   ///< a row of the table is a row on the page
    columns ///< turned by a quarter: for many quantities and few rows
};

struct TablePart {
    Table table = {};
    Layout layout = Layout::rows;
    std::size_t labels = 1; ///< Layout::columns: the first `labels` lines are headings
    Fold fold = Fold::open;
};

inline TablePart rows_part(Table table)
{
    return {std::move(table)};
}

/// A drawing as an <svg> element made by Sketch.
struct Drawing {
    std::string title;
    std::string svg;
    std::string note;
};

/// Long text as it is, folded: a resolved scene.
struct Listing {
    std::string title;
    std::string text;
};

using Part = std::variant<Paragraph, TablePart, Chart, StateMap, MeshView, Drawing, Listing>;

struct Section {
    std::string title;
    std::vector<Part> parts;
    Fold fold = Fold::open;
};

enum class Outcome { none, pass, fail, unresolved };

/// The answer on top of the page.
struct Headline {
    std::string sentence;
    Outcome outcome = Outcome::none;
    std::string verdict; ///< "PASS", or why there is none
};

struct Page {
    std::string title;
    std::string subtitle;
    Headline headline;
    std::vector<std::pair<std::string, std::string>> key_figures; ///< name, value with its unit; at most about six
    std::vector<std::string> warnings;
    std::vector<Section> sections;
    std::vector<std::pair<std::string, std::string>> provenance; ///< name, value: version, scene hash, checksums
};

} // namespace damslip::pages
