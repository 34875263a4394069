#include "fe2d/contact/joint_water.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

/// The rules of guidelines for the water in a crack that opens from a wet end while it shakes:
///
/// - unchanged: the pressure before; the crack is followed for the state after the earthquake.
/// - zero: none in what the earthquake opens, the pressure before elsewhere, and back where it shuts.
/// - full: full head of the wet end to the tip, beyond it as WetJoint::cracked says.
/// - mouth: full head to x_w, which follows the tip with the speed v_w at most and is driven back by it; none from
///   there to the tip; beyond it as a crack of length x_w has it. v_w → ∞: full; v_w → 0: zero.
///
/// Drains that shear off take the rule on with the pressure without them, from the next step on.
///
/// Where a crack shuts at its mouth first, the pairs behind it that are still open keep the pressure they had until they shut:
/// water that vanished there would give back another work than it took, and the rocking dam would live on it.
///
/// The tip at the end of a step gives the pressure at the end of the next: in a step it goes there linearly. So a step
/// knows its water, and full head that opens the joint further does so step by step.
class WaterRule final : public CrackWater {
public:
    WaterRule(const JointWaterLaw& law, std::shared_ptr<const WetJoint> joint);

    std::unique_ptr<JointLaw> clone() const override { return std::make_unique<WaterRule>(*this); }
    void begin(const JointStart& start) override;
    void add(JointTerms& terms) const override;
    JointFit revise(const ContactSolution&) override { return JointFit::fits; }
    void end(const ContactSolution& solution) override;
    const JointWaterReport& report() const override { return report_; }

private:
    Eigen::VectorXd by_rule() const;
    void follow(const ContactStates& states);

    JointWaterLaw law_;
    Eigen::VectorXd change_;     ///< of the pressure, at the end of the last step [Pa]
    Eigen::VectorXd next_;       ///< and of this one [Pa]
    Eigen::VectorXd target_;     ///< of the next step [Pa]
    std::vector<char> wet_pair_; ///< has been in a crack from a wet end since it opened
    Eigen::VectorXd opening_;    ///< at the start of the step [m]
    CrackLengths at_start_;      ///< cracks of the static state [m]
    CrackLengths wet_;           ///< x_w from both ends [m]
    double dt_ = 0.0;
};

/// Water that flows along the joint as it opens and shuts (JointFlow), width w = w_0 + opening. At rest the pressure stays
/// as it was: what the flow along the joint lacks for it comes from the rock, and goes on doing so.
///
/// In the contact problem the pressure at the end of a step is linearised about the last solution,
///
///     A (p_rest - p) = r + Z g,   Z = A (T+S)⁻¹ A/Δt
///
/// and solved again until p is that of the flow. Z may be an older one: it decides how often, not what comes out. So it
/// stays as it is while the state of the cells is the same and no w³ has changed by more than `rebuild_share`.
class ReynoldsWater final : public CrackWater {
public:
    static constexpr double rebuild_share = 0.1; ///< change of w³ that makes Z anew [-]
    static constexpr double tolerance = 1e-7;    ///< of p, over the largest pressure held [-]
    static constexpr int largest_passes = 40;    ///< contact problems of a step; then it is too long

    ReynoldsWater(const JointWaterLaw& law, std::shared_ptr<const WetJoint> joint);

    std::unique_ptr<JointLaw> clone() const override { return std::make_unique<ReynoldsWater>(*this); }
    void begin(const JointStart& start) override;
    void add(JointTerms& terms) const override;
    JointFit revise(const ContactSolution& solution) override;
    void end(const ContactSolution& solution) override;
    const JointWaterReport& report() const override { return report_; }
    void rest_with(const PressureProfile& pressure) override;
    void set_wave_pressure(double pressure) override { waves_ = with_waves_ ? pressure : 0.0; }

private:
    JointFlowStep step() const;
    void linearise(const JointFlowStep& flow, const Eigen::VectorXd& opening, bool anew);
    Eigen::VectorXd width(const Eigen::VectorXd& opening) const;

