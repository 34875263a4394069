#include "fe2d/mesh/import_mesh.hpp"

#include "core/input_error.hpp"
#include "fe2d/gmsh/read_gmsh.hpp"
#include "fe2d/mesh/imported_body.hpp"
#include "scene/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

namespace {

constexpr double same_place = 1e-6; ///< share of the base length within which nodes of one body are the same node

const std::vector<std::string> surface_names{"dam", "rock", "curtain"};
const std::vector<std::string> line_names{"base",   "upstream",  "downstream", "crest",      "floor",
                                          "ground", "rock-left", "rock-right", "rock-bottom"};

constexpr const char* name_surfaces =
    "in Gmsh:  Physical Surface(\"dam\") = {...};  Physical Surface(\"rock\") = {...};";

std::string zone_of(const std::string& name)
{
    return name.substr(0, name.find(':'));
}

void check_names(const GmshFile& file)
{
    for (const GmshGroup& group : file.groups) {
        if (group.dimension == 0 || group.dimension == 3) continue;
        const std::vector<std::string>& known = group.dimension == 2 ? surface_names : line_names;
        const std::string name = group.dimension == 2 ? zone_of(group.name) : group.name;
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        const std::string_view like = nearest(name, known);
        if (group.dimension == 1 && like.empty()) continue; // a line for somebody else
        const bool water = name == "water" || name == "reservoir";
        refuse_mesh(file, group.line,
                    fmt::format("physical {} \"{}\" is not known.{}", group.dimension == 2 ? "surface" : "line",
                                group.name, like.empty() ? "" : fmt::format(" Did you mean \"{}\"?", like)),
                    fmt::format("\"{}\"{}", fmt::join(known, "\", \""),
                                group.dimension == 2 ? ", each also with a zone: \"rock:weathered\"" : ""),
                    water ? "take the water out of the mesh: the program meshes it from [reservoir] itself"
                          : "rename the group, or take it out of the mesh");
    }
}

Region region_of(const std::string& name)
{
    const std::string zone = zone_of(name);
    return zone == "dam" ? Region::dam : zone == "rock" ? Region::rock : Region::curtain;
}

/// Region of every triangle and quadrilateral by the names of its groups; lines have none.
std::vector<std::optional<Region>> regions_of(const GmshFile& file)
{
    std::vector<std::optional<Region>> regions(file.elements.size());
    for (std::size_t e = 0; e < file.elements.size(); ++e) {
        const GmshElement& element = file.elements[e];
        if (dimension(element.shape) != 2) continue;
        for (const GmshGroup& group : file.groups) {
            if (group.dimension != 2 ||
                std::find(element.groups.begin(), element.groups.end(), group.tag) == element.groups.end())
                continue;
            const Region region = region_of(group.name);
            if (regions[e] && *regions[e] != region)
                refuse_mesh(
                    file, element.line,
                    fmt::format("element {} belongs to two bodies, one of them \"{}\".", element.tag, group.name),
                    "each surface in one of \"dam\", \"rock\", \"curtain\"", name_surfaces);
            regions[e] = region;
        }
        if (!regions[e])
            refuse_mesh(file, element.line,
                        fmt::format("element {} is in no physical surface with a name.", element.tag),
                        "every triangle and quadrilateral in \"dam\", \"rock\" or \"curtain\"", name_surfaces);
    }
    return regions;
}

/// The regions that one body consists of, as the scene wants them.
std::vector<std::optional<Region>> only(const std::vector<std::optional<Region>>& regions, const Scene& scene,
                                        Region body)
{
    std::vector<std::optional<Region>> result = regions;
    for (std::optional<Region>& region : result) {
        if (!region) continue;
        if ((*region == Region::dam) != (body == Region::dam))
            region.reset();
        else if (*region == Region::curtain && !curtain_is_meshed(scene))
            region = Region::rock;
    }
    return result;
}

void check_bodies(const GmshFile& file, const std::vector<std::optional<Region>>& regions, const Scene& scene)
{
    const auto there = [&](Region region) {
        return std::find(regions.begin(), regions.end(), region) != regions.end();
    };
    if (!there(Region::dam))
        refuse_mesh(file, 0, "the mesh has no dam.", "triangles or quadrilaterals in the physical surface \"dam\"",
                    name_surfaces);
    if (scene.foundation && !there(Region::rock))
        refuse_mesh(file, 0, fmt::format("the mesh has no rock, but {} has a [foundation].", scene.file.string()),
                    "triangles or quadrilaterals in the physical surface \"rock\"",
                    "mesh the rock too, or delete [foundation] for a rigid base");
    if (curtain_is_meshed(scene) && !there(Region::curtain))
        refuse_mesh(
            file, 0, "the mesh has no curtain, but the scene's differs from the rock.",
            "triangles or quadrilaterals in the physical surface \"curtain\"",
            "mesh the curtain as a surface of its own; or give it the rock's stiffness and no flow on this mesh "
            "(stages.pore_pressure)");
    if (scene.foundation && scene.drains && scene.stages.pore_pressure != PorePressure::none)
        refuse_mesh(file, 0, "stages.pore_pressure with [drains] needs nodes along the drain line.",
                    "no drains, or no flow on this mesh, where the mesh is imported",
                    "delete stages.pore_pressure: uplift.model = \"seepage\" has a mesh of its own, with drains");
}

/// Coordinates in metres; the section lies in one plane.
void to_metres(GmshFile& file, double unit)
{
    double size = 0.0;
    for (const GmshNode& node : file.nodes) size = std::max({size, std::abs(node.at.x), std::abs(node.at.y)});
    for (GmshNode& node : file.nodes) {
        if (std::abs(node.z - file.nodes.front().z) > same_place * size)
            refuse_mesh(
                file, node.line,
                fmt::format("node {} has z = {:g}, the first one {:g}.", node.tag, node.z, file.nodes.front().z),
                "a plane section: x downstream, y up, z the same everywhere", "turn the geometry into the x-y plane");
        node.at = {unit * node.at.x, unit * node.at.y};
    }
}

} // namespace

