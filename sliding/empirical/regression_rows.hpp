#pragma once

#include "sliding/empirical/regression.hpp"

/// What the files of rows share (regression_list.cpp puts them together).
namespace damslip::sliding {

template <int per_mille>
double constant_sigma(const RegressionInputs&)
{
    return per_mille / 1000.0;
}

/// c0 + c1 x + c2 x^2 + c3 x^3 + c4 x^4
inline double quartic(double x, double c0, double c1, double c2, double c3, double c4)
{
    return c0 + x * (c1 + x * (c2 + x * (c3 + x * c4)));
}

} // namespace damslip::sliding
