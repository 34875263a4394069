#include "core/input_error.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "scene/planes.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace damslip::fe2d {

namespace {

constexpr double same_station = 1e-9; ///< of stations, over the box's width [-]
constexpr double most_rows = 24.0;    ///< over the largest depth of the path
constexpr double least_rows = 3.0;    ///< over an interface

/// One column of nodes between the ground and the path.
struct Column {
    double x = 0.0, top = 0.0, bottom = 0.0;
    int rows = 0; ///< of elements; 0 where path and ground meet
    int dam = -1; ///< the dam's node above; -1: none
};

/// Level of a path at x [m].
double level_at(const Polyline& path, double x)
{
    return ground_level(path, x);
}

/// Positions of the columns over the path, those of the dam's base among them.
class PathColumns {
public:
    PathColumns(const Mesh& mesh, const Scene& scene, double size)
        : mesh_(mesh), growth_(scene.mesh.growth), path_(scene.seam_body->path), ground_(ground_line(scene))
    {
        double depth = 0.0, least = HUGE_VAL;
        for (std::size_t i = 0; i < path_.size(); ++i) {
            const double below = ground_level(ground_, path_[i].x) - path_[i].y;
            depth = std::max(depth, below);
            if (i > 0 && i + 1 < path_.size()) least = std::min(least, below);
        }
        row_ = std::min(std::max(size, depth / most_rows), least / least_rows);
        size_ = size;
        const Point heel = mesh.nodes[static_cast<std::size_t>(mesh.contact.dam_nodes.front())],
                    toe = mesh.nodes[static_cast<std::size_t>(mesh.contact.dam_nodes.back())];
        if (path_.front().x < heel.x) place(heel.x, path_.front().x);
        std::reverse(columns_.begin(), columns_.end());
        for (const int node : mesh.contact.dam_nodes) add(mesh.nodes[static_cast<std::size_t>(node)].x, node);
        if (path_.back().x > toe.x) place(toe.x, path_.back().x);
    }

    const std::vector<Column>& all() const { return columns_; }
    std::size_t at(double x) const
    {
        const auto nearest = std::min_element(columns_.begin(), columns_.end(), [x](const Column& a, const Column& b) {
            return std::abs(a.x - x) < std::abs(b.x - x);
        });
        return static_cast<std::size_t>(nearest - columns_.begin());
    }

private:
    void add(double x, int dam = -1)
    {
        const double top = dam < 0 ? ground_level(ground_, x) : mesh_.nodes[static_cast<std::size_t>(dam)].y,
                     bottom = level_at(path_, x), height = top - bottom;
        const int rows = height < 1e-6 * row_ ? 0 : std::max(1, static_cast<int>(std::lround(height / row_)));
        columns_.push_back({x, top, rows == 0 ? top : bottom, rows, dam});
    }

    /// From one end of the base outwards, without it: no column is wider than the path rises or falls by a row.
    void place(double from, double to)
    {
        const double sign = to > from ? 1.0 : -1.0, reach = std::abs(to - from);
        std::vector<double> stations{0.0};
        for (const Polyline* line : {&path_, &ground_})
            for (const Point& p : *line)
                if (const double d = sign * (p.x - from); d > same_station * reach && d < reach * (1.0 - same_station))
                    stations.push_back(d);
        stations.push_back(reach);
        std::sort(stations.begin(), stations.end());
        stations.erase(std::unique(stations.begin(), stations.end(),
                                   [&](double a, double b) { return b - a < same_station * reach; }),
                       stations.end());
        for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
            const double a = from + sign * stations[i], b = from + sign * stations[i + 1];
            const auto thickness = [&](double x) { return ground_level(ground_, x) - level_at(path_, x); };
            const double change = std::abs(thickness(b) - thickness(a)) / std::abs(b - a);
            const double widest = change > 0.0 ? row_ / change : HUGE_VAL;
            const double first = std::min(size_, widest);
            Grading grading{
                .first = first, .growth = growth_, .largest = std::max(first, std::min(widest, 4.0 * size_))};
            std::vector<double> places = graded_positions({0.0, std::abs(b - a)}, grading);
            if (places.size() < 3) places = even_positions({0.0, std::abs(b - a)}, 0.5 * std::abs(b - a));
            for (std::size_t k = 1; k + 1 < places.size(); ++k) add(a + sign * places[k]);
            add(b);
        }
    }