    double clearance_;
    bool with_waves_;
    JointChannel channel_;
    HeldPressure held_;
    double waves_ = 0.0; ///< [Pa]
    double scale_ = 1.0; ///< of pressures [Pa]

    // At the end of the last step.
    JointFlowState water_;
    Eigen::VectorXd source_; ///< from the rock; empty until it shakes
    Eigen::VectorXd change_; ///< of the pressure, as the contact problem had it [Pa]

    // Of this step.
    double dt_ = 0.0;
    Eigen::VectorXd opening_; ///< at its start [m]
    HeldPressure now_;
    JointFlowState next_;
    Eigen::VectorXd force_; ///< r [N/m]
    int passes_ = 0;

    // Z and what it was made for; shared by copies.
    struct Linear {
        Eigen::MatrixXd stiffness;
        Eigen::VectorXd width;
        std::vector<char> cavitated;
        double dt = 0.0;
    };
    std::shared_ptr<const Linear> linear_;
};

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
    : joint_(std::move(joint)), at_rest_(pair_pressure(*joint_, joint_->before)), lost_(VectorXd::Zero(joint_->pairs()))
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

namespace {

/// The middle part of a profile, and one pressure in the crack at either end.
/// @param wet  how far full head reaches into the cracks; nothing is in the rest of them
PressureProfile with_empty_cracks(const PressureProfile& full, double length, const CrackLengths& wet,
                                  const CrackLengths& crack)
{
    PressureProfile result;
    const auto take = [&](double from, double to) {
        if (!(to > from)) return;
        for (const ProfilePoint& point : part(full, from, to)) result.points.push_back(point);
    };
    const auto none = [&](double from, double to) {
        if (!(to > from)) return;
        result.points.push_back({from, 0.0});
        result.points.push_back({to, 0.0});
    };
    const double far_tip = std::max(crack.upstream, length - crack.downstream);
    take(0.0, wet.upstream);
    none(wet.upstream, crack.upstream);
    take(crack.upstream, far_tip);
    none(far_tip, length - wet.downstream);
    take(std::max(far_tip, length - wet.downstream), length);
    return result;
}

} // namespace

WaterRule::WaterRule(const JointWaterLaw& law, std::shared_ptr<const WetJoint> joint)
    : CrackWater(std::move(joint)), law_(law), change_(VectorXd::Zero(joint_->pairs())), next_(change_),
      target_(change_), wet_pair_(static_cast<std::size_t>(joint_->pairs()), 0)
{
}

/// Change of the pressure by the rule, with the present crack.
VectorXd WaterRule::by_rule() const
{
    const CrackLengths& crack = report_.crack;
    const CrackLengths wet_end{joint_->upstream_pressure > 0.0 ? crack.upstream : 0.0,
                               joint_->downstream_pressure > 0.0 ? crack.downstream : 0.0};
    if (wet_end.upstream == 0.0 && wet_end.downstream == 0.0) return lost_;
    CrackLengths wet = wet_end;
    switch (law_.opening) {
    case OpeningWater::zero:
        wet = {std::min(at_start_.upstream, wet_end.upstream), std::min(at_start_.downstream, wet_end.downstream)};
        break;
    case OpeningWater::mouth:
        wet = wet_;
        break;
    case OpeningWater::full:
        break;
    case OpeningWater::unchanged:
    case OpeningWater::reynolds: // ReynoldsWater's
        return lost_;
    }
    const bool full_head = law_.opening != OpeningWater::zero && (wet.upstream > 0.0 || wet.downstream > 0.0);
    const PressureProfile full = full_head ? joint_->cracked(wet.upstream, wet.downstream) : joint_->before;
    return pair_pressure(*joint_, with_empty_cracks(full, joint_->length(), wet, wet_end)) - at_rest_;
}

