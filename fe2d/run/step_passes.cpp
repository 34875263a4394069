#include "fe2d/run/step_passes.hpp"

#include "core/version.hpp"

#include <cassert>

#if DAMSLIP_HAS_AVX2
#include <immintrin.h>
#endif

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// Plain pointers and numbers: what stands in a structure might be written to as far as the compiler knows.
DAMSLIP_TWO_LEVELS void move_on(const StepConstants& constants, const double* const step, double* const x,
                                double* const velocity, double* const acceleration, const Index size)
{
    const double a0 = constants.a0, a1 = constants.a1, a2 = constants.a2, a3 = constants.a3, a4 = constants.a4,
                 a5 = constants.a5;
    DAMSLIP_INDEPENDENT
    for (Index i = 0; i < size; ++i) {
        const double v = velocity[i], a = acceleration[i];
        velocity[i] = a1 * step[i] - a4 * v - a5 * a;
        acceleration[i] = a0 * step[i] - a2 * v - a3 * a;
        x[i] += step[i];
    }
}

DAMSLIP_TWO_LEVELS void add_to_load(const double* const k, const double* const l, const double* const (&x)[4],
                                    const double (&factor)[4], double* const b, const Index size)
{
    const double *const x0 = x[0], *const x1 = x[1], *const x2 = x[2], *const x3 = x[3];
    const double f0 = factor[0], f1 = factor[1], f2 = factor[2], f3 = factor[3];
    DAMSLIP_INDEPENDENT
    for (Index i = 0; i < size; ++i) b[i] = b[i] - k[i] + l[i] + f0 * x0[i] + f1 * x1[i] + f2 * x2[i] + f3 * x3[i];
}

/// Accelerations of the ground along x and against y.
struct Along {
    double x, y;
};

DAMSLIP_TWO_LEVELS void ground_load(const double alpha, const Along start, const Along end, const double* const load,
                                    const double* const x, const double* const y, double* const b, const Index size)
{
    const double w = 1.0 + alpha;
    DAMSLIP_INDEPENDENT
    for (Index i = 0; i < size; ++i)
        b[i] = load[i] + w * (end.x * x[i] - end.y * y[i]) - alpha * (start.x * x[i] - start.y * y[i]);
}

/// Vectors of instant_forces().
struct AtInstant {
    const double *x, *y, *m, *k, *load;
};

DAMSLIP_TWO_LEVELS void instant_forces(const Along ground, const double d, const AtInstant& in, double* const g,
                                       double* const f, const Index size)
{
    const double *const x = in.x, *const y = in.y, *const m = in.m, *const k = in.k, *const load = in.load;
    const double along_x = ground.x, along_y = ground.y;
    DAMSLIP_INDEPENDENT
    for (Index i = 0; i < size; ++i) {
        const double here = along_x * x[i] - along_y * y[i];
        g[i] = here;
        f[i] = d * m[i] + k[i] - load[i] - here;
    }
}

WorkSums one_by_one(const WorkVectors& v)
{
    const auto k_du = v.stiffness - v.stiffness_before, m_da = v.mass_accel - v.mass_accel_before;
    WorkSums sums;
    sums.kinetic = v.velocity.dot(v.mass_rate);
    sums.mass_damping = v.step.dot(v.dam_mass_rate + v.dam_mass_rate_before);
    sums.stiffness_damping = k_du.dot(v.velocity + v.velocity_before);
    sums.load = v.step.dot(v.load);
    sums.ground = v.step.dot(v.ground + v.ground_before);
    sums.step_inertia = v.step.dot(m_da);
    sums.change_inertia = (v.accel - v.accel_before).dot(m_da);
    sums.inertia = v.accel.dot(v.mass_accel);
    sums.inertia_before = v.accel_before.dot(v.mass_accel_before);
    sums.force = v.step.dot(v.force);
    sums.force_before2 = v.step.dot(v.force_before2);
    sums.rate = v.velocity.dot(k_du);
    sums.rate_before2 = v.velocity_before2.dot(k_du);
    return sums;
}

#if DAMSLIP_HAS_AVX2

/// Four partial sums of each inner product, as Eigen has them in two pairs. They start with -0, which adds nothing to any number.
struct Fours {
    __m256d kinetic, mass_damping, stiffness_damping, load, ground, step_inertia, change_inertia, inertia,
        inertia_before, force, force_before2, rate, rate_before2;
};

DAMSLIP_AVX2 inline Fours nothing()
{
    const __m256d none = _mm256_set1_pd(-0.0);
    return {none, none, none, none, none, none, none, none, none, none, none, none, none};
}

DAMSLIP_AVX2 inline void add_product(const __m256d x, const __m256d y, __m256d& sum)
{
    sum = _mm256_add_pd(sum, _mm256_mul_pd(x, y));
}

/// Entries i ... i + 3, or with `pair` i and i + 1 before two zeros.
template <bool pair>
DAMSLIP_AVX2 inline __m256d at(const VectorXd& x, const Index i)
{
    if constexpr (pair) return _mm256_insertf128_pd(_mm256_setzero_pd(), _mm_loadu_pd(x.data() + i), 0);
    return _mm256_loadu_pd(x.data() + i);
}

