#include "pages/sweep/sweep_pages.hpp"

#include "analysis/prepare/plane_model.hpp"
#include "sliding/empirical/regression.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numeric>

namespace damslip::pages {

namespace {

std::vector<std::string> names_of(const std::vector<SweepVariant>& variants)
{
    const auto differs = [&](auto SweepVariant::*member) { return differ(variants, member); };
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
        names.push_back(fmt::format("{}", fmt::join(parts, ", ")));
    }
    return names;
}

} // namespace

SweepViewMaker::SweepViewMaker(std::size_t every)
{
    view_.every = every;
}

std::string_view SweepViewMaker::kept(std::string_view word)
{
    const auto known = words_->find(word);
    return known != words_->end() ? *known : *words_->emplace(word).first;
}

/// The word, which the list then has.
std::string_view SweepViewMaker::listed(const std::string& word, std::vector<std::string>& list)
{
    if (std::ranges::find(list, word) == list.end()) list.push_back(word);
    return kept(word);
}

std::size_t SweepViewMaker::number_of(const SweepVariant& variant)
{
    const auto number = static_cast<std::size_t>(std::ranges::find(view_.variants, variant) - view_.variants.begin());
    if (number == view_.variants.size()) view_.variants.push_back(variant);
    return number;
}

std::size_t SweepViewMaker::variant_of(const SweepLine& l)
{
    const auto [known, fresh] = variants_.try_emplace({l.grid.tasks.variant(l.at), l.at.scale}, 0);
    if (!fresh) return known->second;
    const Axes& axes = l.axes();
    SweepVariant variant{.level = axes.level[l.at.level] * axes.size[l.at.size],
                         .uplift = axes.uplift[l.at.uplift],
                         .reservoir = axes.reservoir[l.at.reservoir],
                         .size = axes.size[l.at.size],
                         .scale = axes.scale[l.at.scale]};
    if (has_opening_axis(axes)) variant.opening = axes.opening[l.at.opening];
    if (!axes.period.empty()) variant.period = axes.period[l.at.period];
    if (!axes.damping.empty()) variant.damping = axes.damping[l.at.damping];
    if (has_plane_axis(axes))
        variant.plane = axes.plane[l.at.plane].empty() ? std::string(base_plane) : axes.plane[l.at.plane];
    return known->second = number_of(variant);
}

SweepRow SweepViewMaker::row_of(const SweepLine& l)
{
    const Axes& axes = l.axes();
    records_.resize(std::max(records_.size(), l.grid.records.size()));
    methods_.resize(axes.method.size());
    std::string_view &record = records_[l.at.record], &method = methods_[l.at.method];
    if (!record.data()) record = listed(l.grid.records[l.at.record], view_.records);
    if (!method.data()) method = listed(axes.method[l.at.method].id, view_.methods);
    const RowResults& found = l.results;
    if (!last_status_.data() || found.status != last_status_) {
        last_status_ = kept(found.status);
        last_state_ = status_of_word(last_status_);
    }
    SweepRow row{.id = static_cast<std::int64_t>(l.id),
                 .variant = variant_of(l),
                 .friction = friction_of(axes, l.at),
                 .polarity = axes.polarity[l.at.polarity],
                 .record = record,
                 .method = method,
                 .yield_acceleration = l.yield(),
                 .pga = l.grid.pga(l.id),
                 .slip = found.max_slip ? found.max_slip : found.slip,
                 .error = found.slip_error,
                 .critical_friction = found.critical_friction,
                 .status = last_status_,
                 .state = last_state_,
                 .error_known = l.error_known()};
    complete(row);
    return row;
}

/// What counts as a slip here.
void SweepViewMaker::complete(SweepRow& row)
{
    if (row.unanswered()) row.slip.reset();
    // Nor has a regression outside its data one to draw or to take medians of; the file has it.
    if (row.status == sliding::outside_its_range) row.slip.reset();
    if (std::ranges::find(view_.polarities, row.polarity) == view_.polarities.end())
        view_.polarities.push_back(row.polarity);
    view_.unanswered.add(row.id, row.state);
}

void SweepViewMaker::put(const SweepRow& row)
{
    if (view_.rows.empty() || row.friction != view_.rows.back().friction) frictions_.insert(row.friction);
    view_.rows.push_back(row);
}

void SweepViewMaker::expect(std::size_t rows)
{
    view_.rows.reserve(rows);
}

void SweepViewMaker::add(const SweepLine& line)
{
    put(row_of(line));
}

void SweepViewMaker::add(const SweepVariant& variant, SweepRow row)
{
    row.variant = number_of(variant);
    row.record = listed(std::string(row.record), view_.records);
    row.method = listed(std::string(row.method), view_.methods);
    row.status = kept(row.status);
    row.state = status_of_word(row.status);
    complete(row);
    put(row);
}

void SweepViewMaker::leave_out(const SweepLine& line)
{
    const SweepRow r = row_of(line);
    ++view_.left_out;
    const std::optional<SweepRow>& largest = view_.largest_left_out;
    if (r.slip && (!largest || std::abs(*r.slip) > std::abs(*largest->slip))) view_.largest_left_out = r;
}

/// By variant and method in the order of the rows, then by friction.
void SweepViewMaker::group_rows()
{
    const std::size_t methods = view_.methods.size(), n = view_.rows.size();
    const auto slot = [&](const SweepRow& r) {
        const auto at = std::ranges::find(view_.methods, r.method);
        return r.variant * methods + static_cast<std::size_t>(at - view_.methods.begin());
    };
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
    view_.frictions.assign(frictions_.begin(), frictions_.end());
    view_.variant_names = names_of(view_.variants);
    group_rows();
    view_.words = words_;
    return std::move(view_);
}

SweepView sweep_view(const Grid& grid, const std::vector<std::size_t>& ids, const SweepOutcome& outcome)
{
    SweepViewMaker maker;
    for_each_sweep_row(grid, ids, outcome, false, [&](const SweepLine& line, const std::vector<Cell>&) { maker.add(line); });
    return maker.view();
}

std::span<const std::uint32_t> SweepView::group(std::size_t variant, std::string_view method, double friction) const
{
    const auto number = std::ranges::find(methods, method);
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

std::string unknown_error_words(const SweepView& view)
{
    const auto unknown = std::ranges::count_if(view.rows, [](const SweepRow& r) { return !r.error_known; });
    if (unknown == 0) return "";
    return fmt::format(
        "{} {} by finite elements {} no error estimate: sub-steps are fixed (a method of whole steps, or "
        "time.substeps), and nothing finer was run beside them",
        unknown, unknown == 1 ? "slip" : "slips", unknown == 1 ? "has" : "have");
}

} // namespace damslip::pages
