#pragma once

#include "cli/sweep_command.hpp"

namespace damslip::cli {

/// Values of every axis of the grid.
struct Axes {
    std::vector<double> friction, level, scale;
    std::vector<int> polarity;
    std::vector<std::string> uplift, reservoir, method;

    bool has(const std::string& name) const; ///< is it among the methods?
};

/// The axes as typed, checked; the scene's own value where nothing is. @throws UsageError
Axes make_axes(const SweepArguments& arguments, const Scene& scene);

/// The scene with another water level [m], uplift model and formula of the added mass, words as typed.
Scene variant(Scene scene, double level, const std::string& uplift, const std::string& reservoir);

} // namespace damslip::cli
