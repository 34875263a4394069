#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/element/elastic.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "fe2d/model/model.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "verification/cases/fe_prescribed.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/elastic_wedge.hpp"
#include "verification/exact/timoshenko_beam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace damslip::verification {

namespace {

namespace quadratic {

using namespace damslip::fe2d;

struct Kind {
    ElementKind kind;
    const char* name;
};
constexpr Kind kinds[] = {{ElementKind::q8, "Q8"}, {ElementKind::q9, "Q9"}, {ElementKind::t6, "T6"}};

constexpr ElasticMaterial stuff{0.0, 1e6, 0.25};

Materials materials_for(ElementKind kind, const ElasticMaterial& material = stuff)
{
    return {.dam = material, .rock = material, .curtain = material, .block = {}, .kind = q4_kind(kind)};
}

Mesh shaped(std::vector<Point> nodes, const std::vector<std::array<int, 4>>& quadrilaterals, ElementKind kind,
            const std::vector<int>& linear_edges = {})
{
    Mesh mesh;
    mesh.nodes = std::move(nodes);
    for (const auto& n : quadrilaterals) mesh.elements.push_back({n, Region::dam});
    mesh.dam_node_count = mesh.node_count();
    mesh.dam_element_count = mesh.element_count();
    mesh.contact.dam_nodes = linear_edges;
    shape_elements(mesh, kind);
    return mesh;
}

/// MacNeal & Harder's five quadrilaterals; `shape` moves the four inner corners.
enum class Inside { distorted, parallelograms };
Mesh patch(ElementKind kind, Inside inside, const std::vector<int>& linear_edges = {})
{
    if (inside == Inside::distorted)
        return shaped(
            {{0, 0}, {0.24, 0}, {0.24, 0.12}, {0, 0.12}, {0.04, 0.02}, {0.18, 0.03}, {0.16, 0.08}, {0.08, 0.08}},
            {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}, kind, linear_edges);
    std::vector<Point> nodes;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) nodes.push_back({0.12 * i + 0.03 * j, 0.06 * j + 0.01 * i});
    return shaped(nodes, {{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}, {4, 5, 8, 7}}, kind, linear_edges);
}

/// Nodes of edges that belong to one element only.
std::vector<int> boundary(const Mesh& mesh)
{
    std::map<std::pair<int, int>, int> count;
    for (const Element& e : mesh.elements)
        for (int i = 0; i < e.size(); ++i)
            ++count[std::minmax(
                {e.nodes[static_cast<std::size_t>(i)], e.nodes[static_cast<std::size_t>((i + 1) % e.size())]})];
    std::vector<int> nodes;
    for (const auto& [edge, elements] : count) {
        if (elements != 1) continue;
        nodes.insert(nodes.end(), {edge.first, edge.second});
        if (const int mid = mid_node(mesh, edge.first, edge.second); mid >= 0) nodes.push_back(mid);
    }
    return nodes;
}

/// u = a x² + b x y + c y² + d x + e y for either component, with the body force that holds it in equilibrium.
struct QuadraticField {
    Eigen::Vector2d a, b, c, d, e;

