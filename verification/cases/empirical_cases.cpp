#include "sliding/empirical/regression.hpp"
#include "verification/cases/modules.hpp"

namespace damslip::verification {

namespace {

using namespace damslip::sliding;

/// r = 1/2, Ia = 1 m/s, a_c = 0.1 g: what the published formulas give by hand.
std::vector<Check> values_by_hand()
{
    RegressionInputs inputs;
    inputs.yield_coefficient = 0.1;
    inputs.pga_g = 0.2;
    inputs.arias_m_s = 1.0;
    std::vector<Check> checks;
    const auto check = [&](const char* id, double median, double sigma_factor) {
        const Regression& regression = *find_regression(id);
        const RegressionResult result = evaluate(regression, inputs);
        checks.push_back({std::string(regression.name) + ": D", "cm", median, result.median_cm.value_or(-1.0), 1e-5});
        checks.push_back({std::string(regression.name) + ": +1 sigma", "cm", median * sigma_factor,
                          result.plus_sd_cm.value_or(-1.0), 1e-5});
    };
    check("ambraseys-menu-1988", 2.927634, 1.995262); // 0.90 + 1.44 log10 0.5 = 0.466517
    check("jibson-1993", 7.617282, 2.564484);         // 1.546 - 0.6642 = 0.8818
    check("jibson-1998", 2.798981, 2.371374);         // 1.993 - 1.546 = 0.447
    inputs.yield_coefficient = 0.2;
    checks.push_back({"at a_y = PGA", "cm", 0.0, evaluate(regressions()[0], inputs).median_cm.value_or(-1.0), 0.0,
                      Measure::absolute});
    return checks;
}

} // namespace

void add_empirical_cases(Registry& registry)
{
    registry.push_back({"sliding.empirical.values",
                        "The three regressions of the source at round values of their inputs.",
                        "Ambraseys & Menu (1988), Jibson (1993), Jibson et al. (1998): Goldgruber (2015) (4-6), (4-7), "
                        "(4-9), misprints corrected",
                        "seven digits computed by hand", values_by_hand});
}

} // namespace damslip::verification
