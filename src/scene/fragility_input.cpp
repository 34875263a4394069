#include "scene/fragility_input.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/units.hpp"
#include "scene/check.hpp"
#include "scene/keys.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace damslip {

namespace {

/// @pre there are such a table and key
const KeyGroup& table_of(std::string_view name)
{
    return *std::ranges::find(fragility_key_tables(), name, &KeyGroup::name);
}
const Key& key_of(std::string_view table, std::string_view name)
{
    return *std::ranges::find(table_of(table).keys, name, &Key::name);
}

/// The tables of a fragility, read with all that is wrong in them.
class FragilityReader {
public:
    FragilityReader(std::string_view text, const std::filesystem::path& file)
        : file_(file), text_(text, file), root_(toml_of(text, file))
    {
    }

    /// Keys of `instead` in place of those of the file.
    void replace(std::string_view instead)
    {
        const toml::table given = toml_of(instead, file_);
        for (auto&& [name, node] : given) {
            const toml::table* from = node.as_table();
            toml::table* into = from && root_.contains(name.str()) ? root_[name.str()].as_table() : nullptr;
            if (!into) {
                root_.insert_or_assign(name.str(), node);
                continue;
            }
            const auto is_level = [](std::string_view key) { return key.starts_with("levels_"); };
            for (auto&& [key, value] : *from)
                if (is_level(key.str()))
                    for (const char* level : {"levels_g", "levels_m_s2", "levels_m_s", "levels_cm_s"})
                        into->erase(level);
            for (auto&& [key, value] : *from) into->insert_or_assign(key.str(), value);
        }
    }

    FragilityInput read()
    {
        FragilityInput input;
        read_probability(input.probability);
        read_suite(input.suite);
        read_intensity(input.intensity);
        read_limits(input.limits);
        read_hazard(input.hazard);
        if (!wrong_.empty()) throw InputError(wrong_);
        return input;
    }

    /// What is wrong in the tables that are there.
    std::vector<Diagnostic> look_over()
    {
        FragilityInput input;
        read_probability(input.probability);
        read_suite(input.suite);
        if (root_.contains("intensity")) read_intensity(input.intensity);
        if (root_.contains("limit")) read_limits(input.limits);
        read_hazard(input.hazard);
        return wrong_;
    }

private:
    void wrong(const toml::node& where, std::string problem, std::string expected, std::string fix)
    {
        wrong_.push_back({file_.string(), static_cast<int>(where.source().begin.line),
                          static_cast<int>(where.source().begin.column), std::move(problem), std::move(expected),
                          std::move(fix)});
    }
    void missing(const std::string& what, const std::string& expected, const std::string& fix)
    {
        wrong_.push_back({file_.string(), 0, 0, what + " is missing.", expected, fix});
    }

