#include "fe2d/solver/dense_algebra.hpp"

template void Eigen::PartialPivLU<Eigen::MatrixXd>::compute();

template Eigen::LLT<Eigen::MatrixXd>&
Eigen::LLT<Eigen::MatrixXd>::compute<Eigen::MatrixXd>(const Eigen::EigenBase<Eigen::MatrixXd>&);

template Eigen::LDLT<Eigen::MatrixXd>&
Eigen::LDLT<Eigen::MatrixXd>::compute<Eigen::MatrixXd>(const Eigen::EigenBase<Eigen::MatrixXd>&);

template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute<Eigen::MatrixXd>(const Eigen::EigenBase<Eigen::MatrixXd>&, int);

template Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>::compute(const Eigen::MatrixXd&, const Eigen::MatrixXd&, int);

template struct Eigen::internal::general_matrix_vector_product<
    Eigen::Index, double, Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::ColMajor>,
    Eigen::ColMajor, false, double, Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::RowMajor>,
    false>;
template struct Eigen::internal::general_matrix_vector_product<
    Eigen::Index, double, Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::RowMajor>,
    Eigen::RowMajor, false, double, Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::ColMajor>,
    false>;
