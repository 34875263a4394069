// A sweep of many rows: its memory does not grow with them, its page says what it draws, and its rows are those of a short one.
#include "core/file.hpp"
#include "program_answer.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace damslip {
namespace {

/// A dry block under a short pulse: rows cost next to nothing.
class LongSweep : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip_long_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "pulse.csv") << "time_s,accel_m_s2\n0,0\n1,2\n2,0\n3,-1.5\n4,0\n5,0\n";
        std::ofstream(folder / "block.toml")
            << "[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.1\n"
               "[[motion.record]]\nhorizontal = \"pulse.csv\"\n";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::vector<std::string> words(const std::string& friction, const std::string& name) const
    {
        return {"sweep",
                (folder / "block.toml").string(),
                "-q",
                "--method",
                "rigid",
                "--friction",
                friction,
                "--polarity",
                "1,-1",
                "-j",
                "1",
                "--out",
                (folder / name).string()};
    }

    /// Largest memory of the sweep in a process of its own [bytes].
    double memory(const std::string& scales) const
    {
        std::vector<std::string> command = words("0.1:1.099:0.001", "memory.csv");
        command.insert(command.end(), {"--scale", scales});
        std::filesystem::remove(folder / "memory.sqlite");
        const pid_t child = ::fork();
        if (child == 0) ::_exit(answer_of(command).code);
        int status = 0;
        rusage usage{};
        EXPECT_EQ(::wait4(child, &status, 0, &usage), child);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        return 1024.0 * static_cast<double>(usage.ru_maxrss);
    }

    std::filesystem::path folder;
};

// 100,000 and 400,000 rows of 1000 frictions, of which the page draws 50,000 each. A row takes the 8 bytes of its id; one that is held
// anywhere takes some hundred.
TEST_F(LongSweep, memory_does_not_grow_with_the_rows)
{
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the checker's own memory grows with every allocation";
#endif
    const double few = memory("0.02:1:0.02"), many = memory("0.005:1:0.005");
    EXPECT_LT((many - few) / 300000.0, 20.0) << few << " and " << many << " bytes";
}

TEST_F(LongSweep, the_page_of_many_rows_says_what_it_draws)
{
    ASSERT_EQ(answer_of(words("0.1:0.4:0.00001", "many.csv")).code, 0);
    const std::string page = read_file(folder / "many.html");
    EXPECT_NE(page.find("Drawn and counted on this page are 30002 of 60002 rows, those of one friction in 2"),
              std::string::npos);
    EXPECT_NE(page.find("60002 rows: the largest slip is"), std::string::npos);
    ASSERT_EQ(answer_of(words("0.1:0.3:0.00001", "fewer.csv")).code, 0);
    EXPECT_EQ(read_file(folder / "fewer.html").find("Drawn and counted"), std::string::npos);
}

TEST_F(LongSweep, its_rows_are_those_of_a_short_one)
{
    ASSERT_EQ(answer_of(words("0.1:0.2:0.00001", "long.csv")).code, 0);
    ASSERT_EQ(answer_of(words("0.1:0.1004:0.00001", "short.csv")).code, 0);
    const auto rows = [&](const char* name) {
        const std::string text = read_file(folder / name);
        return text.substr(text.find("\nid,") + 1);
    };
    EXPECT_TRUE(rows("long.csv").starts_with(rows("short.csv")));
}

} // namespace
} // namespace damslip
