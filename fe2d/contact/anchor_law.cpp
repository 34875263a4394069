#include "fe2d/contact/anchor_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double direction_renewed_after = 0.01; ///< of the free length [-]
/// Changes of state in one step. In a joint without friction two per anchor are enough: its energy is convex, and a spring
/// that is replaced by its yield force yields more.
constexpr int most_revisions = 20;
constexpr double force_round_off = 1e-10; ///< of the yield force: no change of state for less [-]

} // namespace

AnchorLaw::AnchorLaw(std::vector<PlacedAnchor> anchors, Index pairs) : pairs_(pairs)
{
    for (PlacedAnchor& anchor : anchors) {
        Row row;
        row.at = std::move(anchor);
        row.history = anchor_at_lock_off(row.at.bar);
        row.direction = row.pulls = row.at.bar.direction(0.0, 0.0);
        rows_.push_back(std::move(row));
    }
}

double AnchorLaw::interpolated(const Row& row, const VectorXd& values, Index shift) const
{
    const Index i = shift + row.at.pair;
    return row.at.share == 0.0 ? values[i] : (1.0 - row.at.share) * values[i] + row.at.share * values[i + 1];
}

void AnchorLaw::lock_off(Row& row, double gap, double slip) const
{
    row.gap_zero = gap;
    row.slip_zero = slip;
}

void AnchorLaw::begin(const JointStart& start)
{
    dt_ = start.dt;
    revisions_ = 0;
    if (dt_ > 0.0 && phase_ != Phase::locked) {
        for (Row& row : rows_) lock_off(row, interpolated(row, start.opening), interpolated(row, start.slip));
        phase_ = Phase::locked;
    }
    for (Row& row : rows_) {
        const AnchorBar& bar = row.at.bar;
        row.gap_start = interpolated(row, start.opening);
        row.slip_start = interpolated(row, start.slip);
        const double gap = row.gap_start - row.gap_zero, slip = row.slip_start - row.slip_zero;
        row.stretch_start = row.stretch_end = phase_ == Phase::locked ? bar.stretch(gap, slip) : 0.0;
        row.pulls = phase_ == Phase::locked ? bar.direction(gap, slip) : row.direction;
        if (std::hypot(gap - row.gap_of_direction, slip - row.slip_of_direction) >
            direction_renewed_after * bar.length) {
            row.direction = bar.direction(gap, slip);
            row.gap_of_direction = gap;
            row.slip_of_direction = slip;
        }
        row.trial = row.history.state;
        const bool holds = row.history.state != AnchorState::snapped && phase_ == Phase::locked;
        row.dowel = holds && bar.dowel > 0.0 ? bar.dowel * dowel_share(row.history.force / bar.yield_force) : 0.0;
    }
}

void AnchorLaw::add(JointTerms& terms) const
{
    if (phase_ == Phase::absent) return;
    for (const Row& row : rows_) {
        const AnchorBar& bar = row.at.bar;
        const Index i = row.at.pair;
        const Index places[] = {i, i + 1, pairs_ + i, pairs_ + i + 1};
        const double w0 = 1.0 - row.at.share, w1 = row.at.share;
        const auto along = [&](const BarDirection& d) {
            return std::array{d.normal * w0, d.normal * w1, d.along * w0, d.along * w1};
        };
        const std::array<double, 4> b = along(row.direction);
        const auto used = [&](int k) { return b[k] != 0.0; }; // a pair without share may not exist
        const auto pull = [&](const BarDirection& direction, double force) {
            const std::array<double, 4> parts = along(direction);
            for (int k = 0; k < 4; ++k)
                if (parts[k] != 0.0) terms.force[places[k]] += parts[k] * force;
        };
        if (phase_ == Phase::stressed) {
            pull(row.pulls, bar.prestress);
            continue;
        }
        if (row.dowel > 0.0) {
            terms.strength.cohesion[i] += w0 * row.dowel;
            if (w1 > 0.0) terms.strength.cohesion[i + 1] += w1 * row.dowel;
        }
        if (row.trial == AnchorState::yields) pull(row.pulls, bar.yield_force);
        if (row.trial != AnchorState::elastic) continue;
        // x holds the opening at the step's end, and the slip within it.
        pull(row.pulls, row.history.trial_force(bar, row.stretch_start));
        pull(row.direction, -bar.stiffness() * row.direction.normal * row.gap_start);
        for (int k = 0; k < 4; ++k)
            for (int j = 0; j < 4; ++j)
                if (used(k) && used(j)) terms.entries.push_back({places[k], places[j], bar.stiffness() * b[k] * b[j]});
    }
}

