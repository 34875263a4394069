#pragma once

#include "fe2d/run/dynamic_contact.hpp"
#include "fe2d/time/ground_load.hpp"
#include "records/record.hpp"
#include "scene/scene.hpp"

namespace damslip::fe2d {

/// The ground's acceleration of a run. Between the samples it is linear; beyond the record it is zero.
class GroundInput {
public:
    /// @param mass_coefficient  a_M of the damping [1/s]: what resists the total velocity resists the ground's, too,
    /// as long as the record lasts
    GroundInput(const GroundMotion& motion, MassDamping damping, double mass_coefficient);

    double duration() const { return motion_.dt * static_cast<double>(motion_.accel_h.size() - 1); } ///< [s]
    GroundAcceleration at(double time) const; ///< @param time  since the first sample [s]

private:
    GroundMotion motion_;
    GroundHistory history_;
    double drag_ = 0.0; ///< a_M, where it resists the total velocity [1/s]
};

} // namespace damslip::fe2d
