#include "fe2d/mesh/mesh.hpp"

namespace damslip::fe2d {

std::array<Point, 4> corners(const Mesh& mesh, const Element& element)
{
    std::array<Point, 4> result{};
    for (int i = 0; i < element.size(); ++i) result[i] = mesh.nodes[element.nodes[i]];
    return result;
}

} // namespace damslip::fe2d
