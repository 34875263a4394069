#pragma once

#include "core/input_error.hpp"
#include "core/intensity_measure.hpp"
#include "scene/scene_text.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace damslip {

// Values of choices are in the order of the words of their keys (fragility_keys.cpp).

/// Where a value stands in the scene file, for messages that are written later.
struct LineOfFile {
    std::string key; ///< "probability.variable[mu].lognormal"
    std::size_t line = 0;
};

enum class VariableKind { aleatory, epistemic };

/// The law of one variable as the file writes it. Numbers have the unit in the name of the variable's first key.
struct LawInput {
    std::string name;                         ///< "lognormal", "normal", "uniform", "triangular", "beta", "discrete"
    std::map<std::string, double> parameters; ///< "median", "beta", "mean", "cov", "sd", "min", "mode", "max", "a", "b"
    std::vector<KeyValue> values;             ///< of discrete
    std::vector<double> weights;              ///< of discrete
    LineOfFile where;
};

struct RandomVariable {
    std::string name;              ///< given, or the first key
    std::vector<std::string> keys; ///< as SceneText::with() takes them, list entries by name; all take the same draw
    bool factor = false;           ///< the draw multiplies what the file says: SceneText::written()
    VariableKind kind = VariableKind::aleatory;
    LawInput law;
};

struct RankCorrelation {
    std::string first, second; ///< names of variables of one kind
    double spearman = 0.0;     ///< -1 ... 1, open
    LineOfFile where;
};

enum class SamplingInput { sobol, latin_hypercube, random };
enum class StaticFailure {
    infinite,      ///< a dam that does not stand has slipped without end
    given_standing ///< the dam stands today: such draws are left out, their share is printed
};

/// [probability]
struct ProbabilityInput {
    std::uint64_t seed = 1;
    SamplingInput sampling = SamplingInput::sobol;
    int replicates = 16;
    std::optional<int> samples; ///< aleatory draws per replicate and epistemic draw; none: by the budget
    StaticFailure static_failure = StaticFailure::infinite;
    std::vector<RandomVariable> variables;
    std::vector<RankCorrelation> correlations;
};

enum class SuiteDraw { balanced, with_replacement };
enum class SuitePolarity { both, as_recorded, reversed };

/// [suite]. Absent: the records of [motion].
struct SuiteInput {
    std::string
        files; ///< folder, glob, or CSV with columns horizontal, vertical, event, weight, magnitude, scale; found from where the
    ///< program runs: the reader has put the scene's folder in front
    LineOfFile where;
    SuiteDraw draw = SuiteDraw::balanced;
    SuitePolarity polarity = SuitePolarity::both;
    double max_scale = 4.0;     ///< largest factor on a record [-]
    bool allow_scaling = false; ///< beyond max_scale, listed
};

enum class FragilityDesign { stripes, ida, cloud };

/// [intensity]
struct IntensityInput {
    IntensityMeasure measure = IntensityMeasure::pga;
    bool first_period = false;   ///< SA(T1): T1 of the scene's dam
    std::vector<double> periods; ///< of sa (one) and avg_sa [s]
    std::string text = "PGA";    ///< as written: "SA(T1)"
    IntensityComponent component = IntensityComponent::as_used;
    std::vector<double> levels; ///< ascending, SI: m/s^2, m/s of PGV, IA and CAV
    FragilityDesign design = FragilityDesign::stripes;
    double level_unit = 1.0;              ///< SI value of one unit of the levels key: 9.80665 of levels_g
    std::string level_unit_text = "m/s2"; ///< "g", "m/s2", "m/s"
};

enum class LimitQuantity { slip, largest_slip, lift_off, post_seismic_fs };

/// [[limit]]
struct LimitInput {
    LimitQuantity quantity = LimitQuantity::slip;
    double value = 0.0; ///< exceeded above it; of post_seismic_fs below it. SI
    std::string text;           ///< "slip > 50 mm"
    std::string plane = "base"; ///< that slides: a name, or "any", the one that slides furthest
};

/// [hazard]
struct HazardInput {
    std::filesystem::path curve;               ///< a file that read_hazard_file() reads. With the scene's folder
    std::optional<std::array<double, 2>> site; ///< longitude, latitude [degrees] of the curve among several
    std::optional<double> all_events;          ///< rate of all events [1/year]
    LineOfFile where;
};

/// The tables of a scene file that fragility alone reads.
inline constexpr const char* fragility_tables[] = {"probability", "suite", "intensity", "limit", "hazard"};

/// What `damslip fragility` asks of a scene.
struct FragilityInput {
    ProbabilityInput probability;
    std::optional<SuiteInput> suite;
    IntensityInput intensity;
    std::vector<LimitInput> limits; ///< at least one, all of one plane
    std::optional<HazardInput> hazard;
};

/// The tables [probability], [suite], [intensity], [[limit]] and [hazard] of a scene file. Other commands look them over.
/// @throws InputError with everything that is wrong at once
FragilityInput read_fragility_input(const std::filesystem::path& file);

/// What is wrong in those of these tables that a scene has: every command reads them, so that a misspelt key is found at once. Tables that only
/// `fragility` needs may be missing.
std::vector<Diagnostic> wrong_in_fragility_tables(std::string_view text, const std::filesystem::path& file);

/// The same of a text. @param instead  TOML of the same tables: its keys take the place of those of the text; of [[limit]] and
/// [[probability.variable]] the whole list does, of [intensity] the levels in any unit. What is wrong in it has no line.
/// @param file  for messages; paths start from its folder
FragilityInput fragility_input_of(std::string_view text, std::string_view instead, const std::filesystem::path& file);

} // namespace damslip
