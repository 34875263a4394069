#include "pages/fragility/fragility_tables.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

/// "fe 128, fe-reduced 512, rigid-v 9000"
std::string words_of_runs(const std::vector<MfmcModel>& models)
{
    std::string words;
    for (const MfmcModel& m : models) words += fmt::format("{}{} {}", words.empty() ? "" : ", ", m.method, m.runs);
    return words;
}

std::string words_of_correlations(const std::vector<MfmcModel>& models)
{
    std::string words;
    for (std::size_t j = 1; j < models.size(); ++j)
        words += fmt::format("{}{:.3f}", words.empty() ? "" : ", ", models[j].rho);
    return words;
}

} // namespace

Table mfmc_table(const FragilityView& view)
{
    struct Row {
        std::string limit;
        const MfmcAtLevel& at;
    };
    std::vector<Row> rows;
    if (view.mfmc)
        for (const MfmcLimit& limit : view.mfmc->limits)
            for (const MfmcAtLevel& at : limit.levels) rows.push_back({limit.limit.text, at});
    const auto used = [](auto get) { return [=](const Row& r) { return r.at.used ? Cell(get(r.at)) : Cell(); }; };
    using A = MfmcAtLevel;
    Table t = table_of<Row>(
        "Multifidelity Monte Carlo",
        {{{"limit", "limit"}, &Row::limit},
         {{"intensity", view.plan.input.intensity.text, view.unit_text},
          [&](const Row& r) { return r.at.x / view.unit; }},
         {{"probability", "P", "–"}, used([](const A& a) { return 0.5 * (a.low.printed + a.high.printed); })},
         {{"lower", "2.5 %", "–", 3}, used([](const A& a) { return a.low.interval.lower; })},
         {{"upper", "97.5 %", "–", 3}, used([](const A& a) { return a.high.interval.upper; })},
         {{"variation", "c.o.v.", "–", 3}, used([](const A& a) { return a.low.se / std::max(a.low.p, 1e-12); })},
         {{"samples", "samples"}, used([](const A& a) { return words_of_runs(a.models); })},
         {{"correlations", "ρ"}, used([](const A& a) { return words_of_correlations(a.models); })},
         {{"speed_up", "speed-up", "–", 3}, used([](const A& a) { return a.speed_up; })},
         {{"remark", "remark"}, [](const Row& r) { return r.at.used ? Cell() : Cell(r.at.why_not); }}},
        rows);
    if (view.mfmc) {
        t.notes = {fmt::format("A pilot of {} runs a level by all models, whose answers are thrown away, says what the "
                               "cheap ones are worth. speed-up: variance of plain Monte Carlo for the same processor "
                               "seconds, the pilot's among them, over that of the estimate.",
                               view.mfmc->pilot)};
        t.notes.insert(t.notes.end(), view.mfmc->left_out.begin(), view.mfmc->left_out.end());
    }
    return t;
}

} // namespace damslip::pages
