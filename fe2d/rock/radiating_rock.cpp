#include "fe2d/rock/radiating_rock.hpp"

#include "core/file.hpp"
#include "core/parallel.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/model/model.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <mutex>
#include <numbers>
#include <type_traits>
#include <vector>

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

namespace {

// Largest a_max = ω B/c_s: the box and its modes grow with it, 0.7 s at 3.8, 3.4 s at 11.6 (rock of 3 GPa below 45 m for 25 Hz),
// minutes at 30. Softer rock answers rightly up to a lower frequency, which the answer says.
constexpr double largest_automatic = 11.6, largest_asked_for = 25.0;
constexpr double largest_on_floor = 80.0; // the same over the length of a floor: 900 modes, some 30 s

} // namespace

RadiatingRock radiating_rock_of(const Scene& scene, const Mesh& mesh, const std::vector<int>& nodes,
                                double wave_frequency, const std::filesystem::path& cache,
                                const std::function<void(int unknowns)>& reducing)
{
    assert(scene.foundation);
    RadiatingRockInput input;
    input.rock = elastic_material(scene.foundation->material, scene, "foundation");
    input.rock.density = radiating_density(*scene.foundation);
    input.heel = heel(scene.section);
    input.toe = toe(scene.section);
    double floor = 0.0;
    if (floor_on_rock(scene)) {
        const ReservoirMesh water = build_reservoir_mesh(scene);
        for (std::size_t k = 0; k + 1 < water.bottom.size(); ++k) // the last is the heel
            input.surface.push_back(water.mesh.nodes[static_cast<std::size_t>(water.bottom[k])]);
        input.floor = static_cast<int>(input.surface.size());
        floor = input.heel.x - input.surface.front().x;
    }
    for (const int node : nodes) input.surface.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
    const double base = std::hypot(input.toe.x - input.heel.x, input.toe.y - input.heel.y),
                 largest = scene.foundation->wave_frequency ? largest_asked_for : largest_automatic;
    input.highest_frequency =
        std::min(2.0 * std::numbers::pi * scene.foundation->wave_frequency.value_or(wave_frequency),
                 largest * elastic_waves(input.rock).s / base);
    if (floor > 0.0)
        input.highest_frequency =
            std::min(input.highest_frequency, largest_on_floor * elastic_waves(input.rock).s / floor);
    input.box_size = scene.foundation->wave_box;
    input.reducing = reducing;
    return radiating_rock(input, RockStore(cache));
}

namespace fs = std::filesystem;
using Eigen::Index;

namespace {

constexpr std::string_view mark = "damslip rock 1\n";
constexpr const char* ending = ".rock";
constexpr std::size_t checksum = 64;             ///< characters of a SHA-256
constexpr std::uint64_t most_numbers = 1u << 20; ///< rows or columns that are believed
static_assert(std::endian::native == std::endian::little, "the bytes of numbers are kept as they are in memory");

class Writer {
public:
    std::string bytes;

