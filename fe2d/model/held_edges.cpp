#include "fe2d/model/held_edges.hpp"

namespace damslip::fe2d {

HeldStart held_edges(const Model& fixed, const Model& free, const Eigen::VectorXd& displacement,
                     const Eigen::VectorXd& load)
{
    const Eigen::Index n = free.dofs.count;
    HeldStart start{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
    for (std::size_t i = 0; i < free.dofs.dofs.size(); ++i) {
        const int from = fixed.dofs.dofs[i], to = free.dofs.dofs[i];
        if (from == no_dof || to == no_dof) continue;
        start.displacement[to] = displacement[from];
        start.load[to] = load[from];
    }
    const Eigen::VectorXd internal = free.stiffness * start.displacement;
    for (std::size_t i = 0; i < free.dofs.dofs.size(); ++i)
        if (const int to = free.dofs.dofs[i]; to != no_dof && fixed.dofs.dofs[i] == no_dof)
            start.load[to] = internal[to];
    return start;
}

Eigen::VectorXd without_edges(const Model& fixed, const Model& free, const Eigen::VectorXd& displacement)
{
    Eigen::VectorXd result = Eigen::VectorXd::Zero(fixed.dofs.count);
    for (std::size_t i = 0; i < fixed.dofs.dofs.size(); ++i)
        if (const int to = fixed.dofs.dofs[i]; to != no_dof) result[to] = displacement[free.dofs.dofs[i]];
    return result;
}

} // namespace damslip::fe2d
