#include "fe2d/mesh/mesh.hpp"

#include "scene/section.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace damslip::fe2d {

ElementNodes Element::all() const
{
    ElementNodes result;
    const auto add = [&result](int node) {
        if (node >= 0) result.index[result.count++] = node;
    };
    for (const int node : nodes) add(node);
    for (const int node : mid) add(node);
    add(centre);
    return result;
}

int mid_node(const Mesh& mesh, int a, int b)
{
    if (mesh.edge_nodes.empty()) return -1;
    if (b < a) std::swap(a, b);
    const auto at = std::lower_bound(mesh.edge_nodes.begin(), mesh.edge_nodes.end(), std::pair{a, b},
                                     [](const EdgeNode& edge, const std::pair<int, int>& key) {
                                         return std::pair{edge.a, edge.b} < key;
                                     });
    return at != mesh.edge_nodes.end() && at->a == a && at->b == b ? at->mid : -1;
}

std::vector<int> with_mid_nodes(const Mesh& mesh, const NodeChain& chain)
{
    if (mesh.edge_nodes.empty()) return chain;
    std::vector<int> nodes;
    for (std::size_t i = 0; i < chain.size(); ++i) {
        nodes.push_back(chain[i]);
        const int mid = i + 1 < chain.size() ? mid_node(mesh, chain[i], chain[i + 1]) : -1;
        if (mid >= 0) nodes.push_back(mid);
    }
    return nodes;
}

std::array<Point, 4> corners(const Mesh& mesh, const Element& element)
{
    std::array<Point, 4> result{};
    for (int i = 0; i < element.size(); ++i) result[i] = mesh.nodes[element.nodes[i]];
    return result;
}

namespace {

using Corners = std::pair<int, int>; ///< of an edge, the smaller first

Corners edge_of(int a, int b)
{
    return a < b ? Corners{a, b} : Corners{b, a};
}

std::set<Corners> contact_edges(const Mesh& mesh)
{
    std::set<Corners> edges;
    const auto add = [&edges](const std::vector<int>& nodes) {
        for (std::size_t i = 0; i + 1 < nodes.size(); ++i) edges.insert(edge_of(nodes[i], nodes[i + 1]));
    };
    add(mesh.contact.dam_nodes);
    add(mesh.contact.rock_nodes);
    add(mesh.contact.rock_line);
    for (const LiftPlane& lift : mesh.lifts) {
        add(lift.lower_nodes);
        add(lift.upper_nodes);
    }
    for (const LiftPlane& lift : mesh.tied_lifts) add(lift.lower_nodes);
    return edges;
}

/// Every index of a rock node goes up by `shift`.
void shift_rock(Mesh& mesh, int shift)
{
    const int first = mesh.dam_node_count;
    const auto move = [first, shift](std::vector<int>& nodes) {
        for (int& node : nodes)
            if (node >= first) node += shift;
    };
    for (Element& element : mesh.elements)
        for (int& node : element.nodes)
            if (node >= first) node += shift;
    for (std::vector<int>* nodes : {&mesh.contact.dam_nodes, &mesh.contact.rock_nodes, &mesh.contact.rock_line,
                                    &mesh.upstream_face, &mesh.downstream_face, &mesh.crest, &mesh.floor, &mesh.ground,
                                    &mesh.box_left, &mesh.box_right, &mesh.box_bottom})
        move(*nodes);
}

/// Gives the elements of one body their nodes, from `next` on; `places` takes where they are.
class Enrichment {
public:
    Enrichment(const Mesh& mesh, QuadraticKind kind) : mesh_(mesh), kind_(kind), linear_(contact_edges(mesh)) {}

    void add(Element& element, int first, std::vector<Point>& places)
    {
        const int size = element.size();
        for (int i = 0; i < size; ++i)
            element.mid[i] = edge(element.nodes[i], element.nodes[(i + 1) % size], first, places);
        if (size == 3 || kind_ == QuadraticKind::serendipity) return;
        Point centre;
        for (const int node : element.nodes) {
            centre.x += 0.25 * mesh_.nodes[node].x;
            centre.y += 0.25 * mesh_.nodes[node].y;
        }
        element.centre = first + static_cast<int>(places.size());
        places.push_back(centre);
    }

    const std::map<Corners, int>& edges() const { return mids_; }

private:
    int edge(int a, int b, int first, std::vector<Point>& places)
    {
        const Corners key = edge_of(a, b);
        if (linear_.contains(key)) return -1;
        const auto [at, fresh] = mids_.try_emplace(key, first + static_cast<int>(places.size()));
        if (fresh) {
            const Point &p = mesh_.nodes[a], &q = mesh_.nodes[b];
            places.push_back({0.5 * (p.x + q.x), 0.5 * (p.y + q.y)});
        }
        return at->second;
    }

    const Mesh& mesh_;
    QuadraticKind kind_;
    std::set<Corners> linear_;
    std::map<Corners, int> mids_;
};

} // namespace

