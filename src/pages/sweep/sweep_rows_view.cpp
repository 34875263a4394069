#include "pages/sweep/sweep_rows_view.hpp"

#include "pages/sweep/sweep_tables.hpp"
#include "sliding/empirical/regression.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

/// Cells of a row by column key.
class Cells {
public:
    explicit Cells(const Table& table)
    {
        for (std::size_t i = 0; i < table.columns.size(); ++i) at_[table.columns[i].key] = i;
    }

    std::optional<double> number(const std::vector<Cell>& row, const std::string& key) const
    {
        const auto at = at_.find(key);
        if (at == at_.end()) return std::nullopt;
        if (const double* value = std::get_if<double>(&row[at->second])) return *value;
        if (const std::int64_t* value = std::get_if<std::int64_t>(&row[at->second])) return static_cast<double>(*value);
        return std::nullopt;
    }

    std::string word(const std::vector<Cell>& row, const std::string& key) const
    {
        const auto at = at_.find(key);
        if (at == at_.end()) return "";
        const std::string* value = std::get_if<std::string>(&row[at->second]);
        return value ? *value : "";
    }

private:
    std::map<std::string, std::size_t> at_;
};

/// Place of a value in a list; put at its end where it is new.
template <class Value>
std::size_t place_of(std::vector<Value>& list, const Value& value)
{
    const auto at = std::find(list.begin(), list.end(), value);
    if (at != list.end()) return static_cast<std::size_t>(at - list.begin());
    list.push_back(value);
    return list.size() - 1;
}

std::vector<std::string> names_of(const std::vector<SweepVariant>& variants)
{
    const auto differs = [&](auto SweepVariant::*member) {
        return std::any_of(variants.begin(), variants.end(),
                           [&](const SweepVariant& v) { return v.*member != variants.front().*member; });
    };
    std::vector<std::string> names;
    for (const SweepVariant& v : variants) {
        std::vector<std::string> parts;
        if (differs(&SweepVariant::size)) parts.push_back(fmt::format("size {:g}", v.size));
        if (differs(&SweepVariant::level)) parts.push_back(fmt::format("level {:g} m", v.level));
        if (differs(&SweepVariant::uplift)) parts.push_back("uplift " + v.uplift);
        if (differs(&SweepVariant::opening)) parts.push_back("opening water " + v.opening);
        if (differs(&SweepVariant::reservoir)) parts.push_back("water " + v.reservoir);
        if (differs(&SweepVariant::period)) parts.push_back(fmt::format("T_s {:g} s", v.period.value_or(0.0)));
        if (differs(&SweepVariant::damping)) parts.push_back(fmt::format("damping {:g}", v.damping.value_or(0.0)));
        if (differs(&SweepVariant::scale)) parts.push_back(fmt::format("motion × {:g}", v.scale));
        std::string name;
        for (const std::string& part : parts) name += (name.empty() ? "" : ", ") + part;
        names.push_back(std::move(name));
    }
    return names;
}

} // namespace

void SweepViewMaker::add(const Table& table)
{
    const Cells cells(table);
    SweepView& view = view_;
    for (const std::vector<Cell>& row : table.rows) {
        SweepRow r;
        r.variant = place_of(view.variants,
                             SweepVariant{cells.number(row, "level_m").value_or(0.0), cells.word(row, "uplift"),
                                          cells.word(row, "reservoir"), cells.number(row, "size").value_or(1.0),
                                          cells.number(row, "scale").value_or(1.0), cells.word(row, "opening_water"),
                                          cells.number(row, "period_s"), cells.number(row, "damping")});
        r.friction = cells.number(row, "friction").value_or(0.0);
        r.polarity = static_cast<int>(cells.number(row, "polarity").value_or(1.0));
        r.record = cells.word(row, "record");
        r.method = cells.word(row, "method");
        r.yield_acceleration = cells.number(row, "yield_acceleration_m_s2").value_or(0.0);
        r.pga = cells.number(row, "pga_m_s2").value_or(0.0);
        r.critical_friction = cells.number(row, "critical_friction");
        r.slip = cells.number(row, "max_slip_m");
        if (!r.slip) r.slip = cells.number(row, "slip_m");
        r.error = cells.number(row, "slip_error_m");
        r.low = cells.number(row, "slip_low_m");
        r.high = cells.number(row, "slip_high_m");
        r.status = cells.word(row, "status");
        r.state = status_of_word(r.status);
        if (r.unanswered()) r.slip.reset();
        r.error_known = cells.word(row, "remark") != no_error_estimate;
        r.id = static_cast<std::int64_t>(cells.number(row, "id").value_or(0.0));
        // Nor has a regression outside its data one to draw or to take medians of; the file has it.
        if (r.status == sliding::outside_its_range) r.slip.reset(), r.low.reset(), r.high.reset();
        place_of(view.methods, r.method);
        place_of(view.records, r.record);
        frictions_.insert(r.friction);
        view.groups[{r.variant, r.method, r.friction}].push_back(view.rows.size());
        view.rows.push_back(std::move(r));
    }
}

SweepView SweepViewMaker::view()
{
    view_.frictions.assign(frictions_.begin(), frictions_.end());
    view_.variant_names = names_of(view_.variants);
    return std::move(view_);
}

SweepView sweep_view(const Table& table)
{
    SweepViewMaker maker;
    maker.add(table);
    return maker.view();
}

std::string unanswered_words(const SweepView& view)
{
    constexpr std::size_t most_named = 10;
    std::size_t all = 0;
    std::string words;
    for (const StatusRow& status : status_rows()) {
        std::size_t rows = 0;
        std::string ids;
        for (const SweepRow& r : view.rows) {
            if (!r.unanswered() || r.state != status.status) continue;
            if (++rows <= most_named) ids += fmt::format("{}{}", ids.empty() ? "" : ", ", r.id);
        }
        if (rows == 0) continue;
        all += rows;
        words += fmt::format("{}{} {} ({} {}{})", words.empty() ? "" : ", ", rows, status.word,
                             rows == 1 ? "row" : "rows", ids, rows > most_named ? ", ..." : "");
    }
    if (all == 0) return "";
    return fmt::format("{} {} no answer: {}", all, all == 1 ? "row has" : "rows have", words);
}

std::string unknown_error_words(const SweepView& view)
{
    const auto unknown =
        std::count_if(view.rows.begin(), view.rows.end(), [](const SweepRow& r) { return !r.error_known; });
    if (unknown == 0) return "";
    return fmt::format(
        "{} {} by finite elements {} no error estimate: sub-steps are fixed (a method of whole steps, or "
        "time.substeps), and nothing finer was run beside them",
        unknown, unknown == 1 ? "slip" : "slips", unknown == 1 ? "has" : "have");
}

} // namespace damslip::pages
