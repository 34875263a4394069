#include "scene/checks.hpp"

#include <fmt/format.h>

namespace damslip::checks {

void check_mesh_file(const Scene& s, Findings& f, FileCheck files)
{
    if (!s.mesh.file) {
        if (f.given("mesh.file_unit"))
            f.wrong("mesh.file_unit", "mesh.file_unit_m is given without mesh.file.", "both, or neither",
                    "add  file = \"dam.msh\"  or delete file_unit_m");
        return;
    }
    const std::string file = s.mesh.file->string();
    for (const auto& [key, spelled] : {std::pair{"mesh.size", "mesh.size_m"},
                                       {"mesh.contact_size", "mesh.contact_size_m"},
                                       {"mesh.rock_contact_size", "mesh.rock_contact_size_m"},
                                       {"mesh.rock_size", "mesh.rock_size_m"},
                                       {"mesh.growth", "mesh.growth"}})
        if (f.given(key))
            f.wrong(key, fmt::format("{} is given together with mesh.file = \"{}\".", spelled, file),
                    "sizes of the program's own mesh, or an imported mesh, which has its own",
                    fmt::format("delete {} or mesh.file", spelled));
    std::error_code error;
    if (files == FileCheck::must_exist && !std::filesystem::is_regular_file(*s.mesh.file, error))
        f.wrong("mesh.file", fmt::format("mesh.file: there is no file {}.", file),
                "a Gmsh mesh, named relative to the scene file", "correct the name, or copy the file there");
}

} // namespace damslip::checks
