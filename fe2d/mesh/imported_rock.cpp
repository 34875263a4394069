#include "fe2d/mesh/imported_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

namespace {

constexpr double near_share = 1e-5; ///< share of the base length: on the same line, at the same place

enum class Side { surface, left, bottom, right };
constexpr const char* side_names[] = {"surface", "rock-left", "rock-bottom", "rock-right"};

/// The outline of the rock in pieces, counter-clockwise from the heel on.
struct RockSides {
    NodeChain floor, left, bottom, right, ground, base; ///< base: toe to heel
};

class RockImport {
public:
    RockImport(const Mesh& mesh, const GmshFile& file, const ImportedBody& rock)
        : mesh_(mesh), file_(file), rock_(rock), heel_(mesh.nodes[mesh.contact.dam_nodes.front()]),
          toe_(mesh.nodes[mesh.contact.dam_nodes.back()]), length_(std::hypot(toe_.x - heel_.x, toe_.y - heel_.y))
    {
    }

    double along(Point p) const
    {
        return ((p.x - heel_.x) * (toe_.x - heel_.x) + (p.y - heel_.y) * (toe_.y - heel_.y)) / length_;
    }
    double off(Point p) const
    {
        return ((p.y - heel_.y) * (toe_.x - heel_.x) - (p.x - heel_.x) * (toe_.y - heel_.y)) / length_;
    }
    bool on_line(Point p) const { return std::abs(off(p)) <= near_share * length_; }

    RockSides sides() const
    {
        NodeChain loop = outline_of(file_, rock_);
        std::rotate(loop.begin(), loop.begin() + place_of(loop, heel_, "heel"), loop.end());
        const std::ptrdiff_t toe_at = place_of(loop, toe_, "toe");
        RockSides sides;
        sides.base.assign(loop.begin() + toe_at, loop.end());
        sides.base.push_back(loop.front());
        for (const int n : sides.base)
            if (!on_line(rock_.nodes[n]))
                refuse_mesh(
                    file_, 0,
                    fmt::format("the rock does not follow the base: between toe and heel its outline goes through "
                                "({:.6g}, {:.6g}) m.",
                                rock_.nodes[n].x, rock_.nodes[n].y),
                    "rock below the whole base", "let dam and rock share the curve from heel to toe");
        loop.resize(static_cast<std::size_t>(toe_at) + 1);
        divide(loop, sides);
        check_apart(loop);
        return sides;
    }

private:
    std::ptrdiff_t place_of(const NodeChain& loop, Point p, const char* what) const
    {
        const auto found = std::find_if(loop.begin(), loop.end(), [&](int n) {
            return std::hypot(rock_.nodes[n].x - p.x, rock_.nodes[n].y - p.y) <= near_share * length_;
        });
        if (found == loop.end())
            refuse_mesh(file_, 0,
                        fmt::format("the outline of the rock has no node at the {} of the dam, ({:.6g}, {:.6g}) m.",
                                    what, p.x, p.y),
                        "rock below the whole base, with nodes at heel and toe",
                        "let dam and rock share the curve from heel to toe");
        return found - loop.begin();
    }

