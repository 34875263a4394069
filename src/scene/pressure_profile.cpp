#include "scene/pressure_profile.hpp"

namespace damslip {

namespace {

double between(const ProfilePoint& a, const ProfilePoint& b, double distance)
{
    return a.pressure + (b.pressure - a.pressure) * (distance - a.distance) / (b.distance - a.distance);
}

} // namespace

UpliftResultant resultant(const PressureProfile& profile)
{
    UpliftResultant sum;
    for (std::size_t i = 0; i + 1 < profile.points.size(); ++i) {
        const ProfilePoint &a = profile.points[i], &b = profile.points[i + 1];
        const double length = b.distance - a.distance;
        sum.force += 0.5 * length * (a.pressure + b.pressure);
        sum.moment_about_heel +=
            length / 6.0 *
            (a.pressure * (2.0 * a.distance + b.distance) + b.pressure * (a.distance + 2.0 * b.distance));
    }
    return sum;
}

double pressure_at(const PressureProfile& profile, double distance)
{
    const auto& p = profile.points;
    if (p.empty() || distance < p.front().distance || distance > p.back().distance) return 0.0;
    if (distance == p.front().distance) return p.front().pressure;
    for (std::size_t i = 0; i + 1 < p.size(); ++i)
        if (p[i].distance < distance && distance <= p[i + 1].distance) return between(p[i], p[i + 1], distance);
    return p.back().pressure;
}

std::vector<ProfilePoint> part(const PressureProfile& profile, double from, double to)
{
    std::vector<ProfilePoint> out;
    const auto& p = profile.points;
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
        const ProfilePoint &a = p[i], &b = p[i + 1];
        if (b.distance <= from || a.distance >= to || b.distance == a.distance) continue;
        const ProfilePoint left = a.distance < from ? ProfilePoint{from, between(a, b, from)} : a;
        const ProfilePoint right = b.distance > to ? ProfilePoint{to, between(a, b, to)} : b;
        if (out.empty() || out.back() != left) out.push_back(left);
        out.push_back(right);
    }
    return out;
}

} // namespace damslip
