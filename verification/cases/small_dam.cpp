#include "verification/cases/small_dam.hpp"

#include "verification/exact/reference_scene.hpp"

namespace damslip::verification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Scene small_dam_scene(SmallDamBase base)
{
    Scene scene = exact::bare_scene(exact::triangle(30.0, 40.0), 2400.0);
    scene.dam.young_modulus = 2e9;
    scene.dam.poisson_ratio = 0.2;
    scene.contact.friction = 0.7;
    scene.reservoir.emplace();
    scene.reservoir->level = 30.0;
    scene.reservoir->model = ReservoirModel::hydrostatic;
    if (base == SmallDamBase::rock)
        scene.foundation =
            Foundation{.material = {0.0, 4e9, 0.2}, .mass = RockMass::massless, .width = 120.0, .depth = 40.0};
    scene.mesh.size = 8.0;
    scene.mesh.contact_size = 5.0;
    scene.damping.mass_coefficient = 0.0;
    scene.damping.stiffness_coefficient = 4e-3;
    return scene;
}

SmallDam::SmallDam(Scene scene) : scene_(std::move(scene))
{
    fe2d::ModelOptions options;
    options.base = fe2d::Base::separate;
    model_ = fe2d::build_model(scene_, options);
    structure_.emplace(model_);
    load_ = structure_->split(fe2d::load_stages(scene_, model_, {}).last());
    fe2d::StaticContact statics(*structure_);
    memory_ = fe2d::ContactMemory(pairs());
    statics.solve(load_, law(), memory_);
    start_ = statics.displacements(load_, memory_);
}

VectorXd SmallDam::load(const fe2d::GroundAcceleration& ground) const
{
    return joined(load_.dam + ground.h * structure_->inertia_x() - ground.v * structure_->inertia_y(), load_.rock);
}

fe2d::DynamicContact SmallDam::dynamics(const fe2d::Scheme& scheme,
                                        std::shared_ptr<const fe2d::ReducedRock> radiating) const
{
    const fe2d::RunDamping damped{{0.0, damping()}};
    return {std::make_shared<fe2d::StepOperators>(*structure_, damped, scheme, std::move(radiating)), load_, start_,
            memory_};
}

DenseSystem SmallDam::dense() const
{
    const Index d = structure_->dam_unknowns(), m = pairs(), n = start().size();
    MatrixXd mass = MatrixXd::Zero(n, n), stiffness = mass, map = MatrixXd::Zero(2 * m, n);
    mass.topLeftCorner(d, d) = MatrixXd(structure_->mass());
    stiffness.topLeftCorner(d, d) = MatrixXd(structure_->stiffness());
    for (Index k = 0; k < 2 * m; ++k)
        map.col(d - 2 * m + k) = structure_->plane().to_plane(VectorXd(VectorXd::Unit(2 * m, k)));
    if (structure_->has_rock()) {
        stiffness.bottomRightCorner(2 * m, 2 * m) = structure_->rock_stiffness();
        map.rightCols(2 * m) = -MatrixXd::Identity(2 * m, 2 * m);
    }
    return {mass, damping() * stiffness, stiffness, map};
}

VectorXd SmallDam::joined(const VectorXd& dam, const VectorXd& rock) const
{
    VectorXd all(dam.size() + (structure_->has_rock() ? rock.size() : 0));
    all.head(dam.size()) = dam;
    if (structure_->has_rock()) all.tail(rock.size()) = rock;
    return all;
}

} // namespace damslip::verification
