#include "fe2d/mesh/faces.hpp"
#include "fe2d/mesh/import_mesh.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace damslip::fe2d {

namespace {

constexpr double straight_base = 1e-5; ///< share of the base length that its nodes may lie off the line heel to toe

/// The four sides of the dam, each a piece of its outline: counter-clockwise from the heel.
struct DamSides {
    NodeChain base, downstream, crest, upstream;
};

std::string text(Point p)
{
    return fmt::format("({:.6g}, {:.6g})", p.x, p.y);
}

double distance(Point a, Point b)
{
    return std::hypot(b.x - a.x, b.y - a.y);
}

double distance_to_polygon(const Polyline& polygon, Point p)
{
    double best = HUGE_VAL;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double dx = b.x - a.x, dy = b.y - a.y;
        const double t = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
        best = std::min(best, distance(p, {a.x + t * dx, a.y + t * dy}));
    }
    return best;
}

class DamImport {
public:
    DamImport(const GmshFile& file, const ImportedBody& dam, const Scene& scene)
        : file_(file), dam_(dam), scene_(scene), base_(base_length(scene.section)),
          tolerance_(section_tolerance * base_)
    {
    }

    DamSides sides()
    {
        NodeChain loop = outline_of(file_, dam_);
        const std::size_t toe_at = turn_to_base(loop);
        check_section(loop, toe_at);
        loop.push_back(loop.front()); // closed: the upstream face ends at the heel
        const auto [down, up] = crest_ends(scene_.section);
        const std::size_t from = crest_end(loop, toe_at, down, "downstream"),
                          to = down == up ? from : crest_end(loop, from, up, "upstream");
        const auto piece = [&](std::size_t a, std::size_t b) {
            return NodeChain(loop.begin() + static_cast<std::ptrdiff_t>(a),
                             loop.begin() + static_cast<std::ptrdiff_t>(b) + 1);
        };
        DamSides sides{piece(0, toe_at), piece(toe_at, from), piece(from, to), piece(to, loop.size() - 1)};
        check_named(file_, dam_, "base", sides.base);
        check_named(file_, dam_, "downstream", sides.downstream);
        check_named(file_, dam_, "crest", sides.crest);
        check_named(file_, dam_, "upstream", sides.upstream);
        return sides;
    }

private:
    /// Turns the outline so that it starts at the heel. @returns the place of the toe in it
    std::size_t turn_to_base(NodeChain& loop) const
    {
        const auto edges = named_edges(file_, dam_, "base");
        if (!edges)
            refuse_mesh(file_, 0, "there is no physical line \"base\".",
                        "the edges between dam and rock in a group of that name",
                        "in Gmsh:  Physical Curve(\"base\") = {...};");
        const std::size_t n = loop.size();
        const auto in_base = [&](std::size_t i) { return edges->contains(edge(loop[i % n], loop[(i + 1) % n])); };
        std::size_t first = n;
        for (std::size_t i = 0; i < n; ++i)
            if (in_base(i) && !in_base(i + n - 1)) first = i;
        if (first == n)
            refuse_mesh(file_, 0, "no edge of the physical line \"base\" is on the outline of the dam.",
                        "the edges between dam and rock, with the nodes of the dam where the base has its nodes twice",
                        "give the group the curve at the foot of the dam");
        std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first), loop.end());
        std::size_t end = 0;
        while (end < n && edges->contains(edge(loop[end], loop[(end + 1) % n]))) ++end;
        return end;
    }

    void check_section(const NodeChain& loop, std::size_t toe_at) const
    {
        const auto same = [&](const char* what, Point found, Point wanted) {
            if (distance(found, wanted) > tolerance_)
                refuse_mesh(
                    file_, 0,
                    fmt::format("the {} of the mesh is at {} m, that of the scene's section at {} m.", what,
                                text(found), text(wanted)),
                    fmt::format("the same place within {:g} of the base: {:.3g} m", section_tolerance, tolerance_),
                    "the heel is the origin, x points downstream; where the unit of the file is not the metre "
                    "give mesh.file_unit_m; or correct section");
        };
        same("heel", dam_.nodes[loop[0]], heel(scene_.section));
        same("toe", dam_.nodes[loop[toe_at]], toe(scene_.section));
        for (const int n : loop)
            if (const double off = distance_to_polygon(scene_.section.polygon, dam_.nodes[n]); off > tolerance_)
                refuse_mesh(file_, 0,
                            fmt::format("the outline of the dam has a node at {} m, {:.3g} m off the scene's section.",
                                        text(dam_.nodes[n]), off),
                            fmt::format("at most {:g} of the base: {:.3g} m", section_tolerance, tolerance_),
                            "mesh the section of the scene, or correct section");
        const double wanted = area(Section{scene_.section.polygon});
        if (std::abs(dam_.area - wanted) > section_tolerance * wanted)
            refuse_mesh(file_, 0,
                        fmt::format("the dam of the mesh has an area of {:.6g} m2, the scene's section {:.6g} m2.",
                                    dam_.area, wanted),
                        fmt::format("the same area within {:g} of it", section_tolerance),
                        "mesh the section of the scene, or correct section");
    }

    /// The node of the outline that lies at an end of the section's crest.
    std::size_t crest_end(const NodeChain& loop, std::size_t after, Point wanted, const char* which) const
    {
        std::size_t best = after;
        for (std::size_t i = after; i + 1 < loop.size(); ++i)
            if (distance(dam_.nodes[loop[i]], wanted) < distance(dam_.nodes[loop[best]], wanted)) best = i;
        if (distance(dam_.nodes[loop[best]], wanted) > tolerance_)
            refuse_mesh(file_, 0,
                        fmt::format("no node of the outline is at the {} end of the crest, {} m.", which, text(wanted)),
                        fmt::format("a node within {:g} of the base: {:.3g} m", section_tolerance, tolerance_),
                        "put a point of the geometry there");
        return best;
    }

    const GmshFile& file_;
    const ImportedBody& dam_;
    const Scene& scene_;
    double base_, tolerance_;
};

