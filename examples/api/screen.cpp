// A dam as a rigid block: yield acceleration, and the slip under each record of its scene.  screen SCENE
#include "analysis/prepare/ready.hpp"
#include "analysis/screen/screening.hpp"
#include "core/input_error.hpp"
#include "scene/read.hpp"

#include <cstdio>

using namespace damslip;

int main(int, char** argv)
try {
    // Reads the records, decides what the scene leaves open, leaves out what it does not call for.
    const Ready ready = prepare(read_scene(argv[1]), Method::rigid_block);
    const Screening screening = run_screening(ready);
    std::printf("yield acceleration  %.6f m/s2\n", screening.bases.front().model.downstream.law.constant);
    for (const SlipRow& row : screening.slips)
        std::printf("%s, polarity %+d: slip %.4f mm, %s\n", row.record.c_str(), row.polarity, 1e3 * row.judged().slip,
                    word(row.judged().status).c_str());
} catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what()); // file, line, value, what is allowed, what to do
    return exit_input;
}