    Eigen::Vector2d at(Point p) const { return a * p.x * p.x + b * p.x * p.y + c * p.y * p.y + d * p.x + e * p.y; }
    Eigen::Vector3d strain(Point p) const
    {
        const Eigen::Vector2d dx = 2 * p.x * a + p.y * b + d, dy = p.x * b + 2 * p.y * c + e;
        return {dx[0], dy[1], dy[0] + dx[1]};
    }
    Eigen::Vector2d body_force(const Eigen::Matrix3d& m) const
    {
        const Eigen::Vector3d dx(2 * a[0], b[1], b[0] + 2 * a[1]), dy(b[0], 2 * c[1], 2 * c[0] + b[1]); // of the strain
        const Eigen::Vector3d sx = m * dx, sy = m * dy;
        return {-sx[0] - sy[2], -sx[2] - sy[1]};
    }
};
const QuadraticField linear_field{{0, 0}, {0, 0}, {0, 0}, {1e-3, 0.5e-3}, {0.5e-3, 1e-3}};
const QuadraticField full_field{{3e-3, -2e-3}, {5e-3, 4e-3}, {-1e-3, 6e-3}, {1e-3, 0.5e-3}, {0.5e-3, 1e-3}};

struct PatchErrors {
    double displacement = 0.0, stress = 0.0;
};

PatchErrors patch_errors(const Mesh& mesh, ElementKind kind, const QuadraticField& field)
{
    const Materials materials = materials_for(kind);
    const Eigen::Matrix3d d = plane_strain_matrix(stuff);
    const DofMap all = all_dofs(mesh, 2);
    Eigen::VectorXd exact(all.count);
    for (int i = 0; i < mesh.node_count(); ++i)
        exact.segment<2>(2 * i) = field.at(mesh.nodes[static_cast<std::size_t>(i)]);
    const Eigen::VectorXd load = assemble_vector(mesh, all, [&](const Element& e, const Corners& c) {
        return body_force(c, e.size(), field.body_force(d), extra_nodes(e));
    });
    const Eigen::VectorXd u = solve_prescribed(mesh, materials, boundary(mesh), exact, load);
    const StressField stress = stress_field(mesh, all, materials, u);
    PatchErrors errors{.displacement = (u - exact).norm() / exact.norm()};
    double scale = 0.0;
    for (int i = 0; i < mesh.node_count(); ++i) {
        const Eigen::Vector3d s = d * field.strain(mesh.nodes[static_cast<std::size_t>(i)]);
        errors.stress = std::max(errors.stress, (stress.nodal.col(i) - s).cwiseAbs().maxCoeff());
        scale = std::max(scale, s.cwiseAbs().maxCoeff());
    }
    errors.stress /= scale;
    return errors;
}

std::vector<Check> patch_tests()
{
    std::vector<Check> checks;
    const auto exact = [&checks](const std::string& name, const PatchErrors& e) {
        checks.push_back({name + ": displacement error", "–", 1e-12, e.displacement, 0.0, Measure::upper_bound});
        checks.push_back({name + ": nodal stress error", "–", 1e-11, e.stress, 0.0, Measure::upper_bound});
    };
    for (const auto& [kind, name] : kinds) {
        const std::string n = name;
        exact(n + ", linear field, distorted", patch_errors(patch(kind, Inside::distorted), kind, linear_field));
        // The three edges 4-5, 5-6 and 6-7 inside the patch stay linear: transition elements on both sides of them.
        exact(n + ", linear field, transition elements",
              patch_errors(patch(kind, Inside::distorted, {4, 5, 6, 7}), kind, linear_field));
        exact(n + ", quadratic field, parallelograms",
              patch_errors(patch(kind, Inside::parallelograms), kind, full_field));
        if (kind != ElementKind::q8)
            exact(n + ", quadratic field, distorted", patch_errors(patch(kind, Inside::distorted), kind, full_field));
    }
    const PatchErrors q8 = patch_errors(patch(ElementKind::q8, Inside::distorted), ElementKind::q8, full_field);
    checks.push_back({"Q8, quadratic field, distorted: is not exact, displacement error", "–", 1e-5, q8.displacement,
                      0.0, Measure::lower_bound});
    return checks;
}

/// u = U sin(k . x): b = sin(k . x) [(λ + μ)(k . U) k + μ |k|² U].
struct Wave {
    Eigen::Vector2d amplitude{1e-3, 0.6e-3}, k{std::numbers::pi, 0.7 * std::numbers::pi};

