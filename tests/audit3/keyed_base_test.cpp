// What the program says to sections that it does not model, and how its users go on.
#include "program_answer.hpp"

#include "core/file.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace damslip;

TEST(Audit3, C_AKeyedBaseIsRefusedWithTheWayOut)
{
    const std::filesystem::path file = std::filesystem::temp_directory_path() / ("damslip_keyed_base_" + std::to_string(::getpid()) + ".toml");
    write_file(file, "[section]\npolygon_m = [[0, 0], [6, 0], [6, -2], [10, -2], [10, 0], [24, 0], [4, 30], [0, 30]]\n[dam]\ndensity_kg_m3 = 2400\n[contact]\nfriction = 0.7\n");
    const ProgramAnswer answer = answer_of({"screen", file.string()});
    EXPECT_EQ(answer.code, 3);
    for (const std::string& word : std::vector<std::string>{file.filename().string() + ":2", "(6, -2)", "plane through its underside", "[[seam]] depth_m = 2", "[seam.wedge]"})
        EXPECT_NE(answer.talk.find(word), std::string::npos) << word << "\n" << answer.talk;
    std::filesystem::remove(file);
}
