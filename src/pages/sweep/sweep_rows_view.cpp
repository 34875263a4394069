#include "pages/sweep/sweep_pages.hpp"

#include "sliding/empirical/regression.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <tuple>

namespace damslip::pages {

namespace {

/// Where the cell of a key is.
class Place {
public:
    Place(const std::vector<Column>& columns, std::string_view key)
    {
        const auto at = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.key == key; });
        if (at != columns.end()) place_ = static_cast<std::size_t>(at - columns.begin());
    }

    std::optional<double> number(const std::vector<Cell>& row) const
    {
        if (!place_) return std::nullopt;
        if (const double* value = std::get_if<double>(&row[*place_])) return *value;
        if (const std::int64_t* value = std::get_if<std::int64_t>(&row[*place_])) return static_cast<double>(*value);
        return std::nullopt;
    }
    std::string_view word(const std::vector<Cell>& row) const
    {
        const std::string* value = place_ ? std::get_if<std::string>(&row[*place_]) : nullptr;
        return value ? std::string_view(*value) : std::string_view();
    }

private:
    std::optional<std::size_t> place_; ///< none: no such column
};

/// The words of a column, each held once: equal ones have the same place in memory.
class WordColumn {
public:
    WordColumn(const std::vector<Column>& columns, std::string_view key, SweepView::Words& words)
        : place_(columns, key), words_(words)
    {
    }

    std::string_view of(const std::vector<Cell>& row)
    {
        const std::string_view word = place_.word(row);
        if (last_.data() && word == last_) return last_;
        const auto known = words_.find(word);
        return last_ = known != words_.end() ? *known : *words_.emplace(word).first;
    }

private:
    Place place_;
    SweepView::Words& words_;
    std::string_view last_;
};

/// Different words in the order in which they come.
class WordList {
public:
    explicit WordList(std::vector<std::string>& list) : list_(list) {}

    std::size_t place(std::string_view word)
    {
        const auto [at, fresh] = places_.try_emplace(word.data(), list_.size());
        if (fresh) list_.emplace_back(word);
        return at->second;
    }

private:
    std::vector<std::string>& list_;
    std::map<const char*, std::size_t> places_; ///< words of a WordColumn
};