    const Mesh& mesh_;
    double growth_, size_ = 0.0, row_ = 0.0;
    const Polyline& path_;
    const Polyline ground_;
    std::vector<Column> columns_;
};

/// The rock between ground and path, cut at each bend, as part of the dam.
class Block {
public:
    Block(Mesh& mesh, const std::vector<Column>& columns) : mesh_(mesh), columns_(columns) {}

    /// @param from, to  columns of one segment of the path @returns nodes of each from the ground down
    std::vector<std::vector<int>> append(std::size_t from, std::size_t to)
    {
        std::vector<std::vector<int>> nodes;
        for (std::size_t c = from; c <= to; ++c) {
            nodes.push_back(column(columns_[c]));
            if (c > from) join(nodes[nodes.size() - 2], nodes.back());
        }
        return nodes;
    }

private:
    std::vector<int> column(const Column& c)
    {
        std::vector<int> nodes;
        for (int j = 0; j <= c.rows; ++j) {
            nodes.push_back(mesh_.node_count());
            mesh_.nodes.push_back({c.x, c.rows == 0 ? c.top : c.top + (c.bottom - c.top) * j / c.rows});
        }
        return nodes;
    }

    //   a0----b0
    //   |      |      rows that end on the way do so in triangles on the path
    //   a1----b1
    //   |   /
    //   a2
    void join(const std::vector<int>& a, const std::vector<int>& b)
    {
        const std::size_t left = a.size() - 1, right = b.size() - 1, both = std::min(left, right);
        const auto add = [this](std::array<int, 4> nodes) { mesh_.elements.push_back({nodes, Region::block}); };
        for (std::size_t j = 0; j < both; ++j) add({a[j + 1], b[j + 1], b[j], a[j]});
        for (std::size_t j = both; j < left; ++j) add({a[j + 1], b[both], a[j], -1});
        for (std::size_t j = both; j < right; ++j) add({a[both], b[j + 1], b[j], -1});
    }

    Mesh& mesh_;
    const std::vector<Column>& columns_;
};

/// Pairs of one segment of the path, and its part of the two lines.
void add_segment(Mesh& mesh, const std::vector<std::vector<int>>& columns, const std::vector<int>& rock,
                 std::size_t first, bool bend_before, bool bend_beyond)
{
    SeamLine& seam = *mesh.seam;
    ContactPlane& plane = mesh.contact;
    const auto place = [&](std::size_t i) { return mesh.nodes[static_cast<std::size_t>(columns[i].back())]; };
    const std::size_t last = columns.size() - 1;
    const Point a = place(0), b = place(last);
    const double start = seam.body_distance.empty() ? 0.0 : seam.body_distance.back(),
                 length = std::hypot(b.x - a.x, b.y - a.y);
    SeamLine::Segment segment{.first = static_cast<int>(plane.dam_nodes.size()),
                              .tangent = {(b.x - a.x) / length, (b.y - a.y) / length}};
    const auto along = [&](std::size_t i) { return start + (place(i).x - a.x) * length / (b.x - a.x); };
    for (std::size_t i = 0; i <= last; ++i) {
        const int node = columns[i].back();
        seam.body.push_back(node);
        seam.body_distance.push_back(along(i));
        if (i > 0 || !bend_before) {
            seam.rock.push_back(rock[first + i]);
            seam.rock_distance.push_back(along(i));
        }
        if ((i == 0 && bend_before) || (i == last && bend_beyond)) continue;
        plane.dam_nodes.push_back(node);
        plane.rock_nodes.push_back(rock[first + i]);
        plane.distance.push_back(along(i));
    }
    if (bend_before) segment.before = along(1) - along(0);
    if (bend_beyond) segment.beyond = along(last) - along(last - 1);
    segment.end = static_cast<int>(plane.dam_nodes.size());
    seam.segments.push_back(segment);
}