ImportedMesh import_mesh(const Scene& scene, const ContactExtension& extension)
{
    return import_mesh(read_gmsh(*scene.mesh.file), scene, extension);
}

ImportedMesh import_mesh(GmshFile file, const Scene& scene, const ContactExtension& extension)
{
    to_metres(file, scene.mesh.file_unit);
    check_names(file);
    const auto regions = regions_of(file);
    check_bodies(file, regions, scene);

    const double tolerance = same_place * base_length(scene.section);
    ImportedMesh imported;
    ImportSummary& summary = imported.summary;
    summary.version = file.version;
    summary.file_nodes = static_cast<int>(file.nodes.size());
    std::vector<char> used(file.nodes.size(), 0);
    const auto count = [&](const ImportedBody& body) {
        for (std::size_t n = 0; n < used.size(); ++n)
            if (body.own_node[n] >= 0) used[n] = 1;
        summary.joined += body.joined;
        summary.flipped += body.flipped;
    };
    const ImportedBody dam = take_body(file, "dam", only(regions, scene, Region::dam), tolerance);
    append_imported_dam(imported.mesh, file, dam, scene);
    count(dam);
    if (scene.foundation) {
        const ImportedBody rock = take_body(file, "rock", only(regions, scene, Region::rock), tolerance);
        append_imported_rock(imported.mesh, file, rock, scene, extension);
        count(rock);
        if (!imported.mesh.contact.matching && scene.stages.pore_pressure == PorePressure::effective)
            refuse_mesh(file, 0, "the nodes of dam and rock do not face each other along the base.",
                        "the same nodes on both sides for stages.pore_pressure = \"effective\"",
                        "let dam and rock share the curve from heel to toe, or use  pore_pressure = \"total\"");
    }
    summary.unused = static_cast<int>(std::count(used.begin(), used.end(), 0));
    return imported;
}

} // namespace damslip::fe2d
