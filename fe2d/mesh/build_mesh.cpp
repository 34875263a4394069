#include "fe2d/mesh/build_mesh.hpp"

#include "core/input_error.hpp"
#include "fe2d/mesh/faces.hpp"
#include "fe2d/mesh/import_mesh.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "scene/mesh_sizes.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

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
std::vector<double> layer_stations(const Scene& scene, const Faces& faces, const DamSizes& sizes)
{
    std::vector<double> stations = faces.kinks();
    if (!scene.reservoir) return stations;
    const double s = faces.parameter_of_level(scene.reservoir->level);
    if (!(s > 0.0 && s < 1.0)) return stations;
    // A water that is meshed itself must have its surface on a row; loads alone do not need one.
    const bool meshed_water =
        scene.reservoir->model == ReservoirModel::acoustic || scene.reservoir->model == ReservoirModel::automatic;
    const double sliver = (meshed_water ? 0.02 : 0.3) * sizes.size_at(s * faces.height()) / faces.height();
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

/// Around a bonded lift joint elements grow at least by this ratio.
constexpr double least_growth = 1.2;

double parameter_of(const Faces& faces, const LiftJoint& joint)
{
    const auto nearest = std::min_element(faces.layers.begin(), faces.layers.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.level - joint.elevation) < std::abs(b.level - joint.elevation);
    });
    return nearest->s;
}

DamLayout dam_layout(const Scene& scene, const Faces& faces, const MeshSizes& sizes)
{
    DamLayout layout;
    layout.base = even_positions(base_stations(scene), sizes.contact);
    const double height = faces.height();
    layout.sizes.base = {
        .first = std::min(sizes.contact, sizes.dam), .growth = scene.mesh.growth, .largest = sizes.dam};
    for (const LiftJoint& joint : scene.lift_joints)
        if (const double size = lift_mesh_size(scene, joint); size < sizes.dam)
            layout.sizes.lifts.push_back(
                {parameter_of(faces, joint) * height,
                 {.first = size, .growth = std::max(scene.mesh.growth, least_growth), .largest = sizes.dam}});
    std::vector<double> levels = layer_stations(scene, faces, layout.sizes);
    for (double& s : levels) s *= height;
    layout.rows = layout.sizes.positions(levels);
    for (double& s : layout.rows) s /= height;
    layout.rows.back() = 1.0;
    for (const Faces::Layer& layer : faces.layers)
        if (!layer.step) (layer.tied ? layout.tied : layout.joints).push_back(index_of(layout.rows, layer.s));
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
    if (scene.seam_body)
        append_rock_with_seam(mesh, scene, sizes);
    else if (scene.foundation)
        append_rock(mesh, rock_layout(scene, layout, sizes, extension));
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
    if (!scene.foundation || !scene.curtain || scene.seam_body) return false;
    return curtain_changes_stiffness(scene) ||
           (scene.stages.pore_pressure != PorePressure::none && curtain_changes_flow(scene));
}

Mesh build_mesh(const Scene& scene, const ContactExtension& extension)
{
    Mesh mesh = scene.mesh.file ? import_mesh(scene, extension).mesh : own_mesh(scene, extension);
    shape_elements(mesh, scene.mesh.element);
    return mesh;
}

namespace {

/// Columns are joined two by two where they would be narrower than this share of the wanted element size.
constexpr double narrowest_column = 0.6;

/// Uneven columns (curtain sides on the base, columns left over from joining) even out by this share from row to row.
constexpr double evening = 0.2;

/// One row of nodes from the upstream to the downstream face.
struct Row {
    double s = 0.0;
    std::vector<double> fractions; ///< 0 at the upstream face, 1 at the downstream face
    std::vector<int> nodes;

    int columns() const { return static_cast<int>(nodes.size()) - 1; }
};

std::vector<double> evened(const std::vector<double>& fractions)
{
    std::vector<double> result = fractions;
    const double columns = static_cast<double>(fractions.size() - 1);
    for (std::size_t i = 1; i + 1 < fractions.size(); ++i)
        result[i] += evening * (static_cast<double>(i) / columns - fractions[i]);
    return result;
}

class DamBuilder {
public:
    DamBuilder(Mesh& mesh, const Faces& faces) : mesh_(mesh), faces_(faces) {}

