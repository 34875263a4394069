#include "sliding/block/slip_steps.hpp"

#include "sliding/block/roots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace damslip::sliding {

namespace {

bool has_constant_sign(std::span<const double> c, double span)
{
    double rest = 0.0, power = span;
    for (std::size_t i = 1; i < c.size(); ++i, power *= span) rest += std::abs(c[i]) * power;
    return std::abs(c[0]) > rest;
}

/// All sign changes in (0, span), ascending.
std::vector<double> sign_changes(std::span<const double> c, double span)
{
    if (c.size() < 2 || has_constant_sign(c, span)) return {};
    std::vector<double> derivative(c.size() - 1);
    for (std::size_t i = 1; i < c.size(); ++i) derivative[i - 1] = static_cast<double>(i) * c[i];
    std::vector<double> ends = sign_changes(derivative, span);
    ends.push_back(span);
    std::vector<double> found;
    double lo = 0.0, f_lo = c[0];
    for (const double hi : ends) {
        const double f_hi = polynomial(c, hi);
        if ((f_lo < 0.0 && f_hi > 0.0) || (f_lo > 0.0 && f_hi < 0.0))
            found.push_back(bracketed_root([&](double x) { return polynomial(c, x); }, lo, hi));
        else if (f_lo == 0.0 && lo > 0.0)
            found.push_back(lo);
        lo = hi;
        f_lo = f_hi;
    }
    return found;
}

} // namespace

double first_fall_to_zero(std::span<const double> c, double span)
{
    // Zero coefficients at the low end are a root at x = 0 that is not asked for: divide it out.
    while (!c.empty() && c[0] == 0.0) c = c.subspan(1);
    if (c.empty()) return never;
    if (c[0] < 0.0) return 0.0;
    const std::vector<double> roots = sign_changes(c, span);
    if (!roots.empty()) return roots.front();
    return polynomial(c, span) <= 0.0 ? span : never;
}

namespace {

/// Sum over j of z^j/(2j+k)! : k = 0 is cosh(sqrt z) or cos(sqrt -z), k = 1 is sinh(sqrt z)/sqrt z or sin(sqrt -z)/sqrt
/// -z, and so on. For |z| <= 1 the sum has no cancellation to speak of, and unlike the sines it does not lose digits
/// for z -> 0.
double sine_sum(int k, double z)
{
    double term = 1.0;
    for (int i = 2; i <= k; ++i) term /= i;
    double sum = term;
    for (int i = k + 1; std::abs(term) > 1e-18 * std::abs(sum); i += 2) {
        term *= z / (static_cast<double>(i) * (i + 1));
        sum += term;
    }
    return sum;
}

} // namespace

SlopedStep::SlopedStep(const SlopedSlip& slip)
{
    closed_form_ = slip.mass_tn == 0.0 && slip.normal.now == slip.normal.end;
    if (closed_form_)
        set_closed_form(slip);
    else
        set_series(slip);
}

void SlopedStep::set_closed_form(const SlopedSlip& slip)
{
    rate_ = slip.rate;
    accel_ = (slip.drive.now - slip.cohesion - slip.friction * slip.normal.now) / slip.mass_tt;
    if (slip.from_rest) accel_ = std::max(accel_, 0.0);
    drift_ = (slip.drive.end - slip.drive.now) / slip.span / slip.mass_tt;
    kappa_ = -slip.slope * slip.normal.now / slip.mass_tt;
    length_ = slip.span;
    if (std::abs(kappa_) * length_ * length_ > 1.0) length_ = 1.0 / std::sqrt(std::abs(kappa_));
}

void SlopedStep::set_series(const SlopedSlip& slip)
{
    // w_0 = 0, w_1 = rate. With D = mass_tt + mass_tn mu and right side r = drive - cohesion - mu normal, D w'' = r
    // term by term: A_i = (r_i - sum_{j=1..i} D_j A_{i-j}) / D_0 and w_{i+2} = A_i / ((i+2)(i+1)).
    std::array<double, order + 1> mu{}, D{}, A{};
    const double drive_rate = (slip.drive.end - slip.drive.now) / slip.span;
    const double normal_rate = (slip.normal.end - slip.normal.now) / slip.span;
    w_[1] = slip.rate;
    for (int i = 0; i + 2 <= order; ++i) {
        mu[i] = i == 0 ? slip.friction : slip.slope * w_[i];
        D[i] = (i == 0 ? slip.mass_tt : 0.0) + slip.mass_tn * mu[i];
        double r = -mu[i] * slip.normal.now - (i > 0 ? mu[i - 1] * normal_rate : 0.0);
        if (i == 0) r += slip.drive.now - slip.cohesion;
        if (i == 1) r += drive_rate;
        for (int j = 1; j <= i; ++j) r -= D[j] * A[i - j];
        A[i] = r / D[0];
        if (i == 0 && slip.from_rest) A[0] = std::max(A[0], 0.0);
        w_[i + 2] = A[i] / (static_cast<double>(i + 2) * (i + 1));
    }
    length_ = length_to_round_off(std::span(A).first(order - 1), slip.span);
}

