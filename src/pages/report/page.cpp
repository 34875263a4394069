#include "pages/report/page.hpp"

#include "core/text.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/chart.hpp"
#include "pages/report/table_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace damslip::pages {

Headline with_failed_checks(Headline slip, const std::string& failed)
{
    if (failed.empty()) return slip;
    std::string verdict = slip.outcome == Outcome::none ? "no criterion" : slip.verdict;
    if (verdict.ends_with('.')) verdict.pop_back();
    if (verdict.starts_with("Slip: ")) verdict.erase(0, 6);
    const bool of_slip = !verdict.ends_with("by factor of safety");
    return {std::move(slip.sentence), Outcome::fail, (of_slip ? "Slip: " : "") + verdict + "; load combinations: FAIL " + failed};
}

namespace {

std::string note_html(const std::string& note)
{
    return note.empty() ? "" : "<p class=\"note\">" + html_text(note) + "</p>\n";
}

/// The chart's place, its data and what a reader without the picture gets.
std::string chart_html(const Chart& chart)
{
    const ChartData data = thinned(common_abscissae(chart), chart.thin_above, chart.thin_buckets);
    std::string note = chart.note;
    if (data.x.size() < data.samples)
        note += std::string(note.empty() ? "" : " ") + "Drawn from " + std::to_string(data.x.size()) + " of " +
                std::to_string(data.samples) + " samples, extremes kept.";
    const std::string title = html_text(chart.title);
    std::string out = "<figure class=\"chart part\" aria-label=\"" + title + "\">\n<figcaption>" + title +
                      "</figcaption>\n<div class=\"plot\" tabindex=\"0\" role=\"application\" aria-label=\"" + title +
                      ". Left and right keys read values, plus and minus zoom, 0 shows all.\"></div>\n"
                      "<p class=\"readout\" aria-live=\"polite\"></p>\n<script type=\"application/json\">";
    out += chart_json(chart, data);
    return out + "</script>\n" + note_html(note) + "</figure>\n";
}

/// @param kind  of the script that draws it @param data  for it, JSON
std::string picture_html(const std::string& kind, const std::string& plain_title, const std::string& keys,
                         const std::string& data, const std::string& note)
{
    const std::string title = html_text(plain_title);
    return "<figure class=\"picture part\" data-kind=\"" + kind + "\" aria-label=\"" + title + "\">\n<figcaption>" +
           title + "</figcaption>\n<div class=\"canvas\" tabindex=\"0\" role=\"application\" aria-label=\"" + title +
           ". " + keys +
           "\"></div>\n<p class=\"reading\" aria-live=\"polite\"></p>\n<script type=\"application/json\">" + data +
           "</script>\n" + note_html(note) + "</figure>\n";
}

struct PartHtml {
    const std::string& section;
    std::string operator()(const Paragraph& p) const { return "<p>" + html_text(p.text) + "</p>\n"; }
    std::string operator()(const TablePart& p) const { return table_html(p, section); }
    std::string operator()(const Chart& p) const { return chart_html(p); }
    std::string operator()(const StateMap& p) const
    {
        return picture_html("state_map", p.title, "Arrow keys read time and place.", state_map_json(p), p.note);
    }
    std::string operator()(const MeshView& p) const
    {
        return picture_html("mesh_view", p.title, "Left and right keys go through the states.", mesh_view_json(p),
                            p.note);
    }
    std::string operator()(const Drawing& p) const
    {
        const std::string title = html_text(p.title);
        return "<figure class=\"drawing part\">\n<figcaption>" + title +
               "</figcaption>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + title + "\">" +
               p.svg + "</div>\n" + note_html(p.note) + "</figure>\n";
    }
    std::string operator()(const Listing& p) const
    {
        return "<details class=\"part listing\"><summary>" + html_text(p.title) + "</summary>\n<pre tabindex=\"0\">" +
               html_text(p.text) + "</pre></details>\n";
    }
};

std::string section_html(const Section& section, std::size_t number)
{
    std::string body;
    for (const Part& part : section.parts) body += std::visit(PartHtml{section.title}, part);
    const std::string id = " id=\"s" + std::to_string(number) + "\"";
    const std::string title = "<h2>" + html_text(section.title) + "</h2>";
    if (section.fold == Fold::folded)
        return "<details class=\"section\"" + id + "><summary>" + title + "</summary>\n" + body + "</details>\n";
    return "<section" + id + ">\n" + title + "\n" + body + "</section>\n";
}

std::string pairs_html(const std::vector<std::pair<std::string, std::string>>& pairs, const std::string& css)
{
    std::string out = "<dl class=\"" + css + "\">\n";
    for (const auto& [name, value] : pairs)
        out += "<div><dt>" + html_text(name) + "</dt><dd>" + html_text(value) + "</dd></div>\n";
    return out + "</dl>\n";
}

std::string headline_html(const Headline& headline)
{
    if (headline.sentence.empty()) return "";
    const std::string verdict =
        headline.verdict.empty() ? "" : "<strong class=\"verdict\">" + html_text(headline.verdict) + "</strong> ";
    const std::string css = word_in(headline.outcome, {{Outcome::pass, "pass"},
                                                       {Outcome::fail, "fail"},
                                                       {Outcome::unresolved, "unresolved"},
                                                       {Outcome::none, "open"}});
    return "<p class=\"headline " + css + "\">" + verdict + html_text(headline.sentence) + "</p>\n";
}

std::string warnings_html(const std::vector<std::string>& warnings)
{
    if (warnings.empty()) return "";
    constexpr std::size_t shown = 6; // more of them would push the answer's figures off the first page
    std::string out = "<section class=\"warnings\" aria-label=\"Warnings\">\n<h2>Warnings</h2>\n<ul>\n";
    for (std::size_t i = 0; i < warnings.size(); ++i) {
        if (i == shown)
            out += "</ul>\n<details><summary>" + std::to_string(warnings.size() - shown) + " more</summary>\n<ul>\n";
        out += "<li>" + html_text(warnings[i]) + "</li>\n";
    }
    return out + (warnings.size() > shown ? "</ul>\n</details>\n" : "</ul>\n") + "</section>\n";
}

std::string title_block_html(const TitleBlock& block)
{
    if (block.entries.empty() && block.signers.empty() && block.notes.empty()) return "";
    std::string out = "<section class=\"title-block\" aria-label=\"Project\">\n";
    if (!block.entries.empty()) out += pairs_html(block.entries, "entries");
    if (!block.signers.empty()) {
        out += "<dl class=\"signers\">\n";
        for (const auto& [role, name] : block.signers)
            out += "<div><dt>" + html_text(role) + "</dt><dd>" + html_text(name) +
                   "</dd><dd class=\"signature\">date, signature</dd></div>\n";
        out += "</dl>\n";
    }
    if (!block.notes.empty()) out += "<p>" + html_text(block.notes) + "</p>\n";
    return out + "</section>\n";
}

/// As a string of CSS, in quotes.
std::string css_string(const std::string& text)
{
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\' || c == '<') // the last: no tag ends the style element
            out += c == '<' ? "\\3c " : std::string("\\") + c;
        else if (static_cast<unsigned char>(c) >= ' ')
            out += c;
    }
    return out + "\"";
}

