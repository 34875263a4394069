#include "fe2d/solver/linear_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cholmod.h>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fmt/format.h>
#include <initializer_list>
#include <mutex>
#include <new>
#include <sys/resource.h>
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

void use_one_blas_thread()
{
    const auto call = [](const char* name, int value) {
        if (const auto set = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, name))) set(value);
    };
    // Asked for one where it has one, OpenBLAS starts a thread that was ended, which then looks for work for ever.
    const auto blas_threads = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
    if (blas_threads && blas_threads() != 1) call("openblas_set_num_threads", 1);
    call("omp_set_num_threads", 1);
    call("omp_set_max_active_levels", 0); // CHOLMOD asks for four threads by name
}

namespace {

/// OpenBLAS takes 128 MB at its first product, keeps them, and asks for them again and again, for ever, where they cannot be
/// had. To be called before: where the address space is limited (ulimit -v) it asks once, and has OpenBLAS take them.
/// @throws std::bad_alloc
void demand_blas_memory()
{
    static std::mutex mutex;
    static bool taken = false; // OpenBLAS keeps what it has once taken
    const std::lock_guard lock(mutex);
    rlimit limit{};
    if (taken || ::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
    constexpr std::size_t buffer = 130u << 20; // with what it is aligned by
    void* const trial = std::malloc(buffer);
    if (!trial) throw std::bad_alloc();
    std::free(trial);
    using Factorise = void (*)(const char* triangle, const int* n, double* a, const int* rows, int* info);
    if (const auto factorise = reinterpret_cast<Factorise>(dlsym(RTLD_DEFAULT, "dpotrf_"))) {
        double one = 1.0;
        int n = 1, info = 0;
        factorise("L", &n, &one, &n, &info);
    }
    taken = true;
}

constexpr int block = 16; ///< right-hand sides per call of the factor: fastest measured

/// The nearest power of two to value^-1/2.
double scale_for(double diagonal)
{
    const double magnitude = std::abs(diagonal);
    if (!(magnitude > 0.0) || !std::isfinite(magnitude)) return 1.0;
    return std::exp2(std::round(-0.5 * std::log2(magnitude)));
}

/// Lower triangle in CHOLMOD's storage.
struct LowerTriangle {
    std::vector<int> columns, rows;
    std::vector<double> values;
};

LowerTriangle scaled_lower(const Eigen::SparseMatrix<double>& a, const Eigen::VectorXd& scale)
{
    LowerTriangle lower;
    lower.columns.push_back(0);
    for (int j = 0; j < a.cols(); ++j) {
        for (Eigen::SparseMatrix<double>::InnerIterator it(a, j); it; ++it) {
            if (it.row() < j) continue;
            lower.rows.push_back(static_cast<int>(it.row()));
            lower.values.push_back(scale[it.row()] * it.value() * scale[j]);
        }
        lower.columns.push_back(static_cast<int>(lower.rows.size()));
    }
    return lower;
}

/// Smallest |pivot| and the number of negative ones of a simplicial L D L^T or a supernodal L L^T.
struct Pivots {
    double smallest = HUGE_VAL;
    int negative = 0;

    void add(double pivot)
    {
        smallest = std::min(smallest, std::abs(pivot));
        negative += pivot < 0.0;
    }
};

Pivots pivots_of(const cholmod_factor& factor)
{
    Pivots pivots;
    const auto* x = static_cast<const double*>(factor.x);
    if (!factor.is_super) {
        const auto* p = static_cast<const int*>(factor.p);
        for (std::size_t j = 0; j < factor.n; ++j) pivots.add(factor.is_ll ? x[p[j]] * x[p[j]] : x[p[j]]);
        return pivots;
    }
    const auto* super = static_cast<const int*>(factor.super);
    const auto *pi = static_cast<const int*>(factor.pi), *px = static_cast<const int*>(factor.px);
    for (std::size_t s = 0; s < factor.nsuper; ++s)
        for (int k = 0; k < super[s + 1] - super[s]; ++k) {
            const double diagonal = x[px[s] + static_cast<std::ptrdiff_t>(k) * (pi[s + 1] - pi[s]) + k];
            pivots.add(diagonal * diagonal);
        }
    return pivots;
}

std::int64_t factor_nonzeros(const cholmod_factor& factor)
{
    if (!factor.is_super) {
        const auto* counts = static_cast<const int*>(factor.nz);
        std::int64_t sum = 0;
        for (std::size_t j = 0; j < factor.n; ++j) sum += counts[j];
        return sum;
    }
    return static_cast<std::int64_t>(factor.xsize);
}

std::int64_t factor_bytes(const cholmod_factor& factor)
{
    const auto n = static_cast<std::int64_t>(factor.n);
    if (factor.is_super) // values, row indices, four supernode pointers; permutation and column counts
        return static_cast<std::int64_t>(8 * factor.xsize + 4 * factor.ssize + 12 * (factor.nsuper + 1)) + 8 * n;
    return static_cast<std::int64_t>(12 * factor.nzmax) +
           4 * 6 * n; // values and rows; pointers, counts, list, permutation
}

} // namespace

Note SolverReport::note() const
{
    switch (status) {
    case SolverStatus::ok:
        return {NoteKind::factorised, {unknowns, nonzeros_factor, residual}};
    case SolverStatus::not_factorised:
        break;
    case SolverStatus::not_positive_definite:
        return {NoteKind::not_positive_definite, {unknowns}};
    case SolverStatus::singular:
        return {NoteKind::singular, {unknowns, nonzeros_factor, smallest_pivot}};
    case SolverStatus::inaccurate:
        return {NoteKind::inaccurate, {unknowns, nonzeros_factor, residual, forward_error}};
    case SolverStatus::out_of_memory:
        return {NoteKind::out_of_memory, {unknowns}};
    }
    return {NoteKind::not_factorised};
}

struct LinearSolver::Implementation {
    SolverOptions options;
    CholmodFactor factor;
    Eigen::VectorXd scale;
    std::vector<int> columns, rows; ///< pattern the ordering belongs to
    SolverReport report;
    std::int64_t solves = 0;

