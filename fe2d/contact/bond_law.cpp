#include "fe2d/contact/bond_law.hpp"
#include "fe2d/solver/dense_product.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double damage_tolerance = 1e-9; ///< |κ - ε| of a solution [-]
constexpr double step_damage_tolerance =
    1e-7; ///< the same within a step in time: of its strength a pair is off by this share
/// After so many solutions of a step damage only grows from one to the next, which ends for certain.
constexpr int free_solutions = 40;
/// Damage beyond the strain that a step may keep then; else it is too long [-].
constexpr double largest_overshoot = 1e-3;
constexpr int most_solutions = 400;
constexpr int most_solutions_of_step = 100; ///< then a step in time is better made in halves
constexpr int most_tangents = 40;           ///< the same where all pairs are found by Newton's iteration
/// Where a bond has no strength across the joint, tension beyond this share of its shear strength parts it: round-off [-].
constexpr double no_tension = 1e-9;

double square(double x)
{
    return x * x;
}

/// Share of the strength at which exponential softening ends: the law is moved down by it, and its w_I is 0.7 % longer for that, so
/// that it costs G. Of the strength it differs by 0.2 % from exp(-w f/G).
constexpr double end_of_tail = 1e-3;
const double decay = -std::log(end_of_tail);

} // namespace

double BondStrength::left(double damage) const
{
    if (softening == BondSoftening::linear) return 1.0 - damage;
    return (std::exp(-decay * damage) - end_of_tail) / (1.0 - end_of_tail);
}

double BondStrength::slope(double damage) const
{
    return softening == BondSoftening::linear ? 1.0 : decay * std::exp(-decay * damage) / (1.0 - end_of_tail);
}

double BondStrength::work(double damage) const
{
    if (softening == BondSoftening::linear) return damage - 0.5 * damage * damage;
    return (-std::expm1(-decay * damage) / decay - end_of_tail * damage) / (1.0 - end_of_tail);
}

double BondStrength::spent(double damage) const
{
    if (softening == BondSoftening::linear) return damage;
    return (work(damage) - 0.5 * damage * left(damage)) / work(1.0);
}

double BondStrength::damage_at(double softness) const
{
    if (softening == BondSoftening::linear) return 1.0 / (1.0 + softness);
    double damage = 0.0; // left(κ) - h κ is convex and falls: Newton's iteration comes up to its zero from 0
    for (int k = 0; k < 100; ++k) {
        const double step = (left(damage) - softness * damage) / (slope(damage) + softness);
        damage += step;
        if (step <= 1e-15) break;
    }
    return std::min(damage, 1.0);
}

BondStrength bond_strength(double area, double friction, double cohesion, const Bond& bond)
{
    BondStrength b;
    b.area = area;
    b.friction = friction;
    b.unloading = bond.unloading;
    b.softening = bond.softening;
    b.increase = bond.dynamic_increase;
    b.tension = bond.tensile_strength * area;
    b.shear = cohesion * area;
    if (b.tension > 0.0) {
        b.tension_energy = bond.tension_energy.value() * area;
        b.opening = b.tension_energy / (b.work(1.0) * b.tension);
    }
    if (b.shear > 0.0) {
        b.shear_energy = bond.shear_energy.value() * area;
        b.slip = b.shear_energy / (b.work(1.0) * b.shear);
    }
    if (b.tension == 0.0) b.opening = b.slip;
    if (b.shear == 0.0) b.slip = b.opening;
    return b;
}

BondLaw::BondLaw(std::vector<BondStrength> pairs, double first_damage)
    : strength_(std::move(pairs)), smallest_damage_(first_damage)
{
    const auto m = static_cast<Index>(strength_.size());
    damage_ = reference_ = path_ = start_damage_ = slip_ = VectorXd::Zero(m);
    for (Index i = 0; i < m; ++i)
        if (!strength_[static_cast<std::size_t>(i)].any()) damage_[i] = 1.0;
    yield_.assign(strength_.size(), Yield::none);
    at_.resize(strength_.size());
}

double BondLaw::Strain::size() const
{
    return std::hypot(across, along);
}

bool BondLaw::plastic(Index pair) const
{
    const BondStrength& b = strength_[static_cast<std::size_t>(pair)];
    return b.unloading == BondUnloading::plastic && b.shear > 0.0;
}

double BondLaw::initial_stiffness(Index pair) const
{
    const BondStrength& b = strength_[static_cast<std::size_t>(pair)];
    return b.softness(smallest_damage_) * b.shear / b.slip;
}

