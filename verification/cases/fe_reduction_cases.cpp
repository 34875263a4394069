#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/run/earthquake_pass.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/cases/modules.hpp"

#include <cmath>
#include <string>

namespace damslip::verification {

namespace {

/// Slip of reduced runs beside that of the full run, the same steps; and the estimate beside the true error.
std::vector<Check> slip_of_few_modes()
{
    std::vector<Check> checks;
    for (const double friction : {1.0, 0.77, 0.70, 0.66}) {
        Scene scene = fe2d::test::sliding_dam(friction);
        fe2d::RunOptions options = fe2d::test::options_of(scene);
        scene.time.substeps = 0;
        const fe2d::EarthquakeRun full(scene, options);
        const GroundMotion motion = fe2d::test::sines(1.0);
        const fe2d::RunResult whole = full.run(motion);
        const double slip = whole.slip;
        for (const int factor : {1, 4}) {
            const fe2d::ReducedRun reduced(full, scene, options, factor * fe2d::default_modes);
            const fe2d::RunResult result = reduced.run(motion);
            const std::string name =
                ", mu = " + std::to_string(friction).substr(0, 4) + ", " + std::to_string(result.modes) + " modes";
            checks.push_back({"slip" + name, "m", slip, result.slip, factor == 1 ? 1e-2 : 1e-3, Measure::relative});
            // At the end alone the error may be small by accident of signs; over time it is not.
            const double error = fe2d::largest_difference(result.history.slip, whole.history.slip);
            checks.push_back({"|log3| of estimate over error" + name, "-", 1.0,
                              std::abs(std::log(result.truncation_error / error) / std::log(3.0)), 0.0,
                              Measure::upper_bound});
        }
    }
    return checks;
}

} // namespace

void add_fe_reduction_cases(Registry& registry)
{
    registry.push_back({"fe.reduction.slip",
                        "On 12 and 48 elastic modes of the dam the slip is that of the full model, and the printed "
                        "error is its error.",
                        "the full model with the same steps and exact contact",
                        "1 % and 0.1 % are the claims of the reduced run; the estimate of the largest error over time "
                        "within a factor of 3",
                        slip_of_few_modes});
}

} // namespace damslip::verification
