// Lifts that wake, and what is said of cracks that the model does not have.
#include "analysis/ablation/ablation.hpp"
#include "analysis/fe/contact_runs.hpp"
#include "analysis/fe/traced_cracks.hpp"
#include "analysis/fe/variants.hpp"
#include "core/input_error.hpp"
#include "fe2d/assembly/assemble.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/mesh/faces.hpp"
#include "fe2d/run/earthquake_pass.hpp"
#include "fe2d/run/step_parts.hpp"
#include "pages/fe/fe_pages.hpp"
#include "scene/read.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace {

using namespace damslip;

/// A dam of 30 m with lifts every 6 m, on records that are there. Elements are short for the bond of every joint, so that a
/// lift has the same mesh asleep and awake.
std::string dam_text(const std::string& active, const std::string& more = {}, const std::string& pga = "4")
{
    const std::string data = std::string(source_dir()) + "/records/data/";
    return "[section]\nheight_m = 30\nbase_m = 24\ncrest_m = 5\nneck_m = 5\n"
           "[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa = 20\n"
           "[contact]\nfriction = 1\n"
           "[reservoir]\nlevel_m = 27\nmodel = \"added-mass\"\n[uplift]\nmodel = \"none\"\n"
           "[mesh]\nsize_m = 2.5\ncontact_size_m = 2\n"
           "[time]\nsubsteps = 0\n"
           "[lifts]\nspacing_m = 6\nbond = \"bonded\"\nfriction = 0.8\ncohesion_kPa = 800\ntensile_strength_kPa = 500\n"
           "fracture_energy_tension_N_m = 150\nfracture_energy_shear_N_m = 1500\nactive = \"" +
           active +
           "\"\n"
           "[motion]\nscale_to_pga_m_s2 = " + pga + "\n"
           "[[motion.record]]\nname = \"a\"\nhorizontal = \"" +
           data + "ec8_3.0_h.csv\"\nvertical = \"" + data +
           "ec8_3.0_v.csv\"\n"
           "[[motion.record]]\nname = \"b\"\nhorizontal = \"" +
           data + "rock_1.0_h.csv\"\nvertical = \"" + data + "rock_1.0_v.csv\"\n" + more;
}

Ready ready_of(const std::string& text)
{
    return prepare(parse_scene(text, "dam.toml"), Method::finite_elements, {.joints_of_lifts = true});
}

std::vector<ContactRun> runs_of(const Ready& ready, Ready* at_end = nullptr)
{
    Watch nobody;
    FeOptions options;
    options.mesh_error = false;
    ContactRuns all(ready, options, nobody);
    if (at_end) *at_end = all.ready();
    return all.run();
}

TEST(AdaptiveLifts, GiveTheHistoriesOfAllLiftsActiveFromTheStart)
{
    const std::vector<ContactRun> all = runs_of(ready_of(dam_text("all", {}, "2.5")));
    Ready woken;
    const std::vector<ContactRun> adaptive = runs_of(ready_of(dam_text("adaptive", {}, "2.5")), &woken);
    ASSERT_EQ(adaptive.size(), 4u);
    ASSERT_EQ(all.size(), 4u);
    EXPECT_EQ(all.front().fe.lifts.size(), 4u);
    ASSERT_FALSE(woken.scene.lift_joints.empty()); // some crack
    ASSERT_FALSE(woken.scene.tied_lifts.empty());  // and some do not
    for (std::size_t i = 0; i < 4; ++i) {
        const fe2d::RunResult &a = all[i].fe, &b = adaptive[i].fe;
        ASSERT_EQ(a.status, b.status);
        ASSERT_EQ(a.history.time.size(), b.history.time.size());
        EXPECT_LT(fe2d::largest_difference(a.history.slip, b.history.slip), 1e-9);
        EXPECT_LT(fe2d::largest_difference(a.history.crest_x, b.history.crest_x), 1e-9);
        EXPECT_LT(b.energy_error, 1e-9);
        ASSERT_EQ(b.lifts.size(), woken.scene.lift_joints.size());
        for (const fe2d::LiftResult& lift : a.lifts) {
            const auto same = std::find_if(b.lifts.begin(), b.lifts.end(),
                                           [&](const fe2d::LiftResult& other) { return other.name == lift.name; });
            if (same == b.lifts.end()) { // it slept: as a joint it has not moved
                EXPECT_LT(lift.largest_slip, 1e-12) << lift.name;
                EXPECT_LT(lift.largest_opening, 1e-12) << lift.name;
            } else {
                EXPECT_NEAR(lift.slip, same->slip, 1e-9) << lift.name;
                EXPECT_NEAR(lift.largest_opening, same->largest_opening, 1e-9) << lift.name;
            }
        }
        for (const fe2d::TiedLift& lift : b.cracks.lifts) EXPECT_LT(lift.index, fe2d::wake_index) << lift.name;
    }
    // A lift that would slide with full head in its crack is named.
    std::vector<ContactRun> wet = all;
    const auto headline = [&] { return pages::fe_headline(ready_of(dam_text("all")).scene, wet).sentence; };
    EXPECT_EQ(headline().find("full head"), std::string::npos) << headline();
    wet.front().fe.lifts[1].cut_factor = 0.83;
    EXPECT_NE(headline().find("lift joint at 12 m does not stand with full head in its crack after the earthquake, sliding factor 0.83."),
              std::string::npos)
        << headline();
    // Something must have broken, or this compares dams of one piece.
    EXPECT_TRUE(std::any_of(adaptive.begin(), adaptive.end(), [](const ContactRun& r) {
        return r.fe.history.energy.back().bond_fracture > 1.0;
    }));
}

