// One scene, one question, every command: the slip of each record and polarity by one method, the state after the earthquake,
// the scene's hash. tests/python/test_same_bits.py has Python beside the program on the same scene.
#include "analysis/assess/assess.hpp"
#include "core/file.hpp"
#include "csv_rows.hpp"
#include "program_answer.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <unistd.h>

namespace {

using namespace damslip;
using nlohmann::json;

const std::string scene = std::string(source_dir()) + "/tests/audit3/same_question/dam.toml";

/// By polarity [mm].
using Slips = std::map<int, double>;

json ask(std::vector<std::string> command, const std::string& scene = ::scene)
{
    command.insert(command.begin() + 1, scene);
    command.insert(command.end(), {"--json", "--quiet"});
    const ProgramAnswer a = answer_of(command);
    EXPECT_EQ(a.code, 0) << a.talk;
    json answer = json::parse(a.out, nullptr, false);
    if (answer.contains("scene")) {
        EXPECT_EQ(answer["scene"]["hash"], scene_hash(read_scene(scene))) << command.front();
    }
    return answer;
}

/// @param only  key and value of the rows that count; none: all
Slips slips_of(const json& rows, const char* key, double in_mm = 1.0, std::pair<const char*, const char*> only = {})
{
    Slips slips;
    for (const json& row : rows)
        if (!only.first || row[only.first] == only.second) {
            EXPECT_EQ(row["record"], "pulses");
            EXPECT_TRUE(slips.emplace(row["polarity"].get<int>(), in_mm * row[key].get<double>()).second);
        }
    return slips;
}

/// The scene, in other words, beside its record.
void write_copy(const std::filesystem::path& folder, const std::string& text)
{
    std::filesystem::create_directories(folder);
    std::filesystem::copy(std::filesystem::path(scene).parent_path() / "pulses.csv", folder);
    write_file(folder / "dam.toml", text);
}

/// The rows of the level that is the record's own PGA. @param more  tables of the scene
std::vector<std::map<std::string, std::string>> fragility_rows(const std::string& method, const std::string& more = "")
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("damslip_same_answer_" + std::to_string(::getpid()));
    write_copy(folder, read_file(scene) + more);
    const ProgramAnswer a = answer_of({"fragility", folder / "dam.toml", "--method", method, "--out", folder / "out"});
    EXPECT_EQ(a.code, 0) << a.talk;
    auto rows = csv_rows(read_file(folder / "out" / "samples.csv"));
    std::erase_if(rows, [](auto& row) { return row["factor"] != "1"; });
    std::filesystem::remove_all(folder);
    return rows;
}

Slips slips_of(const std::vector<std::map<std::string, std::string>>& samples)
{
    Slips slips;
    for (const auto& row : samples) slips[std::stoi(row.at("polarity"))] = std::stod(row.at("slip_mm"));
    return slips;
}

void expect_same(const Slips& expected, const Slips& found, const char* who)
{
    ASSERT_EQ(found.size(), 2u) << who;
    for (const auto& [polarity, slip] : expected) EXPECT_DOUBLE_EQ(found.at(polarity), slip) << who << ' ' << polarity;
}

