#include "fe2d/element/quadratic.hpp"

#include <cmath>
#include <numbers>

namespace damslip::fe2d {

namespace {

using StrainRows = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 18>; ///< strain (xx, yy, 2xy) = B u

/// A shape function with its derivatives to xi and eta.
struct Shape {
    double n = 0.0, d_xi = 0.0, d_eta = 0.0;

    Shape& operator-=(const Shape& other)
    {
        n -= other.n;
        d_xi -= other.d_xi;
        d_eta -= other.d_eta;
        return *this;
    }
    friend Shape operator*(double factor, const Shape& s) { return {factor * s.n, factor * s.d_xi, factor * s.d_eta}; }
};

/// Corners, middles of all edges, centre; those that are not there are zero.
struct ShapeTable {
    std::array<Shape, 4> corner{}, mid{};
    Shape centre{};
};

/// What the corners give up to the middle nodes and the centre that are there.
void take_from_corners(ShapeTable& table, int size, const ExtraNodes& extra)
{
    for (int i = 0; i < size; ++i) {
        if (!extra.mid[i]) continue;
        table.corner[i] -= 0.5 * table.mid[i];
        table.corner[(i + 1) % size] -= 0.5 * table.mid[i];
    }
}

ShapeTable quadrilateral(const ExtraNodes& extra, double xi, double eta)
{
    static constexpr double sx[4] = {-1, 1, 1, -1}, sy[4] = {-1, -1, 1, 1};
    ShapeTable table;
    for (int i = 0; i < 4; ++i)
        table.corner[i] = {0.25 * (1.0 + sx[i] * xi) * (1.0 + sy[i] * eta), 0.25 * sx[i] * (1.0 + sy[i] * eta),
                           0.25 * sy[i] * (1.0 + sx[i] * xi)};
    const double bx = 1.0 - xi * xi, by = 1.0 - eta * eta;
    table.mid = {Shape{0.5 * bx * (1.0 - eta), -xi * (1.0 - eta), -0.5 * bx},
                 {0.5 * (1.0 + xi) * by, 0.5 * by, -eta * (1.0 + xi)},
                 {0.5 * bx * (1.0 + eta), -xi * (1.0 + eta), 0.5 * bx},
                 {0.5 * (1.0 - xi) * by, -0.5 * by, -eta * (1.0 - xi)}};
    if (extra.centre) {
        table.centre = {bx * by, -2.0 * xi * by, -2.0 * eta * bx};
        for (Shape& mid : table.mid) mid -= 0.5 * table.centre;
        for (Shape& corner : table.corner) corner -= 0.25 * table.centre;
    }
    take_from_corners(table, 4, extra);
    return table;
}

ShapeTable triangle(const ExtraNodes& extra, double l1, double l2)
{
    const double l0 = 1.0 - l1 - l2;
    ShapeTable table;
    table.corner = {Shape{l0, -1.0, -1.0}, {l1, 1.0, 0.0}, {l2, 0.0, 1.0}, {}};
    table.mid = {Shape{4.0 * l0 * l1, 4.0 * (l0 - l1), -4.0 * l1},
                 {4.0 * l1 * l2, 4.0 * l2, 4.0 * l1},
                 {4.0 * l2 * l0, -4.0 * l2, 4.0 * (l0 - l2)},
                 {}};
    take_from_corners(table, 3, extra);
    return table;
}

/// Jacobian of the corners' mapping, rows d/dxi, d/deta.
Eigen::Matrix2d jacobian(const Corners& corners, int size, double xi, double eta)
{
    const ShapeTable linear = size == 3 ? triangle({}, xi, eta) : quadrilateral({}, xi, eta);
    Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
    for (int i = 0; i < size; ++i) {
        const Shape& s = linear.corner[i];
        j.row(0) += s.d_xi * Eigen::RowVector2d(corners[i].x, corners[i].y);
        j.row(1) += s.d_eta * Eigen::RowVector2d(corners[i].x, corners[i].y);
    }
    return j;
}

StrainRows strain_rows(const QuadraticPoint& point)
{
    const Eigen::Index nodes = point.shape.size();
    StrainRows b = StrainRows::Zero(3, 2 * nodes);
    for (Eigen::Index i = 0; i < nodes; ++i) {
        b(0, 2 * i) = b(2, 2 * i + 1) = point.gradient(0, i);
        b(1, 2 * i + 1) = b(2, 2 * i) = point.gradient(1, i);
    }
    return b;
}

Eigen::Vector3d stress_at(const Corners& corners, int size, const ExtraNodes& extra, const Eigen::Matrix3d& d,
                          const ElementVector& u, double xi, double eta)
{
    return d * (strain_rows(quadratic_point(corners, size, extra, xi, eta)) * u);
}

/// Natural coordinates of the element's nodes, one column each, in the order of Element::all.
Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, 9> node_places(int size, const ExtraNodes& extra)
{
    static constexpr double quad[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, tri[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    const auto corner = [size](int i) {
        const double* p = size == 3 ? tri[i % size] : quad[i % size];
        return Eigen::Vector2d(p[0], p[1]);
    };
    Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, 9> places(2, size + extra.count());
    int n = 0;
    for (int i = 0; i < size; ++i) places.col(n++) = corner(i);
    for (int i = 0; i < size; ++i)
        if (extra.mid[i]) places.col(n++) = 0.5 * (corner(i) + corner(i + 1));
    if (extra.centre) places.col(n++).setZero();
    return places;
}

constexpr double barlow = std::numbers::inv_sqrt3; ///< coordinate of the 2 x 2 Gauss points

} // namespace

QuadraticPoint quadratic_point(const Corners& corners, int size, const ExtraNodes& extra, double xi, double eta)
{
    const ShapeTable table = size == 3 ? triangle(extra, xi, eta) : quadrilateral(extra, xi, eta);
    const int nodes = size + extra.count();
    QuadraticPoint point;
    point.shape.resize(nodes);
    Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, 9> natural(2, nodes);
    int n = 0;
    const auto add = [&](const Shape& s) {
        point.shape[n] = s.n;
        natural(0, n) = s.d_xi;
        natural(1, n++) = s.d_eta;
    };
    for (int i = 0; i < size; ++i) add(table.corner[i]);
    for (int i = 0; i < size; ++i)
        if (extra.mid[i]) add(table.mid[i]);
    if (extra.centre) add(table.centre);
    const Eigen::Matrix2d j = jacobian(corners, size, xi, eta);
    point.weight = j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0);
    Eigen::Matrix2d inverse;
    inverse << j(1, 1), -j(0, 1), -j(1, 0), j(0, 0);
    point.gradient = inverse * natural / point.weight;
    return point;
}

std::vector<QuadraticPoint> quadratic_points(const Corners& corners, int size, const ExtraNodes& extra)
{
    std::vector<QuadraticPoint> points;
    const auto add = [&](double xi, double eta, double weight) {
        points.push_back(quadratic_point(corners, size, extra, xi, eta));
        points.back().weight *= weight;
    };
    if (size == 3) {
        constexpr double a = 0.44594849091596488632, w_a = 0.5 * 0.22338158967801146570;
        constexpr double b = 0.09157621350977074346, w_b = 0.5 * 0.10995174365532186764;
        for (const auto& [l, weight] : {std::pair{a, w_a}, {b, w_b}}) {
            add(l, l, weight);
            add(1.0 - 2.0 * l, l, weight);
            add(l, 1.0 - 2.0 * l, weight);
        }
        return points;
    }
    const double g = std::sqrt(0.6);
    constexpr double outer = 5.0 / 9.0, inner = 8.0 / 9.0;
    for (const auto& [eta, w_eta] : {std::pair{-g, outer}, {0.0, inner}, {g, outer}})
        for (const auto& [xi, w_xi] : {std::pair{-g, outer}, {0.0, inner}, {g, outer}}) add(xi, eta, w_xi * w_eta);
    return points;
}

ElementMatrix quadratic_stiffness(const Corners& corners, int size, const ExtraNodes& extra, const Eigen::Matrix3d& d)
{
    const int unknowns = 2 * (size + extra.count());
    ElementMatrix k = ElementMatrix::Zero(unknowns, unknowns);
    for (const QuadraticPoint& point : quadratic_points(corners, size, extra)) {
        const StrainRows b = strain_rows(point), db = point.weight * d * b;
        k.noalias() += b.transpose() * db;
    }
    return 0.5 * (k + k.transpose());
}

ElementMatrix quadratic_mass(const Corners& corners, int size, const ExtraNodes& extra, double density, MassKind kind)
{
    const int nodes = size + extra.count();
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 9, 9> scalar(nodes, nodes);
    scalar.setZero();
    for (const QuadraticPoint& point : quadratic_points(corners, size, extra))
        scalar += density * point.weight * point.shape * point.shape.transpose();
    if (kind == MassKind::lumped) {
        const double factor = scalar.sum() / scalar.trace();
        const auto diagonal = (factor * scalar.diagonal()).eval();
        scalar = diagonal.asDiagonal();
    }
    ElementMatrix m = ElementMatrix::Zero(2 * nodes, 2 * nodes);
    for (int i = 0; i < nodes; ++i)
        for (int j = 0; j < nodes; ++j) m(2 * i, 2 * j) = m(2 * i + 1, 2 * j + 1) = scalar(i, j);
    return m;
}

ElementVector quadratic_body_force(const Corners& corners, int size, const ExtraNodes& extra,
                                   const Eigen::Vector2d& force)
{
    const int nodes = size + extra.count();
    ElementVector f = ElementVector::Zero(2 * nodes);
    for (const QuadraticPoint& point : quadratic_points(corners, size, extra))
        for (int i = 0; i < nodes; ++i) f.segment<2>(2 * i) += point.weight * point.shape[i] * force;
    return f;
}

NodalStress quadratic_nodal_stress(const Corners& corners, int size, const ExtraNodes& extra, const Eigen::Matrix3d& d,
                                   const ElementVector& u)
{
    const auto places = node_places(size, extra);
    NodalStress stress(3, places.cols());
    if (size == 3) {
        for (Eigen::Index i = 0; i < places.cols(); ++i)
            stress.col(i) = stress_at(corners, size, extra, d, u, places(0, i), places(1, i));
        return stress;
    }
    Eigen::Matrix<double, 3, 4> gauss;
    gauss.col(0) = stress_at(corners, size, extra, d, u, -barlow, -barlow);
    gauss.col(1) = stress_at(corners, size, extra, d, u, barlow, -barlow);
    gauss.col(2) = stress_at(corners, size, extra, d, u, barlow, barlow);
    gauss.col(3) = stress_at(corners, size, extra, d, u, -barlow, barlow);
    for (Eigen::Index i = 0; i < places.cols(); ++i) {
        const ShapeTable at = quadrilateral({}, places(0, i) / barlow, places(1, i) / barlow);
        stress.col(i).setZero();
        for (int g = 0; g < 4; ++g) stress.col(i) += at.corner[g].n * gauss.col(g);
    }
    return stress;
}

Eigen::Vector3d quadratic_centre_stress(const Corners& corners, int size, const ExtraNodes& extra,
                                        const Eigen::Matrix3d& d, const ElementVector& u)
{
    if (size == 3) return stress_at(corners, size, extra, d, u, 1.0 / 3.0, 1.0 / 3.0);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const double xi : {-barlow, barlow})
        for (const double eta : {-barlow, barlow}) sum += stress_at(corners, size, extra, d, u, xi, eta);
    return 0.25 * sum;
}

} // namespace damslip::fe2d
