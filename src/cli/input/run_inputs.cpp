#include "cli/input/run_inputs.hpp"

#include "analysis/prepare/plane_model.hpp"
#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/record_list.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "scene/plausible.hpp"
#include "scene/read.hpp"
#include "scene/rock_mass.hpp"
#include "scene/scene_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iostream>
#include <optional>
#include <sstream>

namespace damslip::cli {

namespace {

constexpr const char* standard_input = "-";
constexpr const char* no_vertical = "none"; ///< stands for the vertical component that a record does not have
/// The records of the command line in place of the scene's.
std::vector<RecordFiles> command_line_records(const RunInputs& inputs)
{
    if (!inputs.verticals.empty() && inputs.verticals.size() != inputs.records.size())
        refuse_usage(
            fmt::format("{} --record and {} --vertical are given.", inputs.records.size(), inputs.verticals.size()),
            "no --vertical, or one for each --record in the same order; none for a record without one",
            "for example  --record a_h.at2 b_h.at2 --vertical a_v.at2 none");
    std::vector<RecordFiles> files;
    for (std::size_t i = 0; i < inputs.records.size(); ++i) {
        RecordFiles f;
        f.name = inputs.records[i].stem().string();
        f.horizontal = inputs.records[i];
        if (!inputs.verticals.empty() && inputs.verticals[i] != no_vertical) f.vertical = inputs.verticals[i];
        files.push_back(std::move(f));
    }
    number_names(files);
    return files;
}

/// The scene as its file, or standard input, says it.
Scene scene_as_written(const RunInputs& inputs)
{
    if (inputs.scene != standard_input) return read_scene(inputs.scene);
    constexpr std::size_t most = 4u << 20;
    std::string text(most + 1, '\0');
    std::cin.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(std::cin.gcount()));
    if (text.size() > most)
        refuse("standard input", "the scene has more than 4 MiB.", "a scene file (TOML)",
               "write the scene alone to standard input");
    return parse_scene(text, "standard input");
}

/// Those of --records, said one by one: what was paired with what is not to be guessed.
void put_record_list(const RunInputs& inputs, Scene& scene, std::vector<Diagnostic>& notes)
{
    RecordList list = record_list(inputs.record_list, inputs.column.empty());
    if (list.records.empty())
        refuse_usage(fmt::format("--records {}: there is no record.", inputs.record_list),
                     "a folder, a pattern in quotes, or a CSV with the column horizontal",
                     "for example  --records 'suite/*.AT2'");
    if (!list.made.empty()) notes.push_back({"", 0, 0, list.made, "", ""});
    for (const std::string& note : list.notes) notes.push_back({"", 0, 0, note, "", ""});
    scene.motion.records = std::move(list.records);
    scene.motion.sequence.clear();
}

void put_records(const RunInputs& inputs, Scene& scene)
{
    if (!inputs.record_list.empty() && !inputs.records.empty())
        refuse_usage("--record and --records are both given.", "one of them", "delete one");
    if (!inputs.record_list.empty()) put_record_list(inputs, scene, scene.notes);
    if (!inputs.verticals.empty() && inputs.records.empty())
        refuse_usage("--vertical is given without --record.", "a --record for each --vertical", "add  --record FILE");
    if (!inputs.records.empty()) {
        scene.motion.records = command_line_records(inputs);
        scene.motion.sequence.clear(); // of the scene's own records
    }
    for (RecordFiles& record : scene.motion.records) {
        if (record.unit.empty()) record.unit = inputs.unit;
        if (!record.dt) record.dt = inputs.dt;
        if (record.column.empty()) record.column = inputs.column;
        if (record.vertical && record.vertical_column.empty()) record.vertical_column = inputs.vertical_column;
    }
}

void note_arguments(const RunInputs& inputs, std::vector<Diagnostic>& notes)
{
    const auto look_at = [&notes](const char* flag, const char* key, const std::optional<double>& value) {
        if (!value) return;
        if (auto note = unusual_argument(fmt::format("{} {}", flag, shortest(*value)), key, *value))
            notes.push_back(std::move(*note));
    };
    look_at("--friction", "contact.friction", inputs.friction);
    look_at("--scale", "motion.scale", inputs.scale);
    look_at("--dt", "motion.record.dt", inputs.dt);
}

} // namespace