/// The pressure of the next step: the rule's, and what pairs behind a shut mouth keep.
void WaterRule::follow(const ContactStates& states)
{
    const Index m = joint_->pairs();
    const VectorXd before = target_;
    target_ = by_rule();
    if (law_.opening == OpeningWater::unchanged) return;
    const auto open = [&](Index i) { return states[static_cast<std::size_t>(i)] == ContactState::open; };
    Index first = 0, last = m; // pairs between the two cracks
    if (joint_->upstream_pressure > 0.0)
        while (first < m && open(first)) ++first;
    if (joint_->downstream_pressure > 0.0)
        while (last > first && open(last - 1)) --last;
    for (Index i = 0; i < m; ++i) {
        char& wet = wet_pair_[static_cast<std::size_t>(i)];
        const bool in_crack = i < first || i >= last;
        if (wet && !in_crack && open(i)) target_[i] = before[i];
        wet = open(i) && (in_crack || wet);
    }
}

void WaterRule::begin(const JointStart& start)
{
    dt_ = start.dt;
    opening_ = start.opening.segment(joint_->first, joint_->pairs());
    if (dt_ == 0.0) {
        next_.setZero();
        return;
    }
    next_ = target_;
}

void WaterRule::add(JointTerms& terms) const
{
    terms.force.segment(joint_->first, joint_->pairs()) -= joint_->area.cwiseProduct(next_);
}

void WaterRule::end(const ContactSolution& solution)
{
    const Index first = joint_->first, m = joint_->pairs();
    const VectorXd opening = solution.displacement.segment(first, m);
    if (dt_ > 0.0) add_work(change_, next_, opening - opening_);
    change_ = next_;
    report_.pressure = at_rest_ + change_;
    report_.force = joint_->area.cwiseProduct(change_);
    const auto from = solution.states.begin() + first;
    const ContactStates states(from, from + m);
    look(dt_, opening, states);
    if (dt_ == 0.0) at_start_ = report_.crack;
    // Before it shakes the water has had time to follow.
    const bool slow = law_.opening == OpeningWater::mouth && dt_ > 0.0;
    const double way = slow ? *law_.mouth_speed * dt_ : joint_->length();
    wet_.upstream = std::min(wet_.upstream + way, joint_->upstream_pressure > 0.0 ? report_.crack.upstream : 0.0);
    wet_.downstream =
        std::min(wet_.downstream + way, joint_->downstream_pressure > 0.0 ? report_.crack.downstream : 0.0);
    const bool comes_in = law_.opening == OpeningWater::full || law_.opening == OpeningWater::mouth;
    report_.wet_length = comes_in ? wet_.upstream : 0.0;
    if (dt_ > 0.0) shear_drains(dt_, solution);
    follow(states);
}

namespace {

constexpr double atmosphere = 1e5; // [Pa]

} // namespace

ReynoldsWater::ReynoldsWater(const JointWaterLaw& law, std::shared_ptr<const WetJoint> joint)
    : CrackWater(std::move(joint)), clearance_(law.clearance), with_waves_(law.wet_end == WetEndPressure::with_waves)
{
    channel_.length = joint_->area;
    channel_.fall = joint_->fall;
    channel_.drain = joint_->drain;
    held_ = {joint_->upstream_pressure, joint_->downstream_pressure, joint_->drain ? at_rest_[*joint_->drain] : 0.0};
    scale_ = std::max({held_.first, held_.second, atmosphere});
    water_ = {at_rest_, VectorXd::Zero(joint_->pairs())};
    change_ = force_ = VectorXd::Zero(joint_->pairs());
}

void ReynoldsWater::rest_with(const PressureProfile& pressure)
{
    CrackWater::rest_with(pressure);
    if (joint_->drain) held_.drain = at_rest_[*joint_->drain];
    water_ = {at_rest_, VectorXd::Zero(joint_->pairs())};
    source_.resize(0);
}

