#pragma once

#include "fe2d/mesh/mesh.hpp"
#include "fe2d/rock/reduce_rock.hpp"
#include "fe2d/rock/reduced_rock.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace damslip::fe2d {

/// The numbers of a reduction as bytes, with a checksum behind them: what goes on disk. Doubles keep all their bits.
/// @param key  what the reduction was made for
std::string to_bytes(const ReducedRock& rock, const std::string& key);

/// @returns nothing when the bytes are cut, changed, of another version or of another key
std::optional<ReducedRock> from_bytes(const std::string& bytes, const std::string& key);

/// Reductions kept between runs, one file each, in a folder that any number of runs may use at the same time: files appear
/// whole (write_file), one that is damaged counts as missing. Nothing of this ever fails a run.
class RockStore {
public:
    /// @param folder  empty: keeps nothing, finds nothing
    explicit RockStore(std::filesystem::path folder, std::uintmax_t largest_bytes = default_bytes);

    static constexpr std::uintmax_t default_bytes = 64u << 20; ///< about a hundred reductions

    const std::filesystem::path& folder() const { return folder_; }
    std::filesystem::path file_of(const std::string& key) const;

    /// The bytes kept for `key`, unchecked; their file counts as just used.
    std::optional<std::string> find(const std::string& key) const;
    /// @returns false where it could not be written. Those not used for longest are deleted while all of them are larger than
    /// largest_bytes.
    bool keep(const std::string& key, const std::string& bytes) const;

private:
    void make_room() const;

    std::filesystem::path folder_;
    std::uintmax_t largest_bytes_;
};

/// The rock of one scene.
struct RadiatingRockInput {
    ElasticMaterial rock;       ///< density > 0
    Point heel, toe;            ///< of the base
    std::vector<Point> surface; ///< interface nodes on the rock's surface, upstream to downstream, x increasing [m]
    int floor =
        0; ///< so many of them, the first, are on the floor of acoustic water upstream of the base, whose pressure moves the rock
    double highest_frequency = 0.0; ///< ω up to which waves are to be right [rad/s]
    double box_size = 1.0;          ///< of the box, over the automatic one: wave_box_shape() [-]
    ReductionOptions reduction;
    std::function<void(int unknowns)> reducing; ///< called with the size of a box before it is reduced; may be empty
};

enum class RockOrigin {
    made,     ///< and kept where a store is used
    kept,     ///< found in the store
    not_kept, ///< made, but the store could not be written
};

struct RadiatingRock {
    ReducedRock rock; ///< of the scene, rows (x, y) by node of the base, then ReducedRock::floor
    RockOrigin origin = RockOrigin::made;
    double resolved = 0.0; ///< ω up to which waves are right: the wanted one or up to a quarter more [rad/s]
    WaveBoxShape box;
    double seconds = 0.0; ///< of finding or making it
};

/// Reduced rock of a scene. It is always made without dimensions, E = ρ = B = 1, for a_max = ω B/c_s rounded up to a power of 1.25, and
/// scaled after; positions of nodes are rounded to 2⁻³⁰ B. So one reduction serves all moduli, densities and sizes of one
/// shape, and what is found in the store gives the same bits as what is made.
///
/// @param store  with an empty folder: none
/// @throws std::runtime_error when the box cannot be factorised
RadiatingRock radiating_rock(const RadiatingRockInput& input, const RockStore& store);

/// The box for a_max: its sponge is as thick in shear waves of the highest frequency as 18.85 B are at a_max = 3.8 (41 B x 21 B:
/// E 30 GPa, 45 m, 25 ... 29 Hz), at least a quarter and at most three times as many base lengths. What it sends back at a
/// given share of the highest frequency then does not depend on the rock.
/// @param size  factor on width and depth on top of that [-]
WaveBoxShape wave_box_shape(double highest, double size = 1.0);

/// a_max rounded up to a power of 1.25.
double frequency_band(double highest);

/// The radiating rock of a scene, reduced to nodes on its surface; rows (x, y) by these; where the water's floor is the rock
/// (floor_on_rock()), its nodes' rows too.
/// @param nodes  of the mesh, upstream to downstream: those that the dam faces, or may come to face
/// @param wave_frequency  up to which waves are to be right where the scene has none [Hz]
/// @param cache  folder of reduced rock (RockStore); empty: none
/// @param reducing  as RadiatingRockInput::reducing
RadiatingRock radiating_rock_of(const Scene& scene, const Mesh& mesh, const std::vector<int>& nodes,
                                double wave_frequency, const std::filesystem::path& cache,
                                const std::function<void(int unknowns)>& reducing = {});

} // namespace damslip::fe2d
