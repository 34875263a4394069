#pragma once

#include "fe2d/damping/low_rank.hpp"

#include <Eigen/SparseCore>

namespace damslip::fe2d {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// M ü + C u̇ + K u = R(t) + Bᵀ λ: everything of the model that is linear, supports already eliminated. n unknowns.
/// All matrices are n x n and symmetric, both triangles stored. M may be singular (massless rock); a0 M + a1 C + K must
/// be positive definite. The interface forces λ of contact stay outside: no matrix here knows them.
struct LinearSystem {
    SparseMatrix mass;        ///< M, structure and added mass [kg/m]
    SparseMatrix damping;     ///< sparse part of C [N s/m^2]
    SparseMatrix stiffness;   ///< K [N/m^2]
    LowRank damping_low_rank; ///< rest of C (damping of the deformation only); may be empty

    Eigen::Index size() const { return stiffness.rows(); }
    void add_damping_product(const Eigen::VectorXd& velocity, Eigen::VectorXd& force) const; ///< force += C velocity
};

/// True where a row of M holds no non-zero entry.
std::vector<char> massless_unknowns(const SparseMatrix& mass);

/// Largest natural circular frequency of K - ω² M, undamped, by 80 steps of Lanczos' method, which approaches it from
/// below (relative error below 1e-6 in the tests) [rad/s]; infinite when M is singular. Needed by conditionally stable
/// schemes only.
double highest_frequency(const LinearSystem& system);

} // namespace damslip::fe2d
