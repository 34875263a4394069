// random_scenes [--mutated | --radiating] FIRST COUNT [FOLDER]: scenes of the seeds FIRST, FIRST + 1, ...; each is drawn
// (random_scene.hpp, with --radiating no rock massless; or a shipped example made worse, mutated_scene.hpp), written, run and checked (check_run.hpp, check_promise.hpp). What a scene breaks is printed and its files stay in FOLDER/SEED (default: a folder of the system's for scratch files). The
// folder of the scene under way is there while it runs, so a crash leaves it too.
//
// Environment: DAMSLIP_RANDOM_TALK says how each ended, DAMSLIP_RANDOM_KEEP keeps all files, DAMSLIP_RANDOM_SECONDS is the
// longest a scene may take (120; longer ends the program).
#include "random/check_promise.hpp"
#include "random/check_run.hpp"
#include "random/mutated_scene.hpp"
#include "random/random_scene.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <unistd.h>

int main(int argc, char** argv)
{
    using namespace damslip::random;
    const bool mutated = argc > 1 && std::strcmp(argv[1], "--mutated") == 0,
               radiating = argc > 1 && std::strcmp(argv[1], "--radiating") == 0;
    if (mutated || radiating) {
        ++argv;
        --argc;
    }
    if (argc < 3) {
        std::fprintf(stderr, "random_scenes [--mutated | --radiating] FIRST COUNT [FOLDER]\n");
        return 2;
    }
    const auto first = static_cast<std::uint32_t>(std::atol(argv[1])),
               count = static_cast<std::uint32_t>(std::atol(argv[2]));
    const std::filesystem::path folder =
        argc > 3 ? std::filesystem::path(argv[3])
                 : std::filesystem::temp_directory_path() / ("damslip-random-" + std::to_string(::getpid()));
    const char* seconds_text = std::getenv("DAMSLIP_RANDOM_SECONDS"); // a scene that takes longer is a finding
    const unsigned limit = seconds_text ? static_cast<unsigned>(std::atoi(seconds_text)) : 120;

    std::map<std::string, int> ends, commands;
    int broken = 0;
    double slowest = 0.0;
    std::uint32_t slowest_seed = first;
    for (std::uint32_t seed = first; seed < first + count; ++seed) {
        std::filesystem::remove_all(folder / std::to_string(seed));
        Draw draw = seeded(seed);
        const SceneFiles files = mutated     ? mutated_scene(draw)
                                 : radiating ? random_scene(draw, 1.0)
                                             : random_scene(draw);
        const std::filesystem::path scene = write(files, folder / std::to_string(seed));
        ::alarm(limit); // ends the program: the seed is the folder left behind
        const auto start = std::chrono::steady_clock::now();
        const CheckedRuns runs = mutated ? check_promise(scene, seed) : check_run(scene);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        ::alarm(0);
        if (seconds > slowest) {
            slowest = seconds;
            slowest_seed = seed;
        }
        for (const auto& [command, times] : runs.commands) commands[command] += times;
        ++ends[runs.status.empty() ? "refused (" + std::to_string(runs.fe_code) + ")" : runs.status];
        if (std::getenv("DAMSLIP_RANDOM_TALK"))
            std::printf("%u %.2fs %s %s\n", seed, seconds, runs.status.c_str(), runs.refusal.c_str());
        for (const std::string& finding : runs.findings) std::printf("seed %u: %s\n", seed, finding.c_str());
        if (runs.findings.empty() && !std::getenv("DAMSLIP_RANDOM_KEEP"))
            std::filesystem::remove_all(folder / std::to_string(seed));
        if (!runs.findings.empty()) ++broken;
        std::fflush(stdout);
    }
    std::printf("%u scenes:", count);
    for (const auto& [end, number] : ends) std::printf(" %d %s,", number, end.c_str());
    std::printf(" slowest %u with %.2f s\n", slowest_seed, slowest);
    for (const auto& [command, times] : commands) std::printf("%6d %s\n", times, command.c_str());
    if (broken > 0) std::printf("%d scenes broke a rule, kept in %s\n", broken, folder.c_str());
    return broken == 0 ? 0 : 1;
}
