#include "fe2d/element/elastic.hpp"
#include "fe2d/model/model.hpp"
#include "verification/cases/fe_prescribed.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/elastic_wedge.hpp"
#include "verification/exact/timoshenko_beam.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::verification {

namespace {

using namespace damslip::fe2d;
using exact::ElasticWedge;
using exact::TimoshenkoCantilever;

/// MacNeal & Harder's five distorted quadrilaterals; as ten triangles where asked for.
Mesh patch(ElementKind kind)
{
    Mesh mesh;
    mesh.nodes = {{0, 0}, {0.24, 0}, {0.24, 0.12}, {0, 0.12}, {0.04, 0.02}, {0.18, 0.03}, {0.16, 0.08}, {0.08, 0.08}};
    for (const auto& n : {std::array{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}) {
        if (kind == ElementKind::t3) {
            mesh.elements.push_back({{n[0], n[1], n[2], -1}, Region::dam});
            mesh.elements.push_back({{n[0], n[2], n[3], -1}, Region::dam});
        } else {
            mesh.elements.push_back({n, Region::dam});
        }
    }
    return mesh;
}

std::vector<Check> patch_test()
{
    std::vector<Check> checks;
    const ElasticMaterial material{0.0, 1e6, 0.25};
    const Eigen::Vector3d stress = plane_strain_matrix(material) * Eigen::Vector3d(1e-3, 1e-3, 1e-3);
    for (const auto& [kind, name] : {std::pair{ElementKind::q4_incompatible, "Q4 incompatible"},
                                     {ElementKind::q4, "Q4"},
                                     {ElementKind::t3, "T3"}}) {
        const Mesh mesh = patch(kind);
        const Materials materials{.dam = material, .rock = material, .curtain = material, .block = {}, .kind = q4_kind(kind)};
        Eigen::VectorXd exact(16);
        for (int i = 0; i < 8; ++i) {
            const Point p = mesh.nodes[static_cast<std::size_t>(i)];
            exact.segment<2>(2 * i) << 1e-3 * (p.x + p.y / 2), 1e-3 * (p.y + p.x / 2);
        }
        const Eigen::VectorXd u = solve_prescribed(mesh, materials, {0, 1, 2, 3}, exact, Eigen::VectorXd::Zero(16));
        const StressField field = stress_field(mesh, all_dofs(mesh, 2), materials, u);
        checks.push_back({std::string(name) + ": displacement error", "–", 1e-13, (u - exact).norm() / exact.norm(),
                          0.0, Measure::upper_bound});
        checks.push_back({std::string(name) + ": nodal stress error", "–", 1e-13,
                          (field.nodal.colwise() - stress).cwiseAbs().maxCoeff() / stress.maxCoeff(), 0.0,
                          Measure::upper_bound});
    }
    return checks;
}

struct WedgeErrors {
    double displacement = 0.0, centre_stress = 0.0, nodal_stress = 0.0; ///< root mean square over the exact one's
};

constexpr ElasticWedge wedge{.height = 62.5,
                             .base = 45.0,
                             .young_modulus = 25e9,
                             .poisson_ratio = 0.17,
                             .unit_weight = 24525.0,
                             .water_weight = 9810.0};

WedgeErrors wedge_errors(double size, ElementKind kind)
{
    Scene scene;
    scene.section.polygon = {{0, 0}, {wedge.base, 0}, {0, wedge.height}};
    scene.dam = {2500.0, wedge.young_modulus, wedge.poisson_ratio};
    scene.mesh.size = scene.mesh.contact_size = size;
    scene.mesh.element = kind;
    const Mesh mesh = build_mesh(scene);
    const Materials materials = materials_of(scene);
    const DofMap all = all_dofs(mesh, 2);
    const Region dam[] = {Region::dam};
    const Eigen::VectorXd load =
        gravity_load(mesh, all, materials, 9.81, dam) +
        pressure_load(mesh, all, mesh.upstream_face, [](Point p) { return wedge.water_weight * (wedge.height - p.y); });
    Eigen::VectorXd exact(all.count);
    for (int i = 0; i < mesh.node_count(); ++i) {
        const auto d =
            wedge.displacement(mesh.nodes[static_cast<std::size_t>(i)].x, mesh.nodes[static_cast<std::size_t>(i)].y);
        exact.segment<2>(2 * i) << d.x, d.y;
    }
    const Eigen::VectorXd u = solve_prescribed(mesh, materials, mesh.contact.dam_nodes, exact, load);
    const StressField field = stress_field(mesh, all, materials, u);
    const auto exact_stress = [](Point p) {
        const auto s = wedge.stress(p.x, p.y);
        return Eigen::Vector3d(s.xx, s.yy, s.xy);
    };
    // Sums weighted with the area, so that graded and joined elements count as they should.
    double centre = 0.0, nodal = 0.0, displacement = 0.0, stress_scale = 0.0, displacement_scale = 0.0;
    for (int e = 0; e < mesh.element_count(); ++e) {
        const Element& element = mesh.elements[static_cast<std::size_t>(e)];
        const Corners c = corners(mesh, element);
        const double area = scalar_mass_matrix(c, element.size(), 1.0).sum();
        Point middle;
        for (int i = 0; i < element.size(); ++i) {
            middle.x += c[static_cast<std::size_t>(i)].x / element.size();
            middle.y += c[static_cast<std::size_t>(i)].y / element.size();
            const int node = element.nodes[static_cast<std::size_t>(i)];
            nodal += area / element.size() *
                     (field.nodal.col(node) - exact_stress(c[static_cast<std::size_t>(i)])).squaredNorm();
            displacement += area / element.size() * (u - exact).segment<2>(2 * node).squaredNorm();
            displacement_scale += area / element.size() * exact.segment<2>(2 * node).squaredNorm();
        }
        centre += area * (field.centre.col(e) - exact_stress(middle)).squaredNorm();
        stress_scale += area * exact_stress(middle).squaredNorm();
    }
    return {std::sqrt(displacement / displacement_scale), std::sqrt(centre / stress_scale),
            std::sqrt(nodal / stress_scale)};
}

std::vector<Check> levy_wedge()
{
    std::vector<Check> checks;
    for (const auto& [kind, name] : {std::pair{ElementKind::q4_incompatible, "Q4 incompatible"},
                                     {ElementKind::q4, "Q4"},
                                     {ElementKind::t3, "T3"}}) {
        const WedgeErrors coarse = wedge_errors(2.0, kind), fine = wedge_errors(1.0, kind);
        const std::string n = name;
        checks.push_back({n + ": order of the displacement", "–", 2.0,
                          std::log2(coarse.displacement / fine.displacement), 0.2, Measure::absolute});
        checks.push_back({n + ": order of the stress at centres", "–", 0.9,
                          std::log2(coarse.centre_stress / fine.centre_stress), 0.0, Measure::lower_bound});
        checks.push_back({n + ": order of the nodal stress", "–", 0.9,
                          std::log2(coarse.nodal_stress / fine.nodal_stress), 0.0, Measure::lower_bound});
        // Interpolating the quadratic field linearly leaves about (h/H)^2 per unit of curvature, h/H = 0.016; the
        // incompatible modes carry most of the curvature themselves. The stress of one element is constant or nearly
        // so: h/H.
        const double h = 1.0 / wedge.height;
        const double displacement_limit = (kind == ElementKind::q4_incompatible ? 2.0 : 10.0) * h * h;
        checks.push_back(
            {n + ": displacement error", "–", displacement_limit, fine.displacement, 0.0, Measure::upper_bound});
        checks.push_back({n + ": stress error at centres", "–", h, fine.centre_stress, 0.0, Measure::upper_bound});
        checks.push_back({n + ": nodal stress error", "–", h, fine.nodal_stress, 0.0, Measure::upper_bound});
    }
    return checks;
}

Scene wall(double width, double height, double size, ElementKind kind, const ElasticMaterial& material)
{
    Scene scene;
    scene.section.polygon = {{0, 0}, {width, 0}, {width, height}, {0, height}};
    scene.dam = {material.density, material.young_modulus, material.poisson_ratio};
    scene.mesh.size = scene.mesh.contact_size = size;
    scene.mesh.element = kind;
    return scene;
}

std::vector<Check> cantilever_deflection()
{
    const ElasticMaterial material{2500.0, 30e9, 0.2};
    const TimoshenkoCantilever beam{
        .length = 20.0, .depth = 1.0, .young_modulus = 30e9 / (1 - 0.04), .shear_modulus = 12.5e9, .density = 2500.0};
    const auto tip = [&](double size, ElementKind kind) {
        Scene scene = wall(1.0, 20.0, size, kind, material);
        for (const double x : {0.0, 0.25, 0.5, 0.75}) scene.forces.push_back({"tip", {x + 0.125, 20.0}, 250.0, 0.0});
        const Model model = build_model(scene);
        const Eigen::VectorXd u =
            solve_static(scene, model, {.rock = {}, .gravity = {}, .impounding = static_loads(scene, model).impounding})
                .stages.back()
                .elastic;
        double mean = 0.0;
        for (const int node : model.mesh.crest)
            mean += u[model.dofs(node, 0)] / static_cast<double>(model.mesh.crest.size());
        return mean;
    };
    const double exact = beam.tip_deflection(1000.0);
    return {{"tip deflection, four Q4 incompatible over the depth", "m", exact, tip(0.25, ElementKind::q4_incompatible),
             2e-3},
            {"tip deflection, one Q4 incompatible over the depth", "m", exact, tip(1.0, ElementKind::q4_incompatible),
             5e-3},
            {"share one plain Q4 over the depth reaches (locking)", "–", 0.72, tip(1.0, ElementKind::q4) / exact, 0.0,
             Measure::upper_bound}};
}

/// Cook's trapezoid (0,0) (48,44) (48,60) (0,44), n x n elements, left side clamped, unit shear on the right: v of (48,
/// 52) or (48, 60).
double cook(int n, ElementKind kind, double at)
{
    Mesh mesh;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double s = static_cast<double>(i) / n, t = static_cast<double>(j) / n;
            mesh.nodes.push_back({48.0 * s, 44.0 * s + t * (44.0 - 28.0 * s)});
        }
    const auto node = [n](int i, int j) { return j * (n + 1) + i; };
    std::vector<int> left;
    for (int j = 0; j <= n; ++j) left.push_back(node(0, j));
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            mesh.elements.push_back({{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)}, Region::dam});
    Materials materials;
    materials.dam = materials.rock = materials.curtain = plane_stress_equivalent({0.0, 1.0, 1.0 / 3.0});
    materials.kind = q4_kind(kind);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * (n + 1) * (n + 1));
    for (int j = 0; j <= n; ++j) load[2 * node(n, j) + 1] = (j == 0 || j == n ? 0.5 : 1.0) / n;
    const Eigen::VectorXd u = solve_prescribed(mesh, materials, left, Eigen::VectorXd::Zero(load.size()), load);
    return u[2 * node(n, static_cast<int>(std::lround(at * n))) + 1];
}