    double phase(const Eigen::Vector2d& p) const { return k.dot(p) + 0.3; }
    Eigen::Vector2d at(const Eigen::Vector2d& p) const { return amplitude * std::sin(phase(p)); }
    Eigen::Vector3d strain(const Eigen::Vector2d& p) const
    {
        const double c = std::cos(phase(p));
        return {c * amplitude[0] * k[0], c * amplitude[1] * k[1], c * (amplitude[0] * k[1] + amplitude[1] * k[0])};
    }
    Eigen::Vector2d body_force(const Eigen::Vector2d& p, const ElasticMaterial& m) const
    {
        const double mu = m.young_modulus / (2 * (1 + m.poisson_ratio)),
                     lambda = 2 * mu * m.poisson_ratio / (1 - 2 * m.poisson_ratio);
        return std::sin(phase(p)) * ((lambda + mu) * k.dot(amplitude) * k + mu * k.squaredNorm() * amplitude);
    }
};

/// Places of the shape functions' own quadrature; quadrilaterals by 4 x 4 points, at which no element error vanishes.
std::vector<QuadraticPoint> error_points(const Corners& c, int size, const ExtraNodes& extra)
{
    if (size == 3) return quadratic_points(c, size, extra);
    constexpr double x[4] = {-0.86113631159405258, -0.33998104358485626, 0.33998104358485626, 0.86113631159405258},
                     w[4] = {0.34785484513745386, 0.65214515486254614, 0.65214515486254614, 0.34785484513745386};
    std::vector<QuadraticPoint> points;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            points.push_back(quadratic_point(c, size, extra, x[i], x[j]));
            points.back().weight *= w[i] * w[j];
        }
    return points;
}

struct Norms {
    double displacement = 0.0, energy = 0.0; ///< relative errors in L2 and in the energy norm
};

enum class Cells { squares, trapezoids };

/// Unit square, n x n cells; `trapezoids`: every other row of nodes up and down by half a cell, all cells alike (Arnold,
/// Boffi & Falk 2002, fig. 1).
Norms wave_errors(int n, ElementKind kind, Cells cells)
{
    std::vector<Point> nodes;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double shift = cells == Cells::trapezoids && j % 2 == 1 ? (i % 2 == 0 ? 0.5 : -0.5) : 0.0;
            nodes.push_back({static_cast<double>(i) / n, (j + shift) / n});
        }
    std::vector<std::array<int, 4>> quads;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i;
            quads.push_back({a, a + 1, a + n + 2, a + n + 1});
        }
    const Mesh mesh = shaped(nodes, quads, kind);
    const Materials materials = materials_for(kind);
    const Eigen::Matrix3d d = plane_strain_matrix(stuff);
    const Wave wave;
    const DofMap all = all_dofs(mesh, 2);
    const auto place = [](const Corners& c, int size, const QuadraticPoint& point, const ExtraNodes& extra) {
        Eigen::Vector2d p = Eigen::Vector2d::Zero();
        for (int i = 0; i < size; ++i) { // the corners' share of a linear field, middles at the mean of their corners
            double share = point.shape[i];
            for (int m = 0, at = size; m < size; ++m)
                if (extra.mid[static_cast<std::size_t>(m)]) {
                    if (m == i || (m + 1) % size == i) share += 0.5 * point.shape[at];
                    ++at;
                }
            if (extra.centre) share += 0.25 * point.shape[point.shape.size() - 1];
            p += share * Eigen::Vector2d(c[static_cast<std::size_t>(i)].x, c[static_cast<std::size_t>(i)].y);
        }
        return p;
    };
    const Eigen::VectorXd load = assemble_vector(mesh, all, [&](const Element& e, const Corners& c) {
        const ExtraNodes extra = extra_nodes(e);
        ElementVector f = ElementVector::Zero(2 * (e.size() + extra.count()));
        for (const QuadraticPoint& q : error_points(c, e.size(), extra)) {
            const Eigen::Vector2d b = wave.body_force(place(c, e.size(), q, extra), stuff);
            for (Eigen::Index i = 0; i < q.shape.size(); ++i) f.segment<2>(2 * i) += q.weight * q.shape[i] * b;
        }
        return f;
    });
    Eigen::VectorXd exact(all.count);
    for (int i = 0; i < mesh.node_count(); ++i) {
        const Point p = mesh.nodes[static_cast<std::size_t>(i)];
        exact.segment<2>(2 * i) = wave.at({p.x, p.y});
    }
    const Eigen::VectorXd u = solve_prescribed(mesh, materials, boundary(mesh), exact, load);
    double u2 = 0.0, du2 = 0.0, e2 = 0.0, de2 = 0.0;
    for (const Element& e : mesh.elements) {
        const Corners c = corners(mesh, e);
        const ExtraNodes extra = extra_nodes(e);
        const ElementNodes at = e.all();
        for (const QuadraticPoint& q : error_points(c, e.size(), extra)) {
            const Eigen::Vector2d p = place(c, e.size(), q, extra);
            Eigen::Vector2d uh = Eigen::Vector2d::Zero();
            Eigen::Matrix2d g = Eigen::Matrix2d::Zero(); // du_i/dx_j
            for (int i = 0; i < at.count; ++i) {
                uh += q.shape[i] * u.segment<2>(2 * at[i]);
                g += u.segment<2>(2 * at[i]) * q.gradient.col(i).transpose();
            }
            const Eigen::Vector3d strain = wave.strain(p),
                                  error = strain - Eigen::Vector3d(g(0, 0), g(1, 1), g(0, 1) + g(1, 0));
            u2 += q.weight * wave.at(p).squaredNorm();
            du2 += q.weight * (wave.at(p) - uh).squaredNorm();
            e2 += q.weight * strain.dot(d * strain);
            de2 += q.weight * error.dot(d * error);
        }
    }
    return {std::sqrt(du2 / u2), std::sqrt(de2 / e2)};
}

