// Slip over friction, rigid block and finite elements, with progress; Ctrl-C prints what is finished.  sweep SCENE
#include "analysis/sweep/sweep_run.hpp"
#include "core/status.hpp"
#include "scene/read.hpp"

#include <csignal>
#include <cstdio>

using namespace damslip;

volatile std::sig_atomic_t stopped = 0;

struct Percent final : Watch {
    bool stop_asked() const override { return stopped != 0; }
    void begin(const std::string& label, double total) override { label_ = label, total_ = total; }
    void at(double done) override { std::fprintf(stderr, "\r%s %3.0f %% ", label_.c_str(), total_ > 0 ? 100 * done / total_ : 100.0); }
    std::string label_;
    double total_ = 1.0;
};

int main(int, char** argv)
try {
    std::signal(SIGINT, [](int) { stopped = 1; });
    const Scene scene = read_scene(argv[1]);
    Axes axes = axes_of(scene); // one value each: the scene's own
    axes.friction = {0.7, 0.8, 0.9};
    axes.method = {sweep_method("rigid"), sweep_method("fe")};
    const Sweep sweep = make_sweep(scene, axes);
    Percent watch;
    const SweepOutcome outcome = run_sweep(sweep, watch);
    for (const FinishedRow& row : outcome.rows) {
        const GridIndex at = sweep.tasks.index(row.id);
        std::printf("%-5s mu = %.2f: slip %.4f mm, %s\n", axes.method[at.method].id.c_str(),
                    axes.friction[at.friction], 1e3 * row.results.slip.value_or(0.0), row.results.status.c_str());
    }
    return outcome.complete() ? exit_ok : exit_no_answer; // a run_sweep() with a ResultStore can go on later
} catch (const std::exception& error) { // bad input, with file, line and fix; or a solver without an answer
    std::fprintf(stderr, "%s\n", error.what());
    return exit_input;
}
