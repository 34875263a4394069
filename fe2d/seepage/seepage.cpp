#include "fe2d/seepage/seepage.hpp"

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/element/elastic.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip::fe2d {

namespace {

/// Rock nodes straight below that on the base nearest to a distance, down to a depth.
std::vector<int> nodes_below(const Mesh& mesh, double distance, double depth)
{
    const ContactPlane& contact = mesh.contact;
    const std::vector<double>& distances = contact.matching ? contact.distance : contact.rock_node_distance;
    const auto nearest = std::min_element(distances.begin(), distances.end(), [&](double a, double b) {
        return std::abs(a - distance) < std::abs(b - distance);
    });
    const Point top = mesh.nodes[contact.rock_nodes[nearest - distances.begin()]];
    const double tolerance = 1e-6 * distances.back();
    std::vector<int> nodes;
    for (int n = mesh.dam_node_count; n < mesh.node_count(); ++n)
        if (std::abs(mesh.nodes[n].x - top.x) < tolerance && mesh.nodes[n].y > top.y - depth - tolerance)
            nodes.push_back(n);
    return nodes;
}

/// Head of free water standing on a surface point, or of the point itself where it is dry.
double surface_head(const std::optional<double>& level, double elevation)
{
    return std::max(level.value_or(elevation), elevation);
}

/// @param drained  nodes that the drains hold at `drain_head`
std::vector<NodeHead> boundary_heads(const Mesh& mesh, const UpliftState& state, const std::vector<int>& drained,
                                     double drain_head)
{
    std::vector<NodeHead> heads;
    for (const int n : drained) heads.push_back({n, drain_head});
    for (const int n : with_mid_nodes(mesh, mesh.floor))
        heads.push_back({n, surface_head(state.reservoir_level, mesh.nodes[n].y)});
    for (const int n : with_mid_nodes(mesh, mesh.ground))
        heads.push_back({n, surface_head(state.tailwater_level, mesh.nodes[n].y)});
    return heads;
}

double total(const Eigen::VectorXd& inflow, const std::vector<int>& nodes)
{
    double sum = 0.0;
    for (const int n : nodes) sum += inflow[n];
    return sum;
}

void fill_profile(SeepageResult& result)
{
    const auto& contact = result.mesh.contact;
    const std::vector<double>& distance = contact.matching ? contact.distance : contact.rock_node_distance;
    result.lowest_pressure = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < contact.rock_nodes.size(); ++i) {
        const int n = contact.rock_nodes[i];
        const double p = result.unit_weight * (result.field.head[n] - result.mesh.nodes[n].y);
        result.lowest_pressure = std::min(result.lowest_pressure, p);
        result.profile.points.push_back({distance[i], std::max(0.0, p)});
    }
    result.uplift = resultant(result.profile).force;
    const double scale = result.unit_weight * result.profile.points.back().distance;
    if (result.lowest_pressure < -1e-9 * scale)
        result.notes.push_back({NoteKind::suction, {1e-3 * result.lowest_pressure}});
}

double pressure_near(const SeepageResult& result, double distance)
{
    const auto& points = result.profile.points;
    const auto nearest = std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.distance - distance) < std::abs(b.distance - distance);
    });
    return nearest->pressure;
}

void fill_curtain(SeepageResult& result, const Curtain& curtain, const Permeability& permeability)
{
    result.pressure_before_curtain = pressure_near(result, curtain.distance);
    result.pressure_behind_curtain = pressure_near(result, curtain.distance + curtain.thickness);
    const std::vector<int> line = nodes_below(result.mesh, curtain.distance, std::numeric_limits<double>::infinity());
    const double x = result.mesh.nodes[line.front()].x;
    const auto behind_line = [&](const Element& element, const Corners& points) {
        double centre = 0.0;
        for (int i = 0; i < element.size(); ++i) centre += points[i].x / element.size();
        return centre > x;
    };
    const auto curtain_only = [](const Element& element, const Corners&) { return element.region == Region::curtain; };
    const double all = flow_into(result.mesh, permeability, result.field, line, behind_line);
    result.flow_through_curtain = flow_into(result.mesh, permeability, result.field, line, curtain_only);
    result.flow_under_curtain = all - result.flow_through_curtain;
}

