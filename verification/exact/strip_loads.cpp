#include "verification/exact/strip_loads.hpp"

namespace damslip::exact {

Eigen::MatrixXd strip_loads(const std::vector<Point>& nodes)
{
    const auto n = static_cast<Eigen::Index>(nodes.size());
    const double length = nodes.back().x - nodes.front().x, middle = 0.5 * (nodes.front().x + nodes.back().x),
                 inertia = length * length * length / 12.0;
    Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(2 * n, 3);
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
        const double a = nodes[static_cast<std::size_t>(i)].x, b = nodes[static_cast<std::size_t>(i + 1)].x, h = b - a;
        for (const Eigen::Index node : {i, i + 1}) {
            loads(2 * node, 0) += 0.5 * h / length;
            loads(2 * node + 1, 1) += 0.5 * h / length;
        }
        loads(2 * i + 1, 2) += h * ((a - middle) / 3.0 + (b - middle) / 6.0) / inertia;
        loads(2 * i + 3, 2) += h * ((a - middle) / 6.0 + (b - middle) / 3.0) / inertia;
    }
    return loads;
}

} // namespace damslip::exact