/// In motion strengths and energies are `dynamic_increase` times those at rest: nothing breaks at rest here, so the histories are those of
/// a bond that has as much from the start. The elements are the same, G/f² of the earthquake counts.
TEST(DynamicIncrease, IsABondThatMuchStronger)
{
    const auto run_of = [](const std::string& bond) {
        std::string text = dam_text("all", {}, "3.5");
        text.erase(text.rfind("[[motion.record]]"));
        const std::size_t at = text.find("cohesion_kPa"), end = text.find("active");
        text.replace(at, end - at, bond);
        text.replace(text.find("[motion]\n"), 9, "[motion]\npolarity = 1\n");
        return runs_of(ready_of(text)).front().fe;
    };
    const std::string at_rest = "cohesion_kPa = 800\ntensile_strength_kPa = 500\nfracture_energy_tension_N_m = 150\n"
                                "fracture_energy_shear_N_m = 1500\n";
    const fe2d::RunResult increased = run_of(at_rest + "dynamic_increase = 1.2\n"), plain = run_of(at_rest),
                          strong = run_of("cohesion_kPa = 960\ntensile_strength_kPa = 600\n"
                                          "fracture_energy_tension_N_m = 180\nfracture_energy_shear_N_m = 1800\n");
    ASSERT_EQ(increased.status, strong.status);
    EXPECT_LT(fe2d::largest_difference(increased.history.slip, strong.history.slip), 1e-9);
    EXPECT_LT(fe2d::largest_difference(increased.history.crest_x, strong.history.crest_x), 1e-9);
    EXPECT_GT(strong.history.energy.back().bond_fracture, 1.0); // it cracks, and so otherwise than with its strength at rest
    EXPECT_NEAR(increased.history.energy.back().bond_fracture, strong.history.energy.back().bond_fracture, 1e-6);
    EXPECT_GT(fe2d::largest_difference(plain.history.crest_x, strong.history.crest_x), 1e-6);
    EXPECT_LT(increased.energy_error, 1e-9);
}

/// A step with lift joints on a rigid base keeps A_d Δu = b + k s + Dᵀ λ̃ and has the gaps asked for, whatever they are.
TEST(AwakeLifts, StepsKeepTheEquationOfMotion)
{
    const fe2d::EarthquakeRun model(ready_of(dam_text("all")).scene, {});
    const fe2d::ContactStructure& s = model.structure();
    ASSERT_EQ(s.planes().count(), 5);
    ASSERT_FALSE(s.has_rock());
    const Eigen::Index m = s.pairs(), n = s.dam_unknowns();
    for (const MassDamping mass : {MassDamping::deformation_only, MassDamping::relative}) {
        const fe2d::RunDamping damping{{2.0, 1e-3}, mass};
        const fe2d::Scheme scheme = fe2d::hht(-0.1);
        fe2d::StepOperators operators(s, damping, scheme);
        const fe2d::DynamicOperator& op = operators.at(0.01);
        const fe2d::StepConstants& c = op.constants();
        const double w = 1.0 + scheme.alpha;
        const Eigen::VectorXd b = 1e6 * Eigen::VectorXd::LinSpaced(n, -1.0, 1.0).array().sin().matrix(),
                              known = 1e5 * Eigen::VectorXd::LinSpaced(2 * m, 0.0, 9.0).array().cos().matrix(),
                              gap = 1e-3 * Eigen::VectorXd::LinSpaced(2 * m, 0.0, 30.0).array().sin().matrix();
        fe2d::DynamicOperator::Free free;
        free.dam = b;
        op.factor().forward(free.dam);
        Eigen::VectorXd force, tilde;
        op.solve_free(free, {});
        op.stuck_force(op.contact(), free, known, force);
        force += *op.contact().stiffness * gap;
        op.finish(free, force, known, gap, tilde);
        op.factor().backward(free.dam);
        const Eigen::VectorXd& u = free.dam;

        const fe2d::SlipDamping& slips = operators.slip_damping();
        Eigen::VectorXd left = c.a0 * (s.mass() * u) + (w * c.a1 * damping.constants.mass) * (s.dam_mass() * u) +
                               (w * (1.0 + c.a1 * damping.constants.stiffness)) * (s.stiffness() * u) - b;
        tilde = w * force - known;
        EXPECT_EQ(slips.active(), mass == MassDamping::deformation_only);
        if (slips.active()) {
            const Eigen::VectorXd slip = slips.weights.transpose() * gap.tail(m);
            const Eigen::VectorXd drag = slips.drag * slip - slips.momentum.transpose() * u;
            tilde.tail(m) -= w * c.a1 * (slips.weights * drag);
            left -= w * c.a1 * (slips.momentum * slip);
        }
        left -= s.gaps().transpose() * tilde;
        EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-9 * tilde.cwiseAbs().maxCoeff());
        EXPECT_LT((s.gaps() * u - gap).cwiseAbs().maxCoeff(), 1e-12);
    }
}

