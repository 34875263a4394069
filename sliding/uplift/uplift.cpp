#include "sliding/uplift/uplift.hpp"

#include "core/input_error.hpp"
#include "scene/section.hpp"
#include "scene/uplift_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace damslip::sliding {

namespace {

/// The base with its water, seen from the end where the crack starts: s = 0 there.
struct Base {
    double length = 0.0;
    double unit_weight = 0.0;
    double first_y = 0.0, second_y = 0.0;       ///< elevations of the ends [m]
    double first_head = 0.0, second_head = 0.0; ///< above the heel [m]

    double elevation(double s) const { return first_y + (second_y - first_y) * s / length; }
    double pressure(double head, double s) const { return std::max(0.0, unit_weight * (head - elevation(s))); }
    double first_pressure() const { return pressure(first_head, 0.0); }
    double second_pressure() const { return pressure(second_head, length); }
};

Base base_of(const Scene& scene, const UpliftState& state, Side first)
{
    const double heel_y = heel(scene.section).y, toe_y = toe(scene.section).y;
    // A dry end has its own elevation as head, but never more than the wet end can supply.
    const double h1 = std::max(state.reservoir_level.value_or(heel_y), heel_y);
    const double h2 = std::max(state.tailwater_level.value_or(toe_y), toe_y);
    const double heel_head = h1 > heel_y ? h1 : std::min(heel_y, h2);
    const double toe_head = h2 > toe_y ? h2 : std::min(toe_y, h1);
    Base base{base_length(scene.section), water_unit_weight(scene), heel_y, toe_y, heel_head, toe_head};
    if (first == Side::toe) {
        std::swap(base.first_y, base.second_y);
        std::swap(base.first_head, base.second_head);
    }
    return base;
}

/// From the crack tip straight to the far end.
std::vector<ProfilePoint> linear(const Base& base, double tip)
{
    return {{tip, base.pressure(base.first_head, tip)}, {base.length, base.second_pressure()}};
}

std::vector<ProfilePoint> through(const Base& base, double tip, double at, double pressure)
{
    std::vector<ProfilePoint> points = linear(base, tip);
    points.insert(points.begin() + 1, {at, pressure});
    return points;
}

double linear_pressure(const Base& base, double tip, double at)
{
    const double p0 = base.pressure(base.first_head, tip), p1 = base.second_pressure();
    return p0 + (p1 - p0) * (at - tip) / (base.length - tip);
}

/// A crack that has come to the curtain is past it; without a crack a curtain at the very end of the base still works.
/// @param at  distance of the curtain from the first end
std::vector<ProfilePoint> with_curtain(const Base& base, double tip, double at, double ratio)
{
    if (tip > 0.0 && tip >= at) return linear(base, tip);
    const auto [low, high] = std::minmax({base.first_pressure(), base.second_pressure()});
    return through(base, tip, at, low + ratio * (high - low));
}

/// @param at  distance of the drains from the first end
std::vector<ProfilePoint> with_drains(const Base& base, double tip, double at, double efficiency,
                                      const std::optional<double>& gallery)
{
    if (tip >= at || efficiency <= 0.0) return linear(base, tip);
    const bool from_first = base.first_head >= base.second_head; // which way the water flows
    const double high = std::max(base.first_head, base.second_head);
    double low = std::min(base.first_head, base.second_head);
    if (gallery && *gallery > low) low = std::min(*gallery, high);
    const double way = base.length - tip; // from the crack tip to the other end
    const double share = from_first ? (base.length - at) / way : (at - tip) / way;
    const double head = low + (1.0 - efficiency) * (high - low) * share;
    return through(base, tip, at, std::min(base.pressure(head, at), linear_pressure(base, tip, at)));
}

void mirror(std::vector<ProfilePoint>& points, double length)
{
    std::reverse(points.begin(), points.end());
    for (ProfilePoint& p : points) p.distance = length - p.distance;
}

[[noreturn]] void refuse(const Scene& scene, std::string problem, std::string fix)
{
    throw InputError(Diagnostic{scene.file.string(), 0, 0, std::move(problem), "", std::move(fix)});
}

PressureProfile checked(const Scene& scene, PressureProfile profile, const char* what)
{
    const double length = base_length(scene.section), slack = 1e-9 * length;
    auto& p = profile.points;
    const bool sorted = std::is_sorted(p.begin(), p.end(), [](auto& a, auto& b) { return a.distance < b.distance; });
    if (p.size() < 2 || !sorted || std::abs(p.front().distance) > slack || std::abs(p.back().distance - length) > slack)
        refuse(scene, fmt::format("the {} uplift profile does not go from the heel to the toe.", what),
               fmt::format("give distances along the base in ascending order from 0 to {:g} m", length));
    p.front().distance = 0.0;
    p.back().distance = length;
    return profile;
}

PressureProfile point_profile(const Scene& scene, double heel_pressure)
{
    PressureProfile profile;
    for (const Point& p : scene.uplift->points) profile.points.push_back({p.x, p.y * heel_pressure});
    return checked(scene, std::move(profile), "uplift.points");
}

PressureProfile seepage_profile(const Scene& scene, const UpliftState& state, const SeepageProfile& seepage)
{
    if (!seepage)
        refuse(scene, "uplift.model = \"seepage\" without a seepage solution.",
               "use a command that solves the seepage, or another uplift.model");
    return checked(scene, seepage(state), "seepage");
}

PressureProfile row_profile(const Scene& scene, const UpliftRow& row, const Base& base, Side first)
{
    WetBase wet{base.length, base.first_pressure(), base.second_pressure()};
    if (first == Side::toe) std::swap(wet.heel_pressure, wet.toe_pressure);
    return checked(scene, row.profile(scene, wet), row.word.c_str());
}

/// Full head in the crack, the given profile beyond it.
std::vector<ProfilePoint> beyond_tip(const Base& base, PressureProfile profile, const Crack& crack)
{
    if (crack.side == Side::toe) mirror(profile.points, base.length);
    return crack.length > 0.0 ? part(profile, crack.length, base.length) : profile.points;
}

/// The profile beyond the crack tip, seen from the cracked end.
std::vector<ProfilePoint> uncracked_part(const Scene& scene, const UpliftState& state, const Base& base,
                                         const Crack& crack, const SeepageProfile& seepage)
{
    const auto from_first = [&](double distance) {
        return crack.side == Side::heel ? distance : base.length - distance;
    };
    const double heel_pressure = crack.side == Side::heel ? base.first_pressure() : base.second_pressure();
    if (scene.curtain && state.curtain == CurtainState::damaged && scene.uplift->model != UpliftModel::drains)
        return linear(base, crack.length);
    if (const UpliftRow& row = uplift_row(scene.uplift->model); row.profile) {
        if (row.by_drains && state.drains == DrainState::ineffective) return linear(base, crack.length);
        return beyond_tip(base, row_profile(scene, row, base, crack.side), crack);
    }
    switch (scene.uplift->model) {
    case UpliftModel::none:
    case UpliftModel::linear:
        break;
    case UpliftModel::curtain:
        if (!scene.curtain)
            refuse(scene, "uplift.model = \"curtain\" without a curtain.", "add a [curtain] with its distance_m");
        if (!scene.curtain->intact) break;
        return with_curtain(base, crack.length, from_first(scene.curtain->distance), scene.uplift->curtain_ratio);
    case UpliftModel::drains:
        if (!scene.drains) refuse(scene, "uplift.model = \"drains\" without drains.", "add [drains] with distance_m");
        if (state.drains == DrainState::ineffective) break;
        return with_drains(base, crack.length, from_first(scene.drains->distance), scene.drains->efficiency,
                           scene.drains->gallery_level);
    case UpliftModel::points:
        return beyond_tip(base, point_profile(scene, heel_pressure), crack);
    case UpliftModel::seepage:
        return beyond_tip(base, seepage_profile(scene, state, seepage), crack);
    }
    return linear(base, crack.length);
}

} // namespace