VectorXd ReynoldsWater::width(const VectorXd& opening) const
{
    return opening.cwiseMax(0.0).array() + clearance_;
}

JointFlowStep ReynoldsWater::step() const
{
    return {channel_, joint_->fluid, water_, width(opening_), now_, source_, dt_};
}

void ReynoldsWater::begin(const JointStart& start)
{
    const Index m = joint_->pairs();
    dt_ = start.dt;
    opening_ = start.opening.segment(joint_->first, m);
    passes_ = 0;
    if (dt_ == 0.0) { // the water has time to come to rest
        force_.setZero();
        return;
    }
    now_ = held_;
    now_.first = std::max(held_.first + waves_, joint_->fluid.cavitation);
    if (source_.size() == 0) source_ = steady_source(channel_, joint_->fluid, at_rest_, width(opening_), held_);
    const JointFlowStep flow = step();
    next_ = flow.state(width(opening_));
    linearise(flow, opening_, false);
}

/// r and, where it must be, Z about the pressure `next_` of these openings.
void ReynoldsWater::linearise(const JointFlowStep& flow, const VectorXd& opening, bool anew)
{
    const std::vector<char> cavitated = flow.cavitated(next_);
    const VectorXd widths = width(opening_);
    const auto changed = [&] {
        return ((widths.array() / linear_->width.array()).cube() - 1.0).abs().maxCoeff() > rebuild_share;
    };
    if (anew || !linear_ || linear_->dt != dt_ || linear_->cavitated != cavitated || changed()) {
        Linear made{flow.stiffness(cavitated), widths, cavitated, dt_};
        made.stiffness = joint_->area.asDiagonal() * made.stiffness;
        made.stiffness = (0.5 * (made.stiffness + made.stiffness.transpose())).eval();
        linear_ = std::make_shared<const Linear>(std::move(made));
    }
    force_ = joint_->area.cwiseProduct(at_rest_ - next_.pressure) - linear_->stiffness * opening;
}

void ReynoldsWater::add(JointTerms& terms) const
{
    if (dt_ == 0.0) return;
    const Index first = joint_->first, m = joint_->pairs();
    terms.force.segment(first, m) += force_;
    terms.blocks.push_back({first, {linear_, &linear_->stiffness}});
}

JointFit ReynoldsWater::revise(const ContactSolution& solution)
{
    if (dt_ == 0.0) return JointFit::fits;
    const VectorXd opening = solution.displacement.segment(joint_->first, joint_->pairs());
    const JointFlowStep flow = step();
    next_ = flow.state(width(opening));
    const VectorXd used = at_rest_ - (force_ + linear_->stiffness * opening).cwiseQuotient(joint_->area);
    if ((used - next_.pressure).cwiseAbs().maxCoeff() <= tolerance * scale_) return JointFit::fits;
    if (++passes_ >= largest_passes) return JointFit::too_far;
    linearise(flow, opening, passes_ > 4);
    return JointFit::changed;
}

void ReynoldsWater::end(const ContactSolution& solution)
{
    const Index first = joint_->first, m = joint_->pairs();
    const VectorXd opening = solution.displacement.segment(first, m);
    const auto from = solution.states.begin() + first;
    if (dt_ == 0.0) {
        water_ = {at_rest_, VectorXd::Zero(m)};
        change_.setZero();
    } else {
        const JointFlowStep flow = step();
        const VectorXd widths = width(opening);
        const VectorXd change = -(force_ + linear_->stiffness * opening).cwiseQuotient(joint_->area);
        add_work(change_, change, opening - opening_);
        change_ = change;
        report_.flow += flow.work(next_, widths);
        report_.reynolds_number = std::max(report_.reynolds_number, flow.reynolds_number(next_));
        water_ = next_;
    }
    report_.pressure = water_.pressure;
    report_.force = joint_->area.cwiseProduct(change_);
    look(dt_, opening, ContactStates(from, from + m));
}

} // namespace damslip::fe2d