double SlopedStep::path(double h) const
{
    if (!closed_form_) return polynomial(w_, h);
    const double z = kappa_ * h * h;
    return h * (rate_ * sine_sum(1, z) + h * (accel_ * sine_sum(2, z) + h * drift_ * sine_sum(3, z)));
}

double SlopedStep::rate(double h) const
{
    if (!closed_form_) return polynomial(derivative(w_), h);
    const double z = kappa_ * h * h;
    return rate_ * sine_sum(0, z) + h * (accel_ * sine_sum(1, z) + h * drift_ * sine_sum(2, z));
}

double SlopedStep::accel(double h) const
{
    if (!closed_form_) return polynomial(derivative(derivative(w_)), h);
    const double z = kappa_ * h * h;
    return accel_ * sine_sum(0, z) + h * (drift_ + kappa_ * rate_) * sine_sum(1, z);
}

double SlopedStep::time_of_stop() const
{
    if (!closed_form_) {
        const std::vector<double> rate = derivative(w_);
        return first_fall_to_zero(rate, length_);
    }
    if (rate_ == 0.0 && (accel_ < 0.0 || (accel_ == 0.0 && drift_ <= 0.0))) return 0.0;
    // w'' is a combination of cosine and sine (or hyperbolic) over less than half a period: at most one sign change, so
    // the rate has one turn.
    double turn = length_;
    if ((accel(0.0) > 0.0) != (accel(length_) > 0.0))
        turn = bracketed_root([this](double h) { return accel(h); }, 0.0, length_);
    const auto rate_at = [this](double h) { return rate(h); };
    if (rate_ > 0.0 && rate(turn) <= 0.0) return bracketed_root(rate_at, 0.0, turn);
    if (rate(turn) > 0.0 && rate(length_) <= 0.0) return bracketed_root(rate_at, turn, length_);
    return never;
}

double SlopedStep::time_of_path(double target, double until) const
{
    return bracketed_root([&](double h) { return path(h) - target; }, 0.0, until);
}

double steady_ratio(const RateFriction& law, double rate)
{
    if (!law.active()) return 1.0;
    return law.kinetic_ratio + (1.0 - law.kinetic_ratio) * std::exp(-rate / *law.characteristic_rate);
}

bool lags(const RateFriction& law)
{
    return law.active() && (law.relaxation_time || law.relaxation_slip);
}

RatedStep::RatedStep(const RatedSlip& slip) : slip_(slip)
{
    expand(slip);
}