void make_quadratic(Mesh& mesh, QuadraticKind kind)
{
    const int dam_nodes = mesh.dam_node_count, all_nodes = mesh.node_count();
    Enrichment enrichment(mesh, kind);
    std::vector<Point> dam, rock;
    for (int e = 0; e < mesh.dam_element_count; ++e) enrichment.add(mesh.elements[e], dam_nodes, dam);
    const int shift = static_cast<int>(dam.size());
    for (int e = mesh.dam_element_count; e < mesh.element_count(); ++e)
        enrichment.add(mesh.elements[e], all_nodes + shift, rock);
    for (const auto& [corners, mid] : enrichment.edges()) {
        const int up = corners.first >= dam_nodes ? shift : 0; // both corners are the dam's or the rock's
        mesh.edge_nodes.push_back({corners.first + up, corners.second + up, mid});
    }
    shift_rock(mesh, shift);
    mesh.nodes.insert(mesh.nodes.begin() + dam_nodes, dam.begin(), dam.end());
    mesh.nodes.insert(mesh.nodes.end(), rock.begin(), rock.end());
    mesh.dam_node_count += shift;
}

namespace {

class MeshExport {
public:
    MeshExport(const Mesh& mesh, BaseNodes base) : mesh_(mesh), node_of_(mesh.nodes.size())
    {
        for (std::size_t n = 0; n < node_of_.size(); ++n) node_of_[n] = static_cast<int>(n);
        const ContactPlane& plane = mesh.contact;
        if (base == BaseNodes::shared) {
            assert(plane.matching);
            for (std::size_t i = 0; i < plane.rock_nodes.size(); ++i)
                node_of_[plane.rock_nodes[i]] = plane.dam_nodes[i];
        }
        std::vector<int> place(mesh.nodes.size(), -1);
        for (std::size_t n = 0; n < node_of_.size(); ++n) {
            if (node_of_[n] != static_cast<int>(n)) continue;
            place[n] = static_cast<int>(file_.nodes.size());
            file_.nodes.push_back({static_cast<std::int64_t>(n) + 1, mesh.nodes[n], 0.0, 0});
        }
        for (int& n : node_of_) n = place[n];
    }

    /// A physical line of the edges of a chain; those of no length (at lift joints) are left out.
    void add_line(const char* name, const NodeChain& chain)
    {
        if (chain.size() < 2) return;
        const int tag = add_group(1, name);
        for (std::size_t i = 0; i + 1 < chain.size(); ++i)
            if (mesh_.nodes[chain[i]] != mesh_.nodes[chain[i + 1]])
                add_element(GmshShape::line, {node_of_[chain[i]], node_of_[chain[i + 1]], -1, -1}, tag);
    }

    void add_surfaces()
    {
        int tags[region_count] = {};
        const char* names[region_count] = {"dam", "rock", "curtain", "", "block"};
        for (const Element& element : mesh_.elements) {
            const auto region = static_cast<int>(element.region);
            assert(element.region != Region::reservoir);
            if (tags[region] == 0) tags[region] = add_group(2, names[region]);
            std::array<int, 4> nodes{-1, -1, -1, -1};
            for (int i = 0; i < element.size(); ++i) nodes[i] = node_of_[element.nodes[i]];
            add_element(element.size() == 3 ? GmshShape::triangle : GmshShape::quadrilateral, nodes, tags[region]);
        }
    }

    GmshFile file() && { return std::move(file_); }

private:
    int add_group(int dimension, const char* name)
    {
        file_.groups.push_back({dimension, static_cast<int>(file_.groups.size()) + 1, name, 0});
        return file_.groups.back().tag;
    }

    void add_element(GmshShape shape, std::array<int, 4> nodes, int group)
    {
        file_.elements.push_back({static_cast<std::int64_t>(file_.elements.size()) + 1, shape, nodes, {group}, 0});
    }

    const Mesh& mesh_;
    GmshFile file_;
    std::vector<int> node_of_; ///< in the file, of every node of the mesh
};

} // namespace

GmshFile export_mesh(const Mesh& mesh, BaseNodes base)
{
    MeshExport out(mesh, base);
    out.add_line("base", mesh.contact.dam_nodes);
    out.add_line("downstream", mesh.downstream_face);
    out.add_line("crest", mesh.crest);
    out.add_line("upstream", mesh.upstream_face);
    out.add_line("floor", mesh.floor);
    out.add_line("rock-left", mesh.box_left);
    out.add_line("rock-bottom", mesh.box_bottom);
    out.add_line("rock-right", mesh.box_right);
    out.add_line("ground", mesh.ground);
    out.add_surfaces();
    return std::move(out).file();
}

void set_shares(Mesh& mesh, const Section& section, const std::vector<LiftJoint>& lift_joints)
{
    if (section.thickness.empty()) return;
    for (int e = 0; e < mesh.dam_element_count; ++e) {
        Element& element = mesh.elements[static_cast<std::size_t>(e)];
        const std::array<Point, 4> c = corners(mesh, element);
        const auto [low, high] = std::minmax_element(c.begin(), c.begin() + element.size(),
                                                     [](Point a, Point b) { return a.y < b.y; });
        element.share = mean_share(section, low->y, high->y);
    }
    mesh.contact.share = base_share(section);
    for (std::size_t i = 0; i < mesh.lifts.size(); ++i)
        mesh.lifts[i].share = share_above(section, lift_joints[i].elevation);
}

} // namespace damslip::fe2d
