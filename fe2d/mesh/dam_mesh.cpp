#include "fe2d/mesh/mesh_bodies.hpp"

#include <algorithm>

namespace damslip::fe2d {

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
        const Point u = faces_.upstream_at(s), d = faces_.downstream_at(s);
        mesh_.nodes.push_back({u.x + fraction * (d.x - u.x), u.y + fraction * (d.y - u.y)});
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

    Mesh& mesh_;
    const Faces& faces_;
};

bool wants_joining(const Row& row, double s_next, const Faces& faces, const DamLayout& layout)
{
    const double wanted = layout.heights.size_at(s_next * faces.height());
    return row.columns() >= 4 && faces.width_at(s_next) / row.columns() < narrowest_column * wanted;
}

LiftPlane lift_plane(const Mesh& mesh, const Row& lower, const Row& upper)
{
    LiftPlane plane{.lower_nodes = lower.nodes, .upper_nodes = upper.nodes, .distance = {}};
    for (const int n : lower.nodes) plane.distance.push_back(mesh.nodes[n].x - mesh.nodes[lower.nodes.front()].x);
    return plane;
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
        else
            row = build.plain(row, s);
        add_to_faces(row);
        if (!std::binary_search(layout.joints.begin(), layout.joints.end(), static_cast<int>(j))) continue;
        const Row upper = build.again(row);
        mesh.lifts.push_back(lift_plane(mesh, row, upper));
        row = upper;
        add_to_faces(row);
    }
    std::reverse(mesh.upstream_face.begin(), mesh.upstream_face.end());
    mesh.crest.assign(row.nodes.rbegin(), row.nodes.rend());
    mesh.dam_node_count = mesh.node_count();
    mesh.dam_element_count = mesh.element_count();
}

} // namespace damslip::fe2d
