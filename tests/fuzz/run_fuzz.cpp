// Whole runs: the bytes choose a scene (its choices are taken from them four at a time, then from a generator they seed), which
// is written, run by `screen` and `fe`, and held against what every run has to keep to (random/check_run.hpp).
#include "random/check_run.hpp"
#include "random/random_scene.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <unistd.h>
#include <vector>

namespace {

using namespace damslip::random;

/// The bytes, then the generator.
Draw draw_from(const std::uint8_t* data, std::size_t size)
{
    std::uint32_t seed = 1;
    for (std::size_t k = 0; k < size; ++k) seed = 31 * seed + data[k];
    struct Source {
        std::vector<std::uint8_t> bytes;
        std::size_t at = 0;
        std::mt19937 more;
    };
    auto source = std::make_shared<Source>(Source{{data, data + size}, 0, std::mt19937(seed)});
    return Draw([source] {
        if (source->at + 4 > source->bytes.size()) return static_cast<std::uint32_t>(source->more());
        std::uint32_t bits = 0;
        std::memcpy(&bits, source->bytes.data() + source->at, 4);
        source->at += 4;
        return bits;
    });
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("damslip-run-fuzz-" + std::to_string(::getpid()));
    Draw draw = draw_from(data, size);
    std::filesystem::remove_all(folder);
    const CheckedRuns runs = check_run(write(random_scene(draw), folder));
    for (const std::string& finding : runs.findings) std::fprintf(stderr, "%s\n", finding.c_str());
    if (!runs.findings.empty()) {
        std::fprintf(stderr, "kept in %s\n", folder.c_str());
        std::abort();
    }
    std::filesystem::remove_all(folder);
    return 0;
}
