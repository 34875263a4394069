#include "fe2d/mesh/mesh_bodies.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

namespace {

/// Surface points of all columns, upstream to downstream; `offset` is the index of the first column of the plane.
struct Surface {
    Polyline points;
    int offset = 0;
};

Surface surface_of(const RockLayout& layout)
{
    const auto on_plane = [&](double distance) {
        return Point{distance * std::cos(layout.inclination), -distance * std::sin(layout.inclination)};
    };
    Surface surface;
    const Point first = on_plane(layout.plane.front()), last = on_plane(layout.plane.back());
    for (auto x = layout.left.rbegin(); x + 1 != layout.left.rend(); ++x) surface.points.push_back({*x, first.y});
    surface.offset = static_cast<int>(surface.points.size());
    for (const double distance : layout.plane) surface.points.push_back(on_plane(distance));
    for (std::size_t i = 1; i < layout.right.size(); ++i) surface.points.push_back({layout.right[i], last.y});
    return surface;
}

} // namespace

void append_rock(Mesh& mesh, const RockLayout& layout)
{
    const Surface surface = surface_of(layout);
    const int columns = static_cast<int>(surface.points.size()); // of nodes
    const int rows = static_cast<int>(layout.depths.size());
    const int first = mesh.node_count();
    const auto node = [&](int column, int row) { return first + row * columns + column; };

    for (int j = 0; j < rows; ++j)
        for (const Point& p : surface.points)
            mesh.nodes.push_back({p.x, p.y + layout.depths[j] * (layout.bottom - p.y)});
    for (int j = 0; j + 1 < rows; ++j)
        for (int i = 0; i + 1 < columns; ++i) {
            const int k = i - surface.offset;
            const bool curtain = j < layout.curtain_rows && k >= layout.curtain_begin && k < layout.curtain_end;
            mesh.elements.push_back({{node(i, j + 1), node(i + 1, j + 1), node(i + 1, j), node(i, j)},
                                     curtain ? Region::curtain : Region::rock});
        }

    const int heel = surface.offset + layout.base_begin, toe = surface.offset + layout.base_end;
    ContactPlane& plane = mesh.contact;
    plane.matching = layout.matching;
    for (int i = heel; i <= toe; ++i) {
        plane.rock_nodes.push_back(node(i, 0));
        plane.rock_node_distance.push_back(layout.plane[i - surface.offset]);
        if (plane.matching) mesh.nodes[node(i, 0)] = mesh.nodes[plane.dam_nodes[i - heel]]; // the same bits
    }
    mesh.nodes[plane.rock_nodes.front()] = mesh.nodes[plane.dam_nodes.front()];
    mesh.nodes[plane.rock_nodes.back()] = mesh.nodes[plane.dam_nodes.back()];
    for (int i = 0; i < static_cast<int>(layout.plane.size()); ++i)
        mesh.contact.rock_line.push_back(node(surface.offset + i, 0));
    mesh.contact.rock_distance = layout.plane;
    for (int i = heel; i >= 0; --i) mesh.floor.push_back(node(i, 0));
    for (int i = columns - 1; i >= toe; --i) mesh.ground.push_back(node(i, 0));
    for (int j = 0; j < rows; ++j) mesh.box_left.push_back(node(0, j));
    for (int j = rows - 1; j >= 0; --j) mesh.box_right.push_back(node(columns - 1, j));
    for (int i = 0; i < columns; ++i) mesh.box_bottom.push_back(node(i, rows - 1));
}

} // namespace damslip::fe2d
