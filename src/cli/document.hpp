#pragma once

#include "cli/terminal/streams.hpp"

#include <initializer_list>
#include <string>
#include <utility>

namespace damslip::cli {

/// The --json object of a command whose answer is a text or a file, such as a drawing or a script: printed where --json was asked for.
/// @param what  of the schema: "draw" @param members  names and texts @returns whether it was printed
bool put_json_document(const Streams& streams, const std::string& what,
                       std::initializer_list<std::pair<const char*, std::string>> members);

} // namespace damslip::cli
