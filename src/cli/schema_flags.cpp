#include "cli/flags.hpp"
#include "cli/schema_command.hpp"

namespace damslip::cli {

namespace {

void schema_flags(CLI::App& sub, SchemaArguments& a)
{
    sub.add_flag("--markdown", a.markdown, "the same keys as a Markdown document");
}

} // namespace

Command schema_command()
{
    return {"schema", "JSON Schema of the scene file", "damslip schema > scene.schema.json",
            with_flags<SchemaArguments>(schema_flags, print_schema)};
}

} // namespace damslip::cli
