#pragma once

#include "fe2d/run/dynamic_contact.hpp"
#include "fe2d/time/ground_load.hpp"
#include "records/record.hpp"
#include "scene/scene.hpp"

namespace damslip::fe2d {

/// The ground's acceleration of a run. Between the samples it is linear; beyond the record it is zero.
class GroundInput {
public:
    /// @param mass_coefficient  a_M of the damping [1/s]: damping of the total velocity adds to the acceleration
    GroundInput(const GroundMotion& motion, MassDamping damping, double mass_coefficient);

    double duration() const { return motion_.dt * static_cast<double>(motion_.accel_h.size() - 1); } ///< [s]
    GroundAcceleration at(double time) const; ///< @param time  since the first sample [s]

private:
    void add_velocity(std::vector<double>& acceleration, double coefficient) const;

    GroundMotion motion_;
    GroundHistory history_; ///< of the motion itself
};

} // namespace damslip::fe2d
