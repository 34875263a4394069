#include "pages/sweep/opening_water_table.hpp"

#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace damslip::pages {

namespace {

std::optional<std::size_t> place_of(const Table& table, const std::string& key)
{
    const auto at = std::find_if(table.columns.begin(), table.columns.end(),
                                 [&](const Column& column) { return column.key == key; });
    if (at == table.columns.end()) return std::nullopt;
    return static_cast<std::size_t>(at - table.columns.begin());
}

/// One motion, strength, variant and method under all rules.
struct RuleLine {
    std::vector<Cell> at;                   ///< of the columns that say where it is
    std::map<std::string, Cell> slips = {}; ///< by rule [mm], or the word of a status without a slip

    Cell apart() const
    {
        double least = HUGE_VAL, most = -HUGE_VAL;
        for (const auto& [rule, slip] : slips)
            if (const double* mm = std::get_if<double>(&slip)) {
                least = std::min(least, *mm);
                most = std::max(most, *mm);
            } else {
                return {};
            }
        return slips.size() > 1 ? Cell(most - least) : Cell();
    }
};

bool varies(const Table& rows, std::size_t column)
{
    return std::any_of(rows.rows.begin(), rows.rows.end(),
                       [&](const std::vector<Cell>& row) { return row[column] != rows.rows.front()[column]; });
}

} // namespace

std::optional<Table> opening_water_table(const Table& rows)
{
    const auto rule_at = place_of(rows, "opening_water"), slip_at = place_of(rows, "max_slip_m"),
               status_at = place_of(rows, "status");
    if (!rule_at || !slip_at || !status_at || rows.rows.empty() || !varies(rows, *rule_at)) return std::nullopt;

    std::vector<std::size_t> where;
    for (const char* key :
         {"friction", "level_m", "uplift", "reservoir", "size", "scale", "polarity", "record", "method"})
        if (const auto at = place_of(rows, key);
            at && (varies(rows, *at) || std::string_view(key) == "friction" || std::string_view(key) == "method"))
            where.push_back(*at);

    std::vector<std::string> rules;
    std::vector<RuleLine> lines;
    for (const std::vector<Cell>& row : rows.rows) {
        RuleLine line;
        for (const std::size_t at : where) line.at.push_back(row[at]);
        const auto* rule = std::get_if<std::string>(&row[*rule_at]);
        if (!rule) continue;
        if (std::find(rules.begin(), rules.end(), *rule) == rules.end()) rules.push_back(*rule);
        const auto same = std::find_if(lines.begin(), lines.end(), [&](const RuleLine& l) { return l.at == line.at; });
        RuleLine& target = same == lines.end() ? lines.emplace_back(std::move(line)) : *same;
        const double* metres = std::get_if<double>(&row[*slip_at]);
        target.slips[*rule] = metres ? Cell(std::abs(*metres) / units::mm) : row[*status_at];
    }

    std::vector<ColumnOf<RuleLine>> columns;
    for (std::size_t k = 0; k < where.size(); ++k)
        columns.push_back({rows.columns[where[k]], [k](const RuleLine& l) { return l.at[k]; }});
    for (const std::string& rule : rules)
        columns.push_back({{rule + "_mm", rule, "mm", 4}, [rule](const RuleLine& l) {
                               const auto slip = l.slips.find(rule);
                               return slip == l.slips.end() ? Cell() : slip->second;
                           }});
    columns.push_back({{"apart_mm", "apart", "mm", 3}, &RuleLine::apart});
    return table_of("What the rules for water in the opening base are worth", columns, lines,
                    {"largest slip on the way under each rule of uplift.opening; apart: the largest less the smallest. "
                     "Rigid block: reynolds is taken as unchanged, for a block has no width of the joint; mouth is its "
                     "rule for water that needs time."});
}

std::optional<Section> opening_water_section(const Table& rows)
{
    std::optional<Table> table = opening_water_table(rows);
    if (!table) return std::nullopt;
    return Section{
        "Water in the opening base", {TablePart{std::move(*table), Layout::rows, 1, Fold::open}}, Fold::open};
}

} // namespace damslip::pages
