#include "fe2d/statics/static_solution.hpp"

namespace damslip::fe2d {

namespace {

Eigen::Vector2d resultant_of(const std::vector<StaticLoad>& loads)
{
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const StaticLoad& load : loads) sum += load.resultant;
    return sum;
}

} // namespace

StaticSolution solve_static(const Scene& scene, const Model& model, const StaticLoads& loads,
                            const SolverOptions& options)
{
    LinearSolver solver(options);
    StaticSolution solution{.solver = solver.factorise(model.stiffness), .stages = {}};
    if (!solution.solver.ok()) return solution;

    const int n = model.dofs.count;
    Eigen::VectorXd elastic = Eigen::VectorXd::Zero(n), reference = Eigen::VectorXd::Zero(n);
    Eigen::Vector2d resultant = Eigen::Vector2d::Zero();
    const auto stage = [&](const char* name, const std::vector<StaticLoad>& list) {
        if (list.empty()) return;
        elastic += solver.solve(sum_of(list, n));
        resultant += resultant_of(list);
        solution.stages.push_back({name, resultant, elastic - reference, elastic});
    };
    stage("gravity", loads.gravity);
    if (scene.stages.geostatic) {
        reference = elastic;
        if (!solution.stages.empty()) solution.stages.back().displacement.setZero();
    }
    stage("impounding", loads.impounding);
    return solution;
}

Eigen::Matrix2Xd base_forces(const Model& model, const Eigen::VectorXd& displacement, const Eigen::VectorXd& dam_load)
{
    const DofMap all = all_dofs(model.mesh, 2);
    const Eigen::VectorXd u = nodal_values(model.dofs, displacement);
    const Eigen::VectorXd internal =
        assemble_vector(model.mesh, all, [&](const Element& element, const Corners& c) -> ElementVector {
            if (element.region != Region::dam) return {};
            const ElementNodes nodes = element.all();
            ElementVector ue(2 * nodes.count);
            for (int i = 0; i < nodes.count; ++i) ue.segment<2>(2 * i) = u.segment<2>(2 * nodes[i]);
            return elastic_stiffness(c, element.size(), plane_strain_matrix(model.materials.dam), model.materials.kind,
                                     extra_nodes(element)) *
                   ue;
        });
    const std::vector<int>& nodes = model.mesh.contact.dam_nodes;
    Eigen::Matrix2Xd forces(2, static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i)
        forces.col(static_cast<Eigen::Index>(i)) =
            internal.segment<2>(2 * nodes[i]) - dam_load.segment<2>(2 * nodes[i]);
    return forces;
}

} // namespace damslip::fe2d
