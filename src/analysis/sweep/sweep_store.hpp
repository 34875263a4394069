#pragma once

#include "analysis/sweep/result_store.hpp"
#include "analysis/sweep/sweep_grid.hpp"

namespace damslip {

/// What a table says of a row beside the results, for ResultStore::describe(): axes, names, rock, PGA.
std::string axes_json(const Grid& grid);

/// The grid of a stored sweep, as far as its table needs it: without models and motions. @param axes  of axes_json()
Grid stored_grid(const std::string& axes);

/// Parts put together.
struct MergedSweep {
    std::unique_ptr<ResultStore> whole;
    std::size_t parts = 0;
};

/// The rows of all parts of a sweep in one store.
/// @param paths  stores of parts, or folders: all files named *.i-of-n.sqlite in them
/// @param file   of the whole; empty: a temporary one
/// @throws InputError naming the parts that are missing, given twice, unfinished, damaged or of another sweep
MergedSweep merge_parts(const std::vector<std::filesystem::path>& paths, const std::filesystem::path& file);

} // namespace damslip
