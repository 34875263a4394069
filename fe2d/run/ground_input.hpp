#pragma once

#include "fe2d/run/dynamic_contact.hpp"
#include "fe2d/time/energy.hpp"
#include "records/record.hpp"
#include "scene/scene.hpp"

#include <optional>

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

/// The ground of a run as it goes on: one record, or the events of a sequence, each from the moment on that the run says it
/// rests. What has been played is one motion with zero samples between its events, at least one: a run on that motion gives
/// the same bits.
class PlayedGround {
public:
    PlayedGround(const GroundMotion& motion, MassDamping damping, double mass_coefficient);

    GroundAcceleration at(double time);     ///< @param time  never much before that of the last call [s]
    double end() const { return end_; }     ///< last sample of the present event [s]
    double start() const { return start_; } ///< its first one [s]
    bool more() const { return event_ + 1 < motion_.events.size(); }
    std::size_t left() const { return more() ? motion_.events.size() - event_ - 1 : 0; } ///< events
    double pause() const { return motion_.pause; }                                       ///< [s]
    const MotionEvent* event() const { return motion_.is_sequence() ? &motion_.events[event_] : nullptr; }
    double samples_end() const; ///< length of all events without what is between them [s]
    void next(double time);     ///< the next event begins at the first sample after `time`. @pre more()

private:
    void append(std::size_t event);
    void rest(std::size_t samples);

    GroundMotion motion_, played_;
    MassDamping damping_;
    double coefficient_;
    std::size_t event_ = 0;
    double start_ = 0.0, end_ = 0.0;
    std::optional<GroundInput> input_;
};

} // namespace damslip::fe2d