/// The rock below: columns from the path, and from the ground beside it, to the bottom of the box.
class Below {
public:
    Below(Mesh& mesh, const Scene& scene, const MeshSizes& sizes, const std::vector<Column>& columns)
        : mesh_(mesh), scene_(scene), ground_(ground_line(scene)), path_(scene.seam_body->path)
    {
        const double size = sizes.contact, middle = 0.5 * (heel(scene.section).x + toe(scene.section).x),
                     half = 0.5 * scene.foundation->width;
        const Grading grading{.first = size, .growth = scene.mesh.growth, .largest = std::max(sizes.rock, size)};
        check_box(middle, half, size);
        const auto beside = [&](double from, double to, double sign) {
            std::vector<double> stations{0.0};
            for (const Point& p : ground_)
                if (sign * (p.x - from) > size && sign * (to - p.x) > size) stations.push_back(sign * (p.x - from));
            stations.push_back(sign * (to - from));
            std::sort(stations.begin(), stations.end());
            return graded_positions(stations, grading);
        };
        const std::vector<double> left = beside(path_.front().x, middle - half, -1.0),
                                  right = beside(path_.back().x, middle + half, 1.0);
        for (auto d = left.rbegin(); d + 1 != left.rend(); ++d) x_.push_back(path_.front().x - *d);
        first_ = static_cast<int>(x_.size());
        for (const Column& c : columns) x_.push_back(c.x);
        last_ = static_cast<int>(x_.size()) - 1;
        for (std::size_t i = 1; i < right.size(); ++i) x_.push_back(path_.back().x + right[i]);
        depths_ = graded_positions({0.0, scene.foundation->depth}, grading);
        for (double& d : depths_) d /= scene.foundation->depth;
        depths_.back() = 1.0;
        append(columns);
        append_beside_crack(columns.front());
    }

    std::vector<int> path() const
    {
        std::vector<int> nodes;
        for (int i = first_; i <= last_; ++i) nodes.push_back(node(i, 0));
        return nodes;
    }
    const std::vector<int>& crack() const { return crack_; } ///< from the ground down; empty: none

    /// Ground upstream of the path, and downstream of it, in the order of the chains; the sides of the box.
    void set_edges(Mesh& mesh) const
    {
        if (crack_.empty())
            for (int i = first_; i >= 0; --i) mesh.floor.push_back(node(i, 0));
        else
            mesh.floor.insert(mesh.floor.end(), top_.rbegin(), top_.rend());
        for (int i = columns() - 1; i >= last_; --i) mesh.ground.push_back(node(i, 0));
        mesh.box_left = side_;
        for (int j = 0; j < rows(); ++j) mesh.box_left.push_back(node(0, j));
        for (int j = rows() - 1; j >= 0; --j) mesh.box_right.push_back(node(columns() - 1, j));
        for (int i = 0; i < columns(); ++i) mesh.box_bottom.push_back(node(i, rows() - 1));
    }

private:
    int columns() const { return static_cast<int>(x_.size()); }
    int rows() const { return static_cast<int>(depths_.size()); }
    int node(int column, int row) const { return begin_ + row * columns() + column; }

    void check_box(double middle, double half, double size) const
    {
        double lowest = 0.0;
        for (const Point& p : path_) lowest = std::min(lowest, p.y);
        const Foundation& rock = *scene_.foundation;
        if (!(rock.depth + lowest > 4.0 * size))
            refuse(scene_.file, fmt::format("foundation.depth_m = {:g} does not hold the seam.", rock.depth),
                   fmt::format("more than {:.4g} m below the heel", 4.0 * size - lowest),
                   "use about the height of the dam below the seam");
        if (const double needed = 2.0 * std::max(path_.back().x + size - middle, middle - path_.front().x + size);
            2.0 * half < needed)
            refuse(scene_.file, fmt::format("foundation.width_m = {:g} does not hold the seam.", rock.width),
                   fmt::format("at least {:.4g} m", needed), "use about 5 base lengths more than the seam is long");
    }

