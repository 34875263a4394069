// A dam on a weak seam by finite elements, against the chain of rigid blocks: forces at the limit, factor, slip.
#include "analysis/prepare/ready.hpp"
#include "analysis/sweep/fe_sweep.hpp"
#include "analysis/sweep/sweep_run.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "scene/scene_text.hpp"
#include "sliding/planes/seam.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/exact/reference_scene.hpp"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using Eigen::Index;
using Eigen::VectorXd;

using fe2d::test::sines;

constexpr double deg = std::numbers::pi / 180.0;

/// Scene D of the chain with elastic bodies, coarse. @param stiffness  on the moduli
Scene elastic_seam(double stiffness)
{
    Scene scene = exact::seam_scene();
    scene.dam.young_modulus = 25e9 * stiffness;
    scene.dam.poisson_ratio = 0.17;
    Foundation& rock = *scene.foundation;
    rock.material.young_modulus = 30e9 * stiffness;
    rock.material.poisson_ratio = 0.2;
    rock.mass = RockMass::massless;
    rock.width = 400.0;
    rock.depth = 120.0;
    scene.reservoir->model = ReservoirModel::added_mass;
    scene.damping.method = DampingMethod::none;
    scene.mesh.contact_size = 2.5;
    scene.mesh.size = 5.0;
    scene.planes.slides_on = "D";
    return scene;
}

Scene free_faced(Scene scene)
{
    scene.seams[0].wedge.reset();
    scene.seams[0].exit = SeamExit::free_face;
    return scene;
}

Ready ready_of(const Scene& scene)
{
    return prepare(scene, Method::finite_elements, Records());
}

RunResult run_of(const Scene& scene, const GroundMotion& motion)
{
    const Ready ready = ready_of(scene);
    const Watch nobody;
    return EarthquakeRun(ready.scene, ready.run_options(nobody)).run(motion);
}

GroundMotion still()
{
    GroundMotion motion;
    motion.name = "none";
    motion.dt = 0.01;
    motion.accel_h.assign(3, 0.0);
    return motion;
}

TEST(FeSeam, RowsOfThePairsHaveFullRankAndTheirLengthsAreThoseOfTheLines)
{
    const Ready ready = ready_of(elastic_seam(1.0));
    const Model model = build_model(ready.scene, {.base = Base::separate});
    const ContactPlanes planes(model.mesh);
    ASSERT_EQ(planes.count(), 3); // the path, the base, the interface up from the bend
    const Index m = planes.pairs();
    const Eigen::MatrixXd d = planes.gaps();
    EXPECT_LT((d * d.transpose() - Eigen::MatrixXd::Identity(2 * m, 2 * m)).cwiseAbs().maxCoeff(), 1e-15);
    // Gaps of the bodies' own displacements: a pair too many where three bodies meet would be a combination of others.
    const ContactStructure structure(model);
    const SparseMatrix rows = structure.gaps();
    const Eigen::MatrixXd products = (rows * rows.transpose()).toDense();
    EXPECT_EQ(Eigen::FullPivHouseholderQR<Eigen::MatrixXd>(products).rank(), 2 * m);
    const SeamLine& seam = *model.mesh.seam;
    ASSERT_EQ(seam.bends.size(),
              2u); // the second at the toe, where the dam is the third body: the face has no pair there
    for (const int node : seam.bends[1])
        for (const std::vector<int>* pairs : {&model.mesh.lifts[1].lower_nodes, &model.mesh.lifts[1].upper_nodes})
            EXPECT_EQ(std::count(pairs->begin(), pairs->end(), node), 0);
    for (const int node : seam.bends[0])
        for (const std::vector<int>* pairs : {&model.mesh.contact.dam_nodes, &model.mesh.contact.rock_nodes,
                                              &model.mesh.lifts[1].lower_nodes, &model.mesh.lifts[1].upper_nodes})
            EXPECT_EQ(std::count(pairs->begin(), pairs->end(), node), 0);

    const double wedge = 8.0 / std::sin(25.0 * deg);
    EXPECT_NEAR(planes.base().area.head(planes.base().main_pairs()).sum(), 45.0, 1e-9);
    EXPECT_NEAR(planes.base().length(), 45.0 + wedge, 1e-9);
    EXPECT_NEAR(planes[1].length(), 45.0, 1e-9);
    EXPECT_NEAR(planes[2].length(), 8.0, 1e-9);
    EXPECT_NEAR(planes.weights().col(0).sum(), 1.0, 1e-14);
    const MeshQuality quality = measure_quality(model.mesh);
    EXPECT_GT(quality.smallest_angle, 10.0 * deg);
}

