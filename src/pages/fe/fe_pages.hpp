#pragma once

#include "analysis/fe/contact_runs.hpp"
#include "analysis/fe/tied_runs.hpp"
#include "analysis/fe/traced_cracks.hpp"
#include "analysis/prepare/records.hpp"
#include "analysis/prepare/rigid_model.hpp"
#include "core/csv.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/mesh/import_mesh.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/output/vtu.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"
#include "scene/effect_plan.hpp"
#include "scene/scene.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

/// Results of FE contact runs as tables.
namespace damslip::pages {

/// A slip of the run [mm]; nothing where its status has none.
Cell slip_cell(const ContactRun& run, double metres);

/// How rows of runs begin.
inline const ColumnOf<ContactRun> record_of_run{in_brief({"record", "record"}), &ContactRun::record},
    polarity_of_run{in_brief({"polarity", "polarity"}), &ContactRun::polarity};

/// The terms of the energy, as tables and files have them.
const std::vector<ColumnOf<fe2d::Energy>>& energy_columns();
/// The same, and those of the joints' laws that are not zero in some row.
std::vector<ColumnOf<fe2d::Energy>> energy_columns_of(const std::vector<fe2d::Energy>& rows);

/// The columns of a run, each by its name: tables of runs are made of some of them.
struct RunColumns {
    using C = ColumnOf<ContactRun>;
    explicit RunColumns(const std::optional<double>& allowable); ///< slip [m]