TEST(AdaptiveLifts, AreNotInTheMeshWithNone)
{
    const Ready none = ready_of(dam_text("none")), adaptive = ready_of(dam_text("adaptive"));
    EXPECT_TRUE(none.scene.lift_joints.empty());
    EXPECT_TRUE(none.scene.tied_lifts.empty());
    EXPECT_EQ(adaptive.scene.tied_lifts.size(), 4u);
    const fe2d::Mesh mesh = fe2d::build_mesh(adaptive.scene);
    ASSERT_EQ(mesh.tied_lifts.size(), 4u);
    EXPECT_TRUE(mesh.lifts.empty());
    for (std::size_t k = 0; k < 4; ++k)
        for (const int n : mesh.tied_lifts[k].lower_nodes)
            EXPECT_NEAR(mesh.nodes[static_cast<std::size_t>(n)].y, 6.0 * static_cast<double>(k + 1), 1e-9);
}

TEST(AdaptiveLifts, WithoutFractureEnergiesAreRefused)
{
    std::string text = dam_text("adaptive");
    text.erase(text.find("fracture_energy_tension"), std::string("fracture_energy_tension_N_m = 150\n").size());
    try {
        ready_of(text);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("fracture_energy_tension_N_m = 200"), std::string::npos) << error.what();
    }
}

/// A column of even elements under its weight and a force at its top: the forces at a lift are those of statics.
TEST(TiedLifts, IndexIsThatOfTheResultants)
{
    const std::string text = "[section]\npolygon_m = [[0, 0], [10, 0], [10, 20], [0, 20]]\n"
                             "[dam]\ndensity_kg_m3 = 2000\nyoung_modulus_GPa = 20\n"
                             "[contact]\nfriction = 2\n[mesh]\nsize_m = 1\ncontact_size_m = 1\n[time]\nsubsteps = 0\n"
                             "[lifts]\nelevations_m = [10]\nfriction = 0.6\n"
                             "[[force]]\nforce_x_kN_m = 100\ny_m = 20\n";
    Scene scene = ready_of(text).scene;
    ASSERT_EQ(scene.tied_lifts.size(), 1u);
    scene.tied_lifts[0].strength.cohesion = 30e3; // lost together: the index of the whole line
    const fe2d::EarthquakeRun model(scene, {});
    GroundMotion still;
    still.dt = 0.01;
    still.accel_h.assign(3, 0.0);
    const fe2d::RunResult run = model.run(still);
    ASSERT_EQ(run.cracks.lifts.size(), 1u);
    const double weight = 2000.0 * 9.81 * 10.0 * 10.0;
    EXPECT_NEAR(run.cracks.lifts[0].index, 100e3 / (0.6 * weight + 30e3 * 10.0), 1e-6);
}

