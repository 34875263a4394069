#include "sliding/equilibrium/mouth_water.hpp"

#include "core/units.hpp"
#include "sliding/block/base_equations.hpp"
#include "sliding/equilibrium/shaken_base.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {

namespace {

constexpr int wet_knots = 33;
constexpr int tip_scan = 24;      // parts of what is still shut
constexpr int wet_scan = 8;       // parts of what is wet
constexpr int full_scan = 256;    // parts of a base
constexpr int mouth_v_steps = 10; // of 0.1 g, up and down

/// The part of [low, high] where `holds`, which does at low: its end, to round-off.
template <typename Holds>
double last_where(const Holds& holds, double low, double high)
{
    const double least = 1e-14 * std::max(std::abs(low), std::abs(high));
    while (high - low > least) {
        const double middle = low + 0.5 * (high - low);
        if (middle <= low || middle >= high) break;
        (holds(middle) ? low : high) = middle;
    }
    return low;
}

/// One end of the base, with water and crack of any lengths.
class WetEnd {
public:
    WetEnd(SlipDirection direction, const BaseState& before, const RigidBlock& block, CrackUplift uplift,
           const Force& per_a_h, const Force& per_a_v)
        : sign_(damslip::sliding::sign(direction)),
          side_(direction == SlipDirection::downstream ? Side::heel : Side::toe), length_(before.frame.length),
          first_(before.base.crack.side == side_ ? before.base.crack.length : 0.0), uplift_(std::move(uplift)),
          at_rest_(before.base.uplift.force), load_(base_load(before.frame, before.load)),
          per_a_h_(base_load(before.frame, per_a_h)), per_a_v_(base_load(before.frame, per_a_v)),
          equations_(base_equations(block)), friction_(block.friction), bond_(block.cohesion_force + block.dowel_force)
    {
    }

    double first() const { return first_; }
    double length() const { return length_; }

    /// Crack and water while the block rests.
    WetCrack at_rest(double a_h, double a_v, double wet) const
    {
        const PressureProfile full = profile(wet);
        if (!(normal(a_h, a_v) > resultant(full).force)) return {wet, length_, 0.0};
        const auto opens = [&](double x) { return sign_ * (a_h - accel(profile(x), x, x, a_v)) >= 0.0; };
        if (const double x = first_stop(opens, wet, wet_scan); x < wet) return {x, x, 0.0};
        const auto beyond = [&](double tip) { return sign_ * (a_h - accel(full, wet, tip, a_v)) >= 0.0; };
        if (!beyond(wet)) return {wet, wet, 0.0};
        const double most = shortest_ligament();
        return {wet, beyond(most) ? length_ : last_where(beyond, wet, most), 0.0};
    }

    /// Water that stood at `now` goes on through every crack up to `come`, or is driven back to the next one that holds it.
    double front(double a_h, double a_v, double now, double come) const
    {
        if (!(normal(a_h, a_v) > resultant(profile(come)).force)) return come;
        const double round_off = 1e-9 * (units::standard_gravity + std::abs(a_h));
        const auto opens = [&](double x) { return sign_ * (a_h - accel(profile(x), x, x, a_v)) >= -round_off; };
        const double start = std::max(first_, now), way = (opens(start) ? std::max(come, start) : first_) - start;
        double on = start;
        for (int k = 1; k <= wet_scan && way != 0.0; ++k) {
            const double x = start + way * k / wet_scan;
            if (opens(x) != (way > 0.0)) return way > 0.0 ? last_where(opens, on, x) : last_where(opens, x, on);
            on = x;
        }
        return on;
    }

    /// Where water stops while it slides: the crack is full of it.
    double furthest(double a_v) const
    {
        return first_stop([&](double x) { return excess(profile(x), x, x, a_v) < 0.0; }, shortest_ligament(),
                          full_scan);
    }