std::string contents_html(const Page& page)
{
    std::string out = "<nav aria-label=\"Contents\"><ol>\n";
    for (std::size_t i = 0; i < page.sections.size(); ++i)
        out += "<li><a href=\"#s" + std::to_string(i + 1) + "\">" + html_text(page.sections[i].title) + "</a></li>\n";
    if (!page.provenance.empty()) out += "<li><a href=\"#provenance\">Provenance</a></li>\n";
    return out + "</ol></nav>\n";
}

std::string head_html(const Page& page)
{
    std::string out = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                      "<meta name=\"color-scheme\" content=\"light dark\">\n"
                      // Nothing may be loaded from anywhere, whatever a later change of the page asks for.
                      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
                      "'unsafe-inline'; script-src 'unsafe-inline'; img-src data: blob:\">\n<title>";
    out += html_text(page.title) + "</title>\n<style>\n";
    out += assets().uplot_style;
    out += "\n";
    out += assets().page_style;
    if (!page.footer.empty())
        out += "@media print { @page { @bottom-left { content: " + css_string(page.footer) + "; } } }\n";
    return out + "</style>\n</head>\n";
}

} // namespace

void order_sections(const std::string& titles, Page& page)
{
    auto next = page.sections.begin();
    for (std::size_t from = 0; from < titles.size();) {
        const std::size_t end = std::min(titles.find(',', from), titles.size());
        const std::size_t begin = std::min(titles.find_first_not_of(' ', from), end);
        const std::string title = titles.substr(begin, end - begin);
        from = end + 1;
        if (title.empty()) continue;
        const auto at = std::find_if(next, page.sections.end(), [&](const Section& s) { return s.title == title; });
        if (at == page.sections.end())
            page.warnings.push_back("criteria.report_order: this report has no section \"" + title + "\".");
        else
            std::rotate(next++, at, at + 1);
    }
}

