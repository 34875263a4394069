#include "fe2d/contact/joint_flow.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// q over the laminar one at a gradient of pressure [-]: 1 below the turbulent range. Darcy-Weisbach between plates,
/// |∂p/∂x| = f ρ q²/(4w³); with f = 0.316 (2q/ν)^-1/4 it is solved for q.
double turbulent_share(const JointFluid& fluid, double width, double gradient)
{
    const double cube = width * width * width, laminar = cube / (12.0 * fluid.viscosity) * gradient;
    if (!(laminar > 0.0) || !(fluid.density > 0.0)) return 1.0;
    const double kinematic = fluid.viscosity / fluid.density;
    const double turbulent =
        std::pow(gradient * 4.0 * cube * std::pow(2.0 / kinematic, 0.25) / (0.316 * fluid.density), 1.0 / 1.75);
    return std::min(1.0, turbulent / laminar);
}

} // namespace

JointFlowWork& JointFlowWork::operator+=(const JointFlowWork& other)
{
    for (const auto part :
         {&JointFlowWork::walls, &JointFlowWork::ends, &JointFlowWork::drain, &JointFlowWork::rock,
          &JointFlowWork::viscous, &JointFlowWork::gravity, &JointFlowWork::stored, &JointFlowWork::cavities})
        this->*part += other.*part;
    return *this;
}

JointFlowStep::JointFlowStep(const JointChannel& channel, const JointFluid& fluid, const JointFlowState& start,
                             const VectorXd& width, const HeldPressure& held, const VectorXd& source, double dt)
    : channel_(channel), fluid_(fluid), start_(start), held_(held), dt_(dt), width_(width),
      source_(source.size() > 0 ? source : VectorXd(VectorXd::Zero(channel.cells()))),
      storage_(width.cwiseProduct(channel.length) / (fluid.bulk_modulus * dt))
{
    set_conductance(width);
    const Index m = channel_.cells();
    known_ = source_ + storage_.cwiseProduct(start_.pressure) - start_.empty / dt_;
    for (Index face = 0; face <= m; ++face) {
        if (face > 0) known_[face - 1] -= driven_[face];
        if (face < m) known_[face] += driven_[face];
    }
    known_[0] += conductance_[0] * held_.first;
    known_[m - 1] += conductance_[m] * held_.second;
}

/// Two half cells in series between the centres; half a cell from an open end.
void JointFlowStep::set_conductance(const VectorXd& width)
{
    const Index m = channel_.cells();
    const auto half = [&](Index cell) {
        return 6.0 * fluid_.viscosity * channel_.length[cell] / (width[cell] * width[cell] * width[cell]);
    };
    conductance_ = driven_ = VectorXd::Zero(m + 1);
    for (Index face = 0; face <= m; ++face) {
        const bool first = face == 0, second = face == m;
        if ((first && !channel_.first_open) || (second && !channel_.second_open)) continue;
        const Index left = first ? 0 : face - 1, right = second ? m - 1 : face;
        const double way =
            first || second ? 0.5 * channel_.length[left] : 0.5 * (channel_.length[left] + channel_.length[right]);
        double resistance = 0.0;
        if (!first) resistance += half(left);
        if (!second) resistance += half(right);
        const double before = first ? held_.first : start_.pressure[left],
                     after = second ? held_.second : start_.pressure[right];
        const double weight = fluid_.unit_weight * channel_.fall * way;
        const double narrow = std::min(width[left], width[right]);
        conductance_[face] = turbulent_share(fluid_, narrow, std::abs(before - after + weight) / way) / resistance;
        // Water flows down out of cells that are full, and out of the water before an end.
        const bool from_outside = weight > 0.0 ? first : second;
        if (from_outside || start_.empty[weight > 0.0 ? left : right] <= 0.0)
            driven_[face] = conductance_[face] * weight;
    }
}

/// (T + S) p, the ends' held pressures on the right side.
VectorXd JointFlowStep::times(const VectorXd& pressure) const
{
    const Index m = channel_.cells();
    VectorXd result = storage_.cwiseProduct(pressure);
    result[0] += conductance_[0] * pressure[0];
    result[m - 1] += conductance_[m] * pressure[m - 1];
    for (Index face = 1; face < m; ++face) {
        const double flow = conductance_[face] * (pressure[face - 1] - pressure[face]);
        result[face - 1] += flow;
        result[face] -= flow;
    }
    return result;
}

/// (T + S) p = right on cells that are not held, p = values on those that are. Thomas' algorithm.
VectorXd JointFlowStep::solve(VectorXd right, const std::vector<char>& held, const VectorXd& values) const
{
    const Index m = channel_.cells();
    VectorXd diagonal(m);
    for (Index i = 0; i < m; ++i) diagonal[i] = storage_[i] + conductance_[i] + conductance_[i + 1];
    const auto is_held = [&](Index i) { return held[static_cast<std::size_t>(i)] != 0; };
    for (Index i = 0; i < m; ++i) {
        if (!is_held(i)) continue;
        if (i > 0) right[i - 1] += conductance_[i] * values[i];
        if (i + 1 < m) right[i + 1] += conductance_[i + 1] * values[i];
    }
    for (Index i = 0; i < m; ++i)
        if (is_held(i)) right[i] = values[i];
    const auto coupled = [&](Index face) { // between cells face-1 and face
        return is_held(face - 1) || is_held(face) ? 0.0 : conductance_[face];
    };
    for (Index i = 0; i < m; ++i)
        if (is_held(i)) diagonal[i] = 1.0;
    for (Index i = 1; i < m; ++i) {
        const double c = coupled(i), share = c / diagonal[i - 1];
        diagonal[i] -= share * c;
        right[i] += share * right[i - 1];
    }
    right[m - 1] /= diagonal[m - 1];
    for (Index i = m - 1; i > 0; --i) right[i - 1] = (right[i - 1] + coupled(i) * right[i]) / diagonal[i - 1];
    return right;
}

