#pragma once

#include "core/stop.hpp"
#include "core/table.hpp"

#include <filesystem>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace damslip::cli {

enum class Form { text, json };

/// Where a command puts what it has to say: data on `out`, talk and progress on `talk`. Control characters other than
/// newline and tab reach neither of them.
struct Streams {
    std::ostream& out;
    std::ostream& talk;
    Form form = Form::text;
    bool quiet = false;          ///< no talk but errors
    bool terminal = false;       ///< `talk` is a terminal: progress is drawn
    std::ostream* bar = nullptr; ///< the terminal itself, for a bar that is drawn over; null: no terminal
    StopAsked stop = {};         ///< does the user want the command to end? empty: never
};

/// Table rows as a JSON array for a command's --json object.
nlohmann::ordered_json json_of(const Table& table);

/// {"schema": "damslip.<what>/1", "program": {...}}: how each --json object begins.
nlohmann::ordered_json json_header(const std::string& what);

std::string program_version();

} // namespace damslip::cli
