#include "fe2d/harmonic/transfer.hpp"

#include "core/parallel.hpp"
#include "fe2d/assembly/assemble.hpp"
#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "fe2d/time/structure_system.hpp"

#include <Eigen/QR>
#include <cholmod.h>
#include <umfpack.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <stdexcept>
#include <vector>

extern "C" {
void zsyrk_(const char* triangle, const char* turn, const int* n, const int* k, const std::complex<double>* alpha,
            const std::complex<double>* a, const int* lda, const std::complex<double>* beta, std::complex<double>* c,
            const int* ldc);
void ztrsm_(const char* side, const char* triangle, const char* turn, const char* diagonal, const int* m, const int* n,
            const std::complex<double>* alpha, const std::complex<double>* a, const int* lda, std::complex<double>* b,
            const int* ldb);
void zgemm_(const char* turn_a, const char* turn_b, const int* m, const int* n, const int* k,
            const std::complex<double>* alpha, const std::complex<double>* a, const int* lda,
            const std::complex<double>* b, const int* ldb, const std::complex<double>* beta, std::complex<double>* c,
            const int* ldc);
}

namespace damslip::fe2d {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

namespace {

constexpr Complex one{1.0, 0.0}, minus_one{-1.0, 0.0};
constexpr double good_residual = 1e-11;
constexpr double allowed_residual = 1e-8;
constexpr int most_refinements = 3;
constexpr std::size_t most_factors = 4; ///< at a time: each takes as much memory as the first

} // namespace

namespace fronts {

/// Columns eliminated together: `columns` of them from `first` on, and all rows of these columns.
struct Front {
    int first = 0, columns = 0;
    std::vector<int> rows; ///< ascending; the first ones are the columns themselves
    int parent = -1;
    std::size_t place = 0; ///< of its panel, rows x columns

    int size() const { return static_cast<int>(rows.size()); }
};

/// Order and fronts of a symmetric pattern.
struct Elimination {
    std::vector<int> new_of; ///< by unknown
    std::vector<Front> fronts;
    std::size_t panel_size = 0;

    explicit Elimination(const FrequencySolver::Matrix& pattern)
    {
        const int n = static_cast<int>(pattern.rows());
        cholmod_common common;
        cholmod_start(&common);
        common.supernodal = CHOLMOD_SUPERNODAL;
        common.print = 0;
        cholmod_sparse view{};
        view.nrow = view.ncol = static_cast<std::size_t>(n);
        view.nzmax = static_cast<std::size_t>(pattern.nonZeros());
        view.p = const_cast<int*>(pattern.outerIndexPtr());
        view.i = const_cast<int*>(pattern.innerIndexPtr());
        view.stype = -1; // the lower triangle is used
        view.itype = CHOLMOD_INT;
        view.xtype = CHOLMOD_PATTERN;
        view.dtype = CHOLMOD_DOUBLE;
        view.sorted = view.packed = 1;
        cholmod_factor* factor = cholmod_analyze(&view, &common);
        if (factor) take(*factor);
        cholmod_free_factor(&factor, &common);
        cholmod_finish(&common);
        if (fronts.empty()) throw std::bad_alloc();
    }

private:
    void take(const cholmod_factor& factor)
    {
        const auto *permutation = static_cast<const int*>(factor.Perm), *super = static_cast<const int*>(factor.super),
                   *begin = static_cast<const int*>(factor.pi), *rows = static_cast<const int*>(factor.s);
        new_of.resize(factor.n);
        for (std::size_t k = 0; k < factor.n; ++k)
            new_of[static_cast<std::size_t>(permutation[k])] = static_cast<int>(k);
        std::vector<int> front_of(factor.n);
        for (std::size_t f = 0; f < factor.nsuper; ++f) {
            Front front;
            front.first = super[f];
            front.columns = super[f + 1] - super[f];
            front.rows.assign(rows + begin[f], rows + begin[f + 1]);
            front.place = panel_size;
            panel_size += static_cast<std::size_t>(front.columns) * front.rows.size();
            for (int k = super[f]; k < super[f + 1]; ++k) front_of[static_cast<std::size_t>(k)] = static_cast<int>(f);
            fronts.push_back(std::move(front));
        }
        for (Front& front : fronts)
            if (front.size() > front.columns)
                front.parent = front_of[static_cast<std::size_t>(front.rows[static_cast<std::size_t>(front.columns)])];
    }
};

} // namespace fronts

using fronts::Elimination, fronts::Front;

struct FrequencySolver::Implementation {
    struct Entry {
        int row, column, place; ///< in the new order; place among D's values
    };

