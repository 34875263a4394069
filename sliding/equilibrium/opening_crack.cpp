#include "sliding/equilibrium/base_state.hpp"

#include "core/units.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/roots.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace damslip::sliding {

namespace {

constexpr int table_steps = 100; // of a_v to 1 g
constexpr int wet_steps = 25;    // the same, of the coarser table of water on its way
constexpr int wet_knots = 16;    // parts of x_w of the coarser table
constexpr int tip_scan = 12;      // parts of what is still shut
constexpr int rest_knots = 257;
constexpr int full_scan = 256;    // parts of a base

/// Value before x, and its share of the way to the next one.
std::pair<std::size_t, double> place(const std::vector<double>& grid, double x)
{
    if (grid.size() < 2 || x <= grid.front()) return {0, 0.0};
    if (x >= grid.back()) return {grid.size() - 2, 1.0};
    const auto after = static_cast<std::size_t>(std::upper_bound(grid.begin(), grid.end(), x) - grid.begin());
    return {after - 1, (x - grid[after - 1]) / (grid[after] - grid[after - 1])};
}

/// From first to last in equal steps, and both sides of every event between.
std::vector<double> grid(double first, double last, int knots, const std::vector<double>& events)
{
    std::vector<double> x;
    for (int k = 0; k < knots; ++k) x.push_back(first + (last - first) * k / (knots - 1));
    for (const double at : events)
        if (at > first && at < last) {
            x.push_back(at * (1.0 - 1e-9));
            x.push_back(at);
        }
    std::sort(x.begin(), x.end());
    return x;
}

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
           const Force& per_a_h, const Force& per_a_v, const std::vector<double>& events)
        : sign_(damslip::sliding::sign(direction)),
          side_(direction == SlipDirection::downstream ? Side::heel : Side::toe), length_(before.frame.length),
          first_(before.base.crack.side == side_ ? before.base.crack.length : 0.0), uplift_(std::move(uplift)),
          at_rest_(before.base.uplift.force), load_(base_load(before.frame, before.load)),
          per_a_h_(base_load(before.frame, per_a_h)), per_a_v_(base_load(before.frame, per_a_v)),
          equations_(base_equations(block)), friction_(block.friction), bond_(block.cohesion_force + block.dowel_force)
    {
        knots_.x = grid(first_, shortest_ligament(), rest_knots, events);
        for (const double x : knots_.x) {
            const PressureProfile full = profile(x);
            knots_.accel.push_back(accel(full, x, x, 0.0));
            knots_.per_a_v.push_back(accel(full, x, x, 1.0) - knots_.accel.back());
            knots_.uplift.push_back(resultant(full).force);
        }
    }

    double first() const { return first_; }
    double length() const { return length_; }

    /// Water that stood at `now` goes on through every crack up to `come`, or is driven back to the next one that holds it.
    double front(double a_h, double a_v, double now, double come) const
    {
        if (!(normal(a_h, a_v) > uplift_of(come))) return come;
        const double round_off = 1e-9 * (units::standard_gravity + std::abs(a_h));
        const auto opens_by = [&](double accel, double per_a_v) {
            return sign_ * (a_h - accel - per_a_v * a_v) + round_off; // below zero: the crack is shut there
        };
        const auto here = [&](double x) {
            const auto [k, share] = place(knots_.x, x);
            const auto at = [&](const std::vector<double>& y) { return y[k] + share * (y[k + 1] - y[k]); };
            return opens_by(at(knots_.accel), at(knots_.per_a_v));
        };
        const auto knot = [&](std::size_t k) { return opens_by(knots_.accel[k], knots_.per_a_v[k]); };
        double on = std::max(first_, now), by = here(on);
        const bool goes_on = by >= 0.0;
        const double end = goes_on ? std::max(come, on) : first_;
        std::size_t k = static_cast<std::size_t>((goes_on ? std::upper_bound(knots_.x.begin(), knots_.x.end(), on)
                                                          : std::lower_bound(knots_.x.begin(), knots_.x.end(), on)) -
                                                 knots_.x.begin());
        while (on != end) {
            const bool last = goes_on ? k == knots_.x.size() || knots_.x[k] >= end : k == 0 || knots_.x[k - 1] <= end;
            if (!goes_on && !last) --k;
            const double x = last ? end : knots_.x[k], next = last ? here(x) : knot(k);
            if ((next >= 0.0) != goes_on) return on + (x - on) * by / (by - next);
            on = x;
            by = next;
            if (goes_on) ++k;
        }
        return on;
    }

    /// Change of U as a_h grows from nothing and the block begins to slide, its crack full of water. A crack can run on at one
    /// acceleration: of one with which it slides then, the state before counts.
    double change_at_yield(double a_v) const
    {
        const auto slides = [&](double a, double change) { return excess_under(sign_ * a, a_v, change) >= 0.0; };
        if (!(excess_under(sign_, a_v, -at_rest_) > excess_under(0.0, a_v, -at_rest_)) || slides(0.0, -at_rest_))
            return 0.0; // jammed, or it slides whatever the uplift
        const auto change = [&](double x) { return resultant(profile(x)).force - at_rest_; };
        const auto driving = [&](double x) { return sign_ * accel(profile(x), x, x, a_v); };
        double on = first_, reached = 0.0; // the crack so far, and its acceleration
        bool runs_on = true;
        for (std::size_t k = 0; k < knots_.x.size(); ++k) {
            const double x = knots_.x[k], a = sign_ * (knots_.accel[k] + knots_.per_a_v[k] * a_v);
            if (a < reached) {
                runs_on = true;
                continue;
            }
            if (runs_on) {
                const double to = k == 0 ? x : last_where([&](double y) { return driving(y) < reached; }, knots_.x[k - 1], x);
                if (slides(reached, change(to))) return change(reached > 0.0 ? on : to);
                on = to;
            }
            if (slides(a, knots_.uplift[k] - at_rest_))
                return change(bracketed_root([&](double y) { return excess_under(sign_ * driving(y), a_v, change(y)); }, on, x));
            on = x;
            reached = a;
            runs_on = false;
        }
        const double through = change(length_);
        return slides(reached, through) ? change(on) : through;
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
        const auto beyond = [&](double tip) { return excess(full, wet, tip, a_v); };
        const double most = shortest_ligament();
        double shut = wet, tip = beyond(wet) >= 0.0 ? wet : length_;
        for (int k = 1; k <= tip_scan && tip == length_; ++k) {
            const double open = wet + (most - wet) * k / tip_scan;
            if (beyond(open) >= 0.0) tip = bracketed_root(beyond, shut, open);
            shut = open;
        }
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
    double uplift_of(double wet) const
    {
        const auto [k, share] = place(knots_.x, wet);
        return knots_.uplift[k] + share * (knots_.uplift[k + 1] - knots_.uplift[k]);
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
        return excess_under(accel(full, wet, tip, a_v), a_v, uplift(full, wet, tip).force - at_rest_);
    }
    /// @param change  of the uplift
    double excess_under(double a_h, double a_v, double change) const
    {
        return sign_ * equations_.drive.at(a_h, a_v) - bond_ - friction_ * (equations_.normal.at(a_h, a_v) - change);
    }

    double sign_;
    Side side_;
    double length_, first_;
    CrackUplift uplift_;
    double at_rest_; ///< U before any motion [N/m]
    BaseLoad load_, per_a_h_, per_a_v_;
    BaseEquations equations_;
    double friction_, bond_;
    /// Cracks full of water of the block at rest: the ground acceleration of each, linear in a_v, and its uplift.
    struct {
        std::vector<double> x, accel, per_a_v, uplift;
    } knots_;
};

