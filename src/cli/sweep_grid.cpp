#include "cli/sweep_grid.hpp"

#include "cli/seepage_source.hpp"
#include "core/parallel.hpp"

namespace damslip::cli {

GridIndex grid_index(const Axes& axes, std::size_t records, std::size_t id)
{
    const auto take = [&id](std::size_t n) {
        const std::size_t i = id % n;
        id /= n;
        return i;
    };
    GridIndex g{};
    g.method = take(axes.method.size());
    g.record = take(records);
    g.polarity = take(axes.polarity.size());
    g.scale = take(axes.scale.size());
    g.reservoir = take(axes.reservoir.size());
    g.uplift = take(axes.uplift.size());
    g.level = take(axes.level.size());
    g.friction = take(axes.friction.size());
    return g;
}

Grid make_grid(const Scene& scene, const Axes& axes, const std::vector<RecordPair>& records, int jobs)
{
    Grid grid;
    grid.axes = axes;
    SeepageSource source;
    grid.models.resize(axes.friction.size() * axes.level.size() * axes.uplift.size() * axes.reservoir.size());
    parallel_for(grid.models.size(), jobs, [&](std::size_t i) {
        std::size_t rest = i;
        const std::string& reservoir = axes.reservoir[rest % axes.reservoir.size()];
        rest /= axes.reservoir.size();
        const std::string& uplift = axes.uplift[rest % axes.uplift.size()];
        rest /= axes.uplift.size();
        Scene here = variant(scene, axes.level[rest % axes.level.size()], uplift, reservoir);
        const double friction = axes.friction[rest / axes.level.size()];
        if (friction != here.contact.friction) here = with_friction(std::move(here), friction);
        grid.models[i] = make_rigid_model(here, source.profile_of(here));
    });
    for (const RecordPair& pair : records) {
        grid.records.push_back(pair.files.name);
        for (const double scale : axes.scale) {
            const GroundMotion motion = ground_motion(scene, pair, scale);
            grid.measured.push_back(regression_inputs(pair, motion, grid.models.front()));
            grid.horizontal_motions.emplace_back(horizontal_only(motion));
            grid.motions.emplace_back(motion);
        }
    }
    return grid;
}

FeSweepCounts run_fe(const Scene& scene, const std::vector<RecordPair>& records, int jobs, Progress& progress,
                     const InterruptGuard& interrupt, Grid& grid)
{
    const Axes& axes = grid.axes;
    std::vector<GroundMotion> motions;
    for (const RecordPair& pair : records)
        for (const double scale : axes.scale)
            for (const int polarity : axes.polarity) motions.push_back(ground_motion(scene, pair, scale, polarity));
    FeSweepCounts counts;
    for (const double level : axes.level)
        for (const std::string& uplift : axes.uplift)
            for (const std::string& reservoir : axes.reservoir) {
                const std::vector<FeSlip> slips = fe_slips(variant(scene, level, uplift, reservoir), axes.friction,
                                                           records, motions, jobs, progress, interrupt, counts);
                grid.fe.insert(grid.fe.end(), slips.begin(), slips.end());
            }
    return counts;
}

} // namespace damslip::cli
