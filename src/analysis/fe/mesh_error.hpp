#pragma once

#include "analysis/prepare/ready.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

/// What the mesh leaves open of the slip: |slip(h) - slip(2h)| from one more run on elements of twice the size, with the steps of
/// the run it is for. No order of convergence is assumed.
namespace damslip {

enum class MeshCheck {
    done,       ///< the error is known
    left_out,   ///< not wanted
    imported,   ///< mesh.file: there is no coarser one
    too_coarse, ///< elements of twice the size would not mesh the base
    no_slip,    ///< the run has no final slip with an error of its step: nothing to add to
    no_answer   ///< the run on elements of twice the size has no slip: what the mesh leaves open is not known
};

struct MeshError {
    MeshCheck check = MeshCheck::left_out;
    double base = std::numeric_limits<double>::quiet_NaN(); ///< of the mean slip at the end [m]; NaN: not known
    std::vector<double> lifts;                              ///< of the lift joints, from bottom to top [m]
    std::string reason; ///< why it is not known: "step only: the mesh is imported"; empty: it is known, or nobody asks
};

/// The scene on elements of twice the size, made when the first run asks for it, for all that follow. Runs may ask from
/// their own threads.
class CoarserMesh {
public:
    using Answer = std::function<fe2d::RunAnswer(const fe2d::RunProgress&)>;

    /// @param ready, watch  outlive this; stopped in its set-up, the error is not known
    /// @param wanted  false: every run has MeshCheck::left_out
    /// @param progress  of the runs on it @param modes  of reduced runs
    CoarserMesh(const Ready& ready, bool wanted, Answer progress, Watch& watch, int modes = fe2d::default_modes);

    /// @param run  of `model` with this motion, or of few modes of its dam
    MeshError error_of(const fe2d::EarthquakeRun& model, const fe2d::RunResult& run, const GroundMotion& motion);

private:
    bool known_to_fail(Status status, double step_error, MeshError& result) const;
    bool make(MeshError& result, bool reduced);

    const Ready& ready_;
    bool wanted_;
    Answer progress_;
    Watch& watch_;
    int modes_;
    std::mutex mutex_;
    std::string why_not_; ///< the coarser mesh cannot be made
    std::unique_ptr<const fe2d::EarthquakeRun> full_;
    std::unique_ptr<const fe2d::ReducedRun> reduced_;
};

/// Makes the elements `factor` times as large everywhere but in the far rock; they grow as fast with the distance from the
/// contact plane, and the water's follow.
void scale_mesh(double factor, Scene& scene);

inline constexpr double least_elements = 8.0; ///< on the base, of the coarsest mesh that says anything of a slip

/// On the base, by the scene's size there.
double elements_on_base(const Scene& scene);

} // namespace damslip