/// A row of open holes has one head: water may enter below and leave above. Where the holes would give more than they take, as
/// behind a curtain that lowers the head below theirs, they do nothing.
DarcySolution solve_with_drains(const Mesh& mesh, const Permeability& permeability, const UpliftState& state,
                                const std::vector<int>& nodes, double drain_head)
{
    DarcySolution field = solve_darcy(mesh, permeability, boundary_heads(mesh, state, nodes, drain_head));
    if (nodes.empty() || !field.solver.ok() || total(field.inflow, nodes) <= 0.0) return field;
    return solve_darcy(mesh, permeability, boundary_heads(mesh, state, {}, drain_head));
}

Permeability permeability_of(const Scene& scene, const UpliftState& state)
{
    Permeability k;
    k.rock = rock_permeability(scene);
    const bool works = curtain_changes_flow(scene) && state.curtain == CurtainState::intact;
    k.curtain = works ? scene.curtain->permeability : k.rock;
    return k;
}

} // namespace

std::optional<DrainLine> drain_line(const Scene& scene, const UpliftState& state)
{
    if (!scene.drains || state.drains == DrainState::ineffective) return std::nullopt;
    const double length = base_length(scene.section), slope = std::sin(base_inclination(scene.section));
    const Drains& drains = *scene.drains;
    const double upstream = surface_head(state.reservoir_level, 0.0);
    double low = surface_head(state.tailwater_level, -slope * length);
    if (drains.gallery_level) low = std::max(low, *drains.gallery_level);
    DrainLine line;
    line.distance = drains.distance;
    line.depth = drains.depth.value_or(scene.curtain ? 0.5 * scene.curtain->depth : 0.25 * length);
    line.head = low + (1.0 - drains.efficiency) * (upstream - low) * (length - drains.distance) / length;
    return line;
}

SeepageResult solve_seepage(const Scene& scene, const UpliftState& state, const SeepageMeshOptions& options)
{
    SeepageResult result = solve_seepage_on(seepage_mesh(scene, drain_line(scene, state), options), scene, state);
    if (!scene.foundation) {
        const SeepageBox box = seepage_box(scene);
        result.notes.push_back({NoteKind::seepage_box, {box.width, box.depth, permeability_of(scene, state).rock}});
    }
    return result;
}

SeepageResult solve_seepage_on(Mesh mesh, const Scene& scene, const UpliftState& state)
{
    assert(mesh.has_rock());
    const std::optional<DrainLine> drains = drain_line(scene, state);
    const Permeability permeability = permeability_of(scene, state);
    SeepageResult result;
    result.mesh = std::move(mesh);
    result.unit_weight = water_unit_weight(scene);
    const std::vector<int> drain_nodes =
        drains ? nodes_below(result.mesh, drains->distance, drains->depth) : std::vector<int>{}; // ascending
    result.field = solve_with_drains(result.mesh, permeability, state, drain_nodes, drains ? drains->head : 0.0);
    if (!result.field.solver.ok()) {
        result.notes.push_back({NoteKind::seepage_failed, {text_of(result.field.solver.note())}});
        return result;
    }
    fill_profile(result);
    result.inflow = total(result.field.inflow, with_mid_nodes(result.mesh, result.mesh.floor));
    result.outflow = -total(result.field.inflow, with_mid_nodes(result.mesh, result.mesh.ground));
    if (drains) {
        result.drain_flow = -total(result.field.inflow, drain_nodes);
        result.notes.push_back({NoteKind::drain_line, {drains->distance, drains->depth, drains->head}});
    }
    if (curtain_changes_flow(scene)) fill_curtain(result, *scene.curtain, permeability);
    return result;
}