std::vector<Check> convergence()
{
    std::vector<Check> checks;
    const auto orders = [&checks](const std::string& name, ElementKind kind, Cells cells) {
        const Norms coarse = wave_errors(16, kind, cells), fine = wave_errors(32, kind, cells);
        checks.push_back({name + ": order of the displacement (L2)", "–", 3.0,
                          std::log2(coarse.displacement / fine.displacement), 0.1, Measure::absolute});
        checks.push_back({name + ": order of the energy", "–", 4.0, 2.0 * std::log2(coarse.energy / fine.energy), 0.1,
                          Measure::absolute});
    };
    for (const auto& [kind, name] : kinds) orders(std::string(name) + ", squares", kind, Cells::squares);
    orders("Q9, trapezoids", ElementKind::q9, Cells::trapezoids);
    const Norms coarse = wave_errors(32, ElementKind::q8, Cells::trapezoids),
                fine = wave_errors(64, ElementKind::q8, Cells::trapezoids);
    checks.push_back({"Q8, trapezoids: the order of the displacement falls towards 2", "–", 2.6,
                      std::log2(coarse.displacement / fine.displacement), 0.0, Measure::upper_bound});
    checks.push_back({"Q8, trapezoids: the order of the energy falls towards 2", "–", 3.0,
                      2.0 * std::log2(coarse.energy / fine.energy), 0.0, Measure::upper_bound});
    return checks;
}

/// Cook's trapezoid (fe_core_cases.cpp), n x n elements, consistent shear on the right: v of (48, 52).
double cook(int n, ElementKind kind)
{
    std::vector<Point> nodes;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double s = static_cast<double>(i) / n, t = static_cast<double>(j) / n;
            nodes.push_back({48.0 * s, 44.0 * s + t * (44.0 - 28.0 * s)});
        }
    std::vector<std::array<int, 4>> quads;
    NodeChain left, right;
    for (int j = 0; j <= n; ++j) {
        left.push_back(j * (n + 1));
        right.push_back(j * (n + 1) + n);
        for (int i = 0; i < n && j < n; ++i) {
            const int a = j * (n + 1) + i;
            quads.push_back({a, a + 1, a + n + 2, a + n + 1});
        }
    }
    const Mesh mesh = shaped(nodes, quads, kind);
    const Materials materials = materials_for(kind, plane_stress_equivalent({0.0, 1.0, 1.0 / 3.0}));
    Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * mesh.node_count());
    for (std::size_t j = 0; j + 1 < right.size(); ++j) { // 1/6, 4/6, 1/6 of a constant traction on a quadratic edge
        const int mid = mid_node(mesh, right[j], right[j + 1]);
        for (const int corner : {right[j], right[j + 1]}) load[2 * corner + 1] += (mid < 0 ? 0.5 : 1.0 / 6.0) / n;
        if (mid >= 0) load[2 * mid + 1] += 4.0 / 6.0 / n;
    }
    const Eigen::VectorXd u =
        solve_prescribed(mesh, materials, with_mid_nodes(mesh, left), Eigen::VectorXd::Zero(load.size()), load);
    return u[2 * right[static_cast<std::size_t>(n / 2)] + 1];
}