double BondLaw::smallest(Index pair) const
{
    return smallest_damage_ * 2.0 * strength_[static_cast<std::size_t>(pair)].work(1.0);
}

void BondLaw::set_motion(bool moving)
{
    if (moving == moving_) return;
    moving_ = moving;
    for (Index i = 0; i < damage_.size(); ++i) {
        BondStrength& b = strength_[static_cast<std::size_t>(i)];
        const double factor = moving ? b.increase : 1.0 / b.increase;
        if (factor == 1.0) continue;
        for (double* x : {&b.tension, &b.shear, &b.tension_energy, &b.shear_energy}) *x *= factor;
        if (damage_[i] > 0.0 && damage_[i] < 1.0) damage_[i] = b.damage_at(b.softness(damage_[i]) / factor);
    }
    start_damage_ = damage_;
}

/// Slip from where the bond of plastic unloading carries no shear [m].
double BondLaw::elastic_slip(Index pair, const ContactSolution& solution) const
{
    return slip_[pair] + solution.displacement[solution.displacement.size() / 2 + pair] - reference_[pair];
}

BondLaw::Strain BondLaw::strain(Index pair, const ContactSolution& solution) const
{
    const BondStrength& b = strength_[static_cast<std::size_t>(pair)];
    const double across = std::max(0.0, solution.displacement[pair]) / b.opening;
    const double slip = elastic_slip(pair, solution);
    if (!plastic(pair)) return {across, slip / b.slip};
    const double limit = b.shear * (1.0 - damage_[pair]) / initial_stiffness(pair);
    const double yielded =
        yield_[static_cast<std::size_t>(pair)] == Yield::none ? 0.0 : std::max(0.0, std::abs(slip) - limit);
    return {across, (path_[pair] + yielded) / b.slip};
}

double BondLaw::first_damage(Index pair, const ContactSolution& solution) const
{
    const BondStrength& b = strength_[static_cast<std::size_t>(pair)];
    const Index m = damage_.size();
    const double normal = solution.force[pair], tension = std::max(0.0, -normal),
                 shear = std::max(0.0, std::abs(solution.force[m + pair]) - b.friction * std::max(0.0, normal));
    const double scale = b.tension + b.shear;
    const auto share = [scale](double force, double strength) {
        return force / (strength > 0.0 ? strength : no_tension * scale);
    };
    return std::hypot(share(tension, b.tension), share(shear, b.shear));
}

/// G_I ε_n² + G_II ε_s² of the pair [J/m].
double BondLaw::energy_of(Index pair, const Strain& e) const
{
    const BondStrength& b = strength_[static_cast<std::size_t>(pair)];
    return b.tension_energy * square(e.across) + b.shear_energy * square(e.along);
}

bool BondLaw::by_tangent(Index pair) const
{
    return !static_ && !held_ && !plastic(pair);
}

double BondLaw::least_damage(Index pair) const
{
    return std::max(start_damage_[pair], smallest(pair));
}

BondLaw::Pull BondLaw::pull(Index pair, const Strain& e) const
{
    const BondStrength& b = strength_[static_cast<std::size_t>(pair)];
    const double size = e.size(), least = least_damage(pair), damage = std::max(size, least), h = b.softness(damage);
    if (size >= 1.0 || least >= 1.0) return {};
    Pull p{b.tension * h * e.across, b.shear * h * e.along, h, 0.0, 0.0, h};
    if (size > least) { // it softens: h falls with ε
        const double a = e.across / size, t = e.along / size;
        const double fall = b.softening == BondSoftening::linear ? 1.0 : b.left(size) + size * b.slope(size);
        p.nn -= a * a * fall / size;
        p.tt -= t * t * fall / size;
        p.nt = p.tn = -a * t * fall / size;
    }
    p.nn *= b.tension / b.opening;
    p.nt *= b.tension / b.slip;
    p.tn *= b.shear / b.opening;
    p.tt *= b.shear / b.slip;
    return p;
}

void BondLaw::begin(const JointStart& start)
{
    if (!held_) start_damage_ = damage_;
    slip_ = start.slip;
    static_ = start.dt == 0.0;
    stiffness_ = start.stiffness;
    yield_.assign(strength_.size(), Yield::none);
    tried_damage_ = damage_;
    tried_strain_ = VectorXd::Constant(damage_.size(), -1.0);
    solutions_ = 0;
}

