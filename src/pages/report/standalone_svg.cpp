#include "pages/report/standalone_svg.hpp"

#include "pages/report/assets.hpp"

#include <stdexcept>
#include <string_view>

namespace damslip::pages {

namespace {

/// The part of the page's style between two marks, the first included.
std::string part_of(std::string_view style, std::string_view from, std::string_view to)
{
    const std::size_t first = style.find(from);
    const std::size_t last = first == style.npos ? first : style.find(to, first);
    if (last == style.npos) throw std::logic_error("the page's style has no part " + std::string(from));
    return std::string(style.substr(first, last - first));
}

void replace_all(std::string& text, const std::string& what, const std::string& by)
{
    for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size())
        text.replace(at, what.size(), by);
}

} // namespace

std::string standalone_svg(const std::string& svg)
{
    const std::string_view style = page_style();
    std::string colours = part_of(style, ":root {", "}") + "}\n";
    std::string shapes = part_of(style, "/* drawings */", "@media");
    replace_all(colours, ":root", "svg");
    replace_all(shapes, ".drawing text", "text");
    std::string out = svg;
    if (out.find("xmlns=") == out.npos) out.insert(out.find("<svg") + 4, " xmlns=\"http://www.w3.org/2000/svg\"");
    out.insert(out.find('>') + 1,
               "<style>\n" + colours + "svg { background: var(--paper); }\n" + shapes + "</style>\n");
    return out + "\n";
}

} // namespace damslip::pages
