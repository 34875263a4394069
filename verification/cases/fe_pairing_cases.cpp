#include "fe2d/assembly/assemble.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/run/contact_structure.hpp"
#include "verification/cases/modules.hpp"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::fe2d;
using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Two elastic bodies of different moduli in one state of constant stress. Across the plane y = 0 the traction
// (s_xy, s_yy) and the strain e_xx are the same on both sides, s_xx, e_yy and the shear differ; so
//
//     u_x = e_xx x + (g_xy - r) y,   u_y = r x + e_yy y,   r any rotation,
//
// is linear in each body and continuous at y = 0. The rock is held by it at its bottom and sides; all other tractions
// are given, those of the rock's surface only where the dam does not stand on it.
struct LinearState {
    Vector3d strain, stress; ///< xx, yy, xy (engineering shear)
    double rotation = 0.0;

    Vector2d displacement(Point p) const
    {
        return {strain[0] * p.x + (strain[2] - rotation) * p.y, rotation * p.x + strain[1] * p.y};
    }
};

LinearState linear_state(const ElasticMaterial& material, double strain_xx, const Vector2d& traction)
{
    const Eigen::Matrix3d d = plane_strain_matrix(material);
    LinearState state{.strain = Vector3d::Zero(), .stress = Vector3d::Zero(), .rotation = 2e-4};
    state.strain << strain_xx, (traction[1] - d(1, 0) * strain_xx) / d(1, 1), traction[0] / d(2, 2);
    state.stress = d * state.strain;
    return state;
}

/// A rectangle of nx x ny elements with its lower left corner at (x, y); node (i, j) is i + j (nx + 1). Nodes inside
/// are moved about, so that the elements are no rectangles.
struct Block {
    Mesh mesh;
    int nx = 0, ny = 0;

    int node(int i, int j) const { return i + j * (nx + 1); }
    NodeChain row(int j) const
    {
        NodeChain nodes;
        for (int i = 0; i <= nx; ++i) nodes.push_back(node(i, j));
        return nodes;
    }
    NodeChain column(int i) const
    {
        NodeChain nodes;
        for (int j = 0; j <= ny; ++j) nodes.push_back(node(i, j));
        return nodes;
    }
};

Block block(Point corner, double width, double height, int nx, int ny, Region region)
{
    Block b{.mesh = {}, .nx = nx, .ny = ny};
    const double hx = width / nx, hy = height / ny;
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) {
            const bool inside = i > 0 && i < nx && j > 0 && j < ny;
            const double move = inside ? 0.15 : 0.0;
            b.mesh.nodes.push_back({corner.x + hx * (i + move * std::sin(3.0 * i + j)),
                                    corner.y + hy * (j + move * std::cos(2.0 * i + 5.0 * j))});
        }
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            b.mesh.elements.push_back(
                {{b.node(i, j), b.node(i + 1, j), b.node(i + 1, j + 1), b.node(i, j + 1)}, region});
    return b;
}

/// Integral of N^T t over the part of a straight chain between the distances `from` and `to` along it.
void add_traction(VectorXd& force, const Mesh& mesh, const NodeChain& chain, const Vector2d& traction,
                  double from = -HUGE_VAL, double to = HUGE_VAL)
{
    double a = 0.0; // distance of the edge's first node from the chain's
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        const Point p = mesh.nodes[static_cast<std::size_t>(chain[k])],
                    q = mesh.nodes[static_cast<std::size_t>(chain[k + 1])];
        const double length = std::hypot(q.x - p.x, q.y - p.y);
        const double begin = std::max(0.0, from - a), end = std::min(length, to - a);
        if (end > begin) {
            const double second = (end * end - begin * begin) / (2.0 * length), first = end - begin - second;
            force.segment<2>(2 * chain[k]) += first * traction;
            force.segment<2>(2 * chain[k + 1]) += second * traction;
        }
        a += length;
    }
}

/// What the rock's displacements at its surface nodes are for the dam's nodes.
using Trace = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The rock's shape functions at the dam's nodes: continuous at these points, and not enough.
Trace interpolation(const std::vector<double>& dam, const std::vector<double>& rock)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < dam.size(); ++i) {
        std::size_t j = 0;
        while (j + 2 < rock.size() && rock[j + 1] < dam[i]) ++j;
        const double eta = (dam[i] - rock[j]) / (rock[j + 1] - rock[j]);
        entries.emplace_back(i, j, 1.0 - eta);
        entries.emplace_back(i, j + 1, eta);
    }
    Trace result(static_cast<Index>(dam.size()), static_cast<Index>(rock.size()));
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

