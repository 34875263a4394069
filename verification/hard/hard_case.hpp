#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Scenes that are hard on the numerics, each with the same figure by two methods, or by one and its limit: registered
/// once, seen by ctest, by `damslip verify --hard` and in docs/verification.md.
namespace damslip::hard {

inline constexpr double largest_complementarity = 1e-8; ///< of N': contact is solved to 1e-11 of the largest force that
                                                        ///< would hold all pairs, itself up to some 100 N'
inline constexpr double largest_energy_closure = 1e-9;  ///< of the largest energy: round-off of all steps

/// What one scene came to.
struct HardResult {
    double value_a = 0.0, value_b = 0.0;   ///< of HardCase::quantity by method a and b
    double tolerance = 0.0;                ///< of their difference, absolute, in the quantity's unit
    std::optional<double> complementarity; ///< largest residual of contact and Coulomb's law over the static N' [-];
                                           ///< none: no finite elements in it
    std::optional<double> energy_closure;  ///< largest imbalance of any row over the largest energy [-]
    std::string status;                    ///< how method a ended
};

struct HardCase {
    std::string id;  ///< "hard.friction.one-percent-below": what, and how
    std::string why; ///< why it is hard: one sentence
    std::string quantity = "slip", unit = "m";
    std::string method_a, method_b;
    std::string tolerance; ///< why it is what it is
    std::string expected_status = "at rest";
    double energy_closure = largest_energy_closure; ///< allowed [-]
    std::function<HardResult()> run;
};

/// Within tolerance, contact solved, energy closed, ended as expected; false for anything not finite.
bool passed(const HardCase& subject, const HardResult& result);

using HardCases = std::vector<HardCase>;
HardCases all_hard_cases();

// One function per file of this folder; each appends its cases.
void add_friction_cases(HardCases& cases);
void add_opening_cases(HardCases& cases);
void add_stiffness_cases(HardCases& cases);
void add_time_cases(HardCases& cases);
void add_record_cases(HardCases& cases);
void add_water_cases(HardCases& cases);
void add_law_cases(HardCases& cases);
void add_self_excited_cases(HardCases& cases);
void add_anchor_cases(HardCases& cases);
void add_rate_cases(HardCases& cases);
void add_bond_cases(HardCases& cases);

} // namespace damslip::hard
