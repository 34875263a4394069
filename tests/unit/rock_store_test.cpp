#include "core/file.hpp"
#include "rock_scenes.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <thread>
#include <unistd.h>
#include <vector>

namespace damslip::rock_tests {

using namespace fe2d;

namespace fs = std::filesystem;

namespace {

/// A folder of its own, gone at the end.
struct Folder {
    fs::path path = fs::temp_directory_path() / ("damslip-rock-" + std::to_string(::getpid()) + "-" +
                                                 ::testing::UnitTest::GetInstance()->current_test_info()->name());
    Folder() { fs::remove_all(path); }
    ~Folder() { fs::remove_all(path); }
};

ReducedRock some_rock(int modes = 3, int interface = 4)
{
    ReducedRock rock;
    rock.stiffness = Eigen::VectorXd::LinSpaced(modes, 1.0, 2.0) / 3.0;
    rock.damping = Eigen::MatrixXd::Constant(modes, modes, 0.1);
    rock.modes = Eigen::MatrixXd::Random(interface, modes);
    rock.residual = Eigen::MatrixXd::Identity(interface, interface) / 7.0;
    rock.report = {.unknowns = 5, .modes = modes, .error = 0.25};
    return rock;
}

bool same_bits(const ReducedRock& a, const ReducedRock& b)
{
    return a.stiffness == b.stiffness && a.damping == b.damping && a.modes == b.modes && a.residual == b.residual &&
           a.report.error == b.report.error && a.report.modes == b.report.modes;
}

RadiatingRockInput quick_input(double modulus = 30e9)
{
    return rock_input({2650.0, modulus, 0.2}, 20.0, 4, 10.0);
}

} // namespace

TEST(RockStore, KeepsEveryBit)
{
    const ReducedRock rock = some_rock();
    const std::string bytes = to_bytes(rock, "key");
    const auto back = from_bytes(bytes, "key");
    ASSERT_TRUE(back);
    EXPECT_TRUE(same_bits(rock, *back));
    EXPECT_EQ(back->report.unknowns, 5);
}

TEST(RockStore, DamageCountsAsMissing)
{
    const std::string bytes = to_bytes(some_rock(), "key");
    EXPECT_FALSE(from_bytes(bytes, "another key"));
    EXPECT_FALSE(from_bytes("", "key"));
    for (std::size_t k = 0; k < bytes.size(); k += 7) {
        std::string changed = bytes;
        changed[k] = static_cast<char>(changed[k] ^ 1);
        EXPECT_FALSE(from_bytes(changed, "key")) << k;
        EXPECT_FALSE(from_bytes(bytes.substr(0, k), "key")) << k;
    }
}

// The same bits whether made, found, or made without a store; a damaged file is made again.
TEST(RockStore, ColdWarmAndWithoutGiveTheSameBits)
{
    const Folder folder;
    const RockStore store(folder.path);
    std::vector<int> told; // unknowns of the boxes that are reduced
    RadiatingRockInput input = quick_input();
    input.reducing = [&](int unknowns) { told.push_back(unknowns); };
    const RadiatingRock without = radiating_rock(quick_input(), no_store), cold = radiating_rock(input, store),
                        warm = radiating_rock(input, store);
    EXPECT_EQ(told, std::vector<int>{cold.rock.report.unknowns}); // nothing is said of what is found
    EXPECT_EQ(without.origin, RockOrigin::made);
    EXPECT_EQ(cold.origin, RockOrigin::made);
    EXPECT_EQ(warm.origin, RockOrigin::kept);
    EXPECT_TRUE(same_bits(cold.rock, warm.rock));
    EXPECT_TRUE(same_bits(cold.rock, without.rock));

    const fs::path file = fs::directory_iterator(folder.path)->path();
    std::string bytes = read_file(file);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
    write_file(file, bytes);
    const RadiatingRock again = radiating_rock(quick_input(), store);
    EXPECT_EQ(again.origin, RockOrigin::made);
    EXPECT_TRUE(same_bits(cold.rock, again.rock));
    EXPECT_EQ(radiating_rock(quick_input(), store).origin, RockOrigin::kept);
}

// One file for another modulus in the same band, for another size of the same shape, another density; not for another
// band, Poisson's ratio or mesh.
TEST(RockStore, OneReductionServesAllScales)
{
    const Folder folder;
    const RockStore store(folder.path);
    const RadiatingRock first = radiating_rock(quick_input(), store);
    const auto origin = [&](const RadiatingRockInput& input) { return radiating_rock(input, store).origin; };
    EXPECT_EQ(origin(rock_input({2650.0, 31e9, 0.2}, 20.0, 4, 10.0)), RockOrigin::kept);
    EXPECT_EQ(origin(rock_input({2650.0, 30e9, 0.2}, 60.0, 4, 10.0 / 3.0)), RockOrigin::kept);
    EXPECT_EQ(origin(rock_input({2700.0, 31e9, 0.2}, 20.0, 4, 10.0)), RockOrigin::kept);
    EXPECT_EQ(origin(rock_input({2650.0, 30e9, 0.2}, 20.0, 4, 14.0)), RockOrigin::made);
    EXPECT_EQ(origin(rock_input({2650.0, 30e9, 0.25}, 20.0, 4, 10.0)), RockOrigin::made);
    EXPECT_EQ(origin(rock_input({2650.0, 30e9, 0.2}, 20.0, 5, 10.0)), RockOrigin::made);

    EXPECT_GE(first.resolved, quick_input().highest_frequency * (1.0 - 1e-9));
    EXPECT_LE(first.resolved, quick_input().highest_frequency * 1.2501);
    // somewhere else on the map
    RadiatingRockInput moved = quick_input();
    for (Point* p : {&moved.heel, &moved.toe}) *p = {p->x + 1000.3, p->y - 77.7};
    for (Point& p : moved.surface) p = {p.x + 1000.3, p.y - 77.7};
    const RadiatingRock there = radiating_rock(moved, store);
    EXPECT_EQ(there.origin, RockOrigin::kept);
    EXPECT_TRUE(same_bits(there.rock, first.rock));
}

TEST(RockStore, DeletesWhatWasNotUsedForLongest)
{
    const Folder folder;
    const std::string bytes = to_bytes(some_rock(40, 40), "key");
    const RockStore store(folder.path, 3 * bytes.size() + 100);
    const auto now = fs::file_time_type::clock::now();
    for (int k = 0; k < 3; ++k) {
        const std::string key = "key" + std::to_string(k);
        ASSERT_TRUE(store.keep(key, bytes));
        fs::last_write_time(store.file_of(key), now - std::chrono::hours(10 - k));
    }
    EXPECT_TRUE(store.find("key0")); // just used
    write_file(folder.path / "note.txt", "not ours");
    ASSERT_TRUE(store.keep("key3", bytes));
    EXPECT_TRUE(store.find("key0"));
    EXPECT_FALSE(store.find("key1"));
    EXPECT_TRUE(store.find("key2"));
    EXPECT_TRUE(store.find("key3"));
    EXPECT_TRUE(fs::exists(folder.path / "note.txt"));
    EXPECT_FALSE(RockStore(folder.path, 10).keep("key4", bytes)); // larger than all there may be
}

TEST(RockStore, RunsAtTheSameTimeShareIt)
{
    const Folder folder;
    const RockStore store(folder.path);
    const ReducedRock rock = some_rock(60, 60);
    const std::string bytes = to_bytes(rock, "key");
    std::vector<std::thread> threads;
    std::atomic<int> wrong = 0, found = 0;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int k = 0; k < 50; ++k) {
                store.keep("key", bytes);
                const auto there = store.find("key");
                const auto back = there ? from_bytes(*there, "key") : std::nullopt;
                found += back.has_value();
                wrong += !back || !same_bits(*back, rock);
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(found, 200);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()), 1);
}

