#include "verification/cases/mixed_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace damslip::verification {

namespace {

using namespace fe2d;

/// Numbers in -1 ... 1, the same every time (a linear congruential generator with Knuth's constants).
class Shaker {
public:
    double next()
    {
        state_ = 6364136223846793005u * state_ + 1442695040888963407u;
        return static_cast<double>(state_ >> 11) / 4503599627370496.0 - 1.0;
    }

private:
    std::uint64_t state_ = 2015;
};

void move_inner_nodes(GmshFile& mesh)
{
    std::vector<double> room(mesh.nodes.size(), HUGE_VAL); // shortest edge at the node; zero on lines
    for (const GmshElement& e : mesh.elements)
        for (int i = 0, n = node_count(e.shape); i < n; ++i) {
            const int a = e.nodes[i], b = e.nodes[(i + 1) % n];
            const double length = e.shape == GmshShape::line ? 0.0
                                                             : std::hypot(mesh.nodes[b].at.x - mesh.nodes[a].at.x,
                                                                          mesh.nodes[b].at.y - mesh.nodes[a].at.y);
            room[a] = std::min(room[a], length);
            room[b] = std::min(room[b], length);
        }
    Shaker shaker;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        const double x = shaker.next(), y = shaker.next();
        mesh.nodes[n].at.x += 0.2 * room[n] * x;
        mesh.nodes[n].at.y += 0.2 * room[n] * y;
    }
}

void split_and_turn(GmshFile& mesh)
{
    std::vector<GmshElement> elements;
    int count = 0;
    for (const GmshElement& e : mesh.elements) {
        if (e.shape != GmshShape::quadrilateral || ++count % 3 != 0) {
            elements.push_back(e);
            continue;
        }
        for (const std::array<int, 4>& nodes :
             {std::array{e.nodes[0], e.nodes[1], e.nodes[2], -1}, {e.nodes[0], e.nodes[2], e.nodes[3], -1}}) {
            elements.push_back(e);
            elements.back().shape = GmshShape::triangle;
            elements.back().nodes = nodes;
        }
    }
    for (std::size_t k = 0; k < elements.size(); ++k) {
        GmshElement& e = elements[k];
        if (k % 2 == 0 && e.shape != GmshShape::line)
            std::reverse(e.nodes.begin(), e.nodes.begin() + node_count(e.shape));
        e.tag = static_cast<std::int64_t>(5 * k + 2);
    }
    mesh.elements = std::move(elements);
}

/// Nodes in the order of new tags with gaps: even places first, then the odd ones.
void renumber(GmshFile& mesh)
{
    std::vector<GmshNode> nodes;
    std::vector<int> place(mesh.nodes.size());
    const auto take = [&](std::size_t first) {
        for (std::size_t n = first; n < mesh.nodes.size(); n += 2) {
            place[n] = static_cast<int>(nodes.size());
            nodes.push_back(mesh.nodes[n]);
            nodes.back().tag = static_cast<std::int64_t>(7 * nodes.size());
        }
    };
    take(0);
    take(1);
    nodes.push_back({static_cast<std::int64_t>(7 * nodes.size() + 100), {1e3, 1e3}, 0.0, 0}); // of no element
    for (GmshElement& e : mesh.elements)
        for (int i = 0; i < node_count(e.shape); ++i) e.nodes[i] = place[e.nodes[i]];
    mesh.nodes = std::move(nodes);
}

} // namespace

fe2d::GmshFile mixed_mesh(fe2d::GmshFile regular)
{
    move_inner_nodes(regular);
    split_and_turn(regular);
    renumber(regular);
    return regular;
}

} // namespace damslip::verification