    /// Crack, water and uplift while it slides. @param wet  up to furthest()
    WetCrack sliding(double a_v, double wet) const
    {
        const PressureProfile full = profile(wet);
        const auto rests = [&](double tip) { return excess(full, wet, tip, a_v) < 0.0; };
        const double most = shortest_ligament();
        double shut = wet, open = most;
        for (int k = 1; k <= tip_scan; ++k) {
            const double tip = wet + (most - wet) * k / tip_scan;
            if (!rests(tip)) {
                open = tip;
                break;
            }
            shut = tip;
        }
        const double tip = shut == most ? length_ : last_where(rests, shut, open);
        return {wet, tip, uplift(full, wet, tip).force - at_rest_};
    }

private:
    /// How far up to `wet` it holds without a break: water goes through every crack in between.
    template <typename Holds>
    double first_stop(const Holds& holds, double wet, int parts) const
    {
        double on = first_;
        for (int k = 0; k <= parts; ++k) {
            const double x = first_ + (wet - first_) * k / parts;
            if (!holds(x)) return k == 0 ? first_ : last_where(holds, on, x);
            on = x;
        }
        return std::max(first_, wet);
    }
    double shortest_ligament() const { return length_ * (1.0 - 1e-9); }
    PressureProfile profile(double wet) const { return uplift_({side_, wet}); }
    double normal(double a_h, double a_v) const { return load_.normal + a_h * per_a_h_.normal + a_v * per_a_v_.normal; }

    /// Of the profile with nothing between water and tip.
    UpliftResultant uplift(const PressureProfile& full, double wet, double tip) const
    {
        if (!(tip > wet)) return resultant(full);
        const double from = side_ == Side::heel ? wet : length_ - tip, to = side_ == Side::heel ? tip : length_ - wet;
        PressureProfile dry{part(full, from, to)};
        const UpliftResultant all = resultant(full), gone = resultant(dry);
        return {all.force - gone.force, all.moment_about_heel - gone.moment_about_heel};
    }

    /// Ground acceleration of a tip.
    double accel(const PressureProfile& full, double wet, double tip, double a_v) const
    {
        const UpliftResultant u = uplift(full, wet, tip);
        const double shut = (length_ - tip) / 3.0, r = side_ == Side::heel ? length_ - shut : shut;
        return -(load_.moment_about_heel + a_v * per_a_v_.moment_about_heel + u.moment_about_heel +
                 r * (load_.normal + a_v * per_a_v_.normal - u.force)) /
               (per_a_h_.moment_about_heel + r * per_a_h_.normal);
    }

    /// Drive beyond the resistance at the acceleration of a tip [N/m].
    double excess(const PressureProfile& full, double wet, double tip, double a_v) const
    {
        const double a = accel(full, wet, tip, a_v), change = uplift(full, wet, tip).force - at_rest_;
        return sign_ * equations_.drive.at(a, a_v) - bond_ - friction_ * (equations_.normal.at(a, a_v) - change);
    }

    double sign_;
    Side side_;
    double length_, first_;
    CrackUplift uplift_;
    double at_rest_; ///< U before any motion [N/m]
    BaseLoad load_, per_a_h_, per_a_v_;
    BaseEquations equations_;
    double friction_, bond_;
};

/// Cracks of the sliding block over x_w, up to where it slides with a crack full of water, and a_v.
class CrackTable {
public:
    CrackTable(const WetEnd& end, const std::vector<double>& accel_v, const std::vector<double>& events)
        : accel_v_(accel_v)
    {
        for (const double a_v : accel_v_) {
            Row& row = rows_.emplace_back();
            const double last = end.furthest(a_v);
            for (int k = 0; k < wet_knots; ++k)
                row.wet.push_back(end.first() + (last - end.first()) * k / (wet_knots - 1));
            for (const double at : events)
                if (at > end.first() && at < last) {
                    row.wet.push_back(at * (1.0 - 1e-9));
                    row.wet.push_back(at);
                }
            std::sort(row.wet.begin(), row.wet.end());
            for (const double wet : row.wet) row.cracks.push_back(end.sliding(a_v, wet));
        }
    }

    WetCrack at(double a_v, double wet) const
    {
        const auto [row, share] = place(accel_v_, a_v);
        WetCrack crack = rows_[row].at(wet);
        if (share > 0.0) crack = between(crack, rows_[row + 1].at(wet), share);
        crack.wet = std::min(wet, crack.wet);
        return crack;
    }

private:
    struct Row {
        std::vector<double> wet;
        std::vector<WetCrack> cracks;

