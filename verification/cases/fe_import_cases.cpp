// Imported meshes: what a mesh generator delivers, read from the text of a Gmsh file, against exact solutions and against the
// program's own mesh.
#include "fe2d/assembly/assemble.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/gmsh/gmsh.hpp"
#include "fe2d/mesh/import_mesh.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "scene/section.hpp"
#include "verification/cases/mixed_mesh.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/reference_scene.hpp"

#include <cmath>
#include <set>

namespace damslip::verification {

namespace {

using namespace fe2d;

Scene dam_on_rock(double size)
{
    Scene scene = exact::elastic_reference_scene();
    scene.file = "dam.toml";
    scene.curtain.reset();
    scene.reservoir->model = ReservoirModel::hydrostatic;
    scene.mesh.size = scene.mesh.contact_size = size;
    return scene;
}

Mesh imported(const GmshFile& file, const Scene& scene, GmshVersion version)
{
    return import_mesh(parse_gmsh(gmsh_text(file, version), "mixed.msh"), scene).mesh;
}

Mesh mixed(const Scene& scene, GmshVersion version)
{
    return imported(mixed_mesh(export_mesh(build_mesh(scene), BaseNodes::shared)), scene, version);
}

/// Displacements of every node where those of the outline are given: no loads, base tied.
Eigen::VectorXd with_given_outline(const Mesh& mesh, const Materials& materials, const Eigen::VectorXd& given)
{
    std::vector<int> partner(mesh.nodes.size(), -1);
    for (std::size_t i = 0; i < mesh.contact.rock_nodes.size(); ++i)
        partner[mesh.contact.rock_nodes[i]] = mesh.contact.dam_nodes[i];
    DofMap dofs{.components = 2, .count = 0, .dofs = std::vector<int>(2 * mesh.nodes.size(), no_dof)};
    for (int n = 0; n < mesh.node_count(); ++n)
        for (const int c : {0, 1}) dofs.dofs[2 * n + c] = partner[n] < 0 ? dofs.count++ : dofs.dofs[2 * partner[n] + c];
    std::set<int> held;
    for (const NodeChain* chain : {&mesh.upstream_face, &mesh.crest, &mesh.downstream_face, &mesh.floor, &mesh.box_left,
                                   &mesh.box_bottom, &mesh.box_right, &mesh.ground})
        for (const int n : *chain)
            for (const int c : {0, 1}) held.insert(dofs(n, c));
    Eigen::VectorXd u = Eigen::VectorXd::Zero(dofs.count);
    for (int n = 0; n < mesh.node_count(); ++n)
        for (const int c : {0, 1})
            if (held.contains(dofs(n, c))) u[dofs(n, c)] = given[2 * n + c];
    std::vector<int> free;
    for (int d = 0; d < dofs.count; ++d)
        if (!held.contains(d)) free.push_back(d);
    const Eigen::MatrixXd stiffness(stiffness_matrix(mesh, dofs, materials));
    const Eigen::VectorXd right = -(stiffness * u)(free);
    const Eigen::MatrixXd inner = stiffness(free, free);
    const Eigen::VectorXd solved = inner.llt().solve(right);
    u(free) = solved;
    return nodal_values(dofs, u);
}

std::vector<Check> imported_patch()
{
    const Scene scene = dam_on_rock(7.5);
    const ElasticMaterial material{0.0, 1e6, 0.25};
    const Eigen::Vector3d strain(1e-3, 1e-3, 1e-3), stress = plane_strain_matrix(material) * strain;
    std::vector<Check> checks;
    for (const auto& [kind, name] :
         {std::pair{ElementKind::q4_incompatible, "Q4 incompatible"}, {ElementKind::q4, "Q4"}}) {
        const Mesh mesh = mixed(scene, GmshVersion::v4_1);
        const Materials materials{.dam = material, .rock = material, .curtain = material, .block = {}, .kind = q4_kind(kind)};
        Eigen::VectorXd exact(2 * mesh.node_count());
        for (int i = 0; i < mesh.node_count(); ++i) {
            const Point p = mesh.nodes[i];
            exact.segment<2>(2 * i) << 1e-3 * (p.x + p.y / 2), 1e-3 * (p.y + p.x / 2);
        }
        const Eigen::VectorXd u = with_given_outline(mesh, materials, exact);
        const StressField field = stress_field(mesh, all_dofs(mesh, 2), materials, u);
        checks.push_back({std::string(name) + " and T3: displacement error", "–", 1e-13,
                          (u - exact).norm() / exact.norm(), 0.0, Measure::upper_bound});
        checks.push_back({std::string(name) + " and T3: nodal stress error", "–", 1e-12,
                          (field.nodal.colwise() - stress).cwiseAbs().maxCoeff() / stress.maxCoeff(), 0.0,
                          Measure::upper_bound});
    }
    return checks;
}

std::vector<Check> imported_loads()
{
    const Scene scene = dam_on_rock(4.0);
    const Model model = build_model_on(mixed(scene, GmshVersion::v2_2), scene);
    const StaticLoads loads = static_loads(scene, model);
    const double water = 0.5 * 1000.0 * scene.gravity * 62.5 * 62.5,
                 weight = 2500.0 * scene.gravity * area(scene.section);
    return {{"weight of the dam", "N/m", -weight, loads.gravity.front().resultant.y(), 1e-13},
            {"water on the upstream face", "N/m", water, loads.impounding.front().resultant.x(), 1e-13}};
}

double frequency_of_mesh(const Mesh& mesh, const Scene& scene)
{
    const NaturalModes modes = natural_modes(build_model_on(mesh, scene), 1);
    return modes.status == ModesStatus::ok ? modes.frequency[0] : std::nan("");
}

std::vector<Check> imported_frequency()
{
    const Scene four = dam_on_rock(4.0), two = dam_on_rock(2.0), one = dam_on_rock(1.0);
    const double reference = frequency_of_mesh(build_mesh(one), one);
    const auto error = [&](const Mesh& mesh, const Scene& scene) {
        return std::abs(frequency_of_mesh(mesh, scene) / reference - 1.0);
    };
    const double own = error(build_mesh(four), four), coarse = error(mixed(four, GmshVersion::v4_1), four),
                 fine = error(mixed(two, GmshVersion::v4_1), two);
    return {
        {"error of f_1, 4 m elements of all shapes, over that of the program's own 4 m mesh", "–", 3.0, coarse / own,
         0.0, Measure::upper_bound},
        {"the same error over that of 2 m elements of all shapes", "–", 3.0, coarse / fine, 0.0, Measure::lower_bound}};
}

} // namespace

void add_fe_import_cases(Registry& registry)
{
    registry.push_back(
        {"fe.mesh.imported-patch",
         "An imported mesh of dam and rock, triangles among quadrilaterals of any turn and number, carries a constant "
         "strain.",
         "Irons' patch test: linear displacement on the outline of dam and rock of one material, linear "
         "displacement and constant stress inside, through the joined base",
         "Round-off: condition number about 1e3, 1e-13; stresses are differences over an element, a tenth of the body.",
         imported_patch});
    registry.push_back({"fe.mesh.imported-loads",
                        "Weight and water on an imported dam act on its whole section and face.",
                        "weight rho g A of the polygon, water rho g h^2 / 2",
                        "Round-off: the nodes of the outline lie on the polygon.", imported_loads});
    registry.push_back({"fe.mesh.imported-frequency",
                        "The first frequency of an imported irregular mesh approaches that of the dam with order 2.",
                        "the program's own mesh of 1 m",
                        "The error of the program's own mesh is the measure of what elements of that size leave open; "
                        "a third of the area in "
                        "constant-strain triangles, which bend stiffly, makes it larger. Order 2 is a quarter with "
                        "half the size, and 3 "
                        "leaves room for the error of the reference, a sixteenth of the own mesh's.",
                        imported_frequency});
}

} // namespace damslip::verification
