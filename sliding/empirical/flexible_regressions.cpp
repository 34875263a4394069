#include "sliding/empirical/regression.hpp"

#include <algorithm>
#include <cmath>

// Sliding masses with a fundamental period T_s. A scene without a period is a rigid block: T_s = 0, S_a = a_max.
namespace damslip::sliding {
namespace {

using Input = RegressionInput;
using Inputs = RegressionInputs;

constexpr std::string_view rathje_antonakos =
    "Rathje, E.M. & Antonakos, G. (2011): A unified model for predicting earthquake-induced sliding displacements of "
    "rigid and flexible slopes. Engineering Geology 122, 51-60";
constexpr std::string_view bray_travasarou =
    "Bray, J.D. & Travasarou, T. (2007): Simplified procedure for estimating earthquake-induced deviatoric slope "
    "displacements. Journal of Geotechnical and Geoenvironmental Engineering 133, 381-392";
constexpr std::string_view bray_macedo =
    "Bray, J.D. & Macedo, J. (2019): Procedure for estimating shear-induced seismic slope displacement for shallow "
    "crustal earthquakes. Journal of Geotechnical and Geoenvironmental Engineering 145, 04019106";
constexpr std::string_view bray_macedo_travasarou =
    "Bray, J.D., Macedo, J. & Travasarou, T. (2018): Simplified procedure for estimating seismic slope displacements "
    "for subduction zone earthquakes. Journal of Geotechnical and Geoenvironmental Engineering 144, 04017124";

double period(const Inputs& x)
{
    return x.period_s.value_or(0.0);
}

/// ln of T_s/T_m, at most 8, over `from`; 0 below it, where the mass is rigid.
double log_period_ratio(const Inputs& x, double from)
{
    return std::log(std::clamp(period(x) / *x.mean_period_s, from, 8.0) / from);
}

/// Peak average acceleration of the mass [g]; a_max for T_s/T_m <= 0.1.
double k_max(const Inputs& x)
{
    const double l = log_period_ratio(x, 0.1);
    return x.pga_g * std::exp((0.459 - 0.702 * x.pga_g) * l + (-0.228 + 0.076 * x.pga_g) * l * l);
}

/// Peak of the integral of that acceleration [cm/s]; PGV for T_s/T_m <= 0.2.
double k_vel_max(const Inputs& x)
{
    const double l = log_period_ratio(x, 0.2);
    return *x.pgv_cm_s * std::exp(0.240 * l + (-0.091 - 0.171 * x.pga_g) * l * l);
}

/// The same inputs with k_max and k-vel_max in the place of a_max and PGV.
Inputs of_the_mass(const Inputs& x)
{
    Inputs mass = x;
    mass.pga_g = k_max(x);
    if (x.pgv_cm_s) mass.pgv_cm_s = k_vel_max(x);
    return mass;
}

double ratio_of_the_mass(const Inputs& x)
{
    return x.yield_coefficient / k_max(x);
}

double antonakos_pgv(const Inputs& x)
{
    const double t = period(x);
    return find_regression("saygili-rathje-2008-pga-pgv")->log_median(of_the_mass(x)) + (t <= 0.5 ? 1.42 * t : 0.71);
}

double antonakos_magnitude(const Inputs& x)
{
    const double t = period(x);
    return find_regression("rathje-saygili-2009")->log_median(of_the_mass(x)) +
           (t <= 1.5 ? (3.69 - 1.22 * t) * t : 2.78);
}

// The rigid models beneath them were fitted to these; T_s/T_m is capped in the formula.
std::vector<ValidityRange> antonakos_range()
{
    return {{Input::yield_coefficient, 0.05, 0.30}, {Input::magnitude, 5.0, 7.9, RangeSource::data}};
}

bool rigid_for_bray_travasarou(const Inputs& x)
{
    return period(x) < 0.05;
}

double travasarou(const Inputs& x)
{
    const bool rigid = rigid_for_bray_travasarou(x);
    const double ky = std::log(x.yield_coefficient), sa = std::log(rigid ? x.pga_g : *x.sa_15_g);
    return (rigid ? -0.22 : -1.10 + 1.5 * period(x)) - 2.83 * ky - 0.333 * ky * ky + 0.566 * ky * sa + 3.04 * sa -
           0.244 * sa * sa + 0.278 * (*x.magnitude - 7.0);
}

/// P(D <= 1 cm), eq. (3).
double travasarou_zero(const Inputs& x)
{
    const bool rigid = rigid_for_bray_travasarou(x);
    const double ky = std::log(x.yield_coefficient), sa = std::log(rigid ? x.pga_g : *x.sa_15_g);
    const double t = rigid ? 0.0 : period(x);
    return standard_normal_cdf(-(-1.76 - 3.22 * ky - 0.484 * t * ky + 3.52 * sa));
}

double macedo_rigid(const Inputs& x)
{
    const double ky = std::log(x.yield_coefficient), sa = std::log(x.pga_g);
    return -4.684 - 2.482 * ky - 0.244 * ky * ky + 0.344 * ky * sa + 2.649 * sa - 0.090 * sa * sa +
           0.603 * *x.magnitude;
}

/// P(D < 0.5 cm), eq. (2a) of Bray & Macedo (2019) at T_s = 0.
double macedo_rigid_zero(const Inputs& x)
{
    const double ky = std::log(x.yield_coefficient);
    return standard_normal_cdf(-(-2.480 - 2.970 * ky - 0.120 * ky * ky + 2.780 * std::log(x.pga_g)));
}

/// Coefficients of P(D = 0) = 1 - Phi(c1 + c2 ln ky + c3 ln^2 ky + c4 Ts ln ky + c5 Ts + c6 ln Sa).
struct ZeroCoefficients {
    double c1, c2, c3, c4, c5, c6;
};

double zero_by_period(const Inputs& x, double sa_g, const ZeroCoefficients& to_07_s, const ZeroCoefficients& above)
{
    const double t = period(x), ky = std::log(x.yield_coefficient);
    const auto& [c1, c2, c3, c4, c5, c6] = t <= 0.7 ? to_07_s : above;
    return standard_normal_cdf(-(c1 + c2 * ky + c3 * ky * ky + c4 * t * ky + c5 * t + c6 * std::log(sa_g)));
}

/// P(D < 0.5 cm), eqs. (8a), (8b) of Bray & Macedo (2019), all motions.
double macedo_zero(const Inputs& x)
{
    return zero_by_period(x, *x.sa_13_g, {-2.46, -2.98, -0.12, -0.71, 1.69, 2.76},
                          {-3.40, -4.95, -0.30, -0.33, -0.62, 2.85});
}

/// P(D < 0.5 cm) of Bray, Macedo & Travasarou (2018).
double subduction_zero(const Inputs& x)
{
    return zero_by_period(x, *x.sa_15_g, {-2.64, -3.20, -0.17, -0.49, 2.09, 2.91},
                          {-3.53, -4.78, -0.34, -0.30, -0.67, 2.66});
}

double macedo(const Inputs& x)
{
    const double t = period(x), ky = std::log(x.yield_coefficient), sa = std::log(*x.sa_13_g);
    const double of_period = t < 0.1 ? -4.551 - 9.690 * t : -5.894 + (3.152 - 0.910 * t) * t;
    const double of_pulse = *x.pgv_cm_s > 115.0 ? std::log(*x.pgv_cm_s / 115.0) : 0.0;
    return of_period - 2.491 * ky - 0.245 * ky * ky + 0.344 * ky * sa + 2.703 * sa - 0.089 * sa * sa +
           0.607 * *x.magnitude + of_pulse;
}

/// Near-fault motions of Bray & Macedo (2019): in the direction of the largest slip (D100) or of the median one (D50).
struct NearFault {
    double short_period, rigid_slope;     ///< c1 + c2 T_s below 0.1 s, at moderate PGV
    double long_period, slope, curvature; ///< c1 + c2 T_s + c3 T_s^2 from 0.1 s on, at moderate PGV
    double moderate, strong;              ///< c4 up to and above 150 cm/s
    double strong_shift;                  ///< of c1 above 150 cm/s
    double ky, ky_squared, product, sa, sa_squared, magnitude;
};
constexpr NearFault largest_direction{-6.235,        -2.744, -6.462, 1.069, -0.498, 1.547,  -0.097,
                                      2.480 + 6.235, -2.632, -0.278, 0.527, 1.978,  -0.233, 0.06};
// c1 = -0.148 above 150 cm/s at short periods: see docs/regressions.md.
constexpr NearFault median_direction{-7.497,         -2.731, -7.718, 1.031, -0.480, 1.458,  0.025,
                                     -0.148 + 7.497, -2.931, -0.319, 0.584, 2.261,  -0.241, 0.05};

double near_fault(const Inputs& x, const NearFault& c)
{
    constexpr double strong_pulse = 150.0; // cm/s
    const double t = period(x), ky = std::log(x.yield_coefficient), sa = std::log(*x.sa_13_g),
                 pgv = std::log(*x.pgv_cm_s);
    const bool strong = *x.pgv_cm_s > strong_pulse;
    const double of_period =
        t < 0.1 ? c.short_period + c.rigid_slope * t : c.long_period + (c.slope + c.curvature * t) * t;
    return of_period + (strong ? c.strong_shift + c.strong * pgv : c.moderate * pgv) + c.ky * ky +
           c.ky_squared * ky * ky + c.product * ky * sa + c.sa * sa + c.sa_squared * sa * sa +
           c.magnitude * *x.magnitude;
}

/// P(D < 0.5 cm) = 1/(1 + exp(c1 + c2 ln ky + c3 ln PGV + c4 Ts + c5 ln Sa)).
struct NearFaultZero {
    double c1, ky, pgv, period, sa;
};

double near_fault_zero(const Inputs& x, const NearFaultZero& to_07_s, const NearFaultZero& above)
{
    const NearFaultZero& c = period(x) <= 0.7 ? to_07_s : above;
    return 1.0 / (1.0 + std::exp(c.c1 + c.ky * std::log(x.yield_coefficient) + c.pgv * std::log(*x.pgv_cm_s) +
                                 c.period * period(x) + c.sa * std::log(*x.sa_13_g)));
}

double near_fault_largest(const Inputs& x)
{
    return near_fault(x, largest_direction);
}

double near_fault_median(const Inputs& x)
{
    return near_fault(x, median_direction);
}

/// Eqs. (4a), (4b).
double near_fault_largest_zero(const Inputs& x)
{
    return near_fault_zero(x, {-10.787, -8.717, 1.660, 3.150, 7.560}, {-12.771, -9.979, 2.286, -4.965, 4.817});
}

/// Eqs. (6a), (6b).
double near_fault_median_zero(const Inputs& x)
{
    return near_fault_zero(x, {-14.930, -10.383, 1.971, 3.763, 8.812}, {-14.671, -10.489, 2.222, -4.759, 5.549});
}

Regression near_fault_row(std::string_view id, std::string_view name, std::string_view formula,
                          double (*log_median)(const Inputs&), double (*sigma)(const Inputs&),
                          double (*zero)(const Inputs&))
{
    return {id,
            name,
            formula,
            Logarithm::natural,
            log_median,
            sigma,
            {Input::yield_coefficient, Input::magnitude, Input::pgv, Input::spectral_13},
            {{Input::yield_coefficient, 0.01, 0.80},
             {Input::period, 0.0, 2.0},
             {Input::magnitude, 5.5, 7.9, RangeSource::assumed}},
            "near-fault pulse motions of shallow crustal earthquakes; nonzero D",
            bray_macedo,
            EnsembleUse::on_request,
            nullptr,
            zero};
}

// c2 = 3.081 for T_s >= 0.1 s; some programs have 3.801, see docs/regressions.md.
double subduction(const Inputs& x)
{
    const double t = period(x), ky = std::log(x.yield_coefficient), sa = std::log(*x.sa_15_g);
    const double of_period = t < 0.1 ? -5.864 - 9.421 * t : -6.896 + (3.081 - 0.803 * t) * t;
    return of_period + 0.550 * *x.magnitude - 3.353 * ky - 0.390 * ky * ky + 0.538 * ky * sa + 3.060 * sa -
           0.225 * sa * sa;
}

} // namespace

std::vector<Regression> flexible_block_rows()
{
    return {
        {"rathje-antonakos-2011-pga-pgv",
         "Rathje & Antonakos 2011, PGA, PGV",
         "Saygili & Rathje 2008 (PGA, PGV) with kmax, k-velmax for amax, PGV; + 1.42 Ts (Ts <= 0.5 s) or 0.71",
         Logarithm::natural,
         antonakos_pgv,
         [](const Inputs& x) { return 0.400 + 0.284 * ratio_of_the_mass(x); },
         {Input::yield_coefficient, Input::pga, Input::pgv, Input::mean_period, Input::period},
         antonakos_range(),
         "as Saygili & Rathje 2008; Ts/Tm capped at 8",
         rathje_antonakos,
         EnsembleUse::estimate,
         k_max},
        {"rathje-antonakos-2011-pga-magnitude",
         "Rathje & Antonakos 2011, PGA, M",
         "Rathje & Saygili 2009 with kmax for amax; + 3.69 Ts - 1.22 Ts^2 (Ts <= 1.5 s) or 2.78",
         Logarithm::natural,
         antonakos_magnitude,
         [](const Inputs& x) { return 0.694 + 0.32 * ratio_of_the_mass(x); },
         {Input::yield_coefficient, Input::pga, Input::magnitude, Input::mean_period, Input::period},
         antonakos_range(),
         "as Rathje & Saygili 2009; Ts/Tm capped at 8",
         rathje_antonakos,
         EnsembleUse::estimate,
         k_max},
        {"bray-travasarou-2007",
         "Bray & Travasarou 2007",
         "ln D = -1.10 - 2.83 ln ky - 0.333 ln^2 ky + 0.566 ln ky ln Sa + 3.04 ln Sa - 0.244 ln^2 Sa + 1.5 Ts + 0.278 "
         "(M - 7), Sa at 1.5 Ts; Ts < 0.05 s: -0.22 for -1.10, no Ts term, Sa = amax",
         Logarithm::natural,
         travasarou,
         constant_sigma<660>,
         {Input::yield_coefficient, Input::pga, Input::magnitude, Input::spectral_15},
         {{Input::yield_coefficient, 0.01, 0.50},
          {Input::period, 0.0, 2.0},
          {Input::spectral_15, 0.002, 2.7},
          {Input::magnitude, 5.5, 7.6}},
         "688 records, 41 earthquakes; nonzero D",
         bray_travasarou,
         EnsembleUse::estimate,
         nullptr,
         travasarou_zero},
        {"bray-macedo-2019-rigid",
         "Bray & Macedo 2019, rigid",
         "ln D = -4.684 - 2.482 ln ky - 0.244 ln^2 ky + 0.344 ln ky ln amax + 2.649 ln amax - 0.090 ln^2 amax + 0.603 "
         "M",
         Logarithm::natural,
         macedo_rigid,
         constant_sigma<720>,
         {Input::yield_coefficient, Input::pga, Input::magnitude},
         {{Input::period, 0.0, 0.0},
          {Input::yield_coefficient, 0.01, 0.80},
          {Input::magnitude, 5.5, 7.9, RangeSource::data}},
         "shallow crustal earthquakes, ordinary motions; nonzero D",
         bray_macedo,
         EnsembleUse::estimate,
         peak_of_ground,
         macedo_rigid_zero},
        {"bray-macedo-2019",
         "Bray & Macedo 2019, general",
         "ln D = c1 + c2 Ts + c3 Ts^2 - 2.491 ln ky - 0.245 ln^2 ky + 0.344 ln ky ln Sa + 2.703 ln Sa - 0.089 ln^2 Sa "
         "+ "
         "0.607 M + [ln(PGV/115), PGV > 115 cm/s], Sa at 1.3 Ts; c = (-4.551, -9.690, 0) Ts < 0.1 s, (-5.894, 3.152, "
         "-0.910) else",
         Logarithm::natural,
         macedo,
         constant_sigma<740>,
         {Input::yield_coefficient, Input::magnitude, Input::pgv, Input::period, Input::spectral_13},
         {{Input::yield_coefficient, 0.01, 0.80},
          {Input::period, 0.0, 2.0},
          {Input::magnitude, 5.5, 7.9, RangeSource::data}},
         "6,711 two-component records of shallow crustal earthquakes; nonzero D",
         bray_macedo,
         EnsembleUse::estimate,
         nullptr,
         macedo_zero},
        near_fault_row("bray-macedo-2019-near-fault-d100", "Bray & Macedo 2019, near fault, largest direction",
                       "ln D = c1 + c2 Ts + c3 Ts^2 + c4 ln PGV - 2.632 ln ky - 0.278 ln^2 ky + 0.527 ln ky ln Sa + "
                       "1.978 ln Sa - 0.233 ln^2 "
                       "Sa + 0.06 M, Sa at 1.3 Ts; c = (-6.235, -2.744, 0) Ts < 0.1 s, (-6.462, 1.069, -0.498) else, "
                       "c4 = 1.547; PGV > 150 "
                       "cm/s: c1 + 8.715, c4 = -0.097",
                       near_fault_largest, constant_sigma<560>, near_fault_largest_zero),
        near_fault_row("bray-macedo-2019-near-fault-d50", "Bray & Macedo 2019, near fault, median direction",
                       "ln D = c1 + c2 Ts + c3 Ts^2 + c4 ln PGV - 2.931 ln ky - 0.319 ln^2 ky + 0.584 ln ky ln Sa + "
                       "2.261 ln Sa - 0.241 ln^2 "
                       "Sa + 0.05 M, Sa at 1.3 Ts; c = (-7.497, -2.731, 0) Ts < 0.1 s, (-7.718, 1.031, -0.480) else, "
                       "c4 = 1.458; PGV > 150 "
                       "cm/s: c1 + 7.349, c4 = 0.025",
                       near_fault_median, constant_sigma<540>, near_fault_median_zero),
        {"bray-macedo-travasarou-2018",
         "Bray, Macedo & Travasarou 2018 (subduction)",
         "ln D = c1 + 0.550 M + c2 Ts + c3 Ts^2 - 3.353 ln ky - 0.390 ln^2 ky + 0.538 ln ky ln Sa + 3.060 ln Sa - "
         "0.225 "
         "ln^2 Sa, Sa at 1.5 Ts; c = (-5.864, -9.421, 0) Ts < 0.1 s, (-6.896, 3.081, -0.803) else",
         Logarithm::natural,
         subduction,
         constant_sigma<730>,
         {Input::yield_coefficient, Input::magnitude, Input::spectral_15},
         {{Input::yield_coefficient, 0.01, 0.80},
          {Input::period, 0.0, 2.0},
          {Input::magnitude, 7.0, 9.0, RangeSource::data}},
         "810 two-component records of subduction interface earthquakes; nonzero D",
         bray_macedo_travasarou,
         EnsembleUse::on_request,
         nullptr,
         subduction_zero},
    };
}

} // namespace damslip::sliding
