// fe --frames: what the files for ParaView say against the other files of the same run. The history's columns are sums and largest values of
// the pairs, so each frame has to give them back at its time; the last one is the state at the end.
#include "core/file.hpp"
#include "csv_rows.hpp"
#include "program_answer.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <regex>
#include <tuple>
#include <unistd.h>

namespace damslip::frame_tests {

namespace {

/// Matches of the groups of an expression, all over a text.
std::vector<std::smatch> found_in(const std::string& text, const std::string& expression)
{
    const std::regex wanted(expression);
    return {std::sregex_iterator(text.begin(), text.end(), wanted), std::sregex_iterator()};
}

/// Numbers of an unstructured grid with appended data.
struct Grid {
    std::size_t points = 0, cells = 0;
    std::map<std::string, std::vector<double>> arrays; ///< of float64

    explicit Grid(const std::filesystem::path& file)
    {
        const std::string text = read_file(file), mark = "<AppendedData encoding=\"raw\">\n_";
        const std::size_t data = text.find(mark) + mark.size();
        const std::string head = text.substr(0, data);
        const auto size = found_in(head, "NumberOfPoints=\"([0-9]+)\" NumberOfCells=\"([0-9]+)\"").at(0);
        points = std::stoul(size[1]);
        cells = std::stoul(size[2]);
        for (const auto& a : found_in(head, "type=\"Float64\" Name=\"([^\"]+)\" NumberOfComponents=\"[0-9]\" "
                                            "format=\"appended\" offset=\"([0-9]+)\"")) {
            std::uint64_t bytes = 0;
            const std::size_t at = data + std::stoul(a[2]);
            std::memcpy(&bytes, text.data() + at, sizeof bytes);
            std::vector<double>& values = arrays[a[1]];
            values.resize(bytes / sizeof(double));
            std::memcpy(values.data(), text.data() + at + sizeof bytes, bytes);
        }
    }
};

/// Columns of a CSV file with comments and a heading.
std::map<std::string, std::vector<double>> columns_of(const std::filesystem::path& file)
{
    std::map<std::string, std::vector<double>> columns;
    for (const auto& row : csv_rows(read_file(file)))
        for (const auto& [name, field] : row) columns[name].push_back(field.empty() ? NAN : std::stod(field));
    return columns;
}

/// A soft block of 4 m by 8 m that walks under a second of shaking: it slides by centimetres, rocks and opens.
class Frames : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / fmt::format("damslip_frames_{}", ::getpid());
        std::filesystem::create_directories(folder);
        std::string record = "t,a\n";
        for (int k = 0; k <= 50; ++k)
            record += fmt::format("{:.2f},{:.8g}\n", 0.02 * k, 8.0 * std::sin(0.2 * k) * std::exp(-0.02 * k));
        write_file(folder / "h.csv", record);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string scene(const std::string& water) const
    {
        const std::string file = (folder / "block.toml").string();
        write_file(
            file,
            "[section]\nheight_m = 8\nbase_m = 4\ncrest_m = 4\n[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa = 10\n"
            "poisson_ratio = 0.2\n[foundation]\nyoung_modulus_GPa = 10\npoisson_ratio = 0.25\nwidth_m = 20\ndepth_m = "
            "5\n"
            "mass = \"massless\"\n[reservoir]\nlevel_m = 4\nmodel = \"" +
                water +
                "\"\n[contact]\nfriction = 0.6\n[uplift]\nmodel = \"linear\"\n[mesh]\nsize_m = 2\ncontact_size_m = 1\n"
                "[damping]\nratio = 0.05\n[time]\ndt_s = 0.005\n[[motion.record]]\nname = \"one & two\"\nhorizontal = "
                "\"h.csv\"\n"
                "unit = \"m/s2\"\n");
        return file;
    }
    ProgramAnswer run(const std::string& water, int frames) const
    {
        return answer_of({"fe", scene(water), "--polarity", "1", "--no-mesh-error", "--frames", std::to_string(frames),
                          "--out", (folder / "out").string()});
    }
    /// The only file in a folder that begins and ends so.
    static std::filesystem::path only(const std::filesystem::path& in, const std::string& first,
                                      const std::string& last)
    {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(in))
            if (const std::string name = entry.path().filename().string();
                name.starts_with(first) && name.ends_with(last))
                files.push_back(entry.path());
        EXPECT_EQ(files.size(), 1u) << first << "*" << last;
        return files.at(0);
    }
    /// Times of a series and the blocks of each.
    std::vector<std::pair<double, std::map<std::string, std::filesystem::path>>> series() const
    {
        const std::filesystem::path pvd = only(folder / "out", "frames_", ".pvd");
        std::vector<std::pair<double, std::map<std::string, std::filesystem::path>>> all;
        const std::string text = read_file(pvd);
        for (const auto& entry : found_in(text, "timestep=\"([^\"]+)\" part=\"0\" file=\"([^\"]+)\"")) {
            const std::filesystem::path vtm = pvd.parent_path() / entry[2].str();
            const std::string blocks = read_file(vtm);
            all.emplace_back(std::stod(entry[1]), std::map<std::string, std::filesystem::path>());
            for (const auto& block : found_in(blocks, "name=\"([^\"]+)\" file=\"([^\"]+)\""))
                all.back().second[block[1]] = vtm.parent_path() / block[2].str();
        }
        return all;
    }

