#include "cli/schema_command.hpp"

#include "core/usage_error.hpp"
#include "scene/document.hpp"

#include <ostream>

namespace damslip::cli {

int print_schema(const SchemaArguments& arguments, const Streams& streams)
{
    streams.out << (arguments.markdown ? scene_keys_markdown() : scene_schema());
    return exit_ok;
}

} // namespace damslip::cli