    Row first_row(const DamLayout& layout)
    {
        Row row;
        for (const double distance : layout.base) row.fractions.push_back(distance / layout.base.back());
        place(row, 0.0);
        return row;
    }

    Row plain(const Row& below, double s)
    {
        Row row;
        row.fractions = evened(below.fractions);
        place(row, s);
        for (int i = 0; i < below.columns(); ++i)
            quad(below.nodes[i], below.nodes[i + 1], row.nodes[i + 1], row.nodes[i]);
        return row;
    }

    /// Four columns become two; what is left over from a multiple of four goes on unchanged at the downstream face.
    Row joined(const Row& below, double s)
    {
        const int groups = below.columns() / 4;
        Row row;
        for (int i = 0; i <= below.columns(); i += (i < 4 * groups ? 2 : 1))
            row.fractions.push_back(below.fractions[i]);
        row.fractions = evened(row.fractions);
        place(row, s);
        for (int g = 0; g < groups; ++g) join_four(below, row, g);
        for (int i = 4 * groups; i < below.columns(); ++i)
            quad(below.nodes[i], below.nodes[i + 1], row.nodes[i - 2 * groups + 1], row.nodes[i - 2 * groups]);
        return row;
    }

    /// Two columns become four, below a layer that needs fine elements; a column left over is halved by triangles.
    Row split(const Row& below, double s)
    {
        Row row;
        for (int i = 0; i < below.columns(); ++i) {
            row.fractions.push_back(below.fractions[i]);
            row.fractions.push_back(0.5 * (below.fractions[i] + below.fractions[i + 1]));
        }
        row.fractions.push_back(below.fractions.back());
        place(row, s);
        for (int g = 0; g < below.columns() / 2; ++g) split_two(below, row, g);
        if (below.columns() % 2 == 1) {
            const int* b = &below.nodes[below.columns() - 1];
            const int* t = &row.nodes[row.columns() - 2];
            mesh_.elements.push_back({{b[0], t[1], t[0], -1}, Region::dam});
            mesh_.elements.push_back({{b[0], b[1], t[1], -1}, Region::dam});
            mesh_.elements.push_back({{b[1], t[2], t[1], -1}, Region::dam});
        }
        return row;
    }

    /// The same row again, for the block above a joint.
    Row again(const Row& below)
    {
        Row row{.s = below.s, .fractions = below.fractions, .nodes = {}};
        for (const int n : below.nodes) {
            row.nodes.push_back(mesh_.node_count());
            mesh_.nodes.push_back(Point(mesh_.nodes[n]));
        }
        return row;
    }

    Row point(const Row& below)
    {
        Row row{.s = 1.0, .fractions = {0.0}, .nodes = {node(1.0, 0.0)}};
        for (int i = 0; i < below.columns(); ++i)
            mesh_.elements.push_back({{below.nodes[i], below.nodes[i + 1], row.nodes[0], -1}, Region::dam});
        return row;
    }

private:
    int node(double s, double fraction)
    {
        mesh_.nodes.push_back(faces_.at(s, fraction));
        return mesh_.node_count() - 1;
    }

    void place(Row& row, double s)
    {
        row.s = s;
        for (const double f : row.fractions) row.nodes.push_back(node(s, f));
    }

    void quad(int a, int b, int c, int d) { mesh_.elements.push_back({{a, b, c, d}, Region::dam}); }

    //   t0-------t1-------t2      m1, m2, m3 at half height above b1, b2, b3
    //   | \      |      / |
    //   |  m1----m2---m3  |
    //   |  |     |     |  |
    //   b0 b1    b2    b3 b4
    void join_four(const Row& below, Row& above, int group)
    {
        const int* b = &below.nodes[4 * group];
        const int* t = &above.nodes[2 * group];
        const double s = 0.5 * (below.s + above.s);
        const double* f = &below.fractions[4 * group];
        const int m1 = node(s, f[1]), m2 = node(s, f[2]), m3 = node(s, f[3]);
        quad(b[0], b[1], m1, t[0]);
        quad(b[1], b[2], m2, m1);
        quad(b[2], b[3], m3, m2);
        quad(b[3], b[4], t[2], m3);
        quad(m1, m2, t[1], t[0]);
        quad(m2, m3, t[2], t[1]);
    }

