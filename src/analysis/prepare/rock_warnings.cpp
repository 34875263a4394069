#include "analysis/prepare/rock_warnings.hpp"

#include "fe2d/material/elastic.hpp"
#include "fe2d/model/edge_dashpots.hpp"
#include "records/measure/frequency_content.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

constexpr double elements_per_wave = 8.0;
constexpr double share_of_record = 0.95;

/// Longest edge of the rock's elements [m].
double longest_edge(const fe2d::Mesh& mesh)
{
    double longest = 0.0;
    for (const fe2d::Element& element : mesh.elements) {
        if (element.region == fe2d::Region::dam) continue;
        const auto corner = fe2d::corners(mesh, element);
        for (int i = 0; i < element.size(); ++i) {
            const Point a = corner[static_cast<std::size_t>(i)],
                        b = corner[static_cast<std::size_t>((i + 1) % element.size())];
            longest = std::max(longest, std::hypot(b.x - a.x, b.y - a.y));
        }
    }
    return longest;
}

} // namespace

std::vector<std::string> rock_warnings(const Scene& scene, const fe2d::Mesh& mesh, const GroundMotion& motion)
{
    std::vector<std::string> warnings;
    if (!rock_is_boxed(scene)) return warnings;
    const fe2d::ElasticWaves c =
        fe2d::elastic_waves(fe2d::elastic_material(scene.foundation->material, scene, "foundation"));
    if (!rock_edges_are_viscous(scene)) {
        const double depth = scene.foundation->depth;
        warnings.push_back(fmt::format(
            "foundation.boundary = \"fixed\": the record moves the edges of the rock box, whose waves do not leave: it "
            "resonates at {:.3g} Hz (shear, c_s/4H) and {:.3g} Hz (compression, c_p/4H) and above; \"viscous\" lets "
            "them go",
            0.25 * c.s / depth, 0.25 * c.p / depth));
    }
    const double base = base_length(scene.section);
    if (rock_edges_are_viscous(scene) && scene.foundation->depth < 4.0 * base)
        warnings.push_back(
            fmt::format("the rock box is {:.3g} base lengths deep: dashpots below it lack the stiffness of deeper rock "
                        "for waves longer than the box; 4 or more, {:.3g} m, move the slip by few per cent",
                        scene.foundation->depth / base, 4.0 * base));
    const double size = longest_edge(mesh);
    const auto check = [&](const std::vector<double>& accel, double speed, const char* which) {
        if (accel.empty()) return;
        const double frequency = records::frequency_below(accel, motion.dt, share_of_record);
        const double elements = frequency > 0.0 ? speed / (frequency * size) : elements_per_wave;
        if (elements < elements_per_wave)
            warnings.push_back(fmt::format("rock elements of up to {:.3g} m: {:.2g} to a {} wave of {:.3g} Hz, below "
                                           "which {:.0f} % of the record's "
                                           "energy lies; {:.0f} are wanted: mesh.rock_size_m of {:.3g} m or less",
                                           size, elements, which, frequency, 100.0 * share_of_record, elements_per_wave,
                                           size * elements / elements_per_wave));
    };
    check(motion.accel_h, c.s, "shear");
    check(motion.accel_v, c.p, "compression");
    return warnings;
}

} // namespace damslip