    C status, slip, modes_error, step_error, mesh_error, total_error, error_parts, max_slip, rigid_slip, verdict, modes,
        highest_frequency, steps, dt, correction, corrected_dt, unresolved, residual, energy_error, seconds,
        slid_at_least;
    C slip_in_words; ///< for people: "at least 512" of a dam that goes on by itself
};

// One row per run (or stage).
Table contact_stage_table(const std::vector<ContactRun>& runs);
Table contact_run_table(const std::vector<ContactRun>& runs, const std::optional<double>& allowable);
Table contact_slip_table(const std::vector<ContactRun>& runs); ///< slip along the base, rocking, opening
/// Without rows where the scene has no lift joint.
Table contact_lift_table(const std::vector<ContactRun>& runs, const std::optional<double>& allowable);
Table bond_table(const std::vector<ContactRun>& runs); ///< how far bonded lift joints have cracked; empty: none has a bond
/// What the anchors came to; without rows where the scene has none.
Table contact_anchor_table(const std::vector<ContactRun>& runs);
/// Of a sequence, one row for each event that was reached; without rows where there is none.
Table contact_event_table(const std::vector<ContactRun>& runs);
Table contact_count_table(const std::vector<ContactRun>& runs);  ///< steps by the path of the contact solver
Table contact_energy_table(const std::vector<ContactRun>& runs); ///< terms at the end
/// Slip with the ground moving and at rest, and what pays for it (fe2d::SlideWatch).
Table run_out_table(const std::vector<ContactRun>& runs);

/// What governs the slip of contact runs, and what is to be looked at.
void add_points(const Scene& scene, const std::vector<ContactRun>& runs, Answer& answer, const std::string& name = "governs");

/// What contact_run_table() has for people: the answer, and how it was computed.
Table run_answer_table(const std::vector<ContactRun>& runs, const std::optional<double>& allowable);
/// @param with_seconds  false: the same scene gives the same table
Table run_solution_table(const std::vector<ContactRun>& runs, bool with_seconds);

/// Tension away from joints, and tied lifts; the same columns end contact_run_table().
Table crack_table(const std::vector<ContactRun>& runs);
/// One row for each crack that was traced: where it begins, its path and what drawing it anew moved at last.
/// @param scene  that was run, with the paths
Table traced_table(const std::vector<TracedCrack>& cracks, const Scene& scene);
/// "σ₁ 1.2 MPa, 0.41 of f_t, at x 3 m, y 66 m, 4.35 s". @pre run.fe.cracks.known
std::string crack_words(const ContactRun& run);
/// What cracks that the model does not have, and what to run; empty: nothing. Begins with a space.
std::string crack_sentence(const std::vector<ContactRun>& runs);

/// Slip of each run beside that of the same run with exact contact: what penalty, slip tolerance or soft
/// normal contact err by.
Table contact_law_table(const std::vector<ContactRun>& runs);

// Of one run.
Table contact_history_table(const fe2d::RunHistory& history);
Table base_table(const fe2d::RunResult& result); ///< the pairs at the end

/// Pressure, shear, slip, opening and state of the pairs over time, one row per pair and instant: every k-th row of the
/// history with the least k that keeps `largest` instants at most, and the last one.
Table pair_table(const fe2d::RunResult& result, std::size_t largest = 200);

/// One row per step of the history, one letter per pair from heel to toe: s sticks, d slips downstream, u upstream, o
/// open, p pulled (without separation only).
Table state_map(const fe2d::RunHistory& history);

/// Histories of an FE contact run as charts over time.

/// What the charts of one run are made from.
struct RunView {
    const ContactRun& run;
    const sliding::SlideResult* rigid = nullptr; ///< with its history; null: the block slides statically
    std::optional<double> allowable;             ///< slip [m]
    std::string together;                        ///< charts over time share cursor and zoom
    std::size_t records = 1;                     ///< runs in the report: the more, the fewer samples each chart keeps
};

/// thin_for() of their charts: a run of 20 s at 0.005 s is whole, and many long ones stay small.
inline constexpr std::size_t run_samples = 16000, most_run_samples = 4200;

/// Ground acceleration, slip beside the rigid block's, crest, forces on the base, rocking and opening, energy ledger. All
/// since the static state.
std::vector<Chart> history_charts(const RunView& view);

/// Contact pressure and shear from heel to toe: at the start, when the dam slides fastest, at the end, and at any of about
/// 150 instants by a slider.
std::vector<Chart> base_charts(const RunView& view);

/// Damage of the base's bond from heel to toe at the end, 0 intact, 1 broken; nothing where the base has no bond that breaks by
/// energy.
std::optional<Chart> bond_chart(const RunView& view, const Scene& scene);

/// Which part of the base sticks, slips and opens at every row of the history.
StateMap base_states(const RunView& view);

/// What the pages of all FE runs have in common.

struct FePageFrame {
    const Scene& scene; ///< as the plan calls for it
    const EffectPlan& plan;
    const std::vector<RecordPair>& records;
    const fe2d::Model& model;
    const fe2d::FluidModel* water; ///< acoustic; null: none
    PressureProfile uplift = {};   ///< under the base before the earthquake; empty: none, or taken with the loads
    std::string kind;              ///< for the subtitle: "finite elements with contact"
    std::string method;            ///< for the provenance
    bool slides = true;            ///< false: the base is bonded
    bool reduced = false;          ///< on few modes of the dam
};

/// Title, what the records say of themselves, the section with its mesh.
Page begin_fe_page(const FePageFrame& frame);

/// The sections of the worse polarity of each record, as many open as on every page. @param sections  one for each run
/// @returns  those of the other polarity, folded: the appendix
std::vector<Section> add_worse_polarities(const std::vector<ContactRun>& runs, std::vector<Section> sections,
                                          Page& page);

/// Records with spectra, effects, the model's counts and further tables, scene and provenance.
void end_fe_page(const FePageFrame& frame, const std::vector<GroundMotion>& motions, const std::vector<Table>& tables,
                 Page& page);

/// The mesh of an FE run: its lines in the section, and stresses on it in some states.

/// Element sides of the dam, each once.
std::vector<Polyline> dam_mesh_lines(const fe2d::Mesh& mesh);

/// Stresses on the deformed mesh, without a state yet.
MeshView stress_view(const fe2d::EarthquakeRun& run);
/// Adds the kept states of one run, its start only as the first of all.
void add_stresses(const fe2d::EarthquakeRun& run, const std::string& record, const fe2d::RunResult& result,
                  MeshView& view);

/// Numbers, sizes and shapes of a mesh, in one row.
Table mesh_table(const fe2d::Mesh& mesh);

/// What reading a mesh file left out or changed.
std::string import_note(const Scene& scene, const fe2d::ImportSummary& summary);

/// What all kinds of FE runs write: counts, the frame of the answer, fields for ParaView.

/// @param water  acoustic, a row of its own; null: none
Table count_table(fe2d::ModelCounts counts, const fe2d::FluidModel* water = nullptr);

/// Displacement of the upstream end of the crest [m].
Eigen::Vector2d crest_displacement(const fe2d::Model& model, const Eigen::VectorXd& displacement);

/// Major and minor principal stress of each column (xx, yy, xy), tension positive [Pa].
Eigen::MatrixXd principal_stresses(const Eigen::Matrix3Xd& stress);

/// Displacements of the unknowns as one column (x, y) per node; fixed nodes stay at zero.
Eigen::MatrixXd node_vectors(const fe2d::DofMap& dofs, const Eigen::VectorXd& unknowns);

/// Scene, base, effects and counts of the model.
Answer begin_fe_answer(const FePageFrame& frame);

/// FAIL where the headline says so, of the slip or of the load combinations; else verdict_of() the runs.
Verdict joined_verdict(const Headline& headline, const std::vector<ContactRun>& runs,
                       const std::optional<double>& allowable);

/// Name of a file of one run, without its ending: "history_El_Centro_NS_+1". Records
/// whose names would give the same file get a hash of the name.
std::string run_file(const std::string& kind, const Scene& scene, const std::string& record,
                     const std::string& suffix = "");

/// fields_0000.vtu ... and fields.pvd of one run folder; nothing for an empty folder.
class FieldSeries {
public:
    FieldSeries(std::filesystem::path folder, const fe2d::Model& model) : folder_(std::move(folder)), model_(model) {}