    /// Sides by name where the file has the line, otherwise by place.
    void divide(const NodeChain& loop, RockSides& sides) const
    {
        double left = HUGE_VAL, right = -HUGE_VAL, bottom = HUGE_VAL;
        for (const int n : loop) {
            left = std::min(left, rock_.nodes[n].x), right = std::max(right, rock_.nodes[n].x);
            bottom = std::min(bottom, rock_.nodes[n].y);
        }
        const auto names = {Side::left, Side::bottom, Side::right};
        std::optional<EdgeSet> named[4];
        for (const Side side : names)
            named[static_cast<int>(side)] = named_edges(file_, rock_, side_names[static_cast<int>(side)]);
        const auto at = [&](double a, double b, double place) {
            return std::max(std::abs(a - place), std::abs(b - place)) <= near_share * length_;
        };
        const auto side_of = [&](int a, int b) {
            for (const Side side : names)
                if (const auto& edges = named[static_cast<int>(side)]; edges && edges->contains(edge(a, b)))
                    return side;
            const Point p = rock_.nodes[a], q = rock_.nodes[b];
            if (!named[1] && at(p.x, q.x, left)) return Side::left;
            if (!named[2] && at(p.y, q.y, bottom)) return Side::bottom;
            if (!named[3] && at(p.x, q.x, right)) return Side::right;
            return Side::surface;
        };
        NodeChain* pieces[] = {&sides.floor, &sides.left, &sides.bottom, &sides.right, &sides.ground};
        constexpr Side wanted[] = {Side::surface, Side::left, Side::bottom, Side::right, Side::surface};
        std::size_t i = 0;
        for (int piece = 0; piece < 5; ++piece) {
            pieces[piece]->push_back(loop[i]);
            while (i + 1 < loop.size() && side_of(loop[i], loop[i + 1]) == wanted[piece])
                pieces[piece]->push_back(loop[++i]);
            if (pieces[piece]->size() < 2 || (piece == 4 && i + 1 < loop.size()))
                refuse_mesh(
                    file_, 0,
                    fmt::format("the outline of the rock is not understood at ({:.6g}, {:.6g}) m: \"{}\" was to {} "
                                "there.",
                                rock_.nodes[loop[i]].x, rock_.nodes[loop[i]].y,
                                side_names[static_cast<int>(wanted[piece])],
                                pieces[piece]->size() < 2 ? "begin" : "go on to the toe"),
                    "from the heel: surface, left side, bottom, right side, surface to the toe",
                    "name the sides of a rock that is no box: physical lines \"rock-left\", \"rock-bottom\", "
                    "\"rock-right\"");
        }
        for (const Side side : names)
            check_named(file_, rock_, side_names[static_cast<int>(side)], *pieces[static_cast<int>(side)]);
        check_named(file_, rock_, "floor", sides.floor);
        check_named(file_, rock_, "ground", sides.ground);
    }

    /// Dam and rock meet on the base alone.
    void check_apart(const NodeChain& loop) const
    {
        std::vector<Point> places;
        for (std::size_t i = 1; i + 1 < loop.size(); ++i) places.push_back(rock_.nodes[loop[i]]);
        std::sort(places.begin(), places.end(), [](Point a, Point b) { return a.x < b.x; });
        for (const NodeChain* face : {&mesh_.upstream_face, &mesh_.downstream_face})
            for (std::size_t i = face == &mesh_.downstream_face ? 1 : 0;
                 i + (face == &mesh_.upstream_face) < face->size(); ++i) {
                const Point p = mesh_.nodes[(*face)[i]];
                auto q = std::lower_bound(places.begin(), places.end(), p.x - near_share * length_,
                                          [](Point a, double x) { return a.x < x; });
                for (; q != places.end() && q->x <= p.x + near_share * length_; ++q)
                    if (std::abs(q->y - p.y) <= near_share * length_)
                        refuse_mesh(file_, 0,
                                    fmt::format("dam and rock meet at ({:.6g}, {:.6g}) m, beside the base.", p.x, p.y),
                                    "dam and rock with the base in common and nothing else",
                                    "take the rock beside the dam out of the geometry");
            }
    }

