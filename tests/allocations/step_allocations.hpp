#pragma once

#include "allocation_counter.hpp"

#include "fe2d/reduction/reduced_run.hpp"
#include "scene/rock_mass.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <vector>

/// How often the steps of a run ask for memory.
namespace damslip::test {

/// Runs of one dam, 20 s at 0.01 s, that slides some centimetres with hundreds of landings.
enum class CountedRun { massless, radiating, reduced };

struct StepAllocations {
    std::vector<long> by_step; ///< of step 2, 3, ... to the last but one of the motion
    double slip = 0.0;         ///< at the end [m]

    long after(std::size_t first) const ///< of all steps behind the first ones
    {
        long sum = 0;
        for (std::size_t k = first; k < by_step.size(); ++k) sum += by_step[k];
        return sum;
    }
    long steps_with_some(std::size_t first) const
    {
        long sum = 0;
        for (std::size_t k = first; k < by_step.size(); ++k) sum += by_step[k] > 0;
        return sum;
    }
};

/// @param mesh_size  away from the base [m] @param contact_size  on it [m]
inline StepAllocations count_allocations(CountedRun which, double mesh_size, double contact_size,
                                         double duration = 20.0)
{
    Scene scene = fe2d::test::sliding_dam(0.77, 1.0, contact_size);
    scene.mesh.size = mesh_size;
    scene.mesh.growth = 1.3;
    scene.time.substeps = 0;
    scene = which == CountedRun::radiating ? with_radiating_rock(scene) : with_massless_rock(scene);
    fe2d::RunOptions options = fe2d::test::options_of(scene);
    StepAllocations counted;
    const GroundMotion motion = fe2d::test::sines(1.0, duration);
    const std::size_t steps = motion.accel_h.size() - 3;
    counted.by_step.reserve(steps);
    long before = -1;
    options.progress = [&](const fe2d::RunProgress&) {
        if (before >= 0 && counted.by_step.size() < steps) counted.by_step.push_back(allocations() - before);
        before = allocations();
        return fe2d::RunAnswer::go_on;
    };
    const fe2d::EarthquakeRun run(scene, options);
    counted.slip =
        which == CountedRun::reduced
            ? fe2d::ReducedRun(run, scene, options).run(motion, {}, {}, fe2d::TruncationEstimate::left_out).slip
            : run.run(motion).slip;
    return counted;
}

} // namespace damslip::test
