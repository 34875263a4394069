#include "sliding/empirical/regression.hpp"

#include <cmath>

namespace damslip::sliding {

namespace {

using Input = RegressionInput;
using Inputs = RegressionInputs;

/// log10[(1 - r)^a r^-b], the common part of the ratio models.
double ratio_term(const Inputs& x, double a, double b)
{
    return a * std::log10(1.0 - x.ratio()) - b * std::log10(x.ratio());
}

constexpr std::string_view ambraseys_menu =
    "Ambraseys, N.N. & Menu, J.M. (1988): Earthquake-induced ground displacements. Earthquake Engineering and "
    "Structural Dynamics 16, 985-1006";
constexpr std::string_view jibson_1993 =
    "Jibson, R.W. (1993): Predicting earthquake-induced landslide displacements using Newmark's sliding "
    "block analysis. Transportation Research Record 1411, 9-17";
constexpr std::string_view jibson_1998 =
    "Jibson, R.W., Harp, E.L. & Michael, J.A. (1998): A method for producing digital probabilistic seismic "
    "landslide hazard maps. U.S. Geological Survey Open-File Report 98-113";
constexpr std::string_view jibson_2007 =
    "Jibson, R.W. (2007): Regression models for estimating coseismic landslide displacement. Engineering "
    "Geology 91, 209-218";
constexpr std::string_view saygili_rathje =
    "Saygili, G. & Rathje, E.M. (2008): Empirical predictive models for earthquake-induced sliding "
    "displacements of slopes. Journal of Geotechnical and Geoenvironmental Engineering 134, 790-803";
constexpr std::string_view rathje_saygili =
    "Rathje, E.M. & Saygili, G. (2009): Probabilistic assessment of earthquake-induced sliding "
    "displacements of natural slopes. Bulletin of the New Zealand Society for Earthquake Engineering 42, "
    "18-27";
constexpr std::string_view records_2007 = "2,270 strong-motion components, 30 earthquakes";
constexpr std::string_view records_arias_2007 = "875 strong-motion components";
constexpr std::string_view records_2008 = "2,383 strong-motion components";

// Ranges; those not of the publication are the span of the data it names (docs/regressions.md, "Ranges").
std::vector<ValidityRange> ambraseys_range()
{
    return {{Input::ratio, 0.1, 0.9}, {Input::magnitude, 6.6, 7.3}};
}
std::vector<ValidityRange> jibson_1993_range()
{
    return {{Input::yield_coefficient, 0.02, 0.40}, {Input::arias_intensity, 0.2, 10.0}};
}
std::vector<ValidityRange> jibson_1998_range()
{
    return {{Input::yield_coefficient, 0.02, 0.40}};
}
std::vector<ValidityRange> jibson_2007_range()
{
    return {{Input::yield_coefficient, 0.05, 0.40}, {Input::magnitude, 5.3, 7.6}};
}
std::vector<ValidityRange> saygili_range()
{
    return {{Input::yield_coefficient, 0.05, 0.30}, {Input::magnitude, 5.0, 7.9, RangeSource::data}};
}

} // namespace

std::vector<Regression> rigid_block_rows()
{
    return {
        {"ambraseys-menu-1988",
         "Ambraseys & Menu 1988",
         "log10 D = 0.90 + log10[(1-r)^2.53 r^-1.09]",
         Logarithm::decimal,
         [](const Inputs& x) { return 0.90 + ratio_term(x, 2.53, 1.09); },
         constant_sigma<300>,
         {Input::yield_coefficient, Input::pga},
         ambraseys_range(),
         "50 records, 11 earthquakes",
         ambraseys_menu},
        {"jibson-1993",
         "Jibson 1993",
         "log10 D = 1.460 log10 Ia - 6.642 ac + 1.546",
         Logarithm::decimal,
         [](const Inputs& x) { return 1.460 * std::log10(*x.arias_m_s) - 6.642 * x.yield_coefficient + 1.546; },
         constant_sigma<409>,
         {Input::yield_coefficient, Input::arias_intensity},
         jibson_1993_range(),
         "11 records",
         jibson_1993},
        {"jibson-1998",
         "Jibson et al. 1998",
         "log10 D = 1.521 log10 Ia - 1.993 log10 ac - 1.546",
         Logarithm::decimal,
         [](const Inputs& x) {
             const double a_c = x.yield_coefficient;
             return 1.521 * std::log10(*x.arias_m_s) - 1.993 * std::log10(a_c) - 1.546;
         },
         constant_sigma<375>,
         {Input::yield_coefficient, Input::arias_intensity},
         jibson_1998_range(),
         "555 records, 13 earthquakes",
         jibson_1998},
        {"jibson-2007-ratio",
         "Jibson 2007 (6)",
         "log10 D = 0.215 + log10[(1-r)^2.341 r^-1.438]",
         Logarithm::decimal,
         [](const Inputs& x) { return 0.215 + ratio_term(x, 2.341, 1.438); },
         constant_sigma<510>,
         {Input::yield_coefficient, Input::pga},
         jibson_2007_range(),
         records_2007,
         jibson_2007},
        {"jibson-2007-ratio-magnitude",
         "Jibson 2007 (7)",
         "log10 D = -2.710 + log10[(1-r)^2.335 r^-1.478] + 0.424 M",
         Logarithm::decimal,
         [](const Inputs& x) { return -2.710 + ratio_term(x, 2.335, 1.478) + 0.424 * *x.magnitude; },
         constant_sigma<454>,
         {Input::yield_coefficient, Input::pga, Input::magnitude},
         jibson_2007_range(),
         records_2007,
         jibson_2007},
        {"jibson-2007-arias",
         "Jibson 2007 (9)",
         "log10 D = 2.401 log10 Ia - 3.481 log10 ac - 3.230",
         Logarithm::decimal,
         [](const Inputs& x) {
             return 2.401 * std::log10(*x.arias_m_s) - 3.481 * std::log10(x.yield_coefficient) - 3.230;
         },
         constant_sigma<656>,
         {Input::yield_coefficient, Input::arias_intensity},
         jibson_2007_range(),
         records_arias_2007,
         jibson_2007},
        {"jibson-2007-arias-ratio",
         "Jibson 2007 (10)",
         "log10 D = 0.561 log10 Ia - 3.833 log10 r - 1.474",
         Logarithm::decimal,
         [](const Inputs& x) { return 0.561 * std::log10(*x.arias_m_s) - 3.833 * std::log10(x.ratio()) - 1.474; },
         constant_sigma<616>,
         {Input::yield_coefficient, Input::pga, Input::arias_intensity},
         jibson_2007_range(),
         records_arias_2007,
         jibson_2007},
        {"saygili-rathje-2008-pga",
         "Saygili & Rathje 2008, PGA",
         "ln D = 5.52 - 4.43 r - 20.39 r^2 + 42.61 r^3 - 28.74 r^4 + 0.72 ln amax",
         Logarithm::natural,
         [](const Inputs& x) {
             return quartic(x.ratio(), 5.52, -4.43, -20.39, 42.61, -28.74) + 0.72 * std::log(x.pga_g);
         },
         constant_sigma<1130>,
         {Input::yield_coefficient, Input::pga},
         saygili_range(),
         records_2008,
         saygili_rathje},
        {"saygili-rathje-2008-pga-pgv",
         "Saygili & Rathje 2008, PGA, PGV",
         "ln D = -1.56 - 4.58 r - 20.84 r^2 + 44.75 r^3 - 30.50 r^4 - 0.64 ln amax + 1.55 ln PGV",
         Logarithm::natural,
         [](const Inputs& x) {
             return quartic(x.ratio(), -1.56, -4.58, -20.84, 44.75, -30.50) - 0.64 * std::log(x.pga_g) +
                    1.55 * std::log(*x.pgv_cm_s);
         },
         [](const Inputs& x) { return 0.41 + 0.52 * x.ratio(); },
         {Input::yield_coefficient, Input::pga, Input::pgv},
         saygili_range(),
         records_2008,
         saygili_rathje},
        {"saygili-rathje-2008-pga-arias",
         "Saygili & Rathje 2008, PGA, Ia",
         "ln D = 2.39 - 5.24 r - 18.78 r^2 + 42.01 r^3 - 29.15 r^4 - 1.56 ln amax + 1.38 ln Ia",
         Logarithm::natural,
         [](const Inputs& x) {
             return quartic(x.ratio(), 2.39, -5.24, -18.78, 42.01, -29.15) - 1.56 * std::log(x.pga_g) +
                    1.38 * std::log(*x.arias_m_s);
         },
         [](const Inputs& x) { return 0.46 + 0.56 * x.ratio(); },
         {Input::yield_coefficient, Input::pga, Input::arias_intensity},
         saygili_range(),
         records_2008,
         saygili_rathje},
        {"saygili-rathje-2008-pga-pgv-arias",
         "Saygili & Rathje 2008, PGA, PGV, Ia",
         "ln D = -0.74 - 4.93 r - 19.91 r^2 + 43.75 r^3 - 30.12 r^4 - 1.30 ln amax + 1.04 ln PGV + 0.67 ln Ia",
         Logarithm::natural,
         [](const Inputs& x) {
             return quartic(x.ratio(), -0.74, -4.93, -19.91, 43.75, -30.12) - 1.30 * std::log(x.pga_g) +
                    1.04 * std::log(*x.pgv_cm_s) + 0.67 * std::log(*x.arias_m_s);
         },
         [](const Inputs& x) { return 0.20 + 0.79 * x.ratio(); },
         {Input::yield_coefficient, Input::pga, Input::pgv, Input::arias_intensity},
         saygili_range(),
         records_2008,
         saygili_rathje},
        {"saygili-rathje-2008-pga-period",
         "Saygili & Rathje 2008, PGA, Tm",
         "ln D = 6.62 - 3.93 r - 23.71 r^2 + 49.37 r^3 - 32.94 r^4 + 0.93 ln amax + 1.79 ln Tm",
         Logarithm::natural,
         [](const Inputs& x) {
             // + 0.93, near the a_max T_m^2 that dimensions ask for; some lists have - 0.93, which gives several
             // times the other four of the family on ordinary records.
             return quartic(x.ratio(), 6.62, -3.93, -23.71, 49.37, -32.94) + 0.93 * std::log(x.pga_g) +
                    1.79 * std::log(*x.mean_period_s);
         },
         [](const Inputs& x) { return 0.60 + 0.26 * x.ratio(); },
         {Input::yield_coefficient, Input::pga, Input::mean_period},
         saygili_range(),
         records_2008,
         saygili_rathje},
        {"rathje-saygili-2009",
         "Rathje & Saygili 2009, PGA, M",
         "ln D = 4.89 - 4.85 r - 19.64 r^2 + 42.49 r^3 - 29.06 r^4 + 0.72 ln amax + 0.89 (M - 6)",
         Logarithm::natural,
         [](const Inputs& x) {
             return quartic(x.ratio(), 4.89, -4.85, -19.64, 42.49, -29.06) + 0.72 * std::log(x.pga_g) +
                    0.89 * (*x.magnitude - 6.0);
         },
         [](const Inputs& x) { return 0.73 + x.ratio() * (0.789 - 0.539 * x.ratio()); },
         {Input::yield_coefficient, Input::pga, Input::magnitude},
         saygili_range(),
         "more than 2,000 strong-motion components",
         rathje_saygili},
    };
}

namespace {

constexpr std::string_view hynes_griffin =
    "Hynes-Griffin, M.E. & Franklin, A.G. (1984): Rationalizing the seismic coefficient method. U.S. Army Engineer "
    "Waterways Experiment Station, Misc. Paper GL-84-13; fits by Meehan, C.L. & Vahedifard, F. (2013), Engineering "
    "Geology 152, 187-193";
constexpr std::string_view yegian =
    "Yegian, M.K., Marciano, E.A. & Ghahraman, V.G. (1991): Earthquake-induced permanent deformations: probabilistic "
    "approach. Journal of Geotechnical Engineering 117, 35-50";
constexpr std::string_view fotopoulou =
    "Fotopoulou, S.D. & Pitilakis, K.D. (2015): Predictive relationships for seismically induced slope displacements "
    "using numerical analysis results. Bulletin of Earthquake Engineering 13, 3207-3238";
constexpr std::string_view hsieh_lee =
    "Hsieh, S.-Y. & Lee, C.-T. (2011): Empirical estimation of the Newmark displacement from the Arias intensity and "
    "critical acceleration. Engineering Geology 122, 34-42";

const double ln_100 = std::log(100.0); // Fotopoulou & Pitilakis' D is in metres

// Abscissa of the charts; magnitudes of the records behind them.
std::vector<ValidityRange> hynes_griffin_range()
{
    return {{Input::ratio, 0.01, 1.0}, {Input::magnitude, 3.8, 7.7, RangeSource::data}};
}

// The models have yield coefficients of 0.05 to 0.30 and motions of these magnitudes and peaks.
std::vector<ValidityRange> fotopoulou_range()
{
    return {{Input::yield_coefficient, 0.05, 0.30, RangeSource::data},
            {Input::pga, 0.06, 0.91, RangeSource::data},
            {Input::magnitude, 5.0, 7.62, RangeSource::data}};
}

double log10_ratio(const Inputs& x)
{
    return std::log10(x.ratio());
}

} // namespace

std::vector<Regression> other_rows()
{
    return {
        // In powers of log10 r: so the upper bound is 1 m at r = 0.17, on which the report's seismic coefficient of half
        // the PGA rests. In powers of r itself it would be 3 cm.
        {"hynes-griffin-franklin-1984-mean",
         "Hynes-Griffin & Franklin 1984, mean",
         "log10 D = -0.287 - 2.854 L - 1.733 L^2 - 0.702 L^3 - 0.116 L^4, L = log10 r",
         Logarithm::decimal,
         [](const Inputs& x) { return quartic(log10_ratio(x), -0.287, -2.854, -1.733, -0.702, -0.116); },
         nullptr,
         {Input::yield_coefficient, Input::pga},
         hynes_griffin_range(),
         "fits to the published charts",
         hynes_griffin},
        {"hynes-griffin-franklin-1984-upper",
         "Hynes-Griffin & Franklin 1984, upper bound",
         "log10 D = 0.804 - 1.847 L - 0.285 L^2 + 0.193 L^3 + 0.078 L^4, L = log10 r",
         Logarithm::decimal,
         [](const Inputs& x) { return quartic(log10_ratio(x), 0.804, -1.847, -0.285, 0.193, 0.078); },
         nullptr,
         {Input::yield_coefficient, Input::pga},
         hynes_griffin_range(),
         "the same; upper bound, no estimate",
         hynes_griffin,
         EnsembleUse::on_request},
        {"yegian-1991",
         "Yegian et al. 1991",
         "log10 [D/(amax Neq T^2)] = 0.22 - 10.12 r + 16.38 r^2 - 11.48 r^3; amax in cm/s^2, T = Tm",
         Logarithm::decimal,
         [](const Inputs& x) {
             const double amax_cm_s2 = 980.665 * x.pga_g;
             return quartic(x.ratio(), 0.22, -10.12, 16.38, -11.48, 0.0) +
                    std::log10(amax_cm_s2 * *x.cycles * *x.mean_period_s * *x.mean_period_s);
         },
         constant_sigma<450>,
         {Input::yield_coefficient, Input::pga, Input::mean_period, Input::cycles},
         {{Input::ratio, 0.05, 1.0, RangeSource::assumed}},
         "normalised by amax Neq T^2; Neq by Arias intensity is ours",
         yegian,
         EnsembleUse::on_request},
        {"fotopoulou-pitilakis-2015-pgv-magnitude",
         "Fotopoulou & Pitilakis 2015, PGV, M",
         "ln D = -9.891 + 1.873 ln PGV - 5.964 ky + 0.285 M, D in m",
         Logarithm::natural,
         [](const Inputs& x) {
             return ln_100 - 9.891 + 1.873 * std::log(*x.pgv_cm_s) - 5.964 * x.yield_coefficient + 0.285 * *x.magnitude;
         },
         nullptr,
         {Input::yield_coefficient, Input::pga, Input::pgv, Input::magnitude},
         fotopoulou_range(),
         "finite-difference models of soil slopes",
         fotopoulou},
        {"fotopoulou-pitilakis-2015-pga-magnitude",
         "Fotopoulou & Pitilakis 2015, PGA, M",
         "ln D = -2.965 + 2.127 ln amax - 6.583 ky + 0.535 M, D in m",
         Logarithm::natural,
         [](const Inputs& x) {
             return ln_100 - 2.965 + 2.127 * std::log(x.pga_g) - 6.583 * x.yield_coefficient + 0.535 * *x.magnitude;
         },
         nullptr,
         {Input::yield_coefficient, Input::pga, Input::magnitude},
         fotopoulou_range(),
         "the same",
         fotopoulou},
        {"fotopoulou-pitilakis-2015-ratio-magnitude",
         "Fotopoulou & Pitilakis 2015, ratio, M",
         "ln D = -10.246 - 2.165 ln r + 7.844 ky + 0.654 M, D in m",
         Logarithm::natural,
         [](const Inputs& x) {
             return ln_100 - 10.246 - 2.165 * std::log(x.ratio()) + 7.844 * x.yield_coefficient + 0.654 * *x.magnitude;
         },
         nullptr,
         {Input::yield_coefficient, Input::pga, Input::magnitude},
         fotopoulou_range(),
         "the same",
         fotopoulou},
        {"fotopoulou-pitilakis-2015-pgv-ratio",
         "Fotopoulou & Pitilakis 2015, PGV, ratio",
         "ln D = -8.360 + 1.873 ln PGV - 0.347 ln r - 5.964 ky, D in m",
         Logarithm::natural,
         [](const Inputs& x) {
             return ln_100 - 8.360 + 1.873 * std::log(*x.pgv_cm_s) - 0.347 * std::log(x.ratio()) -
                    5.964 * x.yield_coefficient;
         },
         nullptr,
         {Input::yield_coefficient, Input::pga, Input::pgv},
         fotopoulou_range(),
         "the same",
         fotopoulou},
        {"hsieh-lee-2011",
         "Hsieh & Lee 2011",
         "log10 D = 0.788 log10 Ia - 10.166 ac + 5.95 ac log10 Ia + 1.779",
         Logarithm::decimal,
         [](const Inputs& x) {
             const double ia = std::log10(*x.arias_m_s);
             return 0.788 * ia - 10.166 * x.yield_coefficient + 5.95 * x.yield_coefficient * ia + 1.779;
         },
         constant_sigma<294>,
         {Input::yield_coefficient, Input::pga, Input::arias_intensity},
         {{Input::yield_coefficient, 0.01, 0.40, RangeSource::data}},
         "one of the forms of the source",
         hsieh_lee},
    };
}

} // namespace damslip::sliding
