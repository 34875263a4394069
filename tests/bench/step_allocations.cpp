// Allocations of memory per time step, once the first ten steps are done: the aim is none.
#include "fe2d/reduction/reduced_run.hpp"
#include "scene/rock_mass.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

thread_local long allocations = 0; // of this thread: the runs below have one
}

// glibc's own functions under names that nobody replaces. operator new and Eigen come through here, too.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size)
{
    ++allocations;
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size)
{
    ++allocations;
    return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size)
{
    ++allocations;
    return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size)
{
    ++allocations;
    return __libc_memalign(alignment, size);
}
}

namespace {

using namespace damslip;

constexpr long first_steps = 10; ///< make operators and work space
constexpr int last_step = 2000;  ///< with the ground moving

/// Counts at both ends, as the run's progress passes them.
struct Counter {
    long from = 0, to = 0;

    fe2d::RunAnswer at(const fe2d::RunProgress& p)
    {
        if (p.step == first_steps) from = allocations;
        if (p.step == last_step) to = allocations;
        return fe2d::RunAnswer::go_on;
    }
    double per_step() const { return static_cast<double>(to - from) / static_cast<double>(last_step - first_steps); }
};

void count(const char* name, bool radiates, bool reduced)
{
    Scene scene = fe2d::test::sliding_dam(0.77, 1.0, 0.5);
    scene.mesh.size = 2.0;
    scene.mesh.growth = 1.3;
    scene.time.substeps = 0;
    scene = radiates ? with_radiating_rock(scene) : with_massless_rock(scene);
    fe2d::RunOptions options = fe2d::test::options_of(scene);
    Counter counter;
    options.progress = [&](const fe2d::RunProgress& p) { return counter.at(p); };
    const fe2d::EarthquakeRun run(scene, options);
    const GroundMotion motion = fe2d::test::sines(1.0);
    const double slip =
        reduced ? fe2d::ReducedRun(run, scene, options).run(motion, {}, {}, fe2d::TruncationEstimate::left_out).slip
                : run.run(motion).slip;
    std::printf("%-32s %10.2f %12.3f\n", name, counter.per_step(), 1e3 * slip);
}

} // namespace

int main()
{
    std::printf("%-32s %10s %12s\n", "steps 10 to 2000 of", "a step", "slip [mm]");
    count("exact contact, massless rock", false, false);
    count("exact contact, radiating rock", true, false);
    count("reduced, 12 modes", false, true);
    return 0;
}