    // The same upside down: m1, m2, m3 at half height below t1, t2, t3.
    void split_two(const Row& below, const Row& above, int group)
    {
        const int* b = &below.nodes[2 * group];
        const int* t = &above.nodes[4 * group];
        const double s = 0.5 * (below.s + above.s);
        const double* f = &above.fractions[4 * group];
        const int m1 = node(s, f[1]), m2 = node(s, f[2]), m3 = node(s, f[3]);
        quad(b[0], m1, t[1], t[0]);
        quad(m1, m2, t[2], t[1]);
        quad(m2, m3, t[3], t[2]);
        quad(m3, b[2], t[4], t[3]);
        quad(b[0], b[1], m2, m1);
        quad(b[1], b[2], m3, m2);
    }

    Mesh& mesh_;
    const Faces& faces_;
};

bool wants_joining(const Row& row, double s_next, const Faces& faces, const DamLayout& layout)
{
    // Beside columns that split, half: what has been split is not joined again.
    const double narrowest = layout.sizes.lifts.empty() ? narrowest_column : 0.5;
    const double wanted = layout.sizes.size_at(s_next * faces.height());
    return row.columns() >= 4 && faces.width_at(s_next) / row.columns() < narrowest * wanted;
}

bool wants_splitting(const Row& row, double s_next, const Faces& faces, const DamLayout& layout)
{
    if (layout.sizes.lifts.empty() || row.columns() < 2) return false;
    const double wanted = layout.sizes.size_at(s_next * faces.height());
    return faces.width_at(s_next) / row.columns() > wanted * (1.0 + 1e-9);
}

LiftPlane lift_plane(const Mesh& mesh, const Row& lower, const Row& upper)
{
    LiftPlane plane{.lower_nodes = lower.nodes, .upper_nodes = upper.nodes, .distance = {}};
    for (const int n : lower.nodes) plane.distance.push_back(mesh.nodes[n].x - mesh.nodes[lower.nodes.front()].x);
    return plane;
}

/// Along the path of a crack.
void bend(const Mesh& mesh, LiftPlane& plane)
{
    plane.bent = true;
    for (std::size_t i = 1; i < plane.distance.size(); ++i) {
        const Point a = mesh.nodes[plane.lower_nodes[i - 1]], b = mesh.nodes[plane.lower_nodes[i]];
        plane.distance[i] = plane.distance[i - 1] + std::hypot(b.x - a.x, b.y - a.y);
    }
}

const Faces::Layer& joint_of(const Faces& faces, double s)
{
    return *std::min_element(faces.layers.begin(), faces.layers.end(), [s](const Faces::Layer& a, const Faces::Layer& b) {
        return std::abs(a.s - s) < std::abs(b.s - s);
    });
}

} // namespace

void append_dam(Mesh& mesh, const Faces& faces, const DamLayout& layout)
{
    DamBuilder build(mesh, faces);
    Row row = build.first_row(layout);
    mesh.contact.dam_nodes = row.nodes;
    mesh.contact.distance = layout.base;
    const auto add_to_faces = [&mesh](const Row& added) {
        mesh.upstream_face.push_back(added.nodes.front());
        mesh.downstream_face.push_back(added.nodes.back());
    };
    add_to_faces(row);
    for (std::size_t j = 1; j < layout.rows.size(); ++j) {
        const double s = layout.rows[j];
        const bool last = j + 1 == layout.rows.size();
        if (last && faces.ends_in_point())
            row = build.point(row);
        else if (wants_joining(row, s, faces, layout))
            row = build.joined(row, s);
        else if (wants_splitting(row, s, faces, layout))
            row = build.split(row, s);
        else
            row = build.plain(row, s);
        add_to_faces(row);
        const auto is_one_of = [j](const std::vector<int>& rows) {
            return std::binary_search(rows.begin(), rows.end(), static_cast<int>(j));
        };
        if (is_one_of(layout.tied)) mesh.tied_lifts.push_back(lift_plane(mesh, row, row));
        if (!is_one_of(layout.joints)) continue;
        const Row upper = build.again(row);
        mesh.lifts.push_back(lift_plane(mesh, row, upper));
        if (!joint_of(faces, s).path.empty()) bend(mesh, mesh.lifts.back());
        row = upper;
        add_to_faces(row);
    }
    std::reverse(mesh.upstream_face.begin(), mesh.upstream_face.end());
    mesh.crest.assign(row.nodes.rbegin(), row.nodes.rend());
    mesh.dam_node_count = mesh.node_count();
    mesh.dam_element_count = mesh.element_count();
}

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