/// The seam comes up at both ends.
Scene daylighting(Polyline path, Polyline ground)
{
    Scene scene = elastic_seam(1.0);
    Seam& seam = scene.seams[0];
    seam.depth.reset();
    seam.points = std::move(path);
    seam.heel = SeamHeel::floor;
    seam.exit = SeamExit::daylight;
    seam.wedge.reset();
    scene.foundation->ground = std::move(ground);
    scene.tailwater = Tailwater{3.0};
    return scene;
}

TEST(FeSeam, MassAndLoadsAreThoseOfTheChain)
{
    const Scene scenes[] = {elastic_seam(1.0), free_faced(elastic_seam(1.0)),
                            daylighting({{-20.0, 0.0}, {45.0, -9.0}, {75.0, 0.0}}, {}),
                            daylighting({{-20.0, 0.0}, {90.0, -12.0}}, {{90.0, -12.0}})};
    for (const Scene& scene : scenes) {
        const bool wedge = scene.seams[0].wedge.has_value();
        const Ready ready = ready_of(scene);
        const Watch nobody;
        const EarthquakeRun run(ready.scene, ready.run_options(nobody));
        const sliding::SeamModel chain =
            sliding::seam_model(scene, scene.seams[0], wedge ? std::optional(25.0 * deg) : std::nullopt);
        double mass = 0.0;
        Eigen::Vector2d force = Eigen::Vector2d::Zero();
        for (std::size_t i = 0; i < chain.chain.blocks.size(); ++i) {
            const sliding::ChainBlock& b = chain.chain.blocks[i];
            mass += b.mass;
            force += Eigen::Vector2d(chain.loads[i].x, chain.loads[i].y) +
                     b.uplift * Eigen::Vector2d(std::sin(b.dip), std::cos(b.dip));
        }
        EXPECT_NEAR(run.structure().dam_inertia_x().sum(), mass, 1e-9 * mass);
        const double water = chain.chain.blocks[chain.chain.dam].added_mass.xx;
        EXPECT_NEAR(run.structure().inertia_x().sum() - mass, water, 1e-5 * water);
        const VectorXd load = run.structure().split(run.stages().last()).dam;
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        for (Index i = 0; i < load.size(); i += 2) sum += load.segment<2>(i);
        EXPECT_NEAR(sum[0], force[0], 1e-9 * force.norm());
        EXPECT_NEAR(sum[1], force[1], 1e-9 * force.norm());
    }
}

/// The scene with all strengths over F.
Scene reduced(Scene scene, double factor)
{
    Seam& seam = scene.seams[0];
    seam.strength.friction /= factor;
    if (seam.wedge) seam.wedge->friction /= factor;
    seam.interface.friction /= factor;
    return scene;
}

/// Largest F at which the static stages end in equilibrium, and the run there.
std::pair<double, RunResult> largest_factor(const Scene& scene, double low, double high)
{
    RunResult last;
    while (high - low > 1e-5) {
        const double middle = 0.5 * (low + high);
        RunResult now = run_of(reduced(scene, middle), still());
        const bool stands = !now.stages.empty() && now.stages.back().status == StageStatus::ok;
        (stands ? low : high) = middle;
        if (stands) last = std::move(now);
    }
    return {low, std::move(last)};
}

