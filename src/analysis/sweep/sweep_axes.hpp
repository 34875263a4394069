#pragma once

#include "analysis/sweep/sweep_method.hpp"
#include "core/input_error.hpp"

namespace damslip {

/// Values of every axis of the grid but the records.
struct Axes {
    std::vector<double> friction;               ///< Coulomb mu [-]
    std::vector<double> level;                  ///< water surface above the heel at size 1 [m]
    std::vector<double> size;                   ///< of section, rock, water and elements (sized), factor [-]
    std::vector<double> scale;                  ///< of the motion, factor [-]
    std::vector<int> polarity;                  ///< signs on the horizontal component as filed: 1, -1
    std::vector<std::string> uplift, reservoir; ///< words as typed
    std::vector<std::string> opening{""};       ///< words of uplift.opening as typed; empty: the scene's
    std::vector<double> period, damping;        ///< T_s [s] and zeta [-] of the flexible block; empty: the scene's
    std::vector<SweepMethod> method;
    std::vector<Diagnostic> notes; ///< of values that are allowed but unusual

    bool finite_elements() const; ///< is there an FE method?
    bool flexible() const;        ///< is there a method of the flexible block?
};

/// The axes that leave the scene as it is: one value each, the polarities_of() the scene, the rigid block.
Axes axes_of(const Scene& scene);

/// Words of the water models an axis may have: "auto", "hydrostatic", "acoustic", and the added masses by their formula.
std::vector<std::string> reservoir_axis_words();

/// Is uplift.opening one of the axes?
inline bool has_opening_axis(const Axes& axes)
{
    return axes.opening.size() != 1 || !axes.opening.front().empty();
}

/// The scene with another water level [m], uplift model and water model, words as typed, then another size.
Scene variant(Scene scene, double level, const std::string& uplift, const std::string& reservoir, double size);
/// The same with other water in the opening base. @param opening  empty: the scene's
Scene with_opening_water(Scene scene, const std::string& opening);
/// The same with another mode of the flexible block. @param period, damping  none: the scene's
Scene with_mode(Scene scene, std::optional<double> period, std::optional<double> damping);

/// The axes in words, all digits, in a fixed order: what has to be equal for two sweeps to have the same rows.
std::string text_of(const Axes& axes);

} // namespace damslip
