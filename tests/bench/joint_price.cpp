// What a law of the joint costs: processor seconds of a run with it over those of the same run without, steps and record alike.
#include "analysis/prepare/ready.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "scene/read.hpp"
#include "source_dir.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace damslip;

constexpr int default_repeats = 3;

double processor_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Law {
    std::string name;
    std::function<void(Scene&)> change;
};

Law bond(double cohesion)
{
    return {"bond " + std::to_string(static_cast<int>(cohesion / 1e3)) + " kPa", [cohesion](Scene& scene) {
                scene.contact.cohesion = cohesion;
                scene.contact.bond.tensile_strength = 0.5 * cohesion;
                scene.contact.bond.shear_energy = 1500.0;
                scene.contact.bond.tension_energy = 150.0;
            }};
}

Law reynolds(double clearance)
{
    return {"reynolds " + std::to_string(static_cast<int>(1e3 * clearance)) + " mm", [clearance](Scene& scene) {
                scene.uplift->water.opening = OpeningWater::reynolds;
                scene.uplift->water.clearance = clearance;
            }};
}

void no_law(Scene& scene)
{
    scene.contact.cohesion = 0.0;
    scene.contact.bond = {};
    if (scene.uplift) scene.uplift->water = {};
}

/// A dam, its motion times `scale` in steps of dt/4, its base in elements of one length.
struct Case {
    std::string scene;
    double contact_size; ///< [m]
    double scale;        ///< of the motion [-]
    std::vector<Law> laws;
};

struct Timed {
    std::string name;
    std::shared_ptr<fe2d::EarthquakeRun> run;
    std::vector<double> seconds;
    fe2d::RunResult last;
};

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Runs take turns, so that what else the machine does falls on all of them.
void measure(const Case& c, int repeats)
{
    const Watch nobody;
    Scene plain = read_scene(std::string(source_dir()) + "/examples/" + c.scene);
    no_law(plain);
    plain.mesh.contact_size = c.contact_size;
    plain.mesh.size = 2.0;
    plain.time.substeps = 2;
    std::vector<Timed> runs;
    GroundMotion motion;
    const auto add = [&](const std::string& name, const Scene& scene) {
        const Ready ready = prepare(scene, Method::finite_elements);
        fe2d::RunOptions options = ready.run_options(nobody);
        options.rock_cache = std::filesystem::temp_directory_path() / "damslip-joint-price";
        runs.push_back({name, std::make_shared<fe2d::EarthquakeRun>(ready.scene, options), {}, {}});
        motion = ready.motion(ready.records().front(), c.scale);
    };
    add("none", plain);
    for (const Law& law : c.laws) {
        Scene changed = plain;
        law.change(changed);
        add(law.name, changed);
    }
    for (int repeat = 0; repeat < repeats; ++repeat)
        for (Timed& timed : runs) {
            const double start = processor_seconds();
            timed.last = timed.run->run(motion);
            timed.seconds.push_back(processor_seconds() - start);
        }
    const double without = median(runs.front().seconds);
    for (const Timed& timed : runs) {
        const auto& n = timed.last.counts;
        std::printf("%-20s %5d %5.1f | %-14s | %7.3f | %5.2f | %6d %5.2f %5d %5d | %9.2f mm\n", c.scene.c_str(),
                    static_cast<int>(timed.last.pair_area.size()), c.scale, timed.name.c_str(), median(timed.seconds),
                    median(timed.seconds) / without, n.steps, static_cast<double>(n.contact_iterations) / n.steps,
                    n.halved, n.unresolved, 1e3 * timed.last.slip);
    }
    std::fflush(stdout);
}

} // namespace

/// joint_price [REPEATS [CASE]]: all cases, or the one with that number, from 1 on
int main(int count, char** words)
{
    const int repeats = count > 1 ? std::max(1, std::atoi(words[1])) : default_repeats;
    const int only = count > 2 ? std::atoi(words[2]) : 0;
    std::printf(
        "median of %d runs in turn, steps of dt/4, set-up left out\n%-20s %5s %5s | %-14s | %7s | %5s | %6s %5s "
        "%5s %5s | %12s\n",
        repeats, "scene", "pairs", "scale", "law", "seconds", "ratio", "steps", "iter", "halv.", "unr.", "slip");
    const std::vector<Law> bonds{bond(0.6e6), bond(2e6), bond(5e6)}, waters{reynolds(1e-3), reynolds(3e-3)};
    const Case cases[] = {{"bonded_dam.toml", 0.75, 1.0, bonds},
                          {"bonded_dam.toml", 0.1875, 1.0, bonds},
                          {"opening_water.toml", 0.9, 0.5, waters},
                          {"opening_water.toml", 0.9, 1.0, waters},
                          {"opening_water.toml", 0.9, 2.0, waters}};
    for (int i = 0; i < static_cast<int>(std::size(cases)); ++i)
        if (only == 0 || only == i + 1) measure(cases[i], repeats);
}
