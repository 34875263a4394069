#include "random/draw.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>

namespace damslip::random {

namespace {

double four_digits(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return std::atof(text);
}

} // namespace

int Draw::whole(int first, int last)
{
    return first + static_cast<int>(unit() * (last - first + 1));
}

double Draw::between(double low, double high)
{
    return four_digits(low + (high - low) * unit());
}

double Draw::log_between(double low, double high)
{
    return four_digits(low * std::pow(high / low, unit()));
}

std::string Draw::word(std::initializer_list<const char*> words)
{
    return words.begin()[whole(0, static_cast<int>(words.size()) - 1)];
}

Draw seeded(std::uint32_t seed)
{
    return Draw(
        [generator = std::make_shared<std::mt19937>(seed)] { return static_cast<std::uint32_t>((*generator)()); });
}

} // namespace damslip::random