/// One joint of an imported dam on its way into the mesh.
struct Joint {
    std::vector<int> nodes; ///< of the body, upstream to downstream
    double level = 0.0;     ///< [m]
};

/// Splits the dam along the scene's lift joints: lines of edges through the mesh.
class JointFinder {
public:
    JointFinder(const GmshFile& file, const ImportedBody& dam, double tolerance)
        : file_(file), dam_(dam), tolerance_(tolerance)
    {
    }

    Joint find(const LiftJoint& lift) const
    {
        Joint joint{{}, lift.elevation};
        std::vector<char> below(dam_.nodes.size(), 0), above(dam_.nodes.size(), 0);
        for (std::size_t e = 0; e < dam_.elements.size(); ++e) {
            const Element& element = dam_.elements[e];
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (int i = 0; i < element.size(); ++i) {
                low = std::min(low, dam_.nodes[element.nodes[i]].y);
                high = std::max(high, dam_.nodes[element.nodes[i]].y);
            }
            if (low < joint.level - tolerance_ && high > joint.level + tolerance_)
                refuse_mesh(
                    file_, dam_.lines[e],
                    fmt::format("this element lies across the lift joint \"{}\" at {:g} m.", lift.name, joint.level),
                    "a line of edges through the dam at every lift_joint.elevation_m",
                    "put a curve there in the geometry, or move the joint");
            for (int i = 0; i < element.size(); ++i) {
                const int n = element.nodes[i];
                if (std::abs(dam_.nodes[n].y - joint.level) <= tolerance_)
                    (low < joint.level - tolerance_ ? below : above)[n] = 1;
            }
        }
        for (int n = 0; n < static_cast<int>(dam_.nodes.size()); ++n)
            if (below[n] && above[n]) joint.nodes.push_back(n);
        std::sort(joint.nodes.begin(), joint.nodes.end(),
                  [&](int a, int b) { return dam_.nodes[a].x < dam_.nodes[b].x; });
        if (joint.nodes.size() < 2)
            refuse_mesh(file_, 0,
                        fmt::format("the mesh has no line at the lift joint \"{}\", {:g} m.", lift.name, joint.level),
                        "a line of edges through the dam at every lift_joint.elevation_m",
                        "put a curve there in the geometry, or move the joint");
        return joint;
    }

private:
    const GmshFile& file_;
    const ImportedBody& dam_;
    double tolerance_;
};

/// Numbers the dam's nodes in the mesh: those of the body in its order, and after the last node of each joint the
/// second nodes of that joint.
struct Numbering {
    std::vector<int> lower;                ///< mesh node of every node of the body
    std::vector<std::map<int, int>> upper; ///< for every joint: second node of a node of the body
};

