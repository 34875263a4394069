#pragma once

#include "core/csv.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace damslip::records {

/// Artificial record, or pair of records, that a list of seeds names; its files are there.
struct SeededPair {
    std::string name, event;
    std::filesystem::path horizontal;
    std::optional<std::filesystem::path> vertical;
    double weight = 1.0; ///< > 0 [-]
};

struct SeededSuite {
    std::vector<SeededPair> pairs;
    std::filesystem::path folder; ///< where the records are
    std::size_t made = 0;         ///< pairs that were made now; the others were there
};

/// The columns of a list of seeds.
inline constexpr std::string_view seed_columns =
    "name, seed, pga_m_s2 and, as far as they are wanted, target, ground, duration_s, dt_s, tolerance, vertical, "
    "vertical_pga_m_s2, vertical_tolerance, event, weight";

/// What a list of records or seeds has to be: columns of `known` alone, each once, those of `needed` among them, and in no line more fields than
/// headings, as a decimal comma makes them. Shorter lines leave the last columns empty. @param columns  all of them, for messages
/// @throws InputError with file and line
void check_list(const std::filesystem::path& list, const CsvTable& table, const std::vector<std::string>& known,
                const std::vector<std::string>& needed, std::string_view columns);

/// Whether the heading of a CSV says that it is a list of seeds: it has a column `seed`.
bool is_seed_list(std::string_view text);

/// The records of a list of seeds, made as `damslip record generate` makes them. They go to the folder beside the list that has its name
/// without extension, or, where that cannot be written, to the cache folder; what is there and was made of the same line is kept, so that only
/// the first use takes time. Columns: name of the files, NAME_h.csv and NAME_v.csv; seed, a whole number >= 0; pga_m_s2 of the horizontal component;
/// target: rock (usual), ec8-1, ec8-2 or a file from the list's folder; ground A (usual) ... E; duration_s, 20; dt_s, 0.01; tolerance of the
/// match, 0.1; vertical: yes (usual) or no, with a random stream of its own, its PGA and tolerance those of the horizontal unless said;
/// event, the name; weight, 1.
/// @param jobs  threads; 0: all cores
/// @throws InputError with file and line for what is not allowed, and for a seed whose spectrum misses the tolerance
SeededSuite records_of_seeds(const std::filesystem::path& list, int jobs = 0);

} // namespace damslip::records
