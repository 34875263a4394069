#include "verification/cases/modules.hpp"

#include "fe2d/element/elastic.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/rock/radiating_rock.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/cases/small_dam.hpp"
#include "verification/exact/half_plane.hpp"
#include "verification/exact/strip_loads.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double density = 2650.0;

/// The base of the reference dam on its rock.
std::vector<Check> strip_beside_half_plane()
{
    constexpr int elements = 60;
    constexpr double length = 45.0;
    fe2d::RadiatingRockInput input;
    input.rock = {density, 30e9, 0.2};
    for (int i = 0; i <= elements; ++i) input.surface.push_back({length * i / elements, 0.0});
    input.heel = input.surface.front();
    input.toe = input.surface.back();
    input.highest_frequency = 2.0 * std::numbers::pi * 25.0;
    const fe2d::RadiatingRock rock = fe2d::radiating_rock(input, fe2d::RockStore(""));
    const exact::HalfPlane plane{input.rock.young_modulus / 2.4, 0.2, density, 0.5 * length};
    const MatrixXd loads = exact::strip_loads(input.surface);
    std::vector<Check> checks;
    struct Gate {
        double hertz, largest;
    };
    for (const auto& [hertz, gate] :
         {Gate{1.0, 0.10}, Gate{3.0, 0.03}, Gate{5.0, 0.03}, Gate{10.0, 0.03}, Gate{20.0, 0.03}, Gate{25.0, 0.05}}) {
        const double w = 2.0 * std::numbers::pi * hertz;
        const MatrixXcd u = loads.transpose() * rock.rock.response(w, 0.0, loads);
        const std::complex<double> exact[] = {plane.horizontal(w), plane.vertical(w), plane.rocking(w)};
        const char* const motion[] = {"horizontal", "vertical", "rocking"};
        for (const int i : {0, 1, 2})
            checks.push_back({fmt::format("{:g} Hz, {}: complex relative error of the flexibility", hertz, motion[i]),
                              "-", gate, std::abs(u(i, i) / exact[i] - 1.0), 0.0, Measure::upper_bound});
    }
    checks.push_back({"error of the reduction at frequencies in between", "-", rock.rock.report.wanted,
                      rock.rock.report.error, 0.0, Measure::upper_bound});
    return checks;
}

/// The reference dam on coarse elements and rock that radiates.
Scene reference_radiating(double friction = 0.77)
{
    Scene scene = fe2d::test::sliding_dam(friction);
    scene.foundation->mass = RockMass::with_mass;
    scene.foundation->boundary = RockBoundary::absorbing;
    return scene;
}

struct Slide {
    double slip = 0.0, crest = 0.0, imbalance = 0.0;
    fe2d::Energy energy;
};

Slide slide(Scene scene, const GroundMotion& motion)
{
    scene.time.substeps = 0;
    const fe2d::RunResult r = fe2d::EarthquakeRun(scene, fe2d::test::options_of(scene)).run(motion);
    Slide result{r.slip, 0.0, r.energy_error, r.history.energy.empty() ? fe2d::Energy() : r.history.energy.back()};
    for (const double x : r.history.crest_x) result.crest = std::max(result.crest, std::abs(x));
    if (r.history.time.empty()) result.slip = std::nan("");
    return result;
}

std::vector<Check> size_of_the_wave_box()
{
    std::vector<Check> checks;
    for (const unsigned seed : {5u, 11u})
        for (const double friction : {0.70, 0.77}) {
            const GroundMotion motion = fe2d::test::sines(1.0, 10.0, seed);
            const auto in_box = [&](double size) {
                Scene scene = reference_radiating(friction);
                scene.foundation->wave_box = size;
                return slide(scene, motion);
            };
            const Slide usual = in_box(1.0);
            for (const double size : {0.7, 1.4}) {
                const Slide other = in_box(size);
                const std::string name = fmt::format("motion {}, friction {:g}, box x {:g}: ", seed, friction, size);
                checks.push_back({name + "slip", "m", usual.slip, other.slip, 0.02, Measure::relative});
                checks.push_back({name + "crest", "m", usual.crest, other.crest, 0.02, Measure::relative});
            }
        }
    return checks;
}

std::vector<Check> beside_a_large_box()
{
    const GroundMotion motion = fe2d::test::sines(1.0, 10.0);
    Scene boxed = reference_radiating();
    boxed.curtain.reset();
    const Slide radiating = slide(boxed, motion);
    boxed.foundation->boundary = RockBoundary::viscous;
    boxed.foundation->material.density = density;
    boxed.foundation->width = 1200.0;
    boxed.foundation->depth = 400.0;
    boxed.mesh.rock_size = 12.5;
    const Slide whole = slide(boxed, motion);
    return {{"slip", "m", whole.slip, radiating.slip, 0.05, Measure::relative},
            {"crest", "m", whole.crest, radiating.crest, 0.05, Measure::relative},
            {"energy radiated", "J/m", whole.energy.radiated, radiating.energy.radiated, 0.10, Measure::relative}};
}