/// Cracks of the sliding block over x_w, up to where it slides with a crack full of water, and a_v.
class CrackTable {
public:
    /// @param end  kept by reference @param knots  of x_w
    CrackTable(const WetEnd& end, const std::vector<double>& accel_v, int knots, std::vector<double> events)
        : end_(end), accel_v_(accel_v), knots_(knots), events_(std::move(events)), rows_(accel_v.size())
    {
    }

    WetCrack at(double a_v, double wet) const
    {
        const auto [row, share] = place(accel_v_, a_v);
        WetCrack crack = made(row).at(wet);
        if (share > 0.0) crack = between(crack, made(row + 1).at(wet), share);
        crack.wet = std::min(wet, crack.wet);
        return crack;
    }

private:
    struct Row {
        std::once_flag asked;
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

    /// Made when it is asked for first: most motions need few of them.
    const Row& made(std::size_t index) const
    {
        Row& row = rows_[index];
        std::call_once(row.asked, [&] {
            const double a_v = accel_v_[index];
            row.wet = grid(end_.first(), end_.furthest(a_v), knots_, events_);
            for (const double wet : row.wet) row.cracks.push_back(end_.sliding(a_v, wet));
        });
        return row;
    }

    const WetEnd& end_;
    std::vector<double> accel_v_;
    int knots_;
    std::vector<double> events_;
    mutable std::vector<Row> rows_; ///< by a_v
};

/// Vertical accelerations to 1 g up and down; without vertical motion none.
std::vector<double> accels_v(bool vertical, int steps)
{
    std::vector<double> values;
    const int most = vertical ? steps : 0;
    for (int k = -most; k <= most; ++k) values.push_back(k * units::standard_gravity / steps);
    return values;
}

std::vector<double> from_the_toe(std::vector<double> events, double length)
{
    for (double& at : events) at = length - at;
    return events;
}

/// Water of uplift.opening = "mouth" under the rigid block. With pressure p(x_w, x_t), U and M_U its force and its moment
/// about the heel, a tip x_t of the heel's crack belongs to N' at r = L - (L - x_t)/3 from the heel, and so to one ground
/// acceleration (loads N, M are linear in a_h and a_v):
///
///     a_h(x_w, x_t) = -[M_0 + M_v a_v + M_U + r (N_0 + N_v a_v - U)] / (M_h + r N_h)
///
/// and the toe's crack likewise with r = (L - x_t)/3. x_w never passes it. The
/// block slides with the crack at which drive = c A' + mu N' along that curve: a table over x_w (33 values up to the full crack, and both sides
/// of curtain and drains) and a_v, linear between.
class MouthWater final : public SlowWater {
public:
    /// @param parts  of the table; 2: its full resolution
    MouthWater(std::shared_ptr<const Scene> scene, const WetEnd& heel, const WetEnd& toe, double speed, bool vertical,
               int parts)
        : scene_(std::move(scene)), heel_(heel), toe_(toe), speed_(speed), vertical_(vertical), parts_(parts),
          heel_table_(heel_, accels_v(vertical, wet_steps * parts), wet_knots * parts + 1, crack_events(*scene_)),
          toe_table_(toe_, accels_v(vertical, wet_steps * parts), wet_knots * parts + 1,
                     from_the_toe(crack_events(*scene_), toe_.length()))
    {
    }
    MouthWater(const MouthWater&) = delete; // the tables look at the ends
    MouthWater& operator=(const MouthWater&) = delete;