std::string page_html(const Page& page)
{
    constexpr std::size_t as_long_as_most = 1 << 20;
    std::string out;
    out.reserve(as_long_as_most);
    out += head_html(page);
    out += "<body>\n<header>\n<div class=\"tools\"><button type=\"button\" id=\"unfold\">Open all</button>\n"
           "<button type=\"button\" id=\"theme\">Dark or light</button></div>\n<h1>" +
           html_text(page.title) + "</h1>\n";
    if (!page.subtitle.empty()) out += "<p class=\"subtitle\">" + html_text(page.subtitle) + "</p>\n";
    out += "</header>\n" + contents_html(page) + "<main>\n" + title_block_html(page.title_block) +
           headline_html(page.headline);
    if (!page.key_figures.empty()) out += pairs_html(page.key_figures, "figures");
    out += warnings_html(page.warnings);
    out += "<noscript><p class=\"note\">The charts need JavaScript; tables and drawings do not.</p></noscript>\n";
    for (std::size_t i = 0; i < page.sections.size(); ++i) out += section_html(page.sections[i], i + 1);
    if (!page.provenance.empty())
        out += "<section id=\"provenance\">\n<h2>Provenance</h2>\n" + pairs_html(page.provenance, "provenance") +
               "</section>\n";
    out += "</main>\n<div id=\"drawn\" hidden></div>\n<script>/*! uPlot\n";
    out += assets().uplot_license;
    out += "*/\n";
    out += assets().uplot_script;
    out += "</script>\n<script>\n";
    out += assets().state_map_script;
    out += assets().mesh_view_script;
    out += assets().page_script;
    out += "</script>\n</body>\n</html>\n";
    return out;
}

} // namespace damslip::pages

extern "C" {
extern const char damslip_uplot_js[], damslip_uplot_js_end[];
extern const char damslip_uplot_css[], damslip_uplot_css_end[];
extern const char damslip_uplot_license[], damslip_uplot_license_end[];
extern const char damslip_page_js[], damslip_page_js_end[];
extern const char damslip_state_map_js[], damslip_state_map_js_end[];
extern const char damslip_mesh_view_js[], damslip_mesh_view_js_end[];
extern const char damslip_page_css[], damslip_page_css_end[];
}

