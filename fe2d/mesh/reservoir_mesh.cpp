#include "fe2d/mesh/reservoir_mesh.hpp"

#include "core/input_error.hpp"
#include "fe2d/mesh/faces.hpp"
#include "fe2d/mesh/grading.hpp"
#include "fe2d/mesh/quality.hpp"
#include "scene/mesh_sizes.hpp"
#include "scene/water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

namespace {

constexpr double columns_per_depth = 12.0; ///< far from the dam: 12 resolve three quarter waves with an error of 0.2 %

/// Points of the wet face from the heel up to the surface.
Polyline wet_face(const Scene& scene, double size)
{
    const double level = scene.reservoir->level;
    const Polyline upstream = split_faces(scene).upstream;
    std::vector<double> stations;
    for (const Point& p : upstream)
        if (p.y < level - 1e-6 * size) stations.push_back(p.y);
    stations.push_back(level);
    Polyline points;
    std::size_t edge = 0;
    for (const double y : even_positions(stations, size)) {
        while (edge + 2 < upstream.size() && y > upstream[edge + 1].y) ++edge;
        const Point a = upstream[edge], b = upstream[edge + 1];
        const double t = std::min(1.0, (y - a.y) / (b.y - a.y)); // above the crest: over its upstream end
        points.push_back({a.x + t * (b.x - a.x), y});
    }
    return points;
}

} // namespace

ReservoirMesh build_reservoir_mesh(const Scene& scene)
{
    assert(has_water(scene));
    const Reservoir& water = *scene.reservoir;
    const double size = water_mesh_size(water);
    const Polyline face = wet_face(scene, size);
    const double length = water.length > 0.0 ? water.length : 2.4 * water.level;
    const double leftmost = std::min_element(face.begin(), face.end(), [](Point a, Point b) { return a.x < b.x; })->x;
    if (!(-length < leftmost - size))
        throw InputError(
            Diagnostic{.file = scene.file.string(),
                       .problem = fmt::format("reservoir.length_m = {:g} ends inside the dam's upstream face.", length),
                       .expected = fmt::format("more than {:g} m", size - leftmost),
                       .fix = "use at least twice the water depth"});
    const double largest = std::max(size, water.level / columns_per_depth);
    const std::vector<double> columns =
        graded_positions({0.0, length}, {.first = size, .growth = scene.mesh.growth, .largest = largest});

    ReservoirMesh result;
    result.depth = face.back().y - face.front().y;
    Mesh& mesh = result.mesh;
    const int n = static_cast<int>(columns.size()), rows = static_cast<int>(face.size());
    const auto node = [n](int column, int row) { return row * n + column; }; // column 0 is the face
    for (const Point& p : face)
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
