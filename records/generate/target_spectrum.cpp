#include "records/generate/target_spectrum.hpp"

#include "core/input_error.hpp"
#include "core/units.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <vector>

namespace damslip::records {

namespace {

/// Corner periods of the EN 1998-1 shape [s] and the height of its plateau over PGA [-].
struct Eurocode8Shape {
    double T_B, T_C, T_D, plateau;

    double operator()(double T) const
    {
        if (T <= T_B) return 1.0 + T / T_B * (plateau - 1.0);
        if (T <= T_C) return plateau;
        if (T <= T_D) return plateau * T_C / T;
        return plateau * T_C * T_D / (T * T);
    }
};

constexpr std::array<Eurocode8Shape, 5> type_1{{{0.15, 0.4, 2.0, 2.5},
                                                {0.15, 0.5, 2.0, 2.5},
                                                {0.20, 0.6, 2.0, 2.5},
                                                {0.20, 0.8, 2.0, 2.5},
                                                {0.15, 0.5, 2.0, 2.5}}};
constexpr std::array<Eurocode8Shape, 5> type_2{{{0.05, 0.25, 1.2, 2.5},
                                                {0.05, 0.25, 1.2, 2.5},
                                                {0.10, 0.25, 1.2, 2.5},
                                                {0.10, 0.30, 1.2, 2.5},
                                                {0.05, 0.25, 1.2, 2.5}}};
constexpr Eurocode8Shape vertical{0.05, 0.15, 1.0, 3.0}; // both types

/// log-log line through (x0, y0) and (x1, y1).
double log_line(double x0, double y0, double x1, double y1, double x)
{
    return y0 * std::exp(std::log(y1 / y0) * std::log(x / x0) / std::log(x1 / x0));
}

struct RockShape {
    static constexpr double acceleration = 2.12, velocity = 1.65, displacement = 1.39; // amplification [-]
    static constexpr double v_per_a = 36.0 * 0.0254 / units::standard_gravity;         // 36 in/s per g [s]
    static constexpr double ad_per_v2 = 6.0;
    static constexpr double T_rigid = 1.0 / 33.0, T_plateau = 1.0 / 8.0; // [s]

    double operator()(double T) const
    {
        if (T <= T_rigid) return 1.0;
        if (T <= T_plateau) return log_line(T_rigid, 1.0, T_plateau, acceleration, T);
        const double w = 2.0 * std::numbers::pi / T;
        return std::min({acceleration, velocity * v_per_a * w, displacement * ad_per_v2 * v_per_a * v_per_a * w * w});
    }
};

struct TableShape {
    std::vector<SpectrumRow> rows; // accelerations over the first

    double operator()(double T) const
    {
        if (T <= rows[0].period) return 1.0;
        const SpectrumRow& last = rows.back();
        if (T >= last.period) return last.acceleration * (last.period / T) * (last.period / T);
        std::size_t k = 1;
        while (rows[k].period < T) ++k;
        const SpectrumRow &a = rows[k - 1], &b = rows[k];
        if (a.period == 0.0) return a.acceleration + (b.acceleration - a.acceleration) * T / b.period;
        return log_line(a.period, a.acceleration, b.period, b.acceleration, T);
    }
};

} // namespace

TargetSpectrum eurocode8_spectrum(Eurocode8Type type, GroundType ground, MotionComponent component)
{
    const char* type_name = type == Eurocode8Type::type_1 ? "type 1" : "type 2";
    if (component == MotionComponent::vertical) return {fmt::format("Eurocode 8 {}, vertical", type_name), vertical};
    const auto index = static_cast<std::size_t>(ground);
    return {fmt::format("Eurocode 8 {}, ground {}, horizontal", type_name, "ABCDE"[index]),
            (type == Eurocode8Type::type_1 ? type_1 : type_2)[index]};
}

TargetSpectrum rock_spectrum()
{
    return {"rock (Newmark & Hall 1982, median)", RockShape{}};
}

TargetSpectrum table_spectrum(std::span<const SpectrumRow> rows, std::string name)
{
    const auto fail = [&](std::string problem, std::string expected, std::string fix) {
        throw InputError(Diagnostic{name, 0, 0, std::move(problem), std::move(expected), std::move(fix)});
    };
    if (rows.size() < 2)
        fail(fmt::format("a target spectrum of {} rows.", rows.size()),
             "at least 2 rows of period [s] and spectral acceleration", "add rows");
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (!(rows[k].acceleration > 0.0) || !std::isfinite(rows[k].acceleration))
            fail(fmt::format("spectral acceleration {} at {} s.", rows[k].acceleration, rows[k].period), "a number > 0",
                 "correct the row");
        if (!(rows[k].period >= 0.0) || !std::isfinite(rows[k].period) ||
            (k > 0 && rows[k].period <= rows[k - 1].period))
            fail(fmt::format("period {} s in row {}.", rows[k].period, k + 1), "periods >= 0 that rise from row to row",
                 "sort the rows");
    }
    constexpr double latest_first = 0.03, earliest_last = 2.0; // [s]
    if (rows.front().period > latest_first)
        fail(fmt::format("the first period is {} s.", rows.front().period),
             fmt::format("0 to {} s: the first row is the PGA", latest_first),
             "add a row \"0, PGA\", of frequencies \"100, PGA\"");
    if (rows.back().period < earliest_last)
        fail(fmt::format("the last period is {} s.", rows.back().period),
             fmt::format("at least {} s: so far the record is matched", earliest_last), "add rows");
    TableShape shape{{rows.begin(), rows.end()}};
    for (SpectrumRow& row : shape.rows) row.acceleration /= rows.front().acceleration;
    return {std::move(name), std::move(shape)};
}

} // namespace damslip::records