/// A column on a bond that holds: the largest centre stress off its base, and about that of a beam.
TEST(Cracks, LargestTensionIsThatOfTheElements)
{
    const std::string text = "[section]\npolygon_m = [[0, 0], [10, 0], [10, 20], [0, 20]]\n"
                             "[dam]\ndensity_kg_m3 = 2000\nyoung_modulus_GPa = 20\npoisson_ratio = 0\n"
                             "[contact]\nfriction = 2\ncohesion_kPa = 3000\ntensile_strength_kPa = 3000\n"
                             "fracture_energy_tension_N_m = 5000\nfracture_energy_shear_N_m = 5000\n"
                             "[mesh]\nsize_m = 1\ncontact_size_m = 1\n[time]\nsubsteps = 0\n"
                             "[[force]]\nforce_x_kN_m = 800\ny_m = 20\n";
    const fe2d::EarthquakeRun model(ready_of(text).scene, {});
    GroundMotion still;
    still.dt = 0.01;
    still.accel_h.assign(3, 0.0);
    const fe2d::RunResult run = model.run(still);
    const fe2d::CrackFigures& cracks = run.cracks;
    ASSERT_TRUE(cracks.known);
    const fe2d::Mesh& mesh = model.model().mesh;
    const Eigen::VectorXd nodal = fe2d::nodal_values(model.model().dofs, run.displacement);
    double largest = 0.0;
    for (const fe2d::Element& element : mesh.elements) {
        const fe2d::Corners c = fe2d::corners(mesh, element);
        if (std::min({c[0].y, c[1].y, c[2].y}) < 0.5) continue;
        fe2d::ElementVector u(8);
        for (int i = 0; i < 4; ++i) u.segment<2>(2 * i) = nodal.segment<2>(2 * element.nodes[static_cast<std::size_t>(i)]);
        const Eigen::Vector3d stress =
            fe2d::centre_stress(c, 4, fe2d::plane_strain_matrix(model.model().materials.dam), model.model().materials.kind, u);
        largest = std::max(largest, 0.5 * (stress[0] + stress[1]) + std::hypot(0.5 * (stress[0] - stress[1]), stress[2]));
    }
    EXPECT_NEAR(cracks.stress, largest, 1e-9 * largest);
    EXPECT_NEAR(cracks.at.x, 0.5, 1e-9);
    EXPECT_NEAR(cracks.at.y, 1.5, 1e-9);
    const double bending = 800e3 * 18.5 * 4.5 / (1000.0 / 12.0), weight = 2000.0 * 9.81 * 18.5;
    const double shear = 1.5 * 800e3 / 10.0 * (1.0 - 0.81); // parabola at 4.5 m of 5 m
    const double yy = bending - weight;
    EXPECT_NEAR(cracks.stress, 0.5 * yy + std::hypot(0.5 * yy, shear), 0.06 * yy); // the base holds the ends of the beam
}

/// Koyna's section at 0.47 g, one polarity. @param dam  keys of [dam] @param tables  more of them
std::string koyna_text(const std::string& dam, const std::string& tables)
{
    const std::string data = std::string(source_dir()) + "/records/data/ec8_3.0_";
    return "[section]\npolygon_m = [[0, 0], [70, 0], [19.25, 66.5], [14.8, 103], [0, 103]]\n"
           "[dam]\ndensity_kg_m3 = 2643\nyoung_modulus_GPa = 31\n" + dam +
           "[contact]\nfriction = 1\n[reservoir]\nlevel_m = 90.5\nmodel = \"added-mass\"\n[uplift]\nmodel = \"none\"\n" +
           tables + "[time]\nsubsteps = 0\n[motion]\nscale_to_pga_m_s2 = 4.61\npolarity = 1\n"
           "[[motion.record]]\nname = \"a\"\nhorizontal = \"" + data + "h.csv\"\nvertical = \"" + data + "v.csv\"\n";
}

