#include "key_scenes.hpp"

#include <algorithm>

namespace damslip::audit3 {

namespace {

class Audit3Drains : public KeyScene {
protected:
    /// Drains near the heel. @param lost  lost_at_slip_m; empty: they hold
    Tables drained(const std::string& lost) const
    {
        Tables dam = small_dam();
        set(dam, "uplift.model", "\"drains\"");
        set(dam, "drains.distance_m", "4");
        set(dam, "contact.friction", "0.75");
        if (!lost.empty()) set(dam, "drains.lost_at_slip_m", lost);
        return dam;
    }
    Json fe(const Tables& dam) const { return json({"fe", "--no-mesh-error"}, toml_of(dam)); }
    static double slip(const Json& answer) { return answer["runs"][0]["max_slip_m"].get<double>(); }
};

TEST_F(Audit3Drains, A1_DrainsLostAtSlipInFiniteElements)
{
    Tables linear = drained("");
    set(linear, "uplift.model", "\"linear\"");
    const double held = slip(fe(drained(""))), never_there = slip(fe(linear));
    const Json answer = fe(drained("0.002"));
    const double lost = slip(answer);
    EXPECT_GT(lost, 1.5 * held);
    EXPECT_LT(lost, never_there);
    // A slip that is never reached leaves the bits as they are without the key, but for the round-off of the laws' solver.
    EXPECT_NEAR(slip(fe(drained("0.5"))), held, 1e-9 * held);
    // The later they are lost, the less it slips.
    EXPECT_LT(slip(fe(drained("0.01"))), lost);

    EXPECT_LT(answer["runs"][0]["energy_error"].get<double>(), 1e-9);
    EXPECT_NE(answer["base_water"][0]["water_work_J_m"].get<double>(), 0.0);
    const double at = answer["base_water"][0]["drains_lost_s"].get<double>();
    EXPECT_GT(at, 0.1);
    EXPECT_LT(at, 2.4);
    const auto said = [](const Json& message) {
        return message.get<std::string>().find("the drains sheared off at") != std::string::npos;
    };
    EXPECT_TRUE(std::any_of(answer["messages"].begin(), answer["messages"].end(), said)) << answer["messages"];

    const Json few = json({"fe", "--no-mesh-error", "--reduced"}, toml_of(drained("0.002")));
    EXPECT_NEAR(slip(few), lost, 0.02 * lost);
    EXPECT_TRUE(std::any_of(few["messages"].begin(), few["messages"].end(), said)) << few["messages"];
}

/// A dam that does not deform slides as the rigid block does.
TEST_F(Audit3Drains, A1_DrainsLostAsTheRigidBlock)
{
    for (const char* lost : {"0.005", "1e-5"}) {
        Tables dam = drained(lost);
        set(dam, "dam.young_modulus_GPa", "2e7");
        set(dam, "damping.method", "\"none\"");
        set(dam, "time.substeps", "4");
        const Json answer = fe(dam);
        const double rigid = 1e-3 * answer["runs"][0]["slip_rigid_mm"].get<double>();
        EXPECT_GT(rigid, 0.02);
        EXPECT_NEAR(slip(answer), rigid, 0.01 * rigid) << lost;
    }
}

/// What an earthquake has sheared off stays lost in the next one, with and without water in the crack between them.
TEST_F(Audit3Drains, A1_DrainsStayLostInTheNextEarthquake)
{
    const std::string state = (folder / "state.json").string();
    const Tables dam = drained("0.002");
    json({"fe", "--no-mesh-error", "--state-out", state}, toml_of(dam));
    const Json again = json({"fe", "--no-mesh-error", "--state-in", state}, toml_of(dam));
    EXPECT_EQ(again["base_water"][0]["drains_lost_s"].get<double>(), 0.0);
    Tables sequence = dam;
    set(sequence, "motion.sequence", "[\"a\", \"a\"]");
    const double one_after_the_other = slip(fe(sequence));
    EXPECT_NEAR(again["runs"][0]["slip_mm"].get<double>() * 1e-3 + slip(fe(dam)), one_after_the_other,
                0.02 * one_after_the_other);
    set(sequence, "uplift.after", "\"full\""); // with water in the crack nothing holds the dam
    const Json full = fe(sequence);
    EXPECT_TRUE(full["runs"][0]["max_slip_m"].is_null() || slip(full) > one_after_the_other) << full["runs"];
}

TEST_F(Audit3Drains, A1_DrainsLostWhereTheyCannotBeFollowedAreRefused)
{
    const auto refused = [&](Tables dam, const char* key, const char* value, std::vector<std::string> command,
                             const char* words) {
        set(dam, key, value);
        const ProgramAnswer answer = run(std::move(command), toml_of(dam));
        EXPECT_NE(answer.code, 0);
        EXPECT_NE(answer.talk.find(words), std::string::npos) << answer.talk;
    };
    const Tables dam = drained("0.002");
    refused(dam, "time.scheme", "\"central-difference\"", {"fe"}, "drains.lost_at_slip_m with time.scheme");
    refused(dam, "uplift.opening", "\"reynolds\"", {"fe"}, "drains.lost_at_slip_m with uplift.opening");
}

} // namespace

} // namespace damslip::audit3
