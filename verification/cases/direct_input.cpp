#include "verification/cases/direct_input.hpp"

#include <cmath>

namespace damslip::verification {

DirectInput::DirectInput(const fe2d::Model& model, const exact::SurfacePulse& horizontal,
                         const exact::SurfacePulse& vertical)
    : model_(model), waves_(fe2d::elastic_waves(model.materials.rock))
{
    const fe2d::ElasticMaterial& rock = model.materials.rock;
    density_ = rock.density;
    shear_modulus_ = density_ * waves_.s * waves_.s;
    lame_ = density_ * waves_.p * waves_.p - 2.0 * shear_modulus_;
    horizontal_ = {horizontal, waves_.s};
    vertical_ = {vertical, waves_.p};
}

void DirectInput::add(const fe2d::NodeChain& chain, double normal_x, double normal_y, double time,
                      Eigen::VectorXd& load) const
{
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const Point a = model_.mesh.nodes[static_cast<std::size_t>(chain[i])],
                    b = model_.mesh.nodes[static_cast<std::size_t>(chain[i + 1])];
        const double half = 0.5 * std::hypot(b.x - a.x, b.y - a.y), middle = 0.5 * (a.y + b.y);
        const double shear = shear_modulus_ * horizontal_.gradient(middle, time),
                     strain = vertical_.gradient(middle, time), across = lame_ * strain,
                     along = (lame_ + 2.0 * shear_modulus_) * strain;
        const double c_x = normal_x != 0.0 ? waves_.p : waves_.s, c_y = normal_x != 0.0 ? waves_.s : waves_.p;
        for (const int node : {chain[i], chain[i + 1]}) {
            const double y = model_.mesh.nodes[static_cast<std::size_t>(node)].y;
            const double x_force =
                density_ * c_x * horizontal_.velocity(y, time) + across * normal_x + shear * normal_y;
            const double y_force = density_ * c_y * vertical_.velocity(y, time) + shear * normal_x + along * normal_y;
            load[model_.dofs(node, 0)] += half * x_force;
            load[model_.dofs(node, 1)] += half * y_force;
        }
    }
}

Eigen::VectorXd DirectInput::load(double time) const
{
    Eigen::VectorXd load = Eigen::VectorXd::Zero(model_.dofs.count);
    add(model_.mesh.box_left, -1.0, 0.0, time, load);
    add(model_.mesh.box_right, 1.0, 0.0, time, load);
    add(model_.mesh.box_bottom, 0.0, -1.0, time, load);
    return load;
}

RockAlone::RockAlone(const fe2d::Model& model) : first(fe2d::dam_dof_count(model.mesh, model.dofs))
{
    const Eigen::Index n = model.dofs.count - first;
    const auto corner = [&](const fe2d::SparseMatrix& matrix) {
        return fe2d::SparseMatrix(matrix.bottomRightCorner(n, n));
    };
    system = {corner(model.mass), corner(model.edge_damping), corner(model.stiffness), {}};
}

} // namespace damslip::verification