namespace damslip::pages {

const Assets& assets()
{
    static const Assets all{{damslip_uplot_js, damslip_uplot_js_end},
                            {damslip_uplot_css, damslip_uplot_css_end},
                            {damslip_uplot_license, damslip_uplot_license_end},
                            {damslip_page_js, damslip_page_js_end},
                            {damslip_state_map_js, damslip_state_map_js_end},
                            {damslip_mesh_view_js, damslip_mesh_view_js_end},
                            {damslip_page_css, damslip_page_css_end}};
    return all;
}

namespace {

constexpr std::size_t long_text = 40; ///< a sentence, which may be broken into lines [bytes]

/// Words of verdict and state columns that have to be seen at once; sentences.
std::string cell_class(const Cell& cell)
{
    if (is_number(cell)) return " class=\"number\"";
    const auto* word = std::get_if<std::string>(&cell);
    if (!word) return "";
    if (*word == "PASS" || word->starts_with("PASS ")) return " class=\"pass\"";
    if (*word == "FAIL" || word->starts_with("FAIL ") || *word == "UNRESOLVED" || *word == "SLIDES STATICALLY" ||
        *word == "SLIDES UPSTREAM" || *word == "FLOATS")
        return " class=\"fail\"";
    return word->size() > long_text ? " class=\"sentence\"" : "";
}

std::string cell_html(const Cell& cell, int digits)
{
    return "<td" + cell_class(cell) + ">" + html_text(cell_text(cell, digits)) + "</td>";
}

std::string heading_html(const Column& column)
{
    std::string out = html_text(column.heading);
    if (!column.unit.empty() && column.unit != "–")
        out += " <span class=\"unit\">" + html_text(column.unit) + "</span>";
    return out;
}

std::string by_rows(const Table& given)
{
    const Table table = verdict_after(given, 1); // where a narrow screen shows it without scrolling
    std::string out = "<thead><tr>";
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
        const bool number = !table.rows.empty() && is_number(table.rows.front()[j]);
        out += std::string("<th scope=\"col\"") + (number ? " class=\"number\"" : "") + ">" +
               heading_html(table.columns[j]) + "</th>";
    }
    out += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows) {
        out += "<tr>";
        for (std::size_t j = 0; j < row.size(); ++j) out += cell_html(row[j], table.columns[j].digits);
        out += "</tr>\n";
    }
    return out + "</tbody>";
}

std::string by_columns(const Table& table, std::size_t labels)
{
    std::string out = "<thead>\n";
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
        const bool head = j < labels;
        if (j == labels) out += "</thead>\n<tbody>\n";
        out += "<tr><th scope=\"row\">" + heading_html(table.columns[j]) + "</th>";
        for (const auto& row : table.rows)
            out += head ? "<th scope=\"col\" class=\"number\">" +
                              html_text(cell_text(row[j], table.columns[j].digits)) + "</th>"
                        : "<td class=\"number\">" + html_text(cell_text(row[j], table.columns[j].digits)) + "</td>";
        out += "</tr>\n";
    }
    return out + (table.columns.size() > labels ? "</tbody>" : "</thead>");
}

} // namespace

std::string table_html(const TablePart& part, const std::string& section)
{
    const Table table = with_slips_in_millimetres(part.table);
    const std::string title = html_text(table.title);
    // The frame scrolls where the table is wider than the page, so it takes the keyboard's focus.
    std::string body = "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + title + "\"><table>\n" +
                       (part.layout == Layout::rows ? by_rows(table) : by_columns(table, part.labels)) +
                       "\n</table></div>\n";
    for (const std::string& note : table.notes) body += "<p class=\"note\">" + html_text(note) + "</p>\n";
    for (const std::string& definition : part.definitions)
        body += "<p class=\"note\">" + html_text(definition) + "</p>\n";
    if (part.fold == Fold::folded)
        return "<details class=\"part\"><summary>" + title + "</summary>\n" + body + "</details>\n";
    return "<div class=\"part\">" + (title.empty() || table.title == section ? "" : "<h3>" + title + "</h3>\n") + body +
           "</div>\n";
}

namespace {

// Pixels of the drawing; y is up.
constexpr double width = 720.0, names = 200.0, figures = 130.0, row = 26.0, bar = 15.0, axis_height = 44.0;

/// 1, 2 or 5 times a power of ten, at most the value.
double round_step(double value)
{
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double digit : {5.0, 2.0})
        if (digit * power <= value) return digit * power;
    return power;
}

