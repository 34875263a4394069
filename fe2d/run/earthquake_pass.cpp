#include "fe2d/run/earthquake_pass.hpp"

#include "fe2d/contact/bond_law.hpp"
#include "fe2d/run/base_water.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

namespace {

/// (s_i - s_j) / (s_j - s_k) of an error of order p.
double ratio_of_differences(double p, int first, int second)
{
    return (std::exp2(p * first) - 1.0) / (1.0 - std::exp2(-p * second));
}

} // namespace

double observed_order(std::span<const SlipAtStep> slips, double largest)
{
    if (slips.size() < 3) return 1.0;
    const auto last = slips.last(3);
    const int first = last[1].halvings - last[0].halvings, second = last[2].halvings - last[1].halvings;
    const double before = last[1].change, now = last[2].change;
    double low = 1.0, high = largest;
    for (int k = 0; k < 40; ++k) {
        const double p = 0.5 * (low + high);
        (before > now * ratio_of_differences(p, first, second) ? low : high) = p;
    }
    return low;
}

double step_error(std::span<const SlipAtStep> slips, double largest)
{
    const auto last = slips.last(2);
    const int halvings = last[1].halvings - last[0].halvings;
    double change = last[1].change, safety = safety_factor.of_two;
    if (slips.size() >= 3) {
        const int before = last[0].halvings - slips[slips.size() - 3].halvings;
        change = std::max(change, last[0].change / ratio_of_differences(largest, before, halvings));
        safety = safety_factor.of_three;
    }
    return safety * change / (std::exp2(observed_order(slips, largest) * halvings) - 1.0);
}

int next_halvings(std::span<const SlipAtStep> slips, double excess, double largest)
{
    const int last = slips.back().halvings;
    if (slips.size() != 2) return last + 1;
    const SlipAtStep still{last + 1, slips.back().slip, 0.0}; // as small a change as there can be
    const double best = step_error(std::array{slips[0], slips[1], still}, largest);
    return last + (excess * best > step_error(slips, largest) ? 2 : 1);
}

double largest_difference(std::span<const double> a, std::span<const double> b)
{
    double largest = std::abs(a.back() - b.back());
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

double largest_difference(std::span<const double> a, std::span<const std::size_t> a_starts, std::span<const double> b,
                          std::span<const std::size_t> b_starts)
{
    const auto event = [](std::span<const double> all, std::span<const std::size_t> starts, std::size_t i) {
        const std::size_t end = i + 1 < starts.size() ? starts[i + 1] : all.size();
        return all.subspan(starts[i], end - starts[i]);
    };
    double largest = std::abs(a.back() - b.back());
    for (std::size_t i = 0; i < std::min(a_starts.size(), b_starts.size()); ++i)
        largest = std::max(largest, largest_difference(event(a, a_starts, i), event(b, b_starts, i)));
    return largest;
}

namespace {

/// Energy that contact or the scheme has made up, beyond what the ground and the weights gave: of contact a twentieth of
/// it, or what lifts the dam by a tenth of a millimetre (landings at the end of coarse steps give and take as much). A stable
/// scheme with beta < gamma/2 lends some of the kinetic energy and takes it back; an unstable one soon has given many times
/// all else.
bool diverges(const DynamicContact& dynamics)
{
    const Energy& energy = dynamics.energy();
    const double given = std::abs(energy.external) + std::abs(energy.friction);
    const double little = 1e-4 * dynamics.static_normal_force();
    return !std::isfinite(energy.kinetic) || energy.contact_normal > little + 0.05 * given ||
           -energy.numerical > little + 10.0 * given;
}

} // namespace

long PassSteps::rows(double time) const
{
    return static_cast<long>(std::ceil(time / row - 1e-9));
}

double PassSteps::time(long row_before, int part) const
{
    return (static_cast<double>(row_before) + static_cast<double>(part) / parts) * row;
}

EarthquakePass::EarthquakePass(DynamicContact start, PlayedGround ground, const PassSteps& steps,
                               const Strength& at_start, const RunResult& so_far, PairSeries series,
                               double frame_interval, const std::optional<HistoryBefore>& before, SlideWatch watching,
                               const CrackLines& cracks, bool ends_when_lifts_wake)
    : steps_(steps), dynamics_(std::move(start)), ground_(std::move(ground)), strength_(at_start), result_(so_far),
      recorder_(before ? HistoryRecorder(dynamics_, result_.history, series, *before)
                       : HistoryRecorder(dynamics_, result_.history, series, frame_interval)),
      probe_(dynamics_.structure().planes(), so_far.rest(), dynamics_.state().contact.slip),
      watch_(std::move(watching)), cracks_(cracks), begin_(before ? before->time : 0.0), ends_when_lifts_wake_(ends_when_lifts_wake), record_rows_(steps.rows(ground_.end())),
      all_rows_(record_rows_ + steps.rows(steps.run_out)), rest_rows_(steps.rows(steps.rest_time)),
      shown_rows_(steps.rows(ground_.samples_end()))
{
    if (before) dynamics_.count_slips_from(before->slip_zero);
    result_.dt = steps.step();
    result_.status = Status::sliding_at_end;
    if (!before) result_.events.clear(); // of a coarser pass
    if (const MotionEvent* event = ground_.event())
        result_.events.push_back({event->name, 0.0, ground_.end(), 0.0, 0.0});
    if (!before) result_.cracks = cracks.none_yet();
    watch_.add(probe_.instant(dynamics_, strength_.law()));
    look_for_cracks();
    recorder_.reserve(static_cast<std::size_t>(record_rows_) + 1);
    add_row();
    going_ = all_rows_ > 0;
}

void EarthquakePass::after_step()
{
    strength_.follow(dynamics_.state().contact);
    watch_.add(probe_.instant(dynamics_, strength_.law()));
    look_for_cracks();
}

void EarthquakePass::look_for_cracks()
{
    const DynamicState& now = dynamics_.state();
    const auto* bond = now.contact.laws.find<BondLaw>();
    cracks_.look(begin_ + now.time, now.u, now.v, bond ? &bond->damage() : nullptr, result_.cracks);
}

void EarthquakePass::add_row()
{
    recorder_.add();
    watch_.add_row(result_.history.slide);
}

void EarthquakePass::end(Status status)
{
    result_.status = status;
    going_ = false;
}

void EarthquakePass::after_row(long n, bool stopped)
{
    add_row();
    if (stopped || (ends_when_lifts_wake_ && result_.cracks.wakes()))
        end(Status::interrupted);
    else if (!dynamics_.within_reach())
        end(Status::left_plane);
    else if (diverges(dynamics_))
        end(Status::diverged);
    else if (n + 1 >= record_rows_ + rest_rows_ && at_rest(result_.history, steps_.rest_time))
        rest(n);
    else if (watch_.self_excited())
        end(Status::self_excited);
    if (n + 1 >= all_rows_) going_ = false; // still sliding
}

/// The end, or of a sequence the pause before its next record.
void EarthquakePass::rest(long n)
{
    if (!ground_.more()) return end(Status::at_rest);
    if (at_rest_since_ < 0) at_rest_since_ = n + 1;
    if (n + 1 < at_rest_since_ + steps_.rows(ground_.pause())) return;
    result_.events.back().slip = result_.history.slip.back();
    ground_.next(static_cast<double>(n + 1) * steps_.row);
    result_.events.push_back({ground_.event()->name, ground_.start(), ground_.end(), 0.0, 0.0});
    watch_.next_record(ground_.end());
    record_rows_ = steps_.rows(ground_.end());
    all_rows_ = record_rows_ + steps_.rows(steps_.run_out);
    at_rest_since_ = -1;
}

RunResult& EarthquakePass::finish()
{
    recorder_.finish();
    result_.run_out = watch_.figures();
    result_.events_left = ground_.left();
    return result_;
}

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Hands over λ_c (ContactMemory::contact_force()) without a copy of it.
template <class Use>
auto with_contact_force(const ContactMemory& memory, const Use& use)
{
    return memory.laws.active() ? use(memory.force - memory.laws.force()) : use(memory.force);
}

} // namespace

