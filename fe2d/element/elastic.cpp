#include "fe2d/element/elastic.hpp"

#include "core/input_error.hpp"

#include <Eigen/LU>

#include <cmath>
#include <numbers>
#include <span>

namespace damslip::fe2d {

namespace {

using StrainMatrix = Eigen::Matrix<double, 3, 8>; ///< strain (xx, yy, 2xy) = B u
using ModeMatrix = Eigen::Matrix<double, 3, 4>;   ///< strain of the two incompatible modes, each with x and y amplitude

StrainMatrix strain_matrix(const Eigen::Matrix<double, 2, 4>& gradient)
{
    StrainMatrix b = StrainMatrix::Zero();
    for (int i = 0; i < 4; ++i) {
        b(0, 2 * i) = b(2, 2 * i + 1) = gradient(0, i);
        b(1, 2 * i + 1) = b(2, 2 * i) = gradient(1, i);
    }
    return b;
}

/// Jacobian dx/dxi at the centre of the element: constant in the corrected derivatives of the incompatible modes.
struct CentreJacobian {
    Eigen::Matrix2d inverse; ///< (d xi / d x), rows: d/dx, d/dy as acting on natural derivatives
    double determinant = 0.0;
};

CentreJacobian centre_jacobian(const Corners& c)
{
    Eigen::Matrix2d j;
    j << 0.25 * (-c[0].x + c[1].x + c[2].x - c[3].x), 0.25 * (-c[0].y + c[1].y + c[2].y - c[3].y), //
        0.25 * (-c[0].x - c[1].x + c[2].x + c[3].x), 0.25 * (-c[0].y - c[1].y + c[2].y + c[3].y);
    return {j.inverse(), j.determinant()};
}

/// Taylor, Beresford, Wilson (1976): grad M = (j0 / j) J0^-1 dM/dxi, so that the modes' strain integrates to zero and a
/// constant stress does no work on them.
ModeMatrix mode_matrix(const CentreJacobian& centre, const QuadraturePoint& point)
{
    const double ratio = centre.determinant / point.weight; // Gauss weights are 1: point.weight is the determinant
    const Eigen::Vector2d first = ratio * centre.inverse.col(0) * (-2.0 * point.xi);
    const Eigen::Vector2d second = ratio * centre.inverse.col(1) * (-2.0 * point.eta);
    ModeMatrix g;
    g << first[0], 0.0, second[0], 0.0, //
        0.0, first[1], 0.0, second[1],  //
        first[1], first[0], second[1], second[0];
    return g;
}

struct ModeStiffness {
    Eigen::Matrix4d modes = Eigen::Matrix4d::Zero();                            ///< K_aa
    Eigen::Matrix<double, 4, 8> coupling = Eigen::Matrix<double, 4, 8>::Zero(); ///< K_au
};

ModeStiffness mode_stiffness(std::span<const QuadraturePoint> points, const CentreJacobian& centre,
                             const Eigen::Matrix3d& d)
{
    ModeStiffness k;
    for (const QuadraturePoint& point : points) {
        const ModeMatrix g = mode_matrix(centre, point);
        const Eigen::Matrix<double, 4, 3> gd = g.transpose() * d * point.weight;
        k.modes += gd * g;
        k.coupling += gd * strain_matrix(point.gradient);
    }
    return k;
}

/// Amplitudes of the incompatible modes: K_aa a + K_au u = 0.
Eigen::Vector4d mode_amplitudes(const Corners& corners, const Eigen::Matrix3d& d, const Eigen::Matrix<double, 8, 1>& u)
{
    const auto points = q4_points(corners);
    const ModeStiffness k = mode_stiffness(points, centre_jacobian(corners), d);
    return -k.modes.inverse() * (k.coupling * u);
}

/// Stress at the four Gauss points of a quadrilateral, one column each.
Eigen::Matrix<double, 3, 4> gauss_stress(const Corners& corners, const Eigen::Matrix3d& d, Q4Kind kind,
                                         const Eigen::Matrix<double, 8, 1>& u)
{
    const auto points = q4_points(corners);
    Eigen::Vector4d a = Eigen::Vector4d::Zero();
    if (kind == Q4Kind::incompatible) a = mode_amplitudes(corners, d, u);
    const CentreJacobian centre = centre_jacobian(corners);
    Eigen::Matrix<double, 3, 4> stress;
    for (int i = 0; i < 4; ++i)
        stress.col(i) = d * (strain_matrix(points[i].gradient) * u + mode_matrix(centre, points[i]) * a);
    return stress;
}

Eigen::Vector3d t3_stress(const Corners& corners, const Eigen::Matrix3d& d, const ElementVector& u)
{
    return d * (strain_matrix(t3_points(corners)[0].gradient).leftCols<6>() * u.head<6>());
}

template <class Points>
ElementMatrix consistent_mass(const Points& points, int size, double density)
{
    ElementMatrix m = ElementMatrix::Zero(2 * size, 2 * size);
    for (const QuadraturePoint& point : points)
        for (int i = 0; i < size; ++i)
            for (int j = 0; j < size; ++j) {
                const double value = density * point.weight * point.shape[i] * point.shape[j];
                m(2 * i, 2 * j) += value;
                m(2 * i + 1, 2 * j + 1) += value;
            }
    return m;
}

template <class Points>
ElementVector constant_force(const Points& points, int size, const Eigen::Vector2d& force)
{
    ElementVector f = ElementVector::Zero(2 * size);
    for (const QuadraturePoint& point : points)
        for (int i = 0; i < size; ++i) f.segment<2>(2 * i) += point.weight * point.shape[i] * force;
    return f;
}

} // namespace

Q4Kind q4_kind(ElementKind kind)
{
    const bool plain = kind == ElementKind::q4 || kind == ElementKind::t3 || kind == ElementKind::t6;
    return plain ? Q4Kind::plain : Q4Kind::incompatible;
}

ElementMatrix elastic_stiffness(const Corners& corners, int size, const Eigen::Matrix3d& d, Q4Kind kind,
                                const ExtraNodes& extra)
{
    if (extra.any()) return quadratic_stiffness(corners, size, extra, d);
    if (size == 3) {
        const auto points = t3_points(corners);
        const Eigen::Matrix<double, 3, 6> b = strain_matrix(points[0].gradient).leftCols<6>();
        return 3.0 * points[0].weight * b.transpose() * d * b;
    }
    const auto points = q4_points(corners);
    Eigen::Matrix<double, 8, 8> k = Eigen::Matrix<double, 8, 8>::Zero();
    for (const QuadraturePoint& point : points) {
        const StrainMatrix b = strain_matrix(point.gradient);
        k += point.weight * b.transpose() * d * b;
    }
    if (kind == Q4Kind::incompatible) {
        const ModeStiffness modes = mode_stiffness(points, centre_jacobian(corners), d);
        k -= modes.coupling.transpose() * modes.modes.inverse() * modes.coupling;
    }
    return 0.5 * (k + k.transpose());
}

ElementMatrix elastic_mass(const Corners& corners, int size, double density, MassKind kind, const ExtraNodes& extra)
{
    if (extra.any()) return quadratic_mass(corners, size, extra, density, kind);
    ElementMatrix m =
        size == 3 ? consistent_mass(t3_points(corners), 3, density) : consistent_mass(q4_points(corners), 4, density);
    if (kind == MassKind::lumped) {
        const ElementVector sums = m.rowwise().sum();
        m = sums.asDiagonal();
    }
    return m;
}

ElementVector body_force(const Corners& corners, int size, const Eigen::Vector2d& force, const ExtraNodes& extra)
{
    if (extra.any()) return quadratic_body_force(corners, size, extra, force);
    return size == 3 ? constant_force(t3_points(corners), 3, force) : constant_force(q4_points(corners), 4, force);
}

NodalStress nodal_stress(const Corners& corners, int size, const Eigen::Matrix3d& d, Q4Kind kind,
                         const ElementVector& u, const ExtraNodes& extra)
{
    if (extra.any()) return quadratic_nodal_stress(corners, size, extra, d, u);
    if (size == 3) return t3_stress(corners, d, u).replicate<1, 3>();
    // The Gauss points are a square of half-width 1/sqrt 3: seen from it the nodes are at +-sqrt 3 of the bilinear
    // functions.
    const double a = 1.0 + std::numbers::sqrt3 / 2.0, b = -0.5, c = 1.0 - std::numbers::sqrt3 / 2.0;
    Eigen::Matrix4d extrapolation;
    extrapolation << a, b, c, b, b, a, b, c, c, b, a, b, b, c, b, a;
    return gauss_stress(corners, d, kind, u) * extrapolation;
}

Eigen::Vector3d centre_stress(const Corners& corners, int size, const Eigen::Matrix3d& d, Q4Kind kind,
                              const ElementVector& u, const ExtraNodes& extra)
{
    if (extra.any()) return quadratic_centre_stress(corners, size, extra, d, u);
    if (size == 3) return t3_stress(corners, d, u);
    return gauss_stress(corners, d, kind, u).rowwise().mean();
}

ExtraNodes extra_nodes(const Element& element)
{
    ExtraNodes extra;
    for (int i = 0; i < 4; ++i) extra.mid[i] = element.mid[i] >= 0;
    extra.centre = element.centre >= 0;
    return extra;
}

QuadraturePoint q4_point(const Corners& corners, double xi, double eta)
{
    static constexpr double sx[4] = {-1, 1, 1, -1}, sy[4] = {-1, -1, 1, 1};
    QuadraturePoint point{.xi = xi,
                          .eta = eta,
                          .weight = 0.0,
                          .shape = Eigen::Vector4d::Zero(),
                          .gradient = Eigen::Matrix<double, 2, 4>::Zero()};
    Eigen::Matrix<double, 2, 4> natural;
    Eigen::Matrix<double, 4, 2> x;
    for (int i = 0; i < 4; ++i) {
        point.shape[i] = 0.25 * (1.0 + sx[i] * xi) * (1.0 + sy[i] * eta);
        natural(0, i) = 0.25 * sx[i] * (1.0 + sy[i] * eta);
        natural(1, i) = 0.25 * sy[i] * (1.0 + sx[i] * xi);
        x.row(i) << corners[i].x, corners[i].y;
    }
    const Eigen::Matrix2d jacobian = natural * x;
    point.weight = jacobian(0, 0) * jacobian(1, 1) - jacobian(0, 1) * jacobian(1, 0);
    Eigen::Matrix2d inverse;
    inverse << jacobian(1, 1), -jacobian(0, 1), -jacobian(1, 0), jacobian(0, 0);
    point.gradient = inverse * natural / point.weight;
    return point;
}

std::array<QuadraturePoint, 4> q4_points(const Corners& corners)
{
    const double g = 1.0 / std::numbers::sqrt3;
    return {q4_point(corners, -g, -g), q4_point(corners, g, -g), q4_point(corners, g, g), q4_point(corners, -g, g)};
}

std::array<QuadraturePoint, 3> t3_points(const Corners& c)
{
    const double twice_area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
    QuadraturePoint point{.xi = 0.0,
                          .eta = 0.0,
                          .weight = twice_area / 6.0,
                          .shape = Eigen::Vector4d::Zero(),
                          .gradient = Eigen::Matrix<double, 2, 4>::Zero()};
    point.gradient << c[1].y - c[2].y, c[2].y - c[0].y, c[0].y - c[1].y, 0.0, //
        c[2].x - c[1].x, c[0].x - c[2].x, c[1].x - c[0].x, 0.0;
    point.gradient /= twice_area;
    std::array<QuadraturePoint, 3> points{point, point, point};
    points[0].shape << 0.5, 0.5, 0.0, 0.0;
    points[1].shape << 0.0, 0.5, 0.5, 0.0;
    points[2].shape << 0.5, 0.0, 0.5, 0.0;
    return points;
}

namespace {

ElementMatrix quadratic_gradient_matrix(const Corners& corners, int size, double conductivity, const ExtraNodes& extra)
{
    const int nodes = size + extra.count();
    ElementMatrix k = ElementMatrix::Zero(nodes, nodes);
    for (const QuadraticPoint& point : quadratic_points(corners, size, extra))
        k += conductivity * point.weight * point.gradient.transpose() * point.gradient;
    return k;
}

ElementMatrix quadratic_scalar_mass(const Corners& corners, int size, double capacity, const ExtraNodes& extra)
{
    const int nodes = size + extra.count();
    ElementMatrix m = ElementMatrix::Zero(nodes, nodes);
    for (const QuadraticPoint& point : quadratic_points(corners, size, extra))
        m += capacity * point.weight * point.shape * point.shape.transpose();
    return m;
}

} // namespace

ElementMatrix scalar_gradient_matrix(const Corners& corners, int size, double conductivity, const ExtraNodes& extra)
{
    if (extra.any()) return quadratic_gradient_matrix(corners, size, conductivity, extra);
    ElementMatrix k = ElementMatrix::Zero(size, size);
    const auto add = [&](const QuadraturePoint& point) {
        const auto gradient = point.gradient.leftCols(size);
        k += conductivity * point.weight * gradient.transpose() * gradient;
    };
    if (size == 3)
        for (const auto& point : t3_points(corners)) add(point);
    else
        for (const auto& point : q4_points(corners)) add(point);
    return k;
}

ElementMatrix scalar_mass_matrix(const Corners& corners, int size, double capacity, const ExtraNodes& extra)
{
    if (extra.any()) return quadratic_scalar_mass(corners, size, capacity, extra);
    ElementMatrix m = ElementMatrix::Zero(size, size);
    const auto add = [&](const QuadraturePoint& point) {
        m += capacity * point.weight * point.shape.head(size) * point.shape.head(size).transpose();
    };
    if (size == 3)
        for (const auto& point : t3_points(corners)) add(point);
    else
        for (const auto& point : q4_points(corners)) add(point);
    return m;
}

Eigen::Matrix3d plane_strain_matrix(const ElasticMaterial& material)
{
    const double nu = material.poisson_ratio;
    const double factor = material.young_modulus / ((1.0 + nu) * (1.0 - 2.0 * nu));
    Eigen::Matrix3d d;
    d << 1.0 - nu, nu, 0.0, //
        nu, 1.0 - nu, 0.0,  //
        0.0, 0.0, 0.5 - nu;
    return factor * d;
}

ElasticMaterial plane_stress_equivalent(const ElasticMaterial& material)
{
    const double nu = material.poisson_ratio;
    return {material.density, material.young_modulus * (1.0 + 2.0 * nu) / ((1.0 + nu) * (1.0 + nu)), nu / (1.0 + nu)};
}

ElasticMaterial elastic_material(const Material& material, const Scene& scene, const char* key)
{
    if (!material.young_modulus)
        throw InputError(Diagnostic{.file = scene.file.string(),
                                    .problem = std::string(key) + ".young_modulus is missing.",
                                    .expected = "a number > 0; finite elements need it (concrete: 20 to 35 GPa)",
                                    .fix = std::string("add  young_modulus_GPa = ...  to [") + key + "]"});
    return {material.density, *material.young_modulus, material.poisson_ratio};
}

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