// A folder that cannot be made costs nothing but the time.
TEST(RockStore, AFolderThatCannotBeWrittenIsNoError)
{
    const Folder folder;
    fs::create_directories(folder.path);
    write_file(folder.path / "file", "in the way");
    const RadiatingRock rock = radiating_rock(quick_input(), RockStore(folder.path / "file" / "below"));
    EXPECT_EQ(rock.origin, RockOrigin::not_kept);
    EXPECT_GT(rock.rock.count(), 0);
}

TEST(RockStore, LivesInTheUsersCache)
{
    const auto restore = [](const char* name, std::optional<std::string> value) {
        value ? ::setenv(name, value->c_str(), 1) : ::unsetenv(name);
    };
    const auto now = [](const char* name) -> std::optional<std::string> {
        const char* value = std::getenv(name);
        return value ? std::optional<std::string>(value) : std::nullopt;
    };
    const auto cache = now("XDG_CACHE_HOME"), home = now("HOME");
    ::setenv("XDG_CACHE_HOME", "/somewhere/cache", 1);
    EXPECT_EQ(user_cache_folder(), "/somewhere/cache/damslip");
    ::setenv("XDG_CACHE_HOME", "not/absolute", 1);
    ::setenv("HOME", "/somewhere", 1);
    EXPECT_EQ(user_cache_folder(), "/somewhere/.cache/damslip");
    ::unsetenv("XDG_CACHE_HOME");
    ::unsetenv("HOME");
    EXPECT_TRUE(user_cache_folder().empty());
    restore("XDG_CACHE_HOME", cache);
    restore("HOME", home);
}

} // namespace damslip::rock_tests