struct TwoBodies {
    double rock_size = 2.0; ///< wanted on the surface [m]
    double dam_size = 3.0;  ///< [m]
    double offset = 0.0;    ///< of the dam's heel from the rock's first node [m]
};

struct Errors {
    double displacement = 0.0, stress = 0.0, traction = 0.0; ///< largest over the exact one's largest [-]
};

constexpr double dam_width = 12.0, rock_width = 24.0, height = 6.0;

std::vector<double> distances(const Mesh& mesh, const NodeChain& chain, double origin)
{
    std::vector<double> result;
    for (const int n : chain) result.push_back(mesh.nodes[static_cast<std::size_t>(n)].x - origin);
    return result;
}

enum class Joining { mortar, interpolated };

Errors solve(const TwoBodies& sizes, Joining joining)
{
    const ElasticMaterial concrete{0.0, 25e9, 0.17}, stone{0.0, 10e9, 0.3};
    const Materials materials{.dam = concrete, .rock = stone, .curtain = stone, .block = {}, .kind = Q4Kind::incompatible};
    const Vector2d traction(0.3e6, -1e6); // on the dam's top: shear and pressure
    const LinearState upper = linear_state(concrete, 2e-5, traction), lower = linear_state(stone, 2e-5, traction);
    const int across = static_cast<int>(std::lround(rock_width / sizes.rock_size));
    const Block dam = block({sizes.offset, 0.0}, dam_width, height,
                            static_cast<int>(std::lround(dam_width / sizes.dam_size)), 3, Region::dam);
    const Block rock = block({0.0, -height}, rock_width, height, across, 3, Region::rock);
    const NodeChain base = dam.row(0), surface = rock.row(rock.ny);
    const DofMap dam_dofs = all_dofs(dam.mesh, 2), rock_dofs = all_dofs(rock.mesh, 2);
    const Index nd = dam_dofs.count, nr = rock_dofs.count;

    VectorXd load = VectorXd::Zero(nd + nr);
    VectorXd on_dam = VectorXd::Zero(nd), on_rock = VectorXd::Zero(nr);
    const auto side = [&](double sign) { return Vector2d(sign * upper.stress[0], sign * upper.stress[2]); };
    add_traction(on_dam, dam.mesh, dam.row(dam.ny), traction);
    add_traction(on_dam, dam.mesh, dam.column(0), side(-1.0));
    add_traction(on_dam, dam.mesh, dam.column(dam.nx), side(1.0));
    add_traction(on_rock, rock.mesh, surface, traction, -HUGE_VAL, sizes.offset);
    add_traction(on_rock, rock.mesh, surface, traction, sizes.offset + dam_width, HUGE_VAL);
    load << on_dam, on_rock;

    // All displacements (dam, rock) = join * v; v holds the same list, its entries of the dam's base unused.
    const std::vector<double> dam_places = distances(dam.mesh, base, sizes.offset),
                              rock_places = distances(rock.mesh, surface, 0.0);
    const Trace trace = joining == Joining::mortar ? Pairing(dam_places, rock_places).weights(sizes.offset)
                                                   : interpolation(distances(dam.mesh, base, 0.0), rock_places);
    std::vector<bool> known(static_cast<std::size_t>(nd + nr), false); // not an unknown: at the base, or held
    VectorXd held = VectorXd::Zero(nd + nr);
    for (const int n : base)
        for (const int c : {0, 1}) known[static_cast<std::size_t>(dam_dofs(n, c))] = true;
    for (const NodeChain& chain : {rock.row(0), rock.column(0), rock.column(rock.nx)})
        for (const int n : chain)
            for (const int c : {0, 1}) {
                known[static_cast<std::size_t>(nd + rock_dofs(n, c))] = true;
                held[nd + rock_dofs(n, c)] = lower.displacement(rock.mesh.nodes[static_cast<std::size_t>(n)])[c];
            }
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<bool> at_base(static_cast<std::size_t>(nd), false);
    for (const int n : base)
        for (const int c : {0, 1}) at_base[static_cast<std::size_t>(dam_dofs(n, c))] = true;
    for (Index i = 0; i < nd + nr; ++i)
        if (i >= nd || !at_base[static_cast<std::size_t>(i)]) entries.emplace_back(i, i, 1.0);
    for (Index i = 0; i < trace.outerSize(); ++i)
        for (Trace::InnerIterator it(trace, i); it; ++it)
            for (const int c : {0, 1})
                entries.emplace_back(dam_dofs(base[static_cast<std::size_t>(i)], c),
                                     nd + rock_dofs(surface[static_cast<std::size_t>(it.col())], c), it.value());
    SparseMatrix join(nd + nr, nd + nr);
    join.setFromTriplets(entries.begin(), entries.end());

    SparseMatrix both(nd + nr, nd + nr);
    entries.clear();
    const auto insert = [&entries](const SparseMatrix& part, Index first) {
        for (Index j = 0; j < part.outerSize(); ++j)
            for (SparseMatrix::InnerIterator it(part, j); it; ++it)
                entries.emplace_back(first + it.row(), first + it.col(), it.value());
    };
    insert(stiffness_matrix(dam.mesh, dam_dofs, materials), 0);
    insert(stiffness_matrix(rock.mesh, rock_dofs, materials), nd);
    both.setFromTriplets(entries.begin(), entries.end());

    std::vector<Eigen::Triplet<double>> choose;
    Index unknowns = 0;
    for (Index i = 0; i < nd + nr; ++i)
        if (!known[static_cast<std::size_t>(i)]) choose.emplace_back(i, unknowns++, 1.0);
    SparseMatrix free(nd + nr, unknowns);
    free.setFromTriplets(choose.begin(), choose.end());
    const SparseMatrix shape = join * free;
    const Eigen::SimplicialLDLT<SparseMatrix> solver(SparseMatrix(shape.transpose() * both * shape));
    VectorXd u = join * held;
    for (int pass = 0; pass < 2; ++pass) // the second removes the round-off of the first
        u += shape * solver.solve(VectorXd(shape.transpose() * (load - both * u)));

    Errors errors;
    double largest = 0.0;
    const auto compare = [&](const Block& b, const LinearState& state, const DofMap& dofs, const VectorXd& part) {
        for (int n = 0; n < b.mesh.node_count(); ++n) {
            const Vector2d exact = state.displacement(b.mesh.nodes[static_cast<std::size_t>(n)]);
            largest = std::max(largest, exact.cwiseAbs().maxCoeff());
            errors.displacement = std::max(errors.displacement, (part.segment<2>(2 * n) - exact).cwiseAbs().maxCoeff());
        }
        const StressField field = stress_field(b.mesh, dofs, materials, part);
        errors.stress = std::max(errors.stress, (field.nodal.colwise() - state.stress).cwiseAbs().maxCoeff() / 1e6);
    };
    compare(dam, upper, dam_dofs, u.head(nd));
    compare(rock, lower, rock_dofs, u.tail(nr));
    errors.displacement /= largest;
    const VectorXd residual = load - both * u; // minus what the joint does to the dam's base
    for (std::size_t i = 0; i < base.size(); ++i) {
        const double area = dam_width / dam.nx * (i == 0 || i + 1 == base.size() ? 0.5 : 1.0);
        const Vector2d force = residual.segment<2>(2 * base[i]);
        errors.traction = std::max(errors.traction, (force / area - traction).cwiseAbs().maxCoeff() / 1e6);
    }
    return errors;
}