/// Term by term. With E = exp(-v/v_c): i E_i = -(1/v_c) Σ_j j v_j E_{i-j}; products of series are Cauchy's.
void RatedStep::expand(const RatedSlip& s)
{
    const double k = s.law.kinetic_ratio, v_c = *s.law.characteristic_rate;
    const double per_time = s.law.relaxation_time ? 1.0 / *s.law.relaxation_time : 0.0;
    const double per_slip = s.law.relaxation_slip ? 1.0 / *s.law.relaxation_slip : 0.0;
    const double drive_rate = (s.drive.end - s.drive.now) / s.span,
                 normal_rate = (s.normal.end - s.normal.now) / s.span;
    const bool lag = lags(s.law);
    Series v{}, decay{}, peak{}, steady{}, mu{}, mass{}, accel{};
    v[0] = w_[1] = s.moves ? s.rate : 0.0;
    const int last_term = s.moves ? order - 2 : order; // as far as the length of the step is judged by
    for (int i = 0; i <= last_term; ++i) {
        decay[i] = i == 0 ? std::exp(-v[0] / v_c) : 0.0;
        for (int j = 1; j <= i; ++j) decay[i] -= j * v[j] * decay[i - j] / (v_c * i);
        peak[i] = i == 0 ? s.friction : s.slope * w_[i];
        steady[i] = (i == 0 ? k : 0.0) + (1.0 - k) * decay[i];
        if (!lag) {
            ratio_[i] = steady[i];
        } else if (i == 0) {
            ratio_[0] = s.ratio;
        } else {
            double sum = per_time * (steady[i - 1] - ratio_[i - 1]);
            for (int j = 0; j < i; ++j) sum += per_slip * (steady[j] - ratio_[j]) * v[i - 1 - j];
            ratio_[i] = sum / i;
        }
        for (int j = 0; j <= i; ++j) mu[i] += peak[j] * ratio_[i - j];
        resistance_[i] = mu[i] * s.normal.now + (i > 0 ? mu[i - 1] * normal_rate : 0.0) + (i == 0 ? s.cohesion : 0.0);
        if (!s.moves) continue;
        mass[i] = (i == 0 ? s.mass_tt : 0.0) + s.mass_tn * mu[i];
        double force = (i == 0 ? s.drive.now : i == 1 ? drive_rate : 0.0) - resistance_[i];
        for (int j = 1; j <= i; ++j) force -= mass[j] * accel[i - j];
        accel[i] = force / mass[0];
        if (i == 0 && s.from_rest) accel[0] = std::max(accel[0], 0.0);
        v[i + 1] = accel[i] / (i + 1);
        w_[i + 2] = v[i + 1] / (i + 2);
    }
    // The last two terms stay below round-off of the largest one: of the acceleration, or of r where the block rests.
    const Series& watched = s.moves ? accel : ratio_;
    length_ = length_to_round_off(std::span(watched).first(static_cast<std::size_t>(last_term) + 1), s.span);
}

double RatedStep::path(double h) const
{
    return polynomial(w_, h);
}

double RatedStep::rate(double h) const
{
    return polynomial(derivative(w_), h);
}

double RatedStep::accel(double h) const
{
    return polynomial(derivative(derivative(w_)), h);
}

double RatedStep::ratio(double h) const
{
    return polynomial(ratio_, h);
}

double RatedStep::time_of_stop() const
{
    return first_fall_to_zero(derivative(w_), length_);
}

double RatedStep::time_of_path(double target, double until) const
{
    return bracketed_root([&](double h) { return path(h) - target; }, 0.0, until);
}

double RatedStep::time_of_start(double sign) const
{
    std::vector<double> holds(resistance_.begin(), resistance_.end());
    holds[0] -= sign * slip_.drive.now;
    holds[1] -= sign * (slip_.drive.end - slip_.drive.now) / slip_.span;
    if (holds[0] < 0.0) return 0.0;
    const double h = first_fall_to_zero(holds, length_);
    return h < slip_.span ? h : never;
}

namespace {

using std::numbers::pi;

/// Slip at which the bar has a stretch, on the side where moving along d lengthens (or shortens) it; the other end of the real
/// line where it never has.
double slip_at(const AnchorBar& bar, double stretch, double side)
{
    const double more = stretch * (2.0 * bar.length + stretch), start = bar.length * bar.sine;
    const double square = start * start + more; // (L sin ψ + s)²
    if (!(square >= 0.0)) return side > 0.0 ? -HUGE_VAL : HUGE_VAL;
    const double root = std::sqrt(square);
    // side root - start, without cancellation where they have the same sign.
    return side * start > 0.0 ? side * more / (root + side * start) : side * root - start;
}

/// Does a slide along d lengthen the bar? Yes at its shortest, round-off apart.
bool lengthens_along(const AnchorBar& bar, double d, double s)
{
    return d * (bar.length * bar.sine + s) >= -1e-12 * bar.length;
}

} // namespace

void BlockAnchor::face(double d, double s)
{
    if (history.state == AnchorState::snapped) return;
    const double at = bar.stretch(0.0, s), trial = history.trial_force(bar, at);
    const bool lengthens = lengthens_along(bar, d, s);
    const double round_off = 1e-13 * bar.axial_stiffness;
    if (lengthens && trial >= bar.yield_force - round_off)
        history.state = AnchorState::yields;
    else if (trial < -round_off || (trial <= round_off && !lengthens))
        history.state = AnchorState::slack;
    else
        history.state = AnchorState::elastic;
    if (bar.dowel > 0.0) {
        const double place = std::asin(std::clamp(trial / bar.yield_force, 0.0, 1.0)) / (0.5 * pi) * dowel_chords;
        chord = std::clamp(static_cast<int>(lengthens ? std::floor(place + 1e-9) : std::ceil(place - 1e-9) - 1.0), 0,
                           dowel_chords - 1);
    }
}

