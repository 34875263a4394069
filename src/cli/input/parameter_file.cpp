#include "cli/input/parameter_file.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/number.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <sstream>

namespace damslip::cli {

namespace {

struct Word {
    std::string text;
    int line = 0;
};

constexpr std::size_t largest_parameter_file = 1u << 20;

std::vector<Word> words_of(const std::string& content)
{
    std::vector<Word> words;
    std::istringstream lines(content);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::istringstream parts(line);
        std::string part;
        while (parts >> part) words.push_back({part, number});
    }
    return words;
}

[[noreturn]] void refuse_line(const std::filesystem::path& file, int line, std::string problem, std::string expected,
                              std::string fix)
{
    throw InputError(Diagnostic{file.string(), line, 0, std::move(problem), std::move(expected), std::move(fix)});
}

KeyValue value_of(const std::string& text)
{
    if (const std::optional<double> number = parse_whole_number_text(text)) return *number;
    if (text == "true" || text == "false") return text == "true";
    return text;
}

/// Pairs "value tag", whichever of the two forms the file has.
class DakotaWords {
public:
    DakotaWords(std::filesystem::path file, const std::string& content)
        : file_(std::move(file)), words_(words_of(content)), aprepro_(!words_.empty() && words_.front().text == "{")
    {
    }

    struct Entry {
        std::string value, tag;
        int line = 0;
    };
    Entry next()
    {
        if (!aprepro_) return {take(), take(), line_};
        expect("{");
        Entry entry;
        entry.tag = take();
        expect("=");
        entry.value = take();
        entry.line = line_;
        std::erase(entry.value, '"');
        expect("}");
        return entry;
    }
    /// "2 variables", or "{ DAKOTA_VARS = 2 }"
    std::size_t count(const std::string& tag, const std::string& aprepro_tag)
    {
        const Entry entry = next();
        const std::optional<double> n = parse_whole_number_text(entry.value);
        if (entry.tag != (aprepro_ ? aprepro_tag : tag) || !n || *n < 0 || *n > 10000 || std::floor(*n) != *n)
            refuse_line(file_, entry.line, fmt::format("{} {} is no number of {}.", entry.value, entry.tag, tag),
                        fmt::format("a whole number and the word {}", tag),
                        "Dakota writes this file; do not change it");
        return static_cast<std::size_t>(*n);
    }
    const std::filesystem::path& file() const { return file_; }

private:
    std::string take()
    {
        if (at_ == words_.size())
            refuse_line(file_, line_, "the parameters file ends too early.",
                        "variables and functions, as Dakota writes them", "look whether Dakota could write it whole");
        line_ = words_[at_].line;
        return words_[at_++].text;
    }
    void expect(const std::string& word)
    {
        if (const std::string found = take(); found != word)
            refuse_line(file_, line_, fmt::format("\"{}\" stands where \"{}\" is expected.", found, word),
                        "{ name = value }", "Dakota writes this file; do not change it");
    }

    std::filesystem::path file_;
    std::vector<Word> words_;
    bool aprepro_;
    std::size_t at_ = 0;
    int line_ = 1;
};

} // namespace

DakotaQuestion read_dakota(const std::filesystem::path& file)
{
    DakotaWords words(file, read_file(file, largest_parameter_file));
    DakotaQuestion question;
    for (std::size_t left = words.count("variables", "DAKOTA_VARS"); left > 0; --left) {
        const DakotaWords::Entry entry = words.next();
        question.changes.push_back({entry.tag, value_of(entry.value)});
    }
    for (std::size_t left = words.count("functions", "DAKOTA_FNS"); left > 0; --left) {
        const DakotaWords::Entry entry = words.next(); // "1 ASV_1:slip_mm"
        if (entry.value != "0" && entry.value != "1")
            refuse_line(file, entry.line, fmt::format("{} {} asks for gradients.", entry.value, entry.tag),
                        "0 or 1: values alone", "write  no_gradients  and  no_hessians  to Dakota's responses");
        question.wanted.push_back(entry.value == "1");
        question.responses.push_back(entry.tag.substr(std::min(entry.tag.find(':'), entry.tag.size() - 1) + 1));
    }
    return question;
}

std::vector<KeyChange> read_quofem(const std::filesystem::path& file)
{
    const std::vector<Word> words = words_of(read_file(file, largest_parameter_file));
    const std::optional<double> n = words.empty() ? std::nullopt : parse_whole_number_text(words.front().text);
    if (!n || *n < 0 || static_cast<double>(words.size()) != 2 * *n + 1)
        refuse_line(file, 1, "this is no params.in of quoFEM.",
                    "the number of variables, then a name and a value a line", "look at the file that quoFEM wrote");
    std::vector<KeyChange> changes;
    for (std::size_t i = 1; i + 1 < words.size(); i += 2)
        changes.push_back({words[i].text, value_of(words[i + 1].text)});
    return changes;
}

} // namespace damslip::cli