SlideProbe::SlideProbe(const ContactPlanes& planes, const StageResult& rest, const VectorXd& start) : planes_(planes)
{
    balances_.push_back(rest.resultant);
    for (const PlaneBalance& lift : rest.lifts) balances_.push_back(lift.resultant);
    for (Index k = 0; k < planes.count(); ++k) start_.push_back(planes.mean(k, start));
}

double SlideProbe::sliding_factor(const ContactLaw& law) const
{
    double least = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < planes_.count(); ++k) {
        const Index first = planes_.first(k), pairs = planes_[k].main_pairs();
        const BaseResultant& r = balances_[static_cast<std::size_t>(k)];
        const double resistance =
            law.friction.segment(first, pairs).minCoeff() * r.normal_force + law.cohesion.segment(first, pairs).sum();
        if (std::abs(r.shear_force) > 1e-12 * r.normal_force) // of order N': round-off is no thrust
            least = std::min(least, resistance / std::abs(r.shear_force));
    }
    return least;
}

SlideInstant SlideProbe::instant(double time, const ContactMemory& contact, const ContactLaw& law,
                                 double friction) const
{
    SlideInstant now;
    now.time = time;
    now.friction = friction;
    for (Index k = 0; k < planes_.count(); ++k) {
        const auto plane = static_cast<std::size_t>(k);
        const double slip = planes_.mean(k, contact.slip) - start_[plane];
        if (k == 0) now.slip = slip;
        now.thrust_work += balances_[plane].shear_force * slip;
    }
    const Index base = planes_.base().pairs();
    now.normal_force = with_contact_force(contact, [&](const auto& force) { return force.head(base).sum(); });
    now.open = std::all_of(contact.states.begin(), contact.states.begin() + base,
                           [](ContactState state) { return state == ContactState::open; });
    now.sliding_factor = sliding_factor(law);
    return now;
}

SlideInstant SlideProbe::instant(const ContactMotion& dynamics, const ContactLaw& law) const
{
    const Energy& energy = dynamics.energy();
    SlideInstant now = instant(dynamics.state().time, dynamics.state().contact, law, energy.friction);
    now.other_losses = energy.damping + energy.radiated + energy.numerical;
    return now;
}

} // namespace damslip::fe2d
