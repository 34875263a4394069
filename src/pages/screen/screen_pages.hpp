#pragma once

#include "analysis/prepare/rigid_model.hpp"
#include "analysis/screen/regression_rows.hpp"
#include "analysis/screen/screening.hpp"
#include "core/csv.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/chart.hpp"
#include "pages/report/page.hpp"
#include "sliding/empirical/regression.hpp"

#include <filesystem>
#include <optional>
#include <string>

/// Charts of a screening: yield acceleration, slip, and what the block does under each record.
namespace damslip::pages {

/// Yield acceleration over friction for each uplift model the scene has the data for.
Chart yield_over_friction(const Scene& scene, const Screening& s);

/// Yield acceleration over the reservoir level, likewise. @pre scene.reservoir
Chart yield_over_level(const Scene& scene, const Screening& s);

/// Largest slip over friction, worse polarity, with the vertical component where a record has one: each record up to 6,
/// beyond that median, 16/84 % and largest.
/// @param jobs  threads, 0: all cores
/// @returns nothing without records, or for a scene whose friction is a table over slip
std::optional<Chart> slip_over_friction(const Scene& scene, const Screening& s,
                                        const std::vector<GroundMotion>& motions, int jobs);

/// Largest slip of each record, worse polarity.
Chart slip_by_record(const Screening& s, const std::optional<double>& allowable);

/// Largest slip of each record over a_y/PGA.
Chart slip_over_ratio(const Screening& s);

/// Ground acceleration, slip histories, and (with a vertical component) yield against ground acceleration as
/// Goldgruber (2015), fig. 4-7, of one record; regressions beside the slip. The charts share cursor and zoom.
/// @param motion   of record `number`  @param records  how many there are: the more, the fewer samples each chart keeps
std::vector<Part> record_parts(const Scene& scene, const Screening& s, const GroundMotion& motion, std::size_t number,
                               std::size_t records);

} // namespace damslip::pages

namespace damslip {
struct SpectrumLevel;
}

