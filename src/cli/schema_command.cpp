#include "cli/document.hpp"
#include "cli/flags.hpp"
#include "core/usage_error.hpp"
#include "scene/document.hpp"

#include <ostream>

namespace damslip::cli {

namespace {

struct SchemaArguments {
    bool markdown = false; ///< docs/scene-keys.md instead of the JSON Schema
};

int print_schema(const SchemaArguments& arguments, const Streams& streams)
{
    const std::string text = arguments.markdown ? scene_keys_markdown() : scene_schema(); // the schema is JSON itself
    if (!arguments.markdown || !put_json_document(streams, "schema", {{"markdown", text}})) streams.out << text;
    return exit_ok;
}

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
