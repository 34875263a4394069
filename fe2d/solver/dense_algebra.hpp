#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

/// Eigen's decompositions of dense real matrices, and the products with a vector, compiled once, in dense_algebra.cpp. To be included in place of
/// Eigen's headers where one of them is used: without it the code is the same, but each unit compiles it anew.
extern template void Eigen::PartialPivLU<Eigen::MatrixXd>::compute();

extern template Eigen::LLT<Eigen::MatrixXd>&
Eigen::LLT<Eigen::MatrixXd>::compute<Eigen::MatrixXd>(const Eigen::EigenBase<Eigen::MatrixXd>&);

extern template Eigen::LDLT<Eigen::MatrixXd>&
Eigen::LDLT<Eigen::MatrixXd>::compute<Eigen::MatrixXd>(const Eigen::EigenBase<Eigen::MatrixXd>&);

extern template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute<Eigen::MatrixXd>(const Eigen::EigenBase<Eigen::MatrixXd>&, int);

extern template Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>::compute(const Eigen::MatrixXd&, const Eigen::MatrixXd&, int);

/// y += alpha A x, of A stored by columns and by rows.
extern template struct Eigen::internal::general_matrix_vector_product<
    Eigen::Index, double, Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::ColMajor>,
    Eigen::ColMajor, false, double, Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::RowMajor>,
    false>;
extern template struct Eigen::internal::general_matrix_vector_product<
    Eigen::Index, double, Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::RowMajor>,
    Eigen::RowMajor, false, double, Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::ColMajor>,
    false>;