TEST(FeSeam, StrengthReductionFindsTheFactorAndTheForcesOfTheChain)
{
    Scene scene = elastic_seam(1.0);
    const sliding::Chain chain = sliding::seam_model(scene, scene.seams[0], 25.0 * deg).chain;
    const double factor = sliding::chain_factor(chain);
    EXPECT_NEAR(factor, 1.240163734, 1e-8);
    const auto [found, run] = largest_factor(scene, 1.2, 1.27);
    EXPECT_NEAR(found, factor, 2e-5);
    const sliding::ChainForces forces =
        sliding::chain_forces(chain, sliding::chain_law(chain, found), 0.0, 0.0, 0.0, found);
    const StageResult& end = run.stages.back();
    EXPECT_NEAR(end.resultant.normal_force, forces.normal[0], 1e-4 * forces.normal[0]);
    EXPECT_NEAR(end.resultant.shear_force, forces.resistance[0], 1e-4 * forces.resistance[0]);
    ASSERT_EQ(end.lifts.size(), 2u);
    EXPECT_NEAR(end.lifts[1].resultant.normal_force, forces.thrust[0], 2e-3 * forces.thrust[0]);

    // With friction in the interface between the wedge method's and Sarma's.
    scene.seams[0].interface = {InterfaceModel::friction, std::nullopt, std::tan(20.0 * deg), 0.0};
    const double with_friction = largest_factor(scene, 1.2, 1.32).first;
    EXPECT_GT(with_friction, factor);
    EXPECT_LT(with_friction, 1.275100518 + 1e-5);
}

/// Stiff bodies that nothing damps: with moduli × 1e4 the slip of scene D would be 0.14 % larger.
Scene stiff_seam(double dip)
{
    Scene scene = elastic_seam(1e5);
    scene.time.slip_tolerance = 0.003;
    scene.contact.friction = 3.0; // the base holds
    scene.seams[0].dip = dip;
    return scene;
}

sliding::SlideResult chain_slide(const Scene& scene, const GroundMotion& motion)
{
    sliding::SlideOptions options;
    options.sliding.two_way = false;
    return sliding::slide(motion, sliding::seam_plane(scene, scene.seams[0], {}).stages, options);
}

GroundMotion with_other_polarity(GroundMotion motion)
{
    for (double& a : motion.accel_h) a = -a;
    return motion;
}

TEST(FeSeam, StiffUndampedBodiesSlideAsTheChainWithinTheStepsError)
{
    const GroundMotion motion = sines(2.0, 8.0);
    for (const bool wedge : {true, false})
        for (const double dip : {0.0, 2.0 * deg}) {
            Scene scene = stiff_seam(dip);
            if (!wedge) scene = free_faced(scene);
            const Ready ready = ready_of(scene);
            const Watch nobody;
            const EarthquakeRun model(ready.scene, ready.run_options(nobody));
            for (const GroundMotion& m : {motion, with_other_polarity(motion)}) {
                SCOPED_TRACE(::testing::Message() << (wedge ? "wedge" : "free face") << ", dip " << dip / deg
                                                  << (m.accel_h == motion.accel_h ? ", as is" : ", flipped"));
                const double chain = chain_slide(scene, m).max_slip;
                ASSERT_GT(chain, 2e-3);
                const RunResult run = model.run(m);
                ASSERT_EQ(run.status, Status::at_rest) << text_of(run.notes);
                EXPECT_NEAR(run.max_slip, chain, run.slip_error + 1e-3 * chain);
                EXPECT_LT(run.energy_error, 1e-9);
                EXPECT_EQ(run.counts.unresolved, 0);
                if (!wedge) continue;
                // Both blocks go the same way across their upright face, so it slips by what the wedge's plane rises.
                const double rise = run.slip * (std::tan(25.0 * deg) - std::tan(-dip));
                EXPECT_NEAR(std::abs(run.lifts[1].slip), rise, 0.02 * rise);
            }
        }
}

