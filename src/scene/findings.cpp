#include "scene/findings.hpp"

#include <algorithm>
#include <tuple>

namespace damslip {

namespace {

void sort_by_place(std::vector<Diagnostic>& diagnostics)
{
    std::stable_sort(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.line, a.column) < std::tie(b.line, b.column);
    });
}

} // namespace

Findings::Place Findings::place(const std::string& key) const
{
    std::string name = key;
    for (;;) {
        if (const auto found = places_.find(name); found != places_.end()) return found->second;
        const std::size_t dot = name.rfind('.');
        if (dot == std::string::npos) return {};
        name.resize(dot);
    }
}

void Findings::wrong(const std::string& key, std::string problem, std::string expected, std::string fix)
{
    wrong_at(place(key), std::move(problem), std::move(expected), std::move(fix));
}

void Findings::wrong_at(Place place, std::string problem, std::string expected, std::string fix)
{
    diagnostics_.push_back({file_, place.line, place.column, std::move(problem), std::move(expected), std::move(fix)});
}

void Findings::note_at(Place place, Diagnostic note)
{
    note.file = file_;
    note.line = place.line;
    note.column = place.column;
    notes_.push_back(std::move(note));
}

std::vector<Diagnostic> Findings::notes() const
{
    std::vector<Diagnostic> sorted = notes_;
    sort_by_place(sorted);
    return sorted;
}

void Findings::throw_if_any()
{
    if (diagnostics_.empty()) return;
    sort_by_place(diagnostics_);
    throw InputError(std::move(diagnostics_));
}

} // namespace damslip
