#include "fe2d/run/water_ledger.hpp"

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

WaterLedger::WaterLedger(const WaterBody& body, const NodeOrder& order) : body_(body), mesh_(body.water.mesh_unknowns)
{
    const FluidModel& water = body.water;
    const double s = body.scale, s2 = s * s;
    const auto moved = [&](Index old) { return 2 * order.new_node[static_cast<std::size_t>(old / 2)] + old % 2; };
    for (const Index old : body.place) place_.push_back(moved(old));
    std::vector<Eigen::Triplet<double>> entries;
    for (Index column = 0; column < mesh_; ++column)
        for (SparseMatrix::InnerIterator it(body.coupling, column); it; ++it)
            entries.emplace_back(column, moved(it.row()), s * it.value());
    coupling_.resize(mesh_, body.size);
    coupling_.setFromTriplets(entries.begin(), entries.end());
    mass_ = s2 * SparseMatrix(water.body_mass.topLeftCorner(mesh_, mesh_));
    stiffness_ = s2 * SparseMatrix(water.body_stiffness.topLeftCorner(mesh_, mesh_));
    end_mass_ = s2 * SparseMatrix((water.mass - water.body_mass).topRows(mesh_));
    damping_ = s2 * SparseMatrix(water.damping.topRows(mesh_));
    end_stiffness_ = s2 * SparseMatrix((water.stiffness - water.body_stiffness).topRows(mesh_));
    const auto turned = [&](const VectorXd& load) {
        VectorXd result(mesh_);
        for (Index i = 0; i < mesh_; ++i) result[i] = -load[body.place[static_cast<std::size_t>(i)]];
        return result;
    };
    velocity_x_ = turned(body.velocity_x);
    velocity_y_ = turned(body.velocity_y);
    displacement_y_ = turned(body.displacement_y);
}

VectorXd WaterLedger::water_of(const VectorXd& vector) const
{
    VectorXd result(static_cast<Index>(place_.size()));
    for (std::size_t i = 0; i < place_.size(); ++i) result[static_cast<Index>(i)] = vector[place_[i]];
    return result;
}

WaterLedger::Instant WaterLedger::instant(const VectorXd& z, const VectorXd& v, const VectorXd& a, double velocity_h,
                                          double velocity_v, double displacement_v) const
{
    Instant now{z, v, a, {}, {}, {}};
    now.load = -velocity_h * velocity_x_ + velocity_v * velocity_y_ + displacement_v * displacement_y_;
    const VectorXd phi = water_of(z);
    now.force = damping_ * water_of(v) + stiffness_ * phi.head(mesh_) + end_stiffness_ * phi + coupling_ * v - now.load;
    return now;
}

double WaterLedger::flow(const Instant& instant) const
{
    const VectorXd phi = water_of(instant.z).head(mesh_);
    return 0.5 * phi.dot(stiffness_ * phi);
}

double WaterLedger::compression(const Instant& instant) const
{
    const VectorXd rate = water_of(instant.v).head(mesh_);
    return 0.5 * rate.dot(mass_ * rate);
}

void WaterLedger::add(const StepConstants& c, const Instant& before2, const Instant& before, const Instant& now,
                      Energy& energy) const
{
    const double gamma = c.scheme.gamma, half_beta = c.scheme.beta - 0.5 * gamma, dt2 = c.dt * c.dt;
    const VectorXd phi0 = water_of(before.z), phi1 = water_of(now.z), v0 = water_of(before.v), v1 = water_of(now.v),
                   a0 = water_of(before.a), a1 = water_of(now.a);
    const VectorXd step = (phi1 - phi0).head(mesh_), da = (a1 - a0).head(mesh_);
    const VectorXd m_a0 = mass_ * a0.head(mesh_), m_a1 = mass_ * a1.head(mesh_);
    energy.kinetic += flow(now);
    energy.strain += compression(now);
    energy.radiated += 0.5 * step.dot(end_mass_ * (a0 + a1) + damping_ * (v0 + v1) + end_stiffness_ * (phi0 + phi1));
    energy.external += 0.5 * step.dot(before.load + now.load);
    energy.numerical += -(gamma - 0.5) * step.dot(m_a1 - m_a0) + (gamma - 0.5) * half_beta * dt2 * da.dot(m_a1 - m_a0) +
                        0.5 * half_beta * dt2 * (a1.head(mesh_).dot(m_a1) - a0.head(mesh_).dot(m_a0));
    energy.numerical += 0.5 * c.scheme.alpha * step.dot(now.force - before2.force);
    if (before.jolt.size() > 0) energy.numerical -= 0.5 * (1.0 + c.scheme.alpha) * step.dot(before.jolt);
    energy.numerical +=
        0.5 * (step.dot(coupling_ * (before.v + now.v)) - (coupling_ * (now.z - before.z)).dot((v0 + v1).head(mesh_)));
}

} // namespace damslip::fe2d
