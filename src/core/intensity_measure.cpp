#include "core/intensity_measure.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <utility>

namespace damslip {

namespace {

constexpr std::pair<std::string_view, IntensityMeasure> words[]{{"PGA", IntensityMeasure::pga},
                                                                {"PGV", IntensityMeasure::pgv},
                                                                {"IA", IntensityMeasure::arias},
                                                                {"CAV", IntensityMeasure::cav}};

/// "0.1, 0.2" -> numbers; nothing where one is no period, or not larger than the one before.
std::optional<std::vector<double>> periods_of(std::string_view text)
{
    std::vector<double> periods;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        const std::optional<double> period = parse_whole_number_text(text.substr(from, comma - from));
        if (!period || !(*period >= 0.01 && *period <= 20.0)) return std::nullopt;
        if (!periods.empty() && *period <= periods.back()) return std::nullopt;
        periods.push_back(*period);
        from = comma + 1;
    }
    return periods;
}

} // namespace

std::optional<IntensityName> parse_intensity(std::string_view text)
{
    for (const auto& [word, measure] : words)
        if (text == word) return IntensityName{measure, false, {}};
    if (text == "SA(T1)") return IntensityName{IntensityMeasure::sa, true, {}};
    if (!text.ends_with(')')) return std::nullopt;
    const bool average = text.starts_with("avgSA(");
    if (!average && !text.starts_with("SA(")) return std::nullopt;
    text.remove_prefix(average ? 6 : 3);
    text.remove_suffix(1);
    std::optional<std::vector<double>> periods = periods_of(text);
    if (!periods || (average ? periods->size() < 2 : periods->size() != 1)) return std::nullopt;
    return IntensityName{average ? IntensityMeasure::avg_sa : IntensityMeasure::sa, false, std::move(*periods)};
}

std::string text_of(const IntensityName& name)
{
    for (const auto& [word, measure] : words)
        if (name.measure == measure) return std::string(word);
    if (name.first_period) return "SA(T1)";
    std::string text = name.measure == IntensityMeasure::avg_sa ? "avgSA(" : "SA(";
    for (std::size_t i = 0; i < name.periods.size(); ++i) text += (i ? "," : "") + shortest(name.periods[i]);
    return text + ")";
}

bool is_acceleration(IntensityMeasure measure)
{
    return measure == IntensityMeasure::pga || measure == IntensityMeasure::sa || measure == IntensityMeasure::avg_sa;
}

int power_of_scale(IntensityMeasure measure)
{
    return measure == IntensityMeasure::arias ? 2 : 1;
}

} // namespace damslip
