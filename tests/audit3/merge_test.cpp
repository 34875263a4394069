// Parts to be merged that are no databases: refused at once, whatever they are.
#include "program_answer.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <sys/stat.h>
#include <unistd.h>

namespace damslip {

namespace {

TEST(Audit3, D9_MergeOfADeviceReadsNothing)
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("merge" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    const std::string pipe = folder / "pipe", text = folder / "text.csv", out = folder / "m.csv";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0); // to open it would wait for a writer
    std::ofstream(text) << "id,friction\n0,0.7\n";
    for (const std::string& part : {std::string("/dev/zero"), std::string("/dev/null"), pipe, text}) {
        const ProgramAnswer answer = answer_of({"sweep", "--merge", part, "--out", out});
        EXPECT_EQ(answer.code, 3) << part;
        EXPECT_NE(answer.talk.find(part + ": error: this is not a database of a sweep"), std::string::npos)
            << answer.talk;
        EXPECT_FALSE(std::filesystem::exists(out));
    }
    std::filesystem::remove_all(folder);
}

} // namespace

} // namespace damslip
