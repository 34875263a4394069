#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace damslip::sliding {

/// State after a step and how far the embedded lower order is off.
template <std::size_t n>
struct RungeKuttaStep {
    std::array<double, n> state{};
    std::array<double, n> error{};
};

/// One step of y' = f(x, y) from (x, y) by h: order 5 with an embedded 4. Dormand & Prince (1980), J. Comput. Appl. Math. 6.
template <std::size_t n, class Function>
RungeKuttaStep<n> dormand_prince(Function&& f, double x, const std::array<double, n>& y, double h)
{
    constexpr std::array<double, 7> nodes{0.0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1.0, 1.0};
    constexpr double a[7][6] = {{},
                                {1.0 / 5},
                                {3.0 / 40, 9.0 / 40},
                                {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
    constexpr std::array<double, 7> fourth{5179.0 / 57600,    0.0,          7571.0 / 16695, 393.0 / 640,
                                           -92097.0 / 339200, 187.0 / 2100, 1.0 / 40};
    std::array<std::array<double, n>, 7> k;
    RungeKuttaStep<n> step;
    for (std::size_t stage = 0; stage < 7; ++stage) {
        step.state = y;
        for (std::size_t j = 0; j < stage; ++j)
            for (std::size_t i = 0; i < n; ++i) step.state[i] += h * a[stage][j] * k[j][i];
        k[stage] = f(x + nodes[stage] * h, step.state);
    }
    for (std::size_t i = 0; i < n; ++i) { // the last stage stands at the new state: step.state is it
        double embedded = y[i];
        for (std::size_t j = 0; j < 7; ++j) embedded += h * fourth[j] * k[j][i];
        step.error[i] = step.state[i] - embedded;
    }
    return step;
}

} // namespace damslip::sliding
