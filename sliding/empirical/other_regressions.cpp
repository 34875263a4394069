#include "sliding/empirical/regression_rows.hpp"

#include <cmath>

namespace damslip::sliding {
namespace {

using Input = RegressionInput;
using Inputs = RegressionInputs;

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
