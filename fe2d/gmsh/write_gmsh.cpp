#include "fe2d/gmsh/gmsh.hpp"

#include "core/input_error.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace damslip::fe2d {

namespace {

std::string header(const GmshFile& mesh, const char* version)
{
    std::string out =
        fmt::format("$MeshFormat\n{} 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", version, mesh.groups.size());
    for (const GmshGroup& group : mesh.groups)
        out += fmt::format("{} {} \"{}\"\n", group.dimension, group.tag, group.name);
    return out + "$EndPhysicalNames\n";
}

std::string place(const GmshNode& node)
{
    return shortest(node.at.x) + " " + shortest(node.at.y) + " " + shortest(node.z);
}

std::string nodes_of(const GmshFile& mesh, const GmshElement& element)
{
    std::string out;
    for (int i = 0; i < node_count(element.shape); ++i) out += fmt::format(" {}", mesh.nodes[element.nodes[i]].tag);
    return out;
}

int gmsh_type(GmshShape shape)
{
    return static_cast<int>(shape) + 1;
}

std::string text_2_2(const GmshFile& mesh)
{
    std::string out = header(mesh, "2.2") + fmt::format("$Nodes\n{}\n", mesh.nodes.size());
    for (const GmshNode& node : mesh.nodes) out += fmt::format("{} {}\n", node.tag, place(node));
    out += fmt::format("$EndNodes\n$Elements\n{}\n", mesh.elements.size());
    for (const GmshElement& e : mesh.elements)
        out += fmt::format("{} {} 2 {} {}{}\n", e.tag, gmsh_type(e.shape), e.groups.front(), e.groups.front(),
                           nodes_of(mesh, e));
    return out + "$EndElements\n";
}

struct Box {
    double low_x = HUGE_VAL, low_y = HUGE_VAL, high_x = -HUGE_VAL, high_y = -HUGE_VAL;
};

Box box_of(const GmshFile& mesh, const GmshGroup& group)
{
    Box box;
    for (const GmshElement& e : mesh.elements) {
        if (dimension(e.shape) != group.dimension || e.groups.front() != group.tag) continue;
        for (int i = 0; i < node_count(e.shape); ++i) {
            const Point p = mesh.nodes[e.nodes[i]].at;
            box.low_x = std::min(box.low_x, p.x), box.high_x = std::max(box.high_x, p.x);
            box.low_y = std::min(box.low_y, p.y), box.high_y = std::max(box.high_y, p.y);
        }
    }
    return box;
}

/// An entity for every group, with the group's tag.
std::string entities(const GmshFile& mesh)
{
    const auto count = [&](int dimension) {
        return std::count_if(mesh.groups.begin(), mesh.groups.end(),
                             [&](const GmshGroup& g) { return g.dimension == dimension; });
    };
    std::string out = fmt::format("$Entities\n0 {} {} 0\n", count(1), count(2));
    for (const int dimension : {1, 2})
        for (const GmshGroup& g : mesh.groups) {
            if (g.dimension != dimension) continue;
            const Box box = box_of(mesh, g);
            out += fmt::format("{} {} {} 0 {} {} 0 1 {} 0\n", g.tag, shortest(box.low_x), shortest(box.low_y),
                               shortest(box.high_x), shortest(box.high_y), g.tag);
        }
    return out + "$EndEntities\n";
}

/// Elements that follow each other with the same shape and group are one block.
std::string blocks(const GmshFile& mesh)
{
    std::string out;
    std::size_t count = 0;
    for (std::size_t i = 0, end = 0; i < mesh.elements.size(); i = end, ++count) {
        const GmshElement& first = mesh.elements[i];
        while (end < mesh.elements.size() && mesh.elements[end].shape == first.shape &&
               mesh.elements[end].groups == first.groups)
            ++end;
        out +=
            fmt::format("{} {} {} {}\n", dimension(first.shape), first.groups.front(), gmsh_type(first.shape), end - i);
        for (std::size_t k = i; k < end; ++k)
            out += fmt::format("{}{}\n", mesh.elements[k].tag, nodes_of(mesh, mesh.elements[k]));
    }
    const std::size_t n = mesh.elements.size();
    return fmt::format("$Elements\n{} {} {} {}\n", count, n, n ? mesh.elements.front().tag : 0,
                       n ? mesh.elements.back().tag : 0) +
           out + "$EndElements\n";
}

std::string text_4_1(const GmshFile& mesh)
{
    const auto surface = std::find_if(mesh.groups.begin(), mesh.groups.end(), [](auto& g) { return g.dimension == 2; });
    assert(surface != mesh.groups.end() && !mesh.nodes.empty());
    const std::size_t n = mesh.nodes.size();
    std::string out = header(mesh, "4.1") + entities(mesh) +
                      fmt::format("$Nodes\n1 {} {} {}\n2 {} 0 {}\n", n, mesh.nodes.front().tag, mesh.nodes.back().tag,
                                  surface->tag, n);
    for (const GmshNode& node : mesh.nodes) out += fmt::format("{}\n", node.tag);
    for (const GmshNode& node : mesh.nodes) out += place(node) + "\n";
    return out + "$EndNodes\n" + blocks(mesh);
}

} // namespace

