#pragma once

/// Plane waves that go straight up in an elastic half space and come back from its free surface y = 0.
namespace damslip::exact {

/// The motion of the surface: a pulse u_g(t) = A exp(-((t - t0)/tau)^2) [m].
struct SurfacePulse {
    double amplitude = 0.01; ///< A [m]
    double middle = 0.5;     ///< t0 [s]
    double width = 0.08;     ///< tau [s]

    double displacement(double time) const;
    double velocity(double time) const;
    double acceleration(double time) const;
};

/// One component of the free field, c the speed of its waves [m/s]. The wave equation with u_y = 0 on y = 0 has the solution
///
///     u(y, t) = ½ [u_g(t - y/c) + u_g(t + y/c)],   u(0, t) = u_g(t)
///
/// whose first part comes up from below (y <= 0) with half the motion of the surface.
struct FreeField {
    SurfacePulse surface;
    double speed = 0.0; ///< c [m/s]

    double displacement(double y, double time) const;
    double velocity(double y, double time) const;
    double gradient(double y, double time) const; ///< du/dy [-]
};

} // namespace damslip::exact
