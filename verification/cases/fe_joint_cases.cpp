#include "verification/cases/modules.hpp"

#include "fe2d/contact/contact_solver.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "verification/exact/reference_scene.hpp"

#include <algorithm>

namespace damslip::verification {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Water of uniform pressure p in the joint below a block on rock: -p on the rock, +p on the block, and contact presses
/// by p less. Each side feels the total stress it felt before, so nothing moves.
std::vector<Check> uplift_on_both_faces()
{
    const double base = 40.0, height = 20.0, pressure = 100e3;
    Scene scene = exact::bare_scene({{0, 0}, {base, 0}, {base, height}, {0, height}}, 2400.0);
    scene.dam.young_modulus = 25e9;
    scene.contact.friction = 5.0; // no pair slips
    scene.foundation =
        Foundation{.material = {0.0, 10e9, 0.2}, .mass = RockMass::massless, .width = 200.0, .depth = 60.0};
    scene.mesh.size = 5.0;
    scene.mesh.contact_size = 4.0;
    GroundMotion silence;
    silence.dt = 0.01;
    silence.accel_h.assign(11, 0.0);
    fe2d::RunOptions options;
    scene.time.substeps = 0;
    const fe2d::RunResult dry = fe2d::EarthquakeRun(scene, options).run(silence);
    options.uplift = {{{0.0, pressure}, {base, pressure}}};
    const fe2d::RunResult wet = fe2d::EarthquakeRun(scene, options).run(silence);
    const double weight = 2400.0 * scene.gravity * base * height;
    return {{"N' with water in the joint", "N/m", weight - pressure * base, wet.history.normal_force.front(), 1e-10,
             Measure::relative},
            {"least pressure of a pair with it", "Pa", 0.0, wet.pair_pressure.minCoeff(), 0.0, Measure::lower_bound},
            {"largest displacement by it, of that by the weight", "-", 1e-10,
             (wet.displacement - dry.displacement).cwiseAbs().maxCoeff() / dry.displacement.cwiseAbs().maxCoeff(), 0.0,
             Measure::upper_bound}};
}

/// A bar on n pairs whose normal forces go from tension to compression, N_i = 4 i/(n - 1) - 1, pulled over the bed
/// against a soft spring: joint that cannot open.
std::vector<Check> no_separation()
{
    const Index n = 11;
    const double friction = 0.6, bar = 10.0, spring = 0.1, pull = 20.0;
    MatrixXd v = MatrixXd::Zero(2 * n, 2 * n);
    v.topLeftCorner(n, n).setIdentity();
    for (Index k = n; k + 1 < 2 * n; ++k) {
        v(k, k) += bar;
        v(k + 1, k + 1) += bar;
        v(k, k + 1) -= bar;
        v(k + 1, k) -= bar;
    }
    v(n, n) += spring;
    VectorXd stuck = VectorXd::Zero(2 * n);
    stuck.head(n) = VectorXd::LinSpaced(n, -1.0, 3.0);
    stuck[n] = -pull;
    fe2d::ContactLaw law = fe2d::uniform_law(n, friction);
    law.separation = JointOpening::none;
    fe2d::ContactSolver solver(v);
    fe2d::ContactSolution solution;
    const fe2d::ContactReport report = solver.solve(stuck, law, solution);
    double on_pulled = 0.0;
    for (Index i = 0; i < n; ++i)
        if (stuck[i] < 0.0) on_pulled = std::max(on_pulled, std::abs(solution.force[n + i]));
    const double capacity = friction * stuck.head(n).cwiseMax(0.0).sum();
    return {
        {"resolved", "-", 1.0, report.resolved() ? 1.0 : 0.0, 0.0, Measure::absolute},
        {"shear of all pairs", "of a unit force", capacity, -solution.force.tail(n).sum(), 1e-12, Measure::relative},
        {"largest shear of a pair in tension", "of a unit force", 1e-12, on_pulled, 0.0, Measure::upper_bound},
        {"largest opening", "of a unit length", 0.0, solution.displacement.head(n).cwiseAbs().maxCoeff(), 0.0,
         Measure::absolute}};
}

} // namespace

void add_fe_joint_cases(Registry& registry)
{
    registry.push_back(
        {"fe.contact.uplift-on-both-faces", "Water in a joint that stays shut moves neither side of it.",
         "effective stress, Terzaghi (1923): total stress is contact pressure and water pressure together",
         "round-off of one static solution", uplift_on_both_faces});
    registry.push_back({"fe.contact.no-separation",
                        "Where the joint cannot open, compressed pairs carry mu N and those in tension nothing.",
                        "sum of mu max(N_i, 0) by hand", "round-off of one solution", no_separation});
}

} // namespace damslip::verification