std::vector<Check> cooks_membrane()
{
    std::vector<Check> checks;
    for (const auto& [kind, name] : kinds) {
        checks.push_back({std::string(name) + ": v of the tip's middle, 4 x 4", "–", 23.96, cook(4, kind), 0.02});
        checks.push_back({std::string(name) + ": v of the tip's middle, 32 x 32", "–", 23.96, cook(32, kind), 1e-3});
    }
    return checks;
}

Scene section(Polyline polygon, const ElasticMaterial& material, double size, ElementKind kind)
{
    Scene scene;
    scene.section.polygon = std::move(polygon);
    scene.dam = {material.density, material.young_modulus, material.poisson_ratio};
    scene.mesh.size = scene.mesh.contact_size = size;
    scene.mesh.element = kind;
    return scene;
}

/// Uniform pressure all around a free dam: u = -p (1 + nu)(1 - 2 nu)/E x, K u = f on every node.
double uniform_pressure_residual(ElementKind kind)
{
    const ElasticMaterial concrete{2500.0, 25e9, 0.17};
    const Scene scene = section({{0, 0}, {45, 0}, {12, 51.5}, {12, 62.5}, {0, 62.5}}, concrete, 3.0, kind);
    const Model model = build_model(scene, {.base = Base::separate});
    const Mesh& mesh = model.mesh;
    const double p = 1e6,
                 shrink = p * (1 + concrete.poisson_ratio) * (1 - 2 * concrete.poisson_ratio) / concrete.young_modulus;
    Eigen::VectorXd u(model.dofs.count), f = uplift_load(mesh, model.dofs, {{{0, p}, {45, p}}}, ContactSide::dam);
    for (const NodeChain* chain : {&mesh.upstream_face, &mesh.downstream_face, &mesh.crest})
        f += pressure_load(mesh, model.dofs, *chain, [p](Point) { return p; });
    for (int i = 0; i < mesh.node_count(); ++i)
        for (const int c : {0, 1}) {
            const Point at = mesh.nodes[static_cast<std::size_t>(i)];
            u[model.dofs(i, c)] = -shrink * (c == 0 ? at.x : at.y);
        }
    return (model.stiffness * u - f).cwiseAbs().maxCoeff() / f.cwiseAbs().maxCoeff();
}

/// L2 error of the wedge's displacement at corners, base row of transition elements included.
double wedge_error(double size, ElementKind kind)
{
    static constexpr exact::ElasticWedge wedge{.height = 62.5,
                                               .base = 45.0,
                                               .young_modulus = 25e9,
                                               .poisson_ratio = 0.17,
                                               .unit_weight = 24525.0,
                                               .water_weight = 9810.0};
    const Mesh mesh = build_mesh(section({{0, 0}, {wedge.base, 0}, {0, wedge.height}},
                                         {2500.0, wedge.young_modulus, wedge.poisson_ratio}, size, kind));
    const Materials materials = materials_for(kind, {2500.0, wedge.young_modulus, wedge.poisson_ratio});
    const DofMap all = all_dofs(mesh, 2);
    const Region dam[] = {Region::dam};
    const Eigen::VectorXd load =
        gravity_load(mesh, all, materials, 9.81, dam) +
        pressure_load(mesh, all, mesh.upstream_face, [](Point p) { return wedge.water_weight * (wedge.height - p.y); });
    Eigen::VectorXd exact(all.count);
    for (int i = 0; i < mesh.node_count(); ++i) {
        const Point p = mesh.nodes[static_cast<std::size_t>(i)];
        const auto d = wedge.displacement(p.x, p.y);
        exact.segment<2>(2 * i) << d.x, d.y;
    }
    const Eigen::VectorXd u = solve_prescribed(mesh, materials, mesh.contact.dam_nodes, exact, load);
    double error = 0.0, scale = 0.0;
    for (const Element& e : mesh.elements) {
        const Corners c = corners(mesh, e);
        double area = 0.0;
        for (int i = 0; i < e.size(); ++i) {
            const Point &a = c[static_cast<std::size_t>(i)], &b = c[static_cast<std::size_t>((i + 1) % e.size())];
            area += 0.5 * (a.x * b.y - b.x * a.y);
        }
        for (int i = 0; i < e.size(); ++i) {
            const int node = e.nodes[static_cast<std::size_t>(i)];
            error += area / e.size() * (u - exact).segment<2>(2 * node).squaredNorm();
            scale += area / e.size() * exact.segment<2>(2 * node).squaredNorm();
        }
    }
    return std::sqrt(error / scale);
}

