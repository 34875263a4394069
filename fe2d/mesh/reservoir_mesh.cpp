#include "fe2d/mesh/reservoir_mesh.hpp"

#include "core/input_error.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/mesh/grading.hpp"
#include "fe2d/mesh/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

namespace {

/// Elements over the depth far from the dam: 12 resolve three quarter waves with an error of 0.2 %.
constexpr double elements_over_depth = 12.0;

/// Points of the wet face from the heel up to the surface, and how many of them are dam nodes.
struct WetFace {
    Polyline points;
    std::vector<int> dam_nodes;
};

WetFace wet_face(const Scene& scene, const Mesh& structure, double size)
{
    const double level = scene.reservoir->level;
    WetFace face;
    for (auto node = structure.upstream_face.rbegin(); node != structure.upstream_face.rend(); ++node) {
        const Point p = structure.nodes[*node];
        if (p.y > level + 0.02 * size) break;
        face.points.push_back(p);
        face.dam_nodes.push_back(*node);
    }
    const Point top = face.points.back();
    if (face.points.size() == structure.upstream_face.size() && level > top.y + 0.02 * size)
        for (const double y : even_positions({top.y, level}, size))
            if (y > top.y) face.points.push_back({top.x, y});
    return face;
}

} // namespace

ReservoirMesh build_reservoir_mesh(const Scene& scene, const Mesh& structure)
{
    assert(scene.reservoir && scene.reservoir->level > 0.0);
    const Reservoir& water = *scene.reservoir;
    const MeshSizes sizes = mesh_sizes(scene);
    const WetFace face = wet_face(scene, structure, sizes.dam);
    const double length = water.length > 0.0 ? water.length : 2.4 * water.level;
    const double leftmost =
        std::min_element(face.points.begin(), face.points.end(), [](Point a, Point b) { return a.x < b.x; })->x;
    if (!(-length < leftmost - sizes.dam))
        throw InputError(
            Diagnostic{.file = scene.file.string(),
                       .problem = fmt::format("reservoir.length_m = {:g} ends inside the dam's upstream face.", length),
                       .expected = fmt::format("more than {:g} m", sizes.dam - leftmost),
                       .fix = "use at least twice the water depth"});
    const double largest = std::max(sizes.dam, water.level / elements_over_depth);
    const std::vector<double> columns =
        graded_positions({0.0, length}, {.first = sizes.dam, .growth = scene.mesh.growth, .largest = largest});

    ReservoirMesh result;
    result.dam_face = face.dam_nodes;
    result.depth = face.points.back().y - face.points.front().y;
    Mesh& mesh = result.mesh;
    const int n = static_cast<int>(columns.size()), rows = static_cast<int>(face.points.size());
    const auto node = [n](int column, int row) { return row * n + column; }; // column 0 is the face
    for (const Point& p : face.points)
        for (const double d : columns) mesh.nodes.push_back({p.x + d / length * (-length - p.x), p.y});
    for (int j = 0; j + 1 < rows; ++j)
        for (int i = 0; i + 1 < n; ++i)
            mesh.elements.push_back(
                {{node(i + 1, j), node(i, j), node(i, j + 1), node(i + 1, j + 1)}, Region::reservoir});
    for (int j = 0; j < rows; ++j) {
        result.face.push_back(node(0, j));
        result.far_end.push_back(node(n - 1, rows - 1 - j));
    }
    for (int i = 0; i < n; ++i) {
        result.surface.push_back(node(i, rows - 1));
        result.bottom.push_back(node(n - 1 - i, 0));
    }
    check_quality(mesh, scene);
    return result;
}

} // namespace damslip::fe2d