void BondLaw::add(JointTerms& terms) const
{
    const Index m = damage_.size();
    for (Index i = 0; i < m; ++i) {
        const BondStrength& b = strength_[static_cast<std::size_t>(i)];
        if (!b.any() || damage_[i] >= 1.0) continue;
        if (damage_[i] == 0.0) {
            terms.bonded[static_cast<std::size_t>(i)] = 1;
            continue;
        }
        if (by_tangent(i)) {
            add_tangent(i, terms);
            continue;
        }
        const double h = b.softness(damage_[i]);
        terms.diagonal[i] += h * b.tension / b.opening;
        const Yield yield = yield_[static_cast<std::size_t>(i)];
        if (yield != Yield::none) {
            terms.force[m + i] += static_cast<double>(yield) * b.shear * (1.0 - damage_[i]);
            continue;
        }
        const double along = plastic(i) ? initial_stiffness(i) : h * b.shear / b.slip;
        terms.diagonal[m + i] += along;
        terms.force[m + i] += along * (slip_[i] - reference_[i]);
    }
}

void BondLaw::add_tangent(Index pair, JointTerms& terms) const
{
    const BondStrength& b = strength_[static_cast<std::size_t>(pair)];
    const Index slip = damage_.size() + pair;
    const Strain& e = at_[static_cast<std::size_t>(pair)];
    const Pull p = pull(pair, e);
    const double opening = e.across * b.opening, from_start = e.along * b.slip + reference_[pair] - slip_[pair];
    terms.diagonal[pair] += p.nn;
    terms.diagonal[slip] += p.tt;
    terms.cross[pair] += p.nt;
    terms.cross[slip] += p.tn;
    terms.force[pair] += p.across - p.nn * opening - p.nt * from_start;
    terms.force[slip] += p.along - p.tn * opening - p.tt * from_start;
}

/// Where κ = ε(κ) lies by the last two solutions, each pair by itself: the bond gives way by ε h(κ) + V ε = D, in its strength,
/// with the stiffness V that what is around shows it and the drive D; beyond V = 1 (exponential: D) it snaps through.
double BondLaw::guess(Index pair, double wanted, double strain) const
{
    const double before = tried_damage_[pair], now = damage_[pair], last = tried_strain_[pair];
    if (last < 0.0 || before == now || strain == last || plastic(pair)) return wanted;
    const BondStrength& b = strength_[static_cast<std::size_t>(pair)];
    const double around = (strain * b.softness(now) - last * b.softness(before)) / (last - strain);
    const double drive = strain * (around + b.softness(now));
    if (!std::isfinite(around) || around < 0.0) return wanted;
    if (b.softening == BondSoftening::exponential) {
        if (drive <= 1.0) return wanted;
        if (around <= drive) return 1.0;
        double balance = 1.0; // left(κ) + V κ - D is convex: Newton's iteration comes down to its zero from 1
        for (int k = 0; k < 50; ++k)
            balance -= (b.left(balance) + around * balance - drive) / (around - b.slope(balance));
        return balance;
    }
    if (drive > 1.0 && around <= 1.0) return 1.0;
    const double balance = (drive - 1.0) / (around - 1.0);
    return (balance - now) * (wanted - now) > 0.0 ? balance : wanted;
}

/// The bond yields where its trial force is beyond its strength, and sticks again where that turns round.
bool BondLaw::revise_yield(Index pair, const ContactSolution& solution)
{
    if (!plastic(pair)) return false;
    Yield& yield = yield_[static_cast<std::size_t>(pair)];
    const double strength = strength_[static_cast<std::size_t>(pair)].shear * (1.0 - damage_[pair]);
    const double trial = initial_stiffness(pair) * elastic_slip(pair, solution);
    const Yield wanted = std::abs(trial) <= strength * (1.0 + 1e-12) ? Yield::none
                         : trial > 0.0                               ? Yield::downstream
                                                                     : Yield::upstream;
    if (wanted == yield) return false;
    yield = wanted;
    return true;
}

/// A pair begins to soften in the direction of what it carries.
void BondLaw::break_first(Index pair, const ContactSolution& solution)
{
    const BondStrength& b = strength_[static_cast<std::size_t>(pair)];
    const double normal = solution.force[pair], shear = solution.force[damage_.size() + pair];
    const double tension = std::max(0.0, -normal),
                 over = std::max(0.0, std::abs(shear) - b.friction * std::max(0.0, normal));
    const double across = b.tension > 0.0 ? tension / b.tension : 0.0, along = b.shear > 0.0 ? over / b.shear : 0.0;
    const double size = std::hypot(across, along);
    const double first = damage_[pair] = smallest(pair);
    if (size > 0.0)
        at_[static_cast<std::size_t>(pair)] = {first * across / size, std::copysign(first * along / size, -shear)};
}