    Matrix mass, damping, stiffness; ///< of one pattern
    std::string body;
    Elimination elimination;
    std::vector<std::vector<Entry>> entries; ///< of D's lower triangle, by front

    Implementation(SharedPattern shared, std::string name)
        : mass(std::move(shared.mass)), damping(std::move(shared.damping)), stiffness(std::move(shared.stiffness)),
          body(std::move(name)), elimination(stiffness)
    {
        // entries of the lower triangle by the front of their column in the new order
        const auto& new_of = elimination.new_of;
        std::vector<int> front_of(new_of.size());
        for (std::size_t f = 0; f < elimination.fronts.size(); ++f)
            for (int k = 0; k < elimination.fronts[f].columns; ++k)
                front_of[static_cast<std::size_t>(elimination.fronts[f].first + k)] = static_cast<int>(f);
        entries.resize(elimination.fronts.size());
        for (int j = 0; j < stiffness.outerSize(); ++j)
            for (int p = stiffness.outerIndexPtr()[j]; p < stiffness.outerIndexPtr()[j + 1]; ++p) {
                const int column = new_of[static_cast<std::size_t>(j)],
                          row = new_of[static_cast<std::size_t>(stiffness.innerIndexPtr()[p])];
                if (row >= column)
                    entries[static_cast<std::size_t>(front_of[static_cast<std::size_t>(column)])].push_back(
                        {row, column, p});
            }
    }

    /// D at one frequency at a time, and its factor.
    class Factor {
    public:
        explicit Factor(const Implementation& of)
            : of_(of), matrix_(of.stiffness.cast<Complex>()), panels_(of.elimination.panel_size)
        {
        }
        MatrixXcd solve(At at, const MatrixXd& loads);

    private:
        bool factorise();
        void solve_in_place(MatrixXcd& b) const;

