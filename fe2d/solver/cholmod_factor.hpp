#pragma once

#include <cholmod.h>

#include <vector>

/// Thin owners of CHOLMOD's C structures; private to this folder.
namespace damslip::fe2d {

/// One cholmod_common with one factor. Not shared between threads.
class CholmodFactor {
public:
    CholmodFactor();
    ~CholmodFactor();
    CholmodFactor(const CholmodFactor&) = delete;
    CholmodFactor& operator=(const CholmodFactor&) = delete;

    /// Lower triangle, columns sorted. @returns false when out of memory.
    bool analyse(int n, std::vector<int>& columns, std::vector<int>& rows, std::vector<double>& values,
                 bool supernodal);
    /// @returns false when CHOLMOD reports a pivot it cannot use or lack of memory (see `out_of_memory`).
    bool factorise(int n, std::vector<int>& columns, std::vector<int>& rows, std::vector<double>& values);
    /// In place, `count` columns of length n. @throws std::bad_alloc
    void solve(double* columns, int n, int count);

    bool out_of_memory() const
    {
        return common_.status == CHOLMOD_OUT_OF_MEMORY || common_.status == CHOLMOD_TOO_LARGE;
    }
    const cholmod_factor* factor() const { return factor_; }

private:
    void release();

    cholmod_common common_;
    cholmod_factor* factor_ = nullptr;
    cholmod_dense* result_ = nullptr; ///< kept between solves
    cholmod_dense* work_y_ = nullptr;
    cholmod_dense* work_e_ = nullptr;
};

} // namespace damslip::fe2d
