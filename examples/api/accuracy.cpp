// What accuracy costs: every way to compute the slip of a scene with its seconds and its error.  accuracy SCENE
#include "analysis/accuracy/accuracy.hpp"
#include "core/input_error.hpp"
#include "scene/read.hpp"

#include <cstdio>

using namespace damslip;

int main(int, char** argv)
try {
    const Watch nobody; // silent, never stops
    const Accuracy accuracy = measure_accuracy(read_scene(argv[1]), 0.02, Effort::quick, nobody);
    for (std::size_t i = 0; i < accuracy.rungs.size(); ++i) {
        const RungResult& rung = accuracy.rungs[i];
        const RungVerdict& verdict = accuracy.judgement.rungs[i];
        if (rung.done())
            std::printf("%-28s %9.4f mm  %8.3g s  off by %s\n", rung_id(rung.rung).c_str(), 1e3 * rung.largest_slip(),
                        rung.seconds, verdict.deviation ? std::to_string(*verdict.deviation).c_str() : "?");
        else
            std::printf("%-28s %s\n", rung_id(rung.rung).c_str(), rung.remark.c_str());
    }
    if (accuracy.judgement.choice)
        std::printf("cheapest within 2 %%: %s\n", rung_id(accuracy.rungs[*accuracy.judgement.choice].rung).c_str());
} catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return exit_input;
}