template <bool pair>
DAMSLIP_AVX2 inline void add_entries(const WorkVectors& v, const Index i, Fours& sums)
{
    const __m256d du = at<pair>(v.step, i), v1 = at<pair>(v.velocity, i), a1 = at<pair>(v.accel, i),
                  a0 = at<pair>(v.accel_before, i), m_a1 = at<pair>(v.mass_accel, i),
                  m_a0 = at<pair>(v.mass_accel_before, i), m_da = _mm256_sub_pd(m_a1, m_a0),
                  k_du = _mm256_sub_pd(at<pair>(v.stiffness, i), at<pair>(v.stiffness_before, i));
    add_product(v1, at<pair>(v.mass_rate, i), sums.kinetic);
    add_product(du, _mm256_add_pd(at<pair>(v.dam_mass_rate, i), at<pair>(v.dam_mass_rate_before, i)),
                sums.mass_damping);
    add_product(k_du, _mm256_add_pd(v1, at<pair>(v.velocity_before, i)), sums.stiffness_damping);
    add_product(du, at<pair>(v.load, i), sums.load);
    add_product(du, _mm256_add_pd(at<pair>(v.ground, i), at<pair>(v.ground_before, i)), sums.ground);
    add_product(du, m_da, sums.step_inertia);
    add_product(_mm256_sub_pd(a1, a0), m_da, sums.change_inertia);
    add_product(a1, m_a1, sums.inertia);
    add_product(a0, m_a0, sums.inertia_before);
    add_product(du, at<pair>(v.force, i), sums.force);
    add_product(du, at<pair>(v.force_before2, i), sums.force_before2);
    add_product(v1, k_du, sums.rate);
    add_product(at<pair>(v.velocity_before2, i), k_du, sums.rate_before2);
}

DAMSLIP_AVX2 inline double total(const __m256d four, const __m256d pair)
{
    const __m128d two = _mm_add_pd(_mm_add_pd(_mm256_castpd256_pd128(four), _mm256_extractf128_pd(four, 1)),
                                   _mm256_castpd256_pd128(pair));
    return two[0] + two[1];
}

/// Both unknowns of a node stand together, so there is at most one pair behind the fours.
DAMSLIP_AVX2 WorkSums work_sums_avx2(const WorkVectors& v)
{
    const Index size = v.step.size();
    assert(size % 2 == 0);
    Fours f = nothing(), last = f;
    Index i = 0;
    for (; i + 4 <= size; i += 4) add_entries<false>(v, i, f);
    if (i < size) add_entries<true>(v, i, last);
    WorkSums sums;
    sums.kinetic = total(f.kinetic, last.kinetic);
    sums.mass_damping = total(f.mass_damping, last.mass_damping);
    sums.stiffness_damping = total(f.stiffness_damping, last.stiffness_damping);
    sums.load = total(f.load, last.load);
    sums.ground = total(f.ground, last.ground);
    sums.step_inertia = total(f.step_inertia, last.step_inertia);
    sums.change_inertia = total(f.change_inertia, last.change_inertia);
    sums.inertia = total(f.inertia, last.inertia);
    sums.inertia_before = total(f.inertia_before, last.inertia_before);
    sums.force = total(f.force, last.force);
    sums.force_before2 = total(f.force_before2, last.force_before2);
    sums.rate = total(f.rate, last.rate);
    sums.rate_before2 = total(f.rate_before2, last.rate_before2);
    return sums;
}

#endif

} // namespace

void move_on(const StepConstants& constants, const VectorXd& step, VectorXd& x, VectorXd& v, VectorXd& a)
{
    move_on(constants, step.data(), x.data(), v.data(), a.data(), x.size());
}

void add_to_load(const VectorXd& k, const VectorXd& l, const Term (&terms)[4], VectorXd& b)
{
    add_to_load(k.data(), l.data(),
                {terms[0].vector.data(), terms[1].vector.data(), terms[2].vector.data(), terms[3].vector.data()},
                {terms[0].factor, terms[1].factor, terms[2].factor, terms[3].factor}, b.data(), b.size());
}

void ground_load(double alpha, const GroundAcceleration& start, const GroundAcceleration& end, const VectorXd& load,
                 const VectorXd& x, const VectorXd& y, VectorXd& b)
{
    b.resize(load.size());
    ground_load(alpha, {start.h, start.v}, {end.h, end.v}, load.data(), x.data(), y.data(), b.data(), b.size());
}

void instant_forces(const GroundAcceleration& ground, double d, const VectorXd& x, const VectorXd& y, const VectorXd& m,
                    const VectorXd& k, const VectorXd& load, VectorXd& g, VectorXd& f)
{
    g.resize(load.size());
    f.resize(load.size());
    instant_forces({ground.h, ground.v}, d, {x.data(), y.data(), m.data(), k.data(), load.data()}, g.data(), f.data(),
                   load.size());
}

WorkSums work_sums(const WorkVectors& v, [[maybe_unused]] VectorLevel level)
{
#if DAMSLIP_HAS_AVX2
    if (level == VectorLevel::avx2) return work_sums_avx2(v);
#endif
    return one_by_one(v);
}

} // namespace damslip::fe2d