    const toml::table* table_named(const char* name)
    {
        const toml::node* node = root_.get(name);
        if (node && !node->is_table())
            wrong(*node, fmt::format("{} is no table.", name), fmt::format("[{}]", name),
                  fmt::format("write  [{}]", name));
        return node ? node->as_table() : nullptr;
    }
    /// @param more  names that the table has beside its keys
    void check_keys(const toml::table& table, const std::string& label, std::vector<std::string> more = {})
    {
        std::vector<std::string> known;
        for (const Key& key : table_of(label).keys) known.push_back(key.name);
        known.insert(known.end(), more.begin(), more.end());
        check_names(table, label, known);
    }
    void check_names(const toml::table& table, const std::string& label, const std::vector<std::string>& known)
    {
        for (auto&& [key, node] : table) {
            const std::string name(key.str());
            if (std::find(known.begin(), known.end(), name) != known.end()) continue;
            const std::string_view near = nearest(name, known);
            wrong(node,
                  fmt::format("unknown key {}.{}.{}", label, name,
                              near.empty() ? "" : fmt::format(" Did you mean {}?", near)),
                  fmt::format("keys of {}: {}", label, fmt::join(known, ", ")),
                  near.empty() ? "leave it out" : fmt::format("write  {}", near));
        }
    }
    void not_allowed(const toml::node& node, const std::string& label, const std::string& name,
                     const std::string& expected, const std::string& example)
    {
        wrong(node, fmt::format("{}.{} is not allowed.", label, name), expected,
              fmt::format("for example  {} = {}", name, example));
    }
    static std::optional<double> finite_number(const toml::node& node)
    {
        const std::optional<double> v = node.is_number() ? node.value<double>() : std::nullopt;
        return v && std::isfinite(*v) ? v : std::nullopt;
    }
    /// A key of a table; `out` stays where it is not there.
    void number(const toml::table& table, const std::string& label, const char* name, double& out)
    {
        const toml::node* node = table.get(name);
        if (!node) return;
        const Key& key = key_of(label, name);
        const std::optional<double> v = finite_number(*node);
        if (v && key.range.contains(*v))
            out = *v;
        else
            not_allowed(*node, label, name, "a number " + key.range.text(), key.example);
    }
    void whole(const toml::table& table, const std::string& label, const char* name, std::int64_t& out)
    {
        const toml::node* node = table.get(name);
        if (!node) return;
        const Key& key = key_of(label, name);
        const auto v = node->value_exact<std::int64_t>();
        if (v && key.range.contains(static_cast<double>(*v)))
            out = *v;
        else
            not_allowed(*node, label, name, "a whole number, " + key.range.text(), key.example);
    }
    void flag(const toml::table& table, const std::string& label, const char* name, bool& out)
    {
        const toml::node* node = table.get(name);
        if (!node) return;
        if (const auto v = node->value_exact<bool>())
            out = *v;
        else
            not_allowed(*node, label, name, "true or false", "true");
    }
    std::optional<std::string> text(const toml::table& table, const std::string& label, const char* name)
    {
        const toml::node* node = table.get(name);
        if (!node) return std::nullopt;
        auto v = node->value_exact<std::string>();
        if (!v || v->empty()) not_allowed(*node, label, name, "a text in quotes", key_of(label, name).example);
        return v;
    }
    /// A choice, whose values are in the order of the key's words.
    template <class Choice>
    void choice(const toml::table& table, const std::string& label, const char* name, Choice& out)
    {
        const toml::node* node = table.get(name);
        if (!node) return;
        const std::vector<std::string>& words = key_of(label, name).value.words;
        const auto at = std::ranges::find(words, node->value<std::string>().value_or(""));
        if (at != words.end())
            out = static_cast<Choice>(at - words.begin());
        else
            wrong(*node, fmt::format("{}.{} is not allowed.", label, name),
                  fmt::format("one of \"{}\"", fmt::join(words, "\", \"")),
                  fmt::format("write  {} = \"{}\"", name, words.front()));
    }

    void read_probability(ProbabilityInput& p)
    {
        const toml::table* table = table_named("probability");
        if (!table) return;
        check_keys(*table, "probability", {"variable", "correlation"});
        std::int64_t seed = 1, replicates = p.replicates, samples = 0;
        whole(*table, "probability", "seed", seed);
        whole(*table, "probability", "replicates", replicates);
        whole(*table, "probability", "samples", samples);
        p.seed = static_cast<std::uint64_t>(seed);
        p.replicates = static_cast<int>(replicates);
        if (samples) p.samples = static_cast<int>(samples);
        choice(*table, "probability", "sampling", p.sampling);
        choice(*table, "probability", "static_failure", p.static_failure);
        for_each_entry(*table, "variable", "[[probability.variable]]",
                       [&](const toml::table& entry) { read_variable(entry, p); });
        for_each_entry(*table, "correlation", "[[probability.correlation]]",
                       [&](const toml::table& entry) { read_correlation(entry, p); });
    }

    template <class Take>
    void for_each_entry(const toml::table& table, const char* name, const char* header, Take take)
    {
        const toml::node* node = table.get(name);
        if (!node) return;
        const auto no_list = [&](const toml::node& where) {
            wrong(where, fmt::format("{} is no list of tables.", name), header, "double the brackets");
        };
        const toml::array* list = node->as_array();
        if (!list) return no_list(*node);
        for (const toml::node& item : *list)
            if (const toml::table* entry = item.as_table())
                take(*entry);
            else
                no_list(item);
    }

    void read_variable(const toml::table& entry, ProbabilityInput& p)
    {
        RandomVariable v;
        const char* const label = "probability.variable";
        check_keys(entry, label);
        const toml::node* key = entry.get("key");
        if (!key)
            return wrong(entry, "probability.variable.key is missing.", "a key of the scene",
                         "for example  key = \"contact.friction\"");
        if (const auto one = key->value<std::string>()) v.keys = {*one};
        if (const toml::array* list = key->as_array())
            for (const toml::node& item : *list) v.keys.push_back(item.value<std::string>().value_or(""));
        try {
            for (const std::string& name : v.keys) text_.canonical(name);
        } catch (const InputError& e) {
            const Diagnostic& d = e.diagnostics().front();
            return wrong(*key, d.problem, d.expected, d.fix);
        }
        if (v.keys.empty())
            return wrong(*key, "probability.variable.key is not allowed.", "a key of the scene, or a list of them",
                         "for example  key = \"contact.friction\"");
        v.name = text(entry, label, "name").value_or(v.keys.front());
        for (const RandomVariable& other : p.variables)
            if (other.name == v.name)
                wrong(entry, fmt::format("there are two variables \"{}\".", v.name), "a name of its own for each",
                      "add a name");
        flag(entry, label, "factor", v.factor);
        choice(entry, label, "kind", v.kind);
        read_law(entry, v);
        p.variables.push_back(std::move(v));
    }

