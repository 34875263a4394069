#pragma once

#include <functional>
#include <string>
#include <vector>

/// Verification cases: registered once, seen by ctest, by `damslip verify` and in docs/verification.md.
namespace damslip::verification {

enum class Measure { relative, absolute, upper_bound, lower_bound };

/// One figure held against its exact or published value. Bounds: `expected` is the limit, `tolerance` is not used.
struct Check {
    std::string quantity;
    std::string unit;
    double expected = 0.0;
    double computed = 0.0;
    double tolerance = 0.0;
    Measure measure = Measure::relative;

    double error() const; ///< |computed - expected| (/ |expected|); NaN where the computed value is not finite
    bool passed() const;  ///< false for anything not finite
};

struct Case {
    std::string id;        ///< "sliding.block.decaying-ramp": module.part.what
    std::string claim;     ///< one sentence: what is shown
    std::string source;    ///< the exact or published solution, with equation number or citation
    std::string tolerance; ///< why the tolerances are what they are
    std::function<std::vector<Check>()> run;
};

using Registry = std::vector<Case>;

/// All cases, in the order of the documentation. Each register_... function lives in the file of its module.
Registry all_cases();

} // namespace damslip::verification
