#pragma once

namespace damslip::exact {

/// Crack length of a no-tension base under linear uplift without tailwater.
///
/// Base L, loads without uplift: normal force N and restoring moment M about the toe. Full pressure p over the crack T,
/// then linear to zero at the toe:  U = p (L + T)/2,  moment of U about the toe  p (L^2 + L T - T^2/2)/3.  The triangle
/// of effective stress needs N' at (L - T)/3 from the toe:  M - M_U = (N - U)(L - T)/3. T^2 cancels and
///
///     T = (N L + p L^2/2 - 3 M) / (N - p L).
///
/// Valid for 0 <= T < L and N > p L.
double linear_uplift_crack(double normal, double moment_about_toe, double pressure, double length);

/// The same without any water in the joint: T = L - 3 M/N.
double dry_crack(double normal, double moment_about_toe, double length);

} // namespace damslip::exact