std::vector<std::string> names_of(const std::vector<SweepVariant>& variants)
{
    const auto differs = [&](auto SweepVariant::*member) {
        return std::any_of(variants.begin(), variants.end(),
                           [&](const SweepVariant& v) { return v.*member != variants.front().*member; });
    };
    std::vector<std::string> names;
    for (const SweepVariant& v : variants) {
        std::vector<std::string> parts;
        if (differs(&SweepVariant::plane)) parts.push_back(v.plane);
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

/// What is needed to make a view, and not afterwards.
struct SweepViewMaker::Parts {
    Parts(const std::vector<Column>& columns, SweepView& view)
        : words(std::make_shared<SweepView::Words>()), id(columns, "id"), friction(columns, "friction"),
          level(columns, "level_m"), size(columns, "size"), scale(columns, "scale"), period(columns, "period_s"),
          damping(columns, "damping"), polarity(columns, "polarity"), yield(columns, "yield_acceleration_m_s2"),
          pga(columns, "pga_m_s2"), slip(columns, "slip_m"), max_slip(columns, "max_slip_m"),
          low(columns, "slip_low_m"), high(columns, "slip_high_m"), error(columns, "slip_error_m"),
          critical(columns, "critical_friction"), remark(columns, "remark"), uplift(columns, "uplift", *words),
          opening(columns, "opening_water", *words), plane(columns, "plane", *words), reservoir(columns, "reservoir", *words),
          record(columns, "record", *words), method(columns, "method", *words), status(columns, "status", *words),
          methods(view.methods), records(view.records)
    {
    }

    std::shared_ptr<SweepView::Words> words;
    Place id, friction, level, size, scale, period, damping, polarity, yield, pga, slip, max_slip, low, high, error,
        critical, remark;
    WordColumn uplift, opening, plane, reservoir, record, method, status;
    WordList methods, records;
    std::set<double> frictions;

    using Variant = std::tuple<double, double, double, std::optional<double>, std::optional<double>, const char*,
                               const char*, const char*, const char*>; ///< numbers, and words by their place
    std::map<Variant, std::size_t> variants;
    std::optional<std::pair<Variant, std::size_t>> last_variant;
    std::string_view last_status;
    std::optional<Status> last_state;
};

SweepViewMaker::SweepViewMaker(const std::vector<Column>& columns, std::size_t every)
    : parts_(std::make_unique<Parts>(columns, view_))
{
    view_.every = every;
}

SweepViewMaker::~SweepViewMaker() = default;

std::size_t SweepViewMaker::variant_of(const std::vector<Cell>& row)
{
    Parts& p = *parts_;
    const double level = p.level.number(row).value_or(0.0), size = p.size.number(row).value_or(1.0),
                 scale = p.scale.number(row).value_or(1.0);
    const std::optional<double> period = p.period.number(row), damping = p.damping.number(row);
    const std::string_view uplift = p.uplift.of(row), reservoir = p.reservoir.of(row), opening = p.opening.of(row),
                           plane = p.plane.of(row);
    const Parts::Variant key{level, size, scale, period, damping, uplift.data(), reservoir.data(), opening.data(),
                             plane.data()};
    if (p.last_variant && p.last_variant->first == key) return p.last_variant->second;
    const auto [at, fresh] = p.variants.try_emplace(key, view_.variants.size());
    if (fresh)
        view_.variants.push_back(
            {level, std::string(uplift), std::string(reservoir), size, scale, std::string(opening), period, damping,
             std::string(plane)});
    p.last_variant = {key, at->second};
    return at->second;
}

SweepRow SweepViewMaker::row_of(const std::vector<Cell>& row)
{
    Parts& p = *parts_;
    SweepRow r;
    r.variant = variant_of(row);
    r.friction = p.friction.number(row).value_or(0.0);
    r.polarity = static_cast<int>(p.polarity.number(row).value_or(1.0));
    r.record = p.record.of(row);
    r.method = p.method.of(row);
    r.yield_acceleration = p.yield.number(row).value_or(0.0);
    r.pga = p.pga.number(row).value_or(0.0);
    if (std::find(view_.polarities.begin(), view_.polarities.end(), r.polarity) == view_.polarities.end())
        view_.polarities.push_back(r.polarity);
    r.critical_friction = p.critical.number(row);
    r.slip = p.max_slip.number(row);
    if (!r.slip) r.slip = p.slip.number(row);
    r.error = p.error.number(row);
    r.low = p.low.number(row);
    r.high = p.high.number(row);
    r.status = p.status.of(row);
    if (r.status.data() != p.last_status.data()) p.last_state = status_of_word(r.status);
    p.last_status = r.status;
    r.state = p.last_state;
    if (r.unanswered()) r.slip.reset();
    r.error_known = p.remark.word(row) != no_error_estimate;
    r.id = static_cast<std::int64_t>(p.id.number(row).value_or(0.0));
    // Nor has a regression outside its data one to draw or to take medians of; the file has it.
    if (r.status == sliding::outside_its_range) r.slip.reset(), r.low.reset(), r.high.reset();
    p.methods.place(r.method);
    p.records.place(r.record);
    view_.unanswered.add(r.id, r.state);
    return r;
}

void SweepViewMaker::expect(std::size_t rows)
{
    view_.rows.reserve(rows);
}

void SweepViewMaker::add(const std::vector<Cell>& row)
{
    const SweepRow r = row_of(row);
    if (view_.rows.empty() || r.friction != view_.rows.back().friction) parts_->frictions.insert(r.friction);
    view_.rows.push_back(r);
}

void SweepViewMaker::leave_out(const std::vector<Cell>& row)
{
    const SweepRow r = row_of(row);
    ++view_.left_out;
    const std::optional<SweepRow>& largest = view_.largest_left_out;
    if (r.slip && (!largest || std::abs(*r.slip) > std::abs(*largest->slip))) view_.largest_left_out = r;
}

/// By variant and method in the order of the rows, then by friction.
void SweepViewMaker::group_rows()
{
    const std::size_t methods = view_.methods.size(), n = view_.rows.size();
    const auto slot = [&](const SweepRow& r) { return r.variant * methods + parts_->methods.place(r.method); };
    std::vector<std::size_t>& begin = view_.group_begin;
    begin.assign(view_.variants.size() * methods + 1, 0);
    for (const SweepRow& r : view_.rows) ++begin[slot(r) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<std::size_t> next = begin;
    view_.by_group.resize(n);
    for (std::size_t i = 0; i < n; ++i) view_.by_group[next[slot(view_.rows[i])]++] = static_cast<std::uint32_t>(i);
    const auto by_friction = [&](std::uint32_t a, std::uint32_t b) {
        return view_.rows[a].friction < view_.rows[b].friction;
    };
    for (std::size_t s = 0; s + 1 < begin.size(); ++s) {
        const auto first = view_.by_group.begin() + static_cast<std::ptrdiff_t>(begin[s]),
                   last = view_.by_group.begin() + static_cast<std::ptrdiff_t>(begin[s + 1]);
        if (!std::is_sorted(first, last, by_friction)) std::stable_sort(first, last, by_friction);
    }
}

SweepView SweepViewMaker::view()
{
    view_.frictions.assign(parts_->frictions.begin(), parts_->frictions.end());
    view_.variant_names = names_of(view_.variants);
    group_rows();
    view_.words = parts_->words;
    return std::move(view_);
}

SweepView sweep_view(const Table& table)
{
    SweepViewMaker maker(table.columns);
    for (const std::vector<Cell>& row : table.rows) maker.add(row);
    return maker.view();
}

std::span<const std::uint32_t> SweepView::group(std::size_t variant, std::string_view method, double friction) const
{
    const auto number = std::find(methods.begin(), methods.end(), method);
    if (number == methods.end()) return {};
    const std::size_t slot = variant * methods.size() + static_cast<std::size_t>(number - methods.begin());
    const std::span all = std::span(by_group).subspan(group_begin[slot], group_begin[slot + 1] - group_begin[slot]);
    const auto found = std::ranges::equal_range(all, friction, {}, [&](std::uint32_t i) { return rows[i].friction; });
    return {found.begin(), found.end()};
}

void UnansweredRows::add(std::int64_t id, const std::optional<Status>& state)
{
    constexpr std::size_t most_named = 10;
    if (!state || is_answer(*state)) return;
    Rows& rows = rows_[*state];
    if (++rows.count <= most_named)
        rows.first += fmt::format("{}{}", rows.first.empty() ? "" : ", ", id);
    else if (rows.count == most_named + 1)
        rows.first += ", ...";
}

std::string UnansweredRows::words() const
{
    std::size_t all = 0;
    std::string words;
    for (const StatusRow& status : status_rows()) {
        const auto rows = rows_.find(status.status);
        if (rows == rows_.end()) continue;
        const std::size_t count = rows->second.count;
        all += count;
        words += fmt::format("{}{} {} ({} {})", words.empty() ? "" : ", ", count, status.word,
                             count == 1 ? "row" : "rows", rows->second.first);
    }
    if (all == 0) return "";
    return fmt::format("{} {} no answer: {}", all, all == 1 ? "row has" : "rows have", words);
}

std::string unanswered_words(const SweepView& view)
{
    return view.unanswered.words();
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
