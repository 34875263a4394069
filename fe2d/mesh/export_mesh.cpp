#include "fe2d/mesh/export_mesh.hpp"

#include <cassert>

namespace damslip::fe2d {

namespace {

class MeshExport {
public:
    MeshExport(const Mesh& mesh, BaseNodes base) : mesh_(mesh), node_of_(mesh.nodes.size())
    {
        for (std::size_t n = 0; n < node_of_.size(); ++n) node_of_[n] = static_cast<int>(n);
        const ContactPlane& plane = mesh.contact;
        if (base == BaseNodes::shared) {
            assert(plane.matching);
            for (std::size_t i = 0; i < plane.rock_nodes.size(); ++i)
                node_of_[plane.rock_nodes[i]] = plane.dam_nodes[i];
        }
        std::vector<int> place(mesh.nodes.size(), -1);
        for (std::size_t n = 0; n < node_of_.size(); ++n) {
            if (node_of_[n] != static_cast<int>(n)) continue;
            place[n] = static_cast<int>(file_.nodes.size());
            file_.nodes.push_back({static_cast<std::int64_t>(n) + 1, mesh.nodes[n], 0.0, 0});
        }
        for (int& n : node_of_) n = place[n];
    }

    /// A physical line of the edges of a chain; those of no length (at lift joints) are left out.
    void add_line(const char* name, const NodeChain& chain)
    {
        if (chain.size() < 2) return;
        const int tag = add_group(1, name);
        for (std::size_t i = 0; i + 1 < chain.size(); ++i)
            if (mesh_.nodes[chain[i]] != mesh_.nodes[chain[i + 1]])
                add_element(GmshShape::line, {node_of_[chain[i]], node_of_[chain[i + 1]], -1, -1}, tag);
    }

    void add_surfaces()
    {
        int tags[region_count] = {};
        const char* names[region_count] = {"dam", "rock", "curtain", ""};
        for (const Element& element : mesh_.elements) {
            const auto region = static_cast<int>(element.region);
            assert(element.region != Region::reservoir);
            if (tags[region] == 0) tags[region] = add_group(2, names[region]);
            std::array<int, 4> nodes{-1, -1, -1, -1};
            for (int i = 0; i < element.size(); ++i) nodes[i] = node_of_[element.nodes[i]];
            add_element(element.size() == 3 ? GmshShape::triangle : GmshShape::quadrilateral, nodes, tags[region]);
        }
    }

    GmshFile file() && { return std::move(file_); }

private:
    int add_group(int dimension, const char* name)
    {
        file_.groups.push_back({dimension, static_cast<int>(file_.groups.size()) + 1, name, 0});
        return file_.groups.back().tag;
    }

    void add_element(GmshShape shape, std::array<int, 4> nodes, int group)
    {
        file_.elements.push_back({static_cast<std::int64_t>(file_.elements.size()) + 1, shape, nodes, {group}, 0});
    }

    const Mesh& mesh_;
    GmshFile file_;
    std::vector<int> node_of_; ///< in the file, of every node of the mesh
};

} // namespace

GmshFile export_mesh(const Mesh& mesh, BaseNodes base)
{
    MeshExport out(mesh, base);
    out.add_line("base", mesh.contact.dam_nodes);
    out.add_line("downstream", mesh.downstream_face);
    out.add_line("crest", mesh.crest);
    out.add_line("upstream", mesh.upstream_face);
    out.add_line("floor", mesh.floor);
    out.add_line("rock-left", mesh.box_left);
    out.add_line("rock-bottom", mesh.box_bottom);
    out.add_line("rock-right", mesh.box_right);
    out.add_line("ground", mesh.ground);
    out.add_surfaces();
    return std::move(out).file();
}

} // namespace damslip::fe2d