std::vector<Check> cooks_membrane()
{
    return {
        {"v of the tip's middle, 64 x 64 Q4 incompatible", "–", 23.96, cook(64, ElementKind::q4_incompatible, 0.5),
         1e-3},
        {"v of the tip's middle, 4 x 4 Q4 incompatible", "–", 23.96, cook(4, ElementKind::q4_incompatible, 0.5), 0.05},
        {"v of the tip's middle, 4 x 4 plain Q4 (locks)", "–", 19.0, cook(4, ElementKind::q4, 0.5), 0.0,
         Measure::upper_bound}};
}

} // namespace

void add_fe_core_cases(Registry& registry)
{
    registry.push_back({"fe.element.patch-test", "A constant strain state is reproduced on distorted elements.",
                        "Irons' patch test on the mesh of MacNeal & Harder, Finite Elements in Analysis and Design 1 "
                        "(1985) 3-20: linear displacements around "
                        "the patch, linear displacement and constant stress inside",
                        "Round-off: condition number about 30, 1e-13 leaves two digits.", patch_test});
    registry.push_back(
        {"fe.static.levy-wedge",
         "Triangular dam under its weight and a full reservoir: displacements of second order, stresses converge.",
         "Levy (1898); Timoshenko & Goodier, Theory of Elasticity, art. 45; stresses linear, exact displacement on the "
         "base, exact tractions on "
         "the faces",
         "Orders from elements of 2 m and 1 m. Displacement 2 +- 0.2; stress: first order is the element's own, more "
         "is superconvergence; measured "
         "1.6 at centres of quadrilaterals. Errors at 1 m against (h/H)^2 and h/H.",
         levy_wedge});
    registry.push_back({"fe.static.cantilever", "Slender wall under a tip force.",
                        "Timoshenko beam, P L^3/(3EI) + P L/(kappa G A) with E/(1 - nu^2), kappa = 5/6; L/h = 20",
                        "The clamped end holds the section's width, which the beam does not know: the wall is stiffer "
                        "by 0.1 % (converged), a share of (h/L)^2 = "
                        "0.25 %. Limits 0.2 %, and 0.5 % with one element over the depth.",
                        cantilever_deflection});
    registry.push_back(
        {"fe.static.cooks-membrane", "Tapered skew panel in bending and shear, plane stress mapped to plane strain.",
         "Cook, J. Struct. Div. ASCE 100 (1974) 1851-1863; converged value 23.96 (E = 1, nu = 1/3, unit shear)",
         "The reference has four digits: 0.1 % on 64 x 64. On 4 x 4 published incompatible-mode results are within 5 "
         "%, plain Q4 at 18.3.",
         cooks_membrane});
}

} // namespace damslip::verification
