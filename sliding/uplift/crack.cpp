#include "sliding/uplift/uplift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace damslip::sliding {

namespace {

constexpr int samples_per_interval = 64;

/// N' and where it acts for one profile.
CrackedBase loaded(const BaseLoad& load, PressureProfile profile)
{
    CrackedBase base;
    base.uplift = resultant(profile);
    base.profile = std::move(profile);
    base.effective_normal = load.normal - base.uplift.force;
    // About the heel: loads + uplift + N' x distance = 0.
    base.resultant_distance = -(load.moment_about_heel + base.uplift.moment_about_heel) / base.effective_normal;
    if (base.effective_normal == 0.0) base.resultant_distance = std::numeric_limits<double>::quiet_NaN();
    return base;
}

/// Distance of N' from the end opposite to `side`.
double distance_from_compressed_end(const CrackedBase& base, Side side, double length)
{
    return side == Side::heel ? length - base.resultant_distance : base.resultant_distance;
}

/// Equilibrium at a given crack: the length that would have to be open; infinite where nothing can be compressed.
class Joint {
public:
    Joint(const BaseLoad& load, double length, const CrackUplift& uplift, Side side, double opened)
        : load_(load), length_(length), uplift_(&uplift), side_(side), opened_(opened)
    {
    }
    /// With the uplift of `closed`, whatever the crack.
    Joint(const BaseLoad& load, double length, const CrackedBase& closed, Side side)
        : load_(load), length_(length), closed_(&closed), side_(side), unchanged_(required_of(closed))
    {
    }

    CrackedBase state(double crack) const
    {
        const Crack wet{side_, std::max(crack, opened_)};
        CrackedBase base = closed_ ? *closed_ : loaded(load_, (*uplift_)(wet));
        base.crack = wet;
        return base;
    }
    double required(double crack) const { return closed_ ? unchanged_ : required_of(state(crack)); }
    double excess(double crack) const { return required(crack) - crack; }

private:
    double required_of(const CrackedBase& base) const
    {
        const double d = distance_from_compressed_end(base, side_, length_);
        return base.effective_normal > 0.0 && d > 0.0 ? length_ - 3.0 * d : std::numeric_limits<double>::infinity();
    }

    const BaseLoad& load_;
    double length_;
    const CrackUplift* uplift_ = nullptr;
    const CrackedBase* closed_ = nullptr;
    Side side_;
    double opened_ = 0.0;
    double unchanged_ = 0.0; ///< required(), where the uplift does not change
};

/// Between `longer_needed` (excess > 0) and `enough` (excess <= 0).
double bisect(const Joint& joint, double longer_needed, double enough)
{
    for (int k = 0; k < 200; ++k) {
        const double middle = longer_needed + 0.5 * (enough - longer_needed);
        if (middle <= longer_needed || middle >= enough) break;
        (joint.excess(middle) > 0.0 ? longer_needed : enough) = middle;
    }
    return enough;
}

/// Shortest crack with nothing more to open, scanning interval by interval; none: it runs through.
std::optional<double> shortest_crack(const Joint& joint, const std::vector<double>& bounds)
{
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
        double previous = bounds[i];
        if (joint.excess(previous) <= 0.0) return previous;
        const double last = std::nextafter(bounds[i + 1], 0.0); // just before the tip passes the next event
        for (int k = 1; k <= samples_per_interval; ++k) {
            const double next =
                k == samples_per_interval ? last : bounds[i] + (bounds[i + 1] - bounds[i]) * k / samples_per_interval;
            if (joint.excess(next) <= 0.0) return bisect(joint, previous, next);
            previous = next;
        }
    }
    return std::nullopt;
}

std::vector<double> scan_bounds(std::vector<double> events, Side side, double length)
{
    for (double& d : events) d = side == Side::heel ? d : length - d;
    std::erase_if(events, [&](double d) { return !(d > 0.0 && d < length); });
    events.push_back(0.0);
    events.push_back(length);
    std::sort(events.begin(), events.end());
    return events;
}

/// The end away from the resultant opens; without any N' left the heel does.
Side opening_side(const CrackedBase& closed, double length)
{
    const bool toe_opens = closed.effective_normal > 0.0 && closed.resultant_distance < 0.5 * length;
    return toe_opens ? Side::toe : Side::heel;
}

CrackedBase cracked_joint(const Joint& joint, const std::vector<double>& bounds, Side side, double length)
{
    const std::optional<double> crack = shortest_crack(joint, bounds);
    CrackedBase base = joint.state(crack.value_or(length));
    base.compressed_length = crack ? length - *crack : 0.0;
    base.compressed_side = side == Side::heel ? Side::toe : Side::heel;
    base.status = !crack ? CrackStatus::open : *crack > 0.0 ? CrackStatus::partial : CrackStatus::closed;
    return base;
}

} // namespace

bool cracked_through(const CrackedBase& base, double length)
{
    constexpr double least_share = 0.02, greatest_pressure = 50e6; // [-], [Pa]
    if (base.status != CrackStatus::partial || !(base.compressed_length > 0.0)) return false;
    return base.compressed_length < least_share * length ||
           2.0 * base.effective_normal / base.compressed_length > greatest_pressure;
}

CrackedBase uncracked_base(const BaseLoad& load, double length, const PressureProfile& profile)
{
    CrackedBase base = loaded(load, profile);
    base.compressed_length = length;
    return base;
}

CrackedBase cracked_base(const BaseLoad& load, double length, const CrackUplift& uplift, const Crack& opened,
                         const std::vector<double>& events)
{
    const CrackedBase closed = loaded(load, uplift(opened));
    const Side side = opening_side(closed, length);
    const bool other_end = opened.length > 0.0 && side != opened.side;
    const Joint joint =
        other_end ? Joint(load, length, closed, side) : Joint(load, length, uplift, side, opened.length);
    CrackedBase base = cracked_joint(joint, scan_bounds(events, side, length), side, length);
    if (other_end) base.crack = opened;
    return base;
}

CrackedBase cracked_base_unchanged(const BaseLoad& load, double length, const PressureProfile& profile)
{
    const CrackedBase closed = loaded(load, profile);
    const Side side = opening_side(closed, length);
    return cracked_joint(Joint(load, length, closed, side), scan_bounds({}, side, length), side, length);
}

} // namespace damslip::sliding
