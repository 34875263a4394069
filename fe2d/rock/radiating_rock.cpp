#include "fe2d/rock/radiating_rock.hpp"

#include "core/stopwatch.hpp"
#include "fe2d/model/edge_dashpots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

namespace {

constexpr double ratio = 1.25;       ///< of neighbouring bands
constexpr double grid = 0x1p30;      ///< positions on it, per base length
constexpr double reference = 3.8147; ///< a_max of the default box, 1.25^6
constexpr const char* version = "2"; ///< to be raised with everything that changes what a reduction is

/// E = ρ = B = 1, origin at mid-base.
WaveBoxInput dimensionless(const RadiatingRockInput& input, double length)
{
    WaveBoxInput box;
    box.rock = {1.0, 1.0, input.rock.poisson_ratio};
    box.base = 1.0;
    const Point middle{0.5 * (input.heel.x + input.toe.x), 0.5 * (input.heel.y + input.toe.y)};
    for (const Point& p : input.surface)
        box.surface.push_back(
            {std::round((p.x - middle.x) / length * grid) / grid, std::round((p.y - middle.y) / length * grid) / grid});
    const double highest = frequency_band(input.highest_frequency * length / elastic_waves(input.rock).s);
    box.highest_frequency = highest * elastic_waves(box.rock).s;
    box.shape = wave_box_shape(highest, input.box_size);
    box.floor = input.floor;
    if (input.floor > 0) { // inside is longer by the floor, the sponge stays
        const double floor = box.surface[static_cast<std::size_t>(input.floor)].x - box.surface.front().x;
        box.middle = -0.5 * floor;
        box.shape.width += floor;
        box.shape.inner_width += floor;
    }
    return box;
}

/// Everything the reduction depends on, with all digits.
std::string key_of(const WaveBoxInput& box, const ReductionOptions& r)
{
    const WaveBoxShape& s = box.shape;
    std::string key = fmt::format("{} nu {:a} omega {:a} box {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a} {:a}", version,
                                  box.rock.poisson_ratio, box.highest_frequency, s.width, s.depth, s.inner_width,
                                  s.inner_depth, s.growth, s.per_wave, s.per_sponge, s.sponge_wave, s.sponge);
    key +=
        fmt::format(" reduction {:a} {:a} {:a} {} {} nodes", r.wanted, r.kept, r.sampling, r.checks, r.largest_rounds);
    if (box.floor > 0) key += fmt::format(" floor {}", box.floor);
    for (const Point& p : box.surface) key += fmt::format(" {:.0f} {:.0f}", p.x * grid, p.y * grid);
    return key;
}

} // namespace

double frequency_band(double highest)
{
    assert(highest > 0.0);
    return std::pow(ratio, std::ceil(std::log(highest) / std::log(ratio) - 1e-9));
}

WaveBoxShape wave_box_shape(double highest, double size)
{
    WaveBoxShape shape;
    const double share = std::clamp(reference / highest, 0.25, 3.0);
    constexpr double least_sponge = 0.5; // of what is inside [-]
    const auto whole = [&](double inner, double automatic) {
        return std::max((1.0 + least_sponge) * inner, size * (inner + share * (automatic - inner)));
    };
    shape.width = whole(shape.inner_width, shape.width);
    shape.depth = whole(shape.inner_depth, shape.depth);
    return shape;
}

RadiatingRock radiating_rock(const RadiatingRockInput& input, const RockStore& store)
{
    const Stopwatch watch;
    const double length = std::hypot(input.toe.x - input.heel.x, input.toe.y - input.heel.y);
    const WaveBoxInput box = dimensionless(input, length);
    const std::string key = key_of(box, input.reduction);

    RadiatingRock result;
    result.box = box.shape;
    result.resolved = box.highest_frequency / elastic_waves(box.rock).s * elastic_waves(input.rock).s / length;
    std::optional<ReducedRock> rock;
    if (const std::optional<std::string> bytes = store.find(key)) rock = from_bytes(*bytes, key);
    if (rock) {
        result.origin = RockOrigin::kept;
    } else {
        const WaveBox whole = make_wave_box(box);
        if (input.reducing) input.reducing(2 * whole.nodes);
        const std::string bytes = to_bytes(reduce_rock(box, whole, input.reduction), key);
        if (!store.folder().empty() && !store.keep(key, bytes)) result.origin = RockOrigin::not_kept;
        rock = from_bytes(bytes, key);
        assert(rock);
    }
    rock->floor = box.floor > 0 ? box.floor + 1 : 0; // and the heel
    result.rock = rock->scaled(input.rock.young_modulus, input.rock.density, length);
    result.seconds = watch.seconds();
    return result;
}

} // namespace damslip::fe2d