    void append(const std::vector<Column>& path)
    {
        const bool comes_up = path.back().rows == 0, starts_up = path.front().rows == 0;
        const double bottom = -scene_.foundation->depth;
        const auto top = [&](int i) {
            if (i >= first_ && i <= last_) return path[static_cast<std::size_t>(i - first_)].bottom;
            const double x = x_[static_cast<std::size_t>(i)];
            if (i < first_) return starts_up ? ground_level(ground_, x) : path.front().bottom;
            return comes_up ? ground_level(ground_, x) : path.back().bottom;
        };
        begin_ = mesh_.node_count();
        for (const double d : depths_)
            for (int i = 0; i < columns(); ++i)
                mesh_.nodes.push_back({x_[static_cast<std::size_t>(i)], top(i) + d * (bottom - top(i))});
        for (int j = 0; j + 1 < rows(); ++j)
            for (int i = 0; i + 1 < columns(); ++i)
                mesh_.elements.push_back(
                    {{node(i, j + 1), node(i + 1, j + 1), node(i + 1, j), node(i, j)}, Region::rock});
    }

    /// Upstream of the crack the rock reaches from its foot up to the ground.
    void append_beside_crack(const Column& foot)
    {
        if (foot.rows == 0) return;
        std::vector<int> before;
        for (int i = 0; i <= first_; ++i) {
            const double x = x_[static_cast<std::size_t>(i)], top = i == first_ ? foot.top : ground_level(ground_, x);
            std::vector<int> nodes;
            for (int j = 0; j < foot.rows; ++j) {
                nodes.push_back(mesh_.node_count());
                mesh_.nodes.push_back({x, top + (foot.bottom - top) * j / foot.rows});
            }
            nodes.push_back(node(i, 0));
            for (std::size_t j = 0; i > 0 && j + 1 < nodes.size(); ++j)
                mesh_.elements.push_back({{before[j + 1], nodes[j + 1], nodes[j], before[j]}, Region::rock});
            top_.push_back(nodes.front());
            if (i == 0) side_.assign(nodes.begin(), nodes.end() - 1);
            before = std::move(nodes);
        }
        crack_ = before;
    }

    Mesh& mesh_;
    const Scene& scene_;
    Polyline ground_;
    const Polyline& path_;
    std::vector<double> x_, depths_;
    int first_ = 0, last_ = 0, begin_ = 0;
    std::vector<int> crack_, top_, side_;
};

NodeChain reversed(const NodeChain& chain)
{
    return {chain.rbegin(), chain.rend()};
}

/// The dam's base, a joint on the rock that moves with it.
void add_base(Mesh& mesh, const std::vector<Column>& columns, const std::vector<std::vector<int>>& body,
              const std::vector<double>& distance)
{
    LiftPlane plane{.lower_nodes = {}, .upper_nodes = mesh.seam->base, .distance = distance};
    for (std::size_t i = 0; i < body.size(); ++i)
        if (columns[i].dam >= 0) {
            plane.lower_nodes.push_back(body[i].front());
            mesh.nodes[static_cast<std::size_t>(body[i].front())] =
                mesh.nodes[static_cast<std::size_t>(columns[i].dam)];
        }
    mesh.lifts.insert(mesh.lifts.begin(), std::move(plane));
}

/// Nodes on both sides of a bend, from the ground down. Below the toe the dam is a third body at the upper end, too.
void add_interface(Mesh& mesh, const std::vector<int>& upstream, const std::vector<int>& downstream)
{
    LiftPlane plane{.lower_nodes = {}, .upper_nodes = {}, .distance = {}, .upright = true};
    const auto y = [&](std::size_t j) { return mesh.nodes[static_cast<std::size_t>(upstream[j])].y; };
    const bool at_toe = upstream.front() == mesh.lifts.front().lower_nodes.back();
    if (at_toe) mesh.seam->bends.push_back({upstream.front(), downstream.front(), downstream.front()});
    for (std::size_t j = at_toe ? 1 : 0; j + 1 < upstream.size(); ++j) {
        plane.lower_nodes.push_back(upstream[j]);
        plane.upper_nodes.push_back(downstream[j]);
        plane.distance.push_back(y(0) - y(j));
    }
    plane.beyond = y(upstream.size() - 2) - y(upstream.size() - 1);
    mesh.lifts.push_back(std::move(plane));
    mesh.seam->interfaces.push_back({reversed(upstream), downstream});
}

} // namespace

