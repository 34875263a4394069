#pragma once

#include "fe2d/element/elastic.hpp"

/// Elements with one unknown per node: acoustic pressure, hydraulic head. 3 x 3 for linear triangles, 4 x 4 for linear
/// quadrilaterals, up to 9 x 9 with `extra` nodes.
namespace damslip::fe2d {

/// Integral of k grad N^T grad N, per metre of dam length; `conductivity` k is 1/rho for acoustics [m^3/kg], the
/// permeability for Darcy flow [m/s].
ElementMatrix scalar_gradient_matrix(const Corners& corners, int size, double conductivity,
                                     const ExtraNodes& extra = {});

/// Integral of s N^T N; `capacity` s is 1/K_w for acoustics [1/Pa].
ElementMatrix scalar_mass_matrix(const Corners& corners, int size, double capacity, const ExtraNodes& extra = {});

/// Gradient of the field at the element's centre.
Eigen::Vector2d scalar_gradient(const Corners& corners, int size, const ElementVector& values);

} // namespace damslip::fe2d
