#include "fe2d/mesh/build_mesh.hpp"

#include "core/input_error.hpp"
#include "fe2d/mesh/import_mesh.hpp"
#include "fe2d/mesh/mesh_bodies.hpp"
#include "fe2d/mesh/quadratic.hpp"
#include "fe2d/mesh/quality.hpp"
#include "scene/curtain.hpp"
#include "scene/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

namespace {

/// Stations of the base: heel, curtain sides (they must be node columns of the rock), toe.
std::vector<double> base_stations(const Scene& scene)
{
    const double length = base_length(scene.section);
    if (!curtain_is_meshed(scene)) return {0.0, length};
    const Curtain& curtain = *scene.curtain;
    const double end = curtain.distance + curtain.thickness;
    if (!(curtain.distance >= 0.0 && curtain.thickness > 0.0 && end <= length))
        refuse(scene.file,
               fmt::format("curtain.distance_m = {:g} with curtain.thickness_m = {:g} is not below the base.",
                           curtain.distance, curtain.thickness),
               fmt::format("distance + thickness within the base of {:g} m", length),
               "move the curtain between heel and toe");
    std::vector<double> stations{0.0};
    for (const double s : {curtain.distance, end, length})
        if (s - stations.back() > 1e-9 * length)
            stations.push_back(s);
        else
            stations.back() = std::max(stations.back(), s);
    stations.front() = 0.0;
    return stations;
}

/// Layer stations of the dam: all kinks and joints, and the water level where it is not a sliver away from one of them.
std::vector<double> layer_stations(const Scene& scene, const Faces& faces, const Grading& heights)
{
    std::vector<double> stations = faces.kinks();
    if (!scene.reservoir) return stations;
    const double s = faces.parameter_of_level(scene.reservoir->level);
    if (!(s > 0.0 && s < 1.0)) return stations;
    // A water that is meshed itself must have its surface on a row; loads alone do not need one.
    const bool meshed_water =
        scene.reservoir->model == ReservoirModel::acoustic || scene.reservoir->model == ReservoirModel::automatic;
    const double sliver = (meshed_water ? 0.02 : 0.3) * heights.size_at(s * faces.height()) / faces.height();
    const auto next = std::lower_bound(stations.begin(), stations.end(), s);
    if (*next - s > sliver && s - *(next - 1) > sliver) stations.insert(next, s);
    return stations;
}

int index_of(const std::vector<double>& values, double value)
{
    const auto nearest = std::min_element(
        values.begin(), values.end(), [&](double a, double b) { return std::abs(a - value) < std::abs(b - value); });
    return static_cast<int>(nearest - values.begin());
}

DamLayout dam_layout(const Scene& scene, const Faces& faces, const MeshSizes& sizes)
{
    DamLayout layout;
    layout.heights = {.first = std::min(sizes.contact, sizes.dam), .growth = scene.mesh.growth, .largest = sizes.dam};
    layout.base = even_positions(base_stations(scene), sizes.contact);
    const double height = faces.height();
    std::vector<double> levels = layer_stations(scene, faces, layout.heights);
    for (double& s : levels) s *= height;
    layout.rows = graded_positions(levels, layout.heights);
    for (double& s : layout.rows) s /= height;
    layout.rows.back() = 1.0;
    for (const Faces::Layer& joint : faces.layers) layout.joints.push_back(index_of(layout.rows, joint.s));
    return layout;
}

/// The base's columns with the extensions on both sides, in whole elements of the contact size.
void place_plane(RockLayout& layout, const std::vector<double>& base, double size, const ContactExtension& extension)
{
    const auto whole = [&](double length) { return std::max(1, static_cast<int>(std::ceil(length / size - 1e-9))); };
    const int up = whole(extension.upstream), down = whole(extension.downstream);
    for (int i = up; i >= 1; --i) layout.plane.push_back(-i * size);
    layout.base_begin = up;
    layout.plane.insert(layout.plane.end(), base.begin(), base.end());
    layout.base_end = static_cast<int>(layout.plane.size()) - 1;
    for (int i = 1; i <= down; ++i) layout.plane.push_back(base.back() + i * size);
}

void place_sides(const Scene& scene, RockLayout& layout, const Grading& grading)
{
    const double middle = 0.5 * (heel(scene.section).x + toe(scene.section).x);
    const double half = 0.5 * scene.foundation->width;
    const double cosine = std::cos(layout.inclination);
    const double from = cosine * layout.plane.front(), to = cosine * layout.plane.back();
    const double needed = 2.0 * (std::max(middle - from, to - middle) + grading.first);
    if (scene.foundation->width < needed)
        refuse(scene.file, fmt::format("foundation.width_m = {:g} is too small.", scene.foundation->width),
               fmt::format("at least {:g} m: base, sliding path on both sides and one element", needed),
               "use about 5 base lengths or more");
    for (const double d : graded_positions({0.0, from - (middle - half)}, grading)) layout.left.push_back(from - d);
    for (const double d : graded_positions({0.0, middle + half - to}, grading)) layout.right.push_back(to + d);
}

void place_rows(const Scene& scene, RockLayout& layout, const Grading& grading)
{
    const Foundation& rock = *scene.foundation;
    layout.bottom = -rock.depth;
    const double lowest =
        -std::sin(layout.inclination) * (layout.inclination > 0.0 ? layout.plane.back() : layout.plane.front());
    if (rock.depth <= grading.first - lowest)
        refuse(scene.file, fmt::format("foundation.depth_m = {:g} is too small.", rock.depth),
               fmt::format("more than {:g} m below the heel", grading.first - lowest),
               "use about the height of the dam or more");
    std::vector<double> stations{0.0, rock.depth};
    if (layout.curtain_begin >= 0) {
        // The columns run from the inclined surface to the bottom: the curtain's foot is that deep below its upstream
        // side.
        const double depth = scene.curtain->depth;
        const double available = rock.depth - std::sin(layout.inclination) * layout.plane[layout.curtain_begin];
        if (!(depth > 0.0 && depth < available))
            refuse(scene.file, fmt::format("curtain.depth_m = {:g} does not end inside the foundation.", depth),
                   fmt::format("more than 0 and less than {:g} m (foundation.depth_m = {:g})", available, rock.depth),
                   "make the foundation deeper");
        stations.insert(stations.begin() + 1, depth / available * rock.depth);
    }
    layout.depths = graded_positions(stations, grading);
    if (stations.size() == 3) layout.curtain_rows = index_of(layout.depths, stations[1]);
    for (double& d : layout.depths) d /= rock.depth;
    layout.depths.back() = 1.0;
}

RockLayout rock_layout(const Scene& scene, const DamLayout& dam, const MeshSizes& sizes,
                       const ContactExtension& extension)
{
    const double size = scene.mesh.rock_contact_size.value_or(sizes.contact);
    const Grading grading{.first = size, .growth = scene.mesh.growth, .largest = std::max(sizes.rock, size)};
    RockLayout layout;
    layout.matching = !scene.mesh.rock_contact_size.has_value();
    layout.inclination = base_inclination(scene.section);
    const std::vector<double> base = layout.matching ? dam.base : even_positions(base_stations(scene), size);
    place_plane(layout, base, size, extension);
    if (curtain_is_meshed(scene)) {
        layout.curtain_begin = index_of(layout.plane, scene.curtain->distance);
        layout.curtain_end = index_of(layout.plane, scene.curtain->distance + scene.curtain->thickness);
    }
    place_sides(scene, layout, grading);
    place_rows(scene, layout, grading);
    return layout;
}

/// Every quadrilateral as two triangles along its shorter diagonal.
void split_quadrilaterals(Mesh& mesh)
{
    std::vector<Element> triangles;
    std::ptrdiff_t dam_triangles = 0;
    for (int e = 0; e < mesh.element_count(); ++e) {
        if (e == mesh.dam_element_count) dam_triangles = std::ssize(triangles);
        const Element& element = mesh.elements[e];
        if (element.size() == 3) {
            triangles.push_back(element);
            continue;
        }
        const auto p = corners(mesh, element);
        const auto& n = element.nodes;
        const bool first = std::hypot(p[2].x - p[0].x, p[2].y - p[0].y) <= std::hypot(p[3].x - p[1].x, p[3].y - p[1].y);
        triangles.push_back(
            {first ? std::array{n[0], n[1], n[2], -1} : std::array{n[0], n[1], n[3], -1}, element.region});
        triangles.push_back(
            {first ? std::array{n[0], n[2], n[3], -1} : std::array{n[1], n[2], n[3], -1}, element.region});
    }
    mesh.dam_element_count = static_cast<int>(mesh.has_rock() ? dam_triangles : std::ssize(triangles));
    mesh.elements = std::move(triangles);
}

Mesh own_mesh(const Scene& scene, const ContactExtension& extension)
{
    const Faces faces = split_faces(scene);
    const MeshSizes sizes = mesh_sizes(scene);
    const DamLayout layout = dam_layout(scene, faces, sizes);
    Mesh mesh;
    append_dam(mesh, faces, layout);
    if (scene.foundation) append_rock(mesh, rock_layout(scene, layout, sizes, extension));
    check_quality(mesh, scene);
    return mesh;
}

} // namespace

void shape_elements(Mesh& mesh, ElementKind kind)
{
    if (kind == ElementKind::t3 || kind == ElementKind::t6) split_quadrilaterals(mesh);
    if (kind == ElementKind::q8 || kind == ElementKind::t6) make_quadratic(mesh, QuadraticKind::serendipity);
    if (kind == ElementKind::q9) make_quadratic(mesh, QuadraticKind::lagrange);
}

// Mesh lines are laid around a curtain only where its elements differ from the rock's: in stiffness, or in the flow
// whose pore pressures this mesh carries.
bool curtain_is_meshed(const Scene& scene)
{
    if (!scene.foundation || !scene.curtain) return false;
    return curtain_changes_stiffness(scene) ||
           (scene.stages.pore_pressure != PorePressure::none && curtain_changes_flow(scene));
}

Mesh build_mesh(const Scene& scene, const ContactExtension& extension)
{
    Mesh mesh = scene.mesh.file ? import_mesh(scene, extension).mesh : own_mesh(scene, extension);
    shape_elements(mesh, scene.mesh.element);
    return mesh;
}

} // namespace damslip::fe2d
