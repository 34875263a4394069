#include "analysis/screen/regression_rows.hpp"
#include "cli/flags.hpp"
#include "core/number.hpp"
#include "core/status.hpp"
#include "core/units.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/table_text.hpp"
#include "pages/screen/given_tables.hpp"
#include "pages/screen/screen_tables.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

namespace damslip::cli {

namespace {

/// What is known of an earthquake without its record. In the units of the flags.
struct RegressArguments {
    double yield_g = 0.0, pga_g = 0.0;
    std::optional<double> pgv_cm_s, arias_m_s, mean_period_s, magnitude, period_s, sa_13_g, sa_15_g, cycles;
    std::optional<double> allowable_mm; ///< then k(d*) of each
};

sliding::RegressionInputs inputs_of(const RegressArguments& a)
{
    sliding::RegressionInputs in;
    in.yield_coefficient = a.yield_g;
    in.pga_g = a.pga_g;
    in.arias_m_s = a.arias_m_s;
    in.pgv_cm_s = a.pgv_cm_s;
    in.mean_period_s = a.mean_period_s;
    in.magnitude = a.magnitude;
    in.period_s = a.period_s;
    const bool rigid = a.period_s.value_or(0.0) == 0.0;
    in.sa_13_g = a.sa_13_g ? a.sa_13_g : rigid ? std::optional(a.pga_g) : std::nullopt;
    in.sa_15_g = a.sa_15_g ? a.sa_15_g : rigid ? std::optional(a.pga_g) : std::nullopt;
    in.cycles = a.cycles;
    return in;
}

/// Slips by the regressions from given measures of the motion.
int regress(const RegressArguments& a, const Streams& streams)
{
    const sliding::RegressionInputs inputs = inputs_of(a);
    const std::vector<RegressionRow> rows = regression_rows("given measures", inputs);
    std::optional<Table> coefficients;
    if (a.allowable_mm) coefficients = pages::allowable_coefficient_table(inputs, *a.allowable_mm * units::mm);
    if (streams.form == Form::json) {
        nlohmann::ordered_json j{{"command", "regress"}, {"yield_g", a.yield_g}, {"pga_g", a.pga_g}};
        j["regressions"] = pages::json_of(pages::regression_table(rows));
        if (coefficients) j["k_allowable"] = pages::json_of(*coefficients);
        streams.out << j.dump(2) << "\n";
    } else {
        streams.out << pages::text(pages::regression_summary(rows)) << "\n";
        if (coefficients) streams.out << pages::text(*coefficients) << "\n";
    }
    return rows.back().valid ? exit_ok : exit_no_answer;
}

void regress_flags(CLI::App& sub, RegressArguments& a)
{
    sub.add_option("--yield-g", a.yield_g, "yield acceleration a_y [g]")->required()->check(in_range(1e-6, 10));
    sub.add_option("--pga-g", a.pga_g, "largest horizontal ground acceleration [g]")
        ->required()
        ->check(in_range(1e-6, 10));
    const char* const group = "What more is known of the motion";
    const auto optional = [&](const char* flag, std::optional<double>& target, const char* words, double low,
                              double high) {
        sub.add_option(flag, target, words)->check(in_range(low, high))->group(group);
    };
    optional("--pgv-cm-s", a.pgv_cm_s, "largest ground velocity [cm/s]", 1e-6, 1e4);
    optional("--arias-m-s", a.arias_m_s, "Arias intensity [m/s]", 1e-9, 1e4);
    optional("--magnitude", a.magnitude, "moment magnitude", 2, 10);
    optional("--mean-period-s", a.mean_period_s, "mean period T_m of Rathje et al. (1998) [s]", 1e-3, 100);
    optional("--cycles", a.cycles, "equivalent sine cycles", 1e-3, 1e4);
    optional("--period-s", a.period_s, "fundamental period of the sliding mass [s]; 0: rigid", 0, 100);
    optional("--sa13-g", a.sa_13_g, "5 % spectral acceleration at 1.3 periods [g]", 1e-6, 100);
    optional("--sa15-g", a.sa_15_g, "5 % spectral acceleration at 1.5 periods [g]", 1e-6, 100);
    sub.add_option("--allowable-mm", a.allowable_mm, "then also the yield coefficient for this slip [mm]")
        ->check(in_range(1e-3, 1e6));
}

} // namespace

Command regress_command()
{
    return {"regress", "slip by the regressions from PGA, PGV, magnitude and the like, without a record",
            "damslip regress --yield-g 0.08 --pga-g 0.35 --pgv-cm-s 28 --magnitude 6.8 --allowable-mm 50",
            with_flags<RegressArguments>(regress_flags, regress)};
}

} // namespace damslip::cli
