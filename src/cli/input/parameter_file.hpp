#pragma once

#include "scene/scene_text.hpp"

#include <filesystem>

namespace damslip::cli {

/// What a driver of Dakota asks for.
struct DakotaQuestion {
    std::vector<KeyChange> changes;
    std::vector<std::string> responses; ///< descriptors, in order
    std::vector<bool> wanted;           ///< of each response
};

/// Reads Dakota's parameters file, standard ("0.7 contact.friction") or aprepro ("{ contact.friction = 0.7 }"). Strings are
/// choices. @throws InputError for a file cut short, gradients asked for
DakotaQuestion read_dakota(const std::filesystem::path& file);

/// Reads quoFEM's params.in: the number of variables, then a name and a value a line. @throws InputError
std::vector<KeyChange> read_quofem(const std::filesystem::path& file);

} // namespace damslip::cli
