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

DynamicCounts& DynamicCounts::operator+=(const DynamicCounts& other)
{
    steps += other.steps;
    contact_iterations += other.contact_iterations;
    largest_iterations = std::max(largest_iterations, other.largest_iterations);
    unresolved += other.unresolved;
    for (int k = 0; k < 5; ++k) by_path[k] += other.by_path[k];
    landings += other.landings;
    halved += other.halved;
    refined += other.refined;
    largest_residual = std::max(largest_residual, other.largest_residual);
    factorisations = std::max(factorisations, other.factorisations); // shared
    contact_seconds += other.contact_seconds;
    return *this;
}

LargestSlips::LargestSlips(const ContactPlanes& planes, VectorXd start)
    : planes_(planes), start_(std::move(start)), largest_(VectorXd::Zero(planes.count()))
{
}

void LargestSlips::look(const VectorXd& slip)
{
    since_ = slip - start_;
    for (Index k = 0; k < planes_.count(); ++k) largest_[k] = std::max(largest_[k], std::abs(planes_.mean(k, since_)));
}

} // namespace damslip::fe2d
