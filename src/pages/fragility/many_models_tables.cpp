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

template <class AtLevel>
struct ModelsRow {
    std::string limit;
    const AtLevel& at;
};

/// Of an estimate that was not used there is none.
template <class AtLevel, class Get>
std::function<Cell(const ModelsRow<AtLevel>&)> if_used(Get get)
{
    return [get](const ModelsRow<AtLevel>& r) { return r.at.used ? Cell(get(r.at)) : Cell(); };
}

/// What both estimates by many models show, and between P and the speed-up what each has of its own.
/// @param result  nullptr: not asked for, no rows
template <class AtLevel, class Result>
Table many_models_table(const FragilityView& view, std::string title, const Result* result,
                        std::vector<ColumnOf<ModelsRow<AtLevel>>> own)
{
    using Row = ModelsRow<AtLevel>;
    std::vector<Row> rows;
    if (result)
        for (const auto& limit : result->limits)
            for (const AtLevel& at : limit.levels) rows.push_back({limit.limit.text, at});
    const auto used = [](auto get) { return if_used<AtLevel>(get); };
    using A = AtLevel;
    std::vector<ColumnOf<Row>> columns{
        {{"limit", "limit"}, &Row::limit},
        {intensity_column(view), [&](const Row& r) { return r.at.x / view.unit; }},
        {{"probability", "P", "–"}, used([](const A& a) { return 0.5 * (a.low.printed + a.high.printed); })},
        {{"lower", "2.5 %", "–", 3}, used([](const A& a) { return a.low.interval.lower; })},
        {{"upper", "97.5 %", "–", 3}, used([](const A& a) { return a.high.interval.upper; })},
        {{"variation", "c.o.v.", "–", 3}, used([](const A& a) { return a.low.se / std::max(a.low.p, 1e-12); })}};
    columns.insert(columns.end(), own.begin(), own.end());
    columns.push_back({{"speed_up", "speed-up", "–", 3}, used([](const A& a) { return a.speed_up; })});
    columns.push_back({{"remark", "remark"}, [](const Row& r) { return r.at.used ? Cell() : Cell(r.at.why_not); }});
    return table_of<Row>(std::move(title), columns, rows);
}

} // namespace

Table two_level_table(const FragilityView& view)
{
    using A = TwoLevelAtLevel;
    using Row = ModelsRow<A>;
    Table t = many_models_table<A>(view, "Finite elements and rigid block together", view.two_level,
                                   {{{"rho", "ρ", "–", 3}, if_used<A>([](const A& a) { return a.low.rho; })},
                                    {{"dear", "FE runs"}, [](const Row& r) { return count_cell(r.at.dear); }},
                                    {{"cheap", "rigid runs"}, [](const Row& r) { return count_cell(r.at.cheap); }}});
    if (view.two_level) {
        t.notes = {"speed-up: variance of plain Monte Carlo with finite elements for the same processor seconds over "
                   "that of both models."};
        if (view.two_level->disagree)
            t.notes.push_back(fmt::format("{} draws stand by one of the two models alone.", view.two_level->disagree));
    }
    return t;
}

Table mfmc_table(const FragilityView& view)
{
    using A = MfmcAtLevel;
    Table t = many_models_table<A>(
        view, "Multifidelity Monte Carlo", view.mfmc,
        {{{"samples", "samples"}, if_used<A>([](const A& a) { return words_of_runs(a.models); })},
         {{"correlations", "ρ"}, if_used<A>([](const A& a) { return words_of_correlations(a.models); })}});
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
