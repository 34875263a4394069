// Nanoseconds per sample and yield of the rigid-block integrators, and the error of SLAMMER's scheme.
//
// Runs every record with yields from 0.05 to 0.95 of its peak, one-way, and prints the best of several repetitions, with the ratio to the plain
// exact integrator of the same run. Without arguments the records are artificial: white noise through a ground filter under an envelope, seeded.
//   sliding_bench [FILE DT]...   text files of samples, lines with # skipped; the unit does not matter, yields follow the peak
#include "core/parallel.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/block/slide_batch.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

namespace {

using namespace damslip;
using namespace damslip::sliding;

/// White noise through an oscillator of 2.5 Hz and 60 % damping (Kanai-Tajimi) under a build-up and decay, exact zeros at both ends.
GroundMotion artificial(unsigned seed, double dt, double duration, double strong_from, double decay)
{
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    const double w = 2.0 * std::numbers::pi * 2.5, zeta = 0.6;
    GroundMotion motion{"artificial " + std::to_string(seed), dt, {0.0}, {}, {}};
    double u = 0.0, v = 0.0;
    for (double t = dt; t < duration; t += dt) {
        const double noise = uniform() + uniform() + uniform() + uniform();
        v += dt * (noise / std::sqrt(dt) - 2.0 * zeta * w * v - w * w * u);
        u += dt * v;
        const double envelope =
            t < strong_from ? t * t / (strong_from * strong_from) : std::exp(-decay * (t - strong_from));
        motion.accel_h.push_back(envelope * (2.0 * zeta * w * v + w * w * u));
    }
    motion.accel_h.push_back(0.0);
    return motion;
}

GroundMotion from_file(const char* path, double dt)
{
    GroundMotion motion{path, dt, {}, {}, {}};
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream numbers(line);
        for (double a; numbers >> a;) motion.accel_h.push_back(a);
    }
    return motion;
}

double peak(const GroundMotion& motion)
{
    double largest = 0.0;
    for (const double a : motion.accel_h) largest = std::max(largest, std::abs(a));
    return largest;
}

struct Cost {
    double cpu = 1e300;  ///< of all threads [s per call]
    double wall = 1e300; ///< [s per call]
};

/// Best of the repetitions, each of at least 50 ms.
template <typename Work>
Cost cost_per_call(Work&& work)
{
    using Clock = std::chrono::steady_clock;
    Cost best;
    for (int repetition = 0; repetition < 9; ++repetition) {
        const auto start = Clock::now();
        const std::clock_t cpu_start = std::clock();
        int calls = 0;
        double elapsed = 0.0;
        do {
            work();
            ++calls;
            elapsed = std::chrono::duration<double>(Clock::now() - start).count();
        } while (elapsed < 0.05);
        best.wall = std::min(best.wall, elapsed / calls);
        best.cpu = std::min(best.cpu, static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC / calls);
    }
    return best;
}

constexpr double ratios[] = {0.05, 0.10, 0.15, 0.20, 0.25, 0.30, 0.35, 0.40, 0.45, 0.50,
                             0.55, 0.60, 0.65, 0.70, 0.75, 0.80, 0.85, 0.90, 0.95};