Numbering number_nodes(Mesh& mesh, const ImportedBody& dam, const std::vector<Joint>& joints)
{
    Numbering numbering{std::vector<int>(dam.nodes.size(), -1), std::vector<std::map<int, int>>(joints.size())};
    std::multimap<int, std::size_t> ends; // last node of a joint -> joint
    for (std::size_t j = 0; j < joints.size(); ++j)
        ends.emplace(*std::max_element(joints[j].nodes.begin(), joints[j].nodes.end()), j);
    for (int n = 0; n < static_cast<int>(dam.nodes.size()); ++n) {
        numbering.lower[n] = mesh.node_count();
        mesh.nodes.push_back(dam.nodes[n]);
        const auto [from, to] = ends.equal_range(n);
        for (auto end = from; end != to; ++end)
            for (const int twin : joints[end->second].nodes) {
                numbering.upper[end->second][twin] = mesh.node_count();
                mesh.nodes.push_back(dam.nodes[twin]);
            }
    }
    return numbering;
}

void append_elements(Mesh& mesh, const ImportedBody& dam, const std::vector<Joint>& joints, const Numbering& numbering)
{
    for (const Element& own : dam.elements) {
        double middle = 0.0;
        for (int i = 0; i < own.size(); ++i) middle += dam.nodes[own.nodes[i]].y / own.size();
        Element element = own;
        for (int i = 0; i < own.size(); ++i) {
            element.nodes[i] = numbering.lower[own.nodes[i]];
            for (std::size_t j = 0; j < joints.size(); ++j)
                if (const auto twin = numbering.upper[j].find(own.nodes[i]);
                    twin != numbering.upper[j].end() && middle > joints[j].level)
                    element.nodes[i] = twin->second;
        }
        mesh.elements.push_back(element);
    }
}

enum class Going { up, down };

/// A face through both nodes of every joint it passes.
NodeChain face_of(const NodeChain& own, const Numbering& numbering, Going going)
{
    NodeChain face;
    for (const int n : own) {
        std::vector<int> here{numbering.lower[n]};
        for (const auto& upper : numbering.upper)
            if (const auto twin = upper.find(n); twin != upper.end()) here.push_back(twin->second);
        if (going == Going::down) std::reverse(here.begin(), here.end());
        face.insert(face.end(), here.begin(), here.end());
    }
    return face;
}

void fill_plane(ContactPlane& plane, const Mesh& mesh, const GmshFile& file)
{
    const Point heel = mesh.nodes[plane.dam_nodes.front()], toe = mesh.nodes[plane.dam_nodes.back()];
    const double length = distance(heel, toe), c = (toe.x - heel.x) / length, s = (toe.y - heel.y) / length;
    for (const int n : plane.dam_nodes) {
        const Point p = mesh.nodes[n];
        const double along = (p.x - heel.x) * c + (p.y - heel.y) * s, off = (p.y - heel.y) * c - (p.x - heel.x) * s;
        if (std::abs(off) > straight_base * length || (!plane.distance.empty() && along <= plane.distance.back()))
            refuse_mesh(
                file, 0,
                fmt::format("the base is not straight: its node {} m is {:.3g} m off the line from heel to toe.",
                            text(p), off),
                fmt::format("at most {:g} of the base: {:.3g} m", straight_base, straight_base * length),
                "use a straight curve from heel to toe");
        plane.distance.push_back(along);
    }
}

} // namespace

void append_imported_dam(Mesh& mesh, const GmshFile& file, const ImportedBody& dam, const Scene& scene)
{
    const DamSides sides = DamImport(file, dam, scene).sides();
    const JointFinder finder(file, dam, straight_base * base_length(scene.section));
    std::vector<Joint> joints;
    for (const LiftJoint& lift : scene.lift_joints) joints.push_back(finder.find(lift));
    const Numbering numbering = number_nodes(mesh, dam, joints);
    append_elements(mesh, dam, joints, numbering);

    for (const int n : sides.base) mesh.contact.dam_nodes.push_back(numbering.lower[n]);
    fill_plane(mesh.contact, mesh, file);
    for (const int n : sides.crest) mesh.crest.push_back(numbering.lower[n]);
    mesh.downstream_face = face_of(sides.downstream, numbering, Going::up);
    mesh.upstream_face = face_of(sides.upstream, numbering, Going::down);
    for (std::size_t j = 0; j < joints.size(); ++j) {
        LiftPlane plane;
        const double first = dam.nodes[joints[j].nodes.front()].x;
        for (const int n : joints[j].nodes) {
            plane.lower_nodes.push_back(numbering.lower[n]);
            plane.upper_nodes.push_back(numbering.upper[j].at(n));
            plane.distance.push_back(dam.nodes[n].x - first);
        }
        mesh.lifts.push_back(std::move(plane));
    }
    mesh.dam_node_count = mesh.node_count();
    mesh.dam_element_count = mesh.element_count();
}

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