    /// @param displacement  shown [m] @param elastic  that carries the stresses [m]
    /// @param more  other arrays on the nodes
    void add(const std::string& name, double time, const Eigen::VectorXd& displacement, const Eigen::VectorXd& elastic,
             std::vector<fe2d::VtuArray> more = {});
    void write_collection() const;

private:
    std::filesystem::path folder_;
    const fe2d::Model& model_;
    std::vector<fe2d::PvdEntry> entries_;
};

/// summary.json, fields.pvd, the resolved scene and report.html.
void write_fe_files(const std::filesystem::path& folder, const Scene& scene, const Answer& answer,
                    const FieldSeries& fields, const Page& page);

/// An FE contact run as the report that is handed in.

/// The whole answer in one sentence with its verdict (verdict_of), the worst run named. FAIL: no equilibrium before or after
/// the earthquake, a slip of base or lift joint surely above the allowable or without end, in any of the runs. Unresolved:
/// a run, or the state after it, without an answer, or an allowable slip within the error.
/// Joined with the load combinations whose checks fail, the state after the earthquake of the runs among them.
/// @param combinations  Ready::combinations()
Headline fe_headline(const Scene& scene, const std::vector<ContactRun>& runs,
                     const std::vector<sliding::Equilibrium>& combinations = {});

/// Takes the runs one after the other, so that the values of the pairs over time need to be there for one at a time only.
class FeReport {
public:
    /// What all runs share. References are kept.
    struct Input {
        const Scene& scene; ///< as the plan calls for it
        const EffectPlan& plan;
        const std::vector<RecordPair>& records;
        const fe2d::EarthquakeRun& model;
        const RigidModel& rigid;
        const PressureProfile& uplift;                       ///< under the base before the earthquake
        std::vector<sliding::Equilibrium> combinations = {}; ///< Ready::combinations()
        bool reduced = false;                                ///< on few modes of the dam
        std::vector<TracedCrack> traced = {};                ///< ContactRuns::traced()
    };
    explicit FeReport(const Input& input);

    /// @param run  with the history of its pairs @param motion  it ran with
    void add(const ContactRun& run, const GroundMotion& motion);

