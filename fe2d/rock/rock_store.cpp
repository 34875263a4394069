#include "fe2d/rock/rock_store.hpp"

#include "core/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <type_traits>
#include <vector>

namespace damslip::fe2d {

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