std::vector<Check> loads_and_transitions()
{
    std::vector<Check> checks;
    for (const auto& [kind, name] : kinds)
        checks.push_back({std::string(name) + ": residual under uniform pressure all around", "–", 1e-11,
                          uniform_pressure_residual(kind), 0.0, Measure::upper_bound});
    const double linear = wedge_error(2.0, ElementKind::q4_incompatible);
    for (const auto& [kind, name] : kinds) {
        const double coarse = wedge_error(4.0, kind), fine = wedge_error(2.0, kind);
        checks.push_back({std::string(name) + " of 2 m: wedge's displacement error over that of Q4", "–", 1.0,
                          fine / linear, 0.0, Measure::upper_bound});
        checks.push_back({std::string(name) + ": order, transition elements at the base", "–", 2.0,
                          std::log2(coarse / fine), 0.0, Measure::lower_bound});
    }
    return checks;
}

std::vector<Check> frequencies()
{
    std::vector<Check> checks;
    const exact::TimoshenkoCantilever beam{.length = 20.0,
                                           .depth = 1.0,
                                           .young_modulus = 30e9 / 0.96,
                                           .shear_modulus = 12.5e9,
                                           .density = 2500.0,
                                           .shear_factor = 6.25 / 7.25}; // as in fe.modes.cantilever
    const std::vector<double> bending = beam.frequencies(3);
    const double published[] = {44.623, 130.03, 162.70, 246.05, 379.90, 391.44};
    for (const auto& [kind, name] : kinds) {
        const NaturalModes modes =
            natural_modes(build_model(section({{0, 0}, {1, 0}, {1, 20}, {0, 20}}, {2500.0, 30e9, 0.2}, 0.25, kind)), 5);
        std::size_t next = 0;
        for (Eigen::Index i = 0; i < modes.frequency.size() && next < bending.size(); ++i)
            if (modes.effective_mass(0, i) > modes.effective_mass(1, i)) {
                checks.push_back({fmt::format("{}: bending mode {}, four elements over the depth", name, next + 1),
                                  "Hz", bending[next], modes.frequency[i], 2e-3});
                ++next;
            }
        const Eigen::VectorXd f =
            natural_modes(build_model(section({{0, 0}, {5, 0}, {3, 10}, {2, 10}},
                                              plane_stress_equivalent({8000.0, 200e9, 0.3}), 0.5, kind)),
                          6)
                .frequency;
        for (int i = 0; i < 6; ++i)
            checks.push_back({fmt::format("{}: FV32 mode {}, ten elements over the base", name, i + 1), "Hz",
                              published[i], f[i], 2e-3});
    }
    return checks;
}

fe2d::RunResult slide(Scene scene, ElementKind kind, double dam_size, double contact_size, double duration = 10.0)
{
    scene.mesh.element = kind;
    scene.mesh.size = dam_size;
    scene.mesh.contact_size = contact_size;
    RunOptions options = fe2d::test::options_of(scene);
    scene.time.substeps = 2;
    options.damping = rayleigh_constants(0.05, 2.0 * std::numbers::pi * 3.6, 2.0 * std::numbers::pi * 15.0);
    return EarthquakeRun(scene, options).run(fe2d::test::sines(1.0, duration));
}

std::vector<Check> sliding_dam()
{
    const Scene scene = fe2d::test::sliding_dam(0.70);
    const double coarse = slide(scene, ElementKind::q4_incompatible, 8.0, 5.0).slip,
                 middle = slide(scene, ElementKind::q4_incompatible, 4.0, 2.5).slip,
                 fine = slide(scene, ElementKind::q4_incompatible, 2.0, 1.25).slip;
    const double limit = fine + (fine - middle); // first order: singular heel and toe
    const double open = std::abs(coarse - limit);
    std::vector<Check> checks;
    for (const auto& [kind, name] : kinds) {
        const fe2d::RunResult result = slide(scene, kind, 8.0, 5.0);
        checks.push_back({std::string(name) + " on 5 m: error of the slip over that of Q4 on 5 m", "–", 1.0,
                          std::abs(result.slip - limit) / open, 0.0, Measure::upper_bound});
        checks.push_back(
            {std::string(name) + ": energy left open", "–", 1e-9, result.energy_error, 0.0, Measure::upper_bound});
    }
    return checks;
}

