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
    for (std::size_t i = 0; i < accuracy.model_levels.size(); ++i) {
        const ModelLevelResult& model_level = accuracy.model_levels[i];
        const ModelLevelVerdict& verdict = accuracy.judgement.model_levels[i];
        if (model_level.done())
            std::printf("%-28s %9.4f mm  %8.3g s  off by %s\n", model_level_id(model_level.model_level).c_str(), 1e3 * model_level.largest_slip(),
                        model_level.seconds, verdict.deviation ? std::to_string(*verdict.deviation).c_str() : "?");
        else
            std::printf("%-28s %s\n", model_level_id(model_level.model_level).c_str(), model_level.remark.c_str());
    }
    if (accuracy.judgement.choice)
        std::printf("cheapest within 2 %%: %s\n", model_level_id(accuracy.model_levels[*accuracy.judgement.choice].model_level).c_str());
} catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return exit_input;
}
