#pragma once

#include "records/read/read_record.hpp"

#include <span>

namespace damslip::records {

/// A file format: how its content is known and how it is read. To add one: docs/recipes.md.
struct RecordFormat {
    std::string_view name;
    bool (*recognises)(const RecordText& text);
    std::vector<Record> (*read)(const RecordText& text,
                                const ReadOptions& options); ///< null: known by sight, not read yet
};

/// All formats, in the order they are tried; plain columns come last.
std::span<const RecordFormat> record_formats();

} // namespace damslip::records