/// Koyna's neck at 0.47 g: it cracks from face to face, within a fifth of a second, and the top stands; on two meshes.
TEST(Cracks, CutTheNeckOfKoynaOnTwoMeshes)
{
    const auto run_on = [](const std::string& size, const std::string& softening = "linear") {
        const Ready ready = ready_of(koyna_text(
            "", "[lifts]\nelevations_m = [66]\nbond = \"bonded\"\nfriction = 1\ncohesion_kPa = 3120\n"
                "tensile_strength_kPa = 2400\nfracture_energy_tension_N_m = 200\nfracture_energy_shear_N_m = 1000\n"
                "softening = \"" + softening + "\"\nuplift = \"none\"\n[mesh]\nsize_m = " + size + "\n"));
        return std::move(runs_of(ready).front().fe);
    };
    const auto first = [](const fe2d::RunResult& run, double length) {
        const std::vector<double>& broken = run.history.lifts.front().broken;
        const auto at = std::find_if(broken.begin(), broken.end(), [&](double x) { return x > 0.0 && x >= length; });
        return run.history.time[static_cast<std::size_t>(at - broken.begin())];
    };
    const fe2d::RunResult coarse = run_on("3"), fine = run_on("1.6"), curved = run_on("3", "exponential");
    for (const fe2d::RunResult* run : {&coarse, &fine, &curved}) {
        ASSERT_EQ(run->status, Status::at_rest) << text_of(run->notes);
        EXPECT_EQ(run->counts.unresolved, 0);
        EXPECT_LT(run->energy_error, 1e-9);
        ASSERT_EQ(run->lifts.size(), 1u);
        const fe2d::LiftResult& neck = run->lifts.front();
        EXPECT_GT(neck.bond.bonded, 19.0);
        ASSERT_NEAR(neck.bond.broken, neck.bond.bonded, 1e-9); // cut
        EXPECT_LT(neck.largest_rocking, 0.02);                  // of the top: it rocks and stands
        EXPECT_EQ(run->after.status, fe2d::StageStatus::ok);
        EXPECT_LT(first(*run, neck.bond.bonded - 1e-9) - first(*run, 0.0), 0.2);
        // The top by hand: its weight less the head of 24.5 m below all of it, against the water before it.
        EXPECT_EQ(neck.bond.ligament(), 0.0);
        EXPECT_EQ(neck.dip, 0.0);
        const double width = 19.25 + (70.0 - 19.25) * 0.5 / 66.5, head = 90.5 - 66.0;
        const double weight = 2643.0 * 9.81 * (0.5 * (14.8 + 19.25) * 36.5 + 0.5 * (19.25 + width) * 0.5);
        const double factor = (weight - 9810.0 * head * width) / (0.5 * 9810.0 * head * head);
        EXPECT_NEAR(neck.cut_factor, factor, 1e-6 * factor);
    }
    const double depth = fine.lifts.front().bond.damaged;
    EXPECT_NEAR(coarse.lifts.front().bond.damaged, depth, 0.15 * depth);
    EXPECT_NEAR(first(coarse, 0.0), first(fine, 0.0), 0.02);
}

const char* column = "[section]\npolygon_m = [[0, 0], [10, 0], [10, 20], [0, 20]]\n"
                     "[dam]\ndensity_kg_m3 = 2000\nyoung_modulus_GPa = 20\n[contact]\nfriction = 2\n"
                     "[mesh]\nsize_m = 1\ncontact_size_m = 1\n[time]\nsubsteps = 0\n";

/// A line from face to face that bends: its nodes lie on it, rows bend with it, and no concrete is lost.
TEST(TracedCracks, BendTheRowsOfTheMesh)
{
    Scene scene = ready_of(column).scene;
    const Polyline path{{0.0, 12.0}, {4.0, 11.0}, {7.0, 8.0}, {10.0, 7.5}};
    scene.lift_joints.push_back({"crack 1", 12.0, {}, {}, {}, path});
    const fe2d::EarthquakeRun model(scene, {});
    const fe2d::Mesh& mesh = model.model().mesh;
    ASSERT_EQ(mesh.lifts.size(), 1u);
    double length = 0.0;
    const std::vector<int>& nodes = mesh.lifts[0].lower_nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Point at = mesh.nodes[static_cast<std::size_t>(nodes[i])];
        EXPECT_NEAR(at.y, fe2d::height_on(path, at.x), 1e-12);
        if (i > 0) {
            const Point before = mesh.nodes[static_cast<std::size_t>(nodes[i - 1])];
            length += std::hypot(at.x - before.x, at.y - before.y);
        }
    }
    const fe2d::Plane& plane = model.structure().planes()[1];
    EXPECT_NEAR(plane.area.sum(), length, 1e-12 * length);
    for (Eigen::Index i = 0; i < plane.pairs(); ++i) {
        EXPECT_NEAR(plane.normal_of(i).dot(plane.tangent_of(i)), 0.0, 1e-15);
        EXPECT_GT(plane.normal_of(i).y(), 0.5);
    }
    EXPECT_NEAR(model.model().total_mass.x(), 2000.0 * 200.0, 1e-6);
}

/// A cut that falls downstream holds what is above it with the tangent of its dip, no less.
TEST(TracedCracks, ASlopingCutNeedsTheTangentOfItsDip)
{
    Scene scene = ready_of(column).scene;
    GroundMotion still;
    still.dt = 0.01;
    still.accel_h.assign(3, 0.0);
    for (const double friction : {0.39, 0.41}) {
        scene.lift_joints = {{"crack 1", 12.0, {}, {}, {}, Polyline{{0.0, 12.0}, {10.0, 8.0}}}};
        scene.lift_joints.front().strength.friction = friction;
        const fe2d::RunResult run = fe2d::EarthquakeRun(scene, {}).run(still);
        ASSERT_FALSE(run.stages.empty());
        ASSERT_EQ(run.stages.back().lifts.size(), 1u);
        EXPECT_NEAR(run.stages.back().lifts.front().critical_friction, 0.4, 1e-9);
        EXPECT_EQ(run.stages.back().status, friction < 0.4 ? fe2d::StageStatus::slides : fe2d::StageStatus::ok);
    }
}

