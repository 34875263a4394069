#pragma once

#include "fe2d/gmsh/gmsh.hpp"

namespace damslip::verification {

/// A mesh as mesh generators leave it, made of a regular one: nodes inside moved by up to a fifth of the element beside them, every
/// third quadrilateral two triangles, every second element clockwise, tags with gaps and in another order, a node that belongs
/// to nothing. The same every time. Nodes on physical lines stay.
fe2d::GmshFile mixed_mesh(fe2d::GmshFile regular);

} // namespace damslip::verification