double BlockAnchor::next_change(double d, double s)
{
    next_ = Change::none;
    if (history.state == AnchorState::snapped) return never;
    double nearest = never;
    const bool lengthens = lengthens_along(bar, d, s);
    const auto look = [&](Change change, double strain) {
        const double stretch = bar.length * (strain - bar.prestress / bar.axial_stiffness);
        const double way = d * (slip_at(bar, stretch, lengthens ? d : -d) - s);
        if (!(way < nearest)) return;
        nearest = std::max(0.0, way);
        next_ = change;
    };
    if (!lengthens) { // its shortest length
        nearest = std::abs(bar.length * bar.sine + s);
        next_ = Change::turn;
    }
    const double slack_at = history.plastic_strain, yield_at = slack_at + bar.yield_strain();
    switch (history.state) {
    case AnchorState::elastic:
        look(lengthens ? Change::yields : Change::slack, lengthens ? yield_at : slack_at);
        if (bar.dowel > 0.0) {
            const DowelChord c = dowel_chord(chord);
            const bool last = lengthens ? chord + 1 == dowel_chords : chord == 0;
            if (!last) look(Change::chord, slack_at + bar.yield_strain() * (lengthens ? c.to : c.from));
        }
        break;
    case AnchorState::slack:
        if (lengthens) look(Change::tight, slack_at);
        break;
    case AnchorState::yields:
    case AnchorState::snapped:
        break;
    }
    if (lengthens && bar.rupture_strain) look(Change::snaps, *bar.rupture_strain);
    return nearest;
}

void BlockAnchor::change(double s, double time)
{
    switch (next_) {
    case Change::yields:
        history.state = AnchorState::yields;
        break;
    case Change::slack:
        history.state = AnchorState::slack;
        break;
    case Change::tight:
        history.state = AnchorState::elastic;
        break;
    case Change::snaps:
        go_to(s);
        history.snap(bar, time);
        break;
    case Change::none:
    case Change::chord:
    case Change::turn:
        break;
    }
}

void BlockAnchor::go_to(double s)
{
    history.stretch_to(bar, bar.stretch(0.0, s));
}

double BlockAnchor::tangential(double s) const
{
    return history.force * bar.direction(0.0, s).along;
}

double BlockAnchor::normal(double s) const
{
    return history.force * bar.direction(0.0, s).normal;
}

double BlockAnchor::dowel() const
{
    if (bar.dowel == 0.0 || history.state == AnchorState::snapped) return 0.0;
    return bar.dowel * dowel_share(history.force / bar.yield_force);
}

namespace {

/// Σ_{j=0..i} a_j b_{i-j}
template <class Series>
double product(const Series& a, const Series& b, int i)
{
    double sum = 0.0;
    for (int j = 0; j <= i; ++j) sum += a[j] * b[i - j];
    return sum;
}

/// One bar as series in time, term by term behind the slip's.
template <class Series>
class BarSeries {
public:
    BarSeries(const BlockAnchor& anchor, double s) : a_(anchor), s_(s) {}

    /// Term i of N sin ψ', N cos ψ', D. @param slip  terms of s up to i
    void next(const Series& slip, int i)
    {
        const AnchorBar& bar = a_.bar;
        const AnchorState state = a_.history.state;
        if (state == AnchorState::snapped) return;
        if (state == AnchorState::slack) {
            if (i == 0) dowel[0] = bar.dowel;
            return;
        }
        u_[i] = slip[i] + (i == 0 ? bar.length * bar.sine : 0.0);
        const double across = bar.length * bar.cosine;
        double square = product(u_, u_, i) + (i == 0 ? across * across : 0.0); // of l²
        if (i == 0) {
            length_[0] = std::sqrt(square);
            inverse_[0] = 1.0 / length_[0];
        } else {
            for (int j = 1; j < i; ++j) square -= length_[j] * length_[i - j];
            length_[i] = square / (2.0 * length_[0]);
            double sum = 0.0;
            for (int j = 1; j <= i; ++j) sum += length_[j] * inverse_[i - j];
            inverse_[i] = -sum / length_[0];
        }
        if (state == AnchorState::yields)
            force_[i] = i == 0 ? bar.yield_force : 0.0;
        else
            force_[i] = i == 0 ? a_.history.trial_force(bar, bar.stretch(0.0, s_)) : bar.stiffness() * length_[i];
        sine_[i] = product(u_, inverse_, i);
        tangential[i] = product(force_, sine_, i);
        normal[i] = across * product(force_, inverse_, i);
        if (bar.dowel > 0.0 && state == AnchorState::elastic) {
            const DowelChord c = dowel_chord(a_.chord);
            dowel[i] = bar.dowel * (c.per_share * force_[i] / bar.yield_force + (i == 0 ? c.constant : 0.0));
        }
    }