std::vector<char> JointFlowStep::cavitated(const JointFlowState& state) const
{
    std::vector<char> result(static_cast<std::size_t>(channel_.cells()), 0);
    for (Index i = 0; i < channel_.cells(); ++i)
        result[static_cast<std::size_t>(i)] = state.pressure[i] <= fluid_.cavitation && channel_.drain != i;
    return result;
}

JointFlowState JointFlowStep::state(const VectorXd& width) const
{
    const Index m = channel_.cells();
    const VectorXd right = known_ - channel_.length.cwiseProduct(width - width_) / dt_;
    VectorXd values = VectorXd::Constant(m, fluid_.cavitation);
    std::vector<char> held = cavitated(start_);
    if (channel_.drain) {
        held[static_cast<std::size_t>(*channel_.drain)] = 1;
        values[*channel_.drain] = held_.drain;
    }
    JointFlowState end;
    // Switching all cells that are wrong is monotone for an M-matrix from the second pass on, so m + 2 passes are enough
    // (Hintermüller, Ito & Kunisch 2003); round-off may make a cell at the limit hesitate, which the margins settle.
    const double scale = std::max({1.0, std::abs(fluid_.cavitation), std::abs(held_.first), std::abs(held_.second)});
    const auto volume_margin = [&](Index i) {
        return 1e-14 *
               (channel_.length[i] * width[i] + dt_ * scale * (storage_[i] + conductance_[i] + conductance_[i + 1]));
    };
    for (Index pass = 0; pass < m + 2; ++pass) {
        end.pressure = solve(right, held, values);
        const VectorXd missing = dt_ * (times(end.pressure) - right);
        end.empty = VectorXd::Zero(m);
        bool changed = false;
        for (Index i = 0; i < m; ++i) {
            if (channel_.drain == i) continue;
            char& cavity = held[static_cast<std::size_t>(i)];
            if (cavity && missing[i] < -volume_margin(i)) {
                cavity = 0;
                changed = true;
            } else if (!cavity && end.pressure[i] < fluid_.cavitation - 1e-12 * scale) {
                cavity = 1;
                changed = true;
            }
            if (cavity) end.empty[i] = std::max(0.0, missing[i]);
        }
        if (!changed) break;
    }
    end.pressure = end.pressure.cwiseMax(fluid_.cavitation);
    return end;
}

MatrixXd JointFlowStep::stiffness(const std::vector<char>& cavitated) const
{
    const Index m = channel_.cells();
    std::vector<char> held = cavitated;
    if (channel_.drain) held[static_cast<std::size_t>(*channel_.drain)] = 1;
    MatrixXd result = MatrixXd::Zero(m, m);
    const VectorXd none = VectorXd::Zero(m);
    for (Index j = 0; j < m; ++j) {
        if (held[static_cast<std::size_t>(j)]) continue;
        VectorXd unit = none;
        unit[j] = channel_.length[j] / dt_;
        result.col(j) = solve(std::move(unit), held, none);
    }
    return result;
}

VectorXd JointFlowStep::flux(const JointFlowState& end) const
{
    const Index m = channel_.cells();
    VectorXd q = driven_;
    for (Index face = 0; face <= m; ++face) {
        const double before = face == 0 ? held_.first : end.pressure[face - 1],
                     after = face == m ? held_.second : end.pressure[face];
        q[face] += conductance_[face] * (before - after);
    }
    return q;
}

double JointFlowStep::reynolds_number(const JointFlowState& end) const
{
    return 2.0 * flux(end).cwiseAbs().maxCoeff() * fluid_.density / fluid_.viscosity;
}

JointFlowWork JointFlowStep::work(const JointFlowState& end, const VectorXd& width) const
{
    const Index m = channel_.cells();
    const VectorXd q = flux(end);
    const VectorXd &p = end.pressure, &a = channel_.length;
    JointFlowWork w;
    w.walls = p.dot(a.cwiseProduct(width - width_));
    w.ends = dt_ * (held_.first * q[0] - held_.second * q[m]);
    w.rock = dt_ * p.dot(source_);
    w.stored = dt_ * p.dot(storage_.cwiseProduct(p - start_.pressure));
    w.cavities = -p.dot(end.empty - start_.empty);
    for (Index face = 0; face <= m; ++face) {
        if (conductance_[face] == 0.0) continue;
        w.viscous += dt_ * q[face] * q[face] / conductance_[face];
        w.gravity += dt_ * q[face] * driven_[face] / conductance_[face];
    }
    if (channel_.drain) { // what the drain lets in: the rest of its cell's balance
        const Index i = *channel_.drain;
        const double in = a[i] * (width[i] - width_[i]) / dt_ + storage_[i] * (p[i] - start_.pressure[i]) -
                          (end.empty[i] - start_.empty[i]) / dt_ + q[i + 1] - q[i] - source_[i];
        w.drain = dt_ * p[i] * in;
    }
    return w;
}

VectorXd steady_source(const JointChannel& channel, const JointFluid& fluid, const VectorXd& pressure,
                       const VectorXd& width, const HeldPressure& held)
{
    const Index m = channel.cells();
    const JointFlowState state{pressure, VectorXd::Zero(m)};
    const JointFlowStep step(channel, fluid, state, width, held, {}, 1.0);
    const VectorXd q = step.flux(state);
    VectorXd source = q.tail(m) - q.head(m);
    if (channel.drain) source[*channel.drain] = 0.0;
    return source;
}

} // namespace damslip::fe2d
