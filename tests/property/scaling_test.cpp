// A dam L times as large, with the same densities, gravity, friction and accelerations.
//
// Forces per metre of length are weights and water thrusts, rho g L²; masses (added mass rho h per area included) go with
// L², so accelerations, yield accelerations among them, are the same. With L/T² the same, times go with T = sqrt(L) and
// slips, a T², with L. That is all of the rigid block; a cohesion stress has to go with L, a slip limit too.
//
// An elastic dam has displacements u ~ L, strains ~ 1 and stresses ~ rho g L, so moduli have to go with L: those of dam,
// rock and curtain, and the bulk modulus of acoustic water, whose wave speed then goes with L/T. Rayleigh's coefficients
// follow from the frequencies, 1/T; the frequency up to which waves in the rock are right goes with 1/T. Uplift pressures go with L by themselves. Without that, the slip of an elastic dam
// does not scale.
//
// L = 4 and T = 2 are powers of two: every product and quotient is the same but for its exponent, so the rigid block's
// slip keeps every bit. L = 2, T = sqrt(2) rounds: 1e-12.
#include "drawn_scene.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::property;

double rigid_slip(const Drawn& d)
{
    return sliding::slide(d.motion, sliding::make_rigid_block(d.scene)).slip;
}

fe2d::RunResult fe_run(const Drawn& d)
{
    return fe2d::EarthquakeRun(d.scene, fe2d::test::options_of(d.scene)).run(d.motion);
}

TEST(Scaling, RigidSlipGoesWithTheLength)
{
    int slid = 0;
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        const Drawn d = draw(seed, Rock::rigid);
        const double slip = rigid_slip(d);
        slid += slip != 0.0;
        EXPECT_NEAR(rigid_slip(scaled(d, 2.0)), 2.0 * slip, 1e-12 * std::abs(slip));
        EXPECT_NEAR(rigid_slip(scaled(d, 4.0)), 4.0 * slip, 1e-14 * std::abs(slip));
    }
    EXPECT_GE(slid, 20);
}

// Round-off of a run: some 1e-16 of the loads in each of a hundred steps, more where a pair changes its state a little
// sooner, 1e-9 of the slip at most. The run-out ends on a slip rate with a floor of 0.1 µm (at_rest): the slip is compared
// at the record's end, where both have the same steps. Seeds on rock have elements longer than a metre on the base: the rock's
// surface there goes on for a metre to both sides (ContactExtension), in whole elements, which scales with nothing.
TEST(Scaling, ElasticSlipGoesWithTheLengthWhenTheModuliDo)
{
    int slid = 0;
    for (const std::uint32_t seed : {1, 2, 3, 4, 5, 6, 8, 10}) {
        SCOPED_TRACE(seed);
        const Drawn d = draw(seed, rock_of(seed, 7));
        if (d.scene.foundation) {
            ASSERT_GT(*d.scene.mesh.contact_size, 1.0);
        }
        const fe2d::RunResult own = fe_run(d);
        const std::size_t last = d.motion.accel_h.size() - 1;
        ASSERT_GT(own.history.slip.size(), last) << text_of(own.notes);
        const double slip = own.history.slip[last];
        slid += std::abs(slip) > 1e-4;
        for (const double length : {2.0, 4.0}) {
            const fe2d::RunResult large = fe_run(scaled(d, length));
            EXPECT_EQ(large.status, own.status) << length;
            EXPECT_NEAR(large.history.slip[last], length * slip, 1e-9 * length * own.max_slip + 1e-15) << length;
            EXPECT_NEAR(large.history.energy[last].friction,
                        length * length * length * own.history.energy[last].friction,
                        1e-9 * length * length * length * own.history.energy[last].friction);
        }
        // and does not when they do not
        Drawn soft = scaled(d, 4.0);
        soft.scene.dam.young_modulus = d.scene.dam.young_modulus;
        EXPECT_GT(std::abs(fe_run(soft).history.slip[last] - 4.0 * slip), 1e-6 * own.max_slip);
    }
    EXPECT_GE(slid, 3);
}

} // namespace