/// All modes of a box that is small enough for them: the box itself, for any load.
fe2d::ReducedRock all_modes(const fe2d::WaveBox& box)
{
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen{MatrixXd(box.stiffness), MatrixXd(box.mass)};
    const MatrixXd& shape = eigen.eigenvectors();
    fe2d::ReducedRock rock;
    rock.stiffness = eigen.eigenvalues();
    rock.damping = shape.transpose() * (box.damping * shape);
    const auto interface = static_cast<Index>(box.interface.size());
    rock.modes.resize(interface, shape.cols());
    for (Index i = 0; i < interface; ++i) rock.modes.row(i) = shape.row(box.interface[static_cast<std::size_t>(i)]);
    rock.residual = MatrixXd::Zero(interface, interface);
    return rock;
}

std::vector<Check> reduced_beside_whole_rock()
{
    const Scene scene = small_dam_scene(SmallDamBase::rock);
    const SmallDam dam(scene);
    fe2d::WaveBoxInput input;
    const Material& material = scene.foundation->material;
    input.rock = {density, *material.young_modulus, material.poisson_ratio};
    for (const int node : dam.mesh().contact.rock_nodes)
        input.surface.push_back(dam.mesh().nodes[static_cast<std::size_t>(node)]);
    input.base = input.surface.back().x - input.surface.front().x;
    input.middle = input.surface.front().x + 0.5 * input.base;
    input.highest_frequency = 2.0 * std::numbers::pi * 12.5;
    input.shape.width = 5.0;
    input.shape.depth = 2.5;
    input.shape.inner_width = 2.0;
    input.shape.inner_depth = 0.6;
    input.shape.per_sponge = 6.0;
    const fe2d::WaveBox box = fe2d::make_wave_box(input);
    const fe2d::ReducedRock whole = all_modes(box), reduced = fe2d::reduce_rock(input, box);

    const GroundMotion motion = fe2d::test::sines(5.0, 6.0);
    struct Run {
        VectorXd slip, crest;
        double imbalance = 0.0;
    };
    const auto run = [&](const fe2d::ReducedRock& rock) {
        fe2d::DynamicContact dynamics = dam.dynamics(
            fe2d::hht(-0.05),
            std::make_shared<const fe2d::ReducedRock>(rock.on_plane(dam.plane().normal, dam.plane().tangent)));
        const auto steps = static_cast<Index>(motion.accel_h.size());
        Run result{VectorXd::Zero(steps), VectorXd::Zero(steps)};
        const VectorXd weights = dam.weights(), start = dynamics.state().contact.slip;
        for (Index k = 1; k < steps; ++k) {
            const auto i = static_cast<std::size_t>(k);
            dynamics.advance(motion.dt, {motion.accel_h[i], motion.accel_v[i]}, dam.law());
            result.slip[k] = weights.dot(dynamics.state().contact.slip - start);
            result.crest[k] = dynamics.state().u[0];
        }
        result.imbalance = std::abs(dynamics.energy_imbalance()) / dynamics.energy_scale();
        return result;
    };
    const Run exact = run(whole), short_one = run(reduced);
    return {{"modes of the whole box over those kept", "-", 3.0,
             static_cast<double>(whole.count()) / static_cast<double>(reduced.count()), 0.0, Measure::lower_bound},
            {"slip at the end", "m", exact.slip.tail(1)[0], short_one.slip.tail(1)[0], 0.005, Measure::relative},
            {"slip, largest difference over the largest", "-", 0.005,
             (exact.slip - short_one.slip).cwiseAbs().maxCoeff() / exact.slip.cwiseAbs().maxCoeff(), 0.0,
             Measure::upper_bound},
            {"motion of a node inside the dam, largest difference over the largest", "-", 0.005,
             (exact.crest - short_one.crest).cwiseAbs().maxCoeff() / exact.crest.cwiseAbs().maxCoeff(), 0.0,
             Measure::upper_bound},
            {"energy that does not close, whole rock", "-", 1e-10, exact.imbalance, 0.0, Measure::upper_bound},
            {"energy that does not close, reduced rock", "-", 1e-10, short_one.imbalance, 0.0, Measure::upper_bound}};
}

std::vector<Check> ground_at_rest()
{
    GroundMotion motion = fe2d::test::sines(1.0, 5.0);
    for (std::vector<double>* a : {&motion.accel_h, &motion.accel_v}) std::fill(a->begin(), a->end(), 0.0);
    const Slide r = slide(reference_radiating(), motion);
    return {{"slip", "m", 0.0, r.slip, 1e-12, Measure::absolute},
            {"crest", "m", 0.0, r.crest, 1e-12, Measure::absolute}};
}