double AnchorLaw::stretch_of(const Row& row, const ContactSolution& solution) const
{
    const double gap = interpolated(row, solution.displacement) - row.gap_start,
                 slip = interpolated(row, solution.displacement, pairs_);
    return row.stretch_start + row.direction.normal * gap + row.direction.along * slip;
}

JointFit AnchorLaw::revise(const ContactSolution& solution)
{
    if (phase_ != Phase::locked) return JointFit::fits;
    JointFit fit = JointFit::fits;
    for (Row& row : rows_) {
        if (row.history.state == AnchorState::snapped) continue;
        const AnchorBar& bar = row.at.bar;
        row.stretch_end = stretch_of(row, solution);
        const double trial = row.history.trial_force(bar, row.stretch_end), little = force_round_off * bar.yield_force;
        const AnchorState asked = row.history.state_at(bar, row.stretch_end);
        const bool at_edge = std::abs(trial) <= little || std::abs(trial - bar.yield_force) <= little;
        if (asked == row.trial || at_edge) continue;
        row.trial = asked;
        fit = JointFit::changed;
    }
    if (fit == JointFit::changed && ++revisions_ > most_revisions) return JointFit::too_far;
    return fit;
}

void AnchorLaw::end(const ContactSolution& solution)
{
    time_ += dt_;
    if (phase_ == Phase::absent) {
        const bool stressing =
            std::any_of(rows_.begin(), rows_.end(), [](const Row& r) { return r.at.bar.prestress > 0.0; });
        phase_ = stressing ? Phase::stressed : Phase::locked;
        if (phase_ == Phase::stressed) return;
    } else if (phase_ == Phase::stressed) {
        phase_ = Phase::locked;
    } else {
        for (Row& row : rows_) {
            if (row.history.state == AnchorState::snapped) continue;
            const AnchorBar& bar = row.at.bar;
            row.history.stretch_to(bar, row.stretch_end);
            row.history.state = row.trial;
            if (row.dowel > 0.0) { // by what slipped at it
                const auto slid = [&](Index i) { return std::abs(solution.displacement[pairs_ + i]); };
                row.dowel_work += row.dowel * ((1.0 - row.at.share) * slid(row.at.pair) +
                                               (row.at.share > 0.0 ? row.at.share * slid(row.at.pair + 1) : 0.0));
            }
            if (bar.rupture_strain && bar.strain(row.stretch_end) >= *bar.rupture_strain) row.history.snap(bar, time_);
        }
        return;
    }
    for (Row& row : rows_)
        lock_off(row, interpolated(row, solution.displacement),
                 row.slip_start + interpolated(row, solution.displacement, pairs_));
}

JointEnergy AnchorLaw::energy() const
{
    JointEnergy sum;
    if (phase_ != Phase::locked) return sum;
    for (const Row& row : rows_) {
        sum.stored += row.history.stored(row.at.bar);
        sum.anchor_plastic += row.history.plastic_work;
        sum.anchor_loss += row.history.loss;
    }
    return sum;
}

namespace {

constexpr double not_snapped = -1.0; ///< as a time

} // namespace

double AnchorLaw::reach() const
{
    double longest = 0.0;
    for (const Row& row : rows_)
        if (row.history.state != AnchorState::snapped) longest = std::max(longest, row.at.bar.length);
    return longest;
}