std::string single_quoted(const std::string& word)
{
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string(R"('\'')") : std::string(1, c);
    return quoted + "'";
}

std::string shell_quoted(const std::string& word)
{
    const std::string_view safe = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./:,@%=";
    const bool plain = !word.empty() && word.find_first_not_of(safe) == std::string::npos;
    return plain ? word : single_quoted(word);
}

std::string shell_words(const RunInputs& in)
{
    std::string line = shell_quoted(in.scene.string());
    const auto add = [&line](const char* flag, const std::string& value) {
        if (!value.empty()) line += fmt::format(" {} {}", flag, shell_quoted(value));
    };
    add("--records", in.record_list);
    for (const auto& record : in.records) add("--record", record.string());
    for (const auto& vertical : in.verticals) add("--vertical", vertical.string());
    add("--units", in.unit);
    if (in.dt) add("--dt", shortest(*in.dt));
    add("--column", in.column);
    add("--plane", in.plane);
    add("--vertical-column", in.vertical_column);
    return line;
}

Scene read_run_scene(const RunInputs& inputs, const Streams& streams)
{
    Scene scene = scene_as_written(inputs);
    put_records(inputs, scene);
    if (inputs.plane != base_plane) scene.planes.slides_on = inputs.plane;
    if (inputs.friction) {
        if (!(*inputs.friction >= 0 && *inputs.friction <= 10))
            refuse_usage(fmt::format("--friction {} is not allowed.", *inputs.friction), "Coulomb mu, 0 ... 10",
                         "for example  --friction 0.77");
        scene = with_friction(scene, *inputs.friction);
    }
    if (!inputs.rock.empty()) {
        if (!scene.foundation)
            refuse_usage(fmt::format("--rock {} with a scene without [foundation].", inputs.rock),
                         "a scene with rock: [foundation] and its young_modulus_GPa",
                         "add  [foundation]  with  young_modulus_GPa = 30  to the scene");
        scene = inputs.rock == "massless" ? with_massless_rock(scene) : with_radiating_rock(scene);
    }
    if (inputs.scale) {
        if (!(*inputs.scale >= 0 && std::isfinite(*inputs.scale)))
            refuse_usage(fmt::format("--scale {} is not allowed.", *inputs.scale), "a factor >= 0",
                         "for example  --scale 1.5");
        scene.motion.scale *= *inputs.scale;
    }
    if (!inputs.scheme.empty()) {
        if (inputs.scheme != "exact" && inputs.scheme != "slammer")
            refuse_usage(fmt::format("--scheme {} is not known.", inputs.scheme), "exact or slammer",
                         "for example  --scheme slammer");
        scene.sliding.scheme = inputs.scheme == "slammer" ? SlidingScheme::slammer : SlidingScheme::exact;
    }
    note_arguments(inputs, scene.notes);
    say(scene.notes, inputs.strict, streams);
    return scene;
}

std::optional<Diagnostic> unusual_argument(const std::string& subject, const std::string& key, double value)
{
    const Key of = key_named(key);
    return unusual(of, {subject, value, of.units.front(), false});
}

void say(const std::vector<Diagnostic>& notes, bool strict, const Streams& streams)
{
    if (strict && !notes.empty()) throw InputError(notes);
    for (const Diagnostic& note : notes) streams.remark("note: " + note_text(note));
}

void say_base(const Scene& scene, const Streams& streams)
{
    if (const std::optional<std::string> note = base_note(scene)) streams.remark("warning: " + *note);
}

void need_scene_file(const RunInputs& inputs, const std::string& flag)
{
    if (inputs.scene != standard_input) return;
    refuse_usage(fmt::format("{} with a scene from standard input.", flag),
                 "a scene file: each of the commands reads it anew", "write the scene to a file");
}

void need_section(const Scene& scene, const std::string& command, const std::string& instead)
{
    if (!scene.wedge) return;
    refuse(scene.file, fmt::format("{} cannot take a [wedge]: it has no section for finite elements.", command),
           "a scene with [section], [dam] and [contact]", instead);
}

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
