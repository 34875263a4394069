#pragma once

#include "program_answer.hpp"
#include "pulse_scene.hpp"

#include "probability/distribution.hpp"

#include <gtest/gtest.h>

#include <utility>

/// The program asked for the probability that the block of pulse_scene.hpp slides by more than 200 mm: P = F_mu(mu*) by hand.
namespace damslip::pulse {

constexpr double limit = 0.2; ///< [m]

/// P by hand under a pulse of this plateau [m/s^2].
inline double probability_by_hand(double plateau)
{
    return probability::normal_cdf(std::log(friction(limit, plateau) / 0.30) / 0.2);
}

/// A folder of its own with the pulse's record and a scene.
class Study : public testing::Test {
protected:
    /// Tables that stand in place of the scene's own ones.
    struct Tables {
        std::string intensity = "measure = \"PGA\"\nlevels_m_s2 = [3, 3.5, 4]\n";
        std::string suite = "polarity = \"as-recorded\"\nmax_scale = 4\n";
        std::string sampling = "sampling = \"lhs\"\nreplicates = 4\n";
        std::string variable = "kind = \"aleatory\"\nlognormal = { median = 0.3, beta = 0.2 }\n";
        std::string more = {}; ///< further ones
    };

    void SetUp() override
    {
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
        write_scene({});
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    void write_scene(const Tables& t) const
    {
        write_file(folder / "pulse.csv", record_text());
        write_file(
            scene,
            "title = \"block\"\n[section]\nheight_m = 50\nbase_m = 40\ncrest_m = 5\n[dam]\ndensity_kg_m3 = 2400\n"
            "young_modulus_GPa = 200\npoisson_ratio = 0.2\n[contact]\nfriction = 0.3\n[sliding]\ntwo_way = false\n"
            "[mesh]\nsize_m = 10\ncontact_size_m = 10\n[time]\ndt_s = 0.01\nsubsteps = 0\n"
            "[[motion.record]]\nname = \"pulse\"\nhorizontal = \"pulse.csv\"\nunit = \"m/s2\"\n"
            "[probability]\nseed = 1\n" +
                t.sampling + "[[probability.variable]]\nname = \"mu\"\nkey = \"contact.friction\"\n" + t.variable +
                "[suite]\n" + t.suite + "[[limit]]\nquantity = \"slip\"\nabove_mm = 200\n[intensity]\n" + t.intensity +
                t.more);
    }

    /// `damslip COMMAND scene ...`
    ProgramAnswer ask(const std::string& command, const std::vector<std::string>& more) const
    {
        std::vector<std::string> all{command, scene.string(), "--jobs", "1"};
        all.insert(all.end(), more.begin(), more.end());
        return answer_of(all);
    }
    ProgramAnswer fragility(std::vector<std::string> more) const
    {
        more.insert(more.end(), {"--share-rows", "0"});
        return ask("fragility", more);
    }

    std::string out(const std::string& name) const { return (folder / name).string(); }
    std::string bytes(const std::string& of, const std::string& file) const { return read_file(folder / of / file); }

    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / fmt::format("damslip pulse study {}", ::getpid());
    const std::filesystem::path scene = folder / "dam.toml";
};

} // namespace damslip::pulse