    double speed() const override { return speed_; }
    double length() const override { return heel_.length(); }
    double first(SlipDirection direction) const override { return end(direction).first(); }
    double front(SlipDirection direction, double a_h, double a_v, double now, double come) const override
    {
        return end(direction).front(a_h, a_v, now, come);
    }
    std::shared_ptr<const SlowWater> coarser() const override
    {
        if (parts_ == 1) return nullptr;
        return std::make_shared<const MouthWater>(scene_, heel_, toe_, speed_, vertical_, 1);
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
    bool vertical_;
    int parts_;
    CrackTable heel_table_, toe_table_;
};

} // namespace

std::optional<CrackRule> crack_rule_while_open(OpeningWater opening)
{
    switch (opening) {
    case OpeningWater::zero:
        return CrackRule::seismic_zero;
    case OpeningWater::full:
    case OpeningWater::mouth:
        return CrackRule::seismic_full;
    case OpeningWater::unchanged:
    case OpeningWater::reynolds:
        break;
    }
    return std::nullopt;
}

std::shared_ptr<const OpeningUplift> opening_uplift(const Scene& scene, const StaticCase& static_case,
                                                    const BaseState& before, const RigidBlock& block, bool vertical,
                                                    const SeepageProfile& seepage)
{
    if (!scene.uplift || scene.uplift->model == UpliftModel::none) return nullptr;
    const JointWaterLaw& law = scene.uplift->water;
    const std::optional<CrackRule> rule = crack_rule_while_open(law.opening);
    if (!rule) return nullptr;
    const auto kept = std::make_shared<const Scene>(scene); // the uplift of both ends is read from it
    const bool solved = seepage && scene.uplift->model == UpliftModel::seepage;
    CrackUplift uplift = crack_uplift(*kept, static_case.uplift, static_case.uplift_factor,
                                      solved ? fixed_profile(seepage(static_case.uplift)) : SeepageProfile{});
    if (*rule == CrackRule::seismic_zero)
        uplift = [&before](const Crack& crack) { return without_new_crack(before, crack); };
    const AddedMassIntegral water = scene_added_mass(scene, static_case.loads.reservoir_level);
    const auto sum_of = [&](double a_h, double a_v) {
        Force sum;
        for (const Load& load : earthquake_loads(scene, water, a_h, a_v)) sum += load.force.total();
        return sum;
    };
    const auto end = [&](SlipDirection direction) {
        const std::vector<double> events = crack_events(*kept);
        const Crack& wet = before.base.crack; // at the other end it keeps the water it has
        const bool other_end = wet.length > 0.0 && (wet.side == Side::heel) != (direction == SlipDirection::downstream);
        const CrackUplift held = [all = uplift(wet)](const Crack&) { return all; };
        return WetEnd(direction, before, block, other_end && *rule == CrackRule::seismic_full ? held : uplift, sum_of(1.0, 0.0), sum_of(0.0, 1.0),
                      direction == SlipDirection::downstream ? events : from_the_toe(events, before.frame.length));
    };
    const WetEnd heel = end(SlipDirection::downstream), toe = end(SlipDirection::upstream);
    OpeningUplift table{accels_v(vertical, table_steps), {}, {}};
    for (const double a_v : table.accel_v) {
        table.downstream.push_back(heel.change_at_yield(a_v));
        table.upstream.push_back(toe.change_at_yield(a_v));
    }
    if (law.opening == OpeningWater::mouth)
        table.slow = std::make_shared<const MouthWater>(kept, heel, toe, *law.mouth_speed, vertical, 2);
    return std::make_shared<const OpeningUplift>(std::move(table));
}

} // namespace damslip::sliding