struct Frame {
    double low = 0.0, high = 0.0; ///< of the values
    /// Both sides that have bars have room for their figures.
    double x(double value) const
    {
        const double left = names + (low < 0 ? figures : 0.0);
        return left + (value - low) / (high - low) * (width - figures - left);
    }
};

Frame frame_of(const std::vector<Bar>& bars)
{
    Frame f;
    double largest = 0.0;
    for (const Bar& b : bars) {
        if (!b.value) continue;
        largest = std::max(largest, std::abs(*b.value));
        f.low = std::min(f.low, *b.value);
        f.high = std::max(f.high, *b.value);
    }
    for (const Bar& b : bars) { // whiskers longer than half the longest bar are cut at the frame
        if (!b.value) continue;
        f.low = std::min(f.low, *b.value - std::min(b.error, 0.5 * largest));
        f.high = std::max(f.high, *b.value + std::min(b.error, 0.5 * largest));
    }
    if (f.high == f.low) f.high = 1.0;
    return f;
}

void draw_axis(Sketch& sketch, const Frame& f, double top, const std::string& axis)
{
    const double step = round_step((f.high - f.low) / 3.0);
    for (double k = std::ceil(f.low / step); k * step <= f.high * (1 + 1e-12); ++k) {
        const double x = f.x(k * step);
        sketch.line({{x, axis_height}, {x, top}}, k == 0.0 ? "axis" : "grid-line");
        sketch.text({x, axis_height}, fmt::format("{:.6g}", k == 0.0 ? 0.0 : k * step), Align::middle, 0, 15, "small");
    }
    sketch.text({f.x(0.5 * (f.low + f.high)), axis_height}, axis, Align::middle, 0, 33, "small");
}

void draw_bar(Sketch& sketch, const Frame& f, const Bar& b, double middle)
{
    sketch.text({names, middle}, b.name, Align::end, -12, 4.5, "");
    if (!b.value) {
        sketch.text({f.x(0.0), middle}, b.words, Align::start, 8, 4.5, "small");
        return;
    }
    const double from = f.x(0.0), to = f.x(*b.value), low = middle - bar / 2, high = middle + bar / 2;
    const std::string css = std::string(*b.value > 0 ? "more" : "less") + (b.doubtful ? " doubtful" : "");
    if (from != to) sketch.polygon({{from, low}, {to, low}, {to, high}, {from, high}}, css);
    double end = to;
    if (b.error > 0) {
        const double a = f.x(std::max(f.low, *b.value - b.error)), z = f.x(std::min(f.high, *b.value + b.error));
        sketch.line({{a, middle}, {z, middle}}, "whisker");
        for (const double x : {a, z}) sketch.line({{x, middle - 4}, {x, middle + 4}}, "whisker");
        end = *b.value < 0 ? std::min(a, to) : std::max(z, to);
    }
    sketch.text({end, middle}, b.words, *b.value < 0 ? Align::end : Align::start, *b.value < 0 ? -6 : 6, 4.5,
                "halo small");
}

} // namespace

Drawing tornado(std::string title, std::vector<Bar> bars, const std::string& axis, const std::string& note)
{
    std::ranges::stable_sort(bars, [](const Bar& a, const Bar& b) {
        return (a.value ? std::abs(*a.value) : -1.0) > (b.value ? std::abs(*b.value) : -1.0);
    });
    const Frame f = frame_of(bars);
    const double top = axis_height + row * static_cast<double>(bars.size()) + 4.0;
    Sketch sketch({0, 0}, {width, top}, width);
    draw_axis(sketch, f, top, axis);
    double middle = top - 4.0 - row / 2;
    for (const Bar& b : bars) {
        draw_bar(sketch, f, b, middle);
        middle -= row;
    }
    std::string description = title + ":";
    for (const Bar& b : bars) description += fmt::format(" {} {};", b.name, b.words);
    return {std::move(title), sketch.svg(description), note};
}

} // namespace damslip::pages
