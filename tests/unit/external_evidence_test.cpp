// Results of others: what is in the program, and SLAMMER's schemes against the exact analyses they approximate.
#include "verifier_answer.hpp"

#include "sliding/flexible/flexible_mode.hpp"
#include "verification/external/external.hpp"
#include "verification/external/slammer_scheme.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace {

using namespace damslip;
using namespace damslip::external;

// A miss has its reason; the two there are, Pine Flat on flexible rock, are computed beside it in docs/evidence.md.
TEST(ExternalEvidence, EverySourceHasItsCitationAndAccuracy)
{
    for (const Source& source : all_sources())
        EXPECT_FALSE(source.citation.empty() || source.accuracy.empty()) << source.id;
}

/// Two sines under an envelope [m/s^2].
std::vector<double> shaking(double dt)
{
    std::vector<double> accel;
    for (double t = 0.0; t < 8.0; t += dt)
        accel.push_back(std::sin(std::numbers::pi * t / 8.0) * (3.0 * std::sin(7.0 * t) + 2.0 * std::sin(23.0 * t)));
    return accel;
}

// Slips of both schemes tend to the exact ones with their step, of first order: 0.7 % at 1/8 ms is what is left there.
TEST(ExternalEvidence, SlammersSchemesTendToTheExactAnalyses)
{
    const SlammerColumn column{2.0 * std::numbers::pi / 0.5, 0.15};
    const double yield = 1.0, coarse = 0.01;
    sliding::RigidBlock block;
    block.mass = 1.0;
    block.friction = yield / block.gravity;
    const sliding::SlipStages stages{{0.0, block, 0.0}};
    const sliding::FlexibleBlock flexible{0.5, 0.15};
    sliding::SlideOptions options;
    options.sliding.two_way = false;
    const std::vector<double> samples = shaking(coarse);
    const GroundMotion motion{"two sines", coarse, samples, {}, {}};
    const double decoupled = sliding::slide_decoupled(motion, stages, flexible, options).slide.slip,
                 coupled = sliding::slide_coupled(motion, stages, flexible, options).slide.slip;
    double last[2] = {1.0, 1.0};
    for (const int parts : {1, 8, 80}) {
        std::vector<double> fine;
        for (std::size_t k = 0; k + 1 < samples.size(); ++k)
            for (int i = 0; i < parts; ++i) fine.push_back(samples[k] + (samples[k + 1] - samples[k]) * i / parts);
        const double dt = coarse / parts;
        const double error[2] = {
            std::abs(slammer_decoupled(slammer_response(column, fine, dt).drive, dt, yield) / decoupled - 1.0),
            std::abs(slammer_coupled(column, fine, dt, yield) / coupled - 1.0)};
        for (int k : {0, 1}) {
            EXPECT_LT(error[k], 0.6 * last[k]) << "parts " << parts << (k ? ", coupled" : ", decoupled");
            last[k] = error[k];
        }
    }
    EXPECT_LT(last[0], 0.002);
    EXPECT_LT(last[1], 0.007);
}

// The set's own file is named when it is not there.
TEST(ExternalEvidence, AMissingSetIsNamed)
{
    const Source slammer = all_sources().front();
    ASSERT_EQ(slammer.id, "slammer");
    try {
        slammer.run("/nowhere");
        FAIL();
    } catch (const std::exception& error) {
        EXPECT_NE(std::string(error.what()).find("slammer_results.json.gz"), std::string::npos) << error.what();
    }
}

// A folder that is named and does not hold the set is an error, not a smaller answer.
TEST(ExternalEvidence, AFolderWithoutTheSetIsRefused)
{
    const ProgramAnswer a = verifier_answer({"verify", "--external", "/nowhere", "--quiet"});
    EXPECT_EQ(a.code, 3);
    EXPECT_NE(a.talk.find("slammer_results.json.gz"), std::string::npos) << a.talk;
}

// Without a folder: all that the program holds; what lies outside is Pine Flat's base that bends, and its reason has numbers.
TEST(ExternalEvidence, WithoutAFolderEveryMissHasItsReason)
{
    const ProgramAnswer a = verifier_answer({"verify", "--external", "--quiet", "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto j = nlohmann::json::parse(a.out);
    EXPECT_GE(j["numbers"], 106);
    EXPECT_EQ(j["without_reason"], 0);
    ASSERT_EQ(j["outside"].size(), 2u);
    for (const auto& miss : j["outside"]) {
        EXPECT_NE(miss["what"].get<std::string>().find("elastic base"), std::string::npos);
        const std::string reason = miss["reason"];
        EXPECT_NE(reason.find("rigid strip 0."), std::string::npos) << reason;
        EXPECT_EQ(reason.find("nan"), std::string::npos) << reason;
    }
}

} // namespace