    Series tangential{}, normal{}, dowel{};

private:
    const BlockAnchor& a_;
    double s_;
    Series u_{}, length_{}, inverse_{}, force_{}, sine_{};
};

} // namespace

AnchoredStep::AnchoredStep(const AnchoredSlip& anchored, std::span<const BlockAnchor> anchors)
    : touching_(anchored.touching)
{
    const SlopedSlip& slip = anchored.slip;
    const double d = anchored.direction, ratio = slip.mass_tn / slip.mass_tt;
    const double drive_rate = (slip.drive.end - slip.drive.now) / slip.span;
    const double normal_rate = (slip.normal.end - slip.normal.now) / slip.span;
    std::vector<BarSeries<Series>> bars;
    for (const BlockAnchor& anchor : anchors) bars.emplace_back(anchor, anchored.slip_now);

    // As SlopedStep: with D = mass_tt + mass_tn mu, D w'' = right side, term by term; s = s_now + d w.
    Series mu{}, mass{}, accel{}, drive{}, normal{}, s{};
    w_[1] = slip.rate;
    int terms = 0; // of accel
    for (int i = 0; i <= order; ++i) {
        s[i] = (i == 0 ? anchored.slip_now : 0.0) + d * w_[i];
        drive[i] = i == 0 ? slip.drive.now + d * anchored.initial_tangential : i == 1 ? drive_rate : 0.0;
        normal[i] = i == 0 ? slip.normal.now - anchored.initial_normal : i == 1 ? normal_rate : 0.0;
        double held = i == 0 ? slip.cohesion : 0.0;
        for (BarSeries<Series>& bar : bars) {
            bar.next(s, i);
            drive[i] -= d * bar.tangential[i];
            normal[i] += bar.normal[i];
            held += bar.dowel[i];
        }
        free_normal_[i] = normal[i] + ratio * drive[i];
        if (i + 2 > order) continue;
        double right = drive[i];
        if (touching_) {
            mu[i] = i == 0 ? slip.friction : slip.slope * w_[i];
            mass[i] = (i == 0 ? slip.mass_tt : 0.0) + slip.mass_tn * mu[i];
            right -= held + product(mu, normal, i);
        } else {
            mass[i] = i == 0 ? slip.mass_tt : 0.0;
        }
        for (int j = 1; j <= i; ++j) right -= mass[j] * accel[i - j];
        accel[i] = right / mass[0];
        if (i == 0 && slip.from_rest) accel[0] = std::max(accel[0], 0.0);
        w_[i + 2] = accel[i] / (static_cast<double>(i + 2) * (i + 1));
        terms = i + 1;
    }
    for (const BarSeries<Series>& bar : bars) dowels_.push_back(bar.dowel);

    length_ = length_to_round_off(std::span(accel).first(static_cast<std::size_t>(terms)), slip.span);
}

double AnchoredStep::path(double h) const
{
    return polynomial(w_, h);
}

double AnchoredStep::rate(double h) const
{
    return polynomial(derivative(w_), h);
}

double AnchoredStep::accel(double h) const
{
    return polynomial(derivative(derivative(w_)), h);
}

double AnchoredStep::time_of_stop() const
{
    return first_fall_to_zero(derivative(w_), length_);
}

double AnchoredStep::time_of_path(double target, double until) const
{
    return bracketed_root([&](double h) { return path(h) - target; }, 0.0, until);
}

double AnchoredStep::time_of_contact_change() const
{
    // The state says on which side of zero N' is now, whatever round-off says just after an event.
    Series side = free_normal_;
    if (!touching_)
        for (double& term : side) term = -term;
    side[0] = std::max(side[0], 0.0);
    return first_fall_to_zero(side, length_);
}

double AnchoredStep::dowel_work(std::size_t k, double h) const
{
    if (!touching_) return 0.0;
    // ∫ D w' dh
    const std::vector<double> rate = derivative(w_);
    const Series& dowel = dowels_[k];
    double sum = 0.0;
    for (std::size_t i = 0; i < dowel.size(); ++i) {
        if (dowel[i] == 0.0) continue;
        for (std::size_t j = 0; j < rate.size(); ++j)
            sum += dowel[i] * rate[j] * std::pow(h, static_cast<double>(i + j + 1)) / static_cast<double>(i + j + 1);
    }
    return sum;
}

} // namespace damslip::sliding
