// A loop of screenings over friction, for tests/bench/screen_loop.py to be compared with.  screen_loop SCENE COUNT
// Processor time by call [ms]: key set, scene checked, records read, screened on one thread.
#include "analysis/screen/screening.hpp"
#include "core/parallel.hpp"
#include "scene/scene_text.hpp"

#include <cstdio>
#include <cstdlib>

using namespace damslip;

int main(int argc, char** argv)
{
    if (argc != 3) return 2;
    const int count = std::atoi(argv[2]);
    const SceneText text = SceneText::read(argv[1]);
    double sum = 0.0;
    const ProcessorClock clock(ProcessorTimeOf::process);
    for (int i = 0; i < count; ++i) {
        const KeyChange change{"contact.friction", 0.7 + 0.1 * i / count};
        const Ready ready = prepare(text.with({&change, 1}), Method::rigid_block, {.flexible_modes = true});
        const Screening screening = run_screening(ready, 1);
        for (const SlipRow& row : screening.slips) sum += row.judged().slip;
    }
    std::printf("%.6f ms by call, slips %.17g m\n", 1e3 * clock.seconds() / count, sum);
}