    void read_law(const toml::table& entry, RandomVariable& v)
    {
        const std::string label = fmt::format("probability.variable[{}]", v.name);
        const toml::node* discrete = entry.get("discrete");
        std::size_t laws = discrete ? 1 : 0;
        if (discrete) read_discrete(*discrete, label, v);
        for (const Key& law : table_of("probability.variable").keys) {
            if (law.value.kind != ValueKind::law) continue;
            const toml::node* node = entry.get(law.name);
            if (!node) continue;
            ++laws;
            v.law.name = law.name;
            v.law.where = {label + "." + law.name, node->source().begin.line};
            const toml::table* table = node->as_table();
            if (!table) {
                wrong(*node, fmt::format("{} is not allowed.", v.law.where.key), "its numbers in braces",
                      fmt::format("for example  {} = {}", law.name, law.example));
                continue;
            }
            std::vector<std::string> names;
            for (const LawNumber& k : law.numbers) names.push_back(k.name);
            check_names(*table, v.law.where.key, names);
            for (const LawNumber& k : law.numbers) {
                const toml::node* value = table->get(k.name);
                const std::optional<double> number = value ? finite_number(*value) : std::nullopt;
                const bool good = number && (!k.positive || *number > 0.0);
                if (good) v.law.parameters[k.name] = *number;
                if (value && !good)
                    wrong(*value, fmt::format("{}.{} is not allowed.", v.law.where.key, k.name),
                          k.positive ? "a number > 0" : "a number",
                          fmt::format("for example  {} = {}", law.name, law.example));
                if (!value && k.required)
                    wrong(*node, fmt::format("{}.{} is missing.", v.law.where.key, k.name), "all numbers of the law",
                          fmt::format("for example  {} = {}", law.name, law.example));
            }
            const auto has = [&](const char* name) { return table->contains(name); };
            if (v.law.name == "lognormal" && !((has("median") && has("beta") && !has("mean") && !has("cov")) ||
                                               (has("mean") && has("cov") && !has("median") && !has("beta"))))
                wrong(*node, fmt::format("{} is not allowed.", v.law.where.key), "median and beta, or mean and cov",
                      fmt::format("for example  lognormal = {}", law.example));
        }
        if (laws != 1)
            wrong(entry, fmt::format("{} has {} laws.", label, laws),
                  "one of lognormal, normal, uniform, triangular, beta, discrete",
                  "for example  lognormal = { median = 0.77, beta = 0.15 }");
    }

    void read_discrete(const toml::node& node, const std::string& label, RandomVariable& v)
    {
        v.law.name = "discrete";
        v.law.where = {label + ".discrete", node.source().begin.line};
        const toml::table* table = node.as_table();
        const toml::array* values = table ? (*table)["values"].as_array() : nullptr;
        const toml::array* weights = table ? (*table)["weights"].as_array() : nullptr;
        bool good = values && weights && values->size() == weights->size() && !values->empty();
        for (std::size_t i = 0; good && i < values->size(); ++i) {
            const toml::node& value = (*values)[i];
            if (const auto text = value.value_exact<std::string>())
                v.law.values.emplace_back(*text);
            else if (const auto flag = value.value_exact<bool>())
                v.law.values.emplace_back(*flag);
            else if (const auto d = value.value<double>())
                v.law.values.emplace_back(*d);
            const double weight = (*weights)[i].value<double>().value_or(0.0);
            good = v.law.values.size() == i + 1 && weight > 0.0;
            v.law.weights.push_back(weight);
        }
        if (!good)
            wrong(node, fmt::format("{} is not allowed.", v.law.where.key), "as many weights > 0 as values",
                  "for example  discrete = { values = [\"seepage\", \"linear\"], weights = [0.6, 0.4] }");
    }