    std::filesystem::path folder;
};

// Five frames over a record of 1 s: one each quarter, then the run-out at the same interval, the end included.
TEST_F(Frames, SeriesSpreadsOverTheRun)
{
    ASSERT_EQ(run("added-mass", 5).code, 0);
    const auto history = columns_of(only(folder / "out", "history_", ".csv"));
    const auto frames = series();
    ASSERT_GE(frames.size(), 5u);
    for (std::size_t k = 0; k + 1 < frames.size(); ++k)
        EXPECT_NEAR(frames[k].first, 0.25 * static_cast<double>(k), 0.005 + 1e-9);
    EXPECT_EQ(frames.back().first, history.at("time_s").back());
    for (const auto& [time, blocks] : frames) {
        EXPECT_EQ(blocks.size(), 3u); // dam, rock, joints
        for (const auto& [name, file] : blocks) EXPECT_TRUE(std::filesystem::exists(file)) << file;
    }
}

// Means and largest values of the pairs are the history's, and the solid's motion is its crest's.
TEST_F(Frames, EachFrameIsItsRowOfTheHistory)
{
    ASSERT_EQ(run("added-mass", 9).code, 0);
    auto history = columns_of(only(folder / "out", "history_", ".csv"));
    auto base = columns_of(only(folder / "out", "base_", ".csv"));
    const auto mesh =
        nlohmann::json::parse(answer_of({"mesh", (folder / "block.toml").string(), "--json"}).out)["mesh"].at(0);
    const std::vector<double>& area = base.at("area_m");
    double crest_at_start = 0.0, slid = 0.0, opened = 0.0;
    for (const auto& [time, blocks] : series()) {
        SCOPED_TRACE(time);
        const auto& times = history.at("time_s");
        const auto row = static_cast<std::size_t>(std::find(times.begin(), times.end(), time) - times.begin());
        ASSERT_LT(row, times.size());
        Grid dam(blocks.at("dam")), rock(blocks.at("rock")), joints(blocks.at("joints"));
        EXPECT_EQ(dam.cells, mesh["dam_elements"]);
        EXPECT_EQ(dam.points + rock.points, mesh["nodes"]);
        ASSERT_EQ(joints.points, mesh["base_nodes_dam"]);
        EXPECT_EQ(joints.cells, joints.points - 1);
        double length = 0.0, slip = 0.0, force = 0.0, shear = 0.0;
        for (std::size_t i = 0; i < area.size(); ++i) {
            length += area[i];
            slip += area[i] * joints.arrays.at("slip_m")[i];
            force += area[i] * joints.arrays.at("normal_pressure_Pa")[i];
            shear += area[i] * joints.arrays.at("shear_Pa")[i];
        }
        const std::vector<double>& opening = joints.arrays.at("opening_m");
        EXPECT_NEAR(slip / length, history.at("slip_m")[row], 1e-12);
        EXPECT_NEAR(*std::max_element(opening.begin(), opening.end()), history.at("largest_opening_m")[row], 1e-12);
        EXPECT_NEAR(force, history.at("normal_force_N_m")[row], 1.0);
        EXPECT_NEAR(shear, history.at("shear_force_N_m")[row], 1.0);
        std::size_t crest = 0; // upstream end
        const auto& at = dam.arrays.at("points_m");
        for (std::size_t i = 0; i < dam.points; ++i)
            if (at[3 * i + 1] - at[3 * i] > at[3 * crest + 1] - at[3 * crest]) crest = i;
        if (row == 0) crest_at_start = dam.arrays.at("displacement_m")[3 * crest];
        EXPECT_NEAR(dam.arrays.at("displacement_m")[3 * crest] - crest_at_start, history.at("crest_x_m")[row], 1e-12);
        slid = std::max(slid, std::abs(slip / length));
        opened = std::max(opened, history.at("largest_opening_m")[row]);
    }
    EXPECT_GT(slid, 0.01);
    EXPECT_GT(opened, 1e-4);
}