/// Everything that radiating rock goes along with, beside a neighbour that must slide nearly alike.
std::vector<Check> with_everything()
{
    const GroundMotion motion = fe2d::test::sines(1.0, 8.0);
    const auto usual = [] { return reference_radiating(0.74); };
    const Slide plain = slide(usual(), motion);
    const auto variant = [&](const auto& change) {
        Scene scene = usual();
        change(scene);
        return slide(scene, motion);
    };
    const Slide far = variant([](Scene&s) { s.contact.sliding = JointPath::finite; }),
                unequal = variant([](Scene&s) { s.mesh.rock_contact_size = 1.7; }), tight_lift = variant([](Scene&s) {
                                                                                        LiftJoint lift;
                                                                                        lift.elevation = 30.0;
                                                                                        lift.strength.friction = 5.0;
                                                                                        s.lift_joints = {lift};
                                                                                    });
    Scene acoustic = usual();
    acoustic.reservoir->model = ReservoirModel::acoustic;
    const Slide beside_water = slide(acoustic, motion);

    Scene few = usual();
    few.time.substeps = 0;
    const fe2d::RunOptions options = fe2d::test::options_of(few);
    const fe2d::EarthquakeRun full(few, options);
    const fe2d::RunResult reduced = fe2d::ReducedRun(full, few, options, 60).run(motion);
    return {
        {"finite sliding: slip beside that of small sliding", "m", plain.slip, far.slip, 0.02, Measure::relative},
        {"unequal sides: slip beside that of equal ones", "m", plain.slip, unequal.slip, 0.03, Measure::relative},
        {"lift joint that holds: slip beside that without", "m", plain.slip, tight_lift.slip, 0.03, Measure::relative},
        {"acoustic water: slip", "m", 0.0, beside_water.slip, 0.0, Measure::lower_bound},
        {"60 modes of the dam: slip beside that of all", "m", plain.slip, reduced.slip, 0.03, Measure::relative},
        {"finite sliding: energy that does not close", "-", 1e-10, far.imbalance, 0.0, Measure::upper_bound},
        {"unequal sides: energy that does not close", "-", 1e-10, unequal.imbalance, 0.0, Measure::upper_bound},
        {"lift joint: energy that does not close", "-", 1e-10, tight_lift.imbalance, 0.0, Measure::upper_bound},
        {"acoustic water: energy that does not close", "-", 1e-10, beside_water.imbalance, 0.0, Measure::upper_bound}};
}

} // namespace

void add_fe_radiating_cases(Registry& registry)
{
    registry.push_back(
        {"fe2d.radiating.half-plane",
         "Rock with absorbing edges, reduced to the base, gives way under harmonic loads as the half plane does.",
         "Lamb (1904), strip loads integrated over the wave number, verification/exact/half_plane.hpp",
         "waves longer than the box is deep lack stiffness below it: 10 % at 1 Hz; 3 % for 3 ... 20 Hz, 5 % at "
         "25 Hz, for short elements carry short waves less well; the reduction is in it",
         strip_beside_half_plane});
    registry.push_back({"fe2d.radiating.size-of-the-box",
                        "The reference dam slides the same in boxes of waves 0.7 and 1.4 times the automatic one.",
                        "boxes of another size", "2 %: what the sponge sends back", size_of_the_wave_box});
    registry.push_back({"fe2d.radiating.large-box",
                        "It slides as on all unknowns of a box of 1200 m x 400 m with dashpots on its edges.",
                        "another box, other edges, another formulation of the step (fe2d.rock)",
                        "such a box errs by 3 to 12 % in its flexibility at 2 ... 20 Hz, and its statics are those of "
                        "another box, which "
                        "move the slip by 2 %: 5 %; the energy that leaves, larger where more is shaken, 10 %",
                        beside_a_large_box});
    registry.push_back({"fe2d.radiating.reduction",
                        "A dam slides on reduced rock as on all modes of the same box, and the energy of both closes.",
                        "all modes of the box: no reduction",
                        "the gate of the reduction's flexibility is 2 %: 0.5 % of slip and crest",
                        reduced_beside_whole_rock});
    registry.push_back({"fe2d.radiating.ground-at-rest", "With a record of zeros nothing moves on radiating rock.",
                        "the static state is the origin of the rock's motion",
                        "round-off of displacements of some cm over 500 steps", ground_at_rest});
    registry.push_back(
        {"fe2d.radiating.everywhere",
         "Radiating rock goes along with finite sliding, unequal sides, lift joints, acoustic water and few modes of "
         "the "
         "dam.",
         "the same dam with small sliding, equal sides, no joint, all modes",
         "slips of centimetres follow the surface of the rock: 2 %; another spacing of the rock's nodes 3 %; a joint "
         "that holds adds its pairs' own contact 3 %; 60 modes leave 3 %; energy round-off",
         with_everything});
}

} // namespace damslip::verification
