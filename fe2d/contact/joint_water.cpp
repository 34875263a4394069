#include "fe2d/contact/joint_water.hpp"

#include "fe2d/contact/reynolds_water.hpp"
#include "fe2d/contact/water_rule.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

/// Between corners of the profile and pairs p N is a parabola: Simpson's rule is exact.
VectorXd pair_pressure(const WetJoint& joint, const PressureProfile& profile)
{
    const Index m = joint.pairs();
    VectorXd force = VectorXd::Zero(m);
    const VectorXd& d = joint.distance;
    for (std::size_t k = 0; k + 1 < profile.points.size(); ++k) {
        const ProfilePoint &from = profile.points[k], &to = profile.points[k + 1];
        if (!(to.distance > from.distance)) continue;
        const double slope = (to.pressure - from.pressure) / (to.distance - from.distance);
        const auto p = [&](double x) { return from.pressure + slope * (x - from.distance); };
        Index i = std::clamp<Index>(std::upper_bound(d.data(), d.data() + m, from.distance) - d.data() - 1, 0, m - 2);
        for (; i + 1 < m; ++i) {
            const double a = i == 0 ? from.distance : std::max(from.distance, d[i]);
            const double b = i + 2 == m ? to.distance : std::min(to.distance, d[i + 1]);
            if (!(b > a)) break;
            const auto share = [&](double x) { return std::clamp((x - d[i]) / (d[i + 1] - d[i]), 0.0, 1.0); };
            const double middle = 0.5 * (a + b);
            const double pa = p(a), pm = 4.0 * p(middle), pb = p(b), all = (b - a) / 6.0;
            const double right = all * (pa * share(a) + pm * share(middle) + pb * share(b));
            force[i + 1] += right;
            force[i] += all * (pa + pm + pb) - right;
        }
    }
    return force.cwiseQuotient(joint.area);
}

namespace {

/// Seen from the end where the run begins: pairs at(0), at(1), ... in distances from that end.
template <class At>
double run_of_open_pairs(Index m, double length, const At& at, const ContactStates& states, const VectorXd& opening,
                         const std::function<double(Index)>& distance)
{
    Index open = 0;
    while (open < m && states[static_cast<std::size_t>(at(open))] == ContactState::open) ++open;
    if (open == 0) return 0.0;
    if (open == m) return length;
    const double last = distance(open - 1), shut = distance(open);
    if (open == 1) return 0.5 * (last + shut);
    const double g = opening[at(open - 1)], fall = opening[at(open - 2)] - g;
    if (!(fall > 0.0)) return shut;
    return std::min(shut, last + g / fall * (last - distance(open - 2)));
}

} // namespace

CrackLengths crack_lengths(const WetJoint& joint, const VectorXd& opening, const ContactStates& states)
{
    const Index m = joint.pairs();
    const double length = joint.length();
    return {run_of_open_pairs(
                m, length, [](Index i) { return i; }, states, opening,
                [&](Index i) { return joint.distance[i] - joint.distance[0]; }),
            run_of_open_pairs(
                m, length, [m](Index i) { return m - 1 - i; }, states, opening,
                [&](Index i) { return joint.distance[m - 1] - joint.distance[m - 1 - i]; })};
}

CrackWater::CrackWater(std::shared_ptr<const WetJoint> joint)
    : joint_(std::move(joint)), at_rest_(pair_pressure(*joint_, joint_->before)),
      lost_(VectorXd::Zero(joint_->pairs()))
{
    report_.pressure = at_rest_;
    report_.force = VectorXd::Zero(joint_->pairs());
    report_.least_pressure = at_rest_.minCoeff();
    report_.largest_pressure = at_rest_.maxCoeff();
}

/// The crack of the present state, and the extremes so far.
void CrackWater::look(double dt, const VectorXd& opening, const ContactStates& states)
{
    report_.crack = crack_lengths(*joint_, opening, states);
    report_.largest.upstream = std::max(report_.largest.upstream, report_.crack.upstream);
    report_.largest.downstream = std::max(report_.largest.downstream, report_.crack.downstream);
    if (report_.crack.upstream >= joint_->length()) report_.cracked_through += dt;
    report_.least_pressure = std::min(report_.least_pressure, report_.pressure.minCoeff());
    report_.largest_pressure = std::max(report_.largest_pressure, report_.pressure.maxCoeff());
}

