#include "records/generate/spectrum_file.hpp"

#include "core/file.hpp"
#include "records/read/number_table.hpp"

#include <fmt/format.h>
#include <vector>

namespace damslip::records {

TargetSpectrum parse_target_spectrum(std::string_view content, std::string_view file_name)
{
    const RecordText text = split_lines(content, file_name);
    const NumberTable table = read_number_table(text);
    std::vector<SpectrumRow> rows;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (table.width(row) != 2)
            refuse(text, {table.row_line[row], 0},
                   fmt::format("{} numbers in a line of a target spectrum.", table.width(row)),
                   "two: period [s] and spectral acceleration", "correct the line");
        rows.push_back({table.values[table.row_begin[row]], table.values[table.row_begin[row] + 1]});
    }
    return table_spectrum(rows, std::string(file_name));
}

TargetSpectrum read_target_spectrum(const std::filesystem::path& path)
{
    return parse_target_spectrum(read_file(path), path.string());
}

std::optional<TargetSpectrum> find_target_spectrum(std::string_view word, const std::filesystem::path& file,
                                                   GroundType ground, MotionComponent component)
{
    if (word == "rock") return rock_spectrum();
    if (word == "ec8-1") return eurocode8_spectrum(Eurocode8Type::type_1, ground, component);
    if (word == "ec8-2") return eurocode8_spectrum(Eurocode8Type::type_2, ground, component);
    if (!std::filesystem::exists(file)) return std::nullopt;
    return read_target_spectrum(file);
}

} // namespace damslip::records
