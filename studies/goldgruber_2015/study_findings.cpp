#include "studies/goldgruber_2015/study_findings.hpp"

#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::study {

using namespace pages;

namespace {

using units::standard_gravity;

Finding yield_range(const StudyFacts& f)
{
    Finding out{"4.4.1.1, fig. 4-6",
                "a_y grows with μ and falls with the level; 0.2 to 0.5 g for μ = 1.0 … 1.5, level 0.9 … 1.0 of the "
                "height",
                {},
                {},
                ""};
    const auto yield = [&](double level, double friction) {
        return yield_of(f.scene, "curtain", level, friction) / standard_gravity;
    };
    const double low = yield(1.0, 1.0), high = yield(0.9, 1.5);
    const bool monotone = yield(1.0, 1.5) > low && yield(0.9, 1.0) > low;
    out.here = Judged{fmt::format("{:.2f} … {:.2f} g with the printed uplift", low, high),
                      !monotone                                              ? Holds::no
                      : low > 0.15 && low < 0.25 && high > 0.4 && high < 0.6 ? Holds::yes
                                                                             : Holds::partly};
    out.why = fmt::format(
        "the lower end is μ = 1.0 with the full reservoir; 0.2 g is reached at {:.0f} % of the level", 100.0 * [&] {
            double share = 1.0;
            while (share > 0.5 && yield(share, 1.0) < 0.2) share -= 0.005;
            return share;
        }());
    return out;
}

Finding vertical_varies(const StudyFacts& f)
{
    const sliding::YieldLaw law = f.rows.grid().model(f.rows.grid().tasks.index(0)).downstream.law;
    Finding out{
        "4.4.1.1, fig. 4-7", "a_y is constant without, and varies all the time with vertical motion", {}, {}, ""};
    out.here =
        Judged{fmt::format("a_y changes by {:.2f} m/s² per m/s² of vertical acceleration (μ = 1.00)", law.per_a_v),
               law.per_a_v > 0.0 ? Holds::yes : Holds::no};
    return out;
}

Finding printed_uplift(const StudyFacts& f)
{
    Finding out{"4.2, fig. 4-2", "the curtain lowers the uplift to 2/3 of the full pressure", {}, {}, ""};
    const StudyUplift &seepage = f.uplifts[0], &printed = f.uplifts[1];
    out.here = Judged{
        fmt::format("seepage: {:.2f} p₀ before, {:.2f} p₀ behind the curtain; U = {:.2f} MN/m against {:.2f} by the "
                    "printed rule",
                    seepage.before_curtain, seepage.behind_curtain, seepage.force / 1e6, printed.force / 1e6),
        std::abs(seepage.behind_curtain - 2.0 / 3.0) < 0.1 ? Holds::yes : Holds::no};
    out.why = fmt::format(
        "with the stated geometry and permeabilities the flow lowers it by about 2/3. With the printed rule the block "
        "stands only from μ = {:.3f} on, so that the printed slips at 0.66 and 0.65 cannot belong to it",
        printed.critical_friction);
    return out;
}

Finding no_slip_at_one(const StudyFacts& f)
{
    const StudyCase at{"seepage", "westergaard-simplified", 1.0, 1.0, "rigid"};
    const double a_y = f.rows.yield_acceleration(at), slip = f.rows.slip(at).value_or(std::nan(""));
    Finding out{"4.5.1, fig. 4-11", "rigid block: at μ = 1.0 a_y is well above the PGA, no slip", {}, {}, ""};
    out.here = Judged{fmt::format("a_y = {:.2f}, PGA {:.2f} m/s²; slip {}", a_y, f.pga,
                                  std::isfinite(slip) ? fmt::format("{:.3g} mm", slip) : f.rows.slip_words(at)),
                      slip == 0.0 && a_y > f.pga ? Holds::yes : Holds::no};
    return out;
}

Finding dramatic(const StudyFacts& f)
{
    StudyCase at{"seepage", "westergaard-simplified", 1.0, 0.70, "rigid"};
    const double high = f.rows.slip(at).value_or(std::nan(""));
    const std::string from = f.rows.slip_words(at);
    at.friction = 0.65;
    const double low = f.rows.slip(at).value_or(std::nan(""));
    Finding out{"4.5.1, fig. 4-11", "rigid block: slips change dramatically from μ = 0.70 to 0.65", {}, {}, ""};
    out.here = Judged{fmt::format("{} → {}", from, f.rows.slip_words(at)), low > 5.0 * high ? Holds::yes : Holds::no};
    return out;
}

/// Factor between two positive values, at least 1.
double apart(double a, double b)
{
    return std::max(a, b) / std::min(a, b);
}

Finding jibson_close(const StudyFacts& f)
{
    Finding out{"4.5.1, fig. 4-12",
                "Jibson et al. 1998 is fairly close to the rigid block for a_y = 0.04 … 0.01 g",
                {},
                {},
                ""};
    const RegressionsBeside& r = f.regressions;
    std::string numbers;
    double worst[3] = {1.0, 1.0, 1.0};
    for (std::size_t i = 0; i < r.yield.size(); ++i) {
        if (r.yield[i] < 0.0099 || r.yield[i] > 0.0401) continue;
        for (std::size_t k = 0; k < 3; ++k)
            if (r.regressions[k].median[i] > 0.0)
                worst[k] = std::max(worst[k], apart(r.block[i], r.regressions[k].median[i]));
        if (std::abs(r.yield[i] - 0.01) < 1e-3 || std::abs(r.yield[i] - 0.02) < 1e-3 ||
            std::abs(r.yield[i] - 0.04) < 1e-3)
            numbers += fmt::format("{}{:.2f} g: {:.0f} mm, block {:.0f} mm", numbers.empty() ? "" : "; ", r.yield[i],
                                   r.regressions[2].median[i], r.block[i]);
    }
    numbers += fmt::format(". At most a factor {:.1f} apart (Jibson 1993 {:.1f}, Ambraseys & Menu {:.1f})", worst[2],
                           worst[1], worst[0]);
    out.here = Judged{numbers, worst[2] <= 2.0                                ? Holds::yes
                               : worst[2] <= worst[0] || worst[2] <= worst[1] ? Holds::partly
                                                                              : Holds::no};
    return out;
}

Finding negligible_above(const StudyFacts& f)
{
    Finding out{"4.5.1, fig. 4-12", "slips are negligible for a_y above 0.07 g", {}, {}, ""};
    double largest = 0.0;
    for (std::size_t i = 0; i < f.regressions.yield.size(); ++i)
        if (f.regressions.yield[i] > 0.0699) largest = std::max(largest, f.regressions.block[i]);
    out.here = Judged{fmt::format("at most {:.2g} mm", largest), largest < 1.0 ? Holds::yes : Holds::no};
    return out;
}

Finding vertical_adds(const StudyFacts& f)
{
    Finding out{"4.5.3, fig. 4-19", "rigid block: the vertical motion increases the slip", {}, {}, ""};
    const std::vector<double> h = f.rows.slips({"seepage", "westergaard-simplified", 1.0, 1.0, "rigid"}),
                              v = f.rows.slips({"seepage", "westergaard-simplified", 1.0, 1.0, "rigid-v"});
    bool all = true;
    for (std::size_t i = 0; i < h.size(); ++i) all = all && !(v[i] < h[i]);
    out.here = Judged{slip_list(h) + " → " + slip_list(v), all ? Holds::yes : Holds::no};
    return out;
}

Finding frequencies(const StudyFacts& f)
{
    Finding out{"4.4.3.6, tables 4-3, 4-4",
                "first frequencies 3.6 Hz (62.5 m), 1.8 Hz (125 m); Rayleigh's a_M 1.8 … 1.9 and 0.9 1/s",
                {},
                {},
                ""};
    double first = 0.0, all = 0.0, mass = 0.0;
    for (const ModelModes& m : f.modes) {
        for (const ModeBeside& mode : m.modes)
            all = std::max(all, std::abs(mode.frequency / mode.printed_frequency - 1.0));
        if (!m.modes.empty())
            first = std::max(first, std::abs(m.modes.front().frequency / m.modes.front().printed_frequency - 1.0));
        mass = std::max(mass, std::abs(m.mass_coefficient / m.printed_mass_coefficient - 1.0));
    }
    out.here = Judged{fmt::format("first frequencies within {:.1f} %, all twenty within {:.0f} %, a_M within {:.0f} %",
                                  100 * first, 100 * all, 100 * mass),
                      first < 0.03 && mass < 0.1 ? Holds::yes
                      : first < 0.1              ? Holds::partly
                                                 : Holds::no};
    out.why = "the section is read from the text, its figure being missing; see the tables for each mode";
    return out;
}

} // namespace

