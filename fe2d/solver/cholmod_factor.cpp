#include "fe2d/solver/cholmod_factor.hpp"

#include <cstring>
#include <new>

namespace damslip::fe2d {

namespace {

cholmod_sparse view(int n, std::vector<int>& columns, std::vector<int>& rows, std::vector<double>& values)
{
    cholmod_sparse a{};
    a.nrow = a.ncol = static_cast<std::size_t>(n);
    a.nzmax = rows.size();
    a.p = columns.data();
    a.i = rows.data();
    a.x = values.data();
    a.stype = -1;
    a.itype = CHOLMOD_INT;
    a.xtype = CHOLMOD_REAL;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = 1;
    a.packed = 1;
    return a;
}

} // namespace

CholmodFactor::CholmodFactor()
{
    cholmod_start(&common_);
    common_.print = 0;
    common_.try_catch = 1; // errors come back as status, nothing is written
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_AMD;
    common_.postorder = 1;
}

CholmodFactor::~CholmodFactor()
{
    release();
    cholmod_finish(&common_);
}

void CholmodFactor::release()
{
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_dense(&result_, &common_);
    cholmod_free_dense(&work_y_, &common_);
    cholmod_free_dense(&work_e_, &common_);
}

bool CholmodFactor::analyse(int n, std::vector<int>& columns, std::vector<int>& rows, std::vector<double>& values,
                            bool supernodal)
{
    release();
    common_.supernodal = supernodal ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
    common_.final_ll = supernodal ? 1 : 0;
    cholmod_sparse a = view(n, columns, rows, values);
    factor_ = cholmod_analyze(&a, &common_);
    return factor_ != nullptr;
}

bool CholmodFactor::factorise(int n, std::vector<int>& columns, std::vector<int>& rows, std::vector<double>& values)
{
    cholmod_sparse a = view(n, columns, rows, values);
    common_.status = CHOLMOD_OK;
    const int done = cholmod_factorize(&a, factor_, &common_);
    return done != 0 && common_.status == CHOLMOD_OK && factor_->minor == factor_->n;
}

void CholmodFactor::solve(double* columns, int n, int count)
{
    cholmod_dense b{};
    b.nrow = static_cast<std::size_t>(n);
    b.ncol = static_cast<std::size_t>(count);
    b.nzmax = b.nrow * b.ncol;
    b.d = b.nrow;
    b.x = columns;
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    if (!cholmod_solve2(CHOLMOD_A, factor_, &b, nullptr, &result_, nullptr, &work_y_, &work_e_, &common_))
        throw std::bad_alloc(); // sizes are right: nothing else can fail
    std::memcpy(columns, result_->x, b.nzmax * sizeof(double));
}

} // namespace damslip::fe2d