void AnchorLaw::save(JointLawState& state) const
{
    const auto list = [&](const char* key, auto&& value) {
        std::vector<double>& values = state[key];
        for (const Row& row : rows_) values.push_back(value(row));
    };
    list("anchor_state", [](const Row& r) { return static_cast<double>(r.history.state); });
    list("anchor_force_N_m", [](const Row& r) { return r.history.force; });
    list("anchor_stretch_m", [](const Row& r) { return r.history.stretch; });
    list("anchor_plastic_strain", [](const Row& r) { return r.history.plastic_strain; });
    list("anchor_largest_force_N_m", [](const Row& r) { return r.history.largest_force; });
    list("anchor_largest_stretch_m", [](const Row& r) { return r.history.largest_stretch; });
    list("anchor_snapped_s", [](const Row& r) { return r.history.snapped_at.value_or(not_snapped); });
    list("anchor_plastic_work_J_m", [](const Row& r) { return r.history.plastic_work; });
    list("anchor_loss_J_m", [](const Row& r) { return r.history.loss; });
    list("anchor_dowel_work_J_m", [](const Row& r) { return r.dowel_work; });
    list("anchor_lock_off_opening_m", [](const Row& r) { return r.gap_zero; });
    list("anchor_lock_off_slip_m", [](const Row& r) { return r.slip_zero; });
    list("anchor_direction_opening_m", [](const Row& r) { return r.gap_of_direction; });
    list("anchor_direction_slip_m", [](const Row& r) { return r.slip_of_direction; });
    state["anchor_time_s"] = {time_};
}

void AnchorLaw::restore(const JointLawState& state)
{
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        Row& row = rows_[k];
        const auto value = [&](const char* key) { return state.at(key)[k]; };
        AnchorHistory& h = row.history;
        h.state = static_cast<AnchorState>(static_cast<int>(value("anchor_state")));
        h.force = value("anchor_force_N_m");
        h.stretch = value("anchor_stretch_m");
        h.plastic_strain = value("anchor_plastic_strain");
        h.largest_force = value("anchor_largest_force_N_m");
        h.largest_stretch = value("anchor_largest_stretch_m");
        const double snapped = value("anchor_snapped_s");
        h.snapped_at = snapped == not_snapped ? std::nullopt : std::optional(snapped);
        h.plastic_work = value("anchor_plastic_work_J_m");
        h.loss = value("anchor_loss_J_m");
        row.dowel_work = value("anchor_dowel_work_J_m");
        row.gap_zero = value("anchor_lock_off_opening_m");
        row.slip_zero = value("anchor_lock_off_slip_m");
        row.gap_of_direction = value("anchor_direction_opening_m");
        row.slip_of_direction = value("anchor_direction_slip_m");
        row.direction = row.at.bar.direction(row.gap_of_direction, row.slip_of_direction);
    }
    time_ = state.at("anchor_time_s").front();
    phase_ = Phase::locked;
}

AnchorLaw::Support AnchorLaw::support(Force force, Index first, Index count, const VectorXd& pair_distance) const
{
    Support sum;
    if (phase_ == Phase::absent) return sum;
    for (const Row& row : rows_) {
        const AnchorBar& bar = row.at.bar;
        const Index i = row.at.pair - first;
        if (i < 0 || i >= count || row.history.state == AnchorState::snapped) continue;
        const double pull = force == Force::yield && phase_ == Phase::locked ? bar.yield_force
                            : phase_ == Phase::locked                        ? row.history.force
                                                                             : bar.prestress;
        const double at = row.at.share == 0.0
                              ? pair_distance[i]
                              : (1.0 - row.at.share) * pair_distance[i] + row.at.share * pair_distance[i + 1];
        sum.normal += pull * row.direction.normal;
        sum.along += pull * row.direction.along;
        sum.moment += at * pull * row.direction.normal;
        if (phase_ == Phase::locked && bar.dowel > 0.0)
            sum.dowel += bar.dowel * dowel_share(row.history.force / bar.yield_force);
        sum.any = true;
    }
    return sum;
}

std::vector<AnchorOutcome> AnchorLaw::outcomes() const
{
    std::vector<AnchorOutcome> all;
    for (const Row& row : rows_) {
        all.push_back({row.at.bar.name, row.history, row.at.bar.yield_force, row.history.stored(row.at.bar)});
        all.back().history.plastic_work += row.dowel_work;
    }
    return all;
}

} // namespace damslip::fe2d