PressureProfile uplift_profile(const Scene& scene, const UpliftState& state, const Crack& crack,
                               const SeepageProfile& seepage)
{
    const double length = base_length(scene.section);
    if (!scene.uplift || scene.uplift->model == UpliftModel::none) return {{{0.0, 0.0}, {length, 0.0}}};
    Base base = base_of(scene, state, crack.side);
    if (crack.length >= length)
        base.first_head = std::max(base.first_head, base.second_head); // water enters at both ends
    PressureProfile profile;
    if (crack.length > 0.0) {
        const double tip = std::min(crack.length, length);
        profile.points = {{0.0, base.first_pressure()}, {tip, base.pressure(base.first_head, tip)}};
    }
    if (crack.length < length)
        for (const ProfilePoint& p : uncracked_part(scene, state, base, crack, seepage))
            if (profile.points.empty() || profile.points.back() != p) profile.points.push_back(p);
    if (crack.side == Side::toe) mirror(profile.points, length);
    // Per metre of dam: there is no joint between piers or buttresses.
    if (const double share = base_share(scene.section); share != 1.0)
        for (ProfilePoint& p : profile.points) p.pressure *= share;
    return profile;
}

std::vector<double> crack_events(const Scene& scene)
{
    std::vector<double> distances;
    if (!scene.uplift) return distances;
    if (scene.uplift->model == UpliftModel::curtain && scene.curtain) distances.push_back(scene.curtain->distance);
    if (scene.uplift->model == UpliftModel::drains && scene.drains) distances.push_back(scene.drains->distance);
    return distances;
}

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
