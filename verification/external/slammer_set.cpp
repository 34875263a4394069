#include "verification/external/slammer_set.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <zlib.h>

namespace damslip::external {

namespace {

std::string unpacked(const std::filesystem::path& file)
{
    const auto bad = [&](const char* why) {
        return InputError(Diagnostic{file.string(), 0, 0, why, "the results of SLAMMER 1.1 as JSON, gzip-compressed",
                                     "name the folder that holds it"});
    };
    const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(file.c_str(), "rb"), gzclose);
    if (!in) throw bad("cannot be opened.");
    std::string text;
    char part[65536];
    int n = 0;
    while ((n = gzread(in.get(), part, sizeof part)) > 0) text.append(part, static_cast<std::size_t>(n));
    if (n < 0) throw bad("is damaged.");
    return text;
}

struct Samples {
    std::shared_ptr<const std::vector<double>> g;
    double dt = 0.0, peak = 0.0; ///< [s], [g]
};

/// Lines of time and acceleration in g, headings before.
Samples read_samples(const std::filesystem::path& file)
{
    std::istringstream in(read_file(file));
    std::vector<double> accel;
    double first = 0.0, time = 0.0, value = 0.0;
    Samples samples;
    for (std::string line; std::getline(in, line);) {
        std::istringstream fields(line);
        char comma = 0;
        if (!(fields >> time >> comma >> value)) continue;
        if (accel.empty()) first = time;
        if (accel.size() == 1) samples.dt = time - first;
        accel.push_back(value);
        samples.peak = std::max(samples.peak, std::abs(value));
    }
    if (accel.size() < 2 || !(samples.dt > 0.0))
        throw InputError(Diagnostic{file.string(), 0, 0, "holds no record.", "lines of time [s] and acceleration [g]",
                                    "get the set anew"});
    samples.g = std::make_shared<const std::vector<double>>(std::move(accel));
    return samples;
}

SlammerAnalysis analysis_of(const nlohmann::json& a, const Samples& record)
{
    const auto &ground = a.at("ground_motion_parameters"), &site = a.at("site_parameters"), &found = a.at("results");
    SlammerAnalysis one;
    one.id = a.at("analysis_id");
    one.method = a.at("analysis").at("method");
    one.samples = record.g;
    one.dt = record.dt;
    const double target = ground.at("target_pga_g");
    one.scale =
        target / (std::round(1e3 * record.peak) / 1e3) * units::standard_gravity; // it knows the peak to three decimals
    const double yield_g = site.at("ky_g");
    one.yield = yield_g * units::standard_gravity;
    one.published[0] = found.at("normal_displacement_cm");
    one.published[1] = found.at("inverse_displacement_cm");
    one.words = fmt::format("{} {}, {:g} g, a_y {:g} g", ground.at("earthquake").get<std::string>(),
                            ground.at("record_station").get<std::string>(), target, yield_g);
    if (one.method == "rigid") return one;
    one.height = site.at("height_m");
    one.k_max = found.at("kmax").get<double>();
    one.final_velocity = found.at("vs_final_mps");
    one.final_damping = found.at("damping_final");
    const double velocity = site.at("vs_slope_mps");
    one.words += fmt::format(", {:g} m of {:g} m/s", one.height, velocity);
    if (a.at("analysis").at("mode") == "equivalent_linear")
        one.strain = StrainColumn{one.height, velocity, site.at("vs_base_mps"), site.at("damping_ratio"),
                                  site.at("reference_strain")};
    return one;
}

} // namespace

std::vector<double> SlammerAnalysis::accel(double polarity) const
{
    std::vector<double> all = *samples;
    for (double& a : all) a *= polarity * scale;
    return all;
}

SlammerColumn SlammerAnalysis::column() const
{
    return {std::numbers::pi * final_velocity / (2.0 * height), final_damping};
}

std::vector<SlammerAnalysis> read_slammer_set(const std::filesystem::path& folder)
{
    const std::filesystem::path file = folder / slammer_file;
    std::map<std::string, Samples> records;
    std::vector<SlammerAnalysis> all;
    try {
        const nlohmann::json set = nlohmann::json::parse(unpacked(file));
        for (const auto& a : set.at("analyses")) {
            const std::string name = a.at("ground_motion_parameters").at("ground_motion_file");
            auto record = records.find(name);
            if (record == records.end()) record = records.emplace(name, read_samples(folder / "records" / name)).first;
            all.push_back(analysis_of(a, record->second));
        }
    } catch (const nlohmann::json::exception& error) {
        throw InputError(Diagnostic{file.string(), 0, 0, fmt::format("is not the set: {}.", error.what()),
                                    "the results of SLAMMER 1.1 as JSON", "name the folder that holds it"});
    }
    return all;
}

} // namespace damslip::external
