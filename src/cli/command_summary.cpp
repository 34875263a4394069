#include "cli/command_summary.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>

namespace damslip::cli {

namespace {

/// "TEXT:{contact,tied}", "INT:INT in [1 - 1000]": kind, choices, range.
void read_type(const std::string& type, OptionSummary& option)
{
    const std::size_t colon = type.find(':');
    option.value = type.substr(0, colon);
    if (colon == std::string::npos) return;
    const std::string rule = type.substr(colon + 1);
    const std::size_t open = rule.find_first_of("{["), close = rule.find_last_of("}]");
    if (open == std::string::npos || close == std::string::npos || close < open) return;
    const std::string inside = rule.substr(open + 1, close - open - 1);
    if (rule[open] == '[') {
        option.range = inside;
        return;
    }
    std::istringstream words(inside);
    for (std::string word; std::getline(words, word, ',');) option.choices.push_back(word);
}

OptionSummary summary_of(const CLI::Option& option)
{
    OptionSummary s;
    s.positional = option.get_positional();
    s.name = s.positional ? option.get_name(true) : "";
    if (!s.positional && !option.get_lnames().empty()) s.name = "--" + option.get_lnames().front();
    if (!option.get_snames().empty()) s.short_name = "-" + option.get_snames().front();
    if (option.get_items_expected_max() > 0) read_type(option.get_type_name(), s);
    s.default_value = option.get_default_str();
    s.text = option.get_description();
    s.group = option.get_group();
    s.required = option.get_required();
    s.repeated = option.get_items_expected_max() > 1;
    return s;
}

void add_summaries(const CLI::App& app, const std::string& name, std::vector<CommandSummary>& out)
{
    CommandSummary summary{name, app.get_description(), {}, app.get_footer(), false};
    for (const CLI::Option* option : app.get_options()) summary.options.push_back(summary_of(*option));
    std::stable_partition(summary.options.begin(), summary.options.end(),
                          [](const OptionSummary& o) { return o.positional; });
    const auto below = app.get_subcommands([](const CLI::App*) { return true; });
    summary.has_subcommands = !below.empty();
    out.push_back(std::move(summary));
    for (const CLI::App* sub : below) add_summaries(*sub, (name.empty() ? "" : name + " ") + sub->get_name(), out);
}

} // namespace

std::vector<CommandSummary> summaries_of(const CLI::App& app)
{
    std::vector<CommandSummary> out;
    add_summaries(app, "", out);
    return out;
}

} // namespace damslip::cli
