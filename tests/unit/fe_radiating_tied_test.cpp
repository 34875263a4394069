// Dams tied to a base that moves: the coupling of the steps, and transfer functions with the rock's dynamic stiffness.
#include "analysis/prepare/ready.hpp"
#include "core/input_error.hpp"
#include "fe2d/harmonic/transfer.hpp"
#include "fe2d/rock/reduced_rock.hpp"
#include "fe2d/time/central_difference.hpp"
#include "fe2d/time/integrate.hpp"
#include "fe2d/time/modal_run.hpp"
#include "fe_scenes.hpp"
#include "program_answer.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <unistd.h>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

Model small_model()
{
    Scene scene = fe2d::test::reference_dam_on_rock();
    scene.mesh.size = 8.0;
    scene.mesh.contact_size = 7.5;
    return build_model(scene);
}

GroundMotion two_pulses()
{
    GroundMotion motion;
    motion.dt = 0.01;
    for (int k = 0; k <= 300; ++k) {
        const double t = k * motion.dt, window = std::sin(std::numbers::pi * k / 300.0);
        motion.accel_h.push_back(2.0 * std::sin(5.0 * std::numbers::pi * t) * window);
        motion.accel_v.push_back(1.1 * std::sin(8.0 * std::numbers::pi * t) * window);
    }
    return motion;
}

/// The massless rock of a model as the residual of reduced rock, with one mode that touches nothing.
ReducedRock massless_rock(const Model& model)
{
    const Eigen::MatrixXd with_rock(structure_system(model, {}).system.stiffness),
        rest = with_rock - Eigen::MatrixXd(dam_on_free_base(model, {}).stiffness);
    const std::vector<Eigen::Index> base = unknowns_of_base(model);
    const Eigen::MatrixXd stiffness = rest(base, base);
    const auto n = static_cast<Eigen::Index>(base.size());
    EXPECT_NEAR(rest.norm(), stiffness.norm(), 1e-12 * rest.norm()); // nothing elsewhere
    ReducedRock rock;
    rock.stiffness = Eigen::VectorXd::Ones(1);
    rock.damping = Eigen::MatrixXd::Ones(1, 1);
    rock.modes = Eigen::MatrixXd::Zero(n, 1);
    rock.residual = stiffness.inverse();
    rock.residual = (0.5 * (rock.residual + rock.residual.transpose())).eval();
    return rock;
}

// Massless rock as a moving base: the run on condensed rock, in every scheme, to what inverting K_c costs in digits.
TEST(FeMovingBase, MasslessRockGivesTheRunOnCondensedRock)
{
    const Model model = small_model();
    const ReducedRock rock = massless_rock(model);
    const GroundMotion motion = two_pulses();
    for (const Scheme& scheme : {average_acceleration(), hht(-0.05), hht(-1.0 / 3.0)}) {
        TiedRunOptions options;
        options.scheme = scheme;
        options.damping.constants = {1.5, 1e-3};
        options.static_load = Eigen::VectorXd::Constant(model.dofs.count, 1e4);
        const History condensed = integrate(model, motion, options);
        options.moving_base = [&](const StepConstants& constants, double stiffness_damping) {
            return rock_base(rock, constants, stiffness_damping);
        };
        const History coupled = integrate(model, motion, options);
        ASSERT_EQ(condensed.rows.size(), coupled.rows.size()) << text_of(coupled.ending);
        for (std::size_t k = 0; k < coupled.rows.size(); ++k) {
            ASSERT_NEAR(coupled.rows[k].crest_x, condensed.rows[k].crest_x, 1e-9 * condensed.peak_crest_x);
            ASSERT_NEAR(coupled.rows[k].base_shear, condensed.rows[k].base_shear, 1e-8 * condensed.peak_base_shear);
            // numerical dissipation and damping do not know where the rest is counted from
            ASSERT_NEAR(coupled.rows[k].energy.damping, condensed.rows[k].energy.damping,
                        1e-8 * condensed.energy_scale);
            ASSERT_NEAR(coupled.rows[k].energy.numerical, condensed.rows[k].energy.numerical,
                        1e-8 * condensed.energy_scale);
        }
        EXPECT_GT(condensed.peak_crest_x, 1e-4);
        EXPECT_LT(coupled.largest_imbalance, 1e-11);
        EXPECT_LT((coupled.displacement - condensed.displacement).norm(), 1e-8 * condensed.displacement.norm());
    }
}

