// Sizes of a sweep: every length of a scene grows, nothing else does, and a run does not tell a grown scene from one
// that was written so.
#include "analysis/prepare/rigid_model.hpp"
#include "analysis/sweep/sweep_grid.hpp"
#include "core/text.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"
#include "sweep_scene.hpp"

#include <nlohmann/json.hpp>

namespace damslip::sweep_tests {

namespace {

/// The text with each @number@ replaced by factor x number.
std::string scaled_text(const std::string& text, double factor)
{
    std::string out;
    std::size_t at = 0;
    for (std::size_t open; (open = text.find('@', at)) != std::string::npos;) {
        const std::size_t close = text.find('@', open + 1);
        out += text.substr(at, open - at);
        out += shortest(factor * *parse_whole_number_text(text.substr(open + 1, close - open - 1)));
        at = close + 1;
    }
    return out + text.substr(at);
}

/// Every key that is a length of the geometry, in @...@; slips and clearances are not.
const char* const all_lengths = R"(
[section]
polygon_m = [[0, 0], [@45@, 0], [@12@, @51.5@], [@12@, @62.5@], [0, @62.5@]]
[dam]
density_kg_m3 = 2500
young_modulus_GPa = 25
[foundation]
young_modulus_GPa = 30
width_m = @300@
depth_m = @110@
mass = "massless"
density_kg_m3 = 2650
ground_m = [[@-50@, 0], [@80@, @4@]]
[curtain]
distance_m = @7@
depth_m = @30@
thickness_m = @1.5@
[drains]
distance_m = @9@
depth_m = @12@
gallery_level_m = @3@
lost_at_slip_m = 0.05
[reservoir]
level_m = @60@
length_m = @150@
mesh_size_m = @2@
[tailwater]
level_m = @5@
[silt]
level_m = @10@
submerged_unit_weight_kN_m3 = 8
pressure_coefficient = 0.4
[ice]
force_kN_m = 100
level_m = @59@
[[force]]
x_m = @6@
y_m = @62.5@
force_x_kN_m = 10
[uplift]
model = "points"
points_m = [[0, 1], [@10@, 0.5], [@45@, 0.1]]
[contact]
friction = 0.77
residual_friction = 0.6
residual_slip_m = 0.02
[[lift_joint]]
elevation_m = @51.5@
friction = 0.9
[lifts]
spacing_m = @6@
from_m = @6@
to_m = @48@
friction = 0.8
uplift = "drains"
drains_distance_m = @3@
gallery_level_m = @4@
amplification = "points"
amplification_points_m = [[0, 1], [@60@, 3]]
[[seam]]
name = "bent"
points_m = [[0, @-6@], [@60@, @-9@]]
friction = 0.6
uplift = "points"
uplift_points_m = [[0, 1], [@50@, 0.3]]
[seam.wedge]
friction = 0.8
distance_m = @0@
[[seam]]
name = "straight"
depth_m = @8@
friction = 0.6
[seam.wedge]
friction = 0.8
distance_m = @5@
[[combination]]
name = "flood"
reservoir_level_m = @62@
tailwater_level_m = @6@
[mesh]
size_m = @2@
contact_size_m = @0.75@
rock_contact_size_m = @1.25@
[criteria]
allowable_slip_mm = 50
)";

// Factors that are powers of two: each product is exact, so the scenes have to agree to the last digit.
TEST(SweepSizeOfScene, GrowsEveryLengthAndNothingElse)
{
    const Scene scene = parse_scene(scaled_text(all_lengths, 1.0), "dam.toml");
    for (const double factor : {2.0, 0.5}) {
        const Scene written = parse_scene(scaled_text(all_lengths, factor), "dam.toml");
        EXPECT_EQ(resolved_toml(sized(scene, factor)), resolved_toml(written)) << factor;
    }
    EXPECT_EQ(resolved_toml(sized(scene, 1.0)), resolved_toml(scene));
}

TEST_F(SweepScene, ARowOfSizeTwoIsTheRunOfASceneTwiceAsLarge)
{
    const std::vector<std::string> methods{"--method", "rigid,fe,fe-reduced", "--polarity", "1", "--json"};
    const Answer grown = sweep(with(methods, {"--size", "2"}));
    ASSERT_EQ(grown.code, 0) << grown.talk;
    std::string text = content("block.toml");
    const auto replace = [&text](const std::string& from, const std::string& to) {
        ASSERT_NE(text.find(from), std::string::npos) << from;
        text.replace(text.find(from), from.size(), to);
    };
    replace("[8, 0], [8, 2], [0, 2]", "[16, 0], [16, 4], [0, 4]");
    replace("level_m = 1", "level_m = 2");
    replace("size_m = 1\ncontact_size_m = 1", "size_m = 2\ncontact_size_m = 2");
    write("large.toml", text);
    const Answer written = answer_of(with({"sweep", path("large.toml")}, methods));
    ASSERT_EQ(written.code, 0) << written.talk;
    const auto a = nlohmann::json::parse(grown.out)["rows"], b = nlohmann::json::parse(written.out)["rows"];
    ASSERT_EQ(a.size(), 6u);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (const char* key : {"slip_m", "max_slip_m", "yield_acceleration_m_s2", "critical_friction", "level_m"})
            EXPECT_EQ(a[i][key], b[i][key]) << key << " " << i;
}

} // namespace

} // namespace damslip::sweep_tests
