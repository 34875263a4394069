#pragma once

#include "fe2d/mesh/mesh.hpp"

namespace damslip::fe2d {

enum class QuadraticKind {
    serendipity, ///< nodes in the middle of edges: Q8, T6
    lagrange     ///< and at the centres of quadrilaterals: Q9, T6
};

/// Makes a mesh of linear elements quadratic: every edge gets a node in its middle, except the edges on contact planes
/// (base and lift joints, both sides, and the rock's surface along which the dam may slide), so that contact, uplift and
/// their integrals are those of the linear mesh; the elements at them are transition elements. Water loads, added mass
/// and acoustic coupling integrate over quadratic edges. New nodes of the dam follow the dam's, those of the rock come
/// last: the rock's nodes are renumbered. Same mesh, same bits.
void make_quadratic(Mesh& mesh, QuadraticKind kind);

} // namespace damslip::fe2d
