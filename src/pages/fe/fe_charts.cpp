#include "pages/fe/fe_charts.hpp"

#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

using units::mm;

/// Times as multiples of the history's own step, so that all curves share one list.
std::vector<double> even_times(const std::vector<double>& time)
{
    if (time.size() < 2) return time;
    const double step = time[1] - time[0];
    std::vector<double> even = time;
    for (std::size_t i = 0; i < even.size(); ++i) {
        const double k = static_cast<double>(i);
        if (std::abs(even[i] - k * step) < 1e-6 * step) even[i] = k * step;
    }
    return even;
}

std::vector<double> scaled(std::vector<double> values, double unit)
{
    for (double& v : values) v /= unit;
    return values;
}

/// Makes the charts of one run.
class Charts {
public:
    explicit Charts(const RunView& view)
        : view_(view), h_(view.run.fe.history), time_(even_times(view.run.fe.history.time))
    {
    }

    Chart ground() const
    {
        Chart chart = empty("ground acceleration", "acceleration", "m/s²", 240);
        add(chart, "horizontal, upstream", h_.ground_h, 1.0, 0);
        if (std::any_of(h_.ground_v.begin(), h_.ground_v.end(), [](double a) { return a != 0.0; }))
            add(chart, "vertical, up", h_.ground_v, 1.0, 1);
        return chart;
    }

    Chart slip() const
    {
        Chart chart = empty("slip", "slip, downstream", "mm", 360);
        add(chart, "FE, heel", h_.slip_heel, mm, 2);
        add(chart, "FE, middle", h_.slip_middle, mm, 4);
        add(chart, "FE, toe", h_.slip_toe, mm, 5);
        add(chart, "FE, area mean", h_.slip, mm, 0, Weight::strong);
        for (std::size_t k = 0; k < h_.lifts.size(); ++k) add(chart, lift_name(k), h_.lifts[k].slip, mm, k % 2 ? 6 : 3);
        if (view_.rigid) {
            Curve rigid{"rigid block",
                        view_.rigid->history.time,
                        scaled(view_.rigid->history.slip, mm),
                        {},
                        {},
                        Mark::dashed,
                        Weight::strong,
                        1};
            on_grid(rigid);
            chart.curves.push_back(std::move(rigid));
        }
        if (view_.allowable && std::abs(view_.run.fe.max_slip) > 0.2 * *view_.allowable)
            chart.horizontal.push_back({*view_.allowable / mm, "allowable"});
        chart.note = view_.rigid
                         ? "The rigid block has the same uplift, water and added mass, and the vertical component "
                           "where the record has one."
                         : "";
        return chart;
    }

    Chart crest() const
    {
        Chart chart = empty("crest motion", "displacement, downstream", "mm", 280);
        add(chart, "crest, relative to the ground", h_.crest_x, mm, 0);
        std::vector<double> lean = h_.crest_x;
        for (std::size_t i = 0; i < lean.size(); ++i) lean[i] -= h_.slip[i];
        add(chart, "crest, relative to the base", lean, mm, 2);
        return chart;
    }

    Chart forces() const
    {
        Chart chart = empty("forces on the base", "force", "MN/m", 280);
        add(chart, "effective normal force N'", h_.normal_force, 1e6, 0);
        add(chart, "shear T, resists downstream slip", h_.shear_force, 1e6, 1);
        return chart;
    }

    Chart anchors() const
    {
        Chart chart = empty("anchors", "force N", "kN/m", 240);
        for (std::size_t k = 0; k < h_.anchors.size(); ++k)
            add(chart, h_.anchors[k].name, h_.anchors[k].force, 1e3, static_cast<int>(k % 7));
        return chart;
    }

    Chart rocking() const
    {
        Chart chart = empty("rocking", "rotation", "mrad", 240);
        add(chart, "base over the rock", h_.rocking, 1e-3, 0);
        for (std::size_t k = 0; k < h_.lifts.size(); ++k)
            add(chart, lift_name(k), h_.lifts[k].rocking, 1e-3, k % 2 ? 6 : 3);
        chart.note = "Of what is above over what is below, positive where the upstream end opens.";
        return chart;
    }

    Chart lengths() const
    {
        Chart chart = empty("sliding and open length of the base", "length", "m", 240);
        add(chart, "slips", h_.slipping_length, 1.0, 1);
        add(chart, "open", h_.open_length, 1.0, 0);
        return chart;
    }