TEST(FeSeam, ElasticBodiesOnRadiatingRockCloseTheirEnergy)
{
    Scene scene = elastic_seam(1.0);
    scene.foundation->mass = RockMass::with_mass;
    scene.foundation->boundary = RockBoundary::absorbing;
    scene.damping = {};
    scene.time.substeps = 1;
    const GroundMotion motion = sines(2.0, 6.0);
    const RunResult run = run_of(scene, motion);
    ASSERT_EQ(run.status, Status::at_rest) << text_of(run.notes);
    EXPECT_GT(run.max_slip, 1e-3);
    EXPECT_LT(run.energy_error, 1e-9);
    EXPECT_EQ(run.counts.unresolved, 0);
    ASSERT_EQ(run.stages.size(), 3u); // gravity, water, uplift
    for (const StageResult& stage : run.stages) EXPECT_EQ(stage.status, StageStatus::ok) << text_of(stage.notes());
}

/// Rock under its own weight between fixed sides, far from the crack: σ_xx = k0 σ_yy.
TEST(FeSeam, RockStartsWithTheHorizontalStressOfItsK0)
{
    const auto thrust = [](const Scene& scene) { // between the rock below the dam and the wedge, under gravity
        return run_of(scene, still()).stages.front().lifts[1].resultant.normal_force;
    };
    Scene scene = elastic_seam(1.0);
    scene.foundation->width = 1600.0;
    const double elastic = 0.2 / 0.8, by_weight = thrust(scene), unit = 2650.0 * 9.81;
    scene.foundation->k0 = elastic;
    EXPECT_NEAR(thrust(scene), by_weight, 1e-9 * by_weight);
    double before = by_weight;
    for (const double k0 : {0.6, 1.5}) {
        scene.foundation->k0 = k0;
        const Ready ready = ready_of(scene);
        const Watch nobody;
        const EarthquakeRun run(ready.scene, ready.run_options(nobody));
        const RunResult result = run.run(still());
        ASSERT_GT(result.zero_displacement.size(), 0);
        const Mesh& mesh = run.model().mesh;
        const StressField stress = stress_field(run.model(), result.zero_displacement);
        int far = 0;
        for (int e = 0; e < mesh.element_count(); ++e) {
            Point centre;
            const Element& element = mesh.elements[static_cast<std::size_t>(e)];
            for (const int node : element.all()) {
                centre.x += mesh.nodes[static_cast<std::size_t>(node)].x / element.size();
                centre.y += mesh.nodes[static_cast<std::size_t>(node)].y / element.size();
            }
            if (element.region == Region::dam || std::abs(centre.x) < 500.0) continue;
            ++far;
            EXPECT_NEAR(stress.centre(1, e), unit * centre.y, 0.002 * unit * 120.0);
            EXPECT_NEAR(stress.centre(0, e), k0 * unit * centre.y, 0.002 * k0 * unit * 120.0);
        }
        EXPECT_GT(far, 100);
        // Across 8 m of an upright face, as far as the wedge can carry it on its plane.
        const double now = thrust(scene);
        EXPECT_GT(now, before + 0.5 * (k0 == 0.6 ? 0.35 : 0.9) * 0.5 * unit * 64.0);
        before = now;
    }
}

TEST(FeSeam, TiedModelOfItIsThatOfTheUncutRock)
{
    // The lines share their unknowns: as stiff as one body but for the open crack.
    const Ready ready = ready_of(elastic_seam(1.0));
    const Model tied = build_model(ready.scene), free = build_model(ready.scene, {.base = Base::separate});
    const Mesh& mesh = tied.mesh;
    const auto pairs = static_cast<int>(mesh.contact.dam_nodes.size() + mesh.lifts[0].upper_nodes.size() +
                                        mesh.lifts[1].upper_nodes.size());
    EXPECT_EQ(free.dofs.count - tied.dofs.count,
              2 * (pairs + 3)); // and two of three at the bend, one of two at the toe
}

