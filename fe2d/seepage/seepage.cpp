#include "fe2d/seepage/seepage.hpp"

#include "core/input_error.hpp"
#include "fe2d/assembly/assemble.hpp"
#include "fe2d/element/elastic.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

namespace {

/// Positions from a to b, fine at both ends.
std::vector<double> fine_at_both_ends(double a, double b, const Grading& grading)
{
    const double half = 0.5 * (b - a);
    const std::vector<double> from_end = graded_positions({0.0, half}, grading);
    std::vector<double> positions;
    for (const double d : from_end) positions.push_back(a + d);
    for (auto d = from_end.rbegin() + 1; d != from_end.rend(); ++d) positions.push_back(b - *d);
    positions.back() = b;
    return positions;
}

/// Ascending, without repetitions.
std::vector<double> stations(std::vector<double> values, double tolerance)
{
    std::sort(values.begin(), values.end());
    std::vector<double> result{values.front()};
    for (const double value : values)
        if (value - result.back() > tolerance) result.push_back(value);
    return result;
}

std::vector<double> fine_at_stations(const std::vector<double>& stations, const Grading& grading)
{
    std::vector<double> positions{stations.front()};
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
        const std::vector<double> part = fine_at_both_ends(stations[i], stations[i + 1], grading);
        positions.insert(positions.end(), part.begin() + 1, part.end());
    }
    return positions;
}

int index_of(const std::vector<double>& values, double value)
{
    const auto nearest = std::min_element(
        values.begin(), values.end(), [&](double a, double b) { return std::abs(a - value) < std::abs(b - value); });
    return static_cast<int>(nearest - values.begin());
}

struct Flow {
    const Scene& scene;
    SeepageBox box;
    double base;                    ///< length [m]
    double inclination;             ///< [rad]
    std::optional<Curtain> curtain; ///< where it changes the flow

    /// Rock between the base at a distance from the heel and the bottom of the box [m].
    double rock_below(double distance) const { return box.depth - distance * std::sin(inclination); }
    /// Share of the way to the bottom that a depth below the base is.
    double share(double distance, double depth) const { return depth / rock_below(distance); }
};

void check_box(const Flow& flow)
{
    if (flow.box.width < 1.2 * flow.base || std::min(flow.rock_below(0.0), flow.rock_below(flow.base)) <= 0.0)
        refuse(flow.scene.file,
               fmt::format("foundation box of {:g} m x {:g} m is too small for seepage under a base of {:g} m.",
                           flow.box.width, flow.box.depth, flow.base),
               "width at least 1.2 base lengths, bottom below the base",
               "make foundation.width_m about 5 base lengths and foundation.depth_m about 2");
}

void check_line(const Flow& flow, const char* what, double from, double to, double depth)
{
    if (from < 0.0 || to > flow.base || to < from)
        refuse(flow.scene.file,
               fmt::format("{0}: {1:g} to {2:g} m from the heel is not below the base.", what, from, to),
               fmt::format("between 0 and the base length of {:g} m", flow.base), "move it between heel and toe");
    if (!(depth > 0.0 && depth < flow.rock_below(from)))
        refuse(flow.scene.file, fmt::format("{}: depth {:g} m does not end inside the foundation.", what, depth),
               fmt::format("more than 0 and less than {:g} m", flow.rock_below(from)), "make the foundation deeper");
}

void place_columns(RockLayout& layout, const Flow& flow, const std::optional<DrainLine>& drains, const Grading& grading)
{
    std::vector<double> marks{0.0, flow.base};
    if (flow.curtain) {
        marks.push_back(flow.curtain->distance);
        marks.push_back(flow.curtain->distance + flow.curtain->thickness);
    }
    if (drains) marks.push_back(drains->distance);
    layout.plane = fine_at_stations(stations(marks, 1e-9 * flow.base), grading);
    layout.base_begin = 0;
    layout.base_end = static_cast<int>(layout.plane.size()) - 1;
    const double heel_x = 0.0, toe_x = flow.base * std::cos(flow.inclination), middle = 0.5 * (heel_x + toe_x);
    for (const double d : graded_positions({0.0, heel_x - middle + 0.5 * flow.box.width}, grading))
        layout.left.push_back(heel_x - d);
    for (const double d : graded_positions({0.0, middle + 0.5 * flow.box.width - toe_x}, grading))
        layout.right.push_back(toe_x + d);
}

