#pragma once

#include "core/version.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cstddef>
#include <vector>

namespace damslip::fe2d {

/// y += A x of a dense matrix. Each row sums its columns in blocks: all of them below 128 columns, else 16, or 4 where a
/// column takes more than 32 kB.
/// @param level  the same bits on every level
void add_product(const Eigen::MatrixXd& matrix, const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> y,
                 VectorLevel level = vector_level());

/// y = A x in the same order.
void set_product(const Eigen::MatrixXd& matrix, const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXd& y);

/// y -= x_j A_j, column by column in their order, of those whose x_j is not zero.
void subtract_columns(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& x, Eigen::VectorXd& y,
                      VectorLevel level = vector_level());

} // namespace damslip::fe2d

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

namespace damslip::fe2d {

/// y += Aᵀ x of a dense matrix that stays as it is, again and again. Each column sums its even and its odd rows apart, as Eigen
/// does with two numbers at a time; two columns stand side by side, so that four numbers go at once: the same bits.
class TransposedProduct {
public:
    /// @param matrix  an even number of rows, two columns or more (Eigen sums a single one otherwise); copied
    explicit TransposedProduct(const Eigen::MatrixXd& matrix);
    TransposedProduct() = default; ///< of a matrix without columns

    /// @param level  the same bits on every level
    void add(const Eigen::VectorXd& x, Eigen::VectorXd& y, VectorLevel level = vector_level()) const;

private:
    std::size_t twos_ = 0; ///< rows, two at a time
    std::size_t columns_ = 0;
    std::vector<double>
        columns_of_two_; ///< by two columns, by two rows: both rows of the first column, then of the second
};

/// y += A x of a symmetric matrix. Such a product takes as long as its matrix takes to be read, so one half of it is kept: of each four
/// columns the blocks of four rows from the diagonal down. A block below the diagonal serves its rows and, transposed, its columns.
class SymmetricProduct {
public:
    /// @param matrix  the half below the diagonal is copied
    explicit SymmetricProduct(const Eigen::MatrixXd& matrix);
    SymmetricProduct() = default; ///< of no rows

    Eigen::Index rows() const { return rows_; }
    /// @param room  work space @param level  the same bits on every level
    void add(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> y, Eigen::VectorXd& room,
             VectorLevel level = vector_level()) const;

private:
    Eigen::Index rows_ = 0, blocks_ = 0; ///< blocks of four rows
    std::vector<double> panels_;         ///< by four columns, by blocks of four rows, by columns
};

} // namespace damslip::fe2d