    /// @param runs  all of them, in the order of add() @param messages  shown as warnings @param spread  spread_line()
    Page page(const std::vector<ContactRun>& runs, const std::vector<std::string>& messages,
              const std::string& spread = {}) const;

private:
    Input in_;
    MeshView stresses_;
    std::size_t stress_records_ = 0;
    std::vector<Section> sections_;
    std::vector<GroundMotion> motions_;
};

/// Writes the frames of a run (RunHistory::frames), one after the other so that one is held at a time: for each a .vtm with
/// the blocks dam, rock, water (acoustic) and joints, and over all of them <folder>/frames_<record>.pvd with times in s.
///
/// Dam and rock: displacement_m (from where the run counts it), stresses. Water: pressure_Pa beyond the static one. Joints,
/// lines from heel to toe and along lift joints: opening_m, slip_m since the static state, normal_pressure_Pa (effective,
/// compression positive), shear_Pa (on the part above, positive where it resists downstream slip), water_pressure_Pa,
/// state (0 sticks, 1 slips downstream, 2 upstream, 3 open, 4 pulled).
/// @returns the name of the .pvd; empty: the run has no frames @throws InputError when a file cannot be written
std::string write_frames(const std::filesystem::path& folder, const FeReport::Input& of, const ContactRun& run);

/// Adds a message for each run that did not come to rest, or came to rest after ratcheting.
void add_run_messages(const std::vector<ContactRun>& runs, std::vector<std::string>& messages);

/// What has to be said of scene and runs beside the tables. @param of_rock  warnings on the rock
std::vector<std::string> contact_messages(const Scene& scene, const std::vector<ContactRun>& runs,
                                          const std::vector<std::string>& of_rock);

/// Bonds whose strength was lowered because the elements are too long for them, where the scene does not know the elements: a
/// base on an imported mesh, lift joints.
std::vector<std::string> bond_messages(const Scene& scene, const fe2d::Mesh& mesh);

/// All runs of one call as the answer of `fe`. @param spread  spread_line()
Answer contact_answer(const FeReport::Input& input, const std::vector<ContactRun>& runs,
                        const std::vector<std::string>& messages, const std::string& spread = {});

/// What is kept of one run beside its figures: its tables as CSV files, and fields at the end.
/// @param folder  empty: no files
void keep_contact_run(const std::filesystem::path& folder, const FeReport::Input& input, const ContactRun& run,
                      FieldSeries& fields);

/// The rock below a dam that slides, as answers and pages name it beside the slip.

/// "radiating rock, 2650 kg/m3 (none given): waves right to 29 Hz; 122 modes, error 0.8 %, found in the cache"
std::string rock_line(const Scene& scene, const fe2d::EarthquakeRun& model);

/// {"model", "words"} and of radiating rock density, frequency, modes, error, gate, unknowns, seconds, origin.
nlohmann::ordered_json rock_json(const Scene& scene, const fe2d::EarthquakeRun& model);

/// What is to be known of radiating rock, what the bond asks of the mesh, and what the waves of each record ask of box and mesh (rock_warnings()): the lines of all runs of one
/// model.
class ModelNotes {
public:
    /// @param scene, model  outlive this
    ModelNotes(const Scene& scene, const fe2d::EarthquakeRun& model);
    /// A line that both polarities of a record ask for is there once.
    void add(const std::string& record, const GroundMotion& motion);
    const std::vector<std::string>& lines() const { return lines_; }

private:
    const Scene& scene_;
    const fe2d::EarthquakeRun& model_;
    std::vector<std::string> lines_;
};

/// What to know about length, end and mesh of the scene's water where the ground excites frequencies up to `highest` [Hz].
std::vector<std::string> reservoir_warnings(const Scene& scene, double highest);

/// Unknowns of the water: "1 020 pressures, 12 layers ...".
std::string water_counts(const fe2d::FluidModel& water);

/// Water that follows the opening of the base, for people; nothing where the scene's does not.

/// One row per run: crack, pressures, work.
Table base_water_table(const Scene& scene, const std::vector<ContactRun>& runs);
/// Energy of the flow along the joint, one row per run; without rows unless opening is reynolds.
Table joint_flow_table(const std::vector<ContactRun>& runs);
/// What a reader must know of a run's crack and water.
std::vector<std::string> base_water_notes(const Scene& scene, const std::vector<ContactRun>& runs);
/// Pressure along the base: before, with the longest crack, at its least and largest, at the end, and at any instant by a
/// slider.
std::optional<Chart> base_water_chart(const RunView& view);

FePageFrame tied_frame(const Scene& scene, const EffectPlan& plan, const std::vector<RecordPair>& records,
                       const fe2d::Model& model, const fe2d::FluidModel* water);

Answer tied_answer(const FePageFrame& frame, const fe2d::StaticSolution& statics, const std::vector<TiedRun>& runs);

/// The history of one run as a CSV file. @param hash  of the scene (EffectPlan::scene_hash)
void write_tied_history(const std::filesystem::path& folder, const Scene& scene, const std::string& hash,
                        const TiedRun& run);

/// Histories of crest, base forces and energies of runs that cannot slide.
Page tied_page(const FePageFrame& frame, const fe2d::StaticSolution& statics, const std::vector<TiedRun>& runs);

} // namespace damslip::pages
