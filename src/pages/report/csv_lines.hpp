#pragma once

#include "core/csv.hpp"

#include <string>
#include <vector>

namespace damslip::pages {

/// Comments and the header row of csv().
std::string csv_head(const std::vector<Column>& columns, const std::vector<std::string>& comments = {});

/// The rows of csv() one by one. A value that stands in the row above, or beside it, is not written anew but copied.
class CsvLines {
public:
    /// @param row  of as many cells each time  @param out  its line comes at the end
    void add(const std::vector<Cell>& row, std::string& out);

private:
    struct Field {
        Cell cell;
        std::string text;
    };
    std::vector<Field> last_; ///< of each column, where it had a value
};

} // namespace damslip::pages