/// The bond fits where the line about the strains before gives its force at the new ones.
JointFit BondLaw::revise_tangent(Index pair, const ContactSolution& solution)
{
    const BondStrength& b = strength_[static_cast<std::size_t>(pair)];
    const Strain before = at_[static_cast<std::size_t>(pair)], now = strain(pair, solution);
    const Pull was = pull(pair, before), is = pull(pair, now);
    const double opening = (now.across - before.across) * b.opening, slip = (now.along - before.along) * b.slip;
    at_[static_cast<std::size_t>(pair)] = now;
    damage_[pair] = std::max(least_damage(pair), std::min(now.size(), 1.0));
    const bool fits =
        std::abs(was.across + was.nn * opening + was.nt * slip - is.across) <= step_damage_tolerance * b.tension &&
        std::abs(was.along + was.tn * opening + was.tt * slip - is.along) <= step_damage_tolerance * b.shear;
    return fits ? JointFit::fits : JointFit::changed;
}

JointFit BondLaw::revise_pair(Index pair, const ContactSolution& solution)
{
    const double now = damage_[pair];
    if (now == 0.0) {
        if (first_damage(pair, solution) <= 1.0 + 1e-10) return JointFit::fits;
        break_first(pair, solution);
        return JointFit::changed;
    }
    if (by_tangent(pair)) return revise_tangent(pair, solution);
    if (revise_yield(pair, solution)) return JointFit::changed;
    const double least = least_damage(pair);
    const double strain_now = strain(pair, solution).size();
    double wanted = std::clamp(strain_now, least, 1.0);
    if (solutions_ > free_solutions) wanted = std::max(wanted, now);
    if (std::abs(wanted - now) <= (static_ ? damage_tolerance : step_damage_tolerance)) return JointFit::fits;
    const double next = solutions_ > free_solutions ? wanted : std::clamp(guess(pair, wanted, strain_now), least, 1.0);
    tried_damage_[pair] = now;
    tried_strain_[pair] = strain_now;
    damage_[pair] = next;
    return JointFit::changed;
}

JointFit BondLaw::revise(const ContactSolution& solution)
{
    if (held_) return JointFit::fits;
    ++solutions_;
    JointFit fit = JointFit::fits;
    for (Index i = 0; i < damage_.size(); ++i)
        if (strength_[static_cast<std::size_t>(i)].any() && start_damage_[i] < 1.0)
            fit = std::max(fit, revise_pair(i, solution));
    if (fit == JointFit::changed) {
        const bool all_tangents = std::all_of(strength_.begin(), strength_.end(), [](const BondStrength& b) {
            return b.unloading == BondUnloading::origin || b.shear == 0.0;
        });
        const int most = static_ ? most_solutions : all_tangents ? most_tangents : most_solutions_of_step;
        return solutions_ < most ? fit : JointFit::too_far;
    }
    if (solutions_ > free_solutions)
        for (Index i = 0; i < damage_.size(); ++i)
            if (damage_[i] >
                std::max({strain(i, solution).size(), start_damage_[i], smallest(i)}) + largest_overshoot)
                return JointFit::too_far;
    return static_ || unique(solution) ? fit : JointFit::too_far;
}

/// Of the pairs whose damage has grown: their openings, and their slips.
bool BondLaw::unique(const ContactSolution& solution) const
{
    if (!stiffness_) return true;
    const Index m = damage_.size();
    std::vector<Index> breaking;
    std::vector<double> softening;
    for (Index i = 0; i < m; ++i) {
        const BondStrength& b = strength_[static_cast<std::size_t>(i)];
        if (!(damage_[i] > start_damage_[i]) || damage_[i] >= 1.0) continue;
        const double steepest = b.slope(least_damage(i));
        if (b.tension > 0.0 && solution.displacement[i] > 0.0) {
            breaking.push_back(i);
            softening.push_back(b.tension / b.opening * steepest);
        }
        if (b.shear > 0.0 && solution.displacement[m + i] != 0.0) {
            breaking.push_back(m + i);
            softening.push_back(b.shear / b.slip * steepest);
        }
    }
    if (breaking.empty()) return true;
    MatrixXd left = (*stiffness_)(breaking, breaking);
    left.diagonal() -= VectorXd::Map(softening.data(), left.rows());
    return left.llt().info() == Eigen::Success;
}

/// The next step begins with the tangent of a pair that softened, not with that of its unloading.
void BondLaw::goes_on_softening(Index pair)
{
    constexpr double beyond = 1.0 + 1e-9;
    Strain& e = at_[static_cast<std::size_t>(pair)];
    e = {beyond * e.across, beyond * e.along};
}