/// The screening as the report that is handed in.
namespace damslip::pages {

/// What the report is made from.
struct ScreenReportInput {
    const Scene& given; ///< as read, for the resolved scene
    const Scene& scene; ///< as the plan calls for it
    const Screening& screening;
    const std::vector<RecordPair>& records;
    int jobs = 0;                            ///< threads, 0: all cores
    const SpectrumLevel* spectrum = nullptr; ///< --response-spectrum; null: not asked for
    bool mean_polarity = false;              ///< a table with the mean of both polarities
};

/// The whole answer in one sentence with its verdict: FAIL for a block that slides or floats without any earthquake, a
/// slip above the allowable or without end, or a limit-equilibrium check not met; PASS when something was judged and
/// nothing failed; neither where a run has no answer, or an error that is not known.
Headline screen_headline(const Scene& scene, const Screening& s);

/// What is to be known of the scene beside the screening's own warnings. @param ready  with the flexible block's modes
std::vector<std::string> screen_notes(const Ready& ready);

/// Section, effects, limit equilibrium, yield acceleration, slip over friction and records, each record, provenance.
Page screen_page(const ScreenReportInput& input);

Answer screen_answer(const ScreenReportInput& input);

/// The files of the answer, scene.resolved.toml, report.html. @param answer  screen_answer() of the input
void write_screening(const std::filesystem::path& folder, const ScreenReportInput& input, const Answer& answer);

Table yield_table(const Screening& s);
/// The rigid block above each lift joint: static safety and yield acceleration. Empty without lift joints.
Table lift_joint_table(const Scene& scene);
Table slip_table(const Screening& s, const std::optional<double>& allowable);
/// The elastic dam by reduced finite elements, one row a run. @pre s.elastic
Table elastic_table(const Screening& s, const std::optional<double>& allowable);
/// Mean slip of both polarities, of records that have a slip in both.
Table mean_slip_table(const Screening& s);
/// The block that rocks and slides, with its energies.
Table rocking_table(const Screening& s, const std::optional<double>& allowable);
/// The slip without bond, where much of the resistance is bond.
Table bond_table(const Screening& s, const std::optional<double>& allowable);
/// What the anchors through the base came to in each slide, with the vertical component where there is one.
Table screened_anchor_table(const Screening& s);
/// Of a sequence, one row for each event and polarity; without rows where there is none.
Table event_table(const Screening& s);
/// Slip of the flexible block beside the rigid one, with its verdict.
Table flexible_table(const Screening& s, const std::optional<double>& allowable);

/// Which rows of the table of planes: terminals show of the lifts those that govern; `assess` of all planes.
enum class PlaneRows { all, governing_lifts, governing };
/// Base, lifts and seams side by side. @pre there are planes
Table plane_table(const Planes& planes, const Scene& scene, PlaneRows which);
/// Base, lifts and seams side by side; then each lift, each seam, and the blocks of each seam. Empty: the scene has neither.
std::vector<Table> plane_tables(const Planes& planes, const Scene& scene, PlaneRows which);
/// What the load combinations require of base, lifts and seams, what was computed, and by whom it is required; no rows: nothing is.
Table criteria_table(const Screening& s, const Scene& scene);
/// The tables, a drawing of each seam with its blocks, water and forces, and charts over elevation and wedge angle.
Section plane_section(const Planes& planes, const Scene& scene);
/// The headline of the base joined with what the other planes say: the worst of them counts.
/// "F 0.95, required 1.3 in usual": the factor of safety that is least over the required one.
std::string factor_words(const PlaneRow& row, const std::vector<PlaneState>& states);

Headline with_planes(Headline headline, const Planes& planes, const Scene& scene);

/// Yield and friction that keep the slip within the allowable one; without rows where there is none.
Table needed_table(const std::vector<NeededRow>& rows, const Scene& scene);

/// Every regression for every record, for files.
Table regression_table(const std::vector<RegressionRow>& rows);
/// Those that give an answer of their own, with the weighted median of each record; in the notes a line per record with
/// what is outside its range (slip, never weighted), what expects no slip and what is missing.
Table regression_summary(const std::vector<RegressionRow>& rows);
Table statistics_table(const Screening& s);

/// Tables of what is computed without a scene: `slide` and `regress`.

Table given_yield_table(const GivenYieldBlock& block, const std::vector<GivenYieldRow>& rows);

/// Of each regression whose inputs are given, the yield coefficient at which its median is the allowable slip [m].
Table allowable_coefficient_table(const sliding::RegressionInputs& inputs, double allowable);

/// The rock wedge: its planes, how it stands, its yields. @pre scene.wedge

/// Orientation, area, strength, water and normal force of both planes.
Table wedge_plane_table(const Scene& scene, const RigidWedge& wedge);

/// Way of sliding, its direction, factor of safety: as it is, and without cohesion where a slip takes it away.
Table wedge_stability_table(const Scene& scene, const RigidModel& model);

/// Yield accelerations for ground motion along the records, against them, most unfavourable, and vertical.
Table wedge_yield_table(const Scene& scene, const RigidWedge& wedge);

/// Yield acceleration over the azimuth the motion drives to.
Chart wedge_yield_chart(const RigidWedge& wedge, double largest_pga);

/// "plunging 31.2° towards 158°".
std::string direction_words(const Vector3& direction);

/// Lower hemisphere, equal area: great circles of planes, face and upper ground, line of intersection, way of sliding, direction of
/// the records. @pre scene.wedge
Drawing stereonet(const Scene& scene, const RigidWedge& wedge);

/// The wedge in its slope, seen from before the face; nothing where the scene gives no surfaces.
std::optional<Drawing> wedge_drawing(const Scene& scene, const RigidWedge& wedge);

} // namespace damslip::pages