    void read_correlation(const toml::table& entry, ProbabilityInput& p)
    {
        check_keys(entry, "probability.correlation");
        RankCorrelation c;
        c.where = {"probability.correlation", entry.source().begin.line};
        const toml::array* names = entry["between"].as_array();
        if (names && names->size() == 2) {
            c.first = (*names)[0].value<std::string>().value_or("");
            c.second = (*names)[1].value<std::string>().value_or("");
        }
        const auto find = [&](const std::string& name) {
            return std::find_if(p.variables.begin(), p.variables.end(),
                                [&](const RandomVariable& v) { return v.name == name; });
        };
        const auto a = find(c.first), b = find(c.second);
        if (a == p.variables.end() || b == p.variables.end() || a == b || a->kind != b->kind)
            return wrong(entry, "probability.correlation.between is not allowed.", "names of two variables of one kind",
                         "for example  between = [\"mu\", \"c\"]");
        c.spearman = entry["spearman"].value<double>().value_or(2.0);
        if (!(std::abs(c.spearman) < 1.0))
            return wrong(entry, "probability.correlation.spearman is not allowed.", "a number between -1 and 1",
                         "for example  spearman = -0.3");
        p.correlations.push_back(std::move(c));
    }

    void read_suite(std::optional<SuiteInput>& out)
    {
        const toml::table* table = table_named("suite");
        if (!table) return;
        SuiteInput& suite = out.emplace();
        check_keys(*table, "suite");
        if (const auto files = text(*table, "suite", "files")) suite.files = (file_.parent_path() / *files).string();
        if (const toml::node* files = table->get("files")) suite.where = {"suite.files", files->source().begin.line};
        choice(*table, "suite", "draw", suite.draw);
        choice(*table, "suite", "polarity", suite.polarity);
        number(*table, "suite", "max_scale", suite.max_scale);
        flag(*table, "suite", "allow_scaling", suite.allow_scaling);
    }

    void read_intensity(IntensityInput& in)
    {
        const toml::table* table = table_named("intensity");
        if (!table)
            return missing("[intensity]", "measure and levels",
                           "for example  [intensity] measure = \"PGA\" levels_g = [0.1, 0.2, 0.4]");
        struct Unit {
            const char *key, *text;
            double si;
            bool acceleration;
        };
        static constexpr Unit known_units[] = {{"levels_g", "g", units::standard_gravity, true},
                                               {"levels_m_s2", "m/s2", 1.0, true},
                                               {"levels_m_s", "m/s", 1.0, false},
                                               {"levels_cm_s", "cm/s", units::cm, false}};
        check_keys(*table, "intensity");
        in.text = text(*table, "intensity", "measure").value_or("PGA");
        if (const auto name = parse_intensity(in.text)) {
            in.measure = name->measure;
            in.first_period = name->first_period;
            in.periods = name->periods;
        } else {
            wrong(*table->get("measure"), fmt::format("intensity.measure = \"{}\" is not allowed.", in.text),
                  std::string(known_intensities), "write  measure = \"PGA\"");
        }
        choice(*table, "intensity", "component", in.component);
        choice(*table, "intensity", "design", in.design);
        int given = 0;
        for (const Unit& unit : known_units) {
            const toml::node* node = table->get(unit.key);
            if (!node) continue;
            ++given;
            in.level_unit = unit.si;
            in.level_unit_text = unit.text;
            const toml::array* list = node->as_array();
            bool good = list && !list->empty() && unit.acceleration == is_acceleration(in.measure);
            for (std::size_t i = 0; good && i < list->size(); ++i) {
                in.levels.push_back((*list)[i].value<double>().value_or(-1.0) * unit.si);
                good = in.levels[i] > 0.0 && (i == 0 || in.levels[i] > in.levels[i - 1]);
            }
            if (!good)
                wrong(*node, fmt::format("intensity.{} is not allowed.", unit.key),
                      fmt::format("ascending numbers > 0 in the unit of {}: levels_g or levels_m_s2 of accelerations, "
                                  "levels_m_s or levels_cm_s of PGV, IA and CAV",
                                  in.text),
                      is_acceleration(in.measure) ? "for example  levels_g = [0.1, 0.2, 0.4]"
                                                  : "for example  levels_m_s = [0.1, 0.2, 0.4]");
        }
        if (given != 1)
            wrong(*table, fmt::format("intensity has {} lists of levels.", given), "one",
                  "for example  levels_g = [0.1, 0.2, 0.4]");
    }

