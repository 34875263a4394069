#include "scene/uplift_models.hpp"

#include "scene/check.hpp"
#include "scene/water.hpp"

namespace damslip {

/// The models with a rule of their own for cracks: their profiles are those of sliding/uplift.
std::vector<UpliftRow> named_uplift_models()
{
    return {
        {.word = "none", .meaning = "", .needs = "", .named = UpliftModel::none},
        {.word = "linear", .meaning = "heel to toe, ruptured curtain", .needs = "", .named = UpliftModel::linear},
        {.word = "curtain",
         .meaning = "printed 2/3 rule",
         .needs = "a [curtain] with its distance_m",
         .there = [](const Scene& s) { return s.curtain.has_value(); },
         .named = UpliftModel::curtain},
        {.word = "drains",
         .meaning = "USACE",
         .needs = "a [drains] with its distance_m",
         .there = [](const Scene& s) { return s.drains.has_value(); },
         .named = UpliftModel::drains},
        {.word = "points",
         .meaning = "",
         .needs = "uplift.points_m",
         .there = [](const Scene& s) { return s.uplift && !s.uplift->points.empty(); },
         .named = UpliftModel::points},
        {.word = "seepage", .meaning = "Darcy solution", .needs = "", .named = UpliftModel::seepage},
    };
}

const UpliftRow& uplift_row(UpliftModel model)
{
    return uplift_rows()[std::size_t(model)];
}

bool reads_drains(UpliftModel model)
{
    return model == UpliftModel::drains || model == UpliftModel::seepage || uplift_row(model).by_drains;
}

const char* word(UpliftModel model)
{
    return uplift_row(model).word.c_str();
}

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