        const Implementation& of_;
        Eigen::SparseMatrix<Complex> matrix_; ///< D
        std::vector<Complex> panels_;         ///< L, front by front
    };
};

/// Fronts from the leaves up: a front is the sum of its own entries and of what its children leave to it.
bool FrequencySolver::Implementation::Factor::factorise()
{
    const std::vector<Front>& fronts = of_.elimination.fronts;
    std::vector<MatrixXcd> left(fronts.size()); ///< of each front on its other rows, lower triangle
    std::vector<std::vector<int>> children(fronts.size());
    std::vector<int> local(of_.elimination.new_of.size());
    for (std::size_t f = 0; f < fronts.size(); ++f) {
        const Front& front = fronts[f];
        const int size = front.size(), columns = front.columns, rest = size - columns;
        for (int k = 0; k < size; ++k) local[static_cast<std::size_t>(front.rows[static_cast<std::size_t>(k)])] = k;
        Eigen::Map<MatrixXcd> own(panels_.data() + front.place, size, columns);
        own.setZero();
        MatrixXcd& other = left[f];
        other.setZero(rest, rest);
        for (const Entry& e : of_.entries[f])
            own(local[static_cast<std::size_t>(e.row)], e.column - front.first) += matrix_.valuePtr()[e.place];
        for (const int child : children[f]) {
            const Front& c = fronts[static_cast<std::size_t>(child)];
            MatrixXcd& update = left[static_cast<std::size_t>(child)];
            const int count = c.size() - c.columns;
            const int* const rows = c.rows.data() + c.columns;
            for (int j = 0; j < count; ++j) {
                const int to = local[static_cast<std::size_t>(rows[j])];
                Complex* const column = to < columns
                                            ? &own(0, to)
                                            : other.data() + static_cast<std::ptrdiff_t>(to - columns) * rest - columns;
                for (int i = j; i < count; ++i) column[local[static_cast<std::size_t>(rows[i])]] += update(i, j);
            }
            update.resize(0, 0);
        }
        // L Lᵀ of the columns' own block, column by column
        for (int j = 0; j < columns; ++j) {
            const Complex pivot = std::sqrt(own(j, j));
            if (!(std::norm(pivot) > 0.0) || !std::isfinite(std::norm(pivot))) return false;
            const Complex inverse = 1.0 / pivot;
            own(j, j) = pivot;
            own.col(j).segment(j + 1, columns - j - 1) *= inverse;
            for (int k = j + 1; k < columns; ++k)
                own.col(k).segment(k, columns - k) -= own(k, j) * own.col(j).segment(k, columns - k);
        }
        if (rest == 0) continue;
        Complex* const below = own.data() + columns;
        ztrsm_("R", "L", "T", "N", &rest, &columns, &one, own.data(), &size, below, &size);
        zsyrk_("L", "N", &rest, &columns, &minus_one, below, &size, &one, other.data(), &rest);
        children[static_cast<std::size_t>(front.parent)].push_back(static_cast<int>(f));
    }
    return true;
}

void FrequencySolver::Implementation::Factor::solve_in_place(MatrixXcd& b) const
{
    const std::vector<Front>& fronts = of_.elimination.fronts;
    const Index n = b.rows(), count = b.cols();
    const int loads = static_cast<int>(count), ldb = static_cast<int>(n);
    MatrixXcd x(n, count), rest;
    for (Index i = 0; i < n; ++i) x.row(of_.elimination.new_of[static_cast<std::size_t>(i)]) = b.row(i);
    for (const Front& front : fronts) {
        const int size = front.size(), columns = front.columns, others = size - columns;
        const Complex* const own = panels_.data() + front.place;
        Complex* const here = x.data() + front.first;
        ztrsm_("L", "L", "N", "N", &columns, &loads, &one, own, &size, here, &ldb);
        if (others == 0) continue;
        rest.setZero(others, count);
        zgemm_("N", "N", &others, &loads, &columns, &minus_one, own + columns, &size, here, &ldb, &one, rest.data(),
               &others);
        for (Index load = 0; load < count; ++load)
            for (int k = 0; k < others; ++k)
                x(front.rows[static_cast<std::size_t>(columns + k)], load) += rest(k, load);
    }
    for (auto it = fronts.rbegin(); it != fronts.rend(); ++it) {
        const Front& front = *it;
        const int size = front.size(), columns = front.columns, others = size - columns;
        const Complex* const own = panels_.data() + front.place;
        Complex* const here = x.data() + front.first;
        if (others > 0) {
            rest.resize(others, count);
            for (Index load = 0; load < count; ++load)
                for (int k = 0; k < others; ++k)
                    rest(k, load) = x(front.rows[static_cast<std::size_t>(columns + k)], load);
            zgemm_("T", "N", &columns, &loads, &others, &minus_one, own + columns, &size, rest.data(), &others, &one,
                   here, &ldb);
        }
        ztrsm_("L", "L", "T", "N", &columns, &loads, &one, own, &size, here, &ldb);
    }
    for (Index i = 0; i < n; ++i) b.row(i) = x.row(of_.elimination.new_of[static_cast<std::size_t>(i)]);
}

MatrixXcd FrequencySolver::Implementation::Factor::solve(At at, const MatrixXd& loads)
{
    assert(loads.rows() == matrix_.rows());
    const Complex place(at.growth, at.frequency), square = place * place;
    for (Index k = 0; k < matrix_.nonZeros(); ++k)
        matrix_.valuePtr()[k] =
            of_.stiffness.valuePtr()[k] + place * of_.damping.valuePtr()[k] + square * of_.mass.valuePtr()[k];
    if (!factorise()) throw std::runtime_error(of_.body + " is singular at a frequency");
    const MatrixXcd b = loads.cast<Complex>();
    const Eigen::ArrayXXd size = b.colwise().norm().array().max(std::numeric_limits<double>::min());
    MatrixXcd x = b;
    solve_in_place(x);
    for (int k = 0;; ++k) {
        MatrixXcd rest = b - matrix_ * x;
        const double worst = (rest.colwise().norm().array() / size).maxCoeff<Eigen::PropagateNaN>();
        if (worst <= good_residual) return x;
        if (k == most_refinements) {
            if (worst < allowed_residual) return x;
            throw std::runtime_error(of_.body + " is nearly singular at a frequency");
        }
        solve_in_place(rest);
        x += rest;
    }
}

FrequencySolver::FrequencySolver(const Matrix& mass, const Matrix& damping, const Matrix& stiffness, std::string body)
{
    use_one_blas_thread();
    implementation_ = std::make_unique<const Implementation>(on_one_pattern(mass, damping, stiffness), std::move(body));
}

FrequencySolver::~FrequencySolver() = default;

void FrequencySolver::solve(std::span<const At> frequencies, const MatrixXd& loads,
                            const std::function<void(std::size_t, const MatrixXcd&)>& take,
                            const std::function<void()>& beside) const
{
    const std::size_t factors = std::min({frequencies.size(), most_factors, static_cast<std::size_t>(thread_count(0))});
    std::atomic<std::size_t> next{0};
    parallel_for(factors + 1, 0, [&](std::size_t task) {
        if (task == 0) {
            if (beside) beside();
            return;
        }
        std::size_t k = next.fetch_add(1);
        if (k >= frequencies.size()) return;
        for (Implementation::Factor factor(*implementation_); k < frequencies.size(); k = next.fetch_add(1))
            take(k, factor.solve(frequencies[k], loads));
    });
}

MatrixXcd FrequencySolver::solve(At frequency, const MatrixXd& loads) const
{
    return Implementation::Factor(*implementation_).solve(frequency, loads);
}

namespace {

/// What the rock puts on the unknowns of the base and on φ of the water's floor, where that is its own; empty without. With its
/// compliance F = [F_b, F_bf; F_fb, F_f], p = h φ, h = iω s on v: the base's forces eliminated,
///
///     [K, -K F_bf h; -h F_fb K, -h² (F_f - F_fb K F_bf)],   K = F_b⁻¹
/// @param scale  s [Pa s/m]
Eigen::MatrixXcd dynamic_stiffness(const RockBelow* below, double frequency, double scale)
{
    if (!below) return {};
    const Eigen::Index n = below->rock.interface(), base = below->rock.base(), floor = below->rock.floor;
    const Eigen::MatrixXcd compliance =
        below->rock.response(frequency, below->stiffness_damping, Eigen::MatrixXd::Identity(n, n));
    if (floor == 0) return compliance.inverse();
    const std::complex<double> h(0.0, frequency * scale);
    const Eigen::MatrixXcd stiffness = compliance.topLeftCorner(base, base).inverse(),
                           across = stiffness * compliance.topRightCorner(base, floor);
    Eigen::MatrixXcd block(n, n);
    block.topLeftCorner(base, base) = stiffness;
    block.topRightCorner(base, floor) = -h * across;
    block.bottomLeftCorner(floor, base) = -h * across.transpose();
    block.bottomRightCorner(floor, floor) =
        -h * h * (compliance.bottomRightCorner(floor, floor) - compliance.bottomLeftCorner(floor, base) * across);
    return block;
}

/// Displacement of the crest's upstream end in x beyond the rigid motion that fits the base's nodes best.
std::complex<double> deflection(const Model& model, const Eigen::VectorXcd& z)
{
    const int crest = model.mesh.crest.back();
    const std::complex<double> of_crest = z[model.dofs(crest, 0)];
    if (!model.mesh.has_rock()) return of_crest;
    const std::vector<int>& base = model.mesh.contact.dam_nodes;
    const auto n = static_cast<Eigen::Index>(base.size());
    Eigen::MatrixXcd rigid = Eigen::MatrixXcd::Zero(2 * n, 3); // x, y, rotation from x to y about the crest
    Eigen::VectorXcd motion(2 * n);
    const Point about = model.mesh.nodes[static_cast<std::size_t>(crest)];
    for (Eigen::Index i = 0; i < n; ++i) {
        const int node = base[static_cast<std::size_t>(i)];
        const Point at = model.mesh.nodes[static_cast<std::size_t>(node)];
        rigid(2 * i, 0) = rigid(2 * i + 1, 1) = 1.0;
        rigid(2 * i, 2) = about.y - at.y;
        rigid(2 * i + 1, 2) = at.x - about.x;
        for (const int c : {0, 1}) motion[2 * i + c] = z[model.dofs(node, c)];
    }
    return of_crest - Eigen::VectorXcd(rigid.colPivHouseholderQr().solve(motion))[0];
}

} // namespace

std::vector<TransferPoint> transfer_functions(const Model& model, const LinearSystem& structure,
                                              const FluidModel* water, const std::vector<double>& frequencies,
                                              const RockBelow* rock)
{
    const Eigen::Index n = structure.size();
    CoupledSystem system;
    if (water) {
        const SparseMatrix coupling =
            face_coupling(model.mesh, model.dofs, water->reservoir, water->dofs, water->unknowns());
        system =
            couple(structure.mass, structure.damping, structure.stiffness, SparseMatrix(coupling.topRows(n)), *water);
    } else {
        system.mass = structure.mass;
        system.damping = structure.damping;
        system.stiffness = structure.stiffness;
        system.structure_unknowns = n;
        system.velocity_x = Eigen::VectorXd::Zero(n);
    }
    std::vector<Eigen::Index> moved = rock ? unknowns_of_base(model) : std::vector<Eigen::Index>();
    if (water)
        for (const Eigen::Index unknown : unknowns_of_floor(system, *water)) moved.push_back(unknown);
    HarmonicSolver solver(system.mass, system.damping, system.stiffness, moved);
    const int crest = model.dofs(model.mesh.crest.back(), 0);
    std::vector<TransferPoint> points;
    for (const double frequency : frequencies) {
        TransferPoint point;
        point.frequency = frequency;
        const double w = 2.0 * std::numbers::pi * frequency;
        const std::complex<double> rate(0.0, w);
        point.regular = solver.factorise(w, dynamic_stiffness(rock, w, system.scale));
        if (point.regular) {
            Eigen::VectorXcd load = system.velocity_x.cast<std::complex<double>>() / rate;
            load.head(n) -= model.inertia_x.head(n);
            const Eigen::VectorXcd z = solver.solve(load);
            point.crest = 1.0 - w * w * z[crest];
            point.deflection = -w * w * deflection(model, z);
            if (water)
                point.water_force =
                    system.scale * rate *
                    (water->force_x.cast<std::complex<double>>().transpose() * z.tail(system.water_unknowns)).value();
        }
        points.push_back(point);
    }
    return points;
}

struct HarmonicSolver::Implementation {
    // One pattern for all three; UMFPACK takes real and imaginary parts apart.
    Eigen::SparseMatrix<double> mass, damping, stiffness;
    Eigen::VectorXd real, imaginary;
    std::vector<Index> block_places; ///< of the dense block's entries among those of the pattern, by columns
    void* symbolic = nullptr;
    void* numeric = nullptr;
    std::array<double, UMFPACK_CONTROL> control{};
    bool regular = false;

