#pragma once

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace damslip {

/// Rows of a CSV of the program by the names of its columns; comments are passed over.
inline std::vector<std::map<std::string, std::string>> csv_rows(const std::string& text)
{
    std::vector<std::string> head;
    std::vector<std::map<std::string, std::string>> rows;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with('#')) continue;
        std::vector<std::string> cells(1);
        for (const char c : line)
            if (c == ',')
                cells.emplace_back();
            else
                cells.back() += c;
        if (head.empty()) {
            head = cells;
            continue;
        }
        auto& row = rows.emplace_back();
        for (std::size_t i = 0; i < head.size(); ++i) row[head[i]] = cells.at(i);
    }
    return rows;
}

} // namespace damslip
