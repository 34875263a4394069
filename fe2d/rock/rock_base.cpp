#include "fe2d/rock/rock_base.hpp"

#include "fe2d/rock/rock_motion.hpp"

namespace damslip::fe2d {

namespace {

class RockBase final : public MovingBase {
public:
    RockBase(const ReducedRock& rock, const StepConstants& constants, double stiffness_damping)
        : step_(rock, stiffness_damping, constants), motion_(rock)
    {
    }

    std::int64_t unknowns() const override { return step_.rock().count(); }
    const Eigen::MatrixXd& compliance() const override { return step_.compliance(); }
    const Eigen::VectorXd& begin_step() override
    {
        motion_.begin(step_);
        return motion_.free_step();
    }
    void end_step(const Eigen::VectorXd& weighted_force) override { motion_.finish(weighted_force); }
    Energy energy() const override
    {
        const RockEnergy& rock = motion_.energy();
        Energy energy;
        energy.kinetic = rock.kinetic;
        energy.strain = rock.strain;
        energy.damping = rock.damping;
        energy.radiated = rock.radiated;
        energy.numerical = rock.numerical;
        return energy;
    }

    Eigen::Index floor() const override { return step_.rock().floor; }
    Eigen::VectorXd floor_velocity() const override { return motion_.velocity().tail(floor()); }
    Eigen::VectorXd floor_acceleration() const override { return motion_.acceleration().tail(floor()); }

private:
    RockStep step_;
    RockMotion motion_;
};

} // namespace

std::unique_ptr<MovingBase> rock_base(const ReducedRock& rock, const StepConstants& constants, double stiffness_damping)
{
    return std::make_unique<RockBase>(rock, constants, stiffness_damping);
}

} // namespace damslip::fe2d
