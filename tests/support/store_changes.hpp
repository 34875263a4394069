#pragma once

#include <filesystem>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <string>

namespace damslip {

/// Runs SQL statements on a database, as its user may. @returns the first column of the last row
inline std::string sql(const std::filesystem::path& file, const std::string& statements)
{
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open_v2(file.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr), SQLITE_OK) << file;
    std::string last;
    const auto take = [](void* text, int, char** values, char**) {
        *static_cast<std::string*>(text) = values[0] ? values[0] : "";
        return 0;
    };
    EXPECT_EQ(sqlite3_exec(database, statements.c_str(), take, &last, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
    return last;
}

/// As a process that was stopped leaves it: without every n-th row, its table not written.
inline void leave_unfinished(const std::filesystem::path& store, int every)
{
    sql(store, "DELETE FROM rows WHERE id % " + std::to_string(every) + " = 0; UPDATE sweep SET done = 0");
}

} // namespace damslip
