// A dam by finite elements: the slip under each record with its numerical error and verdict.  fe SCENE
#include "analysis/fe/contact_runs.hpp"
#include "core/input_error.hpp"
#include "scene/read.hpp"

#include <cstdio>

using namespace damslip;

int main(int, char** argv)
try {
    Watch watch; // silent; derive your own for progress and for stopping: see sweep.cpp
    const Ready ready = prepare(read_scene(argv[1]), Method::finite_elements);
    if (ready.reservoir) std::printf("%s\n", ready.reservoir->reason.c_str());
    ContactRuns models(ready, FeOptions{}, watch); // mesh, matrices, rock condensed to the base
    for (const ContactRun& run : models.run())
        std::printf("%s: slip %.4f mm +- %.2g mm (%s), %s, verdict %s\n", run.label().c_str(), 1e3 * run.fe.slip,
                    1e3 * slip_error(run).total, slip_error(run).parts().c_str(), word(run.fe.status).c_str(),
                    word(verdict_of(run, ready.scene.criteria.allowable_slip)).c_str());
} catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return exit_input;
} catch (const NotConverged& error) { // a solver found no answer: nothing is known of the dam
    std::fprintf(stderr, "%s\n", error.what());
    return exit_no_answer;
}