std::vector<Point> uplift_points(const SeepageResult& result, const Scene& scene, const UpliftState& state)
{
    const double at_heel = result.unit_weight * state.reservoir_level.value_or(0.0);
    if (!(at_heel > 0.0)) return {};
    std::vector<Point> points;
    for (const ProfilePoint& p : result.profile.points) points.push_back({p.distance, p.pressure / at_heel});
    points.front().x = 0.0;
    points.back().x = base_length(scene.section);
    return points;
}

namespace {

constexpr Region rock_regions[] = {Region::rock, Region::curtain};

bool in_rock(const Element& element)
{
    return element.region == Region::rock || element.region == Region::curtain;
}

double conductivity(const Permeability& permeability, const Element& element)
{
    return element.region == Region::curtain ? permeability.curtain : permeability.rock;
}

ElementMatrixFunction element_conduction(const Permeability& permeability)
{
    return [permeability](const Element& element, const Corners& corners) -> ElementMatrix {
        if (!in_rock(element)) return {};
        return scalar_gradient_matrix(corners, element.size(), conductivity(permeability, element),
                                      extra_nodes(element));
    };
}

Eigen::VectorXd unknowns(const DofMap& dofs, const Eigen::VectorXd& nodal)
{
    Eigen::VectorXd values(dofs.count);
    for (int node = 0; node < dofs.node_count(); ++node)
        if (dofs(node) != no_dof) values[dofs(node)] = nodal[node];
    return values;
}

void place(const DofMap& dofs, const Eigen::VectorXd& values, Eigen::VectorXd& nodal)
{
    for (int node = 0; node < dofs.node_count(); ++node)
        if (dofs(node) != no_dof) nodal[node] = values[dofs(node)];
}

} // namespace

DarcySolution solve_darcy(const Mesh& mesh, const Permeability& permeability, std::span<const NodeHead> heads)
{
    assert(!heads.empty());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    DarcySolution solution{
        Eigen::VectorXd::Constant(mesh.node_count(), nan), Eigen::VectorXd::Constant(mesh.node_count(), nan), {}};
    std::vector<int> prescribed;
    Eigen::VectorXd nodal = Eigen::VectorXd::Zero(mesh.node_count());
    for (const NodeHead& h : heads) {
        prescribed.push_back(h.node);
        nodal[h.node] = h.head;
    }
    const DofMap all = scalar_dofs(mesh, rock_regions, {}), free = scalar_dofs(mesh, rock_regions, prescribed);
    const SparseMatrix conduction = assemble(mesh, all, element_conduction(permeability));

    LinearSolver solver;
    solver.factorise(assemble(mesh, free, element_conduction(permeability)));
    solution.solver = solver.report();
    if (!solution.solver.ok()) return solution;
    Eigen::VectorXd driving(mesh.node_count()); // inflow that the prescribed heads alone would need, node by node
    place(all, conduction * unknowns(all, nodal), driving);
    place(free, solver.solve(Eigen::VectorXd(-unknowns(free, driving))), nodal);
    place(all, unknowns(all, nodal), solution.head);
    place(all, conduction * unknowns(all, nodal), solution.inflow);
    return solution;
}

double flow_into(const Mesh& mesh, const Permeability& permeability, const DarcySolution& solution,
                 std::span<const int> nodes, const std::function<bool(const Element&, const Corners&)>& chosen)
{
    std::vector<char> given(mesh.nodes.size(), 0);
    for (const int node : nodes) given[node] = 1;
    double flow = 0.0;
    for (const Element& element : mesh.elements) {
        const Corners points = corners(mesh, element);
        if (!in_rock(element) || !chosen(element, points)) continue;
        const ElementNodes at = element.all();
        ElementVector head(at.count);
        for (int i = 0; i < at.count; ++i) head[i] = solution.head[at[i]];
        const ElementVector inflow =
            scalar_gradient_matrix(points, element.size(), conductivity(permeability, element), extra_nodes(element)) *
            head;
        for (int i = 0; i < at.count; ++i)
            if (given[at[i]]) flow += inflow[i];
    }
    return flow;
}

} // namespace damslip::fe2d
