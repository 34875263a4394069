// Artificial records of a list of seeds: made once, as `record generate` makes them, and again where a line changes.
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "records/generate/generate.hpp"
#include "records/record.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

namespace damslip::records {
namespace {

constexpr const char* heading = "name,seed,pga_m_s2,target,ground,duration_s,vertical,vertical_tolerance\n";

class SeedList : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove_all(folder); }
    SeededSuite read(const std::string& lines) const
    {
        write_file(list, heading + lines);
        return records_of_seeds(list, 1);
    }
    std::string refused(const std::string& text) const
    {
        write_file(list, text);
        try {
            records_of_seeds(list, 1);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("damslip seeds " + std::to_string(::getpid()));
    std::filesystem::path list = folder / "pairs.csv";
};

TEST_F(SeedList, MakesWhatTheGeneratorMakes)
{
    const SeededSuite suite = read("a,3,2,ec8-2,B,10,yes,0.2\n# a remark\nb,4,1,,,10,no,\n");
    EXPECT_EQ(suite.made, 2u);
    ASSERT_EQ(suite.pairs.size(), 2u);
    EXPECT_EQ(suite.pairs[0].horizontal, folder / "pairs" / "a_h.csv");
    EXPECT_FALSE(suite.pairs[1].vertical);
    GenerateOptions options;
    options.seed = 3;
    options.pga = 2.0;
    options.duration = 10.0;
    GeneratedRecord horizontal =
        generate_record(eurocode8_spectrum(Eurocode8Type::type_2, GroundType::B, MotionComponent::horizontal), options);
    horizontal.record.name = "a_h";
    EXPECT_EQ(read_file(suite.pairs[0].horizontal), record_csv(horizontal.record));
    options.component = MotionComponent::vertical;
    options.tolerance = 0.2;
    GeneratedRecord vertical =
        generate_record(eurocode8_spectrum(Eurocode8Type::type_2, GroundType::B, MotionComponent::vertical), options);
    vertical.record.name = "a_v";
    EXPECT_EQ(read_file(*suite.pairs[0].vertical), record_csv(vertical.record));
}

TEST_F(SeedList, KeepsWhatIsThereAndMakesAgainWhatChanged)
{
    const std::string a = "a,3,2,,,5,no,\n", b = "b,4,2,,,5,no,\n";
    const std::filesystem::path file = read(a + b).pairs[0].horizontal;
    EXPECT_EQ(read(a + b).made, 0u);
    EXPECT_EQ(read(b + a).made, 0u); // another order
    const std::string before = read_file(file);
    EXPECT_EQ(read("a,3,3,,,5,no,\n" + b).made, 1u);
    EXPECT_NE(read_file(file), before);
    EXPECT_EQ(read(a + b).made, 1u);
    EXPECT_EQ(read_file(file), before);
    std::filesystem::remove(file);
    EXPECT_EQ(read(a + b).made, 1u);
    EXPECT_EQ(read_file(file), before);
    // Stopped while it was making b anew: of what the folder says nothing is left of b's old line.
    write_file(folder / "pairs" / "made_of.csv", "generator,0\n");
    EXPECT_EQ(read(a + b).made, 2u); // by another generator
}

TEST_F(SeedList, GoesToTheCacheWhereItsFolderCannotBe)
{
    write_file(folder / "pairs", "a file in its place");
    const std::filesystem::path cache = cache_folder();
    use_cache_folder({});
    EXPECT_NE(refused(std::string(heading) + "a,3,2,,,5,no,\n").find("pairs"), std::string::npos);
    use_cache_folder(folder / "cache");
    const SeededSuite suite = read("a,3,2,,,5,no,\n");
    EXPECT_EQ(suite.folder.parent_path(), folder / "cache" / "suites");
    EXPECT_TRUE(std::filesystem::exists(suite.pairs[0].horizontal));
    EXPECT_EQ(read("a,3,2,,,5,no,\n").made, 0u);
    use_cache_folder(cache);
}

TEST_F(SeedList, RefusesByLine)
{
    const std::string good = "a,3,2,,,5,no,\n";
    for (const auto& [text, word] : {std::pair<std::string, std::string>{"name,seed\na,1\n", "no column pga_m_s2"},
                                     {"name,seed,pga_m_s2,mass\n", "unknown column \"mass\""},
                                     {"name,seed,pga_m_s2\na,1,2,5\n", "4 fields below 3 headings."},
                                     {"name,seed,pga_m_s2,seed\na,1,2,5\n", "the column seed stands twice."},
                                     {std::string(heading), "no line below"},
                                     {heading + good + "b,-1,2,,,5,no,\n", "seed = \"-1\""},
                                     {heading + good + "b,1e3,2,,,5,no,\n", "seed = \"1e3\""},
                                     {heading + good + "b,4,0,,,5,no,\n", "pga_m_s2 = \"0\""},
                                     {heading + good + "b,4,2,ec9,,5,no,\n", "target = \"ec9\""},
                                     {heading + good + "b,4,2,ec8-1,F,5,no,\n", "ground = \"F\""},
                                     {heading + good + "b,4,2,,,4,no,\n", "duration_s = \"4\""},
                                     {heading + good + "b,4,2,,,5,maybe,\n", "vertical = \"maybe\""},
                                     {heading + good + "../b,4,2,,,5,no,\n", "name = \"../b\""},
                                     {heading + good + "a,4,2,,,5,no,\n", "name = \"a\""}}) {
        const std::string said = refused(text);
        EXPECT_NE(said.find(word), std::string::npos) << said;
        EXPECT_NE(said.find("pairs.csv"), std::string::npos) << said;
    }
    const std::string line = refused(heading + good + "b,4,0,,,5,no,\n");
    EXPECT_NE(line.find("pairs.csv:3"), std::string::npos) << line;
    write_file(list, "name,seed,pga_m_s2,tolerance,duration_s,vertical\na,1,2,0.01,5,no\n");
    EXPECT_THROW(records_of_seeds(list, 1), InputError); // misses its spectrum by more than 1 %
}

TEST_F(SeedList, IsKnownByItsColumn)
{
    EXPECT_TRUE(is_seed_list("# of mine\n\nname, seed ,pga_m_s2\n"));
    EXPECT_FALSE(is_seed_list("horizontal,vertical\nseed,b\n"));
    EXPECT_FALSE(is_seed_list(""));
}

} // namespace
} // namespace damslip::records
