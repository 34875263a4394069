#include "records/read/read_record.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "records/read/format.hpp"

#include <fmt/format.h>

namespace damslip::records {

namespace {

constexpr std::string_view read_formats = "PEER AT2, COSMOS, CSMIP, BHRC, GeoNet, SMC, K-NET, ESM, CSV with a header "
                                          "row, time and acceleration in two columns, or samples "
                                          "with \"# dt: 0.01 s\"";

const RecordFormat& recognise(const RecordText& text)
{
    for (const RecordFormat& format : record_formats()) {
        if (!format.recognises(text)) continue;
        if (!format.read)
            refuse(text, {1, 0}, fmt::format("this looks like {}, which is not read.", format.name),
                   std::string(read_formats),
                   "convert the acceleration to one of these, or download the record in one of them");
        return format;
    }
    refuse(
        text, {1, 0},
        fmt::format("no accelerogram is recognised; the file starts with {}.", in_quotes(trimmed(text.lines.front()))),
        std::string(read_formats), "convert it to one of these");
}

} // namespace

std::vector<Record> parse_record(std::string_view content, std::string_view file_name, const ReadOptions& options)
{
    RecordText text = split_lines(content, file_name); // refuses what is no text by its first bytes as they are
    const std::string converted = is_utf8(content) ? std::string() : utf8_text(std::string(content));
    if (!converted.empty()) text = split_lines(converted, file_name);
    std::vector<Record> records = recognise(text).read(text, options);
    const std::string digest = sha256(content);
    for (Record& record : records) record.source.sha256 = digest;
    return records;
}

Record read_record(const std::filesystem::path& path, const ReadOptions& options)
{
    const std::string content = read_file(path);
    std::vector<Record> records = parse_record(content, path.string(), options);
    if (records.size() > 1) {
        std::string names;
        for (const Record& record : records) names += (names.empty() ? "" : ", ") + record.source.component;
        throw InputError(Diagnostic{
            path.string(), 0, 0, fmt::format("the file holds {} accelerograms: {}.", records.size(), names),
            "one, or a choice among them", "choose by --column (in a scene: motion.record.column, vertical_column)"});
    }
    return std::move(records.front());
}

} // namespace damslip::records
