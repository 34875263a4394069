#include "fe2d/run/node_order.hpp"

#include <Eigen/OrderingMethods>

#include <cassert>

namespace damslip::fe2d {

Eigen::VectorXd NodeOrder::to_new(const Eigen::VectorXd& old_vector) const
{
    Eigen::VectorXd result(old_vector.size());
    for (int k = 0; k < nodes(); ++k) result.segment<2>(2 * k) = old_vector.segment<2>(2 * old_node[k]);
    return result;
}

Eigen::VectorXd NodeOrder::to_old(const Eigen::VectorXd& new_vector) const
{
    Eigen::VectorXd result(new_vector.size());
    for (int k = 0; k < nodes(); ++k) result.segment<2>(2 * old_node[k]) = new_vector.segment<2>(2 * k);
    return result;
}

SparseMatrix NodeOrder::to_new(const SparseMatrix& old_matrix) const
{
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(old_matrix.nonZeros()));
    const auto place = [&](int unknown) { return 2 * new_node[unknown / 2] + unknown % 2; };
    for (int column = 0; column < old_matrix.outerSize(); ++column)
        for (SparseMatrix::InnerIterator it(old_matrix, column); it; ++it)
            entries.emplace_back(place(static_cast<int>(it.row())), place(column), it.value());
    SparseMatrix result(old_matrix.rows(), old_matrix.cols());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

NodeOrder interface_last(const SparseMatrix& matrix, std::span<const int> interface_nodes)
{
    assert(matrix.rows() % 2 == 0);
    const int nodes = static_cast<int>(matrix.rows() / 2);
    NodeOrder order;
    order.new_node.assign(nodes, 0);
    for (const int node : interface_nodes) order.new_node[node] = -1;
    std::vector<int> inner;
    for (int node = 0; node < nodes; ++node)
        if (order.new_node[node] == 0) {
            order.new_node[node] = static_cast<int>(inner.size());
            inner.push_back(node);
        }
    order.inner = static_cast<int>(inner.size());

    std::vector<Eigen::Triplet<double>> edges;
    for (int column = 0; column < matrix.outerSize(); column += 2)
        for (int c = column; c < column + 2; ++c)
            for (SparseMatrix::InnerIterator it(matrix, c); it; ++it) {
                const int a = order.new_node[it.row() / 2], b = order.new_node[column / 2];
                if (a >= 0 && b >= 0) edges.emplace_back(a, b, 1.0);
            }
    SparseMatrix graph(order.inner, order.inner);
    graph.setFromTriplets(edges.begin(), edges.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation(order.inner);
    if (order.inner > 0) Eigen::AMDOrdering<int>()(graph, permutation);
    for (int k = 0; k < order.inner; ++k) order.old_node.push_back(inner[permutation.indices()[k]]);
    for (const int node : interface_nodes) order.old_node.push_back(node);
    for (int k = 0; k < nodes; ++k) order.new_node[order.old_node[k]] = k;
    return order;
}

} // namespace damslip::fe2d