void place_rows(RockLayout& layout, const Flow& flow, const std::optional<DrainLine>& drains, const Grading& grading)
{
    std::vector<double> marks{0.0};
    const auto& curtain = flow.curtain;
    if (curtain) marks.push_back(flow.box.depth * flow.share(curtain->distance, curtain->depth));
    if (drains) marks.push_back(flow.box.depth * flow.share(drains->distance, drains->depth));
    const std::vector<double> fine = stations(marks, 1e-9 * flow.box.depth);
    if (fine.size() > 1) layout.depths = fine_at_stations(fine, grading);
    const double last = fine.back();
    for (const double d : graded_positions({0.0, flow.box.depth - last}, grading))
        if (d > 0.0 || layout.depths.empty()) layout.depths.push_back(last + d);
    if (curtain) {
        layout.curtain_begin = index_of(layout.plane, curtain->distance);
        layout.curtain_end = index_of(layout.plane, curtain->distance + curtain->thickness);
        layout.curtain_rows = index_of(layout.depths, marks[1]);
    }
    for (double& d : layout.depths) d /= flow.box.depth;
    layout.depths.back() = 1.0;
    layout.bottom = -flow.box.depth;
}

} // namespace

SeepageBox seepage_box(const Scene& scene)
{
    if (scene.foundation) return {scene.foundation->width, scene.foundation->depth};
    const double base = base_length(scene.section);
    return {300.0 / 45.0 * base, 100.0 / 45.0 * base};
}

Mesh seepage_mesh(const Scene& scene, const std::optional<DrainLine>& drains, const SeepageMeshOptions& options)
{
    assert(options.finest > 0.0 && options.growth > 1.0 && options.largest > 0.0);
    const Flow flow{scene, seepage_box(scene), base_length(scene.section), base_inclination(scene.section),
                    curtain_changes_flow(scene) ? scene.curtain : std::nullopt};
    check_box(flow);
    if (flow.curtain)
        check_line(flow, "curtain", flow.curtain->distance, flow.curtain->distance + flow.curtain->thickness,
                   flow.curtain->depth);
    if (drains) check_line(flow, "drains", drains->distance, drains->distance, drains->depth);
    double finest = options.finest * flow.base;
    if (flow.curtain) finest = std::min(finest, 0.25 * flow.curtain->thickness);
    const Grading grading{finest, options.growth, std::max(finest, options.largest * flow.box.depth)};

    RockLayout layout;
    layout.inclination = flow.inclination;
    place_columns(layout, flow, drains, grading);
    place_rows(layout, flow, drains, grading);

    Mesh mesh;
    for (const double d : layout.plane) {
        mesh.contact.dam_nodes.push_back(mesh.node_count());
        mesh.nodes.push_back({d * std::cos(flow.inclination), -d * std::sin(flow.inclination)});
    }
    mesh.dam_node_count = mesh.node_count();
    mesh.contact.distance = layout.plane;
    append_rock(mesh, layout);
    return mesh;
}

namespace {

enum class Form { divergence, gradient };

ElementVector element_force(const Corners& corners, int size, const ElementVector& pressure, Form form,
                            const ExtraNodes& extra)
{
    const int nodes = size + extra.count();
    ElementVector force = ElementVector::Zero(2 * nodes);
    const auto add = [&](const auto& point) {
        const double p = point.shape.head(nodes).dot(pressure.head(nodes));
        const Eigen::Vector2d gradient = point.gradient.leftCols(nodes) * pressure.head(nodes);
        for (int i = 0; i < nodes; ++i) {
            const Eigen::Vector2d f = form == Form::divergence ? Eigen::Vector2d(p * point.gradient.col(i))
                                                               : Eigen::Vector2d(-point.shape[i] * gradient);
            force.segment<2>(2 * i) += point.weight * f;
        }
    };
    if (extra.any())
        for (const auto& point : quadratic_points(corners, size, extra)) add(point);
    else if (size == 3)
        for (const auto& point : t3_points(corners)) add(point);
    else
        for (const auto& point : q4_points(corners)) add(point);
    return force;
}

Eigen::VectorXd rock_force(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure, Form form)
{
    assert(pressure.size() == mesh.node_count() && dofs.components == 2);
    return assemble_vector(mesh, dofs, [&](const Element& element, const Corners& corners) -> ElementVector {
        if (element.region != Region::rock && element.region != Region::curtain) return {};
        const ElementNodes nodes = element.all();
        ElementVector p(nodes.count);
        for (int i = 0; i < nodes.count; ++i) p[i] = pressure[nodes[i]];
        return element_force(corners, element.size(), p, form, extra_nodes(element));
    });
}

} // namespace