    void read_limits(std::vector<LimitInput>& limits)
    {
        const toml::node* node = root_.get("limit");
        if (!node)
            return missing("[[limit]]", "at least one", "for example  [[limit]] quantity = \"slip\" above_mm = 50");
        for_each_entry(root_, "limit", "[[limit]]", [&](const toml::table& entry) {
            check_keys(entry, "limit");
            LimitInput limit;
            choice(entry, "limit", "quantity", limit.quantity);
            if (const auto plane = text(entry, "limit", "plane")) limit.plane = *plane;
            const bool of_base = limit.plane == "base";
            if (!of_base && (limit.quantity == LimitQuantity::lift_off || limit.quantity == LimitQuantity::post_seismic_fs))
                wrong(entry, fmt::format("limit on plane \"{}\" that is not of slip.", limit.plane),
                      "slip or largest-slip: lifts and seams are rigid blocks", "delete plane");
            if (!limits.empty() && limit.plane != limits.front().plane)
                wrong(entry, fmt::format("limit on plane \"{}\" beside one on \"{}\".", limit.plane, limits.front().plane),
                      "one plane, or any, for all limits of a file", "write two files");
            int given = 0;
            const bool factor = limit.quantity == LimitQuantity::post_seismic_fs;
            if (factor != entry.contains("below")) {
                wrong(entry, factor ? "limit post-seismic-fs has no value." : "limit has below, which is of factors.",
                      factor ? "below, the least factor" : "above_mm, above_cm or above_m",
                      factor ? "for example  below = 1.1" : "for example  above_mm = 50");
                return;
            }
            if (factor) {
                number(entry, "limit", "below", limit.value);
                limit.text = fmt::format("factor after the earthquake < {}", limit.value);
                if (entry.contains("above_mm") || entry.contains("above_cm") || entry.contains("above_m"))
                    wrong(entry, "limit post-seismic-fs has below and above.", "below alone", "delete the other");
                limits.push_back(std::move(limit));
                return;
            }
            const char* const name = limit.quantity == LimitQuantity::slip       ? "slip"
                                     : limit.quantity == LimitQuantity::lift_off ? "opening of the base"
                                                                                 : "largest slip";
            for (const auto& [key, unit, si] :
                 {std::tuple{"above_mm", "mm", units::mm}, {"above_cm", "cm", units::cm}, {"above_m", "m", 1.0}}) {
                if (!entry.contains(key)) continue;
                ++given;
                double value = 0.0;
                number(entry, "limit", key, value);
                limit.value = value * si;
                limit.text = fmt::format("{} > {} {}{}{}", name, value, unit, of_base ? "" : " on ",
                                         of_base ? "" : limit.plane == "any" ? "any plane" : limit.plane);
            }
            if (given != 1)
                wrong(entry, fmt::format("limit has {} values.", given), "one of above_mm, above_cm, above_m",
                      "for example  above_mm = 50");
            limits.push_back(std::move(limit));
        });
    }

    void read_hazard(std::optional<HazardInput>& out)
    {
        const toml::table* table = table_named("hazard");
        if (!table) return;
        check_keys(*table, "hazard");
        HazardInput& hazard = out.emplace();
        const auto curve = text(*table, "hazard", "curve");
        if (!table->contains("curve"))
            return wrong(*table, "hazard.curve is missing.", "a CSV file: intensity, annual rate",
                         "for example  curve = \"hazard.csv\"");
        if (!curve) return;
        hazard.curve = file_.parent_path() / *curve;
        hazard.where = {"hazard.curve", table->get("curve")->source().begin.line};
        if (const toml::node* node = table->get("site")) {
            const toml::array* place = node->as_array();
            const auto degrees = [&](std::size_t i) {
                return place && place->size() == 2 ? finite_number((*place)[i]) : std::nullopt;
            };
            const Range& range = key_of("hazard", "site").range;
            if (degrees(0) && degrees(1) && range.contains(*degrees(0)) && std::abs(*degrees(1)) <= 90.0)
                hazard.site = {*degrees(0), *degrees(1)};
            else
                not_allowed(*node, "hazard", "site", "longitude and latitude in degrees", "[14.5, 46.05]");
        }
        double rate = 0.0;
        number(*table, "hazard", "all_events", rate);
        if (rate > 0.0) hazard.all_events = rate;
    }

    std::filesystem::path file_;
    SceneText text_;
    toml::table root_;
    std::vector<Diagnostic> wrong_;
};

} // namespace

FragilityInput read_fragility_input(const std::filesystem::path& file)
{
    return FragilityReader(read_file(file, 4u << 20), file).read();
}

std::vector<Diagnostic> wrong_in_fragility_tables(std::string_view text, const std::filesystem::path& file)
{
    return FragilityReader(text, file).look_over();
}

FragilityInput fragility_input_of(std::string_view text, std::string_view instead, const std::filesystem::path& file)
{
    FragilityReader reader(text, file);
    reader.replace(instead);
    return reader.read();
}

} // namespace damslip
