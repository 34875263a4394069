#pragma once

#include "sliding/block/slide.hpp"

#include <span>

/// The step-by-step scheme of SLAMMER, kept for comparison with results of its users.
namespace damslip::sliding {

/// Trapezoid rule of SLAMMER (Jibson, Rathje, Jibson & Lee 2013, U.S. Geological Survey Techniques and Methods 12-B1)
/// for its rigid-block analysis. With y_k = s'' at sample k, zero while the block rests:
///
///     v_k = v_{k-1} + dt/2 (y_{k-1} + y_k),   s_k = s_{k-1} + dt/2 (v_{k-1} + v_k);   v_k = y_k = 0 when v_k would
///     turn against the slip.
///
/// Start and stop are moved to samples and the slip is integrated by trapezoids: an error of order dt^2 that is
/// largest, relative to the slip, when a_y is near the peak (few samples above a_y). The scheme has no state before the
/// first sample (y_{-1} = 0) and ends with the record; there is no run-out. Not taken over: SLAMMER skips samples that
/// are exactly zero, time included, while the block slides.
///
/// Yield may follow a_v and change between stages (friction constant within each); lift-off is `no_friction` only.
SlideResult slide_slammer(const GroundMotion& motion, const SlipStages& stages, const SlideOptions& options);

/// The same for a constant yield and one-way sliding; the kernel the bench times.
/// @param accel ground acceleration [m/s^2], positive drives the block; @param dt [s]; @param yield_acceleration
/// [m/s^2], > 0
/// @returns slip [m]
double slammer_slip(std::span<const double> accel, double dt, double yield_acceleration);

} // namespace damslip::sliding
