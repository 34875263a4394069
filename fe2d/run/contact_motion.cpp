#include "fe2d/run/contact_motion.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

void DynamicCounts::add(const ContactReport& report, double residual)
{
    ++steps;
    largest_iterations = std::max(largest_iterations, report.iterations);
    ++by_path[static_cast<int>(report.path)];
    unresolved += !report.resolved();
    largest_residual = std::max(largest_residual, residual);
}

LargestSlips::LargestSlips(const ContactPlanes& planes, VectorXd start)
    : planes_(planes), start_(std::move(start)), largest_(VectorXd::Zero(planes.count()))
{
}

void LargestSlips::look(const VectorXd& slip)
{
    const VectorXd since = slip - start_;
    for (Index k = 0; k < planes_.count(); ++k) largest_[k] = std::max(largest_[k], std::abs(planes_.mean(k, since)));
}

} // namespace damslip::fe2d