void print_speed(std::vector<SkippingMotion>& motions)
{
    std::size_t samples = 0;
    for (const SkippingMotion& m : motions) samples += m.motion().accel_h.size();
    const double runs = static_cast<double>(samples) * std::size(ratios);
    const int polarity = 1;
    double sink = 0.0;
    const auto each = [&](auto&& slip) {
        for (const SkippingMotion& m : motions) {
            const double pga = peak(m.motion());
            for (const double ratio : ratios) sink += slip(m, ratio * pga);
        }
    };
    const auto constant = [&](Scan scan) {
        return cost_per_call([&] {
            each([&](const SkippingMotion& m, double a_y) {
                return slide_constant_yield(m, {a_y}, {polarity, 60.0, scan}).slip;
            });
        });
    };
    const Cost plain = constant(Scan::every_sample);
    const auto print = [&](const char* name, const Cost& cost, double times = 1.0) {
        std::printf("%-44s %8.3f %8.3f %8.2f\n", name, 1e9 * cost.cpu / (runs * times),
                    1e9 * cost.wall / (runs * times), plain.wall / cost.wall * times);
    };
    std::printf("%zu records, %zu samples, %zu yields of 0.05 to 0.95 of the peak; ns per sample and yield\n\n",
                motions.size(), samples, std::size(ratios));
    std::printf("%-44s %8s %8s %8s\n", "integrator", "CPU", "wall", "x plain");
    print("constant yield, every sample (plain)", plain);
    print("constant yield, skipping blocks", constant(Scan::skip_blocks));
    print("SLAMMER's scheme", cost_per_call([&] {
              each([&](const SkippingMotion& m, double a_y) {
                  return slammer_slip(m.motion().accel_h, m.motion().dt, a_y);
              });
          }));
    const auto general = [&](bool skipping) {
        return cost_per_call([&] {
            each([&](const SkippingMotion& m, double a_y) {
                RigidBlock block;
                block.mass = 1.0;
                block.friction = a_y / block.gravity;
                SlideOptions options;
                options.sliding.two_way = false;
                const SlipStages stages{{0.0, block, 0.0}};
                return (skipping ? slide(m, stages, options) : slide(m.motion(), stages, options)).slip;
            });
        });
    };
    print("block, ranges of the motion made each time", general(false));
    print("block, skipping blocks", general(true));
    print("block, four side by side", cost_per_call([&] {
              for (const SkippingMotion& m : motions) {
                  const double pga = peak(m.motion());
                  std::vector<SlipStages> stages;
                  for (const double ratio : ratios) {
                      RigidBlock block;
                      block.mass = 1.0;
                      block.friction = ratio * pga / block.gravity;
                      stages.push_back({{0.0, block, 0.0}});
                  }
                  std::vector<const SlipStages*> blocks;
                  for (const SlipStages& s : stages) blocks.push_back(&s);
                  SlideOptions options;
                  options.sliding.two_way = false;
                  sink += slide_together(m, blocks, options)[0].slip;
              }
          }));
    std::vector<ConstantYield> yields; // the batch has one list of yields for all records: of the mean peak
    double mean_peak = 0.0;
    for (const SkippingMotion& m : motions) mean_peak += peak(m.motion()) / static_cast<double>(motions.size());
    for (const double ratio : ratios) yields.push_back({ratio * mean_peak});
    std::vector<SkippingMotion> many; // enough work for starting threads not to count
    for (int i = 0; i < 50; ++i) many.insert(many.end(), motions.begin(), motions.end());
    for (const int jobs : {1, thread_count(0)}) {
        const std::string name = "batch, skipping blocks, threads: " + std::to_string(jobs);
        const auto batch = [&] {
            sink += slide_batch(many, yields, std::span(&polarity, 1), ConstantYieldOptions{}, jobs)[0].slip;
        };
        print(name.c_str(), cost_per_call(batch), 50.0);
    }
    if (sink == 0.123) std::printf("\n");
}

/// Relative slip error of SLAMMER's scheme, mean of the absolute values over the records.
void print_bias(const std::vector<SkippingMotion>& motions)
{
    std::printf("\nSLAMMER's scheme: |slip error| in %% of the exact slip, mean over the records; the record and its "
                "subdivisions\n%8s",
                "a_y/peak");
    for (const int parts : {1, 2, 4, 8}) std::printf("   dt/%d     ", parts);
    std::printf("\n");
    for (const double ratio : {0.05, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95}) {
        std::printf("%8.2f", ratio);
        for (const int parts : {1, 2, 4, 8}) {
            double sum = 0.0;
            for (const SkippingMotion& m : motions) {
                const std::vector<double>& a = m.motion().accel_h;
                const double a_y = ratio * *std::max_element(a.begin(), a.end());
                std::vector<double> fine;
                for (std::size_t k = 0; k + 1 < a.size(); ++k)
                    for (int i = 0; i < parts; ++i) fine.push_back(a[k] + (a[k + 1] - a[k]) * i / parts);
                fine.push_back(a.back());
                const double exact = slide_constant_yield(a, m.motion().dt, a_y).slip;
                sum += std::abs(slammer_slip(fine, m.motion().dt / parts, a_y) / exact - 1.0);
            }
            std::printf(" %10.4f", 100.0 * sum / static_cast<double>(motions.size()));
        }
        std::printf("\n");
    }
}

} // namespace

int main(int argc, char** argv)
{
    std::vector<SkippingMotion> motions;
    for (int i = 1; i + 1 < argc; i += 2) motions.emplace_back(from_file(argv[i], std::atof(argv[i + 1])));
    if (motions.empty()) {
        motions.emplace_back(artificial(1, 0.005, 40.0, 4.0, 0.15));
        motions.emplace_back(artificial(2, 0.005, 60.0, 8.0, 0.10));
        motions.emplace_back(artificial(3, 0.01, 40.0, 3.0, 0.20));
        motions.emplace_back(artificial(4, 0.02, 54.0, 2.0, 0.10));
    }
    print_speed(motions);
    print_bias(motions);
}