    const Mesh& mesh_;
    const GmshFile& file_;
    const ImportedBody& rock_;
    Point heel_, toe_;
    double length_;
};

bool same_places(const Mesh& mesh)
{
    const ContactPlane& plane = mesh.contact;
    if (plane.dam_nodes.size() != plane.rock_nodes.size()) return false;
    for (std::size_t i = 0; i < plane.dam_nodes.size(); ++i) {
        const Point a = mesh.nodes[plane.dam_nodes[i]], b = mesh.nodes[plane.rock_nodes[i]];
        if (std::hypot(b.x - a.x, b.y - a.y) > near_share * plane.distance.back()) return false;
    }
    return true;
}

/// The rock's side of the plane; `line` and `places`: its straight surface nodes from upstream to downstream.
void fill_plane(Mesh& mesh, std::vector<int> line, std::vector<double> places, std::size_t heel_at, std::size_t toe_at)
{
    ContactPlane& plane = mesh.contact;
    plane.rock_nodes.assign(line.begin() + static_cast<std::ptrdiff_t>(heel_at),
                            line.begin() + static_cast<std::ptrdiff_t>(toe_at) + 1);
    plane.matching = same_places(mesh);
    if (plane.matching)
        for (std::size_t i = 0; i < plane.rock_nodes.size(); ++i) {
            mesh.nodes[plane.rock_nodes[i]] = Point(mesh.nodes[plane.dam_nodes[i]]); // the same bits
            places[heel_at + i] = plane.distance[i];
        }
    mesh.nodes[plane.rock_nodes.front()] = Point(mesh.nodes[plane.dam_nodes.front()]);
    mesh.nodes[plane.rock_nodes.back()] = Point(mesh.nodes[plane.dam_nodes.back()]);
    places[heel_at] = plane.distance.front();
    places[toe_at] = plane.distance.back();
    plane.rock_node_distance.assign(places.begin() + static_cast<std::ptrdiff_t>(heel_at),
                                    places.begin() + static_cast<std::ptrdiff_t>(toe_at) + 1);
    plane.rock_line = std::move(line);
    plane.rock_distance = std::move(places);
}

/// How many nodes of the surface, from heel or toe on, go on straight until they are `reach` away.
std::size_t straight_nodes(const RockImport& rock, const ImportedBody& body, const std::vector<int>& surface,
                           double from, double reach)
{
    std::size_t count = 0;
    while (count + 1 < surface.size()) {
        if (count > 0 && std::abs(rock.along(body.nodes[surface[count]]) - from) >= reach * (1 - 1e-9)) break;
        if (!rock.on_line(body.nodes[surface[count + 1]])) break;
        ++count;
    }
    return count;
}

void check_reach(const GmshFile& file, const ContactPlane& plane, const ContactExtension& extension)
{
    const double up = -plane.rock_distance.front(), down = plane.rock_distance.back() - plane.distance.back();
    if (up >= extension.upstream * (1 - 1e-9) && down >= extension.downstream * (1 - 1e-9)) return;
    refuse_mesh(
        file, 0,
        fmt::format("the rock surface goes on straight {:.3g} m upstream of the heel and {:.3g} m downstream of the "
                    "toe.",
                    up, down),
        fmt::format("at least {:g} m and {:g} m for contact.sliding = \"finite\"", extension.upstream,
                    extension.downstream),
        "make it straight as far as contact.max_slip_m, or use  sliding = \"small\"");
}

} // namespace

void append_imported_rock(Mesh& mesh, const GmshFile& file, const ImportedBody& rock, const Scene& scene,
                          const ContactExtension& extension)
{
    const RockImport import(mesh, file, rock);
    const RockSides sides = import.sides();
    const int first = mesh.node_count();
    mesh.nodes.insert(mesh.nodes.end(), rock.nodes.begin(), rock.nodes.end());
    for (Element element : rock.elements) {
        for (int i = 0; i < element.size(); ++i) element.nodes[i] += first;
        mesh.elements.push_back(element);
    }
    const std::vector<int> ground(sides.ground.rbegin(), sides.ground.rend()); // from the toe
    const std::size_t up = straight_nodes(import, rock, sides.floor, 0.0, extension.upstream),
                      down = straight_nodes(import, rock, ground, mesh.contact.distance.back(), extension.downstream);
    std::vector<int> line;
    for (std::size_t i = up; i > 0; --i) line.push_back(sides.floor[i]);
    line.insert(line.end(), sides.base.rbegin(), sides.base.rend());
    const std::size_t toe_at = line.size() - 1;
    line.insert(line.end(), ground.begin() + 1, ground.begin() + 1 + static_cast<std::ptrdiff_t>(down));
    std::vector<double> places;
    for (const int n : line) places.push_back(import.along(rock.nodes[n]));
    for (int& n : line) n += first;
    fill_plane(mesh, std::move(line), std::move(places), up, toe_at);
    if (scene.contact.sliding == JointPath::finite) check_reach(file, mesh.contact, extension);

    const auto chain = [first](NodeChain own) {
        for (int& n : own) n += first;
        return own;
    };
    mesh.floor = chain(sides.floor);
    mesh.box_left = chain(sides.left);
    mesh.box_bottom = chain(sides.bottom);
    mesh.box_right = chain(sides.right);
    mesh.ground = chain(sides.ground);
}

} // namespace damslip::fe2d
