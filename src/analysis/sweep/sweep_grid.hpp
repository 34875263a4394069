#pragma once

#include "analysis/prepare/flexible_mass.hpp"
#include "analysis/prepare/ready.hpp"
#include "analysis/sweep/fe_sweep.hpp"
#include "analysis/sweep/result_store.hpp"
#include "analysis/sweep/sweep_axes.hpp"
#include "core/units.hpp"
#include "scene/scene.hpp"
#include "sliding/block/slide.hpp"

namespace damslip {

/// What all rows share, made once: a rigid model per friction and variant, a motion per record and scale.
struct Grid {
    Axes axes;
    TaskList tasks;
    std::vector<RigidModel> models; ///< of the variants of the frictions that are held: hold_models()
    std::size_t first_friction = 0; ///< that is held
    std::vector<std::shared_ptr<SeepageSource>> seepage; ///< of each size: one serves one geometry
    std::vector<std::shared_ptr<KeptStatics>> statics;   ///< of each variant
    std::vector<std::optional<sliding::FlexibleBlock>>
        flexible; ///< of each variant, with methods of the flexible block
    std::vector<sliding::SkippingMotion> motions,
        horizontal_motions;                          ///< of each record and scale, with and without the vertical
    std::vector<sliding::RegressionInputs> measured; ///< of each motion; the yield coefficient is the row's
    std::vector<double> pgas;                        ///< of each motion, in the order of the ids [m/s^2]
    std::vector<std::string> records;                ///< names
    std::vector<std::string> events;                 ///< of the sequence; empty: none
    std::vector<std::string> anchors;                ///< names; empty: none
    std::vector<std::string> rocks; ///< below the dam (rock_words), of each method; empty: no finite elements

    const RigidModel& model(const GridIndex& at) const
    {
        return models[(at.friction - first_friction) * tasks.variants() + tasks.variant(at)];
    }
    double yield(const GridIndex& at) const { return model(at).downstream.law.constant; }
    double pga(std::size_t id) const { return pgas[id / tasks.method % tasks.motions()]; }
    const sliding::SkippingMotion& motion(const GridIndex& at) const { return motions[record_and_scale(at)]; }
    const sliding::SkippingMotion& horizontal(const GridIndex& at) const
    {
        return horizontal_motions[record_and_scale(at)];
    }
    sliding::RegressionInputs inputs_of(const GridIndex& at) const
    {
        sliding::RegressionInputs inputs = measured[record_and_scale(at)];
        inputs.yield_coefficient = yield(at) / units::standard_gravity;
        return inputs;
    }

private:
    std::size_t record_and_scale(const GridIndex& at) const { return at.record * tasks.scale + at.scale; }
};

/// Without the models of any friction but the first.
Grid begin_grid(const Scene& scene, const Axes& axes, const TaskList& tasks, const Records& records);

/// Makes the models of frictions first ... last and drops all others: a long sweep holds those of the rows at work.
void hold_models(Grid& grid, const Scene& scene, const Records& records, std::size_t first, std::size_t last, int jobs);

/// With all models. @param scene  as given: axes may bring back what the scene itself leaves off, such as another uplift model
Grid make_grid(const Scene& scene, const Axes& axes, const TaskList& tasks, const Records& records, int jobs);

/// The scene of a variant: level, uplift, reservoir and size of `at`.
Scene variant_of(const Scene& scene, const Axes& axes, const GridIndex& at);

/// The scene geometrically `factor` times as large: section, rock box, curtain, drains, water and silt levels, uplift
/// points, lifts, seams, element sizes and where forces act. Materials, slips, point forces and ice thrust stay.
///
/// A rigid block on friction with water alone has the same yield acceleration at every size: weight, thrust and uplift
/// grow with the square of the factor, and so does the added mass.
Scene sized(Scene scene, double factor);

/// Adds rows that differ in friction alone: the same as one by one, sooner. @param ids  ascending, at least one
void add_rigid_rows(const Scene& scene, const Grid& grid, std::span<const std::size_t> ids,
                    std::vector<FinishedRow>& rows);

/// The row of an FE run, of the whole dam or of few modes of it. @param with_history  of its slip
FinishedRow fe_row(std::size_t id, const fe2d::RunResult& run, bool with_history);

/// Results of a row that an interrupted sweep did not reach.
RowResults not_run();

/// Empty: a remark of a method that does not apply.
std::optional<Status> status_of(const FinishedRow& row);

} // namespace damslip
