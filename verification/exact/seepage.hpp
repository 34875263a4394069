#pragma once

/// Steady seepage below an impervious flat base with one sheet pile, in a layer of finite depth without lateral ends.
///
/// Rock 0 > y > -T, no flow through its bottom; base from x = -b1 to b2 on its surface, head 1 upstream (x < -b1), 0
/// downstream (x > b2); pile of no thickness below x = 0, depth d >= 0.
///
/// w = tanh(πz/2T) maps the layer to the lower half plane: the surface to -1 < w < 1, the bottom to |w| > 1, the pile
/// to 0 ... -iD, D = tan(πd/2T). ζ = √(w² + D²) opens the pile into -D ... D of the real axis (sign of x; upstream
/// negative). Bottom: |ζ| > M = √(1 + D²); base and pile: ζ1 < ζ < ζ2, ζ_i = ∓√(tanh²(πb_i/2T) + D²). The complex
/// potential maps this half plane to a rectangle, ∫dζ/√((M-ζ)(ζ2-ζ)(ζ-ζ1)(ζ+M)), an elliptic integral (Byrd & Friedman
/// 1971, 254.00):
///
///     H = 1 - F(φ, k)/K(k),  sin²φ = (ζ2+M)(ζ-ζ1) / ((ζ2-ζ1)(ζ+M)),  k² = (ζ2-ζ1)·2M / ((M-ζ1)(ζ2+M))
///
/// and the discharge is q = k_rock ΔH K(√(1-k²))/K(k). See Harr (1962), Groundwater and Seepage, ch. 5. T -> ∞ gives
/// H = arccos((2ζ-ζ1-ζ2)/(ζ2-ζ1))/π with ζ = ±√(x²+d²), and without pile H = arccos(2x/B - 1)/π, x from the heel.
namespace damslip::exact {

struct SeepageUnderBase {
    double upstream;    ///< b1, base upstream of the pile [m], >= 0
    double downstream;  ///< b2, base downstream of the pile [m], b1 + b2 > 0
    double pile_depth;  ///< d [m], 0 <= d < T
    double layer_depth; ///< T [m]

    enum class Side { upstream, downstream };
    /// Share of the head difference left at the base, x from the pile [m]; `side` decides at x = 0 with d > 0.
    double head(double x, Side side) const;
    double discharge() const; ///< q/(k ΔH) [-]
    /// Mean of H over the base: the uplift force over γ_w ΔH (b1 + b2).
    double mean_head() const;

    /// The same for a layer without bottom (T is not used).
    double head_deep(double x, Side side) const;
};

} // namespace damslip::exact
