#include "fe2d/modes/modes_and_damping.hpp"
#include "sliding/loads/added_mass.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/reference_scene.hpp"
#include "verification/exact/timoshenko_beam.hpp"

#include <cmath>
#include <complex>

namespace damslip::verification {

namespace {

using namespace damslip::fe2d;

Scene section(Polyline polygon, const ElasticMaterial& material)
{
    Scene scene;
    scene.section.polygon = std::move(polygon);
    scene.dam = {material.density, material.young_modulus, material.poisson_ratio};
    return scene;
}

Eigen::VectorXd frequencies(const Scene& scene, int count)
{
    return natural_modes(build_model(scene), count).frequency;
}

/// Bending frequencies only: axial modes of the wall are left out by their effective mass in y.
std::vector<Check> cantilever()
{
    const exact::TimoshenkoCantilever beam{
        .length = 20.0,
        .depth = 1.0,
        .young_modulus = 30e9 / 0.96,
        .shear_modulus = 12.5e9,
        .density = 2500.0,
        .shear_factor = 6.25 / 7.25}; // 5 (1 + nu)/(6 + 5 nu), nu = 0.25 of the equivalent plane stress
    Scene scene = section({{0, 0}, {1, 0}, {1, 20}, {0, 20}}, {2500.0, 30e9, 0.2});
    scene.mesh.size = scene.mesh.contact_size = 0.0625;
    const NaturalModes modes = natural_modes(build_model(scene), 6);
    const std::vector<double> exact = beam.frequencies(4);
    std::vector<Check> checks;
    for (Eigen::Index i = 0; i < modes.frequency.size() && checks.size() < exact.size(); ++i)
        if (modes.effective_mass(0, i) > modes.effective_mass(1, i))
            checks.push_back({"bending mode " + std::to_string(checks.size() + 1), "Hz", exact[checks.size()],
                              modes.frequency[i], 1e-3});
    return checks;
}

std::vector<Check> tapered_membrane()
{
    const double published[] = {44.623, 130.03, 162.70, 246.05, 379.90, 391.44};
    Scene scene = section({{0, 0}, {5, 0}, {3, 10}, {2, 10}}, plane_stress_equivalent({8000.0, 200e9, 0.3}));
    scene.mesh.size = scene.mesh.contact_size = 0.1;
    const Eigen::VectorXd f = frequencies(scene, 6);
    std::vector<Check> checks;
    for (int i = 0; i < 6; ++i) checks.push_back({"mode " + std::to_string(i + 1), "Hz", published[i], f[i], 1e-3});
    return checks;
}

/// Square wall: frequencies of plain Q4 with the consistent mass are upper bounds that fall towards the exact ones.
std::vector<Check> squat_wall()
{
    const auto run = [](double size, ElementKind kind) {
        Scene scene = section({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {2500.0, 30e9, 0.2});
        scene.mesh.size = scene.mesh.contact_size = size;
        scene.mesh.element = kind;
        return frequencies(scene, 4);
    };
    const Eigen::VectorXd a = run(0.5, ElementKind::q4), b = run(0.25, ElementKind::q4),
                          c = run(0.125, ElementKind::q4);
    const Eigen::VectorXd incompatible = run(0.25, ElementKind::q4_incompatible),
                          triangles = run(0.125, ElementKind::t3);
    std::vector<Check> checks;
    for (int i = 0; i < 4; ++i) {
        const double ratio = (a[i] - b[i]) / (b[i] - c[i]), limit = c[i] - (b[i] - c[i]) / (ratio - 1.0); // Aitken
        const std::string mode = "mode " + std::to_string(i + 1);
        checks.push_back({mode + ": order of convergence", "–", 1.0, std::log2(ratio), 0.0, Measure::lower_bound});
        checks.push_back({mode + ": Q4 incompatible, 40 elements over the base", "Hz", limit, incompatible[i], 1e-3});
        checks.push_back({mode + ": T3, 80 elements over the base", "Hz", limit, triangles[i], 2e-3});
    }
    return checks;
}

/// @param scale  1: 62.5 m high, 2: 125 m
Scene thesis_dam(double scale = 1.0)
{
    Scene scene = exact::elastic_reference_scene(scale);
    scene.added_mass.formula = AddedMassFormula::westergaard_simplified;
    return scene;
}

AddedMassLaw law_of(const Scene& scene)
{
    const sliding::WaterColumn water{scene.reservoir->level, scene.reservoir->density, scene.reservoir->bulk_modulus};
    return [&scene, water](Point p, double angle) {
        return sliding::added_mass_per_area(scene.added_mass, water, water.depth - p.y, angle);
    };
}

std::vector<Check> modes_of_the_reference_dam()
{
    const Scene scene = thesis_dam();
    const NaturalModes modes = natural_modes(build_model(scene, {.added_mass = law_of(scene)}), 5);
    const double published[] = {3.6, 8.4, 10.6}, cumulative[] = {0.595, 0.898, 0.913, 0.977};
    std::vector<Check> checks;
    for (int i = 0; i < 3; ++i)
        checks.push_back({"frequency, mode " + std::to_string(i + 1), "Hz", published[i], modes.frequency[i], 0.06});
    checks.push_back({"frequency, mode 4 over the published 14.9 Hz", "–", 1.11, modes.frequency[3] / 14.9, 0.02,
                      Measure::absolute});
    checks.push_back({"no mode near the published fifth, 15.9 Hz: the next one", "Hz", 20.0, modes.frequency[4], 0.0,
                      Measure::lower_bound});
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        sum += modes.effective_share(0, i);
        checks.push_back({"effective mass in x, modes 1 to " + std::to_string(i + 1), "–", cumulative[i], sum, 0.03,
                          Measure::absolute});
    }
    const Scene doubled = thesis_dam(2.0); // every length twice: every frequency half
    const NaturalModes doubled_modes = natural_modes(build_model(doubled, {.added_mass = law_of(doubled)}), 4);
    const double published_doubled[] = {1.8, 4.3, 5.3, 8.1};
    for (int i = 0; i < 4; ++i) {
        const std::string mode = "125 m, mode " + std::to_string(i + 1);
        checks.push_back({mode + ": frequency", "Hz", published_doubled[i], doubled_modes.frequency[i], 0.06});
        checks.push_back(
            {mode + ": half the one of 62.5 m", "Hz", 0.5 * modes.frequency[i], doubled_modes.frequency[i], 1e-3});
    }
    return checks;
}

std::vector<Check> moving_mass_totals()
{
    Scene scene = thesis_dam();
    const Model simplified = build_model(scene, {.added_mass = law_of(scene)});
    scene.added_mass.formula = AddedMassFormula::westergaard;
    const Model rigorous = build_model(scene, {.added_mass = law_of(scene)});
    const auto total = [](const Model& model) { return model.total_mass[0] - model.total_mass[1]; };
    return {{"simplified: 7/12 rho h^2", "kg/m", 7.0 / 12.0 * 1000.0 * 62.5 * 62.5, total(simplified), 1e-4},
            {"series: 16 rho h^2 / pi^3 times sum 1/n^3", "kg/m",
             16.0 / std::pow(M_PI, 3) * 1.0517997902646450 * 1000.0 * 62.5 * 62.5, total(rigorous), 1e-4},
            {"matrix sums to the total", "kg/m", total(simplified), simplified.added_mass.sum(), 1e-12}};
}

std::vector<Check> koyna()
{
    const double published[] = {19.27, 51.50, 67.56, 99.73};
    const Eigen::VectorXd f = 2.0 * M_PI *
                              frequencies(section({{0, 0}, {70, 0}, {19.25, 66.5}, {14.8, 103}, {0, 103}},
                                                  plane_stress_equivalent({2643.0, 31.027e9, 0.2})),
                                          4);
    std::vector<Check> checks;
    for (int i = 0; i < 4; ++i)
        checks.push_back({"circular frequency, mode " + std::to_string(i + 1), "rad/s", published[i], f[i], 0.03});
    return checks;
}

std::vector<Check> pine_flat()
{
    constexpr double ft = 0.3048, psi = 6894.757293168361, lb_ft3 = 16.01846337396014;
    // Upstream batter 0.05 up to 335 ft, then vertical; downstream slope 0.78 up to the vertical part below the crest;
    // crest 32 ft.
    const Polyline feet{{0, 0},       {314.32, 0},  {48.75, (314.32 - 48.75) / 0.78},
                        {48.75, 400}, {16.75, 400}, {16.75, 335}};
    Polyline polygon;
    for (const Point p : feet) polygon.push_back({p.x * ft, p.y * ft});
    const double period = 1.4 * 400.0 / std::sqrt(3.25e6);
    const Eigen::VectorXd f =
        frequencies(section(polygon, plane_stress_equivalent({155.0 * lb_ft3, 3.25e6 * psi, 0.2})), 4);
    return {{"fundamental period", "s", period, 1.0 / f[0], 0.05}};
}

/// Cross moment of two oscillators under white noise, real part of the integral of H_i H_j* over all frequencies, by the
/// trapezoid rule; its error falls faster than any power of the step, for the integrand is smooth and the axis infinite.
double cross_moment(double w_i, double w_j, double ratio)
{
    constexpr double step = 1e-3, last = 400.0; // widths of the peaks are 0.1 and more; H falls with w^-4 beyond 10
    double sum = 0.0;
    for (double w = 0.0; w < last; w += step) {
        const std::complex<double> h_i = 1.0 / std::complex<double>(w_i * w_i - w * w, 2.0 * ratio * w_i * w);
        const std::complex<double> h_j = 1.0 / std::complex<double>(w_j * w_j - w * w, 2.0 * ratio * w_j * w);
        sum += (w == 0.0 ? 0.5 : 1.0) * (h_i * std::conj(h_j)).real();
    }
    return sum * step;
}

std::vector<Check> white_noise()
{
    std::vector<Check> checks;
    for (const double r : {0.7, 0.9, 0.97, 1.2}) {
        constexpr double ratio = 0.05;
        const double exact =
            cross_moment(1.0, r, ratio) / std::sqrt(cross_moment(1.0, 1.0, ratio) * cross_moment(r, r, ratio));
        checks.push_back({"correlation, frequencies 1 and " + std::to_string(r).substr(0, 4), "-", exact,
                          fe2d::modal_correlation(1.0, r, ratio), 1e-6});
    }
    return checks;
}

/// Effective masses of a uniform Euler-Bernoulli cantilever: Gamma_n^2/m = 4 sigma_n^2/lambda_n^2.
std::vector<Check> slender_wall()
{
    Scene scene;
    scene.section.polygon = {{0, 0}, {1, 0}, {1, 40}, {0, 40}};
    scene.dam = {2500.0, 30e9, 0.0};
    scene.mesh.size = scene.mesh.contact_size = 0.25;
    const fe2d::NaturalModes modes = fe2d::natural_modes(fe2d::build_model(scene), 4);
    const double lambda[] = {1.875104, 4.694091}, sigma[] = {0.734096, 1.018467};
    std::vector<Check> checks;
    for (Eigen::Index i = 0; i < modes.frequency.size() && checks.size() < 2; ++i) {
        if (modes.effective_mass(0, i) <= modes.effective_mass(1, i)) continue; // axial
        const std::size_t n = checks.size();
        const double exact = 4.0 * sigma[n] * sigma[n] / (lambda[n] * lambda[n]);
        checks.push_back({"share of the mass, bending mode " + std::to_string(n + 1), "-", exact,
                          modes.effective_share(0, i), 5e-3});
    }
    return checks;
}

} // namespace

void add_fe_modes_cases(Registry& registry)
{
    registry.push_back({"fe.modes.cantilever", "Bending frequencies of a slender wall on a rigid base.",
                        "Timoshenko beam, frequency equation of Huang, J. Appl. Mech. 28 (1961) 579-584, E/(1 - nu^2); "
                        "kappa = 5(1 + nu)/(6 + 5 nu) of "
                        "Kaneko, J. Phys. D 8 (1975) 1927-1936, with the equivalent plane stress nu/(1 - nu); L/h = 20",
                        "16 elements over the depth, converged to 0.02 %. The beam leaves out that the clamped end "
                        "holds the section's width: 0.04 % in mode 1. "
                        "With kappa = 5/6 mode 4 would be 0.16 % off, which shows the shear term is seen.",
                        cantilever});
    registry.push_back(
        {"fe.modes.tapered-membrane",
         "Cantilevered tapered membrane 10 m long, 5 m to 1 m wide, plane stress mapped to plane strain.",
         "NAFEMS, Abbassian, Dawswell & Knowles, Selected Benchmarks for Natural Frequency Analysis (1987), test FV32",
         "Elements of 0.1 m, converged to 0.05 %; published to four or five digits, from a finite-element model of "
         "their own: 0.1 %.",
         tapered_membrane});
    registry.push_back({"fe.modes.squat-wall", "Square wall on a rigid base: three element types meet in one limit.",
                        "No closed form: conforming Q4 with consistent mass gives upper bounds; their limit over three "
                        "meshes (Aitken) is the reference",
                        "Order 1.7 to 2 (2 without the singularity of the clamped corners). The incompatible element's "
                        "own error on its mesh, from its limit: 0.05 %; "
                        "triangles of half the size: 0.08 %.",
                        squat_wall});
    registry.push_back({"fe.modes.added-mass-total", "The added mass on the face integrates to its closed totals.",
                        "Goldgruber (2015), (3-5): 7/12 rho h^2; series (3-1), T = infinity: 16 rho h^2/pi^3 sum of "
                        "1/n^3 over odd n = 0.5428 rho h^2",
                        "Five Gauss points per edge; the square root at the surface costs 1e-5. ", moving_mass_totals});
    registry.push_back({"fe.modes.reference-dam", "Dam of 62.5 m on massless rock with Westergaard's added mass.",
                        "Goldgruber (2015), chapter 4: 3.6, 8.4, 10.6, 14.9 (15.9) Hz, cumulative effective masses "
                        "59.5, 89.8, 91.3, 97.7 %; 125 m: 1.8, 4.3, 5.3, 8.1 Hz",
                        "The section's figure is missing in the source; with this one modes 1 to 3 agree within 6 %, "
                        "mode 4 is 11 % high. The published mode of "
                        "15.9 Hz has no counterpart with massless rock.",
                        modes_of_the_reference_dam});
    registry.push_back({"fe.modes.koyna", "Koyna dam, empty reservoir, rigid base, plane stress.",
                        "Chopra & Chakrabarti, Bull. Seism. Soc. Am. 63 (1973) 381-397: 19.27, 51.50, 67.56, 99.73 "
                        "rad/s; E = 31.027 GPa, 2643 kg/m^3, nu = 0.2",
                        "The published values come from a mesh of 136 elements: 3 %.", koyna});
    registry.push_back({"fe.modes.pine-flat",
                        "Pine Flat dam, tallest monolith, empty reservoir, rigid base, plane stress.",
                        "Fenves & Chopra, UCB/EERC-85/10 (1986): T_1 = 1.4 H/sqrt(E) (ft, psi) = 0.311 s for H = 400 "
                        "ft, E = 3.25e6 psi; 155 lb/ft^3, nu = 0.2",
                        "The formula is that of a standard section with a rounded coefficient: 5 %.", pine_flat});
    registry.push_back({"fe.spectrum.white-noise", "Correlation of two modes under white noise (CQC).",
                        "Der Kiureghian, Earthq. Eng. Struct. Dyn. 9 (1981) 419-435, against the cross moment of two "
                        "oscillators by quadrature",
                        "The formula is exact for white noise; the quadrature is cut where 1e-8 is left.",
                        white_noise});
    registry.push_back({"fe.spectrum.slender-wall", "Effective masses of a slender wall on a rigid base.",
                        "Uniform Euler-Bernoulli cantilever: share 4 sigma^2/lambda^2",
                        "Shear, rotation and the mass of the fixed nodes, 0.3 % of the wall, are not in the beam: 0.5 "
                        "%.",
                        slender_wall});
}

} // namespace damslip::verification
