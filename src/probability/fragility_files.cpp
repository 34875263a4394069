#include "probability/fragility_files.hpp"

#include "core/text.hpp"
#include "probability/distribution.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace damslip::probability {

namespace {

void check_word(const char* what, const std::string& word)
{
    const bool ok = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '-' || c == '_';
    });
    if (!ok) throw ParameterError(what, "\"" + word + "\"", "letters, digits, \"-\" and \"_\"");
}

void check_model(const NrmlModel& model, bool discrete)
{
    check_word("id", model.id);
    if (model.limits.empty()) throw ParameterError("limits", "none", "one limit at least");
    if (model.levels.empty()) throw ParameterError("levels", "none", "the tested intensities");
    for (std::size_t i = 0; i < model.levels.size(); ++i)
        if (!(model.levels[i] > (i ? model.levels[i - 1] : 0.0)))
            throw ParameterError("levels", shortest(model.levels[i]), "intensities > 0 that rise");
    for (const NrmlLimit& limit : model.limits) {
        check_word("limit", limit.name);
        if (!discrete && !(limit.median > 0.0 && limit.beta > 0.0))
            throw ParameterError("beta", shortest(limit.beta), "median and beta > 0");
        if (discrete && limit.poes.size() != model.levels.size())
            throw ParameterError("poes", fmt::format("{}", limit.poes.size()),
                                 fmt::format("{}, one for each level", model.levels.size()));
    }
}

std::string numbers(const std::vector<double>& values)
{
    std::string text;
    for (const double v : values) text += (text.empty() ? "" : " ") + shortest(v);
    return text;
}

/// True where the lognormal curves of two limits cross within the levels: NRML then needs the discrete form.
bool limits_cross(const NrmlModel& model)
{
    if (model.levels.empty()) return false;
    for (std::size_t i = 1; i < model.limits.size(); ++i)
        for (const double x : {model.levels.front(), model.levels.back()}) // straight lines over ln x
            if (std::log(x / model.limits[i - 1].median) / model.limits[i - 1].beta <
                std::log(x / model.limits[i].median) / model.limits[i].beta)
                return true;
    return false;
}

} // namespace

std::string nrml_fragility(const NrmlModel& model)
{
    const bool curves = std::all_of(model.limits.begin(), model.limits.end(),
                                    [](const NrmlLimit& l) { return l.median > 0.0 && l.beta > 0.0; });
    const bool discrete = !curves || limits_cross(model);
    check_model(model, discrete);
    std::string states, rows;
    for (const NrmlLimit& limit : model.limits) {
        states += (states.empty() ? "" : " ") + limit.name;
        if (discrete) {
            rows += fmt::format("      <poes ls=\"{}\">{}</poes>\n", limit.name, numbers(limit.poes));
            continue;
        }
        const double variance = limit.beta * limit.beta, mean = limit.median * std::exp(0.5 * variance);
        rows += fmt::format("      <params ls=\"{}\" mean=\"{}\" stddev=\"{}\"/>\n", limit.name, shortest(mean),
                            shortest(mean * std::sqrt(std::expm1(variance))));
    }
    const std::string imls =
        discrete ? fmt::format("      <imls imt=\"{}\" noDamageLimit=\"{}\">{}</imls>\n", xml_text(model.imt),
                               shortest(model.no_damage), numbers(model.levels))
                 : fmt::format("      <imls imt=\"{}\" noDamageLimit=\"{}\" minIML=\"{}\" maxIML=\"{}\"/>\n",
                               xml_text(model.imt), shortest(model.no_damage), shortest(model.levels.front()),
                               shortest(model.levels.back()));
    return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                       "<nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n"
                       "  <fragilityModel id=\"{0}\" assetCategory=\"dams\" lossCategory=\"structural\">\n"
                       "    <description>{1}</description>\n"
                       "    <limitStates>{2}</limitStates>\n"
                       "    <fragilityFunction id=\"{0}\" format=\"{3}\"{4}>\n{5}{6}"
                       "    </fragilityFunction>\n  </fragilityModel>\n</nrml>\n",
                       model.id, xml_text(model.description), states, discrete ? "discrete" : "continuous",
                       discrete ? "" : " shape=\"logncdf\"", imls, rows);
}

std::string usace_fragility(const std::string& name, const std::vector<UsaceLocation>& locations)
{
    nlohmann::ordered_json file{{"name", name}, {"locations", nlohmann::ordered_json::array()}};
    for (const UsaceLocation& place : locations) {
        nlohmann::ordered_json p = nlohmann::ordered_json::array(), y = nlohmann::ordered_json::array();
        double last = -1.0;
        for (const StageTriangle& s : place.stages) {
            if (!(s.probability > last && s.probability >= 0.0 && s.probability <= 1.0))
                throw ParameterError("probability", shortest(s.probability), "0 to 1, rising");
            if (!(s.min <= s.most_likely && s.most_likely <= s.max))
                throw ParameterError(
                    "stage", fmt::format("{}, {}, {}", shortest(s.min), shortest(s.most_likely), shortest(s.max)),
                    "min <= most likely <= max");
            last = s.probability;
            p.push_back(s.probability);
            y.push_back({{"type", "TriangularDistribution"},
                         {"parameters", {{"min", s.min}, {"mostlikely", s.most_likely}, {"max", s.max}}}});
        }
        file["locations"].push_back(
            {{"location", place.location}, {"probability-stage", {{"xvalues", p}, {"ydistributions", y}}}});
    }
    return file.dump(2) + "\n";
}

} // namespace damslip::probability