    ~Implementation()
    {
        if (numeric) umfpack_zi_free_numeric(&numeric);
        if (symbolic) umfpack_zi_free_symbolic(&symbolic);
    }
};

namespace {

/// Stored zeros at every pair of the unknowns.
Eigen::SparseMatrix<double> zero_block(std::span<const Index> unknowns, Index size)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (const Index column : unknowns)
        for (const Index row : unknowns) entries.emplace_back(row, column, 0.0);
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

} // namespace

HarmonicSolver::HarmonicSolver(const Matrix& mass, const Matrix& damping, const Matrix& stiffness,
                               std::span<const Index> block_at)
    : implementation_(std::make_unique<Implementation>())
{
    Implementation& s = *implementation_;
    SharedPattern shared = on_one_pattern(mass, damping, stiffness + zero_block(block_at, stiffness.rows()));
    s.mass = std::move(shared.mass);
    s.damping = std::move(shared.damping);
    s.stiffness = std::move(shared.stiffness);
    for (const Index column : block_at)
        for (const Index row : block_at)
            s.block_places.push_back(&s.stiffness.coeffRef(row, column) - s.stiffness.valuePtr());
    umfpack_zi_defaults(s.control.data());
}

HarmonicSolver::~HarmonicSolver() = default;
HarmonicSolver::HarmonicSolver(HarmonicSolver&&) noexcept = default;

bool HarmonicSolver::factorise(double frequency, const Eigen::MatrixXcd& block)
{
    Implementation& s = *implementation_;
    assert(static_cast<std::size_t>(block.size()) == s.block_places.size());
    const auto n = static_cast<int>(s.stiffness.rows());
    s.real = s.stiffness.coeffs() - frequency * frequency * s.mass.coeffs();
    s.imaginary = frequency * s.damping.coeffs();
    for (std::size_t k = 0; k < s.block_places.size(); ++k) {
        const std::complex<double> value = block.data()[k];
        s.real[s.block_places[k]] += value.real();
        s.imaginary[s.block_places[k]] += value.imag();
    }
    const int *columns = s.stiffness.outerIndexPtr(), *rows = s.stiffness.innerIndexPtr();
    if (s.numeric) umfpack_zi_free_numeric(&s.numeric);
    if (!s.symbolic)
        umfpack_zi_symbolic(n, n, columns, rows, s.real.data(), s.imaginary.data(), &s.symbolic, s.control.data(),
                            nullptr);
    s.regular = s.symbolic && umfpack_zi_numeric(columns, rows, s.real.data(), s.imaginary.data(), s.symbolic,
                                                 &s.numeric, s.control.data(), nullptr) == UMFPACK_OK;
    return s.regular;
}

Eigen::VectorXcd HarmonicSolver::solve(const Eigen::VectorXcd& right_hand_side) const
{
    const Implementation& s = *implementation_;
    assert(s.regular && right_hand_side.size() == s.stiffness.rows());
    const Eigen::VectorXd b = right_hand_side.real(), c = right_hand_side.imag();
    Eigen::VectorXd x(b.size()), y(b.size());
    umfpack_zi_solve(UMFPACK_A, s.stiffness.outerIndexPtr(), s.stiffness.innerIndexPtr(), s.real.data(),
                     s.imaginary.data(), x.data(), y.data(), b.data(), c.data(), s.numeric, s.control.data(), nullptr);
    Eigen::VectorXcd solution(b.size());
    solution.real() = x;
    solution.imag() = y;
    return solution;
}

} // namespace damslip::fe2d
