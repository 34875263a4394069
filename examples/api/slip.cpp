// Slip of a dam as a rigid block and by finite elements, with the libraries of damslip:  slip SCENE
#include "core/input_error.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "records/read/read_record.hpp"
#include "records/transform/ground_motion.hpp"
#include "scene/read.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/block/yield.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "sliding/loads/added_mass.hpp"
#include "sliding/uplift/uplift_profile.hpp"

#include <cstdio>

using namespace damslip;

int main(int, char** argv)
try {
    const Scene scene = read_scene(argv[1]); // checked, SI, defaults filled in
    const Record horizontal = records::read_record(scene.motion.records.at(0).horizontal);
    const GroundMotion motion = records::make_ground_motion(horizontal, {});

    const sliding::RigidBlock block = sliding::make_rigid_block(scene);
    std::printf("yield acceleration  %.6f m/s2\n", sliding::yield_acceleration(block));
    std::printf("slip, rigid block   %.4f mm\n", 1e3 * sliding::slide(motion, block, {scene.sliding}).slip);

    fe2d::RunOptions options; // fe2d knows nothing of sliding: the loads on the base and the face are handed over
    options.halvings = 2;     // steps dt/4; without: chosen so that the slip is within 1 %
    for (const auto& p : sliding::uplift_profile(scene, sliding::scene_uplift_state(scene)).points)
        options.uplift.push_back({p.distance, p.pressure});
    const sliding::WaterColumn water{scene.reservoir->level, scene.reservoir->density, scene.reservoir->bulk_modulus};
    options.added_mass = [&](Point at, double face_angle) {
        return sliding::added_mass_per_area(scene.added_mass, water, water.depth - at.y, face_angle);
    };
    const fe2d::RunResult result = fe2d::EarthquakeRun(scene, options).run(motion);
    std::printf("slip, elastic dam   %.4f mm  (%s)\n", 1e3 * result.slip, result.message.c_str());
} catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what()); // file, line, value, what is allowed, what to do
    return 3;
}
