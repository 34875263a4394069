#include "core/input_error.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <numeric>

namespace damslip {

namespace {

std::string join(const std::vector<Diagnostic>& diagnostics)
{
    std::string text;
    for (const Diagnostic& d : diagnostics) text += (text.empty() ? "" : "\n") + d.text();
    return text;
}

std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substitute = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
        }
    }
    return row[b.size()];
}

} // namespace

std::string Diagnostic::text() const
{
    std::string where = file;
    if (line > 0) where += ":" + std::to_string(line);
    if (line > 0 && column > 0) where += ":" + std::to_string(column);
    std::string out = (where.empty() ? "" : where + ": ") + "error: " + problem;
    if (!expected.empty()) out += "\n  expected: " + expected;
    if (!fix.empty()) out += "\n  fix:      " + fix;
    return visible(out, LineEnds::kept); // what() ends at a NUL
}

InputError::InputError(Diagnostic diagnostic) : InputError(std::vector<Diagnostic>{std::move(diagnostic)}) {}

InputError::InputError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(join(diagnostics)), diagnostics_(std::move(diagnostics))
{
}

NotConverged::NotConverged(Diagnostic diagnostic)
    : std::runtime_error(diagnostic.text()), diagnostic_(std::move(diagnostic))
{
}

Interrupted::Interrupted(const std::string& where) : std::runtime_error("Interrupted during " + where + ".") {}

void refuse(const std::filesystem::path& file, std::string problem, std::string expected, std::string fix)
{
    throw InputError(Diagnostic{file.string(), 0, 0, std::move(problem), std::move(expected), std::move(fix)});
}

std::string_view nearest(std::string_view word, const std::vector<std::string>& candidates)
{
    std::string_view best;
    std::size_t best_distance = word.size() > 8 ? 4 : 3;
    for (const std::string& candidate : candidates) {
        const std::size_t longer = std::max(word.size(), candidate.size());
        const std::size_t shorter = std::min(word.size(), candidate.size());
        if (longer - shorter >= best_distance || longer > 200) continue;
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best_distance && distance < longer) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

} // namespace damslip
