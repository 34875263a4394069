#pragma once

#include "analysis/prepare/records.hpp"
#include "core/csv.hpp"
#include "core/status.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"
#include "records/record.hpp"
#include "scene/anchor_bar.hpp"
#include "scene/effect_plan.hpp"
#include "scene/scene.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"
#include "sliding/uplift/uplift.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What the numbers of a report hold for, and parts that several reports share.
namespace damslip::pages {

/// "Limits of validity": what each model of the method leaves out, for this scene.
/// @param method  finite elements: the rigid block's rows, too, as it stands beside them
Section limits_section(const Scene& scene, Method method);

/// "Limit equilibrium": the checks of all load combinations as one matrix, their quantities, and the loads of each, folded.
Section equilibrium_section(const std::vector<sliding::Equilibrium>& combinations);

/// One row per load, sum and uplift of one combination: Fx, Fy [kN/m], moment about the heel [kN m/m].
Table load_table(const sliding::Equilibrium& e);

/// One row per combination: levels, seismic coefficients, N', T, U, factors, resultant, stresses, crack, accelerations.
Table equilibrium_table(const std::vector<sliding::Equilibrium>& all);

/// One row per check of each combination: value, required value, PASS / FAIL / no criterion, source.
Table verdict_table(const std::vector<sliding::Equilibrium>& all);

/// For people: a row for each combination that is judged, a column for each check: "FAIL 2.950 / 3".
Table check_matrix(const std::vector<sliding::Equilibrium>& all);

/// The checks that fail, the strongest answer of the combinations: "usual 2.95 < 3.0; post-MCE, cracked 1.01 < 1.1";
/// empty: all hold, or none is required.
std::string failed_checks(const std::vector<sliding::Equilibrium>& all);
/// "2.95 < 3.0", with as many digits as tell the two apart. @param required  least value, or largest where `value` is above it
std::string unmet_words(double value, double required);

/// Uplift and critical friction of each model.
Table uplift_comparison_table(const std::vector<sliding::UpliftComparison>& all);

/// The table of records with what its measures mean.
TablePart record_part(Table table);

/// The plan of effects with how it is to be read.
TablePart effect_part(const EffectPlan& plan);

/// The plan as a table: effect, on, because, cost. @param on  those that are on, or off; none: all
Table effect_table(const EffectPlan& plan, std::optional<bool> on = {});

/// What every answer says of where it comes from.

/// How the --json object of a command on a scene begins: schema, program, the scene's title, file and hash.
/// @param hash  of the scene as it was given (EffectPlan::scene_hash); empty: `scene` is that. The hash of `scene` as it stands, with
/// what was chosen for it, is resolved_hash
nlohmann::ordered_json json_header(const std::string& what, const Scene& scene, const std::string& hash = {});

/// A page with the scene's title, and below it what the page is about, the scene's file and hash, the version.
/// @param about  sentences: "What accuracy costs. "
Page begin_page(const Scene& scene, const std::string& about, const std::string& hash = {});

/// The resolved scene, folded.
Listing scene_listing(const Scene& scene);

/// Program, scene, its hash and that of the resolved scene. @param hash  as of json_header()
std::vector<std::pair<std::string, std::string>> scene_provenance(const Scene& scene, const std::string& hash = {});

/// File, format, samples and checksum of each component, after what the list holds.
void add_record_provenance(const std::vector<RecordPair>& records,
                           std::vector<std::pair<std::string, std::string>>& list);

/// How most pages end: the scene, then the provenance of scene, answer and records.
/// @param entries  of the provenance, between those of scene and records @param hash  as of json_header()
void end_page(const Scene& scene, const std::vector<RecordPair>& records, Page& page,
              const std::vector<std::pair<std::string, std::string>>& entries = {}, const std::string& hash = {});

/// What reading them found, with their names.
std::vector<std::string> record_warnings(const std::vector<RecordPair>& records);

/// Anchors: what they are, and what a run made of them.

/// Strengths and limits of the scene's anchors; without rows where it has none.
Table anchor_list_table(const Scene& scene);

/// One anchor in one run.
struct AnchorRow {
    std::string record;
    int polarity = 1;
    const AnchorOutcome& anchor;
};
Table anchor_run_table(const std::vector<AnchorRow>& rows);

/// One event of a sequence in one run.
struct EventRow {
    std::string record;
    int polarity = 1;
    const EventSlip& event;
    const EventSlip* rigid = nullptr; ///< the same of the rigid block beside the run; null: not known
};
/// @param more  columns
Table event_run_table(const std::vector<EventRow>& rows, const std::vector<ColumnOf<EventRow>>& more,
                      const std::string& note);

/// Records as tables and spectra.

/// Sections of records that a report shows unfolded.
inline constexpr std::size_t open_records = 3;

/// Response spectra of the horizontal components, pseudo-acceleration, 5 %: each record up to 6, beyond that median, 16/84 %
/// and all records faintly. @param jobs  threads, 0: all cores
Chart spectra(const std::vector<GroundMotion>& motions, int jobs);

/// "Records": their table and spectra. @param jobs  threads, 0: all cores
Section records_section(const std::vector<GroundMotion>& motions, int jobs);

/// Fewer samples in each chart of a history the more records there are: about 80 000 abscissae in all histories of one
/// kind keep a report of any number of records at a few megabytes. Call it when the chart has its curves.
/// @param all  abscissae of all records @param most  of this chart
void thin_for(Chart& chart, std::size_t records, std::size_t all = 80000, std::size_t most = 20000);

/// Measures of the scaled horizontal components: PGA, PGV, I_A, duration, mean period; vertical PGA.
Table record_table(const std::vector<GroundMotion>& motions);

/// What a new scene is made of. What is not given is assumed and said so in the file.
struct SceneTemplate {
    std::string title = "My dam";
    double height = 0.0;             ///< [m]
    std::optional<double> base;      ///< [m]; default: 0.8 of the height
    std::optional<double> crest;     ///< width [m]; default: a tenth of the height
    std::optional<double> level;     ///< of the reservoir above the heel [m]; default: 95 % of the height
    std::optional<double> friction;  ///< of the base [-]; default: 0.8
    std::optional<double> allowable; ///< slip [mm]; default: 50
    std::vector<std::filesystem::path> records, verticals; ///< as many verticals as records, or none
};

/// A scene file with a comment for each line. Paths are written as given.
std::string scene_text(const SceneTemplate& dam);

/// The section to scale: concrete, water and its levels, silt, ice, forces, curtain, drains, the uplift pressure below
/// the base, dimensions, axes and the sign convention.
/// @param uplift  along the base, as the yield acceleration uses it
/// @param mesh  lines of a mesh of the section, drawn in it; empty: none
Drawing section_drawing(const Scene& scene, const PressureProfile& uplift, const std::vector<Polyline>& mesh = {});

/// The section of a scene as an SVG file: concrete, water, curtain, drains, uplift, signs. A wedge has its own drawing.
/// @throws InputError, NotConverged  of the seepage
std::string drawn_section(const Scene& given);

} // namespace damslip::pages