const char* word(Holds holds)
{
    return holds == Holds::yes ? "yes" : holds == Holds::partly ? "partly" : "no";
}

std::vector<Finding> study_findings(const StudyFacts& f)
{
    std::vector<Finding> list{printed_uplift(f), yield_range(f),      vertical_varies(f),
                              frequencies(f),    no_slip_at_one(f),   dramatic(f),
                              jibson_close(f),   negligible_above(f), vertical_adds(f)};
    if (!f.rows.accurate().empty())
        for (Finding& finding : fe_findings(f.rows)) list.push_back(std::move(finding));
    return list;
}

Table findings_table(const std::vector<Finding>& findings)
{
    using F = Finding;
    const auto numbers = [](std::optional<Judged> F::*judged) {
        return [=](const F& f) { return f.*judged ? (f.*judged)->numbers : std::string(); };
    };
    const auto holds = [](std::optional<Judged> F::*judged) {
        return [=](const F& f) { return f.*judged ? word((f.*judged)->holds) : ""; };
    };
    std::vector<ColumnOf<F>> columns{{{"where", "where"}, &F::where},
                                     {{"printed", "printed"}, &F::printed},
                                     {{"here", "here"}, numbers(&F::here)},
                                     {{"holds", "holds"}, holds(&F::here)}};
    if (std::any_of(findings.begin(), findings.end(), [](const F& f) { return f.as_source.has_value(); })) {
        columns.push_back({{"as_source", "with the source's settings"}, numbers(&F::as_source)});
        columns.push_back({{"holds_as_source", "holds"}, holds(&F::as_source)});
    }
    columns.push_back({{"why", "why not, or with what reserve"}, &F::why});
    return table_of("What the source found, and what came out here", columns, findings);
}

std::string findings_text(const std::vector<Finding>& findings)
{
    std::string all;
    for (const Finding& f : findings) {
        if (!f.here) continue;
        all += fmt::format("{}: {}\n  {}: {}\n", f.where, f.printed, word(f.here->holds), f.here->numbers);
        if (f.as_source)
            all += fmt::format("  with the source's settings {}: {}\n", word(f.as_source->holds), f.as_source->numbers);
    }
    return all;
}

} // namespace damslip::study
