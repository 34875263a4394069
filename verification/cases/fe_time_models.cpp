#include "verification/cases/fe_time_models.hpp"

#include <cmath>

namespace damslip::verification {

using Eigen::Index;

namespace {

fe2d::SparseMatrix from_entries(Index size, const std::vector<Eigen::Triplet<double>>& entries)
{
    fe2d::SparseMatrix matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

void add_pair(std::vector<Eigen::Triplet<double>>& entries, Index a, Index b, double diagonal, double off_diagonal)
{
    entries.emplace_back(a, a, diagonal);
    entries.emplace_back(b, b, diagonal);
    entries.emplace_back(a, b, off_diagonal);
    entries.emplace_back(b, a, off_diagonal);
}

} // namespace

fe2d::LinearSystem oscillator(double omega, double damping_ratio, double mass)
{
    fe2d::LinearSystem system;
    system.mass = from_entries(1, {{0, 0, mass}});
    system.damping = from_entries(1, {{0, 0, 2.0 * damping_ratio * omega * mass}});
    system.stiffness = from_entries(1, {{0, 0, omega * omega * mass}});
    return system;
}

fe2d::LinearSystem lattice(const LatticeOptions& o)
{
    std::vector<Eigen::Triplet<double>> mass, stiffness;
    const auto spring = [](Index k) { return 400.0 * (1.0 + 0.4 * std::sin(0.9 * static_cast<double>(k))); };
    const auto weight = [](Index k) { return 1.0 + 0.3 * std::cos(1.3 * static_cast<double>(k)); };
    const Index n = o.nx * o.ny;
    for (Index j = 0; j < o.ny; ++j)
        for (Index i = 0; i < o.nx; ++i) {
            const Index here = i + j * o.nx;
            const bool has_mass = j >= o.massless_rows;
            if (has_mass) mass.emplace_back(here, here, weight(here));
            if (j == 0) stiffness.emplace_back(here, here, spring(here));
            if (i + 1 < o.nx) {
                add_pair(stiffness, here, here + 1, spring(2 * here + n), -spring(2 * here + n));
                if (has_mass) add_pair(mass, here, here + 1, 0.2 * weight(here), 0.1 * weight(here));
            }
            if (j + 1 < o.ny) {
                add_pair(stiffness, here, here + o.nx, spring(3 * here + 2 * n), -spring(3 * here + 2 * n));
                if (has_mass) add_pair(mass, here, here + o.nx, 0.2 * weight(here), 0.1 * weight(here));
            }
        }
    fe2d::LinearSystem system;
    system.mass = from_entries(n, mass);
    system.stiffness = from_entries(n, stiffness);
    system.damping = o.mass_coefficient * system.mass + o.stiffness_coefficient * system.stiffness;
    return system;
}

Eigen::VectorXd uneven_vector(Index size, double phase)
{
    Eigen::VectorXd vector(size);
    for (Index k = 0; k < size; ++k) vector[k] = std::sin(1.1 * static_cast<double>(k) + phase) + 0.3 * std::cos(phase);
    return vector;
}

} // namespace damslip::verification
