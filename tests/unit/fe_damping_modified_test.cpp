// Modified Rayleigh damping (Spears & Jensen 2012) on modes and spectra whose answer is known.
#include "fe2d/modes/modes_and_damping.hpp"
#include "verification/exact/damped_oscillator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace damslip;
constexpr double per_hertz = 2.0 * std::numbers::pi;

/// Absolute acceleration under harmonic ground motion of 1 m/s² and 3 Hz, steady state: a closed spectrum.
double harmonic_spectrum(double frequency, double ratio)
{
    return exact::DampedOscillator{frequency, ratio}.transmissibility(3.0 * per_hertz);
}

const std::vector<fe2d::ModalMass> six_modes = {{3.6 * per_hertz, 800e3},  {8.4 * per_hertz, 450e3},
                                                {10.6 * per_hertz, 60e3},  {14.9 * per_hertz, 190e3},
                                                {15.9 * per_hertz, 120e3}, {24.0 * per_hertz, 70e3}};

// Two modes: ω_j = ω_2 gives ζ in both, ΔS = 0, and no other does, since S_a falls with ζ in this spectrum above
// resonance.
TEST(FeModifiedRayleigh, two_modes_give_ordinary_rayleigh)
{
    const std::vector<fe2d::ModalMass> modes = {{5.0 * per_hertz, 7.0}, {12.0 * per_hertz, 2.0}};
    const auto result = fe2d::modified_rayleigh(modes, harmonic_spectrum, {.ratio = 0.05, .total_mass = 10.0});
    EXPECT_EQ(result.status, fe2d::ModifiedRayleighStatus::found);
    ASSERT_EQ(result.sign_changes.size(), 1u);
    EXPECT_NEAR(result.second_frequency, 12.0 * per_hertz, 1e-9 * per_hertz);
    EXPECT_NEAR(result.mass_share, 0.9, 1e-15);
    EXPECT_TRUE(result.warnings.empty());
}

// (2-58) written out again with its own constants: the sum must vanish at the result to the accuracy of the root, 1e-12
// in ω_j times the slope of the sum (of the order of the sum itself).
TEST(FeModifiedRayleigh, solves_its_equation)
{
    const auto result = fe2d::modified_rayleigh(six_modes, harmonic_spectrum, {.ratio = 0.05, .total_mass = 2.0e6});
    ASSERT_EQ(result.status, fe2d::ModifiedRayleighStatus::found);
    const double wi = 3.6 * per_hertz, wj = result.second_frequency;
    double imbalance = 0.0, wanted = 0.0;
    for (const auto& mode : six_modes) {
        const double w = mode.frequency, ratio = 0.05 * (wi * wj / w + w) / (wi + wj);
        const auto s_a = [&](double z) {
            const double r = 3.0 * per_hertz / w;
            return std::sqrt((1 + 4 * z * z * r * r) / (std::pow(1 - r * r, 2) + 4 * z * z * r * r));
        };
        imbalance += (s_a(ratio) - s_a(0.05)) * mode.effective_mass_x;
        wanted += s_a(0.05) * mode.effective_mass_x;
    }
    EXPECT_LT(std::abs(imbalance), 1e-11 * wanted);
    EXPECT_NEAR(result.imbalance, imbalance, 1e-10 * wanted);
    EXPECT_NEAR(result.constants.mass, 0.1 * wi * wj / (wi + wj), 1e-12 * result.constants.mass);
    EXPECT_NEAR(fe2d::damping_ratio(result.constants, wi), 0.05, 1e-15);
    EXPECT_GT(wj, 8.4 * per_hertz); // a mean of what the higher modes ask for
    EXPECT_LT(wj, 24.0 * per_hertz);
    EXPECT_NEAR(fe2d::shear_imbalance(six_modes, harmonic_spectrum, 0.05, result.constants), imbalance, 1e-10 * wanted);
}

// A spectrum made to cross often, wavy in ζ; all sign changes against a scan 50 times finer.
TEST(FeModifiedRayleigh, lists_all_sign_changes_and_takes_the_smallest)
{
    const auto wavy = [](double frequency, double ratio) {
        return 2.0 + std::sin(150.0 * (ratio - 0.05) + 0.3 * frequency);
    };
    const fe2d::ModifiedRayleighOptions options{.ratio = 0.05, .total_mass = 1.69e6};
    const auto result = fe2d::modified_rayleigh(six_modes, wavy, options);
    std::vector<double> expected;
    const auto imbalance = [&](double w) {
        return fe2d::shear_imbalance(six_modes, wavy, 0.05, fe2d::rayleigh_constants(0.05, six_modes[0].frequency, w));
    };
    const int points = 20000;
    double left = six_modes[0].frequency * 1.0000001;
    for (int k = 1; k <= points; ++k) {
        const double right = six_modes[0].frequency * std::pow(72.0 / 3.6, double(k) / points);
        if ((imbalance(left) > 0.0) != (imbalance(right) > 0.0)) expected.push_back(0.5 * (left + right));
        left = right;
    }
    ASSERT_GT(expected.size(), 1u);
    ASSERT_EQ(result.sign_changes.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(result.sign_changes[k] / expected[k], 1.0, 2e-4);
    EXPECT_EQ(result.second_frequency, result.sign_changes.front());
}

// S_a smallest at ζ itself: ΔS > 0 unless every ζ_n = ζ, which three frequencies cannot have.
TEST(FeModifiedRayleigh, without_a_solution_it_is_ordinary_rayleigh_and_says_so)
{
    const std::vector<fe2d::ModalMass> modes = {{2.0 * per_hertz, 3.0}, {5.0 * per_hertz, 1.0}, {9.0 * per_hertz, 1.0}};
    const auto valley = [](double, double ratio) { return 1.0 + std::abs(ratio - 0.05); };
    const auto result = fe2d::modified_rayleigh(modes, valley, {.ratio = 0.05, .total_mass = 100.0});
    EXPECT_EQ(result.status, fe2d::ModifiedRayleighStatus::no_solution);
    EXPECT_TRUE(result.sign_changes.empty());
    EXPECT_EQ(result.second_frequency, modes[2].frequency); // mode 5 of ordinary Rayleigh, the last there is
    ASSERT_EQ(result.warnings.size(), 2u);                  // 5 % of the mass only; no solution
    EXPECT_NE(text_of(result.warnings[0]).find("5.0 % of the horizontal mass"), std::string::npos);
    EXPECT_NE(text_of(result.warnings[1]).find("|dS|"), std::string::npos);
    const auto expected = fe2d::rayleigh_constants(0.05, modes[0].frequency, modes[2].frequency);
    EXPECT_DOUBLE_EQ(result.constants.mass, expected.mass);
    EXPECT_DOUBLE_EQ(result.constants.stiffness, expected.stiffness);
    // ζ_1 = ζ_3 = ζ, ζ_2 = 0.05 (2·9/5 + 5)/11: |ΔS| = (0.05 - ζ_2)·1
    EXPECT_NEAR(result.imbalance, 0.05 * (1.0 - (2.0 * 9.0 / 5.0 + 5.0) / 11.0), 1e-14);
}

} // namespace
