#pragma once

#include "cli/fe_sweep.hpp"
#include "cli/rigid_model.hpp"
#include "cli/sweep_axes.hpp"
#include "core/units.hpp"
#include "sliding/block/skipping_motion.hpp"

namespace damslip::cli {

/// Position of a flat index in the grid, the last axis fastest.
struct GridIndex {
    std::size_t friction, level, uplift, reservoir, scale, polarity, record, method;
};
GridIndex grid_index(const Axes& axes, std::size_t records, std::size_t id);

/// What all rows share, made once: a model per friction, level, uplift and reservoir, a motion per record and scale.
struct Grid {
    Axes axes;
    std::vector<RigidModel> models;
    std::vector<sliding::SkippingMotion> motions,
        horizontal_motions; ///< of each record and scale, with and without the vertical
    std::vector<FeSlip> fe; ///< of each variant, record, scale, polarity and friction; empty without this method
    std::vector<sliding::RegressionInputs> measured; ///< of each motion; the yield coefficient is the row's
    std::vector<std::string> records;

    std::size_t size() const { return models.size() * motions.size() * axes.polarity.size() * axes.method.size(); }
    const RigidModel& model(const GridIndex& g) const
    {
        return models[((g.friction * axes.level.size() + g.level) * axes.uplift.size() + g.uplift) *
                          axes.reservoir.size() +
                      g.reservoir];
    }
    const FeSlip& fe_slip(const GridIndex& g) const
    {
        const std::size_t variant = (g.level * axes.uplift.size() + g.uplift) * axes.reservoir.size() + g.reservoir,
                          motion = (g.record * axes.scale.size() + g.scale) * axes.polarity.size() + g.polarity,
                          motions_of_variant = motions.size() * axes.polarity.size();
        return fe[(variant * motions_of_variant + motion) * axes.friction.size() + g.friction];
    }
    sliding::RegressionInputs inputs_of(const GridIndex& g) const
    {
        sliding::RegressionInputs inputs = measured[g.record * axes.scale.size() + g.scale];
        inputs.yield_coefficient = model(g).downstream.law.constant / units::standard_gravity;
        return inputs;
    }
    const sliding::SkippingMotion& motion(const GridIndex& g) const
    {
        return motions[g.record * axes.scale.size() + g.scale];
    }
    const sliding::SkippingMotion& horizontal(const GridIndex& g) const
    {
        return horizontal_motions[g.record * axes.scale.size() + g.scale];
    }
};

/// Rigid models and motions, without FE runs.
Grid make_grid(const Scene& scene, const Axes& axes, const std::vector<RecordPair>& records, int jobs);

/// FE runs of the whole grid into grid.fe, one set-up for each variant.
FeSweepCounts run_fe(const Scene& scene, const std::vector<RecordPair>& records, int jobs, Progress& progress,
                     const InterruptGuard& interrupt, Grid& grid);

} // namespace damslip::cli
