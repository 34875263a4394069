#pragma once

#include "cli/terminal/streams.hpp"

namespace damslip::cli {

struct SchemaArguments {
    bool markdown = false; ///< docs/scene-keys.md instead of the JSON Schema
};

int print_schema(const SchemaArguments& arguments, const Streams& streams);

} // namespace damslip::cli
