#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// How strong the shaking of a record is, in one number.
namespace damslip {

enum class IntensityMeasure {
    pga,    ///< max |a| [m/s^2]
    pgv,    ///< max |v| [m/s]
    sa,     ///< pseudo-acceleration at 5 % damping and one period [m/s^2]
    avg_sa, ///< geometric mean of SA over several periods [m/s^2]
    arias,  ///< Arias intensity I_A [m/s]
    cav     ///< cumulative absolute velocity [m/s]
};

/// Which horizontal motion is measured.
enum class IntensityComponent {
    as_used, ///< the component that shakes the dam
    geomean  ///< square root of the product of that of both horizontals; of a record of one component that one
};

/// A measure with its periods, as people write it: PGA, PGV, SA(0.3), SA(T1), avgSA(0.1,0.2,0.5), IA, CAV.
struct IntensityName {
    IntensityMeasure measure = IntensityMeasure::pga;
    bool first_period = false;   ///< SA(T1): the first period of the dam
    std::vector<double> periods; ///< of sa (one; none for SA(T1)) and avg_sa (two or more), ascending, 0.01 ... 20 [s]
};

/// @returns nothing for what is no measure
std::optional<IntensityName> parse_intensity(std::string_view text);

/// "SA(0.3)".
std::string text_of(const IntensityName& name);

/// PGA, SA and avgSA are accelerations [m/s^2], the others have the unit of a velocity [m/s].
bool is_acceleration(IntensityMeasure measure);

/// The power of the factor on a record with which its intensity grows: 2 for I_A, else 1.
int power_of_scale(IntensityMeasure measure);

/// For messages: what parse_intensity() takes.
inline constexpr std::string_view known_intensities =
    "PGA, PGV, SA(T1), SA(0.3), avgSA(0.1,0.2,0.5) with periods of 0.01 ... 20 s, IA, CAV";

} // namespace damslip
