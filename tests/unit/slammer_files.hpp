#pragma once

#include "core/file.hpp"
#include "core/units.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <unistd.h>

/// A small set in the format of SLAMMER's published results, whose numbers follow from a closed form: one trapezoidal pulse.
namespace damslip::slammer_tests {

using Json = nlohmann::json;

constexpr double ramp = 0.1, plateau = 0.5, record_dt = 0.01; ///< of the pulse and its record [s]
constexpr double record_peak_g = 0.5004;                      ///< three decimals are known of it: 0.5
constexpr const char* record_name = "Pulse_2000_ONE-090.csv";

/// Slip of a rigid block under the pulse with plateau A: integrating u'' = a - y over both ramps and the plateau, then at -y to rest;
/// it still moves at the end of the pulse. [m] @param A, y  [m/s^2]
inline double slip_by_hand(double A, double y)
{
    if (y >= A) return 0.0;
    const double d = A - y;
    double v = d * d * ramp / (2.0 * A), s = d * d * d * ramp * ramp / (6.0 * A * A);
    s += v * plateau + d * plateau * plateau / 2.0;
    v += d * plateau;
    s += v * ramp + d * ramp * ramp / 2.0 - A * ramp * ramp / 6.0;
    v += (A / 2.0 - y) * ramp;
    return s + v * v / (2.0 * y);
}

/// Plateau of a motion that is asked for with this peak: the record is scaled by its peak of three decimals [m/s^2].
inline double accel_of(double target_g)
{
    return target_g / 0.5 * record_peak_g * units::standard_gravity;
}

/// As it is published: five decimals.
inline double printed_cm(double metres)
{
    return std::round(1e7 * metres) / 1e5;
}

inline Json rigid(int number, double target_g, double yield_g, double wrong = 1.0)
{
    const double slip = wrong * slip_by_hand(accel_of(target_g), yield_g * units::standard_gravity);
    return {{"analysis_id", fmt::format("analysis_{:04d}_rigid", number)},
            {"ground_motion_parameters",
             {{"earthquake", "Pulse 2000"},
              {"record_station", "ONE-090"},
              {"target_pga_g", target_g},
              {"ground_motion_file", record_name}}},
            {"analysis", {{"method", "rigid"}}},
            {"site_parameters", {{"ky_g", yield_g}}},
            {"results", {{"normal_displacement_cm", printed_cm(slip)}, {"inverse_displacement_cm", 0.0}}}};
}

/// A column so stiff that it is a rigid block: H = 5 m, T_s = 4 ms.
inline Json stiff_column(int number, const std::string& method, double target_g, double yield_g)
{
    Json one = rigid(number, target_g, yield_g);
    one["analysis_id"] = fmt::format("analysis_{:04d}_{}", number, method);
    one["analysis"] = {{"method", method}, {"mode", "linear_elastic"}};
    one["site_parameters"].update(
        {{"height_m", 5.0}, {"vs_slope_mps", 5000.0}, {"vs_base_mps", 5000.0}, {"damping_ratio", 0.2}});
    one["results"].update({{"kmax", std::round(1e5 * accel_of(target_g) / units::standard_gravity) / 1e5},
                           {"vs_final_mps", 5000.0},
                           {"damping_final", 0.2}});
    return one;
}

class SlammerFolder : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / fmt::format("damslip_slammer_{}", ::getpid());
        std::filesystem::create_directories(folder / "records");
        std::string text = "# Time Series: Pulse 2000 - ONE-090\n# Time (s),Acceleration (g's)\n";
        for (int k = 0; k * record_dt <= 2.0 * ramp + plateau + 2.0 * record_dt; ++k) {
            const double t = k * record_dt, end = 2.0 * ramp + plateau;
            text +=
                fmt::format("{:.10g},{:.12g}\n", t, record_peak_g * std::clamp(std::min(t, end - t) / ramp, 0.0, 1.0));
        }
        text += [] { // at rest while the slowest blocks come to rest, as their scheme ends with the record
            std::string rest;
            for (int k = 73; k <= 600; ++k) rest += fmt::format("{:.10g},0.0\n", k * record_dt);
            return rest;
        }();
        write_file(folder / "records" / record_name, text);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    void write_set(const std::vector<Json>& analyses) const
    {
        write_packed(Json{{"schema_version", "1"}, {"analyses", analyses}}.dump());
    }
    void write_packed(const std::string& text) const
    {
        const std::unique_ptr<gzFile_s, int (*)(gzFile)> out(gzopen(set_file().c_str(), "wb"), gzclose);
        if (!out ||
            gzwrite(out.get(), text.data(), static_cast<unsigned>(text.size())) != static_cast<int>(text.size()))
            throw std::runtime_error("cannot write " + set_file());
    }
    std::string set_file() const { return (folder / "slammer_results.json.gz").string(); }

    std::filesystem::path folder;
};

} // namespace damslip::slammer_tests