/// Koyna's section without lifts: a crack begins at the bend of the downstream face and one on the upstream face; they find their
/// paths, meet and cut the neck.
TEST(TracedCracks, FindTheirPathThroughTheNeckOfKoyna)
{
    const Ready ready = ready_of(
        koyna_text("tensile_strength_MPa = 2.4\ncrack = \"traced\"\n", "[sliding]\nrun_out_max_s = 0\n"));
    GroundMotion motion = ready.motions(ready.records().front(), 1).front();
    motion.accel_h.resize(240); // it is cut by then
    motion.accel_v.resize(240);
    Watch nobody;
    fe2d::RunOptions options = ready.run_options(nobody);
    options.ends_when_lifts_wake = true;
    Scene scene = ready.scene;
    std::vector<TracedCrack> cracks;
    fe2d::RunResult run;
    for (bool more = true; more && cracks.size() < 2;) {
        options.crack_starts = starts_of(scene, cracks);
        run = fe2d::EarthquakeRun(scene, options).run(motion);
        EXPECT_EQ(run.counts.unresolved, 0);
        EXPECT_LT(run.energy_error, 1e-9);
        more = draw_paths_anew(scene, {&run}, cracks);
        if (!more && run.cracks.cracks()) {
            scene = with_traced_crack(scene, run, cracks);
            more = true;
        }
    }
    ASSERT_EQ(cracks.size(), 1u);
    const TracedCrack& neck = cracks.front();
    EXPECT_TRUE(neck.settled) << neck.passes << " passes, moved by " << neck.change;
    EXPECT_LT(neck.change, 0.3);
    EXPECT_FALSE(neck.from_upstream);
    EXPECT_NEAR(neck.start, 66.0, 1.5); // the bend is at 66.5 m
    ASSERT_TRUE(neck.other.has_value());
    EXPECT_NEAR(*neck.other, 60.0, 3.0);
    ASSERT_EQ(run.lifts.size(), 1u);
    EXPECT_NEAR(run.lifts.front().bond.broken, run.lifts.front().bond.bonded, 1e-9); // cut
    // Off the bend it falls into the dam at first, as a crack across the tension of a face that leans does.
    const Polyline& path = scene.lift_joints.front().path;
    EXPECT_NEAR(std::atan2(path.back().y - fe2d::height_on(path, path.back().x - 1.0), 1.0) * 180.0 / 3.14159265, 32.0, 6.0);
    EXPECT_LT(fe2d::height_on(path, 12.0), 60.5);
}

/// A path that still moves is no plain PASS, and the answer names the crack.
TEST(TracedCracks, APathThatHasNotSettledIsSaid)
{
    ContactRun run;
    run.fe.status = Status::at_rest;
    run.fe.cracks.known = true;
    run.fe.slip = run.fe.max_slip = 1e-3;
    run.fe.slip_error = 1e-5;
    Scene scene = ready_of(column).scene;
    scene.criteria.allowable_slip = 1.0;
    run.mesh.check = MeshCheck::done;
    run.mesh.base = 1e-6;
    EXPECT_EQ(pages::fe_headline(scene, {run}).verdict, "PASS");
    run.unsettled_cracks = "crack 2";
    const auto said = pages::fe_headline(scene, {run});
    EXPECT_EQ(said.verdict, "PASS, the path of a crack not settled");
    EXPECT_NE(said.sentence.find("The path of crack 2 is not settled"), std::string::npos) << said.sentence;
}

/// What traced cracks need, and what they do not go with.
TEST(TracedCracks, SayWhatTheyNeed)
{
    const auto said = [](const std::string& more) -> std::string {
        try {
            ready_of(std::string("[section]\npolygon_m = [[0, 0], [10, 0], [10, 20], [0, 20]]\n[contact]\nfriction = 2\n") +
                     "[dam]\ndensity_kg_m3 = 2000\nyoung_modulus_GPa = 20\ncrack = \"traced\"\n" + more);
        } catch (const InputError& error) {
            return error.diagnostics().front().problem + error.diagnostics().front().fix;
        }
        return "";
    };
    EXPECT_NE(said("").find("add  tensile_strength_MPa"), std::string::npos);
    EXPECT_EQ(said("tensile_strength_MPa = 2\n"), "");
    EXPECT_NE(said("tensile_strength_MPa = 2\n[time]\nscheme = \"central-difference\"\n").find("hht"), std::string::npos);
}

