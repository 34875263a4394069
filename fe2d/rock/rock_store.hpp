#pragma once

#include "fe2d/rock/reduced_rock.hpp"

#include <cstdint>
#include <filesystem>
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

} // namespace damslip::fe2d
