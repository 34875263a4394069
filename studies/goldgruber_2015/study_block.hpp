#pragma once

#include "analysis/prepare/records.hpp"
#include "core/csv.hpp"
#include "pages/report/chart.hpp"
#include "sliding/uplift/uplift.hpp"

/// Uplift and yield acceleration of the rigid block (Goldgruber 2015, figs 4-2, 4-6, 4-7, 4-12).
namespace damslip::study {

/// Uplift of the models of the study: its force, the pressure before and behind the curtain, the critical friction.
struct StudyUplift {
    std::string model;
    PressureProfile profile;
    double force = 0.0;                                ///< U [N/m]
    double before_curtain = 0.0, behind_curtain = 0.0; ///< pressure over the heel's [-]
    double critical_friction = 0.0;                    ///< [-]
};
std::vector<StudyUplift> study_uplifts(const Scene& scene);
Table uplift_table(const std::vector<StudyUplift>& uplifts);
pages::Chart uplift_chart(const std::vector<StudyUplift>& uplifts);

/// Yield acceleration [m/s²] with a water level as a share of the crest's, simplified Westergaard's added mass.
double yield_of(const Scene& scene, const std::string& uplift, double level_share, double friction);
/// Fig. 4-6: over friction, for several levels.
pages::Chart yield_by_level(const Scene& scene, const std::string& uplift);

/// Fig. 4-7: yield acceleration with the vertical motion beside the constant one and the ground's, at friction 0.84.
pages::Chart yield_with_vertical(const Scene& scene, const std::string& uplift, const GroundMotion& motion);

/// Rigid block and regressions over the yield acceleration.
struct RegressionsBeside {
    std::vector<double> yield; ///< a_y [g]
    std::vector<double> block; ///< horizontal motion, largest slip [mm]
    struct Curve {
        std::string id;
        std::vector<double> median, low, high; ///< [mm]; NaN: not defined there
    };
    std::vector<Curve> regressions; ///< Ambraseys & Menu 1988, Jibson 1993, Jibson et al. 1998
};
/// Frictions are chosen for a_y of 0.005 to 0.12 g; seepage uplift, simplified Westergaard.
RegressionsBeside regressions_beside_block(const Scene& scene, const RecordPair& record);
/// Fig. 4-12.
pages::Chart regression_chart(const RegressionsBeside& values);

} // namespace damslip::study
