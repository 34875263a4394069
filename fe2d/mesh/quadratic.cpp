#include "fe2d/mesh/quadratic.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace damslip::fe2d {

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

} // namespace damslip::fe2d
