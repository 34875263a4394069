#include "fe2d/mesh/imported_body.hpp"

#include "core/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace damslip::fe2d {

namespace {

constexpr double flattest_imported = 0.01; ///< scaled Jacobian, as of check_quality

double twice_area(Point a, Point b, Point c)
{
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/// For every node of `used` (indices in the file, increasing) the first one at its place.
std::map<int, int> first_at_place(const GmshFile& file, const std::vector<int>& used, double same_place)
{
    std::vector<int> by_x = used;
    std::stable_sort(by_x.begin(), by_x.end(), [&](int a, int b) { return file.nodes[a].at.x < file.nodes[b].at.x; });
    std::map<int, int> first;
    for (const int n : used) first[n] = n;
    for (std::size_t i = 0; i < by_x.size(); ++i)
        for (std::size_t k = i + 1; k < by_x.size(); ++k) {
            const Point a = file.nodes[by_x[i]].at, b = file.nodes[by_x[k]].at;
            if (b.x - a.x > same_place) break;
            if (std::abs(b.y - a.y) > same_place) continue;
            int &one = first[by_x[i]], &other = first[by_x[k]];
            one = other = std::min(one, other);
        }
    return first;
}

/// Lines may have nodes of their own at the places of the body's.
void find_line_nodes(const GmshFile& file, std::vector<int> used, double same_place, std::vector<int>& own_node)
{
    const auto x_of = [&](int n) { return file.nodes[n].at.x; };
    std::sort(used.begin(), used.end(), [&](int a, int b) { return x_of(a) < x_of(b); });
    for (const GmshElement& e : file.elements)
        for (int i = 0; e.shape == GmshShape::line && i < 2; ++i) {
            const int n = e.nodes[i];
            if (own_node[n] >= 0) continue;
            auto at = std::lower_bound(used.begin(), used.end(), x_of(n) - same_place,
                                       [&](int a, double x) { return x_of(a) < x; });
            for (; at != used.end() && x_of(*at) <= x_of(n) + same_place; ++at)
                if (std::abs(file.nodes[*at].at.y - file.nodes[n].at.y) <= same_place) own_node[n] = own_node[*at];
        }
}

/// Smallest scaled Jacobian over the corners (see MeshQuality); negative where one turns the other way.
double scaled_jacobian(const std::array<Point, 4>& p, int n)
{
    double smallest = HUGE_VAL;
    for (int i = 0; i < n; ++i) {
        const Point a = p[(i + n - 1) % n], b = p[i], c = p[(i + 1) % n];
        const double lengths = std::hypot(c.x - b.x, c.y - b.y) * std::hypot(a.x - b.x, a.y - b.y);
        smallest = std::min(smallest, lengths > 0.0 ? twice_area(b, c, a) / lengths : 0.0);
    }
    return n == 4 ? smallest : smallest * 2.0 / std::numbers::sqrt3;
}

Element element_of(const GmshFile& file, ImportedBody& body, const GmshElement& source, Region region)
{
    Element element{{-1, -1, -1, -1}, region};
    const int n = node_count(source.shape);
    for (int i = 0; i < n; ++i) element.nodes[i] = body.own_node[source.nodes[i]];
    std::array<Point, 4> p{};
    const auto place = [&] {
        for (int i = 0; i < n; ++i) p[i] = body.nodes[element.nodes[i]];
    };
    place();
    double area = 0.5 * twice_area(p[0], p[1], p[2]) + (n == 4 ? 0.5 * twice_area(p[0], p[2], p[3]) : 0.0);
    if (area < 0.0) {
        std::reverse(element.nodes.begin() + 1, element.nodes.begin() + n);
        place();
        area = -area;
        ++body.flipped;
    }
    if (const double shape = scaled_jacobian(p, n); !(shape >= flattest_imported))
        refuse_mesh(file, source.line,
                    fmt::format("element {} of the {} at ({:.6g}, {:.6g}) m is {} (scaled Jacobian {:.3g}).",
                                source.tag, body.name, p[0].x, p[0].y, shape < 0.0 ? "folded or re-entrant" : "flat",
                                shape),
                    fmt::format("every corner with a scaled Jacobian of at least {:g}", flattest_imported),
                    "mesh again: optimise the mesh, or leave out Recombine");
    body.area += area;
    return element;
}

using DirectedEdges = std::map<std::pair<int, int>, std::size_t>; ///< to the element on the left

DirectedEdges directed_edges(const GmshFile& file, const ImportedBody& body)
{
    DirectedEdges edges;
    for (std::size_t e = 0; e < body.elements.size(); ++e) {
        const Element& element = body.elements[e];
        for (int i = 0; i < element.size(); ++i) {
            const int a = element.nodes[i], b = element.nodes[(i + 1) % element.size()];
            const auto [other, added] = edges.emplace(std::pair{a, b}, e);
            if (!added)
                refuse_mesh(file, body.lines[e],
                            fmt::format("this element of the {} and the one of line {} overlap at ({:.6g}, {:.6g}) m.",
                                        body.name, body.lines[other->second], body.nodes[a].x, body.nodes[a].y),
                            "elements side by side, each in one physical surface",
                            "take the surface out of all physical groups but one, or mesh it once");
        }
    }
    return edges;
}

} // namespace

void refuse_mesh(const GmshFile& file, int line, std::string problem, std::string expected, std::string fix)
{
    throw InputError(Diagnostic{.file = file.file.string(),
                                .line = line,
                                .column = 0,
                                .problem = std::move(problem),
                                .expected = std::move(expected),
                                .fix = std::move(fix)});
}

ImportedBody take_body(const GmshFile& file, const std::string& name,
                       const std::vector<std::optional<Region>>& region_of, double same_place)
{
    ImportedBody body;
    body.name = name;
    body.own_node.assign(file.nodes.size(), -1);
    std::vector<int> used;
    for (std::size_t e = 0; e < file.elements.size(); ++e)
        for (int i = 0; region_of[e] && i < node_count(file.elements[e].shape); ++i)
            used.push_back(file.elements[e].nodes[i]);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const std::map<int, int> first = first_at_place(file, used, same_place);
    for (const int n : used)
        if (first.at(n) == n) {
            body.own_node[n] = static_cast<int>(body.nodes.size());
            body.nodes.push_back(file.nodes[n].at);
        }
    for (const int n : used)
        if (first.at(n) != n) {
            int to = first.at(n);
            while (first.at(to) != to) to = first.at(to);
            body.own_node[n] = body.own_node[to];
            ++body.joined;
        }
    find_line_nodes(file, used, same_place, body.own_node);
    for (std::size_t e = 0; e < file.elements.size(); ++e) {
        if (!region_of[e]) continue;
        body.elements.push_back(element_of(file, body, file.elements[e], *region_of[e]));
        body.lines.push_back(file.elements[e].line);
    }
    return body;
}

NodeChain outline_of(const GmshFile& file, const ImportedBody& body)
{
    const DirectedEdges edges = directed_edges(file, body);
    std::map<int, int> next;
    for (const auto& [ab, element] : edges) {
        if (edges.contains({ab.second, ab.first})) continue;
        const Point p = body.nodes[ab.first];
        if (!next.emplace(ab.first, ab.second).second)
            refuse_mesh(file, body.lines[element],
                        fmt::format("parts of the {} touch only in the point ({:.6g}, {:.6g}) m.", body.name, p.x, p.y),
                        "elements joined by whole edges", "mesh the geometry again, in one piece");
    }
    NodeChain outline{next.begin()->first};
    for (int n = next.begin()->second; n != outline.front(); n = next.at(n)) outline.push_back(n);
    if (outline.size() < next.size()) {
        std::vector<char> reached(body.nodes.size(), 0);
        for (const int n : outline) reached[n] = 1;
        const auto other = std::find_if(next.begin(), next.end(), [&](auto& e) { return !reached[e.first]; });
        const Point p = body.nodes[outline.front()], q = body.nodes[other->first];
        refuse_mesh(file, 0,
                    fmt::format("the {} has more than one outline: through ({:.6g}, {:.6g}) m and ({:.6g}, {:.6g}) m.",
                                body.name, p.x, p.y, q.x, q.y),
                    "one body without openings, its elements joined by whole edges",
                    "close openings; where neighbouring surfaces were meshed apart, let them share their curve "
                    "(Coherence, or BooleanFragments)");
    }
    return outline;
}

std::optional<EdgeSet> named_edges(const GmshFile& file, const ImportedBody& body, const std::string& name)
{
    const auto group = std::find_if(file.groups.begin(), file.groups.end(),
                                    [&](const GmshGroup& g) { return g.dimension == 1 && g.name == name; });
    if (group == file.groups.end()) return std::nullopt;
    EdgeSet edges;
    for (const GmshElement& e : file.elements) {
        if (e.shape != GmshShape::line) continue;
        if (std::find(e.groups.begin(), e.groups.end(), group->tag) == e.groups.end()) continue;
        const int a = body.own_node[e.nodes[0]], b = body.own_node[e.nodes[1]];
        if (a >= 0 && b >= 0 && a != b) edges.insert(edge(a, b));
    }
    return edges;
}

void check_named(const GmshFile& file, const ImportedBody& body, const std::string& name, const NodeChain& chain)
{
    const auto named = named_edges(file, body, name);
    if (!named) return;
    EdgeSet own;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) own.insert(edge(chain[i], chain[i + 1]));
    if (own == *named) return;
    EdgeSet different;
    std::set_symmetric_difference(own.begin(), own.end(), named->begin(), named->end(),
                                  std::inserter(different, different.end()));
    const auto [a, b] = *different.begin();
    const Point p = body.nodes[a], q = body.nodes[b];
    refuse_mesh(file, 0,
                fmt::format("physical line \"{}\" does not fit: the edge ({:.6g}, {:.6g}) - ({:.6g}, {:.6g}) m {}.",
                            name, p.x, p.y, q.x, q.y,
                            own.contains(edge(a, b)) ? "belongs to that side of the " + body.name + " and is not in it"
                                                     : "is in it and does not belong to that side of the " + body.name),
                "all edges of one side of the outline, between two corners, and no others",
                "correct the group; a line that is not named is found from the section");
}

} // namespace damslip::fe2d
