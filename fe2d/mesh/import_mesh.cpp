#include "fe2d/mesh/import_mesh.hpp"

#include "core/input_error.hpp"
#include "fe2d/gmsh/gmsh.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <numeric>

namespace damslip::fe2d {

namespace {

constexpr double same_place = 1e-6; ///< share of the base length within which nodes of one body are the same node

const std::vector<std::string> surface_names{"dam", "rock", "curtain"};
const std::vector<std::string> line_names{"base",   "upstream",  "downstream", "crest",      "floor",
                                          "ground", "rock-left", "rock-right", "rock-bottom"};

constexpr const char* name_surfaces =
    "in Gmsh:  Physical Surface(\"dam\") = {...};  Physical Surface(\"rock\") = {...};";

std::string zone_of(const std::string& name)
{
    return name.substr(0, name.find(':'));
}

void check_names(const GmshFile& file)
{
    for (const GmshGroup& group : file.groups) {
        if (group.dimension == 0 || group.dimension == 3) continue;
        const std::vector<std::string>& known = group.dimension == 2 ? surface_names : line_names;
        const std::string name = group.dimension == 2 ? zone_of(group.name) : group.name;
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        const std::string_view like = nearest(name, known);
        if (group.dimension == 1 && like.empty()) continue; // a line for somebody else
        const bool water = name == "water" || name == "reservoir";
        refuse_mesh(file, group.line,
                    fmt::format("physical {} \"{}\" is not known.{}", group.dimension == 2 ? "surface" : "line",
                                group.name, like.empty() ? "" : fmt::format(" Did you mean \"{}\"?", like)),
                    fmt::format("\"{}\"{}", fmt::join(known, "\", \""),
                                group.dimension == 2 ? ", each also with a zone: \"rock:weathered\"" : ""),
                    water ? "take the water out of the mesh: the program meshes it from [reservoir] itself"
                          : "rename the group, or take it out of the mesh");
    }
}

Region region_of(const std::string& name)
{
    const std::string zone = zone_of(name);
    return zone == "dam" ? Region::dam : zone == "rock" ? Region::rock : Region::curtain;
}

/// Region of every triangle and quadrilateral by the names of its groups; lines have none.
std::vector<std::optional<Region>> regions_of(const GmshFile& file)
{
    std::vector<std::optional<Region>> regions(file.elements.size());
    for (std::size_t e = 0; e < file.elements.size(); ++e) {
        const GmshElement& element = file.elements[e];
        if (dimension(element.shape) != 2) continue;
        for (const GmshGroup& group : file.groups) {
            if (group.dimension != 2 ||
                std::find(element.groups.begin(), element.groups.end(), group.tag) == element.groups.end())
                continue;
            const Region region = region_of(group.name);
            if (regions[e] && *regions[e] != region)
                refuse_mesh(
                    file, element.line,
                    fmt::format("element {} belongs to two bodies, one of them \"{}\".", element.tag, group.name),
                    "each surface in one of \"dam\", \"rock\", \"curtain\"", name_surfaces);
            regions[e] = region;
        }
        if (!regions[e])
            refuse_mesh(file, element.line,
                        fmt::format("element {} is in no physical surface with a name.", element.tag),
                        "every triangle and quadrilateral in \"dam\", \"rock\" or \"curtain\"", name_surfaces);
    }
    return regions;
}

/// The regions that one body consists of, as the scene wants them.
std::vector<std::optional<Region>> only(const std::vector<std::optional<Region>>& regions, const Scene& scene,
                                        Region body)
{
    std::vector<std::optional<Region>> result = regions;
    for (std::optional<Region>& region : result) {
        if (!region) continue;
        if ((*region == Region::dam) != (body == Region::dam))
            region.reset();
        else if (*region == Region::curtain && !curtain_is_meshed(scene))
            region = Region::rock;
    }
    return result;
}

void check_bodies(const GmshFile& file, const std::vector<std::optional<Region>>& regions, const Scene& scene)
{
    const auto there = [&](Region region) {
        return std::find(regions.begin(), regions.end(), region) != regions.end();
    };
    if (!there(Region::dam))
        refuse_mesh(file, 0, "the mesh has no dam.", "triangles or quadrilaterals in the physical surface \"dam\"",
                    name_surfaces);
    if (scene.foundation && !there(Region::rock))
        refuse_mesh(file, 0, fmt::format("the mesh has no rock, but {} has a [foundation].", scene.file.string()),
                    "triangles or quadrilaterals in the physical surface \"rock\"",
                    "mesh the rock too, or delete [foundation] for a rigid base");
    if (curtain_is_meshed(scene) && !there(Region::curtain))
        refuse_mesh(
            file, 0, "the mesh has no curtain, but the scene's differs from the rock.",
            "triangles or quadrilaterals in the physical surface \"curtain\"",
            "mesh the curtain as a surface of its own; or give it the rock's stiffness and no flow on this mesh "
            "(stages.pore_pressure)");
    if (scene.foundation && scene.drains && scene.stages.pore_pressure != PorePressure::none)
        refuse_mesh(file, 0, "stages.pore_pressure with [drains] needs nodes along the drain line.",
                    "no drains, or no flow on this mesh, where the mesh is imported",
                    "delete stages.pore_pressure: uplift.model = \"seepage\" has a mesh of its own, with drains");
}

/// Coordinates in metres; the section lies in one plane.
void to_metres(GmshFile& file, double unit)
{
    double size = 0.0;
    for (const GmshNode& node : file.nodes) size = std::max({size, std::abs(node.at.x), std::abs(node.at.y)});
    for (GmshNode& node : file.nodes) {
        if (std::abs(node.z - file.nodes.front().z) > same_place * size)
            refuse_mesh(
                file, node.line,
                fmt::format("node {} has z = {:g}, the first one {:g}.", node.tag, node.z, file.nodes.front().z),
                "a plane section: x downstream, y up, z the same everywhere", "turn the geometry into the x-y plane");
        node.at = {unit * node.at.x, unit * node.at.y};
    }
}

} // namespace

ImportedMesh import_mesh(const Scene& scene, const ContactExtension& extension)
{
    return import_mesh(read_gmsh(*scene.mesh.file), scene, extension);
}

ImportedMesh import_mesh(GmshFile file, const Scene& scene, const ContactExtension& extension)
{
    to_metres(file, scene.mesh.file_unit);
    check_names(file);
    const auto regions = regions_of(file);
    check_bodies(file, regions, scene);

    const double tolerance = same_place * base_length(scene.section);
    ImportedMesh imported;
    ImportSummary& summary = imported.summary;
    summary.version = file.version;
    summary.file_nodes = static_cast<int>(file.nodes.size());
    std::vector<char> used(file.nodes.size(), 0);
    const auto count = [&](const ImportedBody& body) {
        for (std::size_t n = 0; n < used.size(); ++n)
            if (body.own_node[n] >= 0) used[n] = 1;
        summary.joined += body.joined;
        summary.flipped += body.flipped;
    };
    const ImportedBody dam = take_body(file, "dam", only(regions, scene, Region::dam), tolerance);
    append_imported_dam(imported.mesh, file, dam, scene);
    count(dam);
    if (scene.foundation) {
        const ImportedBody rock = take_body(file, "rock", only(regions, scene, Region::rock), tolerance);
        append_imported_rock(imported.mesh, file, rock, scene, extension);
        count(rock);
        if (!imported.mesh.contact.matching && scene.stages.pore_pressure == PorePressure::effective)
            refuse_mesh(file, 0, "the nodes of dam and rock do not face each other along the base.",
                        "the same nodes on both sides for stages.pore_pressure = \"effective\"",
                        "let dam and rock share the curve from heel to toe, or use  pore_pressure = \"total\"");
    }
    summary.unused = static_cast<int>(std::count(used.begin(), used.end(), 0));
    return imported;
}

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
