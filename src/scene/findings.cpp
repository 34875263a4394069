#include "scene/findings.hpp"

#include <algorithm>
#include <tuple>

namespace damslip {

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

void Findings::throw_if_any()
{
    if (diagnostics_.empty()) return;
    std::stable_sort(diagnostics_.begin(), diagnostics_.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.line, a.column) < std::tie(b.line, b.column);
    });
    throw InputError(std::move(diagnostics_));
}

} // namespace damslip