namespace {

/// Distance at which the largest size is reached.
double growing_length(const Grading& g)
{
    return g.growth > 1.0 ? (g.largest - g.first) / std::log(g.growth) : 0.0;
}

int nearest_count(double elements)
{
    return std::max(1, static_cast<int>(std::lround(elements)));
}

} // namespace

double Grading::size_at(double distance) const
{
    return std::min(largest, first + distance * std::log(growth));
}

double Grading::elements_to(double distance) const
{
    if (growth <= 1.0) return distance / first;
    const double rate = std::log(growth);
    const double graded = std::min(distance, growing_length(*this));
    return std::log1p(rate * graded / first) / rate + (distance - graded) / largest;
}

double Grading::distance_after(double element_number) const
{
    if (growth <= 1.0) return element_number * first;
    const double rate = std::log(growth);
    const double length = growing_length(*this);
    const double graded = elements_to(length);
    return element_number <= graded ? first * std::expm1(rate * element_number) / rate
                                    : length + (element_number - graded) * largest;
}

std::vector<double> graded_positions(const std::vector<double>& stations, const Grading& grading)
{
    assert(stations.size() >= 2 && grading.first > 0.0 && grading.growth >= 1.0 && grading.largest >= grading.first);
    const double origin = stations.front();
    std::vector<double> positions{origin};
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
        const double start = grading.elements_to(stations[i] - origin);
        const double end = grading.elements_to(stations[i + 1] - origin);
        const int count = nearest_count(end - start);
        for (int k = 1; k < count; ++k)
            positions.push_back(origin + grading.distance_after(start + (end - start) * k / count));
        positions.push_back(stations[i + 1]);
    }
    return positions;
}

double DamSizes::size_at(double height) const
{
    double size = base.size_at(height);
    for (const FineLayer& lift : lifts) size = std::min(size, lift.grading.size_at(std::abs(height - lift.height)));
    return size;
}

std::vector<double> DamSizes::positions(const std::vector<double>& stations) const
{
    if (lifts.empty()) return graded_positions(stations, base);
    // Elements up to a height, as the integral of dy/h(y) over parts that are short beside the smallest size.
    double smallest = base.first;
    for (const FineLayer& lift : lifts) smallest = std::min(smallest, lift.grading.first);
    std::vector<double> result{stations.front()};
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
        const double from = stations[i], length = stations[i + 1] - from;
        const int parts = static_cast<int>(std::ceil(8.0 * length / smallest));
        const double part = length / parts;
        std::vector<double> elements{0.0};
        for (int k = 0; k < parts; ++k) elements.push_back(elements.back() + part / size_at(from + (k + 0.5) * part));
        const int count = nearest_count(elements.back());
        std::size_t k = 0;
        for (int n = 1; n < count; ++n) {
            const double wanted = elements.back() * n / count;
            while (elements[k + 1] < wanted) ++k;
            const double share = (wanted - elements[k]) / (elements[k + 1] - elements[k]);
            result.push_back(from + (static_cast<double>(k) + share) * part);
        }
        result.push_back(stations[i + 1]);
    }
    return result;
}

std::vector<double> even_positions(const std::vector<double>& stations, double size)
{
    return graded_positions(stations, {.first = size, .growth = 1.0, .largest = size});
}

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