    bool wants_supernodal(int n) const
    {
        if (options.definiteness == Definiteness::quasi_definite) return false;
        return options.factorisation == Factorisation::supernodal ||
               (options.factorisation == Factorisation::automatic && n > options.supernodal_above);
    }

    void begin_report(const Eigen::SparseMatrix<double>& a)
    {
        report = {.analyses = report.analyses, .factorisations = report.factorisations + 1};
        report.unknowns = a.rows();
        report.nonzeros_matrix = a.nonZeros();
        report.supernodal = wants_supernodal(static_cast<int>(a.rows()));
    }

    SolverStatus run(const Eigen::SparseMatrix<double>& a)
    {
        const int n = static_cast<int>(a.rows());
        scale.resize(n);
        for (int i = 0; i < n; ++i) scale[i] = scale_for(a.coeff(i, i));
        LowerTriangle lower = scaled_lower(a, scale);
        if (lower.columns != columns || lower.rows != rows) {
            ++report.analyses;
            if (!factor.analyse(n, lower.columns, lower.rows, lower.values, report.supernodal))
                return SolverStatus::out_of_memory;
            columns = lower.columns;
            rows = lower.rows;
        }
        if (!factor.factorise(n, lower.columns, lower.rows, lower.values))
            return factor.out_of_memory() ? SolverStatus::out_of_memory : SolverStatus::not_positive_definite;
        const Pivots pivots = pivots_of(*factor.factor());
        report.smallest_pivot = pivots.smallest;
        report.negative_pivots = pivots.negative;
        report.nonzeros_factor = factor_nonzeros(*factor.factor());
        report.bytes =
            factor_bytes(*factor.factor()) + 8 * n + static_cast<std::int64_t>(4 * (columns.size() + rows.size()));
        if (pivots.negative > 0 && options.definiteness == Definiteness::positive)
            return SolverStatus::not_positive_definite;
        if (!(pivots.smallest > options.smallest_pivot)) return SolverStatus::singular;
        return check(a);
    }

    /// One known solution: x alternates in sign, in the scaled unknowns.
    SolverStatus check(const Eigen::SparseMatrix<double>& a)
    {
        Eigen::VectorXd x(a.rows());
        for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = i % 2 == 0 ? 1.0 : -1.0;
        const Eigen::VectorXd exact = scale.cwiseProduct(x);
        const Eigen::VectorXd b = a * exact;
        Eigen::MatrixXd solution = b;
        solve_in_place(solution);
        const Eigen::VectorXd residual = scale.cwiseProduct(a * solution.col(0) - b), right = scale.cwiseProduct(b);
        report.residual = residual.lpNorm<Eigen::Infinity>() / right.lpNorm<Eigen::Infinity>();
        report.forward_error = (solution.col(0).cwiseQuotient(scale) - x).lpNorm<Eigen::Infinity>();
        return report.residual <= options.residual_limit ? SolverStatus::ok : SolverStatus::inaccurate;
    }

    void solve_in_place(Eigen::MatrixXd& b)
    {
        assert(b.rows() == scale.size() && factor.factor() != nullptr);
        const int n = static_cast<int>(b.rows());
        b = scale.asDiagonal() * b;
        for (Eigen::Index j = 0; j < b.cols(); j += block) {
            const int count = static_cast<int>(std::min<Eigen::Index>(block, b.cols() - j));
            if (n > 0) factor.solve(b.col(j).data(), n, count);
        }
        b = scale.asDiagonal() * b;
        solves += b.cols();
    }
};

LinearSolver::LinearSolver(const SolverOptions& options) : implementation_(std::make_unique<Implementation>())
{
    implementation_->options = options;
}

LinearSolver::~LinearSolver() = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

const SolverReport& LinearSolver::factorise(const Eigen::SparseMatrix<double>& matrix)
{
    assert(matrix.rows() == matrix.cols());
    use_one_blas_thread();
    implementation_->begin_report(matrix);
    if (implementation_->report.supernodal) demand_blas_memory();
    const SolverStatus status = implementation_->run(matrix);
    if (status == SolverStatus::out_of_memory) throw std::bad_alloc();
    implementation_->report.status = status;
    return implementation_->report;
}

const SolverReport& LinearSolver::report() const
{
    return implementation_->report;
}
std::int64_t LinearSolver::solves() const
{
    return implementation_->solves;
}

Eigen::VectorXd LinearSolver::solve(const Eigen::VectorXd& b) const
{
    Eigen::MatrixXd x = b;
    implementation_->solve_in_place(x);
    return x.col(0);
}

Eigen::MatrixXd LinearSolver::solve(const Eigen::MatrixXd& b) const
{
    Eigen::MatrixXd x = b;
    implementation_->solve_in_place(x);
    return x;
}

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
