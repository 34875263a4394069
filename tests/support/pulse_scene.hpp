#pragma once

#include "analysis/fragility/fragility_runs.hpp"
#include "core/file.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

/// A one-way block under one pulse, whose slip has a closed form: what a probability of sliding can be held against.
namespace damslip::pulse {

constexpr double accel = 4.0;    ///< of the plateau [m/s^2]
constexpr double gravity = 9.81; ///< of the scene [m/s^2]
constexpr double length = 0.5;   ///< of the plateau [s]
constexpr double dt = 0.01;      ///< of the record, whose flanks are one step long [s]

/// Slip by hand, flanks included [m].
inline double slip(double mu, double plateau = accel)
{
    const double y = mu * gravity, A = plateau, T = length;
    if (y >= A) return 0.0;
    double v = (A - y) * (A - y) * dt / (2 * A), s = std::pow(A - y, 3) * dt * dt / (6 * A * A);
    s += v * T + (A - y) * T * T / 2;
    v += (A - y) * T;
    s += v * dt + (A - y) * dt * dt / 2 - A * dt * dt / 6;
    v += (A / 2 - y) * dt;
    return s + v * v / (2 * y);
}

/// The friction with that slip.
inline double friction(double of_slip, double plateau = accel)
{
    double low = 0.01, high = 1.0;
    for (int i = 0; i < 100; ++i) (slip(0.5 * (low + high), plateau) > of_slip ? low : high) = 0.5 * (low + high);
    return low;
}

/// Of this process.
inline std::filesystem::path folder()
{
    const auto at = std::filesystem::temp_directory_path() / fmt::format("damslip_pulse_{}", ::getpid());
    std::filesystem::create_directories(at);
    return at;
}

/// Its record, as a file. @param plateau  [m/s^2]
inline std::string record_text(double plateau = accel)
{
    std::string samples = "# units: m/s2\nt,a\n0,0\n";
    for (int k = 1; k <= 51; ++k) samples += fmt::format("{},{}\n", k * dt, plateau);
    return samples + fmt::format("{},0\n{},0\n", 52 * dt, 53 * dt);
}

/// The block, and beside it the record. @param more  further tables
inline SceneText scene(const std::string& more = "", double mu = 0.7, bool two_way = false)
{
    write_file(folder() / "pulse.csv", record_text());
    return {fmt::format("[section]\nheight_m = 50\nbase_m = 40\ncrest_m = 5\n[dam]\ndensity_kg_m3 = 2400\n"
                        "young_modulus_GPa = 25\npoisson_ratio = 0.2\n[contact]\nfriction = {}\n"
                        "[sliding]\ntwo_way = {}\n{}"
                        "[[motion.record]]\nname = \"pulse\"\nhorizontal = \"pulse.csv\"\nunit = \"m/s2\"\n",
                        mu, two_way, more),
            folder() / "pulse.toml"};
}

/// Its records, each an event of its own, all of the plateau's intensity.
inline ShakingSuite suite(const SceneText& text)
{
    ShakingSuite suite;
    suite.pairs = load_records(text.scene(), Method::rigid_block);
    for (const RecordPair& pair : *suite.pairs) {
        suite.event.push_back(pair.files.name);
        suite.weight.push_back(1.0);
        suite.intensity.push_back(accel);
    }
    return suite;
}

inline RandomVariable lognormal(const std::string& name, const std::string& key, double median, double beta,
                                VariableKind kind = VariableKind::aleatory)
{
    RandomVariable v;
    v.name = name;
    v.keys = {key};
    v.kind = kind;
    v.law = {"lognormal", {{"median", median}, {"beta", beta}}, {}, {}, {"probability.variable", 7}};
    return v;
}

/// Friction of median 0.30, beta 0.2.
inline RandomVariable mu(VariableKind kind = VariableKind::aleatory)
{
    return lognormal("mu", "contact.friction", 0.30, 0.2, kind);
}

} // namespace damslip::pulse