Eigen::VectorXd excess_pore_pressure(const Eigen::VectorXd& head, double unit_weight)
{
    return head.unaryExpr([&](double h) { return std::isfinite(h) ? unit_weight * h : 0.0; });
}

Eigen::VectorXd pore_pressure_force(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure)
{
    return rock_force(mesh, dofs, pressure, Form::divergence);
}

Eigen::VectorXd seepage_body_force(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure)
{
    return rock_force(mesh, dofs, pressure, Form::gradient);
}

Eigen::VectorXd surface_pressure_force(const Mesh& mesh, const DofMap& dofs, std::span<const int> chain,
                                       const Eigen::VectorXd& pressure)
{
    Eigen::VectorXd force = Eigen::VectorXd::Zero(dofs.count);
    const auto add = [&](int node, double x, double y) {
        if (dofs(node, 0) != no_dof) force[dofs(node, 0)] += x;
        if (dofs(node, 1) != no_dof) force[dofs(node, 1)] += y;
    };
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const int a = chain[i], b = chain[i + 1];
        const Point from = mesh.nodes[a], to = mesh.nodes[b];
        const double inward_x = from.y - to.y, inward_y = to.x - from.x; // -n times length
        if (const int mid = mid_node(mesh, a, b); mid >= 0) {            // integral of N_i N_j, quadratic
            const double p = pressure[a], q = pressure[b], r = pressure[mid];
            const double at_a = (4.0 * p - q + 2.0 * r) / 30.0, at_b = (4.0 * q - p + 2.0 * r) / 30.0,
                         at_mid = (2.0 * p + 2.0 * q + 16.0 * r) / 30.0;
            add(a, at_a * inward_x, at_a * inward_y);
            add(b, at_b * inward_x, at_b * inward_y);
            add(mid, at_mid * inward_x, at_mid * inward_y);
            continue;
        }
        const double at_a = pressure[a] / 3.0 + pressure[b] / 6.0, at_b = pressure[a] / 6.0 + pressure[b] / 3.0;
        add(a, at_a * inward_x, at_a * inward_y);
        add(b, at_b * inward_x, at_b * inward_y);
    }
    return force;
}

namespace {

/// The rock's face of the base joint, rock on the left.
NodeChain rock_face(const Mesh& mesh)
{
    return {mesh.contact.rock_nodes.rbegin(), mesh.contact.rock_nodes.rend()};
}

} // namespace

Eigen::VectorXd water_in_rock(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure, PorePressure form)
{
    if (form == PorePressure::none) return Eigen::VectorXd::Zero(dofs.count);
    if (form == PorePressure::effective)
        return seepage_body_force(mesh, dofs, pressure) - surface_pressure_force(mesh, dofs, rock_face(mesh), pressure);
    return pore_pressure_force(mesh, dofs, pressure) + surface_pressure_force(mesh, dofs, mesh.floor, pressure) +
           surface_pressure_force(mesh, dofs, mesh.ground, pressure);
}

Eigen::VectorXd pore_pressure_loads(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure,
                                    PorePressure form)
{
    assert(mesh.contact.matching);
    // Uplift on the dam: its base runs from heel to toe with the dam on the left.
    Eigen::VectorXd on_dam = pressure;
    for (std::size_t i = 0; i < mesh.contact.dam_nodes.size(); ++i)
        on_dam[mesh.contact.dam_nodes[i]] = pressure[mesh.contact.rock_nodes[i]];
    return surface_pressure_force(mesh, dofs, mesh.contact.dam_nodes, on_dam) +
           surface_pressure_force(mesh, dofs, rock_face(mesh), pressure) + water_in_rock(mesh, dofs, pressure, form);
}

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