std::vector<Check> pairing_patch()
{
    std::vector<Check> checks;
    const auto add = [&](const std::string& name, const TwoBodies& sizes) {
        const Errors e = solve(sizes, Joining::mortar);
        checks.push_back({name + ": displacement error", "-", 1e-12, e.displacement, 0.0, Measure::upper_bound});
        checks.push_back({name + ": stress error", "-", 1e-12, e.stress, 0.0, Measure::upper_bound});
        checks.push_back({name + ": contact stress error", "-", 1e-12, e.traction, 0.0, Measure::upper_bound});
    };
    add("rock to dam 2:3", {.rock_size = 2.0, .dam_size = 3.0, .offset = 6.0});
    add("2:3, offset 4 sqrt(2)", {.rock_size = 2.0, .dam_size = 3.0, .offset = 4.0 * std::numbers::sqrt2});
    add("3:2, offset 2 e", {.rock_size = 3.0, .dam_size = 2.0, .offset = 2.0 * std::numbers::e});
    add("1:1, offset pi", {.rock_size = 2.0, .dam_size = 2.0, .offset = std::numbers::pi});
    checks.push_back({"counter-proof, plain interpolation, 2:3: contact stress error", "-", 0.01,
                      solve({.rock_size = 2.0, .dam_size = 3.0, .offset = 6.0}, Joining::interpolated).traction, 0.0,
                      Measure::lower_bound});
    return checks;
}

} // namespace

void add_fe_pairing_cases(Registry& registry)
{
    registry.push_back({"fe.contact.pairing-patch",
                        "Two elastic bodies whose meshes do not match carry a constant stress through the plane.",
                        "linear elasticity: constant stress, equal traction and strain along the plane on both sides",
                        "exact for linear displacement on any meshes: round-off of about 600 unknowns, 1e-12; plain "
                        "interpolation at the dam's nodes is wrong by more than 1 %",
                        pairing_patch});
}

} // namespace damslip::verification