void CrackWater::shear_drains(double dt, const ContactSolution& solution)
{
    time_ += dt;
    if (!joint_->drain_loss || report_.drains_lost) return;
    const Index pairs = solution.displacement.size() / 2;
    path_ += std::abs(joint_->area.dot(solution.displacement.segment(pairs + joint_->first, joint_->pairs()))) /
             joint_->length();
    if (path_ >= joint_->drain_loss->path) lose_drains();
}

void CrackWater::lose_drains()
{
    WetJoint joint = *joint_;
    joint.before = joint.drain_loss->before;
    joint.cracked = joint.drain_loss->cracked;
    joint.drain.reset();
    joint_ = std::make_shared<const WetJoint>(std::move(joint));
    lost_ = pair_pressure(*joint_, joint_->before) - at_rest_;
    report_.drains_lost = time_;
}

/// By the trapezoid, as the ledger of the steps counts all forces. @param before, after  changes of pressure [Pa]
void CrackWater::add_work(const VectorXd& before, const VectorXd& after, const VectorXd& opened)
{
    energy_.water += 0.5 * (before + after).cwiseProduct(joint_->area).dot(opened);
}

void CrackWater::rest_with(const PressureProfile& pressure)
{
    WetJoint joint = *joint_;
    joint.before = pressure;
    joint_ = std::make_shared<const WetJoint>(std::move(joint));
    at_rest_ = pair_pressure(*joint_, pressure);
    lost_.setZero();
    report_.pressure = at_rest_;
}

namespace {

using FlowTerm = double JointFlowWork::*;
constexpr FlowTerm flow_terms[] = {&JointFlowWork::walls,  &JointFlowWork::ends,    &JointFlowWork::drain,
                                   &JointFlowWork::rock,   &JointFlowWork::gravity, &JointFlowWork::viscous,
                                   &JointFlowWork::stored, &JointFlowWork::cavities};

} // namespace

void CrackWater::save(JointLawState& state) const
{
    state["water_largest_crack_m"] = {report_.largest.upstream, report_.largest.downstream};
    state["water_pressures_Pa"] = {report_.least_pressure, report_.largest_pressure};
    state["water_reynolds_number"] = {report_.reynolds_number};
    state["water_cracked_through_s"] = {report_.cracked_through};
    state["water_work_J_m"] = {energy_.water};
    std::vector<double>& flow = state["water_flow_J_m"];
    for (const FlowTerm term : flow_terms) flow.push_back(report_.flow.*term);
    if (joint_->drain_loss) state["drain_path_m"] = {path_};
}

void CrackWater::restore(const JointLawState& state)
{
    const std::vector<double>&crack = state.at("water_largest_crack_m"), &pressures = state.at("water_pressures_Pa");
    report_.largest = {crack[0], crack[1]};
    report_.least_pressure = pressures[0];
    report_.largest_pressure = pressures[1];
    report_.reynolds_number = state.at("water_reynolds_number").front();
    report_.cracked_through = state.at("water_cracked_through_s").front();
    energy_.water = state.at("water_work_J_m").front();
    const std::vector<double>& flow = state.at("water_flow_J_m");
    for (std::size_t k = 0; k < std::size(flow_terms); ++k) report_.flow.*flow_terms[k] = flow[k];
    if (!joint_->drain_loss) return;
    path_ = state.at("drain_path_m").front();
    if (path_ >= joint_->drain_loss->path) lose_drains();
}

std::unique_ptr<CrackWater> make_joint_water(const JointWaterLaw& law, std::shared_ptr<const WetJoint> joint)
{
    if (!law.follows() && !joint->drain_loss) return nullptr;
    if (law.opening == OpeningWater::reynolds) return std::make_unique<ReynoldsWater>(law, std::move(joint));
    return std::make_unique<WaterRule>(law, std::move(joint));
}

} // namespace damslip::fe2d
