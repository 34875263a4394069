#pragma once

#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/output/vtu.hpp"
#include "pages/fe/contact_tables.hpp"
#include "pages/report/json_object.hpp"
#include "pages/report/page.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace damslip::pages {

/// What both kinds of FE runs write: fields for ParaView, counts, crest motion.
/// @param water  acoustic, a row of its own; null: none
Table count_table(fe2d::ModelCounts counts, const fe2d::FluidModel* water = nullptr);

/// Displacement of the upstream end of the crest [m].
Eigen::Vector2d crest_displacement(const fe2d::Model& model, const Eigen::VectorXd& displacement);

/// Displacements of the unknowns as one column (x, y) per node; fixed nodes stay at zero.
Eigen::MatrixXd node_vectors(const fe2d::DofMap& dofs, const Eigen::VectorXd& unknowns);

/// The worst run by record and polarity, with its status, slip, error and verdict; null without runs.
nlohmann::ordered_json worst_json(const std::vector<ContactRun>& runs, const std::optional<double>& allowable);

/// Sentence and verdict for a terminal.
std::string headline_text(const Headline& headline);

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

/// summary.json, fields.pvd and the resolved scene, and a line that says so; nothing for an empty folder.
void finish_output(const std::filesystem::path& folder, const Scene& scene, const std::string& summary_json,
                   const FieldSeries& fields);

} // namespace damslip::pages
