#pragma once

#include "core/file.hpp"

#include <filesystem>
#include <string>

namespace damslip {

/// While one lives, a command is on its way, and no file it reads may be one that its output goes to: read_file() refuses a
/// file named by keep_from_inputs(), FileWriter one that has been read and lies where output goes. Files the command has
/// written itself and those of the cache are no inputs. Commands within commands share what is known.
class InputsKept {
public:
    InputsKept();
    ~InputsKept();
    InputsKept(const InputsKept&) = delete;
    InputsKept& operator=(const InputsKept&) = delete;
};

/// Output goes to this file, or into this folder. Does nothing where no InputsKept lives. @param named  how the user gave it: "--out"
void keep_from_inputs(const std::filesystem::path& output, OutputPath kind, const std::string& named);

} // namespace damslip
