#pragma once

#include "analysis/prepare/rigid_model.hpp"
#include "pages/fe/fe_output.hpp"
#include "pages/fe/mesh_drawing.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

/// An FE contact run as the report that is handed in.
namespace damslip::pages {

/// The whole answer in one sentence with its verdict (verdict_of), the worst run named. FAIL: no equilibrium before or after
/// the earthquake, a slip of base or lift joint surely above the allowable or without end, in any of the runs. Unresolved:
/// a run, or the state after it, without an answer, or an allowable slip within the error.
/// Joined with the load combinations whose checks fail, the state after the earthquake of the runs among them.
/// @param combinations  Ready::combinations() @param step  what the step's part of the error holds
Headline fe_headline(const Scene& scene, const std::vector<ContactRun>& runs,
                     const std::vector<sliding::Equilibrium>& combinations = {}, const std::string& step = "step");

/// Sentence and verdict for a terminal.
std::string headline_text(const Headline& headline);

/// Slips, friction, opening of the worst run: for the top of the page.
std::vector<std::pair<std::string, std::string>> fe_key_figures(const Scene& scene,
                                                                const std::vector<ContactRun>& runs);

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
        const PressureProfile& uplift; ///< under the base before the earthquake
        std::vector<sliding::Equilibrium> combinations = {}; ///< Ready::combinations()
    };
    explicit FeReport(const Input& input);

    /// @param run  with the history of its pairs @param motion  it ran with
    void add(const ContactRun& run, const GroundMotion& motion);

    /// @param runs  all of them, in the order of add() @param messages  shown as warnings @param spread  spread_line()
    Page page(const std::vector<ContactRun>& runs, const std::vector<std::string>& messages,
              const std::string& spread = {}) const;

private:
    Input in_;
    StressView stresses_;
    std::size_t stress_records_ = 0;
    std::vector<Section> sections_;
    std::vector<GroundMotion> motions_;
};

/// What the page, and the answer, of contact runs begin from.
FePageFrame contact_frame(const FeReport::Input& input);

/// What has to be said of scene and runs beside the tables.
/// @param of_rock  warnings on the rock
/// What is to be known first, the rigid base before all; then what is unusual in the scene.
std::vector<std::string> base_notes(const Scene& scene);
/// What each run has to say of itself, in their order. Why a dam goes on by itself, and what ends it, is said of one run, the
/// worst where it is one of them, else the first; the others say how far they walked.
std::vector<std::string> run_sentences(const std::vector<ContactRun>& runs);
/// What became of runs that did not come to rest, or only after they had walked.
void add_run_messages(const std::vector<ContactRun>& runs, std::vector<std::string>& messages);

std::vector<std::string> contact_messages(const Scene& scene, const std::vector<ContactRun>& runs,
                                          const std::vector<std::string>& of_rock);

/// Bonds whose strength was lowered because the elements are too long for them, where the scene does not know the elements: a
/// base on an imported mesh, lift joints.
std::vector<std::string> bond_messages(const Scene& scene, const fe2d::Mesh& mesh);

/// All runs of one call as the answer of `fe`. @param spread  spread_line()
FeAnswer contact_answer(const FeReport::Input& input, const std::vector<ContactRun>& runs,
                        const std::vector<std::string>& messages, const std::string& spread = {});

/// What is kept of one run beside its figures: its tables as CSV files, and fields at the end.
/// @param folder  empty: no files
void keep_contact_run(const std::filesystem::path& folder, const FeReport::Input& input, const ContactRun& run,
                      FieldSeries& fields);

} // namespace damslip::pages