TEST(FeSeam, SaysWhatFiniteElementsDoNotFollow)
{
    const auto message = [](const Scene& scene) -> std::string {
        try {
            ready_of(scene);
        } catch (const InputError& error) {
            const Diagnostic& d = error.diagnostics().front();
            return d.problem + " | " + d.expected + " | " + d.fix;
        }
        return {};
    };
    Scene scene = elastic_seam(1.0);
    scene.planes.slides_on = "E";
    EXPECT_EQ(message(scene),
              "no seam is named \"E\". | seams: D; lifts slide beside the base without --plane | write  --plane \"D\"");
    scene = elastic_seam(1.0);
    scene.seams[0].interface.angle = 70.0 * deg;
    EXPECT_EQ(message(scene), "seam[1] \"D\" by finite elements (--plane): interface.angle_deg is not 90. | upright interfaces | "
                              "write  angle_deg = 90  in [seam.interface], or use  damslip screen");
    scene = elastic_seam(1.0);
    scene.seams[0].dilation = 5.0 * deg;
    EXPECT_NE(message(scene).find("dilates"), std::string::npos);
    scene = elastic_seam(1.0);
    scene.mesh.element = ElementKind::q8;
    EXPECT_NE(message(scene).find("quadratic"), std::string::npos);
    // A wedge of one given angle that water carries without an earthquake; with a search the body is alone.
    scene = elastic_seam(1.0);
    scene.seams[0].uplift = UpliftModel::linear;
    EXPECT_NE(message(scene).find("does not stand without an earthquake. It weighs "), std::string::npos) << message(scene);
    scene.seams[0].wedge->angles.clear();
    EXPECT_EQ(message(scene), "");
}

/// A row of a sweep on a seam is the run of the scene with that friction and no other; the base in the same sweep is a scene without
/// `--plane`.
TEST(FeSeam, RowsOfASweepAreTheRunsOfTheirScenes)
{
    Scene scene = elastic_seam(1.0);
    scene.planes.slides_on.clear();
    scene.damping = {};
    scene.time.substeps = 1;
    const GroundMotion shaken = sines(4.0, 3.0);
    RecordPair pair;
    pair.files.name = "sines";
    pair.horizontal.dt = shaken.dt;
    pair.horizontal.acceleration = shaken.accel_h;
    Axes axes = axes_of(scene);
    axes.polarity = {1};
    axes.plane = {"", "D"};
    axes.friction = {1.0, 1.1};
    axes.method = {sweep_method("fe")};
    Sweep sweep{scene, axes, {}, std::make_shared<const std::vector<RecordPair>>(1, pair)};
    sweep.tasks = make_tasks(axes, 1);
    Watch nobody;
    check_fe_scenes(sweep);
    const SweepOutcome outcome = run_sweep(sweep, nobody);
    ASSERT_EQ(outcome.rows.size(), 4u);
    std::vector<double> slips;
    for (const FinishedRow& row : outcome.rows) {
        const GridIndex at = sweep.tasks.index(row.id);
        Scene here = scene;
        here.planes.slides_on = axes.plane[at.plane];
        set_friction(here, axes.friction[at.friction]);
        const RunResult run = run_of(here, ground_motion(scene, pair, 1.0, 1));
        ASSERT_EQ(run.status, Status::at_rest);
        EXPECT_EQ(row.results.slip, run.slip);
        slips.push_back(run.slip);
    }
    std::sort(slips.begin(), slips.end());
    EXPECT_EQ(std::adjacent_find(slips.begin(), slips.end()), slips.end()); // four different answers

    axes.friction = {scene.contact.friction};
    axes.plane_friction = {scene.contact.friction, 0.9};
    sweep = Sweep{scene, axes, make_tasks(axes, 1), sweep.records};
    const SweepOutcome own = run_sweep(sweep, nobody);
    Scene here = scene;
    here.planes.slides_on = "D";
    set_friction(here, 0.9);
    EXPECT_EQ(own.rows.back().results.slip, run_of(here, ground_motion(scene, pair, 1.0, 1)).slip);
}

/// Its rock moves in blocks of its own: the modes of the dam are not enough, nor do they correct its steps.
TEST(FeSeam, IsNotReduced)
{
    const Ready ready = ready_of(elastic_seam(1.0));
    const Watch nobody;
    const RunOptions options = ready.run_options(nobody);
    EXPECT_FALSE(options.corrector);
    const EarthquakeRun run(ready.scene, options);
    EXPECT_THROW(ReducedRun(run, ready.scene, options), InputError);
}

} // namespace
