// Gmsh files: any bytes either give a file whose nodes and elements keep the promises of gmsh_file.hpp, and a mesh of the scene or an
// InputError. What was read and has one group for each element is written in both versions and must read back alike.
#include "core/input_error.hpp"
#include "fe2d/gmsh/gmsh.hpp"
#include "fe2d/mesh/faces.hpp"
#include "fe2d/mesh/import_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

void demand(bool condition)
{
    if (!condition) std::abort();
}

void check(const GmshFile& file)
{
    for (std::size_t n = 0; n < file.nodes.size(); ++n) {
        demand(std::isfinite(file.nodes[n].at.x) && std::isfinite(file.nodes[n].at.y));
        demand(n == 0 || file.nodes[n - 1].tag < file.nodes[n].tag);
    }
    for (const GmshElement& e : file.elements)
        for (int i = 0; i < 4; ++i)
            demand(i < node_count(e.shape) ? e.nodes[i] >= 0 && e.nodes[i] < static_cast<int>(file.nodes.size())
                                           : e.nodes[i] == -1);
}

/// Every element in one group that has a name, as the writer asks for; a surface group among them.
bool writable(const GmshFile& file)
{
    const auto has_surface =
        std::any_of(file.groups.begin(), file.groups.end(), [](auto& g) { return g.dimension == 2; });
    return has_surface && !file.nodes.empty() &&
           std::all_of(file.groups.begin(), file.groups.end(),
                       [](auto& g) { return g.tag > 0 && g.name.find('\n') == std::string::npos; }) &&
           std::all_of(file.elements.begin(), file.elements.end(), [&](const GmshElement& e) {
               return e.groups.size() == 1 && std::any_of(file.groups.begin(), file.groups.end(), [&](auto& g) {
                          return g.dimension == dimension(e.shape) && g.tag == e.groups.front();
                      });
           });
}

void check_written(const GmshFile& file, GmshVersion version)
{
    const GmshFile back = parse_gmsh(gmsh_text(file, version), "written");
    demand(back.nodes.size() == file.nodes.size() && back.elements.size() == file.elements.size());
    for (std::size_t n = 0; n < file.nodes.size(); ++n)
        demand(back.nodes[n].tag == file.nodes[n].tag && back.nodes[n].at == file.nodes[n].at);
    for (std::size_t e = 0; e < file.elements.size(); ++e)
        demand(back.elements[e].nodes == file.elements[e].nodes && back.elements[e].groups == file.elements[e].groups);
}

/// The dam 2 m x 2 m on rock that the corpus has.
Scene scene()
{
    Scene scene;
    scene.section.polygon = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    scene.dam = {2500.0, 25e9, 0.17};
    scene.foundation = Foundation{.material = {0.0, 30e9, 0.2}, .mass = RockMass::massless, .width = 6.0, .depth = 2.0};
    return scene;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const GmshFile file = parse_gmsh(text, "fuzz.msh");
        check(file);
        if (writable(file))
            for (const GmshVersion version : {GmshVersion::v2_2, GmshVersion::v4_1}) check_written(file, version);
        Scene given = scene();
        if (size % 2) given.lift_joints.push_back({.name = "lift", .elevation = 1.0, .strength = {}});
        const Mesh mesh = import_mesh(file, given).mesh;
        demand(mesh.has_rock() && mesh.contact.dam_nodes.size() >= 2);
        demand(measure_quality(mesh).smallest_scaled_jacobian > 0.0);
    } catch (const InputError& error) {
        demand(!error.diagnostics().empty() && !error.diagnostics().front().problem.empty());
    }
    return 0;
}