// The last frame is the end: pairs as the table of the base has them, displacements as the field of the end has them. Uplift: linear, 4 m of
// water at the heel.
TEST_F(Frames, LastFrameIsTheEnd)
{
    ASSERT_EQ(run("added-mass", 2).code, 0);
    auto base = columns_of(only(folder / "out", "base_", ".csv"));
    const auto last = series().back().second;
    Grid joints(last.at("joints")), dam(last.at("dam")), rock(last.at("rock")),
        end(only(folder / "out", "fields_", "_end.vtu"));
    for (std::size_t i = 0; i < joints.points; ++i) {
        EXPECT_NEAR(joints.arrays.at("slip_m")[i], base.at("slip_m")[i], 1e-12);
        EXPECT_NEAR(joints.arrays.at("opening_m")[i], base.at("opening_m")[i], 1e-12);
        EXPECT_NEAR(joints.arrays.at("normal_pressure_Pa")[i], base.at("pressure_Pa")[i], 1e-3);
        EXPECT_NEAR(joints.arrays.at("shear_Pa")[i], base.at("shear_Pa")[i], 1e-3);
        EXPECT_NEAR(joints.arrays.at("water_pressure_Pa")[i], 9810.0 * 4.0 * (1.0 - base.at("distance_m")[i] / 4.0),
                    1e-6);
    }
    ASSERT_EQ(end.points, dam.points + rock.points); // the dam's nodes come first, each twice on the base
    const std::vector<double>& places = end.arrays.at("points_m");
    for (const auto& [part, from, to] : {std::tuple{&dam, std::size_t{0}, dam.points}, {&rock, dam.points, end.points}})
        for (std::size_t i = 0; i < part->points; ++i) {
            const double* const place = &part->arrays.at("points_m")[3 * i];
            std::size_t same = from;
            while (same < to && !std::equal(place, place + 3, &places[3 * same])) ++same;
            ASSERT_LT(same, to);
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(part->arrays.at("displacement_m")[3 * i + c], end.arrays.at("displacement_m")[3 * same + c],
                            1e-12);
        }
}

// Acoustic water is a block of its own: no pressure beyond the static one before the earthquake and on the surface, and some on the way.
TEST_F(Frames, AcousticWaterHasItsPressure)
{
    const ProgramAnswer a = run("acoustic", 9);
    ASSERT_EQ(a.code, 0) << a.talk;
    double largest = 0.0;
    const auto frames = series();
    for (const auto& [time, blocks] : frames) {
        ASSERT_TRUE(blocks.contains("water"));
        Grid water(blocks.at("water"));
        ASSERT_EQ(water.arrays.at("pressure_Pa").size(), water.points);
        for (std::size_t i = 0; i < water.points; ++i) {
            const double pressure = water.arrays.at("pressure_Pa")[i];
            if (time == 0.0 || water.arrays.at("points_m")[3 * i + 1] > 4.0 - 1e-9) {
                EXPECT_EQ(pressure, 0.0);
            }
            largest = std::max(largest, std::abs(pressure));
        }
    }
    // Westergaard: rho a h at most three quarters, for 8 m/s^2; a stiff dam on its way gives some of it.
    EXPECT_GT(largest, 0.05 * 1000.0 * 8.0 * 4.0);
    EXPECT_LT(largest, 5.0 * 1000.0 * 8.0 * 4.0);
}

TEST_F(Frames, NeedAFolderAndADamThatSlides)
{
    const std::string file = scene("added-mass"), out = (folder / "out").string();
    EXPECT_EQ(answer_of({"fe", file, "--frames", "5"}).code, 2);
    const ProgramAnswer tied = answer_of({"fe", file, "--frames", "5", "--base", "tied", "--out", out});
    EXPECT_EQ(tied.code, 2);
    EXPECT_NE(tied.talk.find("--frames with --base tied."), std::string::npos) << tied.talk;
    EXPECT_FALSE(std::filesystem::exists(out));
}

} // namespace

} // namespace damslip::frame_tests
