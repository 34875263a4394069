// Seconds of an FE run, part by part: 20 s record of 0.01 s steps, exact contact, everything included.
#include "verification/fe_run_scenes.hpp"

#include <cstdio>
#include <ctime>

namespace {

using namespace damslip;

/// Processor time of this program: what one core needs, whoever else uses the machine.
double processor_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void run_case(const char* name, double contact_size, double dam_size, double growth, double friction, int halvings)
{
    Scene scene = fe2d::test::sliding_dam(friction, 1.0, contact_size);
    scene.mesh.size = dam_size;
    scene.mesh.growth = growth;
    fe2d::RunOptions options = fe2d::test::options_of(scene);
    options.halvings = halvings;
    const GroundMotion motion = fe2d::test::sines(1.0);
    const double start = processor_seconds();
    const fe2d::EarthquakeRun run(scene, options);
    const double ready = processor_seconds();
    const fe2d::RunResult result = run.run(motion);
    const double end = processor_seconds();
    const auto& c = result.counts;
    std::printf("%-22s %6d %6d %5d %5.2f %6d | %8.3f %8.3f %8.3f %8.3f | %6.1f us %5.2f %3d %4d | %9.2f mm\n", name,
                run.model().dofs.count, static_cast<int>(run.structure().dam_unknowns()),
                static_cast<int>(run.structure().plane().pairs()), friction, c.steps, ready - start, end - ready,
                c.contact_seconds, end - start, 1e6 * (end - ready) / c.steps,
                static_cast<double>(c.contact_iterations) / c.steps, c.largest_iterations, c.unresolved,
                1e3 * result.slip);
}

} // namespace

int main()
{
    std::printf("processor seconds; contact is wall time within the run\n");
    std::printf("%-22s %6s %6s %5s %5s %6s | %8s %8s %8s %8s | %9s %5s %3s %4s | %s\n", "case", "dofs", "dam", "pairs",
                "mu", "steps", "set-up", "run", "contact", "all", "a step", "iter", "max", "unr.", "slip");
    for (const double friction : {1.0, 0.77, 0.70, 0.66}) run_case("7000 unknowns", 0.5, 2.0, 1.3, friction, 0);
    run_case("10000 unknowns", 0.5, 1.5625, 1.15, 0.77, 0);
    run_case("7000, 4 sub-steps", 0.5, 2.0, 1.3, 0.77, 2);
    run_case("default mesh", 0.75, 1.5625, 1.15, 0.77, 0);
    run_case("coarse", 2.5, 4.0, 1.15, 0.77, 0);
    return 0;
}
