#include "scene/checks.hpp"

#include <fmt/format.h>

namespace damslip::checks {

void check_flexible_block(const Scene& s, Findings& f)
{
    if (!s.flexible_block) return;
    const FlexibleMass& m = *s.flexible_block;
    const auto wrong = [&f](const char* key, std::string problem, std::string expected, std::string fix) {
        f.wrong(key, std::move(problem), std::move(expected), std::move(fix));
    };
    if (m.height.has_value() != m.shear_velocity.has_value())
        wrong(m.height ? "flexible_block.height" : "flexible_block.shear_velocity",
              "flexible_block.height_m and shear_velocity_m_s are not both given.", "both or neither", "add the other");
    if (m.height && m.shear_velocity && (m.period || m.of_modes))
        wrong("flexible_block.period",
              "flexible_block.period_s is given together with height_m and shear_velocity_m_s.",
              "one of them: T_s = 4 H/V_s of the column", "delete period_s");
    for (const auto& [key, given] : {std::pair{"flexible_block.base_velocity", m.base_velocity},
                                     {"flexible_block.reference_strain", m.reference_strain}})
        if (given && !m.height)
            wrong(key, fmt::format("{} is given without a column.", key),
                  "height_m and shear_velocity_m_s of the column", "add them, or delete this key");
    if (!m.period && !m.of_modes && !m.height && !(s.regressions.period > 0.0))
        wrong("flexible_block", "flexible_block.period_s is missing.",
              "a period, or regressions.period_s, or \"modes\"", "add  period_s = 0.3  to [flexible_block]");
    if (m.modal_load.has_value() != m.modal_mass.has_value())
        wrong(m.modal_load ? "flexible_block.modal_load" : "flexible_block.modal_mass",
              "flexible_block.modal_load_kg_m and modal_mass_kg_m are not both given.", "both or neither",
              "add the other");
    const int ways = m.mass_ratio.has_value() + m.shape_exponent.has_value() + m.modal_mass.has_value();
    const char* first = m.mass_ratio       ? "flexible_block.mass_ratio"
                        : m.shape_exponent ? "flexible_block.shape_exponent"
                                           : "flexible_block.modal_mass";
    if (ways > 1)
        wrong(first, "flexible_block gives the mass ratio in more than one way.",
              "one of mass_ratio, shape_exponent, modal_load_kg_m with modal_mass_kg_m", "delete the others");
    if (m.of_modes && ways > 0)
        wrong(first, fmt::format("{} is given together with flexible_block.period_s = \"modes\".", first),
              "the modes of the finite-element model give the mass ratio too",
              "delete it, or give the period as a number");
    if (m.of_modes && !s.dam.young_modulus)
        wrong("flexible_block.period", "flexible_block.period_s = \"modes\" needs dam.young_modulus_GPa.",
              "Young's modulus of the dam", "add  young_modulus_GPa = 25  to [dam]");
}

} // namespace damslip::checks
