// Every .toml of examples/ is read and held against the figures it states under [expect].
#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/rigid_model.hpp"
#include "analysis/prepare/reservoir.hpp"
#include "core/units.hpp"
#include "scene/read.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>

namespace {

using namespace damslip;

std::vector<std::filesystem::path> example_files()
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(source_dir()) + "/examples"))
        if (entry.path().extension() == ".toml" && entry.path().parent_path().filename() != "criteria") // no scenes
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// The quantities an example may state, from the rigid block.
const std::map<std::string, std::function<double(const RigidModel&)>> rigid_quantities{
    {"yield_acceleration_m_s2", [](const RigidModel& m) { return m.downstream.law.constant; }},
    {"yield_acceleration_upstream_m_s2", [](const RigidModel& m) { return m.upstream.law.constant; }},
    {"yield_coefficient_g", [](const RigidModel& m) { return m.downstream.law.constant / units::standard_gravity; }},
    {"critical_friction", [](const RigidModel& m) { return m.critical_friction; }},
    {"factor_of_safety", [](const RigidModel& m) { return m.wedge ? m.wedge->still.factor_of_safety : std::nan(""); }},
    {"uplift_N_m", [](const RigidModel& m) { return m.block.uplift; }},
};

double quantity_of(const RigidModel& model, const std::string& name)
{
    const auto quantity = rigid_quantities.find(name);
    EXPECT_NE(quantity, rigid_quantities.end()) << name << " is not a quantity this test knows";
    return quantity == rigid_quantities.end() ? std::nan("") : quantity->second(model);
}

TEST(Examples, StateWhatTheProgramComputes)
{
    int figures = 0;
    for (const auto& file : example_files()) {
        SCOPED_TRACE(file.filename().string());
        const Scene scene = read_scene(file);
        const RigidModel model = prepare(scene, Method::rigid_block, nullptr).rigid_model();
        for (const Expectation& e : scene.expectations) {
            const double computed = quantity_of(model, e.quantity);
            // Agreement to `digits` significant digits: half a unit in the last of them.
            const double unit = std::pow(10.0, std::floor(std::log10(std::abs(e.value))) - e.digits + 1);
            EXPECT_NEAR(computed, e.value, 0.5 * unit) << e.quantity << ", " << e.source;
            ++figures;
        }
    }
    EXPECT_GE(figures, 5); // an examples folder without figures tests nothing
}

} // namespace