void append_rock_with_seam(Mesh& mesh, const Scene& scene, const MeshSizes& sizes)
{
    assert(scene.seam_body && scene.foundation && mesh.element_count() == mesh.dam_element_count);
    const Polyline& path = scene.seam_body->path;
    const PathColumns places(mesh, scene, sizes.contact);
    const std::vector<Column>& columns = places.all();
    if (const auto bare =
            std::find_if(columns.begin(), columns.end(), [](const Column& c) { return c.dam >= 0 && c.rows == 0; });
        bare != columns.end())
        refuse(scene.file, fmt::format("seam \"{}\" meets the base at x = {:.6g} m.", scene.seam_body->name, bare->x),
               "rock between seam and base from heel to toe: both are joints of the model",
               "start the seam lower, or upstream of the heel");
    mesh.seam.emplace();
    const std::vector<double> along_base = std::exchange(mesh.contact.distance, {});
    mesh.seam->base = std::exchange(mesh.contact.dam_nodes, {});

    // 1. The rock above the path, a body for each segment.
    Block block(mesh, columns);
    std::vector<std::vector<std::vector<int>>> bodies;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
        bodies.push_back(block.append(places.at(path[i].x), places.at(path[i + 1].x)));
    add_base(mesh, columns, bodies.front(), along_base);
    mesh.dam_node_count = mesh.node_count();
    mesh.dam_element_count = mesh.element_count();

    // 2. The rock below it.
    const Below below(mesh, scene, sizes, columns);
    below.set_edges(mesh);

    // 3. Pairs along the path, and on the interfaces up from its bends.
    const std::vector<int> rock = below.path();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        add_segment(mesh, bodies[i], rock, places.at(path[i].x), i > 0, i + 1 < bodies.size());
    mesh.contact.rock_node_distance = mesh.contact.distance;
    mesh.contact.rock_line = mesh.contact.rock_nodes;
    mesh.contact.rock_distance = mesh.contact.distance;
    for (std::size_t i = 0; i < mesh.contact.dam_nodes.size(); ++i) // the same bits
        mesh.nodes[static_cast<std::size_t>(mesh.contact.rock_nodes[i])] =
            mesh.nodes[static_cast<std::size_t>(mesh.contact.dam_nodes[i])];
    for (std::size_t i = 1; i < bodies.size(); ++i) {
        const std::vector<int>&upstream = bodies[i - 1].back(), &downstream = bodies[i].front();
        mesh.seam->bends.push_back({upstream.back(), downstream.back(), rock[places.at(path[i].x)]});
        add_interface(mesh, upstream, downstream);
    }

    // 4. Faces with water in them, and the ground above the path.
    const std::vector<int>&first = bodies.front().front(), &last = bodies.back().back();
    if (first.size() > 1) mesh.seam->crack = {reversed(below.crack()), first};
    if (last.size() > 1) {
        mesh.seam->end.upstream = reversed(last);
        mesh.ground.clear(); // far below: no water of it reaches the dam
    }
    NodeChain top;
    for (const auto& body : bodies)
        for (const std::vector<int>& column : body) top.push_back(column.front());
    const std::vector<int>& under_dam = mesh.lifts.front().lower_nodes;
    const auto heel = std::find(top.begin(), top.end(), under_dam.front()),
               toe = std::find(top.begin(), top.end(), under_dam.back());
    mesh.floor.insert(mesh.floor.begin(), std::make_reverse_iterator(heel + 1), top.rend());
    mesh.ground.insert(mesh.ground.end(), top.rbegin(), std::make_reverse_iterator(toe));
}

} // namespace damslip::fe2d