        WetCrack at(double x) const
        {
            const auto [k, share] = place(wet, x);
            return share > 0.0 ? between(cracks[k], cracks[k + 1], share) : cracks[k];
        }
    };
    static WetCrack between(const WetCrack& a, const WetCrack& b, double share)
    {
        return {a.wet + share * (b.wet - a.wet), a.tip + share * (b.tip - a.tip),
                a.change + share * (b.change - a.change)};
    }
    /// Value before x, and its share of the way to the next one.
    static std::pair<std::size_t, double> place(const std::vector<double>& grid, double x)
    {
        if (grid.size() < 2 || x <= grid.front()) return {0, 0.0};
        if (x >= grid.back()) return {grid.size() - 1, 0.0};
        const auto after = static_cast<std::size_t>(std::upper_bound(grid.begin(), grid.end(), x) - grid.begin());
        return {after - 1, (x - grid[after - 1]) / (grid[after] - grid[after - 1])};
    }

    std::vector<double> accel_v_;
    std::vector<Row> rows_; ///< by a_v
};

std::vector<double> from_the_toe(std::vector<double> events, double length)
{
    for (double& at : events) at = length - at;
    return events;
}

class MouthWater final : public SlowWater {
public:
    MouthWater(std::shared_ptr<const Scene> scene, WetEnd heel, WetEnd toe, double speed,
               const std::vector<double>& accel_v)
        : scene_(std::move(scene)), heel_(std::move(heel)), toe_(std::move(toe)), speed_(speed),
          heel_table_(heel_, accel_v, crack_events(*scene_)),
          toe_table_(toe_, accel_v, from_the_toe(crack_events(*scene_), toe_.length()))
    {
    }

    double speed() const override { return speed_; }
    double length() const override { return heel_.length(); }
    double first(SlipDirection direction) const override { return end(direction).first(); }
    WetCrack at_rest(SlipDirection direction, double a_h, double a_v, double wet) const override
    {
        return end(direction).at_rest(a_h, a_v, wet);
    }
    double front(SlipDirection direction, double a_h, double a_v, double now, double come) const override
    {
        return end(direction).front(a_h, a_v, now, come);
    }
    WetCrack sliding(SlipDirection direction, double a_v, double wet) const override
    {
        return (direction == SlipDirection::downstream ? heel_table_ : toe_table_).at(a_v, wet);
    }

private:
    const WetEnd& end(SlipDirection direction) const { return direction == SlipDirection::downstream ? heel_ : toe_; }

    std::shared_ptr<const Scene> scene_; ///< the uplift of both ends is read from it
    WetEnd heel_, toe_;
    double speed_;
    CrackTable heel_table_, toe_table_;
};

} // namespace

std::shared_ptr<const SlowWater> mouth_water(const Scene& scene, const StaticCase& static_case, const BaseState& before,
                                             const RigidBlock& block, double speed, bool vertical,
                                             const SeepageProfile& seepage)
{
    const auto kept = std::make_shared<const Scene>(scene);
    const AddedMassIntegral water = scene_added_mass(scene, static_case.loads.reservoir_level);
    const auto sum_of = [&](double a_h, double a_v) {
        Force sum;
        for (const Load& load : earthquake_loads(scene, water, a_h, a_v)) sum += load.force.total();
        return sum;
    };
    const bool solved = seepage && scene.uplift->model == UpliftModel::seepage;
    const CrackUplift uplift = crack_uplift(*kept, static_case.uplift, static_case.uplift_factor,
                                            solved ? fixed_profile(seepage(static_case.uplift)) : SeepageProfile{});
    const auto end = [&](SlipDirection direction) {
        return WetEnd(direction, before, block, uplift, sum_of(1.0, 0.0), sum_of(0.0, 1.0));
    };
    std::vector<double> accel_v{0.0};
    if (vertical)
        for (int k = 1; k <= mouth_v_steps; ++k)
            for (const int s : {-1, 1}) accel_v.push_back(0.1 * s * k * units::standard_gravity);
    std::sort(accel_v.begin(), accel_v.end());
    return std::make_shared<const MouthWater>(kept, end(SlipDirection::downstream), end(SlipDirection::upstream), speed,
                                              accel_v);
}

} // namespace damslip::sliding
