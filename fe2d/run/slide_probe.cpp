#include "fe2d/run/slide_probe.hpp"

#include "fe2d/run/base_water.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

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
        const Index first = planes_.first(k), pairs = planes_[k].pairs();
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

double friction_work(const ContactMemory& before, const ContactMemory& after)
{
    const Index m = after.slip.size();
    return with_contact_force(before, [&](const auto& of_before) {
        return with_contact_force(after, [&](const auto& of_after) {
            return -0.5 * (of_before.tail(m) + of_after.tail(m)).dot(after.slip - before.slip);
        });
    });
}

} // namespace damslip::fe2d