    template <class Number>
    void number(Number value)
    {
        static_assert(std::is_trivially_copyable_v<Number>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void text(std::string_view value)
    {
        number(static_cast<std::uint64_t>(value.size()));
        bytes += value;
    }
    template <class Matrix>
    void matrix(const Matrix& m)
    {
        number(static_cast<std::uint64_t>(m.rows()));
        number(static_cast<std::uint64_t>(m.cols()));
        bytes.append(reinterpret_cast<const char*>(m.data()), sizeof(double) * static_cast<std::size_t>(m.size()));
    }
};

/// Fails for ever once something is missing.
class Reader {
public:
    explicit Reader(std::string_view bytes) : left_(bytes) {}

    bool failed() const { return failed_; }
    bool done() const { return !failed_ && left_.empty(); }

    std::string_view take(std::uint64_t count)
    {
        if (failed_ || count > left_.size()) {
            failed_ = true;
            return {};
        }
        const std::string_view taken = left_.substr(0, count);
        left_.remove_prefix(count);
        return taken;
    }
    template <class Number>
    void number(Number& value)
    {
        const std::string_view from = take(sizeof value);
        if (!failed_) std::memcpy(&value, from.data(), sizeof value);
    }
    std::string_view text()
    {
        std::uint64_t size = 0;
        number(size);
        return take(size);
    }
    template <class Matrix>
    void matrix(Matrix& m)
    {
        std::uint64_t rows = 0, columns = 0;
        number(rows);
        number(columns);
        if (rows > most_numbers || columns > most_numbers) failed_ = true;
        const std::string_view from = take(sizeof(double) * rows * columns);
        if (failed_) return;
        m.resize(static_cast<Index>(rows), static_cast<Index>(columns));
        std::memcpy(m.data(), from.data(), from.size());
    }

private:
    std::string_view left_;
    bool failed_ = false;
};

} // namespace

std::string to_bytes(const ReducedRock& rock, const std::string& key)
{
    Writer out;
    out.bytes = mark;
    out.text(key);
    const ReductionReport& r = rock.report;
    for (const int value : {r.unknowns, r.patterns, r.frequencies, r.modes, r.rounds}) out.number(value);
    for (const double value : {r.error, r.wanted, r.seconds}) out.number(value);
    out.matrix(rock.stiffness);
    out.matrix(rock.damping);
    out.matrix(rock.modes);
    out.matrix(rock.residual);
    out.bytes += sha256(out.bytes);
    return std::move(out.bytes);
}

std::optional<ReducedRock> from_bytes(const std::string& bytes, const std::string& key)
{
    if (bytes.size() < mark.size() + checksum) return std::nullopt;
    const std::string_view content = std::string_view(bytes).substr(0, bytes.size() - checksum);
    if (sha256(content) != std::string_view(bytes).substr(content.size())) return std::nullopt;
    Reader in(content);
    if (in.take(mark.size()) != mark || in.text() != key) return std::nullopt;
    ReducedRock rock;
    ReductionReport& r = rock.report;
    for (int* value : {&r.unknowns, &r.patterns, &r.frequencies, &r.modes, &r.rounds}) in.number(*value);
    for (double* value : {&r.error, &r.wanted, &r.seconds}) in.number(*value);
    Eigen::MatrixXd stiffness;
    in.matrix(stiffness);
    in.matrix(rock.damping);
    in.matrix(rock.modes);
    in.matrix(rock.residual);
    const Index n = rock.modes.cols(), interface = rock.modes.rows();
    if (!in.done() || stiffness.cols() != 1 || stiffness.rows() != n || rock.damping.rows() != n ||
        rock.damping.cols() != n || rock.residual.rows() != interface || rock.residual.cols() != interface)
        return std::nullopt;
    rock.stiffness = stiffness.col(0);
    return rock;
}

RockStore::RockStore(fs::path folder, std::uintmax_t largest_bytes)
    : folder_(std::move(folder)), largest_bytes_(largest_bytes)
{
}

fs::path RockStore::file_of(const std::string& key) const
{
    return folder_ / (sha256(key).substr(0, 32) + ending);
}

std::optional<std::string> RockStore::find(const std::string& key) const
{
    if (folder_.empty()) return std::nullopt;
    const fs::path file = file_of(key);
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return std::nullopt;
    try {
        std::string bytes = read_file(file, largest_bytes_);
        fs::last_write_time(file, fs::file_time_type::clock::now(), error); // what fails here does not matter
        return bytes;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

bool RockStore::keep(const std::string& key, const std::string& bytes) const
{
    if (folder_.empty() || bytes.size() > largest_bytes_) return false;
    static std::mutex mutex; // write_file tells processes apart, not threads
    const std::lock_guard lock(mutex);
    try {
        write_file(file_of(key), bytes);
    } catch (const InputError&) {
        return false;
    }
    make_room();
    return true;
}

void RockStore::make_room() const
{
    struct Entry {
        fs::path path;
        fs::file_time_type used;
        std::uintmax_t size;
    };
    std::vector<Entry> entries;
    std::uintmax_t sum = 0;
    std::error_code error;
    for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
        std::error_code gone; // deleted by another run meanwhile
        if (it->path().extension() != ending || !it->is_regular_file(gone)) continue;
        Entry entry{it->path(), it->last_write_time(gone), 0};
        if (!gone) entry.size = it->file_size(gone);
        if (gone) continue;
        sum += entry.size;
        entries.push_back(std::move(entry));
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
    for (const Entry& entry : entries) {
        if (sum <= largest_bytes_) return;
        fs::remove(entry.path, error);
        sum -= entry.size;
    }
}

} // namespace damslip::fe2d
