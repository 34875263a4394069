#pragma once

#include "analysis/prepare/ready.hpp"
#include "verification/second_solver/second_solver.hpp"
#include "calculix_reader.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "scene/read.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <unistd.h>

/// What the tests of the second solver share: a block of 15 m by 20 m with 15 m of water on massless rock, some 60 elements.
namespace damslip::calculix_tests {

/// Parts of its scene file; change one, and it is another scene.
struct BlockScene {
    std::string dam = "[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa = 20\npoisson_ratio = 0.2\n";
    std::string rock =
        "[foundation]\nyoung_modulus_GPa = 25\npoisson_ratio = 0.25\nwidth_m = 60\ndepth_m = 15\nmass = \"massless\"\n";
    std::string water = "[reservoir]\nlevel_m = 15\nmodel = \"added-mass\"\n";
    std::string contact = "[contact]\nfriction = 0.8\n";
    std::string mesh = "[mesh]\nelement = \"q8\"\nsize_m = 5\ncontact_size_m = 2.5\n";
    std::string uplift = "[uplift]\nmodel = \"none\"\n";
    std::string damping = "[damping]\nmass_coefficient_1_s = 0\nstiffness_coefficient_s = 0.003\n";
    std::string time = "[time]\nscheme = \"newmark\"\ndt_s = 0.001\n";
    std::string motion =
        "[[motion.record]]\nname = \"pulses\"\nhorizontal = \"h.csv\"\nvertical = \"v.csv\"\nunit = \"m/s2\"\n";
    double base = 15.0;

    std::string text() const
    {
        return fmt::format("title = \"Block\"\n[section]\nheight_m = 20\nbase_m = {0}\ncrest_m = {0}\n", base) + dam +
               rock + water + contact + mesh + uplift + damping + time + motion;
    }
};

/// Samples of the record, horizontal and vertical [m/s^2].
inline double horizontal_of(double t)
{
    return 2.0 * std::sin(40.0 * t) * std::sin(2.0 * t);
}
inline double vertical_of(double t)
{
    return std::sin(25.0 * t);
}

class SecondSolver : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / fmt::format("damslip_second_solver_{}", ::getpid());
        std::filesystem::create_directories(folder);
        write_record(0.01, 1.2);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    void write_record(double dt, double end) const
    {
        std::string h = "t,a\n", v = h;
        for (int k = 0; k * dt <= end + 1e-9; ++k) {
            h += fmt::format("{:.10g},{:.12g}\n", k * dt, horizontal_of(k * dt));
            v += fmt::format("{:.10g},{:.12g}\n", k * dt, vertical_of(k * dt));
        }
        write_file(folder / "h.csv", h);
        write_file(folder / "v.csv", v);
    }
    Ready ready(const BlockScene& scene) const
    {
        return prepare(parse_scene(scene.text(), folder / "block.toml"), Method::finite_elements);
    }
    std::string deck(const Ready& of, SecondAnalysis analysis, int modes = 4) const
    {
        return calculix_deck(of, analysis, modes, watch);
    }
    std::vector<SecondResult> beside(const Ready& of, SecondAnalysis analysis, int modes, const std::string& dat)
    {
        return beside_calculix(of, analysis, modes, dat, "block.dat", watch);
    }

    std::filesystem::path folder;
    Watch watch;
};

// As ccx prints: seven digits.

inline std::string printed_modes(const std::vector<double>& frequencies)
{
    std::string dat =
        "\n     E I G E N V A L U E   O U T P U T\n\n MODE NO    EIGENVALUE                       FREQUENCY\n\n";
    int number = 0;
    for (const double f : frequencies) {
        const double omega = 2.0 * std::numbers::pi * f;
        dat += fmt::format("{:7d}{:16.7E}{:16.7E}{:16.7E}{:16.7E}\n", ++number, omega * omega, omega, f, 0.0);
    }
    return dat + "\n     P A R T I C I P A T I O N   F A C T O R S\n\n      1   0.1E+01  0.2E+01  0.3E+01  0.4E+01\n";
}

inline std::string printed_crest(const std::vector<double>& x, double dt)
{
    std::string dat;
    for (std::size_t k = 1; k < x.size(); ++k)
        dat += fmt::format(
            "\n displacements (vx,vy,vz) for set NCREST and time {:15.6E}\n\n{:10d}{:15.6E}{:15.6E}{:15.6E}\n",
            static_cast<double>(k) * dt, 7, x[k], 0.0, 0.0);
    return dat;
}

/// Frequencies of a deck by its own elements [Hz].
inline std::vector<double> frequencies_of(const std::string& deck, int count)
{
    const Deck read(deck);
    const DeckModes modes{DeckModel(read)};
    std::vector<double> f;
    for (Eigen::Index i = 0; i < count; ++i) f.push_back(modes.omega[i] / (2.0 * std::numbers::pi));
    return f;
}

/// The crest's history of a tied deck by all modes of its own elements, each followed exactly [m].
inline std::vector<double> crest_of(const std::string& text)
{
    const Deck deck(text);
    const DeckModel model(deck);
    const DeckModes modes(model);
    const DeckStep& step = deck.steps.at(1);
    const auto& rayleigh = step.card("MODAL DAMPING").lines.at(0);
    const double mass = std::stod(rayleigh.at(2)), stiffness = std::stod(rayleigh.at(3));
    const double dt = std::stod(step.card("MODAL DYNAMIC").lines.at(0).at(0));
    const int crest = model.row(deck.node_sets.at("Ncrest").at(0), 0);
    const std::size_t samples = deck.amplitudes.at("Ah").size();
    std::vector<double> x(samples, 0.0);
    Eigen::MatrixXd load(modes.omega.size(), samples);
    load.setZero();
    for (const auto& [name, values] : deck.amplitudes) {
        const Eigen::VectorXd share = modes.shape.transpose() * model.force(step, name);
        for (std::size_t k = 0; k < samples; ++k) load.col(static_cast<Eigen::Index>(k)) += values.at(k).second * share;
    }
    for (Eigen::Index i = 0; i < modes.omega.size(); ++i) {
        const double omega = modes.omega[i];
        const Eigen::VectorXd row = load.row(i);
        const std::vector<double> q =
            oscillator(omega, 0.5 * (mass / omega + stiffness * omega), {row.data(), row.data() + row.size()}, dt);
        for (std::size_t k = 0; k < samples; ++k) x[k] += modes.shape(crest, i) * q[k];
    }
    return x;
}

} // namespace damslip::calculix_tests
