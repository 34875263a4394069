#pragma once

#include "fe2d/output/vtu.hpp"
#include "pages/fe/contact_tables.hpp"
#include "pages/fe/fe_page.hpp"
#include "pages/report/json_object.hpp"

#include <nlohmann/json.hpp>
#include <vector>

/// What all kinds of FE runs write: counts, the frame of the answer, fields for ParaView.
namespace damslip::pages {

/// @param water  acoustic, a row of its own; null: none
Table count_table(fe2d::ModelCounts counts, const fe2d::FluidModel* water = nullptr);

/// Displacement of the upstream end of the crest [m].
Eigen::Vector2d crest_displacement(const fe2d::Model& model, const Eigen::VectorXd& displacement);

/// Major and minor principal stress of each column (xx, yy, xy), tension positive [Pa].
Eigen::MatrixXd principal_stresses(const Eigen::Matrix3Xd& stress);

/// Displacements of the unknowns as one column (x, y) per node; fixed nodes stay at zero.
Eigen::MatrixXd node_vectors(const fe2d::DofMap& dofs, const Eigen::VectorXd& unknowns);

enum class FeKind { contact, reduced, tied };

/// The answer of `fe`: one object for --json and summary.json, and text for a terminal.
struct FeAnswer {
    nlohmann::ordered_json json;
    std::string text;
};

/// Scene, base, effects and counts of the model.
FeAnswer begin_fe_answer(FeKind kind, const FePageFrame& frame);

/// FAIL where the headline says so, of the slip or of the load combinations; else verdict_of() the runs.
Verdict joined_verdict(const Headline& headline, const std::vector<ContactRun>& runs,
                       const std::optional<double>& allowable);

/// Headline, verdict and worst run, in the object.
void add_verdict(const Headline& headline, const std::vector<ContactRun>& runs, const std::optional<double>& allowable,
                 FeAnswer& answer);

/// Messages last; in the text as notes.
void end_fe_answer(const std::vector<std::string>& messages, FeAnswer& answer);

/// Name of a file of one run, without its ending: "history_El_Centro_NS_+1"; records whose names would give the same file are told apart.
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
void write_fe_files(const std::filesystem::path& folder, const Scene& scene, const FeAnswer& answer,
                    const FieldSeries& fields, const Page& page);

} // namespace damslip::pages
