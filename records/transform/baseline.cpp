#include "records/transform/baseline.hpp"

#include "core/input_error.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace damslip::records {

namespace {

using Samples = std::vector<double>;

/// Velocity at the samples, starting from rest, in units of dt.
Samples integral(const Samples& accel)
{
    Samples v(accel.size(), 0.0);
    for (std::size_t k = 1; k < accel.size(); ++k) v[k] = v[k - 1] + 0.5 * (accel[k - 1] + accel[k]);
    return v;
}

double dot(const Samples& a, const Samples& b)
{
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
}

/// Legendre polynomial of degree p on x in 0 ... 1, well conditioned as a basis, and its coefficients of 1, x, x^2.
constexpr std::array<std::array<double, 3>, 3> legendre{{{1.0, 0.0, 0.0}, {-1.0, 2.0, 0.0}, {1.0, -6.0, 6.0}}};

Samples basis_samples(std::size_t degree, std::size_t n)
{
    Samples f(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double x = static_cast<double>(k) / static_cast<double>(n - 1);
        f[k] = legendre[degree][0] + x * (legendre[degree][1] + x * legendre[degree][2]);
    }
    return f;
}

/// Least squares by Gram-Schmidt, twice: coefficients b of the columns so that |target - sum b_p column_p| is smallest.
std::vector<double> least_squares(const std::vector<Samples>& columns, Samples target)
{
    std::vector<Samples> q = columns;
    std::vector<std::vector<double>> r(columns.size(), std::vector<double>(columns.size(), 0.0));
    std::vector<double> b(columns.size(), 0.0);
    for (std::size_t j = 0; j < q.size(); ++j) {
        for (int pass = 0; pass < 2; ++pass)
            for (std::size_t i = 0; i < j; ++i) {
                const double share = dot(q[i], q[j]);
                r[i][j] += share;
                for (std::size_t k = 0; k < target.size(); ++k) q[j][k] -= share * q[i][k];
            }
        r[j][j] = std::sqrt(dot(q[j], q[j]));
        for (double& value : q[j]) value /= r[j][j];
        b[j] = dot(q[j], target);
        for (std::size_t k = 0; k < target.size(); ++k) target[k] -= b[j] * q[j][k];
    }
    for (std::size_t j = q.size(); j-- > 0;) {
        for (std::size_t i = j + 1; i < q.size(); ++i) b[j] -= r[j][i] * b[i];
        b[j] /= r[j][j];
    }
    return b;
}

} // namespace

BaselineResult baseline_corrected(const Record& record, const BaselineOptions& options)
{
    const std::size_t n = record.acceleration.size();
    if (n < 4)
        throw InputError(
            Diagnostic{record.source.file, 0, 0,
                       fmt::format("the record \"{}\" has {} samples: too few to fit a baseline.", record.name, n),
                       "at least 4 samples", "use the record as it is"});
    const auto degree = static_cast<std::size_t>(options.degree);
    const bool by_velocity = options.fit == BaselineFit::velocity;
    std::vector<Samples> shapes, columns;
    for (std::size_t p = 0; p <= degree; ++p) {
        shapes.push_back(basis_samples(p, n));
        columns.push_back(by_velocity ? integral(shapes.back()) : shapes.back());
    }
    const std::vector<double> b =
        least_squares(columns, by_velocity ? integral(record.acceleration) : record.acceleration);

    BaselineResult result{record, std::vector<double>(degree + 1, 0.0)};
    for (std::size_t p = 0; p <= degree; ++p) {
        for (std::size_t k = 0; k < n; ++k) result.record.acceleration[k] -= b[p] * shapes[p][k];
        for (std::size_t c = 0; c <= p; ++c) result.coefficients[c] += b[p] * legendre[p][c];
    }
    return result;
}

} // namespace damslip::records
