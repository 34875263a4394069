// Rows of a rigid sweep on a seam with a passive wedge against rows of the base, nanoseconds per row and their ratio: at most 2.
// Then the screening of a dam with 30 lifts and two seams, processor time: at most 0.3 s.
//
// The same artificial motions, scales and frictions for both; "slides": rows of one model, "models": making one for each friction,
// the angle of the wedge searched.
#include "analysis/prepare/plane_model.hpp"
#include "analysis/screen/screening.hpp"
#include "core/parallel.hpp"
#include "scene/read.hpp"
#include "source_dir.hpp"
#include "verification/exact/reference_scene.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <random>

namespace {

using namespace damslip;

GroundMotion artificial()
{
    std::mt19937 random(7);
    GroundMotion motion{"artificial", 0.005, {0.0}, {}, {}};
    double u = 0.0, v = 0.0;
    for (double t = 0.005; t < 30.0; t += 0.005) {
        double noise = 0.0;
        for (int i = 0; i < 4; ++i) noise += static_cast<double>(random()) / 4294967296.0 - 0.5;
        v += 0.005 * (20.0 * noise - 19.0 * v - 247.0 * u);
        u += 0.005 * v;
        motion.accel_h.push_back(25.0 * std::min(1.0, t / 4.0) * std::exp(-0.15 * std::max(0.0, t - 8.0)) * (19.0 * v + 247.0 * u));
    }
    return motion;
}

double seconds(const std::function<void()>& work)
{
    double best = 1e9;
    for (int i = 0; i < 7; ++i) {
        const ProcessorClock clock;
        work();
        best = std::min(best, clock.seconds());
    }
    return best;
}

/// The dam of examples/lifts_dam.toml with a lift every 2 m, the seam of examples/seam_dam.toml and a second one below it.
Scene many_planes()
{
    const std::string examples = std::string(source_dir()) + "/examples/";
    Scene scene = read_scene(examples + "lifts_dam.toml");
    const Scene on_seam = read_scene(examples + "seam_dam.toml");
    scene.lifts->spacing = 2.0;
    scene.foundation = on_seam.foundation;
    scene.drains->depth = on_seam.drains->depth;
    scene.seams = {on_seam.seams[0], on_seam.seams[0]};
    scene.seams[1].name = "second seam";
    scene.seams[1].depth = 14.0;
    scene.seams[1].strength.friction = 0.9;
    return scene;
}

double seconds_of_screening()
{
    const Scene scene = many_planes();
    double best = 1e9;
    for (int i = 0; i < 5; ++i) {
        const ProcessorClock clock(ProcessorTimeOf::process);
        const Screening screening = run_screening(prepare(scene, Method::rigid_block), 1);
        best = std::min(best, clock.seconds());
        if (i == 0) std::printf("screen of %zu planes", screening.planes.rows.size());
    }
    std::printf(": %.4f s of processor time (at most 0.3)\n", best);
    return best;
}

} // namespace

int main()
{
    Scene scene = exact::seam_scene();
    scene.seams[0].wedge->angles.clear();
    const GroundMotion motion = artificial();
    std::vector<sliding::SkippingMotion> motions;
    for (int i = 1; i <= 20; ++i) {
        GroundMotion scaled = motion;
        for (double& a : scaled.accel_h) a *= 0.1 * i;
        motions.emplace_back(std::move(scaled));
    }
    double slides[2], models[2], sum = 0.0;
    for (const bool on_seam : {false, true}) {
        KeptStatics kept;
        const auto model = [&](double friction) {
            Scene here = scene;
            here.planes.slides_on = on_seam ? here.seams[0].name : "";
            (on_seam ? here.seams[0].strength : here.contact).friction = friction;
            return make_rigid_model(here, {}, std::nullopt, &kept);
        };
        // Frictions at which both start to slide alike.
        const RigidModel one = model(on_seam ? 0.7 : 0.77);
        slides[on_seam] = seconds([&] {
            for (const sliding::SkippingMotion& m : motions)
                for (const int polarity : {1, -1}) sum += slide_model(scene, one, m, polarity).max_slip;
        }) / 40.0;
        models[on_seam] = seconds([&] {
            for (int i = 0; i < 20; ++i) sum += model((on_seam ? 0.7 : 0.77) + 0.001 * i).downstream.law.constant;
        }) / 20.0;
        std::printf("%-6s a_y %.3f m/s2   slides %10.0f ns/row   models %10.0f ns\n", on_seam ? "seam" : "base",
                    one.downstream.law.constant, 1e9 * slides[on_seam], 1e9 * models[on_seam]);
    }
    std::printf("seam over base: slides %.2f (at most 2), models %.2f   (%g)\n", slides[1] / slides[0], models[1] / models[0], sum);
    const double screening = seconds_of_screening();
    return slides[1] <= 2.0 * slides[0] && screening <= 0.3 ? 0 : 1;
}
