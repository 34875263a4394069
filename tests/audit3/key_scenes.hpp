#pragma once

#include "core/file.hpp"
#include "program_answer.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

/// A dam of few elements and a record of three seconds, for tests that run it many times.
namespace damslip::audit3 {

using Json = nlohmann::json;

/// Tables of a scene by name; a table of a list has the name "name[]".
using Tables = std::vector<std::pair<std::string, std::vector<std::pair<std::string, std::string>>>>;

inline Tables small_dam()
{
    return {{"section", {{"height_m", "30"}, {"base_m", "24"}, {"crest_m", "4"}}},
            {"dam", {{"density_kg_m3", "2400"}, {"young_modulus_GPa", "20"}, {"poisson_ratio", "0.2"}}},
            {"contact", {{"friction", "0.8"}}},
            {"reservoir", {{"level_m", "26"}, {"model", "\"added-mass\""}}},
            {"uplift", {{"model", "\"linear\""}}},
            {"criteria", {{"allowable_slip_mm", "1000"}}},
            {"mesh", {{"size_m", "8"}, {"contact_size_m", "4"}}},
            {"time", {{"substeps", "1"}}},
            {"sliding", {{"run_out_max_s", "2"}}},
            {"motion", {{"polarity", "1"}}},
            {"motion.record[]",
             {{"name", "\"a\""},
              {"horizontal", "\"h.csv\""},
              {"vertical", "\"v.csv\""},
              {"unit", "\"m/s2\""}}}};
}

/// "drains.distance_m" in its table, made where there is none; value "-": without the key, or the table "drains" with all.
inline void set(Tables& tables, const std::string& path, const std::string& value)
{
    const bool whole = value == "-" && path.find("[]") == std::string::npos &&
                       std::any_of(tables.begin(), tables.end(), [&](const auto& t) { return t.first == path; });
    if (whole) {
        std::erase_if(tables, [&](const auto& t) { return t.first == path; });
        return;
    }
    const std::size_t dot = path.rfind('.');
    const std::string name = path.substr(0, dot), key = path.substr(dot + 1);
    auto table = std::find_if(tables.begin(), tables.end(), [&](const auto& t) { return t.first == name; });
    if (table == tables.end()) table = tables.insert(tables.end(), {name, {}});
    std::erase_if(table->second, [&](const auto& k) { return k.first == key; });
    if (value != "-") table->second.emplace_back(key, value);
}

inline std::string toml_of(const Tables& tables)
{
    std::string text;
    for (const auto& [name, keys] : tables) {
        const bool list = name.ends_with("[]");
        text += list ? "[[" + name.substr(0, name.size() - 2) + "]]\n" : "[" + name + "]\n";
        for (const auto& [key, value] : keys) text += key + " = " + value + "\n";
    }
    return text;
}

/// A folder of this process with the records.
class KeyScene : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / fmt::format("damslip_keys_{}", ::getpid());
        std::filesystem::create_directories(folder);
        const auto record = [&](const char* name, auto&& accel) {
            std::string text = "t,a\n";
            for (int i = 0; i < 150; ++i)
                text += fmt::format("{:.2f},{:.5f}\n", 0.02 * i, i < 120 ? accel(0.02 * i) : 0.0);
            write_file(folder / name, text);
        };
        const auto sine = [](double amplitude, double frequency, double t) {
            return amplitude * std::sin(2.0 * M_PI * frequency * t);
        };
        record("h.csv", [&](double t) { return sine(3.2, 1.6, t) * std::min(1.0, t) + sine(1.5, 4.0, t); });
        record("v.csv", [&](double t) { return sine(2.0, 3.0, t); });
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    ProgramAnswer run(std::vector<std::string> command, const std::string& toml) const
    {
        const std::filesystem::path file = folder / "dam.toml";
        write_file(file, toml);
        command.insert(command.begin() + 1, file.string());
        return answer_of(command);
    }
    Json json(std::vector<std::string> command, const std::string& toml) const
    {
        command.emplace_back("--json");
        const ProgramAnswer answer = run(std::move(command), toml);
        EXPECT_EQ(answer.code, 0) << answer.talk << toml;
        return Json::parse(answer.out);
    }

    std::filesystem::path folder;
};

} // namespace damslip::audit3
