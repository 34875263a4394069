#include "studies/goldgruber_2015/study_rows.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace damslip::study {

namespace {

template <class List, class Matches>
std::optional<std::size_t> place(const List& list, Matches&& matches)
{
    const auto at = std::find_if(list.begin(), list.end(), matches);
    return at == list.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - list.begin()));
}

} // namespace

std::optional<std::size_t> StudyRows::id(const StudyCase& c) const
{
    const Axes& axes = grid_.axes;
    const auto equal = [](const auto& wanted) { return [&wanted](const auto& value) { return value == wanted; }; };
    const auto friction = place(axes.friction, equal(c.friction)), uplift = place(axes.uplift, equal(c.uplift)),
               reservoir = place(axes.reservoir, equal(c.water)), size = place(axes.size, equal(c.size)),
               method = place(axes.method, [&](const SweepMethod&m) { return m.id == c.method; });
    if (!friction || !uplift || !reservoir || !size || !method) return std::nullopt;
    return grid_.tasks.id({*friction, 0, *uplift, *reservoir, *size, 0, 0, 0, *method});
}

const FinishedRow* StudyRows::row(const StudyCase& at) const
{
    const auto number = id(at);
    return number ? outcome_.find(*number) : nullptr;
}

bool StudyRows::fails_statically(const StudyCase& at) const
{
    const FinishedRow* found = row(at);
    const auto status = found ? status_of(*found) : std::nullopt;
    return status && damslip::fails_statically(*status);
}

std::optional<double> StudyRows::slip(const StudyCase& at) const
{
    const FinishedRow* found = row(at);
    if (!found || !found->good) return std::nullopt;
    const std::optional<double>& slip = found->results.max_slip ? found->results.max_slip : found->results.slip;
    return slip ? std::optional(1e3 * *slip) : std::nullopt;
}

std::vector<double> StudyRows::slips(StudyCase at) const
{
    std::vector<double> list;
    for (const double friction : chapter_4::frictions) {
        at.friction = friction;
        list.push_back(slip(at).value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    return list;
}

std::optional<Status> StudyRows::status(const StudyCase& at) const
{
    const FinishedRow* found = row(at);
    return found ? status_of(*found) : std::nullopt;
}

std::string StudyRows::slip_words(const StudyCase& at) const
{
    if (const auto value = slip(at)) return fmt::format("{:.0f} mm", *value);
    const auto ended = status(at);
    return ended ? word(*ended) : "no such row";
}

std::optional<double> StudyRows::step_error(const StudyCase& at) const
{
    const FinishedRow* found = row(at);
    return found && found->results.slip_error ? std::optional(1e3 * *found->results.slip_error) : std::nullopt;
}

const SlipHistory* StudyRows::history(const StudyCase& at) const
{
    const FinishedRow* found = row(at);
    return found && found->good && found->history.interval > 0.0 ? &found->history : nullptr;
}

double StudyRows::critical_friction(const StudyCase& at) const
{
    const auto number = id(at);
    return number ? grid_.model(grid_.tasks.index(*number)).critical_friction : 0.0;
}

double StudyRows::yield_acceleration(const StudyCase& at) const
{
    const auto number = id(at);
    return number ? grid_.model(grid_.tasks.index(*number)).downstream.law.constant : 0.0;
}

bool StudyRows::has(const std::string& method) const
{
    return place(grid_.axes.method, [&](const SweepMethod& m) { return m.id == method; }).has_value();
}

std::string StudyRows::accurate() const
{
    for (const char* method : {"fe", "fe-whole-steps"})
        if (has(method)) return method;
    return "";
}

} // namespace damslip::study
