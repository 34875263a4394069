#pragma once

#include "core/csv.hpp"
#include "pages/report/chart.hpp"

#include <optional>
#include <string>
#include <string_view>
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
    std::vector<std::string> definitions = {}; ///< sentences below it that files and terminals do without: what its
                                               ///< words and signs mean
};

inline TablePart rows_part(Table table, std::vector<std::string> definitions = {})
{
    return {std::move(table), Layout::rows, 1, Fold::open, std::move(definitions)};
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
    std::vector<Part> parts = {};
    Fold fold = Fold::open;
};

enum class Outcome { none, pass, fail, unresolved };

/// The answer on top of the page.
struct Headline {
    std::string sentence;
    Outcome outcome = Outcome::none;
    std::string verdict = {}; ///< "PASS", or why there is none
};

/// The verdict on the slip joined with that on the load combinations: "Slip: PASS; load combinations: FAIL usual 2.95 < 3.0".
/// @param failed  checks that fail (sliding::failed_checks()); empty: the slip's stands alone
Headline with_failed_checks(Headline slip, const std::string& failed);

/// Whose report it is; nothing given: no block.
struct TitleBlock {
    std::vector<std::pair<std::string, std::string>> entries; ///< name, value: "client", "Valley Power"
    std::vector<std::pair<std::string, std::string>> signers; ///< role, name; with room for a signature
    std::string notes;
};

struct Page {
    std::string title;
    std::string subtitle;
    TitleBlock title_block = {};
    std::string footer = {}; ///< at the foot of each printed page, beside its number
    Headline headline;
    std::vector<std::pair<std::string, std::string>> key_figures; ///< name, value with its unit; at most about six
    std::vector<std::string> warnings;
    std::vector<Section> sections;
    std::vector<std::pair<std::string, std::string>> provenance; ///< name, value: version, scene hash, checksums
};

/// Sections with these titles first, in this order; a title that the page does not have is a warning. @param titles  with commas
void order_sections(const std::string& titles, Page& page);

/// The page as one HTML file that needs nothing else: style, script and data inside, no reference to any network.
/// The same page gives the same bytes.
std::string page_html(const Page& page);

/// The table with its title and notes as HTML; numbers right-aligned with the column's digits, PASS / FAIL marked.
/// @param section  title of the section it stands in; a table of the same title shows it only once
std::string table_html(const TablePart& part, const std::string& section = "");

/// Script and style that every page carries, embedded at build (assets.S).
struct Assets {
    std::string_view uplot_script,
        uplot_style;                ///< uPlot 1.6.32 (MIT), minified; readable twin and checksums: vendor/uplot
    std::string_view uplot_license; ///< goes with every copy of the two
    std::string_view page_script, state_map_script, mesh_view_script, page_style; ///< page.js, ..., page.css
};
const Assets& assets();

/// One bar from zero.
struct Bar {
    std::string name;
    std::optional<double> value;
    double error = 0.0;    ///< drawn as a whisker on both sides of the end; 0: none
    std::string words;     ///< beside the bar: its figure; in its place where there is no value
    bool doubtful = false; ///< drawn hollow: not larger than its error
};

/// Bars to both sides of zero, the longest on top; those without a value at the bottom.
/// @param unit  of the values, for the axis
Drawing tornado(std::string title, std::vector<Bar> bars, const std::string& axis, const std::string& note);

} // namespace damslip::pages
