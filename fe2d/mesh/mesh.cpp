#include "fe2d/mesh/mesh.hpp"

#include <algorithm>
#include <tuple>

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

} // namespace damslip::fe2d
