#pragma once

#include "fe2d/run/earthquake_run.hpp"
#include "sliding/loads/added_mass.hpp"
#include "sliding/uplift/uplift.hpp"
#include "verification/exact/reference_scene.hpp"

#include <cmath>
#include <numbers>
#include <random>

/// Scenes, loads and motions of the FE run tests.
namespace damslip::fe2d::test {

/// The reference dam on its rock with curtain, uplift points and Westergaard's rigorous added mass, coarse enough for
/// tests. `stiffness` multiplies all Young's moduli.
inline Scene sliding_dam(double friction, double stiffness = 1.0, double contact_size = 2.5)
{
    Scene scene = exact::reference_scene(exact::ReferenceUplift::points, friction);
    scene.dam.young_modulus = 25e9 * stiffness;
    scene.dam.poisson_ratio = 0.17;
    scene.foundation = Foundation{
        .material = {0.0, 30e9 * stiffness, 0.2}, .mass = RockMass::massless, .width = 300.0, .depth = 100.0};
    scene.curtain = Curtain{.distance = 7.0, .depth = 30.0, .thickness = 1.0, .young_modulus = 27e9 * stiffness};
    scene.reservoir->model = ReservoirModel::added_mass;
    scene.added_mass.formula = AddedMassFormula::westergaard;
    scene.mesh.contact_size = contact_size;
    scene.mesh.size = 4.0;
    return scene;
}

/// Added mass and uplift from the sliding module, as the program passes them.
inline RunOptions options_of(const Scene& scene)
{
    RunOptions options;
    if (scene.reservoir && scene.reservoir->model == ReservoirModel::added_mass) {
        const sliding::WaterColumn water{scene.reservoir->level, scene.reservoir->density,
                                         scene.reservoir->bulk_modulus};
        const AddedMass method = scene.added_mass;
        options.added_mass = [water, method](Point at, double face_angle) {
            return sliding::added_mass_per_area(method, water, water.depth - at.y, face_angle);
        };
    }
    if (scene.uplift) options.uplift = sliding::uplift_profile(scene, scene_uplift_state(scene));
    return options;
}

/// Forty sines of 0.5 ... 10 Hz with random phases under a trapezoidal envelope; peak `pga`, vertical 0.67 of it.
inline GroundMotion sines(double pga, double duration = 20.0, unsigned seed = 5, double dt = 0.01)
{
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; }; // the same on every machine
    GroundMotion motion;
    motion.name = "sines";
    motion.dt = dt;
    const auto samples = static_cast<std::size_t>(std::lround(duration / dt)) + 1;
    for (auto* a : {&motion.accel_h, &motion.accel_v}) {
        std::vector<double> frequency, phase, amplitude;
        for (int k = 0; k < 40; ++k) {
            frequency.push_back(0.5 * std::pow(20.0, uniform()));
            phase.push_back(2.0 * std::numbers::pi * uniform());
            amplitude.push_back(uniform());
        }
        double largest = 0.0;
        for (std::size_t i = 0; i < samples; ++i) {
            const double t = static_cast<double>(i) * dt;
            double sum = 0.0;
            for (std::size_t k = 0; k < 40; ++k)
                sum += amplitude[k] * std::sin(2.0 * std::numbers::pi * frequency[k] * t + phase[k]);
            a->push_back(sum * std::clamp(std::min(t / 2.0, (duration - t) / 4.0), 0.0, 1.0));
            largest = std::max(largest, std::abs(a->back()));
        }
        const double scale = (a == &motion.accel_h ? 1.0 : 0.67) * pga / largest;
        for (double& value : *a) value *= scale;
    }
    return motion;
}

inline GroundMotion flipped(GroundMotion motion)
{
    for (double& a : motion.accel_h) a = -a;
    return motion;
}

} // namespace damslip::fe2d::test