TEST(FeMovingBase, MasslessRockGivesTheTransferFunctionOfCondensedRock)
{
    const Model model = small_model();
    const ReducedRock rock = massless_rock(model);
    const RayleighConstants damping{1.5, 1e-3};
    const std::vector<double> frequencies{0.1, 2.0, 5.0, 17.0};
    const RockBelow below{rock, damping.stiffness};
    const auto wanted = transfer_functions(model, structure_system(model, damping).system, nullptr, frequencies),
               found = transfer_functions(model, dam_on_free_base(model, damping), nullptr, frequencies, &below);
    ASSERT_EQ(wanted.size(), found.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
        EXPECT_LT(std::abs(found[k].crest - wanted[k].crest), 1e-9 * std::abs(wanted[k].crest)) << frequencies[k];
}

// A base that has no mass of its own has no largest stable step: linear acceleration is refused, and so are modes.
TEST(FeMovingBase, SchemesThatCannotStepItAreRefused)
{
    const Model model = small_model();
    const ReducedRock rock = massless_rock(model);
    TiedRunOptions options;
    options.moving_base = [&](const StepConstants& constants, double stiffness_damping) {
        return rock_base(rock, constants, stiffness_damping);
    };
    EXPECT_THROW(integrate_modal(model, two_pulses(), options), InputError);
    EXPECT_THROW(integrate_explicit(model, two_pulses(), options), InputError);
    options.scheme = linear_acceleration();
    EXPECT_THROW(integrate(model, two_pulses(), options), InputError);
}

TEST(FeMovingBase, AutomaticSchemeIsHht)
{
    Scene scene = fe2d::test::reference_dam_on_rock();
    scene.foundation->mass = RockMass::with_mass;
    scene.foundation->boundary = RockBoundary::absorbing;
    GroundMotion motion;
    motion.dt = 0.01;
    motion.accel_h.assign(100000, 0.0); // modes would pay
    const TiedScheme chosen = tied_scheme(scene, motion, {});
    EXPECT_EQ(chosen.scheme, TimeScheme::hht);
    EXPECT_NE(chosen.reason.find("waves out"), std::string::npos) << chosen.reason;
    scene.foundation->boundary = RockBoundary::fixed;
    scene.foundation->mass = RockMass::massless;
    EXPECT_EQ(tied_scheme(scene, motion, {}).scheme, TimeScheme::modal);
}

// On each rock other transfer functions, and the page says on which.
TEST(FeMovingBase, TransferFunctionsOfTheCommandAreOnTheRockOfTheScene)
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("damslip_frf_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    const auto transfer = [&](const std::string& rock) {
        std::ofstream(folder / "dam.toml")
            << "[section]\nheight_m = 20\nbase_m = 16\ncrest_m = 4\n[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa = "
               "25\n[foundation]\nyoung_modulus_GPa = 5\ndensity_kg_m3 = 2600\n"
            << rock << "[contact]\nfriction = 0.4\n[mesh]\nsize_m = 4\ncontact_size_m = 4\n";
        const std::filesystem::path out = folder / "out";
        const ProgramAnswer a =
            answer_of({"modes", (folder / "dam.toml").string(), "--frf", "--out", out.string(), "--quiet"});
        EXPECT_EQ(a.code, 0) << a.talk;
        std::ifstream file(out / "transfer_functions.csv");
        const std::string table{std::istreambuf_iterator<char>(file), {}};
        return std::pair{table.substr(table.find("\n0.1")), a.out};
    };
    const auto massless = transfer("mass = \"massless\"\n"), radiating = transfer("mass = \"with-mass\"\nboundary = \"absorbing\"\n"),
               viscous = transfer("mass = \"with-mass\"\nboundary = \"viscous\"\n"),
               fixed = transfer("mass = \"with-mass\"\nboundary = \"fixed\"\n");
    EXPECT_NE(massless.first, radiating.first);
    EXPECT_NE(massless.first, viscous.first);
    EXPECT_NE(massless.first, fixed.first);
    EXPECT_NE(viscous.first, fixed.first);
    EXPECT_EQ(massless.second.find("transfer functions: on"), std::string::npos);
    EXPECT_NE(radiating.second.find("transfer functions: on radiating rock"), std::string::npos) << radiating.second;
    std::filesystem::remove_all(folder);
}

} // namespace