void BondLaw::end(const ContactSolution& solution)
{
    stored_ = 0.0;
    for (Index i = 0; i < damage_.size(); ++i) {
        const BondStrength& b = strength_[static_cast<std::size_t>(i)];
        if (!b.any() || (damage_[i] == 0.0 && start_damage_[i] == 0.0)) continue;
        const Strain e = strain(i, solution);
        const double size = e.size();
        const double mix = size > 0.0 ? energy_of(i, e) / square(size) : std::max(b.tension_energy, b.shear_energy);
        fracture_ += mix * (b.spent(damage_[i]) - b.spent(start_damage_[i]));
        if (damage_[i] > start_damage_[i]) goes_on_softening(i);
        if (plastic(i) && yield_[static_cast<std::size_t>(i)] != Yield::none) {
            const double limit = b.shear * (1.0 - damage_[i]) / initial_stiffness(i);
            const double slip = elastic_slip(i, solution), yielded = std::max(0.0, std::abs(slip) - limit);
            path_[i] += yielded;
            reference_[i] += std::copysign(yielded, slip);
        }
        if (damage_[i] < 1.0 && damage_[i] > 0.0 && !plastic(i))
            stored_ += b.softness(damage_[i]) * energy_of(i, e) / (2.0 * b.work(1.0));
    }
    start_damage_ = damage_;
    stiffness_ = nullptr;
}

JointEnergy BondLaw::energy() const
{
    JointEnergy e;
    e.stored = stored_;
    e.bond_fracture = fracture_;
    return e;
}

void BondLaw::save(JointLawState& state) const
{
    const auto list = [](const VectorXd& values) { return std::vector<double>(values.begin(), values.end()); };
    state["bond_damage"] = list(damage_);
    state["bond_reference_m"] = list(reference_);
    state["bond_path_m"] = list(path_);
    state["bond_fracture_J_m"] = {fracture_};
    state["bond_stored_J_m"] = {stored_};
}

void BondLaw::restore(const JointLawState& state)
{
    const auto vector = [&state](const char* key) {
        const std::vector<double>& values = state.at(key);
        return VectorXd(Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size())));
    };
    damage_ = start_damage_ = vector("bond_damage");
    reference_ = vector("bond_reference_m");
    path_ = vector("bond_path_m");
    fracture_ = state.at("bond_fracture_J_m").front();
    stored_ = state.at("bond_stored_J_m").front();
}

BondLengths BondLaw::lengths(Index first, Index pairs) const
{
    BondLengths sum;
    double run = 0.0; // broken pairs up to this one
    for (Index i = first; i < first + pairs; ++i) {
        const BondStrength& b = strength_[static_cast<std::size_t>(i)];
        if (!b.any()) continue;
        sum.bonded += b.area;
        if (damage_[i] > smallest(i)) sum.damaged += b.area;
        if (damage_[i] >= 1.0) sum.broken += b.area;
        run = damage_[i] >= 1.0 ? run + b.area : 0.0;
        if (sum.broken == sum.bonded) sum.upstream = run;
    }
    sum.downstream = run;
    return sum;
}

double BondLaw::broken(Index first, Index pairs) const
{
    double spent = 0.0, all = 0.0;
    for (Index i = first; i < first + pairs; ++i) {
        const BondStrength& b = strength_[static_cast<std::size_t>(i)];
        spent += b.spent(damage_[i]) * (b.tension_energy + b.shear_energy);
        all += b.tension_energy + b.shear_energy;
    }
    return all > 0.0 ? spent / all : 0.0;
}

VectorXd BondLaw::excess(const ContactSolution& solution) const
{
    VectorXd result = VectorXd::Zero(damage_.size());
    for (Index i = 0; i < damage_.size(); ++i) {
        if (!strength_[static_cast<std::size_t>(i)].any() || damage_[i] >= 1.0) continue;
        result[i] = damage_[i] == 0.0 ? first_damage(i, solution) : strain(i, solution).size() / damage_[i];
    }
    return result;
}

void BondLaw::damage_more(Index pair, double share)
{
    double& damage = damage_[pair];
    damage = damage == 0.0 ? smallest(pair) : std::min(1.0, (1.0 + share) * damage);
}

std::unique_ptr<BondLaw> BondLaw::released() const
{
    auto copy = std::make_unique<BondLaw>(*this);
    copy->held_ = false;
    return copy;
}

std::unique_ptr<BondLaw> BondLaw::held() const
{
    auto copy = std::make_unique<BondLaw>(*this);
    copy->held_ = true;
    return copy;
}

} // namespace damslip::fe2d