std::string gmsh_text(const GmshFile& mesh, GmshVersion version)
{
    assert(std::all_of(mesh.elements.begin(), mesh.elements.end(), [](auto& e) { return e.groups.size() == 1; }));
    return version == GmshVersion::v2_2 ? text_2_2(mesh) : text_4_1(mesh);
}

namespace {

constexpr std::string_view blanks = " \t\r\v\f";
constexpr std::size_t shown = 60; ///< characters of the file in a message

std::string_view trimmed(std::string_view text)
{
    const std::size_t from = text.find_first_not_of(blanks);
    if (from == std::string_view::npos) return {};
    return text.substr(from, text.find_last_not_of(blanks) - from + 1);
}

/// What the file has, as far as a terminal can show it.
std::string printable(std::string_view text)
{
    std::string out;
    for (const char c : text.substr(0, shown)) out += c < ' ' || c > '~' ? '?' : c;
    return text.size() > shown ? out + "..." : out;
}

} // namespace

bool GmshLines::next()
{
    while (!rest_.empty()) {
        const std::size_t end = rest_.find('\n');
        line_ = trimmed(rest_.substr(0, end));
        rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
        ++number_;
        if (!line_.empty()) return true;
    }
    return false;
}

void GmshLines::need(const std::string& section)
{
    if (!next())
        refuse("the file ends inside $" + section + ".", "a line $End" + section + " after as many lines as announced",
               "the file looks cut: write it again");
}

void GmshLines::refuse(std::string problem, std::string expected, std::string fix) const
{
    throw InputError(Diagnostic{.file = file_,
                                .line = number_,
                                .column = 0,
                                .problem = std::move(problem),
                                .expected = std::move(expected),
                                .fix = std::move(fix)});
}

std::string_view GmshWords::word(const char* what)
{
    const std::size_t from = rest_.find_first_not_of(blanks);
    if (from == std::string_view::npos)
        lines_.refuse(fmt::format("{} is missing: the line \"{}\" ends too early.", what, printable(lines_.line())),
                      what, "write the mesh again with Gmsh, or complete the line");
    const std::size_t end = rest_.find_first_of(blanks, from);
    const std::string_view word = rest_.substr(from, end == std::string_view::npos ? end : end - from);
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end);
    return word;
}

std::int64_t GmshWords::whole(const char* what, std::int64_t low, std::int64_t high)
{
    const std::string_view text = word(what);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < low || value > high)
        lines_.refuse(fmt::format("{} = {} is not allowed.", what, printable(text)),
                      fmt::format("a whole number {} ... {}", low, high),
                      "write the mesh again, or correct the number");
    return value;
}

double GmshWords::number(const char* what)
{
    const std::string_view text = word(what);
    const auto value = parse_whole_number_text(text);
    if (!value)
        lines_.refuse(fmt::format("{} = {} is not allowed.", what, printable(text)), "a finite number",
                      "write the mesh again, or correct the number");
    return *value;
}

std::string GmshWords::quoted(const char* what)
{
    const std::string_view text = trimmed(rest_);
    if (text.size() < 2 || text.front() != '"' || text.back() != '"' || text.find('"', 1) != text.size() - 1)
        lines_.refuse(fmt::format("{} = {} is not allowed.", what, printable(text)), "a text in double quotes",
                      "for example  2 1 \"dam\"");
    rest_ = {};
    return std::string(text.substr(1, text.size() - 2));
}

void GmshWords::end() const
{
    if (const std::string_view text = trimmed(rest_); !text.empty())
        lines_.refuse(fmt::format("\"{}\" is too much in the line \"{}\".", printable(text), printable(lines_.line())),
                      "no more entries on this line", "write the mesh again, or delete what is too much");
}

} // namespace damslip::fe2d