/// A variant of the ablation has the awake lifts of `fe`, and without its lifts another slip.
TEST(Cracks, VariantsLetLiftsWake)
{
    const Ready ready = ready_of(dam_text("adaptive", {}, "2.5"));
    Watch nobody;
    const VariantRuns variant = run_variant(ready, {}, nobody);
    const std::vector<ContactRun> runs = runs_of(ready);
    ASSERT_EQ(variant.motions.size(), runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
        EXPECT_EQ(variant.motions[i].label(), runs[i].label());
        EXPECT_EQ(variant.motions[i].slip, runs[i].fe.slip);
        EXPECT_EQ(variant.motions[i].lift_slips.size(), runs[i].fe.lifts.size());
    }
    EXPECT_FALSE(variant.motions.front().lift_slips.empty());

    const AblationPlan plan = make_ablations(ready.given, Method::finite_elements, {});
    const auto lifts = std::find_if(plan.removals.begin(), plan.removals.end(),
                                    [](const Ablation& a) { return a.effect == Effect::lift_joints; });
    ASSERT_NE(lifts, plan.removals.end());
    const AblationRuns ablated = run_ablations(plan, ready.pairs, 2, nobody);
    EXPECT_EQ(ablated.scenes.front().motions.front().slip, runs.front().fe.slip); // time.substeps: the same step
    const VariantRuns& whole = ablated.scenes[1 + static_cast<std::size_t>(lifts - plan.removals.begin())];
    EXPECT_TRUE(whole.motions.front().lift_slips.empty());
    EXPECT_NE(whole.motions.front().slip, runs.front().fe.slip);
}

/// The row "traced cracks" is that of scenes with `dam.crack`, and takes the key out.
TEST(TracedCracks, AreAnEffect)
{
    const std::string traced = "tensile_strength_MPa = 2\ncrack = \"traced\"\n";
    std::string text = dam_text("none");
    text.insert(text.find("[contact]"), traced);
    const AblationPlan plan = make_ablations(ready_of(text).given, Method::finite_elements, {});
    const auto cracks = std::find_if(plan.removals.begin(), plan.removals.end(),
                                     [](const Ablation& a) { return a.name == "traced cracks"; });
    ASSERT_NE(cracks, plan.removals.end());
    EXPECT_EQ(cracks->scene.dam.crack, BodyCrack::none);
    for (const PlannedEffect& e : make_effect_plan(ready_of(dam_text("none")).given, Method::finite_elements).effects)
        EXPECT_NE(e.name, "traced cracks");
}

/// Full head in the broken part of a lift of 10 m, 20 m below the reservoir: in a lift with water on a line the surplus falls on a
/// line from the tip to the other face, in a dry one it ends at the tip.
TEST(Cracks, HeadInALiftIsThatOfItsFace)
{
    Scene scene = parse_scene("[section]\npolygon_m = [[0, 0], [10, 0], [10, 40], [0, 40]]\n[dam]\ndensity_kg_m3 = 2400\n"
                              "[contact]\nfriction = 1\n[reservoir]\nlevel_m = 30\nmodel = \"added-mass\"\n"
                              "[tailwater]\nlevel_m = 15\n[uplift]\nmodel = \"none\"\n",
                              "dam.toml");
    LiftJoint lift;
    lift.elevation = 10.0;
    const Eigen::Index pairs = 1001;
    fe2d::Plane plane;
    plane.distance = Eigen::VectorXd::LinSpaced(pairs, 0.0, 10.0);
    plane.area = Eigen::VectorXd::Constant(pairs, 0.01);
    plane.area[0] = plane.area[pairs - 1] = 0.005;
    const double up = 9810.0 * 20.0, down = 9810.0 * 5.0;
    const auto added = [&](JointWater water, double upstream, double downstream) {
        lift.water = water;
        return fe2d::head_in_crack(scene, lift, plane, {10.0, 10.0, upstream + downstream, upstream, downstream});
    };
    EXPECT_NEAR(added(JointWater::none, 4.005, 0.0), 4.005 * up, 1e-9 * up);
    EXPECT_NEAR(added(JointWater::none, 4.005, 2.005), 4.005 * up + 2.005 * down, 1e-9 * up);
    // On a line: 4 m with `up`, then straight to `down` at the other face, less the trapezoid that was there.
    EXPECT_NEAR(added(JointWater::linear, 4.0, 0.0), 4.0 * up + 6.0 * 0.5 * (up + down) - 10.0 * 0.5 * (up + down), 0.01 * up);
    EXPECT_NEAR(added(JointWater::linear, 10.0, 10.0), 10.0 * up - 10.0 * 0.5 * (up + down), 1e-9 * up);
    EXPECT_EQ(added(JointWater::linear, 0.0, 3.0), 0.0); // from the tailwater: no less than there was
}

