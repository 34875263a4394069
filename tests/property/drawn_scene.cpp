#include "drawn_scene.hpp"

#include "scene/section.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::property {

namespace {

/// Triangles one after the other, of either sign.
std::vector<double> pulses(random::Draw& draw, int samples, double peak)
{
    std::vector<double> a(static_cast<std::size_t>(samples), 0.0);
    for (int start = 2; start + 12 < samples;) {
        const int width = draw.whole(6, 24);
        const double top = draw.between(-1.0, 1.0) * peak;
        for (int i = 0; i <= width && start + i < samples - 1; ++i)
            a[static_cast<std::size_t>(start + i)] = top * (1.0 - std::abs(2.0 * i / width - 1.0));
        start += width;
    }
    return a;
}

} // namespace

Drawn draw(std::uint32_t seed, Rock rock)
{
    random::Draw draw = random::seeded(seed);
    Drawn drawn;
    Scene& scene = drawn.scene;
    scene.file = "drawn.toml";
    const double base = draw.log_between(4.0, 40.0), height = base * draw.between(0.6, 1.4),
                 crest = base * draw.between(0.15, 0.5), batter = draw.chance(0.5) ? 0.0 : 0.1 * base;
    scene.section.polygon = {{0, 0}, {base, 0}, {batter + crest, height}, {batter, height}};
    scene.dam = {draw.between(2200, 2600), 1e9 * draw.between(15, 35), 0.2};
    if (rock != Rock::rigid)
        scene.foundation = Foundation{.material = {0.0, 1e9 * draw.between(10, 40), 0.25},
                                      .mass = RockMass::massless,
                                      .width = 4 * base,
                                      .depth = 1.5 * base};
    scene.reservoir = Reservoir{.level = height * draw.between(0.5, 0.9), .model = ReservoirModel::added_mass};
    scene.uplift.emplace().model = UpliftModel::linear;
    if (draw.chance(0.5)) scene.tailwater = Tailwater{0.1 * height};
    scene.mesh.size = base / 4;
    scene.mesh.contact_size = base / 6;
    scene.mesh.growth = 1.5;
    scene.damping.ratio = draw.between(0.02, 0.08);
    scene.damping.second_mode = 3;
    scene.time.substeps = 0;
    scene.contact.friction = 1.0; // the loads do not depend on it
    scene.contact.friction = sliding::critical_friction(sliding::make_rigid_block(scene)) * draw.between(1.15, 1.5);

    drawn.motion.name = "pulses";
    drawn.motion.dt = 0.01;
    drawn.motion.accel_h = pulses(draw, 120, 5.0);
    drawn.motion.accel_v = pulses(draw, 120, 3.0);
    if (rock == Rock::radiating) {
        scene.foundation->mass = RockMass::with_mass;
        scene.foundation->boundary = RockBoundary::absorbing;
        scene.foundation->wave_frequency = draw.between(10.0, 25.0); // a frequency, which scaled() knows of
        if (draw.chance(0.5)) scene.foundation->material.density = draw.between(2300.0, 2900.0);
    }
    return drawn;
}

Drawn scaled(const Drawn& drawn, double length)
{
    const double time = std::sqrt(length);
    Drawn result = drawn;
    Scene& s = result.scene;
    for (Point& p : s.section.polygon) p = {p.x * length, p.y * length};
    s.dam.young_modulus = *s.dam.young_modulus * length;
    if (s.foundation) {
        s.foundation->material.young_modulus = *s.foundation->material.young_modulus * length;
        s.foundation->width *= length;
        s.foundation->depth *= length;
        if (s.foundation->wave_frequency) s.foundation->wave_frequency = *s.foundation->wave_frequency / time;
    }
    s.reservoir->level *= length;
    s.reservoir->bulk_modulus *= length;
    s.reservoir->length *= length;
    if (s.reservoir->mesh_size) s.reservoir->mesh_size = *s.reservoir->mesh_size * length;
    if (s.tailwater) s.tailwater->level *= length;
    s.contact.cohesion *= length;
    s.contact.residual_slip *= length;
    s.mesh.size = *s.mesh.size * length;
    s.mesh.contact_size = *s.mesh.contact_size * length;
    s.sliding.run_out_max *= time;
    result.motion.dt *= time;
    return result;
}

GroundMotion times(GroundMotion motion, double factor)
{
    for (auto* component : {&motion.accel_h, &motion.accel_v})
        for (double& a : *component) a *= factor;
    return motion;
}

GroundMotion subdivided(const GroundMotion& motion, int parts)
{
    const auto refined = [parts](const std::vector<double>& a) {
        std::vector<double> fine;
        for (std::size_t k = 0; k + 1 < a.size(); ++k)
            for (int i = 0; i < parts; ++i) fine.push_back(a[k] + (a[k + 1] - a[k]) * i / parts);
        if (!a.empty()) fine.push_back(a.back());
        return fine;
    };
    GroundMotion fine = motion;
    fine.dt = motion.dt / parts;
    fine.accel_h = refined(motion.accel_h);
    fine.accel_v = refined(motion.accel_v);
    return fine;
}

} // namespace damslip::property
