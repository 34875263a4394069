#pragma once

#include "fe2d/assembly/assemble.hpp"

#include <span>

namespace damslip::fe2d {

/// Extent and elements of the box of rock in which waves travel, in base lengths B where a length is meant.
struct WaveBoxShape {
    double width = 41.0;       ///< [B], > inner_width
    double depth = 21.0;       ///< below the surface at mid-base [B], > inner_depth
    double inner_width = 3.3;  ///< without sponge [B]
    double inner_depth = 1.3;  ///< [B]
    double growth = 1.15;      ///< of neighbouring elements [-], > 1
    double per_wave = 8.0;     ///< elements per shear wave of the highest frequency inside [-]
    double per_sponge = 27.0;  ///< elements over the thickness of the sponge, where these are no longer than ... [-]
    double sponge_wave = 0.35; ///< ... this share of that shear wave [-]; 0.35: 40 m for E 30 GPa, 25 Hz
    double sponge = 0.06;      ///< b0 c_s/L_s [-]: damping of the sponge at its outer edge, b0 K

    friend bool operator==(const WaveBoxShape&, const WaveBoxShape&) = default;
};

/// What the box is made for.
struct WaveBoxInput {
    ElasticMaterial rock;       ///< density > 0
    double base = 0.0;          ///< B, length of the base [m]
    double middle = 0.0;        ///< x of mid-base [m]
    std::vector<Point> surface; ///< interface nodes on the rock's surface, upstream to downstream, x increasing; the
                                ///< surface runs straight between them and level from the outer ones on [m]
    int floor = 0;              ///< so many of them, the first, are on the water's floor; the base begins after them
    double highest_frequency = 0.0; ///< ω up to which waves are resolved [rad/s]
    WaveBoxShape shape;
};

/// Rock with mass that lets waves out: M ü + (C + b_K K) u̇ + K u = B_rᵀ p.
///
/// Structured and graded: columns through the interface nodes, rows with depth; where elements would be slender, every
/// other line ends at a hanging node that its two neighbours carry along (a congruence). Edges: dashpots ρ c_p across and
/// ρ c_s along with springs G/R and G/2R per area, R the distance from mid-base (Deeks & Randolph 1994, J. Engng Mech. 120,
/// 25-42; Liu, Du, Du, Wang & Wu 2006, Earthq. Engng Engng Vib. 5, 21-28); the springs make K positive definite: nothing
/// drifts. Sponge: ∫ b0 ξ² BᵀDB, ξ from 0 at inner_width, inner_depth to 1 at the edge, b0 = sponge L_s/c_s. M, C, K are
/// sums of Gram matrices, so the box is passive whatever the numbers.
///
/// Everything scales: K ∝ E, M ∝ ρ B², C ∝ B √(E ρ) at fixed ν, geometry/B and ω B/c_s.
struct WaveBox {
    SparseMatrix mass;          ///< [kg/m]
    SparseMatrix damping;       ///< of edges and sponge, without b_K K [N s/m^2]
    SparseMatrix stiffness;     ///< with the springs on the edges [N/m^2]
    std::vector<int> interface; ///< unknowns of the interface nodes (x, y, x, y, ...)
    double thickness = 0.0;     ///< L_s, of the sponge at the sides [m]
    int nodes = 0;              ///< free ones
    int elements = 0;
};

WaveBox make_wave_box(const WaveBoxInput& input);

} // namespace damslip::fe2d
