#include "studies/goldgruber_2015/study_modes.hpp"

#include "analysis/modes/modes.hpp"
#include "analysis/prepare/reservoir.hpp"
#include "analysis/sweep/sweep_axes.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/time/structure_system.hpp"
#include "scene/rock_mass.hpp"

#include <fmt/format.h>
#include <numbers>

namespace damslip::study {

namespace {

constexpr int listed = 5;

/// Goldgruber (2015), tables 4-3 and 4-4.
struct Printed {
    const char* water;
    double size;
    double frequency[listed], mass_sum[listed], mass_coefficient, stiffness_coefficient;
};
constexpr Printed printed_models[] = {
    {"acoustic", 1.0, {3.6, 9.9, 12.2, 17.1, 18.0}, {35.4, 54.3, 68.4, 78.2, 79.1}, 1.9, 0.0007},
    {"westergaard", 1.0, {3.6, 8.4, 10.6, 14.9, 15.9}, {59.5, 89.8, 91.3, 97.7, 99.0}, 1.8, 0.0008},
    {"acoustic", 2.0, {1.8, 4.9, 6.1, 8.5, 9.0}, {52.2, 72.1, 85.4, 95.9, 96.7}, 0.9, 0.0015},
    {"westergaard", 2.0, {1.8, 4.3, 5.3, 8.1, 8.8}, {59.9, 89.5, 90.7, 97.0, 98.3}, 0.9, 0.0015}};

fe2d::NaturalModes modes_of(const Scene& scene, double size)
{
    fe2d::ModelOptions options;
    options.added_mass = added_mass_law(scene);
    const fe2d::Model model = fe2d::build_model(with_massless_rock(scene), options);
    if (scene.reservoir->model != ReservoirModel::acoustic) return fe2d::natural_modes(model, listed);
    const fe2d::FluidModel water = fe2d::build_fluid(scene);
    const fe2d::CoupledModes coupled =
        fe2d::coupled_modes_up_to(fe2d::coupled_pencil(model, water), 20.0 / size, listed);
    return as_natural_modes(coupled, fe2d::leading_modes(coupled, listed));
}

ModelModes beside(const Scene& given, const Printed& printed)
{
    const Scene variant_scene = variant(given, given.reservoir->level, "seepage", printed.water, printed.size);
    const Scene scene = called_for(make_effect_plan(variant_scene, Method::finite_elements), variant_scene);
    const fe2d::NaturalModes modes = modes_of(scene, printed.size);
    ModelModes out{printed.water, printed.size, {}, printed.mass_coefficient, 0.0, printed.stiffness_coefficient, 0.0};
    double sum = 0.0;
    for (int i = 0; i < std::min<int>(listed, static_cast<int>(modes.frequency.size())); ++i) {
        sum += 100.0 * modes.effective_share(0, i);
        out.modes.push_back({printed.frequency[i], modes.frequency[i], printed.mass_sum[i], sum});
    }
    if (out.modes.size() < static_cast<std::size_t>(listed)) return out;
    const double two_pi = 2.0 * std::numbers::pi;
    const fe2d::RayleighConstants damping = fe2d::rayleigh_constants(
        scene.damping.ratio, two_pi * out.modes.front().frequency, two_pi * out.modes.back().frequency);
    out.mass_coefficient = damping.mass;
    out.stiffness_coefficient = damping.stiffness;
    return out;
}

} // namespace

std::vector<ModelModes> study_modes(const Scene& scene)
{
    std::vector<ModelModes> models;
    for (const Printed& printed : printed_models) models.push_back(beside(scene, printed));
    return models;
}

Table modes_table(const std::vector<ModelModes>& models, double size)
{
    struct Row {
        const ModelModes& model;
        std::size_t number; ///< from 0
        const ModeBeside& mode;
    };
    std::vector<Row> rows;
    for (const ModelModes& model : models)
        for (std::size_t i = 0; model.size == size && i < model.modes.size(); ++i)
            rows.push_back({model, i, model.modes[i]});
    const auto once = [](double ModelModes::*coefficient) { // of a model, beside its first mode
        return [=](const Row& r) { return r.number == 0 ? Cell(r.model.*coefficient) : Cell(); };
    };
    const auto of_mode = [](double ModeBeside::*value) { return [=](const Row& r) { return r.mode.*value; }; };
    using M = ModeBeside;
    return table_of<Row>(
        size == 1.0 ? "Natural frequencies and Rayleigh damping, 62.5 m (table 4-3)"
                    : "Natural frequencies and Rayleigh damping, 125 m (table 4-4)",
        {{{"water", "water"}, [](const Row& r) { return r.model.water; }},
         {{"mode", "mode"}, [](const Row& r) { return count_cell(r.number + 1); }},
         {{"printed_frequency_Hz", "f printed", "Hz", 3}, of_mode(&M::printed_frequency)},
         {{"frequency_Hz", "f here", "Hz", 4}, of_mode(&M::frequency)},
         {{"printed_mass_sum_percent", "mass sum printed", "%", 3}, of_mode(&M::printed_mass_sum)},
         {{"mass_sum_percent", "mass sum here", "%", 3}, of_mode(&M::mass_sum)},
         {{"printed_mass_coefficient_1_s", "a_M printed", "1/s", 3}, once(&ModelModes::printed_mass_coefficient)},
         {{"mass_coefficient_1_s", "a_M here", "1/s", 4}, once(&ModelModes::mass_coefficient)},
         {{"printed_stiffness_coefficient_s", "b_K printed", "s", 3}, once(&ModelModes::printed_stiffness_coefficient)},
         {{"stiffness_coefficient_s", "b_K here", "s", 3}, once(&ModelModes::stiffness_coefficient)}},
        rows,
        {"tied base. mass sum: of everything that moves in x, the mass of incompressible water included, over the "
         "listed modes; what the source divides by is not printed."});
}

} // namespace damslip::study