/// Koyna's section overtopped, E 25 GPa, f_t 1 MPa, G 200 N/m (Jirásek & Zimmermann after Saksala & Mäkinen 2020): the heel cracks first,
/// then the upstream face higher up, of six lifts at that at 60 m.
TEST(Cracks, OvertoppedKoynaCracksAtItsHeelThenHigherUpstream)
{
    // Damaged pairs of the base and of each lift, and whether they go on from the upstream face.
    const auto cracks_of = [](double water) {
        const std::string bond = "cohesion_kPa = 3000\ntensile_strength_kPa = 1000\nfracture_energy_tension_N_m = 200\n"
                                 "fracture_energy_shear_N_m = 2000\nsoftening = \"exponential\"\n";
        const Ready ready = ready_of(
            "[section]\npolygon_m = [[0, 0], [70, 0], [19.25, 66.5], [14.8, 103], [0, 103]]\n"
            "[dam]\ndensity_kg_m3 = 2643\nyoung_modulus_GPa = 25\npoisson_ratio = 0.2\n[contact]\nfriction = 1\n" +
            bond + "[reservoir]\nlevel_m = " + std::to_string(water) +
            "\novertopped = true\nmodel = \"hydrostatic\"\n[uplift]\nmodel = \"none\"\n[time]\nsubsteps = 0\n"
            "[lifts]\nelevations_m = [30, 45, 55, 60, 66, 75]\nbond = \"bonded\"\nactive = \"all\"\nuplift = \"none\"\n"
            "friction = 1\n" + bond);
        const fe2d::EarthquakeRun model(ready.scene, {});
        GroundMotion still;
        still.dt = 0.01;
        still.accel_h.assign(3, 0.0);
        const fe2d::RunResult run = model.run(still);
        EXPECT_EQ(run.status, Status::at_rest) << text_of(run.notes);
        const std::vector<double>& damage = run.state.laws.at("bond_damage");
        const fe2d::ContactPlanes& planes = model.structure().planes();
        std::vector<int> cracks;
        for (Eigen::Index k = 0; k < planes.count(); ++k) {
            const auto first = damage.begin() + planes.first(k), end = first + planes[k].pairs();
            const auto tip = std::find(first, end, 0.0);
            EXPECT_TRUE(std::all_of(tip, end, [](double x) { return x == 0.0; })) << water << " m, plane " << k;
            cracks.push_back(static_cast<int>(tip - first));
        }
        return cracks;
    };
    const std::vector<int> little = cracks_of(105.0), much = cracks_of(117.0);
    EXPECT_GT(little[0], 3);
    EXPECT_GT(much[0], little[0]);
    for (std::size_t k = 1; k < little.size(); ++k) {
        EXPECT_EQ(little[k], 0) << k;
        if (k == 4) // at 60 m: a second crack, half through
            EXPECT_GT(much[k], 10);
        else
            EXPECT_EQ(much[k], 0) << k;
    }
}

/// Strength halfway below the stress: the answer says so, and PASS is no plain one.
TEST(Cracks, TurnPassIntoPassWithoutCracking)
{
    const auto answer = [](const std::string& strength) {
        std::string text = dam_text("none", "[criteria]\nallowable_slip_mm = 5000\n");
        text.replace(text.find("friction = 1\n"), 13, "friction = 1\n");
        text.replace(text.find("young_modulus_GPa = 20\n"), 23, "young_modulus_GPa = 20\n" + strength);
        text.replace(text.find("substeps = 0\n"), 13, "slip_tolerance = 0.2\n");
        const Ready ready = ready_of(text);
        const std::vector<ContactRun> runs = runs_of(ready);
        return std::pair(pages::fe_headline(ready.scene, runs), pages::crack_sentence(runs));
    };
    const auto [weak, said] = answer("tensile_strength_MPa = 0.9\n");
    EXPECT_EQ(weak.verdict, "PASS, cracking not modelled") << weak.sentence;
    EXPECT_NE(said.find("The concrete would crack here"), std::string::npos) << said;
    EXPECT_NE(said.find("[[lift_joint]]"), std::string::npos) << said;
    const auto [strong, nothing] = answer("tensile_strength_MPa = 9\n");
    EXPECT_EQ(strong.verdict, "PASS") << strong.sentence;
    EXPECT_EQ(nothing, "");
}

} // namespace