    Chart energy() const
    {
        Chart chart = empty("energy since the start of the shaking", "energy", "kJ/m", 360);
        const auto term = [&](const char* name, double fe2d::Energy::*member, int colour, Mark mark = Mark::line) {
            if (h_.energy.empty()) return;
            std::vector<double> values;
            values.reserve(h_.energy.size());
            for (const fe2d::Energy& e : h_.energy) values.push_back(e.*member - h_.energy.front().*member);
            add(chart, name, values, 1e3, colour);
            chart.curves.back().mark = mark;
        };
        term("external work", &fe2d::Energy::external, 0);
        term("kinetic", &fe2d::Energy::kinetic, 2);
        term("strain", &fe2d::Energy::strain, 5);
        term("friction, dissipated", &fe2d::Energy::friction, 1);
        term("damping, dissipated", &fe2d::Energy::damping, 4);
        term("scheme, dissipated", &fe2d::Energy::numerical, 3);
        if (!h_.energy.empty() && h_.energy.back().radiated != 0.0)
            term("radiated by water and rock", &fe2d::Energy::radiated, 6);
        const std::size_t before_joints = chart.curves.size();
        const auto of_joints = [&](const char* name, double fe2d::Energy::*member, int colour) {
            const auto there = [=](const fe2d::Energy& e) { return e.*member != 0.0; };
            if (std::any_of(h_.energy.begin(), h_.energy.end(), there)) term(name, member, colour, Mark::dashed);
        };
        of_joints("stored in joints", &fe2d::Energy::joint_stored, 5);
        of_joints("bond, fracture", &fe2d::Energy::bond_fracture, 1);
        of_joints("anchors, plastic", &fe2d::Energy::anchor_plastic, 3);
        of_joints("anchors, snapped", &fe2d::Energy::anchor_loss, 2);
        of_joints("impacts", &fe2d::Energy::impact, 4);
        of_joints("water in joints", &fe2d::Energy::joint_water, 6);
        const std::size_t plain = before_joints + 2; // this one and the imbalance
        term("contact normal work", &fe2d::Energy::contact_normal, 7, Mark::dashed);
        add(chart, "imbalance", h_.imbalance, 1e3, 7);
        chart.note =
            fmt::format("kinetic + strain + damping + scheme + friction + radiated = external + contact normal work; "
                        "what is left is the imbalance, at the end {:.1e} of the largest term.",
                        view_.run.fe.energy_error);
        if (chart.curves.size() > plain)
            chart.note +=
                " What bonds, anchors and impacts store and spend counts on the left, the work of water in joints "
                "on the right.";
        return chart;
    }

private:
    std::string lift_name(std::size_t k) const
    {
        const fe2d::LiftResult& lift = view_.run.fe.lifts[k];
        return lift.name.empty() ? lift.plane : lift.name;
    }

    Chart empty(const std::string& title, const std::string& label, const std::string& unit, int height) const
    {
        Chart chart;
        chart.title = view_.run.label() + ": " + title;
        chart.x = {"time", "s"};
        chart.y = {label, unit};
        chart.height = height;
        chart.together = view_.together;
        return chart;
    }

    void add(Chart& chart, const std::string& name, const std::vector<double>& values, double unit, int colour,
             Weight weight = Weight::normal) const
    {
        if (values.size() != time_.size()) return; // not kept by this kind of run
        chart.curves.push_back({name, time_, scaled(values, unit), {}, {}, Mark::line, weight, colour});
    }

    /// Times of the block at the history's instants become those to the last bit.
    void on_grid(Curve& curve) const
    {
        for (std::size_t i = 0; i < std::min(curve.x.size(), time_.size()); ++i)
            if (std::abs(curve.x[i] - time_[i]) <
                1e-6 * (time_.back() - time_.front()) / static_cast<double>(time_.size()))
                curve.x[i] = time_[i];
    }

    const RunView& view_;
    const fe2d::RunHistory& h_;
    std::vector<double> time_;
};

} // namespace

std::vector<Chart> history_charts(const RunView& view)
{
    const Charts make(view);
    std::vector<Chart> charts{make.ground(),  make.slip(),    make.crest(),   make.forces(),
                              make.anchors(), make.rocking(), make.lengths(), make.energy()};
    std::erase_if(charts, [](const Chart& chart) { return chart.curves.empty(); });
    for (Chart& chart : charts) { // so that a run of 20 s at 0.005 s is whole, and many long ones stay small
        chart.thin_above = std::clamp<std::size_t>(16000 / std::max<std::size_t>(view.records, 1), 800, 4200);
        chart.thin_buckets = chart.thin_above / (2 * chart.curves.size());
    }
    return charts;
}

std::optional<std::size_t> fastest_row(const fe2d::RunHistory& h)
{
    std::optional<std::size_t> row;
    double largest = 0.0;
    for (std::size_t i = 1; i < h.slip.size(); ++i) {
        const double rate = std::abs(h.slip[i] - h.slip[i - 1]) / (h.time[i] - h.time[i - 1]);
        if (!(rate > largest)) continue;
        largest = rate;
        row = i;
    }
    return row;
}

} // namespace damslip::pages