std::vector<Check> rigid_limit()
{
    const Scene scene = fe2d::test::sliding_dam(0.70, 1e4);
    Scene block = scene;
    block.contact.friction = 0.70;
    const double rigid = sliding::slide(fe2d::test::sines(1.0, 10.0), sliding::make_rigid_block(block)).slip;
    std::vector<Check> checks;
    for (const auto& [kind, name] : kinds)
        checks.push_back({std::string(name) + ", E x 1e4: slip", "m", rigid, slide(scene, kind, 8.0, 5.0).slip, 0.01});
    return checks;
}

} // namespace quadratic

} // namespace

void add_fe_quadratic_cases(Registry& registry)
{
    registry.push_back({"fe.quadratic.patch-test",
                        "Q8, Q9, T6 and transition elements hold what they must on distorted meshes.",
                        "Irons' patch test on MacNeal & Harder's patch (1985); quadratic displacement under the body "
                        "force that balances it: Lee & Bathe (1993), Int. J. Numer. Meth. Engng 36, 3553-3576",
                        "Round-off. Q8 holds quadratic fields on parallelograms only: on the distorted patch its error "
                        "must be seen.",
                        quadratic::patch_tests});
    registry.push_back(
        {"fe.quadratic.convergence",
         "Smooth displacements converge with third order, their energy with fourth; Q8 loses it on trapezoids.",
         "plane wave u = U sin(k x), manufactured body force; Arnold, Boffi & Falk (2002), Math. Comp. 71, 909-922, "
         "for "
         "the trapezoids",
         "3 +- 0.1 and 4 +- 0.1 from 16 and 32 elements a side; Q8 on trapezoids tends to 2 and 2: bounds from 32 and "
         "64.",
         quadratic::convergence});
    registry.push_back({"fe.quadratic.cooks-membrane", "Cook's tapered panel with quadratic elements.",
                        "Cook (1974); converged value 23.96",
                        "0.1 % on 32 x 32, as the reference has four digits; 2 % on 4 x 4, where Q4 locks by 24 %.",
                        quadratic::cooks_membrane});
    registry.push_back(
        {"fe.quadratic.loads-and-transitions",
         "Pressures on quadratic faces and on the linear base are consistent; with its transition elements at the base "
         "Levy's wedge is no worse than on Q4.",
         "uniform stress -p under uniform pressure; Levy's wedge (1898), whose displacement is quadratic",
         "Round-off of K u - f. Wedge: what is left is the interpolation along the linear edges of the base, second "
         "order, no larger than the error of Q4 with incompatible modes of the same size.",
         quadratic::loads_and_transitions});
    registry.push_back({"fe.quadratic.frequencies", "Bending frequencies of a wall and NAFEMS FV32.",
                        "Timoshenko beam; NAFEMS Selected Benchmarks for Natural Frequency Analysis (1987), FV32",
                        "0.2 %: the clamped end of the wall holds its width, which the beam does not know; FV32 is "
                        "published to five digits, 0.2 % on ten elements over the base.",
                        quadratic::frequencies});
    registry.push_back(
        {"fe.quadratic.sliding-dam",
         "The sliding reference dam on coarse quadratic elements against finer and finer Q4.",
         "the same model on Q4 of 5, 2.5 and 1.25 m on the base, extrapolated with first order",
         "No further off than Q4 of the same size (measured 0.4 of it); the energy identity holds to round-off.",
         quadratic::sliding_dam});
    registry.push_back({"fe.quadratic.rigid-limit", "Slip with moduli times 1e4 on quadratic elements.",
                        "event-located rigid block, Newmark (1965)", "1 % for the step of 0.0025 s.",
                        quadratic::rigid_limit});
}

} // namespace damslip::verification
