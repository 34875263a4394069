#pragma once

#include "cli/terminal/streams.hpp"
#include "pages/scene/scene_template.hpp"

namespace damslip::cli {

struct InitArguments {
    std::filesystem::path out = "dam.toml";
    pages::SceneTemplate dam;
    bool force = false; ///< replaces a file
};

/// Writes a commented scene and its drawing beside it. Asks for what is missing where somebody sits at the terminal.
int init(const InitArguments& arguments, const Streams& streams);

} // namespace damslip::cli