TEST(Audit3, TheSameQuestionHasTheSameAnswer)
{
    const json screen = ask({"screen"}), fe = ask({"fe", "--no-mesh-error"}),
               sweep = ask({"sweep", "--method", "rigid,rigid-v,fe"})["rows"];
    const Slips horizontal = slips_of(screen["displacements"], "slip_h_mm"),
                rigid = slips_of(screen["displacements"], "slip_hv_mm"), elastic = slips_of(fe["runs"], "slip_mm");
    for (const Slips& slips : {horizontal, rigid, elastic}) { // the test can tell polarities and methods apart
        ASSERT_EQ(slips.size(), 2u);
        EXPECT_GT(slips.at(1), 3.0 * slips.at(-1));
    }
    EXPECT_GT(rigid.at(1), 1.005 * horizontal.at(1));
    EXPECT_GT(elastic.at(1), 1.05 * rigid.at(1));

    expect_same(horizontal, slips_of(sweep, "slip_m", 1e3, {"method", "rigid"}), "sweep, rigid");
    expect_same(horizontal, slips_of(ask({"accuracy", "--rung", "rigid:h"})["runs"], "slip_mm"), "accuracy, rigid:h");
    expect_same(horizontal, slips_of(fragility_rows("rigid")), "fragility, rigid");

    const std::pair full{"effect", "(all effects)"};
    expect_same(rigid, slips_of(fe["runs"], "slip_rigid_mm"), "fe, rigid block beside");
    expect_same(rigid, slips_of(sweep, "slip_m", 1e3, {"method", "rigid-v"}), "sweep, rigid-v");
    expect_same(rigid, slips_of(ask({"accuracy", "--rung", "rigid:h+v"})["runs"], "slip_mm"), "accuracy, rigid:h+v");
    expect_same(rigid, slips_of(ask({"explain", "--ablate"})["ablation"]["changes"], "slip_mm", 1.0, full), "ablation");
    expect_same(rigid, slips_of(fragility_rows("rigid-v")), "fragility, rigid-v");

    const auto samples = fragility_rows("fe", "[[limit]]\nquantity = \"post-seismic-fs\"\nbelow = 1.1\n");
    ask({"fragility", "--method", "fe"}); // its hash
    expect_same(elastic, slips_of(sweep, "slip_m", 1e3, {"method", "fe"}), "sweep, fe");
    expect_same(elastic, slips_of(ask({"accuracy", "--rung", "fe-added-mass:scene"})["runs"], "slip_mm"),
                "accuracy, fe");
    expect_same(elastic,
                slips_of(ask({"explain", "--ablate", "--method", "fe"})["ablation"]["changes"], "slip_mm", 1.0, full),
                "ablation, fe");
    expect_same(elastic, slips_of(samples), "fragility, fe");

    Watch nobody;
    const Assessment assessed = assess(read_scene(scene), {60.0, 1}, nobody);
    Slips block, model;
    for (const SlipRow& slip : assessed.screening.slips) block[slip.polarity] = 1e3 * slip.judged().slip;
    for (const ContactRun& run : assessed.runs) model[run.polarity] = 1e3 * run.fe.slip;
    expect_same(rigid, block, "assess, rigid block");
    expect_same(elastic, model, "assess, fe");

    // Drains no longer work and the bond is gone: the sliding factor after the earthquake.
    const auto factor = [](const json& combinations) {
        for (const json& row : combinations)
            if (row["combination"] == "post-seismic") return row["sliding_factor"].get<double>();
        return 0.0;
    };
    const double after = factor(screen["limit_equilibrium"]);
    EXPECT_LT(after, 0.8 * screen["limit_equilibrium"][0]["sliding_factor"].get<double>());
    EXPECT_DOUBLE_EQ(factor(ask({"assess"})["limit_equilibrium"]), after);
    int stages = 0;
    for (const json& row : fe["stages"])
        if (row["stage"] == "after the earthquake") {
            EXPECT_NEAR(row["sliding_factor"].get<double>(), after, 1e-9 * after);
            ++stages;
        }
    EXPECT_EQ(stages, 2);
    for (const auto& row : samples) EXPECT_NEAR(std::stod(row.at("factor_after")), after, 1e-9 * after);
}

/// Eight seconds of three sines with the peak of pulses.csv, and its columns.
std::string swaying()
{
    std::vector<double> time, h, v;
    double peak = 0.0;
    for (int i = 0; i <= 800; ++i) {
        const double turn = 2.0 * std::numbers::pi * 0.01 * i, strength = std::sin(turn / 16.0);
        time.push_back(0.01 * i);
        h.push_back(strength * (4.0 * std::sin(2.0 * turn) + 1.5 * std::sin(5.3 * turn) + 0.6 * std::sin(0.7 * turn)));
        v.push_back(strength * std::sin(3.0 * turn));
        peak = std::max(peak, std::abs(h.back()));
    }
    std::string rows = "time_s,horizontal_m_s2,vertical_m_s2\n";
    for (std::size_t i = 0; i < h.size(); ++i) rows += fmt::format("{:.2f},{:.6f},{:.6f}\n", time[i], 6.0 * h[i] / peak, v[i]);
    return rows;
}

/// Where nothing says how small, the steps are chosen, and few modes of the dam correct their slip.
TEST(Audit3, CorrectedStepsAreThoseOfEveryCommand)
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("damslip_corrected_steps_" + std::to_string(::getpid()));
    std::string text = read_file(scene);
    const std::string fixed = "[time]\nsubsteps = 1\n";
    ASSERT_NE(text.find(fixed), std::string::npos);
    write_copy(folder, text.erase(text.find(fixed), fixed.size()));
    write_file(folder / "pulses.csv", swaying());
    const std::string dam = folder / "dam.toml";
    const json runs = ask({"fe", "--no-mesh-error"}, dam)["runs"];
    const Slips elastic = slips_of(runs, "slip_mm");
    ASSERT_EQ(elastic.size(), 2u);
    int corrected = 0;
    for (const json& run : runs) corrected += run["step_correction_mm"].is_number();
    EXPECT_GE(corrected, 1);
    expect_same(elastic, slips_of(ask({"sweep", "--method", "fe"}, dam)["rows"], "slip_m", 1e3), "sweep");
    expect_same(elastic, slips_of(ask({"accuracy", "--rung", "fe-added-mass:scene"}, dam)["runs"], "slip_mm"), "accuracy");
    answer_of({"fragility", dam, "--method", "fe", "--out", folder / "out"}); // two motions are few for a P: not code 0
    auto rows = csv_rows(read_file(folder / "out" / "samples.csv"));
    std::erase_if(rows, [](auto& row) { return row["factor"] != "1"; });
    expect_same(elastic, slips_of(rows), "fragility");
    std::filesystem::remove_all(folder);
}

} // namespace
