#include "analysis/fragility/packed_rows.hpp"

#include <algorithm>
#include <bit>

namespace damslip {

namespace {

constexpr std::uint8_t bad_run = 0x80;

/// Stands for no figure: a NaN that no calculation gives.
constexpr std::uint64_t no_figure = 0x7ff8'6e6f'6e65'0001;

bool is_figure(double x)
{
    return std::bit_cast<std::uint64_t>(x) != no_figure;
}

} // namespace

std::size_t PackedRows::finished() const
{
    return size() - static_cast<std::size_t>(std::count(state_.begin(), state_.end(), std::uint8_t{0}));
}

const std::optional<FinishedRow> PackedRows::operator[](std::size_t id) const
{
    if (!has(id)) return std::nullopt;
    FinishedRow row;
    row.id = id;
    row.good = (state_[id] & bad_run) == 0;
    row.results.status = statuses_[(state_[id] & ~bad_run) - 1u];
    for (std::size_t i = 0; i < figures_.size(); ++i)
        if (!figures_[i].empty() && is_figure(figures_[i][id])) row.results.*row_numbers[i].value = figures_[i][id];
    return row;
}

void PackedRows::put(const FinishedRow& row)
{
    for (std::size_t i = 0; i < figures_.size(); ++i) {
        const std::optional<double>& figure = row.results.*row_numbers[i].value;
        if (figure && figures_[i].empty()) figures_[i].assign(size(), std::bit_cast<double>(no_figure));
        if (!figures_[i].empty()) figures_[i][row.id] = figure.value_or(std::bit_cast<double>(no_figure));
    }
    state_[row.id] = state_of(row);
}

std::uint8_t PackedRows::state_of(const FinishedRow& row)
{
    const auto at = std::find(statuses_.begin(), statuses_.end(), row.results.status);
    const auto place = static_cast<std::uint8_t>(at - statuses_.begin());
    if (at == statuses_.end()) statuses_.push_back(row.results.status); // of a list of few words
    return static_cast<std::uint8_t>((place + 1u) | (row.good ? 0u : bad_run));
}

} // namespace damslip
