#pragma once

#include "fe2d/run/earthquake_run.hpp"
#include "pages/report/page.hpp"

/// The mesh of an FE run: its lines in the section, and stresses on it in some states.
namespace damslip::pages {

/// Element sides of the dam, each once.
std::vector<Polyline> dam_mesh_lines(const fe2d::Mesh& mesh);

/// Stresses of the kept states of runs on the deformed mesh.
class StressView {
public:
    /// @param run  outlives this
    explicit StressView(const fe2d::EarthquakeRun& run);

    /// The kept states of one run, its start only for the first run.
    void add(const std::string& record, const fe2d::RunResult& result);

    bool empty() const { return view_.states.empty(); }
    const MeshView& view() const { return view_; }

private:
    void add_state(const std::string& name, const fe2d::StoredState& state, const Eigen::VectorXd& zero);

    const fe2d::EarthquakeRun& run_;
    MeshView view_;
};

} // namespace damslip::pages
