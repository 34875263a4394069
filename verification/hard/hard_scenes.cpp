#include "verification/hard/hard_scenes.hpp"

#include "analysis/prepare/ready.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::hard {

Scene stiff_dam(double friction)
{
    Scene scene = fe2d::test::sliding_dam(friction, 1e4, 5.0);
    scene.mesh.size = 8.0;
    return scene;
}

Scene soft_dam(double friction)
{
    Scene scene = fe2d::test::sliding_dam(friction, 1.0, 5.0);
    scene.mesh.size = 8.0;
    return scene;
}

Scene stiff_block(double base, double height, double friction)
{
    Scene scene = exact::bare_scene({{0, 0}, {base, 0}, {base, height}, {0, height}}, 2400.0);
    scene.dam.young_modulus = 3e12;
    scene.dam.poisson_ratio = 0.0;
    scene.contact.friction = friction;
    scene.mesh.size = base / 6.0;
    scene.mesh.contact_size = base / 8.0;
    scene.damping.method = DampingMethod::none;
    return scene;
}

fe2d::RunResult fe_run(Scene scene, const GroundMotion& motion, std::optional<int> halvings)
{
    if (halvings) scene.time.substeps = halvings;
    const Watch nobody;
    const Ready ready = prepare(scene, Method::finite_elements, nullptr);
    return fe2d::EarthquakeRun(ready.scene, ready.run_options(nobody)).run(motion);
}

sliding::SlideResult rigid_run(const Scene& scene, const GroundMotion& motion)
{
    const Ready ready = prepare(scene, Method::rigid_block, nullptr);
    return slide_model(ready.scene, ready.rigid_model(), motion, 1);
}

double friction_that_holds(const Scene& scene)
{
    return prepare(scene, Method::rigid_block, nullptr).rigid_model().critical_friction;
}

Scene with_friction_over(Scene scene, double factor)
{
    scene.contact.friction = factor * friction_that_holds(scene);
    return scene;
}

HardResult result_of(const fe2d::RunResult& run)
{
    HardResult result;
    result.value_a = run.slip;
    result.complementarity = run.counts.largest_residual;
    double scale = 0.0, imbalance = 0.0;
    for (std::size_t k = 0; k < run.history.energy.size(); ++k) {
        scale = std::max(scale, run.history.energy[k].scale());
        imbalance = std::max(imbalance, std::abs(run.history.imbalance[k]));
    }
    if (scale > 0.0) result.energy_closure = imbalance / scale;
    result.status = word(run.status);
    return result;
}

HardResult compared(const fe2d::RunResult& run, double value_b, double tolerance)
{
    HardResult result = result_of(run);
    result.value_b = value_b;
    result.tolerance = tolerance;
    return result;
}

HardResult compared(const fe2d::RunResult& run, const fe2d::RunResult& other, double tolerance)
{
    HardResult result = compared(run, other.slip, tolerance);
    const HardResult b = result_of(other);
    result.complementarity = std::max(*result.complementarity, *b.complementarity);
    result.energy_closure = std::max(result.energy_closure.value_or(0.0), b.energy_closure.value_or(0.0));
    if (b.status != "at rest") result.status += ", the other " + b.status;
    return result;
}

HardResult against_rigid(const Scene& scene, const GroundMotion& motion, double share)
{
    const double rigid = rigid_run(scene, motion).slip;
    return compared(fe_run(scene, motion), rigid, share * std::abs(rigid));
}

GroundMotion silence(double duration, double dt)
{
    GroundMotion motion;
    motion.name = "silence";
    motion.dt = dt;
    motion.accel_h.assign(static_cast<std::size_t>(std::lround(duration / dt)) + 1, 0.0);
    return motion;
}

GroundMotion push(double acceleration, double seconds, double duration, double start, double dt)
{
    GroundMotion motion = silence(duration, dt);
    motion.name = "push";
    for (std::size_t k = 1; k < motion.accel_h.size(); ++k) {
        const double t = static_cast<double>(k) * dt;
        if (t > start && t < start + seconds - 0.5 * dt) motion.accel_h[k] = acceleration;
    }
    return motion;
}

GroundMotion scaled(GroundMotion motion, double factor)
{
    for (auto* a : {&motion.accel_h, &motion.accel_v})
        for (double& value : *a) value *= factor;
    return motion;
}

double double_integral(const GroundMotion& motion)
{
    const std::vector<double>& a = motion.accel_h;
    const double dt = motion.dt;
    double velocity = 0.0, displacement = 0.0;
    for (std::size_t k = 1; k < a.size(); ++k) {
        displacement += velocity * dt + dt * dt * (2.0 * a[k - 1] + a[k]) / 6.0;
        velocity += 0.5 * dt * (a[k - 1] + a[k]);
    }
    return displacement;
}

} // namespace damslip::hard
