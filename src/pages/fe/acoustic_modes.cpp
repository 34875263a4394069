#include "pages/fe/acoustic_modes.hpp"

#include "scene/mesh_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

Table coupled_mode_table(const fe2d::CoupledModes& modes, const std::vector<Eigen::Index>& leading)
{
    Table t;
    t.title = "Coupled modes of dam and water (tied base)";
    t.columns = {{"mode", "mode", "", 4},
                 {"frequency_Hz", "frequency", "Hz", 5},
                 {"period_s", "period", "s", 5},
                 {"of", "of", "", 4},
                 {"water_energy_percent", "energy in water", "%", 3},
                 {"effective_mass_x_kg_m", "mass x", "kg/m", 5},
                 {"share_x_percent", "share x", "%", 4},
                 {"cumulative_x_percent", "sum x", "%", 4},
                 {"effective_mass_y_kg_m", "mass y", "kg/m", 5},
                 {"share_y_percent", "share y", "%", 4},
                 {"dam_share_x_percent", "of it the dam", "%", 4},
                 {"leading", "leading", "", 4}};
    double sum = 0.0;
    for (Eigen::Index k = 0; k < modes.frequency.size(); ++k) {
        sum += modes.effective_share(0, k);
        const bool chosen = std::find(leading.begin(), leading.end(), k) != leading.end();
        t.rows.push_back({static_cast<std::int64_t>(k + 1), modes.frequency[k], 1 / modes.frequency[k],
                          std::string(modes.of_water(k) ? "reservoir" : "dam"), 100 * modes.water_share[k],
                          modes.effective_mass(0, k), 100 * modes.effective_share(0, k), 100 * sum,
                          modes.effective_mass(1, k), 100 * modes.effective_share(1, k), 100 * modes.dam_share[k],
                          chosen ? Cell(std::string("yes")) : Cell()});
    }
    t.notes.push_back(fmt::format("real modes: far end closed, bottom rigid and still. leading: the first {} in which "
                                  "the dam's own mass carries at "
                                  "least 0.1 % of the horizontal mass; damping.rayleigh_modes counts these.",
                                  leading.size()));
    t.notes.push_back(
        "shares of the dam and the added mass of incompressible water; a mode is the reservoir's when more than "
        "half of its potential energy is in the water.");
    return t;
}

fe2d::NaturalModes as_natural_modes(const fe2d::CoupledModes& modes, const std::vector<Eigen::Index>& leading)
{
    fe2d::NaturalModes natural;
    natural.frequency = modes.frequency(leading);
    natural.effective_mass = modes.effective_mass(Eigen::all, leading);
    natural.effective_share = modes.effective_share(Eigen::all, leading);
    return natural;
}

Table transfer_table(const std::vector<fe2d::TransferPoint>& points, bool water)
{
    Table t;
    t.title = "Transfer functions of a horizontal ground acceleration (tied base)";
    t.columns = {{"frequency_Hz", "frequency", "Hz", 5},
                 {"crest_amplitude", "crest/ground", "–", 5},
                 {"crest_phase_deg", "phase", "deg", 4}};
    if (water) {
        t.columns.push_back({"water_force_kN_m_per_m_s2", "water force", "kN/m per m/s²", 5});
        t.columns.push_back({"water_force_phase_deg", "phase", "deg", 4});
    }
    const auto degrees = [](std::complex<double> z) { return std::arg(z) * 180.0 / M_PI; };
    for (const fe2d::TransferPoint& p : points) {
        if (!p.regular) continue;
        std::vector<Cell> row{p.frequency, std::abs(p.crest), degrees(p.crest)};
        if (water) {
            row.emplace_back(std::abs(p.water_force) / 1e3);
            row.emplace_back(degrees(p.water_force));
        }
        t.rows.push_back(std::move(row));
    }
    t.notes.push_back("crest: absolute acceleration of its upstream end in x; both positive downstream.");
    return t;
}

std::vector<std::string> reservoir_warnings(const Scene& scene, double highest)
{
    const Reservoir& water = *scene.reservoir;
    const double c = std::sqrt(water.bulk_modulus / water.density), first = c / (4.0 * water.level),
                 ratio = water.length / water.level;
    std::vector<std::string> warnings;
    if (water.far_end == FarEnd::damper && highest > first)
        warnings.push_back(
            fmt::format("reservoir.far_end = \"damper\" is exact for waves along the axis only: above the reservoir's "
                        "first frequency, {:.3g} Hz, its "
                        "force may err by a factor of 2 with a rigid bottom; \"absorbing\" is right there",
                        first));
    if (water.far_end == FarEnd::damper && ratio < 2.0)
        warnings.push_back(fmt::format(
            "the reservoir is {:.3g} depths long; a damper wants 2 at least (Goldgruber 2015, 3.5.3.2)", ratio));
    if ((water.far_end == FarEnd::closed || water.far_end == FarEnd::open) && ratio < 4.0)
        warnings.push_back(
            fmt::format("the reservoir is {:.3g} depths long; a reflecting end wants 4 at least", ratio));
    if ((water.far_end == FarEnd::closed || water.far_end == FarEnd::open) && highest > first)
        warnings.push_back(fmt::format(
            "waves above the reservoir's first frequency, {:.3g} Hz, come back from a reflecting far end after "
            "{:.3g} s",
            first, 2.0 * water.length / c));
    if (water.far_end == FarEnd::absorbing && ratio < 0.5)
        warnings.push_back(
            fmt::format("the reservoir is {:.3g} depths long; the absorbing end wants half a depth at least", ratio));
    if (water.bottom_motion == BottomMotion::ground && scene.motion.vertical && water.bottom_reflection == 1.0 &&
        !water.bottom_density && highest > first)
        warnings.push_back(
            fmt::format("a rigid bottom that moves (bottom_reflection = 1) has no damping of the water's vertical "
                        "resonance at {:.3g} "
                        "Hz: vertical motion may raise the slip several times; give the bottom its bottom_reflection",
                        first));
    const double size = water_mesh_size(water), resolved = c / (10.0 * std::max(size, water.level / 12.0));
    if (highest > resolved)
        warnings.push_back(
            fmt::format("the water's mesh resolves waves up to {:.3g} Hz (ten elements a wave)", resolved));
    return warnings;
}

std::string water_counts(const fe2d::FluidModel& water)
{
    std::string text = fmt::format("acoustic water: {} elements, {} pressures", water.reservoir.mesh.element_count(),
                                   water.mesh_unknowns);
    if (water.layer_pressures > 0)
        text += fmt::format(", absorbing end of {} layers with {} pressures and {} momenta",
                            water.options.layers.cosines.size() + water.options.layers.decays.size(),
                            water.layer_pressures, water.layer_momenta);
    return text + fmt::format("; {} non-zeros in its matrices",
                              water.mass.nonZeros() + water.damping.nonZeros() + water.stiffness.nonZeros());
}

} // namespace damslip::pages
