#include "fe2d/output/mesh_part.hpp"

namespace damslip::fe2d {

namespace {

Eigen::MatrixXd chosen_columns(const Eigen::MatrixXd& values, const std::vector<int>& columns)
{
    Eigen::MatrixXd chosen(values.rows(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) chosen.col(static_cast<Eigen::Index>(i)) = values.col(columns[i]);
    return chosen;
}

} // namespace

Eigen::MatrixXd MeshPart::at_nodes(const Eigen::MatrixXd& values) const
{
    return chosen_columns(values, nodes);
}

Eigen::MatrixXd MeshPart::at_elements(const Eigen::MatrixXd& values) const
{
    return chosen_columns(values, elements);
}

MeshPart part_of(const Mesh& mesh, int first, int end)
{
    MeshPart part;
    std::vector<int> place(mesh.nodes.size(), -1);
    const auto take = [&](int& node) {
        if (node < 0) return;
        int& at = place[static_cast<std::size_t>(node)];
        if (at < 0) {
            at = static_cast<int>(part.nodes.size());
            part.nodes.push_back(node);
            part.mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
        }
        node = at;
    };
    for (int e = first; e < end; ++e) {
        Element element = mesh.elements[static_cast<std::size_t>(e)];
        for (int& node : element.nodes) take(node);
        for (int& node : element.mid) take(node);
        take(element.centre);
        part.mesh.elements.push_back(element);
        part.elements.push_back(e);
    }
    return part;
}

} // namespace damslip::fe2d
